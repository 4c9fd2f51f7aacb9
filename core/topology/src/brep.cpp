#include "qmcf/topology/brep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bodies.hpp"
#include "face_surface.hpp"
#include "feature_edges.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/mesh/sharp_angle.hpp"
#include "ring_starts.hpp"
#include "triangle_edges.hpp"

namespace qmcf {

std::string_view edgeKindName(EdgeKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"nonManifold", "boundary", "sharp", "label"};
  return kNames[static_cast<std::size_t>(kind)];
}

namespace detail {
namespace {

/// A chain or a face that turns by more than this has a corner: 45 degrees, and a little for round-off.
constexpr double kCornerTurn = math::kPi / 4.0 + 1e-6;
/// Quads wanted at a corner; the thresholds favour simple corners, as gmsh's do.
std::int32_t quadsAtCorner(double angle) {
  const double quarters = 2.0 * angle / math::kPi;
  if (quarters <= 1.25) return 1;
  if (quarters <= 2.75) return 2;
  return quarters <= 3.5 ? 3 : 4;
}

/// Builds the B-rep from the marked edges of the mesh.
class BrepBuilder {
 public:
  BrepBuilder(const TriangleMesh& mesh, const TriangleEdges& edges, const FeatureEdges& features, const Bodies& bodies,
              const std::vector<std::uint8_t>& scattered)
      : bodies_(bodies),
        scattered_(scattered),
        mesh_(mesh),
        edges_(edges),
        features_(features),
        fans_(buildFans(edges, features.mark)),
        around_(edges, features.mark) {}

  Brep build() {
    measureFans();
    findCorners();
    floodFaces();
    traceEdges();
    numberVertices();
    traceLoops();
    listBodies();
    nameFaces();
    return std::move(brep_);
  }

 private:
  /// Role of a mesh vertex.
  enum class Role : std::uint8_t { none, vertex, artificial };

  [[nodiscard]] const Vec3& at(VertexId v) const { return mesh_.positions[v.index()]; }

  [[nodiscard]] double cornerAngle(HalfedgeId h) const {
    const Vec3 p = at(edges_.origin(h));
    const Vec3 u = at(edges_.target(h)) - p;
    const Vec3 v = at(edges_.origin(Surface::prev(h))) - p;
    return math::atan2(norm(cross(u, v)), dot(u, v));
  }

  /// Angle and last half-edge of each fan.
  void measureFans() {
    fanAngle_.assign(fans_.first.size(), 0.0);
    fanLast_.assign(fans_.first.size(), HalfedgeId());
    for (const HalfedgeId h : edges_.halfedges()) {
      const auto fan = static_cast<std::size_t>(fans_.ofCorner[h]);
      fanAngle_[fan] += cornerAngle(h);
      if (features_.mark[edges_.edge(Surface::prev(h))] != 0) fanLast_[fan] = Surface::prev(h);
    }
  }

  void findCorners() {
    role_.assign(mesh_.positions.size(), Role::none);
    for (std::size_t v = 0; v < role_.size(); ++v) {
      const auto around = around_.at(VertexId(v));
      if (around.empty()) continue;
      const bool passes = around.size() == 2 && continuesAt(VertexId(v), around[0], around[1]);
      if (!passes && !isZigzag(VertexId(v))) role_[v] = Role::vertex;
    }
    // Fans decide as well: a corner of a face, and a face that touches the vertex otherwise than along both edges.
    for (std::size_t fan = 0; fan < fans_.first.size(); ++fan) {
      const HalfedgeId first = fans_.first[fan];
      const std::size_t v = edges_.origin(first).index();
      if (around_.at(VertexId(v)).empty()) continue;
      const bool passes = fans_.open[fan] && edges_.edge(first) != edges_.edge(fanLast_[fan]);
      const bool straight = std::fabs(fanAngle_[fan] - math::kPi) <= kCornerTurn || isZigzag(VertexId(v));
      if (!passes || !straight) role_[v] = Role::vertex;
    }
  }

