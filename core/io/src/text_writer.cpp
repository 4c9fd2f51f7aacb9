#include "text_writer.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

namespace qmcf {

std::string shortText(double value) {
  std::string text = nlohmann::json(value).dump();
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0) text.resize(text.size() - 2);
  return text;
}

TextWriter& TextWriter::operator<<(double value) {
  text_ += shortText(value);
  return *this;
}

void TextWriter::appendInteger(long long value) {
  std::array<char, 24> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text_.append(digits.data(), result.ptr);
}

}  // namespace qmcf
