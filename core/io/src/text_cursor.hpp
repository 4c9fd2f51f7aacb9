#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace qmcf {

/// What was found where a number should be.
enum class NumberState : std::uint8_t { ok, nonFinite, malformed, missing };

/// Reads text in memory and counts its lines. LF, CR and CRLF each end one line; a backslash right before a line's end
/// continues the line where skipBlanks() and nextLine() meet it.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text)
      : begin_(text.data()), position_(text.data()), end_(text.data() + text.size()) {}

  [[nodiscard]] bool atEnd() const { return position_ == end_; }
  [[nodiscard]] bool atLineEnd() const { return position_ == end_ || *position_ == '\n' || *position_ == '\r'; }
  /// The character `ahead` places on; NUL past the end.
  [[nodiscard]] char peek(std::size_t ahead = 0) const { return ahead < remaining() ? position_[ahead] : '\0'; }
  [[nodiscard]] std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }
  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(position_ - begin_); }
  /// The current line, counted from 1.
  [[nodiscard]] std::int64_t line() const { return line_; }

  /// \pre count <= remaining(), and no line ends in between.
  void advance(std::size_t count) { position_ += count; }
  void skipBlanks() {
    while (position_ != end_) {
      if (isBlank(*position_)) {
        ++position_;
      } else if (*position_ != '\\' || !skipContinuation()) {
        return;
      }
    }
  }
  /// Skips blanks and line ends.
  void skipSpace();
  /// Moves behind the end of this line. A comment has no continuation, so that a path at its end can't swallow a line.
  void nextLine(bool continued = true);
  /// The characters up to the next blank or line end, not consumed.
  [[nodiscard]] std::string_view token() const;
  /// The rest of the line without blanks around it, consumed up to the line's end.
  std::string_view restOfLine();

  /// Reads a number after blanks. Values too small for a double become 0. Nothing but a blank or a line end may follow.
  NumberState real(double& value);
  /// Reads an integer after blanks; whatever follows it is left.
  NumberState integer(std::int64_t& value);

  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0' || c == '\x1a'; }

 private:
  /// At a backslash: consumes it with the line end behind it, if there is one, and says so.
  bool skipContinuation();
  void skipLineEnd() {
    position_ += (*position_ == '\r' && position_ + 1 != end_ && position_[1] == '\n') ? 2 : 1;
    ++line_;
  }

  const char* begin_;
  const char* position_;
  const char* end_;
  std::int64_t line_ = 1;
};

/// Whether the two are the same but for the case of ASCII letters.
bool equalsIgnoringCase(std::string_view a, std::string_view b);
/// A piece of the file as a message can quote it: valid UTF-8, no control characters, at most 40 characters, in quotes.
std::string quoted(std::string_view piece);
/// A name of the file as valid UTF-8 without control characters, at most maxBytes long. Bytes that are not UTF-8 are
/// taken for Latin-1.
std::string cleanName(std::string_view name, std::size_t maxBytes = 200);

}  // namespace qmcf