  /// Two cutting edges at v are parts of one edge of the B-rep, as far as they alone can tell.
  [[nodiscard]] bool continuesAt(VertexId v, EdgeId a, EdgeId b) const {
    const auto kindOf = [&](EdgeId e) {
      // A crease may fade along a label's border.
      return features_.is(e, EdgeKind::label) ? EdgeKind::sharp : features_.kind(e);
    };
    return kindOf(a) == kindOf(b) && turning(edges_.otherEnd(a, v), v, edges_.otherEnd(b, v)) <= kCornerTurn;
  }

  [[nodiscard]] double turning(VertexId from, VertexId v, VertexId to) const {
    const Vec3 in = at(v) - at(from);
    const Vec3 out = at(to) - at(v);
    return math::atan2(norm(cross(in, out)), dot(in, out));
  }

  /// The borders of a scan zigzag from triangle to triangle. There, a vertex where two edges of a kind meet is no
  /// corner when the line through every second vertex goes straight on.
  [[nodiscard]] bool isZigzag(VertexId v) const {
    const auto around = around_.at(v);
    if (around.size() != 2 || features_.kind(around[0]) != features_.kind(around[1])) return false;
    if (scattered_[bodies_.of(edges_, around[0])] == 0) return false;
    std::array<VertexId, 2> second;
    for (std::size_t i = 0; i < 2; ++i) {
      const VertexId first = edges_.otherEnd(around[i], v);
      const auto further = around_.at(first);
      if (further.size() != 2) return false;
      second[i] = edges_.otherEnd(further[0] == around[i] ? further[1] : further[0], first);
    }
    return turning(second[0], v, second[1]) <= kCornerTurn;
  }

  void traceEdges() {
    edgeOf_.resize(edges_.edgeCount(), kNone);
    forward_.resize(edges_.edgeCount(), 0);
    for (std::size_t v = 0; v < role_.size(); ++v) {
      if (role_[v] == Role::none) continue;
      for (const EdgeId e : around_.at(VertexId(v))) traceEdge(VertexId(v), e);
    }
    // What is left are closed chains without a corner.
    for (const VertexId start : placeRingStarts(mesh_, findRings(), facesWithVertices())) {
      role_[start.index()] = Role::artificial;
      traceEdge(start, around_.at(start)[0]);
    }
  }

  /// The closed chains of cutting edges that no vertex of the B-rep is on.
  [[nodiscard]] std::vector<Ring> findRings() const {
    std::vector<Ring> rings;
    IdMap<EdgeId, std::uint8_t> seen;
    seen.resize(edges_.edgeCount(), 0);
    for (std::size_t first = 0; first < role_.size(); ++first) {
      for (EdgeId e : around_.at(VertexId(first))) {
        if (edgeOf_[e] != kNone || seen[e] != 0) continue;
        Ring& ring = rings.emplace_back();
        for (const HalfedgeId h : edges_.uses(e)) {
          ring.faces.push_back(brep_.triangleFace[Surface::triangle(h).index()]);
        }
        for (VertexId v(first); seen[e] == 0;) {
          seen[e] = 1;
          ring.points.push_back(v);
          v = edges_.otherEnd(e, v);
          const auto around = around_.at(v);
          e = around[0] == e ? around[1] : around[0];
        }
      }
    }
    return rings;
  }

  /// Per face, 1 where a vertex of the B-rep is on its boundary.
  [[nodiscard]] std::vector<std::uint8_t> facesWithVertices() const {
    std::vector<std::uint8_t> has(brep_.faces.size(), 0);
    for (const HalfedgeId h : edges_.halfedges()) {
      if (features_.mark[edges_.edge(h)] == 0 || role_[edges_.origin(h).index()] == Role::none) continue;
      has[static_cast<std::size_t>(brep_.triangleFace[Surface::triangle(h).index()])] = 1;
    }
    return has;
  }

