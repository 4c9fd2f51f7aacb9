#include "qmcf/cleanup/cleanup.hpp"

#include <algorithm>

#include "operators.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/extract.hpp"
#include "relaxation.hpp"
#include "stand.hpp"
#include "untangle.hpp"

namespace qmcf {
namespace {

/// Quads with a worse shape are better off as two triangles; poor ones are if these are better by so much.
constexpr double kHopeless = 0.05;
constexpr double kPoor = 0.15;
constexpr double kGain = 0.15;

/// Cuts a quad along the better diagonal, if that is worth more than `least`. worth(a, b, c, d): of the cut between a
/// and c. Returns whether it was cut.
template <class Worth>
bool cutInTwo(EditMesh& mesh, FaceId f, double least, Worth worth) {
  const auto sides = mesh.sides(f);
  const auto corner = [&](std::size_t c) { return mesh.origin(sides[c % 4]); };
  double best = least;
  std::size_t from = 4;
  for (std::size_t c = 0; c < 2; ++c) {
    if (mesh.connected(corner(c), corner(c + 2))) continue;
    const double here = worth(corner(c), corner(c + 1), corner(c + 2), corner(c + 3));
    if (here <= best) continue;
    best = here;
    from = c;
  }
  if (from == 4) return false;
  mesh.cut(sides[from], sides[from + 2]);
  return true;
}

bool isQuad(const EditMesh& mesh, FaceId f) { return mesh.kind(f) != FaceKind::removed && mesh.cornerCount(f) == 4; }

/// Cuts quads that are turned over at a corner, or nearly, into triangles that are not. Returns how many.
std::int64_t cutInverted(EditMesh& mesh) {
  std::int64_t cuts = 0;
  const std::size_t faces = mesh.faceCapacity();
  const auto worseTriangle = [&](VertexId a, VertexId b, VertexId c, VertexId d) {
    return std::min(triangleShape(mesh, a, b, c), triangleShape(mesh, a, c, d));
  };
  for (std::size_t i = 0; i < faces; ++i) {
    const FaceId f(i);
    if (!isQuad(mesh, f)) continue;
    const double shape = faceShape(mesh, f);
    const bool isHopeless = isInverted(mesh, f) || !(shape >= kHopeless);
    if (!isHopeless && shape >= kPoor) continue;
    cuts += cutInTwo(mesh, f, isHopeless ? 0.0 : shape + kGain, worseTriangle) ? 1 : 0;
  }
  return cuts;
}

/// Cuts quads that no solver takes into two triangles that one does, whatever the normals say: where the outline turns
/// back within a triangle of the part, they face against it. Returns how many.
std::int64_t cutUnusable(EditMesh& mesh) {
  constexpr double kLeast = 1e-3;
  std::int64_t cuts = 0;
  const std::size_t faces = mesh.faceCapacity();
  // Twice the area vector over the sum of the squared sides, at most 0.29 long.
  const auto directed = [&](VertexId a, VertexId b, VertexId c) {
    const Vec3 ab = mesh.position(b) - mesh.position(a);
    const Vec3 ac = mesh.position(c) - mesh.position(a);
    const double squares = squaredNorm(ab) + squaredNorm(ac) + squaredNorm(ac - ab);
    return squares > 0.0 ? cross(ab, ac) / squares : Vec3{};
  };
  const auto smallerArea = [&](VertexId a, VertexId b, VertexId c, VertexId d) {
    const Vec3 one = directed(a, b, c);
    const Vec3 other = directed(a, c, d);
    return dot(one, other) > 0.0 ? std::min(norm(one), norm(other)) : 0.0;
  };
  for (std::size_t i = 0; i < faces; ++i) {
    const FaceId f(i);
    if (!isQuad(mesh, f) || !isDegenerate(mesh, f)) continue;
    cuts += cutInTwo(mesh, f, kLeast, smallerArea) ? 1 : 0;
  }
  return cuts;
}

/// Joins triangles beside each other to quads that are well shaped and upright: around tips smooth normals are so far
/// from those of the elements that good quads are cut. Returns how many.
std::int64_t joinUpright(EditMesh& mesh, const RelaxationTarget& target) {
  constexpr double kLeastSquare = 0.4;
  std::int64_t joined = 0;
  const auto isTriangle = [&mesh](FaceId f) { return mesh.kind(f) != FaceKind::removed && mesh.cornerCount(f) == 3; };
  // Two elements would share both of their sides at a vertex inside that has no others.
  const auto hasEnough = [&mesh](VertexId v) {
    int elements = 0;
    mesh.forEachOutgoing(v, [&](HalfedgeId) { ++elements; });
    return mesh.isBoundary(v) || elements > 3;
  };
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    double best = kLeastSquare;
    HalfedgeId across;
    if (!isTriangle(f)) continue;
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid() || !mesh.twin(h).valid() || !isTriangle(mesh.face(mesh.twin(h)))) continue;
      if (!hasEnough(mesh.origin(h)) || !hasEnough(mesh.target(h))) continue;
      const std::size_t mark = mesh.mark();
      const FaceId quad = joinTriangles(mesh, h);
      const Stand stand = standOf(mesh, target, quad);
      if (!stand.turnedOver && !(stand.penalty > 0.0) && stand.square >= best) {
        best = stand.square;
        across = h;
      }
      mesh.rollback(mark);
    }
    if (!across.valid()) continue;
    joinTriangles(mesh, across);
    ++joined;
  }
  return joined;
}

