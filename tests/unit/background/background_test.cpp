#include "qmcf/background/background.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "qmcf/spatial/triangle_bvh.hpp"
#include "sizing/parts.hpp"

namespace qmcf {
namespace {

struct Remeshed {
  TriangleMesh mesh;
  Brep brep;
  SizeField field;
  DividedEdges divided;
  std::vector<Patch> patches;
};

/// Runs sizing, division and background of all faces, dividing again while a boundary is too coarse.
Remeshed remesh(TriangleMesh mesh, const SizingOptions& options) {
  Remeshed r;
  r.mesh = std::move(mesh);
  r.brep = parts::brepOf(r.mesh);
  SilentProgress progress;
  Result<SizeField> field = computeSizeField(r.mesh, r.brep, options, progress);
  EXPECT_TRUE(field.ok());
  r.field = std::move(field).value();
  std::vector<std::int32_t> minimum(r.brep.edges.size(), 1);
  for (int attempt = 0; attempt < 8; ++attempt) {
    r.divided = divideEdges(r.mesh, r.brep, r.field, minimum);
    r.patches.clear();
    bool tooCoarse = false;
    for (std::size_t f = 0; f < r.brep.faces.size(); ++f) {
      Result<BackgroundResult> result =
          buildBackground(r.mesh, r.brep, static_cast<std::int32_t>(f), r.field, r.divided, {}, progress);
      EXPECT_TRUE(result.ok());
      for (const std::int32_t e : result.value().tooCoarse) {
        tooCoarse = true;
        const auto edge = static_cast<std::size_t>(e);
        minimum[edge] = 2 * static_cast<std::int32_t>(r.divided.edges[edge].nodes.size() - 1);
      }
      r.patches.push_back(std::move(result).value().patch);
    }
    if (!tooCoarse) return r;
  }
  ADD_FAILURE() << "the boundary stays too coarse";
  return r;
}

Remeshed remesh(TriangleMesh mesh, double size) {
  SizingOptions options;
  options.size = size;
  return remesh(std::move(mesh), options);
}

double areaOf(const Patch& patch) {
  double area = 0.0;
  for (const TriangleId t : patch.surface.triangles()) area += 0.5 * norm(patch.surface.areaVector(t));
  return area;
}

double smallestAngle(const Patch& patch) {
  double smallest = math::kPi;
  for (const HalfedgeId h : patch.surface.halfedges()) smallest = std::min(smallest, patch.surface.angle(h));
  return smallest * 180.0 / math::kPi;
}

/// The nodes that the B-rep's loops ask for, per loop, sorted; and those along the patch's boundary.
std::vector<std::vector<std::int32_t>> wantedLoops(const Remeshed& r, const BrepFace& face) {
  std::vector<std::vector<std::int32_t>> loops;
  for (const BrepLoop& loop : face.loops) {
    std::vector<std::int32_t> nodes;
    for (const Coedge& coedge : loop.coedges) {
      std::vector<std::int32_t> way = r.divided.edges[static_cast<std::size_t>(coedge.edge)].nodes;
      if (coedge.reversed) std::reverse(way.begin(), way.end());
      nodes.insert(nodes.end(), way.begin(), way.end() - 1);
    }
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    loops.push_back(nodes);
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

std::vector<std::vector<std::int32_t>> foundLoops(const Patch& patch) {
  std::vector<std::vector<std::int32_t>> loops;
  for (const HalfedgeId first : patch.surface.boundaryLoops()) {
    std::vector<std::int32_t> nodes;
    HalfedgeId h = first;
    do {
      nodes.push_back(patch.node[patch.surface.origin(h)]);
      h = patch.surface.nextBoundary(h);
    } while (h != first);
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    loops.push_back(nodes);
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

/// distance: how far vertices may be from the face; 0 but for the planar area between a chord and a curve beyond it.
void checkPatch(const Remeshed& r, const Patch& patch, double distance = 0.0) {
  const auto f = static_cast<std::size_t>(patch.face);
  const Surface& s = patch.surface;
  EXPECT_EQ(foundLoops(patch), wantedLoops(r, r.brep.faces[f]));
  const FaceSurface& cut = r.brep.cuts[static_cast<std::size_t>(patch.face)];
  EXPECT_EQ(s.eulerCharacteristic(), cut.surface.eulerCharacteristic());
  ASSERT_EQ(patch.normal.size(), s.vertexCount());
  ASSERT_EQ(patch.size.size(), s.vertexCount());
  ASSERT_EQ(patch.node.size(), s.vertexCount());
  ASSERT_EQ(patch.cornerQuads.size(), s.vertexCount());
  ASSERT_EQ(patch.edge.size(), s.halfedgeCount());

  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::int32_t t : r.brep.faces[f].triangles)
    triangles.push_back(r.mesh.triangles[static_cast<std::size_t>(t)]);
  const TriangleBvh bvh(r.mesh.positions, triangles);
  for (const VertexId v : s.vertices()) {
    EXPECT_EQ(s.isBoundary(v), patch.node[v] != kNone);
    EXPECT_GT(patch.size[v], 0.0);
    EXPECT_LE(patch.size[v], r.field.base * (1.0 + 1e-12));
    EXPECT_NEAR(norm(patch.normal[v]), 1.0, 1e-12);
    EXPECT_LT(std::sqrt(bvh.closest(s.position(v)).squaredDistance), distance + 1e-9);
    if (s.isBoundary(v)) {
      EXPECT_EQ(s.position(v), r.divided.nodes[static_cast<std::size_t>(patch.node[v])]);
      EXPECT_GE(patch.cornerQuads[v], 1);
      EXPECT_LE(patch.cornerQuads[v], 4);
    } else {
      EXPECT_EQ(patch.cornerQuads[v], 0);
    }
  }
  for (const HalfedgeId h : s.halfedges()) {
    EXPECT_EQ(patch.edge[h] != kNone, s.isBoundary(h));
    const double slope = std::fabs(patch.size[s.origin(h)] - patch.size[s.target(h)]) / s.length(h);
    EXPECT_LE(slope, r.field.gradation * (1.0 + 1e-9));
  }
  for (const TriangleId t : s.triangles()) {
    const auto corners = s.corners(t);
    const Vec3 normal = patch.normal[corners[0]] + patch.normal[corners[1]] + patch.normal[corners[2]];
    EXPECT_GT(dot(s.areaVector(t), normal), 0.0);
  }
}

std::int64_t edgesBetweenBoundaryVertices(const Patch& patch) {
  std::int64_t count = 0;
  for (const HalfedgeId h : patch.surface.halfedges()) {
    if (patch.surface.isBoundary(h) || patch.surface.twin(h) < h) continue;
    if (patch.surface.isBoundary(patch.surface.origin(h)) && patch.surface.isBoundary(patch.surface.target(h))) ++count;
  }
  return count;
}

TEST(Background, BoxOfTwoTrianglesASide) {
  const Remeshed r = remesh(parts::box(1.0, 2.0, 3.0), 0.2);
  double area = 0.0;
  for (const Patch& patch : r.patches) {
    checkPatch(r, patch);
    EXPECT_GT(smallestAngle(patch), 20.0);
    EXPECT_EQ(edgesBetweenBoundaryVertices(patch), 0);
    area += areaOf(patch);
    std::int64_t corners = 0;
    for (const VertexId v : patch.surface.vertices()) corners += patch.cornerQuads[v] == 1 ? 1 : 0;
    EXPECT_EQ(corners, 4);
  }
  EXPECT_NEAR(area, 22.0, 1e-9);
}

TEST(Background, ANeedleTakesFewVerticesMoreThanItsNodes) {
  // Its two long sides were joined by a fan of needles, all of which were cut into pieces.
  TriangleMesh needle;
  needle.positions = {{0, 0, 0}, {1000, 0, 0}, {0, 1, 0}};
  needle.triangles = {{0, 1, 2}};
  const Remeshed r = remesh(needle, 2.0);
  ASSERT_EQ(r.patches.size(), 1U);
  EXPECT_LT(r.patches[0].surface.vertexCount(), 2 * r.divided.nodes.size());
  EXPECT_NEAR(areaOf(r.patches[0]), 500.0, 1e-6);
}

TEST(Background, DiskFromAFanOfEars) {
  const Remeshed r = remesh(parts::disk(128, 1.0), 0.15);
  ASSERT_EQ(r.patches.size(), 1U);
  checkPatch(r, r.patches[0]);
  EXPECT_GT(smallestAngle(r.patches[0]), 22.0);
  EXPECT_EQ(edgesBetweenBoundaryVertices(r.patches[0]), 0);
  // A polygon of n nodes on the unit circle.
  const auto n = static_cast<double>(r.divided.edges[0].nodes.size() - 1);
  EXPECT_NEAR(areaOf(r.patches[0]), 0.5 * n * std::sin(2.0 * math::kPi / n), 2e-3);
}

TEST(Background, AnnulusKeepsItsHole) {
  const Remeshed r = remesh(parts::annulus(96, 0.4, 1.0), 0.12);
  checkPatch(r, r.patches[0]);
  EXPECT_EQ(r.patches[0].surface.eulerCharacteristic(), 0);
  EXPECT_GT(smallestAngle(r.patches[0]), 20.0);
}

TEST(Background, SmallHoleInALargePlateRefinesOnlyNearby) {
  const Remeshed r = remesh(parts::plateWithHole(10.0, {2.0, 1.0, 0.0}, 0.1, 32), 1.0);
  const Patch& patch = r.patches[0];
  checkPatch(r, patch);
  EXPECT_GT(smallestAngle(patch), 15.0);
  for (const VertexId v : patch.surface.vertices()) {
    const double away = distance(patch.surface.position(v), {2.0, 1.0, 0.0});
    if (away > 8.0) {
      EXPECT_DOUBLE_EQ(patch.size[v], 1.0);
    }
    if (away < 0.3) {
      EXPECT_LT(patch.size[v], 0.3);
    }
  }
}

TEST(Background, CylinderOfNeedlesIsAsGoodAsAFineOne) {
  const Remeshed needles = remesh(parts::cylinderSide(64, 1, 1.0, 6.0), 0.3);
  const Remeshed fine = remesh(parts::cylinderSide(64, 48, 1.0, 6.0), 0.3);
  for (const Remeshed* r : {&needles, &fine}) {
    checkPatch(*r, r->patches[0]);
    EXPECT_EQ(r->patches[0].surface.eulerCharacteristic(), 0);
    EXPECT_GT(smallestAngle(r->patches[0]), 25.0);
    EXPECT_EQ(edgesBetweenBoundaryVertices(r->patches[0]), 0);
    EXPECT_NEAR(areaOf(r->patches[0]), 2.0 * math::kPi * 6.0, 0.6);
    for (const VertexId v : r->patches[0].surface.vertices()) {
      const Vec3 p = r->patches[0].surface.position(v);
      EXPECT_GT(dot(r->patches[0].normal[v], normalized({p.x, p.y, 0.0})), 0.99);
    }
  }
  const auto count = static_cast<double>(needles.patches[0].surface.triangleCount());
  EXPECT_NEAR(count, static_cast<double>(fine.patches[0].surface.triangleCount()), 0.1 * count);
}

TEST(Background, SphereIsCoarsenedWithoutABoundary) {
  const Remeshed r = remesh(parts::sphere(24), 0.25);
  ASSERT_EQ(r.patches.size(), 1U);
  checkPatch(r, r.patches[0]);
  EXPECT_EQ(r.patches[0].surface.eulerCharacteristic(), 2);
  EXPECT_GT(smallestAngle(r.patches[0]), 30.0);
  EXPECT_LT(r.patches[0].surface.triangleCount(), 6U * 24U * 24U);
  EXPECT_NEAR(areaOf(r.patches[0]), 4.0 * math::kPi, 0.02 * 4.0 * math::kPi);
}

TEST(Background, ChordsThatCutThroughAThinRingAreReported) {
  // Eight chords across a ring this thin leave it; its rims are turned against each other so that they would cross.
  constexpr std::int32_t kCount = 96;
  TriangleMesh mesh;
  mesh.positions = parts::ring(kCount, 0.97, 0.0, 1.0 / 16.0);
  const std::vector<Vec3> outer = parts::ring(kCount, 1.0);
  mesh.positions.insert(mesh.positions.end(), outer.begin(), outer.end());
  const auto inner = [](std::int32_t i) { return (i + kCount - kCount / 16) % kCount; };
  for (std::int32_t i = 0; i < kCount; ++i) {
    const std::int32_t j = (i + 1) % kCount;
    parts::addQuad(mesh, inner(i), kCount + i, kCount + j, inner(j));
  }
  const Brep brep = parts::brepOf(mesh);
  ASSERT_EQ(brep.edges.size(), 2U);
  SizeField coarse;
  coarse.base = 10.0;
  coarse.value.assign(mesh.positions.size(), 10.0);
  coarse.minimumDivisions = {8, 8};
  const DividedEdges divided = divideEdges(mesh, brep, coarse, {});
  SilentProgress progress;
  const Result<BackgroundResult> result = buildBackground(mesh, brep, 0, coarse, divided, {}, progress);
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result.value().tooCoarse.empty());
  EXPECT_EQ(result.value().patch.surface.triangleCount(), 0U);
  // Raising the numbers always helps in the end.
  const Remeshed r = remesh(mesh, 10.0);
  checkPatch(r, r.patches[0], 0.01);
}

TEST(Background, NarrowStripIsMeshedWithoutInnerVertices) {
  const Remeshed r = remesh(parts::box(4.0, 0.05, 4.0), 0.5);
  for (const Patch& patch : r.patches) checkPatch(r, patch);
}

TEST(Background, GivenTrianglesAreTheFacesOwn) {
  for (const TriangleMesh& mesh : {parts::box(4.0, 0.05, 4.0), parts::cylinderSide(40, 1, 1.0, 3.0),
                                   parts::plateWithHole(5.0, {3, 1, 0}, 0.5, 64)}) {
    Remeshed r;
    r.mesh = mesh;
    r.brep = parts::brepOf(mesh);
    SizingOptions options;
    options.size = 0.7;
    SilentProgress progress;
    r.field = computeSizeField(r.mesh, r.brep, options, progress).value();
    r.divided = divideEdges(r.mesh, r.brep, r.field, {}, std::vector<std::uint8_t>(r.brep.edges.size(), 1));
    for (std::size_t f = 0; f < r.brep.faces.size(); ++f) {
      const Patch patch = givenTriangles(r.brep, static_cast<std::int32_t>(f), r.field, r.divided);
      EXPECT_EQ(foundLoops(patch), wantedLoops(r, r.brep.faces[f]));
      EXPECT_EQ(patch.surface.triangleCount(), r.brep.faces[f].triangles.size());
      EXPECT_NEAR(areaOf(patch), r.brep.faces[f].area, 1e-12 * r.brep.faces[f].area);
      std::int32_t corners = 0;
      for (const VertexId v : patch.surface.vertices()) {
        EXPECT_NEAR(norm(patch.normal[v]), 1.0, 1e-12);
        EXPECT_GT(patch.size[v], 0.0);
        corners += patch.cornerQuads[v] == 1 ? 1 : 0;
        const std::int32_t node = patch.node[v];
        EXPECT_EQ(node != kNone, patch.surface.isBoundary(v));
        if (node == kNone) continue;
        EXPECT_EQ(r.divided.nodes[static_cast<std::size_t>(node)], patch.surface.position(v));
      }
      std::int32_t wanted = 0;
      for (const BrepLoop& loop : r.brep.faces[f].loops) {
        for (const Coedge& coedge : loop.coedges) wanted += coedge.cornerQuads == 1 ? 1 : 0;
      }
      EXPECT_EQ(corners, wanted);
    }
  }
}

TEST(Background, IsTheSameEveryTime) {
  const Remeshed a = remesh(parts::cylinderSide(40, 1, 1.0, 3.0), 0.3);
  const Remeshed b = remesh(parts::cylinderSide(40, 1, 1.0, 3.0), 0.3);
  ASSERT_EQ(a.patches[0].surface.vertexCount(), b.patches[0].surface.vertexCount());
  for (const VertexId v : a.patches[0].surface.vertices()) {
    EXPECT_EQ(a.patches[0].surface.position(v), b.patches[0].surface.position(v));
  }
}

TEST(Background, StopsWhenAsked) {
  class Stop final : public Progress {
    bool report(Stage, double) override { return --left_ > 0; }
    int left_ = 3;
  } stop;
  const Remeshed r = remesh(parts::disk(32, 1.0), 0.5);
  const Result<BackgroundResult> result = buildBackground(r.mesh, r.brep, 0, r.field, r.divided, {}, stop);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

TEST(Background, FollowsSizesInsideFaces) {
  // Two triangles in the plane, and a fine curved face.
  const TriangleMesh flat = parts::sheet({0.0, 10.0}, {0.0, 10.0}, [](int, int) { return true; });
  SizingOptions options;
  options.vertexSize = {0.3, 1.3, 0.3, 1.3};
  const Remeshed r = remesh(flat, options);
  const Patch& patch = r.patches.at(0);
  for (const VertexId v : patch.surface.vertices()) {
    EXPECT_NEAR(patch.size[v], 0.3 + 0.1 * patch.surface.position(v).x, 0.01);
  }
  for (const HalfedgeId h : patch.surface.halfedges()) {
    EXPECT_LT(patch.surface.length(h), 2.5 * patch.size[patch.surface.origin(h)]);
  }

  const TriangleMesh tube = parts::cylinderSide(48, 24, 1.0, 4.0);
  options.vertexSize.clear();
  for (const Vec3& p : tube.positions) options.vertexSize.push_back(0.05 + 0.1 * std::fabs(p.z - 2.0));
  const Remeshed bent = remesh(tube, options);
  for (const VertexId v : bent.patches.at(0).surface.vertices()) {
    const double wanted = 0.05 + 0.1 * std::fabs(bent.patches[0].surface.position(v).z - 2.0);
    EXPECT_NEAR(bent.patches[0].size[v], wanted, 0.1 * wanted);
  }
}

}  // namespace
}  // namespace qmcf
