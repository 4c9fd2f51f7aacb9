#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// A short decimal form of a finite number that reads back as the same value, the same on every platform (std::to_chars
/// is missing in the oldest supported libc++).
std::string shortText(double value);

/// Appends to a text, numbers as shortText() gives them.
class TextWriter {
 public:
  TextWriter& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  TextWriter& operator<<(char c) {
    text_ += c;
    return *this;
  }
  TextWriter& operator<<(double value);
  TextWriter& operator<<(std::integral auto value) {
    appendInteger(static_cast<long long>(value));
    return *this;
  }
  /// Three numbers with blanks between them.
  TextWriter& operator<<(const Vec3& point) { return *this << point.x << ' ' << point.y << ' ' << point.z; }

  void reserve(std::size_t size) { text_.reserve(size); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void appendInteger(long long value);

  std::string text_;
};

}  // namespace qmcf
