#include "load.hpp"

#include <cstddef>
#include <vector>

#include "files.hpp"

namespace qmcf::cli {

Result<ReadModel> loadModel(const std::string& path, Progress& progress) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes.ok()) return bytes.error();
  return readModel(bytes.value(), progress);
}

Result<QuadMesh> loadQuadMesh(const std::string& path, Progress& progress) {
  const Result<std::vector<std::byte>> bytes = readFile(path);
  if (!bytes.ok()) return bytes.error();
  return readQuadMesh(bytes.value(), progress);
}

}  // namespace qmcf::cli
