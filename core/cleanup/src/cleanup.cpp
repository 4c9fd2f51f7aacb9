#include "qmcf/cleanup/cleanup.hpp"

#include <algorithm>

#include "operators.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/extract.hpp"
#include "relaxation.hpp"
#include "untangle.hpp"

namespace qmcf {
namespace {

/// Quads with a worse shape are better off as two triangles; poor ones are if these are better by so much.
constexpr double kHopeless = 0.05;
constexpr double kPoor = 0.15;
constexpr double kGain = 0.15;

/// Cuts quads that are turned over at a corner, or nearly, into triangles that are not. Returns how many.
std::int64_t cutInverted(EditMesh& mesh) {
  std::int64_t cuts = 0;
  const std::size_t faces = mesh.faceCapacity();
  for (std::size_t i = 0; i < faces; ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed || mesh.cornerCount(f) != 4) continue;
    const double shape = faceShape(mesh, f);
    const bool isHopeless = isInverted(mesh, f) || !(shape >= kHopeless);
    if (!isHopeless && shape >= kPoor) continue;
    const auto sides = mesh.sides(f);
    const auto corner = [&](std::size_t c) { return mesh.origin(sides[c % 4]); };
    double best = isHopeless ? 0.0 : shape + kGain;
    std::size_t from = 4;
    for (std::size_t c = 0; c < 2; ++c) {
      if (mesh.connected(corner(c), corner(c + 2))) continue;
      const double worse = std::min(triangleShape(mesh, corner(c), corner(c + 1), corner(c + 2)),
                                    triangleShape(mesh, corner(c), corner(c + 2), corner(c + 3)));
      if (worse <= best) continue;
      best = worse;
      from = c;
    }
    if (from == 4) continue;
    mesh.cut(sides[from], sides[from + 2]);
    ++cuts;
  }
  return cuts;
}

/// Twice the area vector of a triangle over the sum of its squared sides, at most 0.29 long.
Vec3 directedShape(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double squares = squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c);
  return squares > 0.0 ? cross(b - a, c - a) / squares : Vec3{};
}

/// Cuts quads that no solver takes into two triangles that one does, whatever the normals say: where the outline turns
/// back within a triangle of the part, they face against it. Returns how many.
std::int64_t cutUnusable(EditMesh& mesh) {
  constexpr double kLeast = 1e-3;
  std::int64_t cuts = 0;
  const std::size_t faces = mesh.faceCapacity();
  for (std::size_t i = 0; i < faces; ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed || mesh.cornerCount(f) != 4 || !isDegenerate(mesh, f)) continue;
    const auto sides = mesh.sides(f);
    const auto place = [&](std::size_t c) -> const Vec3& { return mesh.position(mesh.origin(sides[c % 4])); };
    double best = kLeast;
    std::size_t from = 4;
    for (std::size_t c = 0; c < 2; ++c) {
      if (mesh.connected(mesh.origin(sides[c]), mesh.origin(sides[c + 2]))) continue;
      const Vec3 one = directedShape(place(c), place(c + 1), place(c + 2));
      const Vec3 other = directedShape(place(c), place(c + 2), place(c + 3));
      const double worse = std::min(norm(one), norm(other));
      if (!(dot(one, other) > 0.0) || worse <= best) continue;
      best = worse;
      from = c;
    }
    if (from == 4) continue;
    mesh.cut(sides[from], sides[from + 2]);
    ++cuts;
  }
  return cuts;
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
    }
    relaxation.wake(topology.takeTouched());
    if (changes == 0) break;
  }
  note(TraceKind::smooth);
  for (std::int32_t sweep = 0; sweep < options.sweeps; ++sweep) {
    if (!progress.report(Stage::cleanup, 0.7 + 0.3 * sweep / options.sweeps)) return cancelledError();
    if (sweep == std::max(0, options.sweeps - kSweepsOnFace)) relaxation.land();
    relaxation.sweep();
    work.commit();
  }
  note(TraceKind::untangle);
  const std::int64_t turnedOver = untangle(work, where, options.quadsOnly);
  const std::int64_t cuts = options.quadsOnly ? 0 : cutInverted(work);
  if (cuts > 0) untangle(work, where, options.quadsOnly);
  const std::int64_t unusable = options.quadsOnly ? 0 : cutUnusable(work);
  work.commit();
  CleanupResult result{extract(work, mesh.patchVertex), topology.statistics(), 1.0, {}, {}};
  for (std::size_t v = 0; v < work.vertexCapacity(); ++v) {
    const bool isNew = v >= mesh.positions.size();
    if (work.alive(VertexId(v))) result.before.push_back(isNew ? kNone : static_cast<std::int32_t>(v));
  }
  result.statistics.turnedOver = turnedOver;
  result.statistics.cuts = cuts + unusable;
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