/// Per vertex, the elements that make it regular. The mesh's numbers are its own: patchVertex tells the patch's.
std::vector<std::int32_t> wantedElements(const FaceMesh& mesh, const EditMesh& work, const Patch& patch) {
  constexpr std::int32_t kInsideEdge = 2;
  std::vector<std::int32_t> wanted(mesh.positions.size(), TopologicalCleanup::kRegular);
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    if (!work.isBoundary(VertexId(v))) continue;
    wanted[v] = mesh.patchVertex[v] == kNone ? kInsideEdge : patch.cornerQuads[VertexId(mesh.patchVertex[v])];
  }
  return wanted;
}

}  // namespace

Result<CleanupResult> cleanUp(const FaceMesh& mesh, const Patch& patch, const TriangleBvh& target,
                              const CleanupOptions& options, Progress& progress, TraceRecorder* trace,
                              TraceKind start) {
  EditMesh work(mesh);
  if (trace != nullptr) trace->begin(start, work);
  const auto note = [trace](TraceKind kind) {
    if (trace != nullptr) trace->next(kind);
  };
  const RelaxationTarget where{patch, target, options.sizeScale, false, options.part};
  TopologicalCleanup topology(work, wantedElements(mesh, work, patch), where, options, trace);
  constexpr double kEnough = 0.6;
  constexpr int kSweepsPerRound = 3;
  constexpr std::int32_t kSmallRounds = 2;
  constexpr int kCavityPasses = 2;
  // On the way the patch is near enough; in the end the vertices go to the face itself.
  constexpr std::int32_t kSweepsOnFace = 3;
  RelaxationTarget onTheWay = where;
  onTheWay.onPatch = true;
  int cavityPasses = 0;
  LazyRelaxation relaxation(work, onTheWay, kEnough);
  for (std::int32_t round = 0; options.topology && round < options.rounds; ++round) {
    if (!progress.report(Stage::cleanup, 0.7 * round / options.rounds)) return cancelledError();
    note(TraceKind::smooth);
    for (int sweep = 0; sweep < kSweepsPerRound && relaxation.sweep(); ++sweep) {
    }
    work.commit();
    std::int64_t changes = topology.pass();
    const bool settled = changes == 0 || round == kSmallRounds;
    if (settled && cavityPasses < kCavityPasses) {
      ++cavityPasses;
      changes += topology.cavityPass();
      changes += topology.distantPass();
    }
    relaxation.wake(topology.takeTouched());
    if (changes == 0) break;
  }
  if (options.pairAll) {
    topology.pairAll(progress);
    relaxation.wake(topology.takeTouched());
  }
  note(TraceKind::smooth);
  for (std::int32_t sweep = 0; sweep < options.sweeps; ++sweep) {
    if (!progress.report(Stage::cleanup, 0.7 + 0.3 * sweep / options.sweeps)) return cancelledError();
    if (sweep == std::max(0, options.sweeps - kSweepsOnFace)) relaxation.land();
    relaxation.sweep();
    work.commit();
  }
  note(TraceKind::untangle);
  if (!progress.report(Stage::cleanup, 1.0)) return cancelledError();
  const std::int64_t turnedOver = untangle(work, where, options.quadsOnly);
  const std::int64_t cuts = options.quadsOnly ? 0 : cutInverted(work);
  if (cuts > 0) untangle(work, where, options.quadsOnly);
  const std::int64_t unusable = options.quadsOnly ? 0 : cutUnusable(work);
  const std::int64_t joined = options.quadsOnly ? 0 : joinUpright(work, where);
  work.commit();
  CleanupResult result{extract(work, mesh.patchVertex), topology.statistics(), 1.0, {}, {}};
  for (std::size_t v = 0; v < work.vertexCapacity(); ++v) {
    const bool isNew = v >= mesh.positions.size();
    if (work.alive(VertexId(v))) result.before.push_back(isNew ? kNone : static_cast<std::int32_t>(v));
  }
  result.statistics.turnedOver = turnedOver;
  result.statistics.cuts = cuts + unusable;
  result.statistics.joins = joined;
  std::int32_t element = 0;
  for (std::size_t i = 0; i < work.faceCapacity(); ++i) {
    if (work.kind(FaceId(i)) == FaceKind::removed) continue;
    result.worstShape = std::min(result.worstShape, faceShape(work, FaceId(i)));
    if (isDegenerate(work, FaceId(i))) result.degenerate.push_back(element);
    ++element;
  }
  return result;
}

}  // namespace qmcf
