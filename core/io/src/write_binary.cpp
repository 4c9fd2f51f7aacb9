#include <string>

#include "mesh_writers.hpp"
#include "qmcf/base/bits.hpp"
#include "text_writer.hpp"

namespace qmcf {
namespace {

template <class Bits>
void appendLittleEndian(std::string& out, Bits bits) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) out += static_cast<char>(bits >> (8U * i) & 0xFFU);
}

void appendInt(std::string& out, std::int32_t value) { appendLittleEndian(out, static_cast<std::uint32_t>(value)); }
void appendDouble(std::string& out, double value) { appendLittleEndian(out, bitCast<std::uint64_t>(value)); }
void appendFloat(std::string& out, double value) {
  appendLittleEndian(out, bitCast<std::uint32_t>(static_cast<float>(value)));
}

std::string plyHeader(const QuadMesh& mesh, const GroupNames& names, std::size_t segments) {
  TextWriter header;
  header << "ply\nformat binary_little_endian 1.0\ncomment Quad-dominant mesh by QMCF\n";
  for (std::size_t f = 0; f < names.faces.size(); ++f)
    header << "comment face_name " << f << ' ' << names.faces[f] << '\n';
  for (std::size_t e = 0; e < names.edges.size(); ++e)
    header << "comment edge_name " << e << ' ' << names.edges[e] << '\n';
  header << "element vertex " << mesh.positions.size() << "\nproperty double x\nproperty double y\nproperty double z\n"
         << "element face " << mesh.elements.size() << "\nproperty list uchar int vertex_indices\nproperty int face\n"
         << "element edge " << segments << "\nproperty int vertex1\nproperty int vertex2\nproperty int edge\n"
         << "end_header\n";
  return header.take();
}

void appendFacet(std::string& out, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = normalized(cross(b - a, c - a));
  for (const Vec3& v : {normal, a, b, c}) {
    appendFloat(out, v.x);
    appendFloat(out, v.y);
    appendFloat(out, v.z);
  }
  out.append(2, '\0');
}

}  // namespace

std::string writePly(const QuadMesh& mesh, const WriteOptions& options) {
  const auto edges = segmentsByEdge(mesh);
  std::size_t segments = 0;
  for (const auto& edge : edges) segments += edge.size();
  std::string out = plyHeader(mesh, groupNames(mesh, options, NameRule::quotedText), segments);
  out.reserve(out.size() + mesh.positions.size() * 24 + mesh.elements.size() * 21 + segments * 12);
  for (const Vec3& point : mesh.positions) {
    appendDouble(out, point.x);
    appendDouble(out, point.y);
    appendDouble(out, point.z);
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::size_t corners = cornerCount(mesh.elements[e]);
    out += static_cast<char>(corners);
    for (std::size_t c = 0; c < corners; ++c) appendInt(out, mesh.elements[e][c]);
    appendInt(out, faceOf(mesh, e));
  }
  for (const auto& edge : edges) {
    for (const FeatureSegment& segment : edge) {
      appendInt(out, segment.a);
      appendInt(out, segment.b);
      appendInt(out, segment.edge);
    }
  }
  return out;
}

std::string writeStl(const QuadMesh& mesh) {
  std::size_t triangles = 0;
  for (const Element& element : mesh.elements) triangles += cornerCount(element) - 2;
  std::string out = "Quad-dominant mesh by QMCF, cut into triangles";
  out.reserve(84 + 50 * triangles);
  out.resize(80, ' ');
  appendLittleEndian(out, static_cast<std::uint32_t>(triangles));
  for (const Element& element : mesh.elements) {
    const auto point = [&](std::size_t c) { return mesh.positions[static_cast<std::size_t>(element[c])]; };
    if (cornerCount(element) == 3) {
      appendFacet(out, point(0), point(1), point(2));
    } else if (squaredNorm(point(3) - point(1)) < 0.999 * squaredNorm(point(2) - point(0))) {
      appendFacet(out, point(1), point(2), point(3));
      appendFacet(out, point(1), point(3), point(0));
    } else {
      appendFacet(out, point(0), point(1), point(2));
      appendFacet(out, point(0), point(2), point(3));
    }
  }
  return out;
}

}  // namespace qmcf
