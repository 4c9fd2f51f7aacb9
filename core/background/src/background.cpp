#include "qmcf/background/background.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "face_boundary.hpp"
#include "face_reference.hpp"
#include "missed_places.hpp"
#include "remesh_mesh.hpp"
#include "remesher.hpp"

namespace qmcf {
namespace {

constexpr int kSmoothingSweeps = 3;
constexpr int kExtraRounds = 6;
constexpr double kCoarsest = 8.0;  // In units of the target length.

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

std::vector<std::int32_t> pointsLeft(const RemeshMesh& mesh) {
  std::vector<std::int32_t> points;
  for (std::int32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (!mesh.isVertexRemoved(v) && mesh.role[index(v)] == VertexRole::point) points.push_back(v);
  }
  return points;
}

void coarsen(Remesher& remesher, const RemeshMesh& mesh) {
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::int32_t collapsed = remesher.collapseShort();
    if (static_cast<std::int64_t>(collapsed) * 1000 < mesh.halfedgeCount()) return;
  }
}

/// Small meshes fit in the cache whatever their order.
void renumberIfLarge(Remesher& remesher, const RemeshMesh& mesh, FaceBoundary& boundary) {
  constexpr std::int32_t kLarge = 10000;
  std::int32_t vertices = 0;
  for (std::int32_t v = 0; v < mesh.vertexCount(); ++v) vertices += mesh.isVertexRemoved(v) ? 0 : 1;
  if (vertices < kLarge) return;
  const std::vector<std::int32_t> newVertex = remesher.renumber();
  for (std::int32_t& v : boundary.firstVertex) v = newVertex[index(v)];
}

/// Returns false when progress asked to stop.
bool remesh(Remesher& remesher, const RemeshMesh& mesh, FaceBoundary& boundary, const BackgroundOptions& options,
            Progress& progress) {
  remesher.updateSizes();
  remesher.removePoints();
  coarsen(remesher, mesh);
  if (!remesher.flipNeedles(progress)) return false;
  remesher.flipEdges();
  // Long needles are cut in few pieces first: collapses and flips between make most of the others unnecessary.
  for (double scale = kCoarsest; scale > 1.0; scale *= 0.5) {
    if (!progress.report(Stage::background, 0.0)) return false;
    if (remesher.splitLong(scale) == 0) continue;
    remesher.flipEdges();
    remesher.smooth(1);
    remesher.updateSizes();
    remesher.removePoints();
    remesher.collapseShort();
  }
  const int rounds = options.iterations + kExtraRounds;
  for (int round = 0; round < rounds; ++round) {
    if (!progress.report(Stage::background, static_cast<double>(round) / rounds)) return false;
    // The first round makes most of the vertices.
    if (round <= 1) renumberIfLarge(remesher, mesh, boundary);
    remesher.updateSizes();
    const std::int32_t left = remesher.removePoints();
    if (round >= options.iterations && left == 0) break;
    remesher.collapseShort();
    remesher.splitLong(1.0);
    remesher.flipEdges();
    remesher.smooth(kSmoothingSweeps);
  }
  return true;
}

/// Distance of a point that stands in for a stretch of boundary from the chord between the nodes around it, in chords.
double relativeSagitta(const RemeshMesh& mesh, std::int32_t point) {
  std::int32_t before = point;
  while (mesh.role[index(before)] == VertexRole::point) before = mesh.origin(mesh.incomingBoundary(before));
  std::int32_t after = point;
  while (mesh.role[index(after)] == VertexRole::point) after = mesh.target(mesh.outgoing(after));
  const Vec3 chord = mesh.positionOf(after) - mesh.positionOf(before);
  const double length = norm(chord);
  if (!(length > 0.0)) return HUGE_VAL;
  return norm(cross(chord, mesh.positionOf(point) - mesh.positionOf(before))) / (length * length);
}

/// Removes the points that the remesh could not, where little is at stake; the edges of the others.
std::vector<std::int32_t> settlePoints(Remesher& remesher, const RemeshMesh& mesh, const FaceBoundary& boundary) {
  constexpr double kNegligible = 0.05;
  std::vector<std::int32_t> tooCoarse;
  for (const std::int32_t v : pointsLeft(mesh)) {
    const std::int32_t coedge = mesh.mark(mesh.outgoing(v));
    if (relativeSagitta(mesh, v) < kNegligible && remesher.forcePoint(v)) continue;
    tooCoarse.push_back(boundary.coedges[index(coedge)].edge);
  }
  std::sort(tooCoarse.begin(), tooCoarse.end());
  tooCoarse.erase(std::unique(tooCoarse.begin(), tooCoarse.end()), tooCoarse.end());
  return tooCoarse;
}

Result<Patch> makePatch(const RemeshMesh& mesh, const FaceBoundary& boundary, const std::vector<double>& size,
                        std::int32_t face) {
  Patch patch;
  patch.face = face;
  std::vector<std::int32_t> newVertex(mesh.position.size(), kNone);
  std::vector<Vec3> positions;
  for (std::int32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (mesh.isVertexRemoved(v)) continue;
    newVertex[index(v)] = static_cast<std::int32_t>(positions.size());
    positions.push_back(mesh.positionOf(v));
    patch.normal.push_back(mesh.normal[index(v)]);
    patch.size.push_back(size[index(v)]);
    patch.node.push_back(mesh.node[index(v)]);
    patch.cornerQuads.push_back(mesh.role[index(v)] == VertexRole::interior ? 0 : 2);
  }
  for (std::size_t c = 0; c < boundary.coedges.size(); ++c) {
    patch.cornerQuads[VertexId(newVertex[index(boundary.firstVertex[c])])] = boundary.coedges[c].cornerQuads;
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t h = 0; h < mesh.halfedgeCount(); h += 3) {
    if (mesh.isRemoved(h)) continue;
    triangles.push_back(
        {newVertex[index(mesh.origin(h))], newVertex[index(mesh.origin(h + 1))], newVertex[index(mesh.origin(h + 2))]});
    for (std::int32_t c = 0; c < 3; ++c) {
      const std::int32_t mark = mesh.mark(h + c);
      patch.edge.push_back(mark == kNone ? kNone : boundary.coedges[index(mark)].edge);
    }
  }
  Result<Surface> surface = Surface::build(std::move(positions), triangles);
  if (!surface.ok()) {
    return Error{
        ErrorCode::internal, "The triangulation of face " + std::to_string(face) + " lost its manifoldness.", {face}};
  }
  patch.surface = std::move(surface).value();
  return patch;
}

}  // namespace

