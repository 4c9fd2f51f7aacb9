#include "checks.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/topology/brep.hpp"
#include "qmcf/topology/repair.hpp"
#include "qmcf/topology/statistics.hpp"

namespace qmcf::fuzz {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

void checkError(const Error& error) {
  require(error.code != ErrorCode::internal, "bad input is not an internal error");
  require(error.message.size() > 10 && error.message.back() == '.', "an error is a sentence");
  require(error.message.size() < 500, "an error is short");
}

bool inRange(std::int32_t index, std::size_t count) { return index >= 0 && static_cast<std::size_t>(index) < count; }

void checkIndices(const TriangleMesh& mesh) {
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) require(inRange(v, mesh.positions.size()), "corners are vertices");
  }
  for (const Vec3& p : mesh.positions) require(isFinite(p), "coordinates are finite");
  require(mesh.labels.empty() || mesh.labels.size() == mesh.triangles.size(), "all or no triangles have labels");
  for (const std::int32_t label : mesh.labels) require(inRange(label, mesh.labelNames.size()), "labels have names");
}

void checkLoop(const Brep& brep, const FaceSurface& face, const BrepLoop& loop, std::span<const HalfedgeId> sides) {
  std::size_t side = 0;
  for (const Coedge& coedge : loop.coedges) {
    require(inRange(coedge.edge, brep.edges.size()), "loops use edges");
    std::vector<std::int32_t> points = brep.edges[static_cast<std::size_t>(coedge.edge)].points;
    if (coedge.reversed) std::reverse(points.begin(), points.end());
    require(points.size() >= 2, "edges have two ends");
    require(coedge.cornerQuads >= 1 && coedge.cornerQuads <= 4, "a corner wants one to four quads");
    for (std::size_t i = 0; i + 1 < points.size(); ++i, ++side) {
      require(side < sides.size(), "a loop is as long as its half-edges");
      require(face.edge[sides[side]] == coedge.edge, "half-edges know their edge");
      require(face.vertexPoint[face.surface.origin(sides[side]).index()] == points[i], "loops follow edges");
      require(face.vertexPoint[face.surface.target(sides[side]).index()] == points[i + 1], "loops follow edges");
    }
  }
  require(side == sides.size(), "half-edges are as many as a loop's");
}

void checkFace(const Brep& brep, std::size_t f) {
  const FaceSurface& face = brep.cuts[f];
  require(face.triangleOrigin == brep.faces[f].triangles, "a face's surface is made of its triangles");
  require(face.loops.size() == brep.faces[f].loops.size(), "a face's surface has the face's loops");
  std::size_t boundary = 0;
  for (const HalfedgeId h : face.surface.halfedges()) boundary += face.surface.isBoundary(h) ? 1U : 0U;
  std::size_t inLoops = 0;
  for (std::size_t i = 0; i < face.loops.size(); ++i) {
    checkLoop(brep, face, brep.faces[f].loops[i], face.loops[i]);
    inLoops += face.loops[i].size();
  }
  require(inLoops == boundary, "loops are the whole boundary");
}

void checkBrep(const TriangleMesh& mesh) {
  SilentProgress silent;
  const Result<Brep> result = recoverBrep(mesh, {}, silent);
  if (!result.ok()) return checkError(result.error());
  const Brep& brep = result.value();
  std::vector<std::int32_t> faceOf(mesh.triangles.size(), kNone);
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    for (const std::int32_t t : brep.faces[f].triangles) {
      require(inRange(t, faceOf.size()) && faceOf[static_cast<std::size_t>(t)] == kNone, "faces do not overlap");
      faceOf[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(f);
    }
    checkFace(brep, f);
  }
  require(faceOf == brep.triangleFace, "every triangle has its face");
  for (const BrepEdge& edge : brep.edges) {
    require(inRange(edge.start, brep.vertices.size()) && inRange(edge.end, brep.vertices.size()), "edges have ends");
    require(edge.points.front() == brep.vertices[static_cast<std::size_t>(edge.start)].point,
            "edges begin at a vertex");
    require(edge.points.back() == brep.vertices[static_cast<std::size_t>(edge.end)].point, "edges end at a vertex");
  }
}

void checkRepair(const TriangleMesh& mesh, bool modify) {
  SilentProgress silent;
  const Result<RepairedMesh> result = repair(mesh, {modify}, silent);
  if (!result.ok()) return checkError(result.error());
  const RepairedMesh& repaired = result.value();
  checkIndices(repaired.mesh);
  require(repaired.triangleOrigin.size() == repaired.mesh.triangles.size(), "every triangle has an origin");
  for (const std::int64_t origin : repaired.triangleOrigin) {
    require(origin >= 0 && static_cast<std::size_t>(origin) < mesh.triangles.size(), "origins are triangles");
  }
  for (const auto& c : repaired.mesh.triangles) {
    require(c[0] != c[1] && c[1] != c[2] && c[2] != c[0], "corners differ");
  }
  for (const RepairItem& item : repaired.items) {
    require(item.count > 0 && item.elements.size() <= 100 && !item.elements.empty(), "items say what and where");
  }
  checkBrep(repaired.mesh);
}

}  // namespace

TriangleMesh checkReading(std::span<const std::byte> bytes) {
  SilentProgress silent;
  const Result<QuadMesh> quads = readQuadMesh(bytes, silent);
  if (quads.ok()) {
    for (const auto& element : quads.value().elements) {
      for (std::size_t c = 0; c < 4; ++c) {
        const bool isTriangle = c == 3 && element[c] == kNone;
        require(isTriangle || inRange(element[c], quads.value().positions.size()), "elements have vertices");
      }
    }
  }
  Result<ReadModel> model = readModel(bytes, silent);
  if (!model.ok()) {
    checkError(model.error());
    return {};
  }
  const TriangleMesh& mesh = model.value().mesh;
  checkIndices(mesh);
  // The least that a file spends on a vertex are three bytes, on a triangle one.
  require(mesh.positions.size() <= bytes.size() / 3 + 1, "vertices are in the file");
  require(mesh.triangles.size() <= bytes.size(), "triangles are in the file");
  return std::move(model).value().mesh;
}

void checkTopology(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const MeshStatistics statistics = meshStatistics(mesh);
  require(statistics.triangles == static_cast<std::int64_t>(mesh.triangles.size()), "all triangles are counted");
  require(statistics.components <= statistics.triangles, "a component has a triangle");
  checkRepair(mesh, true);
  checkRepair(mesh, false);
}

}  // namespace qmcf::fuzz
