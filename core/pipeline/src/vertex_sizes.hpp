#pragma once

#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// Sizes at the vertices of the input as sizes at those of the repaired mesh. Of input vertices at one point, the
/// smallest holds; a vertex that repair made has what the closest point of the input has, linear in its triangles.
/// Errors: invalidOption if there are not as many sizes as vertices.
Result<std::vector<double>> sizesOfRepaired(const std::vector<double>& sizes, const TriangleMesh& input,
                                            const TriangleMesh& repaired);

}  // namespace qmcf
