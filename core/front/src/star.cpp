// Patterns at singularities: section 4.2.1 of the paper; D5 of docs/algorithm.md.
#include "star.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/base/math.hpp"
#include "qmcf/front/quad_formation.hpp"
#include "qmcf/front/recovery.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

/// Room that a star needs around its centre, in element sizes.
constexpr double kRoom = 2.2;

/// The open face that contains a point, found by walking from a face near it; invalid outside the open region.
FaceId locateOpenFace(const FrontMesh& front, FaceId start, const EditMesh::Vertex& vertex) {
  const EditMesh& mesh = front.mesh();
  constexpr int kMaxSteps = 300;
  FaceId f = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const HalfedgeId first = mesh.halfedge(f);
    HalfedgeId worst;
    double worstArea = 0.0;
    HalfedgeId h = first;
    do {
      const double area =
          orient(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)), vertex.position, vertex.normal);
      if (area < worstArea) {
        worstArea = area;
        worst = h;
      }
      h = mesh.next(h);
    } while (h != first);
    if (!worst.valid()) return f;
    if (front.isFront(worst)) return {};
    f = mesh.face(mesh.twin(worst));
  }
  return {};
}

/// An open face near a surface point: one that still touches a corner of the point's background triangle.
FaceId openFaceNear(const FrontMesh& front, const SurfacePoint& point) {
  const EditMesh& mesh = front.mesh();
  for (const VertexId v : front.patch().surface.corners(point.triangle)) {
    if (!mesh.alive(v)) continue;
    FaceId found;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      if (!found.valid() && mesh.isOpen(h)) found = mesh.face(h);
    });
    if (found.valid()) return found;
  }
  return {};
}

bool hasRoom(const FrontMesh& front, FaceId start, const Vec3& centre, double radius) {
  const EditMesh& mesh = front.mesh();
  constexpr std::size_t kMaxFaces = 400;
  std::vector<FaceId> faces{start};
  for (std::size_t i = 0; i < faces.size() && faces.size() < kMaxFaces; ++i) {
    const HalfedgeId first = mesh.halfedge(faces[i]);
    HalfedgeId h = first;
    do {
      const Vec3 p = mesh.position(mesh.origin(h));
      const Vec3 q = mesh.position(mesh.target(h));
      const double along = std::clamp(dot(centre - p, q - p) / std::max(squaredNorm(q - p), 1e-300), 0.0, 1.0);
      if (distance(p + (q - p) * along, centre) < radius) {
        if (front.isFront(h)) return false;
        const FaceId other = mesh.face(mesh.twin(h));
        if (std::find(faces.begin(), faces.end(), other) == faces.end()) faces.push_back(other);
      }
      h = mesh.next(h);
    } while (h != first);
  }
  return true;
}

/// The front edge that starts the sector of v, or, while nothing around v is meshed, any half-edge leaving it.
HalfedgeId openSpoke(const FrontMesh& front, VertexId v) {
  HalfedgeId found;
  front.mesh().forEachOutgoing(v, [&](HalfedgeId h) {
    if (front.isFront(h) || (!found.valid() && front.mesh().isOpen(h))) found = h;
  });
  return found;
}

/// Straight edge between two vertices of the open region. Returns whether it is there.
bool join(FrontMesh& front, VertexId a, VertexId b) {
  if (front.mesh().connected(a, b)) return true;
  return recoverEdge(front, openSpoke(front, a), b).valid();
}

/// Inserts the vertices, joins them as the cells ask, and makes the cells elements; all or nothing.
bool placeCells(FrontMesh& front, FaceId start, const std::vector<EditMesh::Vertex>& vertices,
                const std::vector<std::array<int, 4>>& cells) {
  EditMesh& mesh = front.mesh();
  const std::size_t mark = mesh.mark();
  std::vector<VertexId> ids;
  FaceId near = start;
  for (const EditMesh::Vertex& vertex : vertices) {
    const FaceId face = locateOpenFace(front, near, vertex);
    constexpr double kReuse = 0.3;
    const double reuse = kReuse * front.sizeAt(vertex.location);
    VertexId id = face.valid() ? insertInFace(front, face, vertex, reuse) : VertexId();
    if (id.valid() && std::find(ids.begin(), ids.end(), id) != ids.end()) id = {};
    if (!id.valid()) {
      mesh.rollback(mark);
      return false;
    }
    ids.push_back(id);
    near = mesh.face(mesh.outgoing(id));
  }
  bool formed = true;
  constexpr double kLeastQuality = 0.3;
  for (const auto& cell : cells) {
    std::vector<VertexId> corners;
    for (const int i : cell) corners.push_back(ids[static_cast<std::size_t>(i)]);
    // On a folded triangulation a cell can enclose a vertex of the next one, and took it away.
    formed = formed && std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return mesh.alive(v); });
    for (std::size_t i = 0; formed && i < 4; ++i) formed = join(front, corners[i], corners[(i + 1) % 4]);
    formed = formed && formElement(front, corners, kLeastQuality).has_value();
  }
  if (!formed) mesh.rollback(mark);
  return formed;
}

