// Any bytes, starting from small PLY files.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  qmcf::fuzz::checkReading(qmcf::fuzz::bytesOf(data, size));
  return 0;
}
