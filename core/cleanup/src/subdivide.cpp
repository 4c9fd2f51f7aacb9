#include "qmcf/cleanup/subdivide.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "relaxation.hpp"

namespace qmcf {
namespace {

/// An edge of an element between two vertices, smaller id first.
struct Side {
  std::array<std::int32_t, 2> ends{};
  std::size_t element = 0;
  std::size_t corner = 0;

  friend bool operator<(const Side& a, const Side& b) {
    return std::pair(a.ends, a.element) < std::pair(b.ends, b.element);
  }
};

std::vector<Side> sidesOf(const FaceMesh& mesh) {
  std::vector<Side> sides;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::size_t corners = cornerCount(mesh.elements[e]);
    for (std::size_t c = 0; c < corners; ++c) {
      const auto [a, b] = std::minmax(mesh.elements[e][c], mesh.elements[e][(c + 1) % corners]);
      sides.push_back({{a, b}, e, c});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

class Subdivision {
 public:
  Subdivision(const FaceMesh& coarse, const Patch& patch, const TriangleBvh& target,
              const IdMap<HalfedgeId, Vec3>& boundaryMiddle, NewVertices place)
      : coarse_(coarse), patch_(patch), target_{patch, target, 0.5}, boundaryMiddle_(boundaryMiddle), place_(place) {
    result_.mesh = coarse;
    result_.mesh.elements.clear();
    result_.boundaryEdge.resize(coarse.positions.size());
  }

  SubdividedFace run() {
    std::vector<std::array<std::int32_t, 4>> middles(coarse_.elements.size(), {kNone, kNone, kNone, kNone});
    const std::vector<Side> sides = sidesOf(coarse_);
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].ends == sides[i].ends) ++end;
      // Two vertices of a boundary can be joined by more than one edge; then each element's edge is its own.
      const bool shared = end - i == 2 && !boundaryEdgeOf(sides[i]).valid();
      std::int32_t middle = kNone;
      for (; i < end; ++i) {
        if (middle == kNone || !shared) middle = addMiddle(sides[i]);
        middles[sides[i].element][sides[i].corner] = middle;
      }
    }
    for (std::size_t e = 0; e < coarse_.elements.size(); ++e) addElements(coarse_.elements[e], middles[e]);
    return std::move(result_);
  }

 private:
  /// The patch's boundary half-edge under a side of an element, or an invalid one.
  [[nodiscard]] HalfedgeId boundaryEdgeOf(const Side& side) const {
    const Element& element = coarse_.elements[side.element];
    const std::int32_t a = coarse_.patchVertex[static_cast<std::size_t>(element[side.corner])];
    const std::int32_t b =
        coarse_.patchVertex[static_cast<std::size_t>(element[(side.corner + 1) % cornerCount(element)])];
    if (a == kNone || b == kNone) return HalfedgeId();
    const HalfedgeId h = patch_.surface.outgoing(VertexId(a));
    const bool runsAlong = patch_.surface.isBoundary(h) && patch_.surface.target(h) == VertexId(b);
    return runsAlong ? h : HalfedgeId();
  }

  std::int32_t add(const EditMesh::Vertex& vertex, HalfedgeId boundaryEdge) {
    FaceMesh& mesh = result_.mesh;
    mesh.positions.push_back(vertex.position);
    mesh.normals.push_back(vertex.normal);
    mesh.locations.push_back(vertex.location);
    mesh.patchVertex.push_back(kNone);
    result_.boundaryEdge.push_back(boundaryEdge);
    return static_cast<std::int32_t>(mesh.positions.size()) - 1;
  }

  [[nodiscard]] EditMesh::Vertex vertexOf(std::int32_t v) const {
    const auto i = static_cast<std::size_t>(v);
    EditMesh::Vertex vertex;
    vertex.position = coarse_.positions[i];
    vertex.normal = coarse_.normals[i];
    vertex.location = coarse_.locations[i];
    return vertex;
  }

  /// The mean of some vertices, or the point of the face below it.
  [[nodiscard]] EditMesh::Vertex meanOf(const std::vector<std::int32_t>& vertices) const {
    EditMesh::Vertex start = vertexOf(vertices.front());
    Vec3 position;
    Vec3 normal;
    for (const std::int32_t v : vertices) {
      position += vertexOf(v).position / static_cast<double>(vertices.size());
      normal += vertexOf(v).normal;
    }
    if (norm(normal) > 0.0) start.normal = normalized(normal);
    EditMesh::Vertex vertex = projectVertex(target_, start, position);
    if (place_ == NewVertices::between) vertex.position = position;
    return vertex;
  }

  std::int32_t addMiddle(const Side& side) {
    const HalfedgeId h = boundaryEdgeOf(side);
    EditMesh::Vertex vertex = meanOf({side.ends[0], side.ends[1]});
    if (h.valid()) {
      const auto corner = static_cast<std::size_t>(h.value % 3);
      vertex.position = boundaryMiddle_[h];
      vertex.location = {Surface::triangle(h), {0.0, 0.0, 0.0}};
      vertex.location.barycentric[corner] = 0.5;
      vertex.location.barycentric[(corner + 1) % 3] = 0.5;
    }
    return add(vertex, h);
  }

  void addElements(const Element& element, const std::array<std::int32_t, 4>& middles) {
    const std::size_t corners = cornerCount(element);
    const std::int32_t centre =
        add(meanOf({element.begin(), element.begin() + static_cast<std::ptrdiff_t>(corners)}), {});
    for (std::size_t c = 0; c < corners; ++c) {
      result_.mesh.elements.push_back({element[c], middles[c], centre, middles[(c + corners - 1) % corners]});
    }
  }

  const FaceMesh& coarse_;
  const Patch& patch_;
  RelaxationTarget target_;
  const IdMap<HalfedgeId, Vec3>& boundaryMiddle_;
  NewVertices place_;
  SubdividedFace result_;
};

}  // namespace

SubdividedFace subdivide(const FaceMesh& mesh, const Patch& patch, const TriangleBvh& target,
                         const IdMap<HalfedgeId, Vec3>& boundaryMiddle, NewVertices place) {
  return Subdivision(mesh, patch, target, boundaryMiddle, place).run();
}

}  // namespace qmcf
