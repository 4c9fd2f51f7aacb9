// A file of any format, read, repaired and taken apart into faces.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  qmcf::fuzz::checkTopology(qmcf::fuzz::checkReading(qmcf::fuzz::bytesOf(data, size)));
  return 0;
}