  void traceEdge(VertexId v, EdgeId e) {
    if (edgeOf_[e] != kNone) return;
    const auto id = static_cast<std::int32_t>(brep_.edges.size());
    BrepEdge edge;
    edge.kind = features_.kind(e);
    edge.points.push_back(v.value);
    while (edgeOf_[e] == kNone) {
      edgeOf_[e] = id;
      forward_[e] = edges_.ends(e)[0] == v ? 1 : 0;
      edge.kind = std::min(edge.kind, features_.kind(e));
      const VertexId next = edges_.otherEnd(e, v);
      edge.length += distance(at(v), at(next));
      edge.points.push_back(next.value);
      v = next;
      if (role_[v.index()] != Role::none) break;
      if (features_.junction[v.index()] != 0) edge.stops.push_back(static_cast<std::int32_t>(edge.points.size()) - 1);
      const auto around = around_.at(v);
      e = around[0] == e ? around[1] : around[0];
    }
    brep_.edges.push_back(std::move(edge));
  }

  void numberVertices() {
    std::vector<std::int32_t> number(role_.size(), kNone);
    for (std::size_t v = 0; v < role_.size(); ++v) {
      if (role_[v] == Role::none) continue;
      number[v] = static_cast<std::int32_t>(brep_.vertices.size());
      brep_.vertices.push_back({static_cast<std::int32_t>(v), role_[v] == Role::artificial});
    }
    for (BrepEdge& edge : brep_.edges) {
      edge.start = number[static_cast<std::size_t>(edge.points.front())];
      edge.end = number[static_cast<std::size_t>(edge.points.back())];
    }
  }

  void floodFaces() {
    brep_.triangleFace.assign(mesh_.triangles.size(), kNone);
    for (const TriangleId root : edges_.triangles()) {
      if (brep_.triangleFace[root.index()] != kNone) continue;
      BrepFace face;
      flood(edges_, root, &features_.mark, brep_.triangleFace, static_cast<std::int32_t>(brep_.faces.size()),
            [&](TriangleId t) { face.triangles.push_back(t.value); });
      std::sort(face.triangles.begin(), face.triangles.end());
      for (const std::int32_t t : face.triangles) {
        const auto& c = mesh_.triangles[static_cast<std::size_t>(t)];
        const Vec3 p = at(VertexId(c[0]));
        face.area += 0.5 * norm(cross(at(VertexId(c[1])) - p, at(VertexId(c[2])) - p));
      }
      brep_.faces.push_back(std::move(face));
    }
  }

  /// Loops start at their smallest half-edge that leaves a B-rep vertex, and come in that order: cutFace() relies
  /// on it.
  void traceLoops() {
    std::vector<std::uint8_t> visited(edges_.halfedgeCount(), 0);
    for (const HalfedgeId first : edges_.halfedges()) {
      if (visited[first.index()] != 0 || features_.mark[edges_.edge(first)] == 0) continue;
      if (role_[edges_.origin(first).index()] == Role::none) continue;
      BrepLoop loop;
      HalfedgeId h = first;
      do {
        visited[h.index()] = 1;
        const VertexId v = edges_.origin(h);
        if (role_[v.index()] != Role::none) {
          const EdgeId e = edges_.edge(h);
          const bool along = (edges_.ends(e)[0] == v) == (forward_[e] != 0);
          const double angle = fanAngle_[static_cast<std::size_t>(fans_.ofCorner[h])];
          const std::int32_t quads = role_[v.index()] == Role::artificial ? 2 : quadsAtCorner(angle);
          loop.coedges.push_back({edgeOf_[e], !along, angle, quads});
        }
        h = nextCut(fans_, h);
      } while (h != first);
      const std::int32_t face = brep_.triangleFace[Surface::triangle(first).index()];
      brep_.faces[static_cast<std::size_t>(face)].loops.push_back(std::move(loop));
    }
  }

