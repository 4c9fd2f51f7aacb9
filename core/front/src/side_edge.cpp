// Side edges of QMCF: section 4.2 (2) and (3) of the paper; D2, D5 and D6 of docs/algorithm.md.
#include "side_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "qmcf/base/math.hpp"
#include "qmcf/front/recovery.hpp"

namespace qmcf {
namespace {

/// Rows ahead, in element sizes, in which an opposite front is looked for.
constexpr double kReach = 2.6;
/// A new point this near to a front node, in element sizes, is only a last resort.
constexpr double kCrowded = 0.45;
constexpr double kLastResortCost = 5.0;

double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The direction that divides the sector evenly.
Vec3 bisectorDirection(const FrontMesh& front, const SideRequest& request) {
  const EditMesh& mesh = front.mesh();
  const VertexId a = mesh.origin(request.sector);
  const LocalPlane plane(mesh.position(a), mesh.normal(a));
  const Vec2 first = plane.point(mesh.position(mesh.target(request.sector)));
  const Vec2 last = plane.point(mesh.position(mesh.origin(front.previousFront(request.sector))));
  double angle = math::atan2(cross(first, last), dot(first, last));
  const double unfolded = front.sectorAngle(request.sector);
  // A sector of nearly a full turn may come out as a small positive or negative angle in the plane.
  if (angle < 0.0 || (angle < 0.5 && unfolded > math::kPi)) angle += 2.0 * math::kPi;
  const int step = request.left ? 1 : request.quads - 1;
  const double turn = angle * step / request.quads;
  const double c = math::cos(turn);
  const double s = math::sin(turn);
  return normalized(plane.vector(Vec2{c * first.x - s * first.y, s * first.x + c * first.y}));
}

/// A side is no longer and no shorter than the front edges that it starts from by more than these factors: a row that
/// the size field wants much higher than its edges are long is made of elements that nothing can make square later.
constexpr double kLongestSide = 1.4;
constexpr double kShortestSide = 0.8;

/// Mean length of the two front edges at a sector.
double frontLength(const FrontMesh& front, HalfedgeId sector) {
  const EditMesh& mesh = front.mesh();
  const Vec3& at = mesh.position(mesh.origin(sector));
  const Vec3& before = mesh.position(mesh.origin(front.previousFront(sector)));
  return 0.5 * (distance(at, mesh.position(mesh.target(sector))) + distance(at, before));
}

/// How a side edge runs: direction at its start and a point of the given length along it.
struct Trace {
  Vec3 direction;
  double length = 0.0;
  EditMesh::Vertex end;
};

/// Weighted combination of field and bisector, followed for one element by a midpoint step.
Trace traceSide(const FrontMesh& front, HalfedgeId sector, const Vec3& ideal, double fieldWeight) {
  const EditMesh::Vertex& start = front.mesh().vertex(front.mesh().origin(sector));
  const double base = frontLength(front, sector);
  const auto sizeAt = [&](const SurfacePoint& at) {
    return std::clamp(front.sizeAt(at), kShortestSide * base, kLongestSide * base);
  };
  const double h = sizeAt(start.location);
  const auto towards = [&](const SurfacePoint& at, const Vec3& normal, const Vec3& direction, double weight) {
    const Vec3 c = normalized(tangentPart(front.crossNear(at, direction), normal));
    return normalized(tangentPart(c * weight + direction * (1.0 - weight), normal));
  };
  const Vec3 c = normalized(tangentPart(front.crossNear(start.location, ideal), start.normal));
  const double agreement = smoothStep(0.72, 0.94, dot(c, ideal));
  const EditMesh::Vertex ahead = front.vertexNear(start.location, start.position + ideal * (0.7 * h));
  const double confidence = smoothStep(0.2, 0.8, crossConfidence(front.field(), ahead.location));
  const double weight = fieldWeight * agreement * confidence;

  Trace trace;
  const Vec3 d1 = towards(start.location, start.normal, ideal, weight);
  const EditMesh::Vertex middle = front.vertexNear(start.location, start.position + d1 * (0.5 * h));
  trace.direction = towards(middle.location, start.normal, d1, weight);
  trace.end = front.vertexNear(middle.location, start.position + trace.direction * h);
  trace.length = 0.5 * (h + sizeAt(trace.end.location));
  return trace;
}

constexpr std::size_t kMaxFaces = 60;

/// Up to kMaxFaces faces, each once, in the order in which they were added.
class FewFaces {
 public:
  FewFaces() { slots_.fill(kNone); }
  void add(FaceId f) {
    // Open addressing; three quarters of the slots stay free.
    std::size_t slot = f.index() % slots_.size();
    while (slots_[slot] != kNone) {
      if (slots_[slot] == f.value) return;
      slot = (slot + 1) % slots_.size();
    }
    slots_[slot] = f.value;
    faces_[size_++] = f;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] FaceId operator[](std::size_t i) const { return faces_[i]; }

