#include "text_writer.hpp"

#include <array>
#include <charconv>

namespace qmcf {

TextWriter& TextWriter::operator<<(double value) {
  std::array<char, 32> digits{};  // The longest double takes 24.
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text_.append(digits.data(), result.ptr);
  return *this;
}

void TextWriter::appendInteger(long long value) {
  std::array<char, 24> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text_.append(digits.data(), result.ptr);
}

}  // namespace qmcf