  void listBodies() {
    for (const std::uint8_t closed : bodies_.closed) brep_.bodies.push_back({{}, closed != 0});
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      BrepFace& face = brep_.faces[f];
      face.body = bodies_.ofTriangle[static_cast<std::size_t>(face.triangles.front())];
      brep_.bodies[static_cast<std::size_t>(face.body)].faces.push_back(static_cast<std::int32_t>(f));
    }
  }

  void nameFaces() {
    const bool labelled = mesh_.labels.size() == mesh_.triangles.size();
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      BrepFace& face = brep_.faces[f];
      face.name = "face " + std::to_string(f);
      if (!labelled) continue;
      const std::int32_t label = mesh_.labels[static_cast<std::size_t>(face.triangles.front())];
      const bool uniform = std::all_of(face.triangles.begin(), face.triangles.end(), [&](std::int32_t t) {
        return mesh_.labels[static_cast<std::size_t>(t)] == label;
      });
      const bool named = label >= 0 && static_cast<std::size_t>(label) < mesh_.labelNames.size() &&
                         !mesh_.labelNames[static_cast<std::size_t>(label)].empty();
      if (uniform && named) face.name = mesh_.labelNames[static_cast<std::size_t>(label)];
    }
    numberEqualNames();
  }

  /// Faces with the same label get numbers, in their order.
  void numberEqualNames() {
    std::vector<std::size_t> order(brep_.faces.size());
    for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const int compared = brep_.faces[a].name.compare(brep_.faces[b].name);
      return compared != 0 ? compared < 0 : a < b;
    });
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
      const std::string name = brep_.faces[order[i]].name;
      for (end = i + 1; end < order.size() && brep_.faces[order[end]].name == name;) ++end;
      if (end - i == 1) continue;
      for (std::size_t k = i; k < end; ++k) brep_.faces[order[k]].name = name + " " + std::to_string(k - i);
    }
  }

  const Bodies& bodies_;
  const std::vector<std::uint8_t>& scattered_;
  const TriangleMesh& mesh_;
  const TriangleEdges& edges_;
  const FeatureEdges& features_;
  Fans fans_;
  VertexEdges around_;
  std::vector<double> fanAngle_;
  std::vector<HalfedgeId> fanLast_;
  std::vector<Role> role_;
  IdMap<EdgeId, std::int32_t> edgeOf_;
  IdMap<EdgeId, std::uint8_t>
      forward_;  ///< The B-rep edge runs from the smaller vertex of the mesh edge to the larger.
  Brep brep_;
};

}  // namespace
}  // namespace detail

Result<Brep> recoverBrep(const TriangleMesh& mesh, const BrepOptions& options, Progress& progress) {
  if (mesh.triangles.empty()) return Error{ErrorCode::noSurface, "The model has no triangles.", {}};
  if (!progress.report(Stage::topology, 0.0)) return cancelledError();
  const detail::TriangleEdges edges(mesh.triangles, mesh.positions.size());
  if (!progress.report(Stage::topology, 0.3)) return cancelledError();
  const double featureAngle = leastSharpAngle(options.featureAngle);
  detail::FeatureEdges features = detail::markFeatureEdges(mesh, edges, featureAngle);
  if (!progress.report(Stage::topology, 0.5)) return cancelledError();
  const detail::Bodies bodies = detail::findBodies(mesh, edges);
  const auto scattered = detail::cleanFeatureChains(mesh, edges, bodies, featureAngle, options.flatEdges, features);
  if (!progress.report(Stage::topology, 0.7)) return cancelledError();
  Brep brep = detail::BrepBuilder(mesh, edges, features, bodies, scattered).build();
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const double done = static_cast<double>(f) / static_cast<double>(brep.faces.size());
    if (!progress.report(Stage::topology, 0.8 + 0.2 * done)) return cancelledError();
    auto cut = detail::cutFace(mesh, brep, static_cast<std::int32_t>(f));
    if (!cut) return cut.error();
    brep.cuts.push_back(std::move(cut).value());
  }
  return brep;
}

}  // namespace qmcf
