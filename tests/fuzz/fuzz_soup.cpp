// Meshes with every defect there is, repaired and taken apart into faces.

#include "checks.hpp"
#include "soup.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  qmcf::fuzz::checkTopology(qmcf::fuzz::soupFromBytes(qmcf::fuzz::bytesOf(data, size)));
  return 0;
}
