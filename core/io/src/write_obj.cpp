#include <string>

#include "mesh_writers.hpp"
#include "text_writer.hpp"

namespace qmcf {

std::string writeObj(const QuadMesh& mesh, const WriteOptions& options) {
  const GroupNames names = groupNames(mesh, options, NameRule::word);
  TextWriter out;
  out.reserve(mesh.positions.size() * 60 + mesh.elements.size() * 30);
  out << "# Quad-dominant mesh by QMCF\n";
  for (const Vec3& point : mesh.positions) out << "v " << point << '\n';

  std::int32_t group = kNone;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::int32_t face = faceOf(mesh, e);
    if (face != group) out << "g " << names.faces[static_cast<std::size_t>(face)] << '\n';
    group = face;
    out << 'f';
    for (std::size_t c = 0; c < cornerCount(mesh.elements[e]); ++c) out << ' ' << mesh.elements[e][c] + 1;
    out << '\n';
  }

  const auto edges = segmentsByEdge(mesh);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    if (edges[edge].empty()) continue;
    out << "g " << names.edges[edge] << '\n';
    for (const FeatureSegment& segment : edges[edge]) out << "l " << segment.a + 1 << ' ' << segment.b + 1 << '\n';
  }
  return out.take();
}

}  // namespace qmcf
