#pragma once

#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace qmcf {

/// Why an operation could not be done. One enumerator per row of errors.def.
enum class ErrorCode : std::uint8_t {
#define QMCF_ERROR(code, exitStatus, meaning) code,
#include "qmcf/base/errors.def"
#undef QMCF_ERROR
};

/// The code's name as written in errors.def; the same in C++, JSON and TypeScript.
std::string_view errorName(ErrorCode code);
/// What the code means in general; an Error's own message says what happened.
std::string_view errorMeaning(ErrorCode code);
/// The exit status of the command line for this code: 2, 3, 4 or 5.
int errorExitStatus(ErrorCode code);

/// An expected failure: what is wrong, where, and what to do about it.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;                 ///< One sentence for a person.
  std::vector<std::int64_t> elements;  ///< Lines or element ids at fault, 0-based ids, at most 100.
};

/// A value or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// \pre ok()
  T& value() & {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  const T& value() const& {
    assert(ok());
    return *std::get_if<0>(&state_);
  }
  T&& value() && {
    assert(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  /// \pre !ok()
  [[nodiscard]] const Error& error() const {
    assert(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The value of operations that return nothing but may fail.
struct Done {};

/// The Error of a run that its Progress asked to stop.
Error cancelledError();

}  // namespace qmcf