Result<BackgroundResult> buildBackground(const TriangleMesh& mesh, const Brep& brep, std::int32_t face,
                                         const SizeField& size, const DividedEdges& divided,
                                         const BackgroundOptions& options, Progress& progress) {
  if (!progress.report(Stage::background, 0.0)) return cancelledError();
  const FaceSurface& cut = brep.cuts[static_cast<std::size_t>(face)];
  const FaceReference reference(cut.surface);
  RemeshMesh work;
  FaceBoundary boundary = insertNodes(work, mesh, brep, face, cut, reference, divided);
  RemeshTargets targets;
  targets.base = size.base;
  targets.gradation = size.gradation;
  targets.relativeSize = options.relativeSize;
  targets.flatSize = options.flatSize;
  targets.inner = FaceSizes(size, face);
  targets.nodeSize = std::move(boundary.nodeSize);
  targets.spacing = std::move(boundary.spacing);
  for (const SizeLimit& limit : size.limits) {
    if (limit.face == face) targets.limits.push_back(limit);
  }
  Remesher remesher(work, reference, std::move(targets));
  if (!remesh(remesher, work, boundary, options, progress)) return cancelledError();

  BackgroundResult result;
  result.tooCoarse = settlePoints(remesher, work, boundary);
  if (!result.tooCoarse.empty()) return result;
  remesher.flipEdges();
  remesher.smooth(kSmoothingSweeps);
  renumberIfLarge(remesher, work, boundary);
  remesher.updateSizes();
  Result<Patch> patch = makePatch(work, boundary, remesher.size(), face);
  if (!patch.ok()) return patch.error();
  result.patch = std::move(patch).value();
  result.missed = findMissedPlaces(cut.surface, reference, result.patch, size.base);
  return result;
}

}  // namespace qmcf
