#pragma once

#include <string>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/io/read.hpp"

namespace qmcf::cli {

/// Reads a file as a triangle mesh.
Result<ReadModel> loadModel(const std::string& path, Progress& progress);
/// Reads a file as a mesh of triangles and quadrilaterals.
Result<QuadMesh> loadQuadMesh(const std::string& path, Progress& progress);

}  // namespace qmcf::cli
