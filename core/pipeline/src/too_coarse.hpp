#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/quality/quality.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// Half the present length at the middle of each of these elements of a face.
std::vector<SizeLimit> halvedAt(const FaceMesh& mesh, const std::vector<std::int32_t>& elements, std::int32_t face);

/// Half the present length at the elements for which a joined mesh is not valid: where these are too large for the
/// part, two walls meet in the same elements or an element lies against the surface.
std::vector<SizeLimit> halvedWhereInvalid(const QuadMesh& mesh, const QualityReport& quality);

/// Half the present length at every triangle.
std::vector<SizeLimit> halvedAtTriangles(const QuadMesh& mesh);

/// The limits that ask for at least `lowest`.
std::vector<SizeLimit> notBelow(const std::vector<SizeLimit>& limits, double lowest);

/// When the mesh fails to cover the part: the same for elements of faces of which much is missing whose area is far
/// from that of what is nearest to them.
std::vector<SizeLimit> halvedWhereMissing(const QuadMesh& mesh, const QualityReport& quality, const TriangleMesh& part,
                                          const Brep& brep);

/// Half the size at places of the part that the mesh misses (QualityReport::missed), as far apart as that reaches.
std::vector<SizeLimit> halvedWhereMissed(const std::vector<Vec3>& places, const TriangleMesh& mesh, const Brep& brep,
                                         const SizeField& size);

/// Faces with elements that a failing check lists or that are duplicates of these, and those of which much is missing,
/// ascending.
std::vector<std::int32_t> facesAtFault(const QuadMesh& mesh, const QualityReport& quality, const Brep& brep);

/// Defects of all failing checks together.
std::int64_t countFaults(const QualityReport& quality);

}  // namespace qmcf
