#include "text_cursor.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

namespace qmcf {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool contains(std::string_view text, std::string_view part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [](char a, char b) { return lower(a) == b; }) != text.end();
}

/// Length of the UTF-8 sequence at the front of text, 0 if it is none.
std::size_t utf8Length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80U) return 1;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const bool overlong = (first == 0xE0U && byte(1) < 0xA0U) || (first == 0xF0U && byte(1) < 0x90U);
  const bool surrogate = first == 0xEDU && byte(1) >= 0xA0U;
  const bool tooHigh = first == 0xF4U && byte(1) >= 0x90U;
  return overlong || surrogate || tooHigh ? 0 : length;
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8Length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

void appendLatin1(std::string& out, unsigned char byte) {
  out += static_cast<char>(0xC0U | (byte >> 6U));
  out += static_cast<char>(0x80U | (byte & 0x3FU));
}

}  // namespace

void TextCursor::skipSpace() {
  while (position_ != end_) {
    if (*position_ == '\n' || *position_ == '\r') {
      skipLineEnd();
    } else if (isBlank(*position_)) {
      ++position_;
    } else {
      return;
    }
  }
}

bool TextCursor::skipContinuation() {
  const char* const next = position_ + 1;
  if (next == end_ || (*next != '\n' && *next != '\r')) return false;
  position_ = next;
  skipLineEnd();
  return true;
}

void TextCursor::nextLine(bool continued) {
  while (position_ != end_) {
    const char c = *position_;
    if (c == '\n' || c == '\r') {
      skipLineEnd();
      return;
    }
    if (c == '\\' && continued && skipContinuation()) continue;
    ++position_;
  }
}

std::string_view TextCursor::token() const {
  const char* last = position_;
  while (last != end_ && !isBlank(*last) && *last != '\n' && *last != '\r') ++last;
  return {position_, static_cast<std::size_t>(last - position_)};
}

std::string_view TextCursor::restOfLine() {
  while (!atLineEnd() && isBlank(*position_)) ++position_;
  const char* const first = position_;
  while (!atLineEnd()) ++position_;
  const char* last = position_;
  while (last != first && isBlank(last[-1])) --last;
  return {first, static_cast<std::size_t>(last - first)};
}

NumberState TextCursor::real(double& value) {
  skipBlanks();
  if (atLineEnd()) return NumberState::missing;
  const char* const first = *position_ == '+' ? position_ + 1 : position_;
  const auto [last, status] = fast_float::from_chars(first, end_, value);
  const bool understood = status == std::errc{} || status == std::errc::result_out_of_range;
  const bool whole = last == end_ || isBlank(*last) || *last == '\n' || *last == '\r' || *last == '\\';
  if (understood && whole) {
    if (!std::isfinite(value)) return NumberState::nonFinite;
    position_ = last;
    return NumberState::ok;
  }
  // What C libraries print for values that are no number: nan(ind), 1.#QNAN, -1.#IND, Infinity.
  const std::string_view text = token();
  const bool special = contains(text, "nan") || contains(text, "inf") || contains(text, "#ind");
  return special ? NumberState::nonFinite : NumberState::malformed;
}

NumberState TextCursor::integer(std::int64_t& value) {
  skipBlanks();
  if (atLineEnd()) return NumberState::missing;
  const char* digit = position_;
  const bool negative = *digit == '-';
  if (negative || *digit == '+') ++digit;
  const char* const firstDigit = digit;
  constexpr std::int64_t kLimit = 100'000'000'000'000'000;
  std::int64_t magnitude = 0;
  for (; digit != end_ && *digit >= '0' && *digit <= '9'; ++digit) {
    // Saturates: an index this large is out of range whatever its last digits are.
    if (magnitude < kLimit) magnitude = magnitude * 10 + (*digit - '0');
  }
  if (digit == firstDigit) return NumberState::malformed;
  value = negative ? -magnitude : magnitude;
  position_ = digit;
  return NumberState::ok;
}

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string cleanName(std::string_view name, std::size_t maxBytes) {
  const bool utf8 = isUtf8(name);
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t length = utf8 ? utf8Length(name.substr(i)) : 1;
    const auto first = static_cast<unsigned char>(name[i]);
    const std::size_t needed = !utf8 && first >= 0x80U ? 2 : length;
    if (out.size() + needed > maxBytes) break;
    if (!utf8 && first >= 0x80U) {
      appendLatin1(out, first);
    } else if (first < 0x20U || first == 0x7FU) {
      out += ' ';
    } else {
      out.append(name.substr(i, length));
    }
    i += length;
  }
  return out;
}

std::string quoted(std::string_view piece) {
  constexpr std::size_t kLongest = 40;
  return "\"" + cleanName(piece, kLongest) + (piece.size() > kLongest ? "...\"" : "\"");
}

}  // namespace qmcf