 private:
  std::array<std::int32_t, 256> slots_;
  std::array<FaceId, kMaxFaces + 3> faces_;  // The sides of the last face looked at may be three too many.
  std::size_t size_ = 0;
};

/// Front nodes near a point of the open region, found through the open faces around it.
std::vector<VertexId> frontNodesNear(const FrontMesh& front, FaceId start, const Vec3& point, double radius) {
  const EditMesh& mesh = front.mesh();
  FewFaces faces;
  faces.add(start);
  std::vector<VertexId> nodes;
  const double reach = radius * radius;
  for (std::size_t i = 0; i < faces.size() && faces.size() < kMaxFaces; ++i) {
    const HalfedgeId first = mesh.halfedge(faces[i]);
    HalfedgeId h = first;
    do {
      const HalfedgeId next = mesh.next(h);
      const VertexId v = mesh.origin(h);
      const Vec3& p = mesh.position(v);
      const bool near = squaredNorm(point - p) < reach;
      if (near && std::find(nodes.begin(), nodes.end(), v) == nodes.end() && !front.isFree(v)) nodes.push_back(v);
      if (!front.isFront(h)) {
        // Distance of the edge's nearest point, to decide whether to look beyond it.
        const Vec3& q = mesh.position(mesh.origin(next));
        const double along = std::clamp(dot(point - p, q - p) / std::max(squaredNorm(q - p), 1e-300), 0.0, 1.0);
        if (squaredNorm(point - (p + (q - p) * along)) < reach) faces.add(mesh.face(mesh.twin(h)));
      }
      h = next;
    } while (h != first);
  }
  return nodes;
}

}  // namespace

std::vector<SideProposal> proposeSide(const FrontMesh& front, const SideRequest& request, const FrontOptions& options) {
  const EditMesh& mesh = front.mesh();
  const VertexId a = mesh.origin(request.sector);
  const Vec3 position = mesh.position(a);
  const Vec3 normal = mesh.normal(a);
  Trace trace = traceSide(front, request.sector, bisectorDirection(front, request), options.fieldWeight);
  if (request.closure) {
    const Vec3 blended = (trace.end.position - position + *request.closure - position) * 0.5;
    trace.direction = normalized(tangentPart(blended, normal));
    trace.end = front.vertexNear(trace.end.location, position + blended);
  }

  // Look ahead: where an opposite front is near, the rows in between must be whole.
  const LocalPlane plane(position, normalized(normal + trace.end.normal));
  const WalkResult walk =
      walkTowards(front, request.sector, position + trace.direction * (kReach * trace.length), plane);
  bool joins = false;
  if (walk.end == WalkResult::End::blocked) {
    const double gap = walk.fraction * kReach;
    const double rows = std::max(1.0, std::floor(gap + 0.5));
    joins = rows < 1.5;
    if (rows < kReach) {
      const double length = trace.length * gap / rows;
      trace.end = front.vertexNear(trace.end.location, position + trace.direction * length);
      if (!joins) trace.length = length;
    }
  }
  FaceId around = walk.end == WalkResult::End::blocked ? mesh.face(walk.edge) : FaceId();
  const WalkResult toEnd = walkTowards(front, request.sector, trace.end.position, plane);
  if (toEnd.end == WalkResult::End::inside) around = toEnd.face;
  if (toEnd.end == WalkResult::End::blocked) around = mesh.face(toEnd.edge);
  std::vector<SideProposal> proposals;
  if (!around.valid()) return proposals;

  const VertexId before = mesh.origin(front.previousFront(request.sector));
  const VertexId after = mesh.target(request.sector);
  const Vec3 sideways = cross(normal, trace.direction);
  const double snap = joins ? 1.35 : options.snapRadius;
  bool crowded = false;
  for (const VertexId v : frontNodesNear(front, around, trace.end.position, 1.5 * snap * trace.length)) {
    if (v == a) continue;
    const Vec3 offset = mesh.position(v) - trace.end.position;
    const double cost =
        std::max(std::fabs(dot(offset, trace.direction)), std::fabs(dot(offset, sideways))) / trace.length;
    if (cost < kCrowded) crowded = true;
    if (v == before || v == after || cost > snap) continue;
    SideProposal proposal;
    proposal.existing = v;
    proposal.vertex = mesh.vertex(v);
    proposal.cost = cost;
    proposals.push_back(proposal);
  }
  if (!(crowded || joins)) {
    SideProposal created;
    created.vertex = trace.end;
    created.cost = proposals.empty() ? 0.0 : options.snapRadius;
    proposals.push_back(created);
  } else if (request.lastResort) {
    SideProposal created;
    created.vertex = joins ? front.vertexNear(trace.end.location, (position + trace.end.position) * 0.5) : trace.end;
    created.cost = kLastResortCost;
    proposals.push_back(created);
  }
  std::stable_sort(proposals.begin(), proposals.end(),
                   [](const SideProposal& p, const SideProposal& q) { return p.cost < q.cost; });
  return proposals;
}

}  // namespace qmcf
