#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

/// The element sizes that suit the crosses: a mesh of squares can follow a field that turns only if its elements grow
/// to the outside of the bend, grad(log h) = -rotated(grad(angle)). Where no size does (the field is not conformal, or
/// faces that share an edge ask for different ones) the least squares over all patches. Rows of such elements need not
/// end inside a face. E6 of docs/algorithm.md.
/// fields: one per patch; a patch with an empty one asks for nothing. Patches share the values at the nodes of their
/// boundaries. Returns, per patch and vertex, log h up to one constant, whose mean over the area is 0.
/// Errors: cancelled, internal (factorisation failed).
Result<std::vector<IdMap<VertexId, double>>> naturalSizes(const std::vector<Patch>& patches,
                                                          const std::vector<CrossField>& fields, Progress& progress);

/// The sizes wanted, as rows of elements can take them up from the boundary of a patch inwards: the s that minimises
/// the integral of |grad(s)|^2 + ((s - log size) / r)^2 and is log size on the boundary, r being four times the size.
/// E7 of docs/algorithm.md. Returns h = exp(s) per vertex. Errors: cancelled, internal (factorisation failed).
Result<IdMap<VertexId, double>> spreadSizes(const Patch& patch, Progress& progress);

/// The patch's sizes as a mesh of squares that follows the crosses wants them: times exp(w), the w that minimises the
/// integral of |grad(w) + rotated(grad(angle))|^2 + (w / r)^2 and is 0 on the boundary, bent to stay within 0.3 either
/// way; r is eight times the size. A patch without a boundary has sizes of its own as well. E7 of docs/algorithm.md.
/// field: an empty one does not turn. Returns h per vertex. Errors: cancelled, internal (factorisation failed).
Result<IdMap<VertexId, double>> turnedSizes(const Patch& patch, const CrossField& field, Progress& progress);

/// An edge of a mesh and the size wanted there.
struct SizedEdge {
  std::array<std::int32_t, 2> ends{};
  double size = 0.0;  ///< The mean of its ends'.
  double log = 0.0;   ///< Of its length in units of that.
};

/// Each edge of a mesh of the patch once.
std::vector<SizedEdge> sizedEdges(const Patch& patch, const FaceMesh& mesh);

/// The patch's sizes as a mesh of it came out: times exp(s), the s that is 0 on the boundary and minimises
/// the sum of (s - log)^2 size^2 / 2 over the mesh's edges (sizedEdges(), log within 1 either way), taken at their
/// ends, and the integral of size^2 |grad(s)|^2, bent to stay within 0.3 either way. Of a patch without a boundary only
/// what varies counts: log less its mean. E7 of docs/algorithm.md. Returns h per vertex. Errors: cancelled, internal
/// (factorisation failed).
Result<IdMap<VertexId, double>> sizesOfMesh(const Patch& patch, const FaceMesh& mesh, Progress& progress);

/// How many rows of elements are to be expected to end inside the patches if these have the sizes h = patch.size *
/// exp(log): the integral of |grad(log h) + rotated(grad(angle))| / patch.size; not / h, or larger elements where most
/// rows end would count for fewer ends. Triangles around singularities and patches with an empty field are left out.
/// logs: per patch and vertex.
double expectedRowEnds(const std::vector<Patch>& patches, const std::vector<CrossField>& fields,
                       const std::vector<IdMap<VertexId, double>>& logs);

}  // namespace qmcf
