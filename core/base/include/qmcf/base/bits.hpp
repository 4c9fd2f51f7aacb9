#pragma once

#include <cstring>

namespace qmcf {

/// The value of type To with the bytes of `from`: std::bit_cast, which the oldest supported libc++ does not have.
template <class To, class From>
To bitCast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(To));
  return to;
}

}  // namespace qmcf
