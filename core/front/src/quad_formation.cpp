// Steps 4c of section 4.1 (Owen et al. 1999) and the closing of small loops.
#include "qmcf/front/quad_formation.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/loop_fillings.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kMaxRegion = 400;

double scaledCorner(const Vec3& before, const Vec3& at, const Vec3& after, const Vec3& normal) {
  const Vec3 forward = after - at;
  const Vec3 backward = before - at;
  const double lengths = norm(forward) * norm(backward);
  return lengths > 0.0 ? dot(cross(forward, backward), normal) / lengths : -1.0;
}

/// Whether triangles with that many boundary edges together have the Euler characteristic of a disc: a small loop may
/// enclose a handle.
bool isDisc(const EditMesh& mesh, const std::vector<FaceId>& region, std::size_t boundary) {
  std::vector<VertexId> vertices;
  std::size_t sides = 0;
  for (const FaceId f : region) {
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid()) continue;
      ++sides;
      vertices.push_back(mesh.origin(h));
    }
  }
  std::sort(vertices.begin(), vertices.end());
  const auto last = std::unique(vertices.begin(), vertices.end());
  const auto count = static_cast<std::size_t>(last - vertices.begin());
  return count + region.size() == (sides + boundary) / 2 + 1;
}

}  // namespace

std::optional<std::vector<FaceId>> enclosedRegion(const FrontMesh& front, const std::vector<HalfedgeId>& boundary) {
  const EditMesh& mesh = front.mesh();
  std::vector<FaceId> region{mesh.face(boundary.front())};
  std::size_t sidesSeen = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (region.size() > kMaxRegion) return std::nullopt;
    const HalfedgeId first = mesh.halfedge(region[i]);
    HalfedgeId h = first;
    do {
      if (std::find(boundary.begin(), boundary.end(), h) != boundary.end()) {
        ++sidesSeen;
      } else {
        if (front.isFront(h)) return std::nullopt;
        const FaceId other = mesh.face(mesh.twin(h));
        if (std::find(region.begin(), region.end(), other) == region.end()) region.push_back(other);
      }
      h = mesh.next(h);
    } while (h != first);
  }
  if (sidesSeen != boundary.size() || !isDisc(mesh, region, boundary.size())) return std::nullopt;
  return region;
}

std::optional<FaceId> formElement(FrontMesh& front, const std::vector<VertexId>& corners, double least) {
  EditMesh& mesh = front.mesh();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (corners[i] == corners[j]) return std::nullopt;
    }
  }
  const double quality = corners.size() == 4 ? quadShape(mesh, {corners[0], corners[1], corners[2], corners[3]})
                                             : triangleShape(mesh, corners[0], corners[1], corners[2]);
  if (!(quality >= least)) return std::nullopt;
  std::vector<HalfedgeId> boundary;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const HalfedgeId h = mesh.find(corners[i], corners[(i + 1) % corners.size()]);
    if (!h.valid() || !mesh.isOpen(h)) return std::nullopt;
    boundary.push_back(h);
  }
  const auto region = enclosedRegion(front, boundary);
  if (!region) return std::nullopt;
  return mesh.fill(boundary, *region, FaceKind::element);
}

std::vector<FaceId> closeLoop(FrontMesh& front, HalfedgeId h, int length, double least) {
  EditMesh& mesh = front.mesh();
  if (loopFillings(length).empty()) return {};
  std::vector<HalfedgeId> loop;
  std::vector<VertexId> vertices;
  std::vector<int> elements;
  Vec3 centre;
  Vec3 normal;
  for (HalfedgeId e = h; static_cast<int>(loop.size()) < length; e = front.nextFront(e)) {
    const VertexId v = mesh.origin(e);
    if (std::find(vertices.begin(), vertices.end(), v) != vertices.end()) return {};
    loop.push_back(e);
    vertices.push_back(v);
    const int wanted = mesh.isBoundary(v) ? front.patch().cornerQuads[v] : 4;
    elements.push_back(front.surroundings(v).elements - wanted);
    centre += mesh.position(v) / length;
    normal += mesh.normal(v);
  }
  const auto region = enclosedRegion(front, loop);
  if (!region) return {};
  const EditMesh::Vertex middle = front.vertexNear(mesh.vertex(vertices[0]).location, centre);

  const auto positionOfIndex = [&](int i) {
    return i == length ? middle.position : mesh.position(vertices[static_cast<std::size_t>(i)]);
  };
  const auto normalOfIndex = [&](int i) {
    return i == length ? middle.normal : mesh.normal(vertices[static_cast<std::size_t>(i)]);
  };
  const LoopFilling* best = nullptr;
  double bestCost = 0.0;
  for (const LoopFilling& way : loopFillings(length)) {
    double worst = 1.0;
    std::vector<int> excess = elements;
    excess.push_back(way.hasMiddle ? -4 : 0);
    for (const auto& quad : way.cells) {
      for (std::size_t i = 0; i < 4; ++i) {
        ++excess[static_cast<std::size_t>(quad[i])];
        worst = std::min(worst, scaledCorner(positionOfIndex(quad[(i + 3) % 4]), positionOfIndex(quad[i]),
                                             positionOfIndex(quad[(i + 1) % 4]), normalOfIndex(quad[i])));
      }
    }
    double cost = 1.0 - worst;
    for (const int e : excess) cost += 0.5 * e * e;
    if (worst >= least && (best == nullptr || cost < bestCost)) {
      best = &way;
      bestCost = cost;
    }
  }
  if (best == nullptr) return {};
  return mesh.fill(loop, *region, best->cells, best->hasMiddle ? std::vector{middle} : std::vector<EditMesh::Vertex>{});
}

}  // namespace qmcf
