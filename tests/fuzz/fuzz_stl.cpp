// Any bytes, starting from small STL files.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  qmcf::fuzz::checkReading(qmcf::fuzz::bytesOf(data, size));
  return 0;
}
