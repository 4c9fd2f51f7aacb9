#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ply_header.hpp"
#include "text_cursor.hpp"

namespace qmcf {

enum class PlyValueState : std::uint8_t { ok, malformed, ended };

/// Reads the values of the data one by one, whatever their encoding. Infinite and NaN values are passed on.
class PlyValueReader {
 public:
  PlyValueReader(std::string_view bytes, const PlyHeader& header)
      : encoding_(header.encoding), data_(bytes.substr(header.size)), cursor_(data_), firstLine_(header.lines) {}

  PlyValueState next(PlyType type, double& value) {
    return encoding_ == PlyEncoding::ascii ? nextAscii(value) : nextBinary(type, value);
  }
  /// Least bytes that a value takes.
  [[nodiscard]] std::size_t leastSize(PlyType type) const {
    return encoding_ == PlyEncoding::ascii ? 2 : plyTypeSize(type);
  }
  [[nodiscard]] std::size_t remaining() const {
    // One more: the last value of a text needs no separator.
    return encoding_ == PlyEncoding::ascii ? cursor_.remaining() + 1 : data_.size() - offset_;
  }
  [[nodiscard]] double fraction() const {
    return data_.empty() ? 1.0 : 1.0 - static_cast<double>(remaining()) / static_cast<double>(data_.size() + 1);
  }
  /// "Line 7" of a text; nothing in binary data.
  [[nodiscard]] std::string where() const {
    return encoding_ == PlyEncoding::ascii ? "Line " + std::to_string(firstLine_ + cursor_.line()) + ": " : "";
  }

 private:
  PlyValueState nextAscii(double& value);
  PlyValueState nextBinary(PlyType type, double& value);

  PlyEncoding encoding_;
  std::string_view data_;
  TextCursor cursor_;
  std::size_t offset_ = 0;
  std::int64_t firstLine_;
};

}  // namespace qmcf