/// Direction of a separatrix at the centre: where the field is radial. The field on a small circle turns by index / 4
/// of the turn of the radius, so one solution gives all of them.
double firstSeparatrix(const FrontMesh& front, const EditMesh::Vertex& centre, const LocalPlane& plane, double radius,
                       int index) {
  constexpr int kSamples = 16;
  std::complex<double> sum{0.0, 0.0};
  for (int i = 0; i < kSamples; ++i) {
    const double angle = 2.0 * math::kPi * i / kSamples;
    const Vec3 radial = plane.vector(Vec2{math::cos(angle), math::sin(angle)});
    const EditMesh::Vertex at = front.vertexNear(centre.location, centre.position + radial * radius);
    const Vec2 c = plane.vector(front.crossNear(at.location, radial));
    const double cross4 = 4.0 * math::atan2(c.y, c.x) - index * angle;
    sum += math::unitComplex(cross4);
  }
  return math::arg(sum) / (4.0 - index);
}

}  // namespace

bool placeStar(FrontMesh& front, const Singularity& singularity) {
  const int spokes = 4 - singularity.index;
  if (spokes < 3 || spokes > 6) return false;
  const EditMesh::Vertex centre =
      front.vertexNear(singularity.point, positionOf(front.patch().surface, singularity.point));
  const double h = front.sizeAt(centre.location);
  const FaceId near = openFaceNear(front, centre.location);
  if (!near.valid()) return false;
  const FaceId start = locateOpenFace(front, near, centre);
  if (!start.valid() || !hasRoom(front, start, centre.position, kRoom * h)) return false;

  const LocalPlane plane(centre.position, centre.normal);
  const double first = firstSeparatrix(front, centre, plane, h, singularity.index);
  const double step = 2.0 * math::kPi / spokes;
  // Corners between the spokes: a parallelogram would have them at 2 cos(step / 2); a little rounder serves the front.
  const double cornerDistance = spokes == 3 ? 1.25 : 2.0 * math::cos(0.5 * step);
  std::vector<EditMesh::Vertex> vertices{centre};
  for (int i = 0; i < 2 * spokes; ++i) {
    const double angle = first + 0.5 * step * i;
    const double length = i % 2 == 0 ? h : h * cornerDistance;
    const Vec3 radial = plane.vector(Vec2{math::cos(angle), math::sin(angle)});
    vertices.push_back(front.vertexNear(centre.location, centre.position + radial * length));
  }
  std::vector<std::array<int, 4>> cells;
  for (int i = 0; i < spokes; ++i) cells.push_back({0, 2 * i + 1, 2 * i + 2, (2 * i + 2) % (2 * spokes) + 1});
  return placeCells(front, start, vertices, cells);
}

bool placeSeed(FrontMesh& front, double place) {
  const EditMesh& mesh = front.mesh();
  // Any place will do; the next one is tried only where the quad can't be cut out of the triangulation.
  const std::size_t count = front.patch().surface.triangleCount();
  const auto first = static_cast<std::size_t>(place * static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleId t((first + i) % count);
    const EditMesh::Vertex centre = front.vertexNear(
        {t, {1.0 / 3, 1.0 / 3, 1.0 / 3}}, positionOf(front.patch().surface, {t, {1.0 / 3, 1.0 / 3, 1.0 / 3}}));
    const double h = front.sizeAt(centre.location);
    const Vec3 x = normalized(
        tangentPart(crossDirections(front.patch().surface, front.field(), centre.location)[0], centre.normal));
    const Vec3 y = cross(centre.normal, x);
    std::vector<EditMesh::Vertex> vertices;
    for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      vertices.push_back(front.vertexNear(centre.location, centre.position + (x * u + y * v) * h));
    }
    const FaceId start(t.value);
    if (mesh.kind(start) == FaceKind::open && placeCells(front, start, vertices, {{0, 1, 2, 3}})) return true;
  }
  return false;
}

}  // namespace qmcf
