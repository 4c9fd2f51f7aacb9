#include "qmcf/cleanup/cleanup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "cleanup/grid_mesh.hpp"
#include "field/patches.hpp"
#include "qmcf/base/random.hpp"
#include "qmcf/cleanup/subdivide.hpp"
#include "qmcf/quality/quality.hpp"
#include "qmcf/spatial/surface_tree.hpp"

namespace qmcf {
namespace {

CleanupResult clean(const FaceMesh& mesh, const Patch& patch, const CleanupOptions& options = {}) {
  SilentProgress silent;
  auto result = cleanUp(mesh, patch, surfaceTree(patch.surface), options, silent);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

/// The triangles of a patch, most of them in pairs that are drawn by lot.
FaceMesh randomlyPaired(const Patch& patch, std::uint64_t seed) {
  const Surface& surface = patch.surface;
  FaceMesh mesh = testing::verticesOf(patch);
  Random random(seed);
  std::vector<char> used(surface.triangleCount(), 0);
  for (const TriangleId t : surface.triangles()) {
    if (used[t.index()] != 0) continue;
    used[t.index()] = 1;
    const auto corners = surface.corners(t);
    Element element{corners[0].value, corners[1].value, corners[2].value, kNone};
    const int start = static_cast<int>(random.uniform(0.0, 3.0));
    for (int k = 0; k < 3 && element[3] == kNone; ++k) {
      const HalfedgeId h(3 * t.value + (k + start) % 3);
      const HalfedgeId w = surface.twin(h);
      if (!w.valid() || used[Surface::triangle(w).index()] != 0 || random.uniform(0.0, 1.0) < 0.3) continue;
      used[Surface::triangle(w).index()] = 1;
      element = {surface.origin(surface.prev(h)).value, surface.origin(h).value, surface.origin(surface.prev(w)).value,
                 surface.origin(w).value};
    }
    mesh.elements.push_back(element);
  }
  return mesh;
}

/// The grid of a square of 6 x 6 cells, with a vertex inside one of its quads that is joined to two opposite corners:
/// two quads with a doublet between them.
FaceMesh gridWithDoublet(const Patch& square) {
  FaceMesh mesh = testing::gridMesh(square, 6);
  const Element quad = mesh.elements[14];
  const auto at = [&](std::size_t i) { return mesh.positions[static_cast<std::size_t>(quad[i])]; };
  const auto middle = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back((at(0) + at(1) + at(2) + at(3)) * 0.25);
  mesh.normals.push_back({0, 0, 1});
  mesh.locations.push_back(mesh.locations[static_cast<std::size_t>(quad[0])]);
  mesh.patchVertex.push_back(kNone);
  mesh.elements[14] = {quad[0], quad[1], quad[2], middle};
  mesh.elements.push_back({quad[0], middle, quad[2], quad[3]});
  return mesh;
}

/// Of a part that is this patch alone: which triangle of it each of the patch's is.
std::vector<std::int32_t> ownTriangles(const Patch& patch) {
  std::vector<std::int32_t> triangleOf(patch.surface.triangleCount());
  std::iota(triangleOf.begin(), triangleOf.end(), 0);
  return triangleOf;
}

TEST(CleanUp, LeavesAPerfectGridAlone) {
  const Patch patch = testing::makeSquare(6);
  const FaceMesh grid = testing::gridMesh(patch, 6);
  const CleanupResult result = clean(grid, patch);
  EXPECT_EQ(result.mesh.elements.size(), 36U);
  EXPECT_NEAR(result.worstShape, 1.0, 1e-9);
  for (std::size_t v = 0; v < grid.positions.size(); ++v)
    EXPECT_LT(distance(result.mesh.positions[v], grid.positions[v]), 1e-9);
}

TEST(CleanUp, RelaxesNoiseBackToTheGrid) {
  const Patch patch = testing::makeSquare(8);
  FaceMesh noisy = testing::gridMesh(patch, 8);
  Random random(3);
  for (std::size_t v = 0; v < noisy.positions.size(); ++v) {
    if (noisy.patchVertex[v] != kNone) continue;
    noisy.positions[v] += {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0.0};
  }
  const CleanupResult result = clean(noisy, patch);
  EXPECT_GT(result.worstShape, 0.99);
}

TEST(CleanUp, UndoesADoubletAndABadRotation) {
  const Patch patch = testing::makeSquare(6);
  const FaceMesh mesh = gridWithDoublet(patch);
  const CleanupResult result = clean(mesh, patch);
  EXPECT_EQ(result.mesh.elements.size(), 36U);
  EXPECT_EQ(result.mesh.positions.size(), 49U);
  EXPECT_GT(result.worstShape, 0.99);
}

TEST(CleanUp, PairsTrianglesOfASplitQuad) {
  const Patch patch = testing::makeSquare(5);
  FaceMesh mesh = testing::gridMesh(patch, 5);
  const Element quad = mesh.elements[12];
  mesh.elements[12] = {quad[0], quad[1], quad[2], kNone};
  mesh.elements.push_back({quad[0], quad[2], quad[3], kNone});
  const CleanupResult result = clean(mesh, patch);
  EXPECT_EQ(result.statistics.pairs, 1);
  for (const Element& element : result.mesh.elements) EXPECT_EQ(cornerCount(element), 4U);
}

/// The grid of a square of n x n cells with a row, the middle one, cut askew: a triangle at each end and parallelograms
/// between, from the second cell on.
FaceMesh gridWithRowAskew(const Patch& square, int n, int between) {
  FaceMesh mesh = testing::gridMesh(square, n);
  const auto first = mesh.elements.begin() + n / 2 * n + 1;
  const std::vector<Element> row(first, first + between + 1);
  first[0] = {row[0][0], row[0][1], row[0][3], kNone};
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    first[static_cast<std::ptrdiff_t>(i) + 1] = {row[i][1], row[i + 1][1], row[i][2], row[i][3]};
  }
  mesh.elements.push_back({row.back()[1], row.back()[2], row.back()[3], kNone});
  return mesh;
}

TEST(CleanUp, BridgesTrianglesWithQuadsBetween) {
  const Patch patch = testing::makeSquare(8);
  for (int between = 1; between <= 3; ++between) {
    const CleanupResult result = clean(gridWithRowAskew(patch, 8, between), patch);
    EXPECT_EQ(result.mesh.elements.size(), 64U) << between;
    EXPECT_EQ(result.statistics.refills, 1) << between;  // Without remeshing a larger region.
    EXPECT_EQ(result.statistics.cavities, 0) << between;
    for (const Element& element : result.mesh.elements) EXPECT_EQ(cornerCount(element), 4U) << between;
    EXPECT_GT(result.worstShape, 0.99) << between;
  }
}

TEST(CleanUp, PairsTrianglesFarFromEachOther) {
  // No region around one of them reaches the other before it is too large for a pattern.
  const Patch patch = testing::makeSquare(30);
  for (const int between : {10, 16, 26}) {
    const CleanupResult result = clean(gridWithRowAskew(patch, 30, between), patch);
    EXPECT_EQ(result.mesh.elements.size(), 900U) << between;
    EXPECT_EQ(result.statistics.pairs, 1) << between;
    for (const Element& element : result.mesh.elements) EXPECT_EQ(cornerCount(element), 4U) << between;
    EXPECT_GT(result.worstShape, 0.99) << between;
  }
}

TEST(CleanUp, TwoOppositeDipolesGiveWayToAGrid) {
  const Patch patch = testing::makeSquare(8);
  FaceMesh mesh = testing::gridMesh(patch, 8);
  // The diagonal of two quads beside each other is turned: four irregular vertices in the middle.
  const Element a = mesh.elements[3 * 8 + 3];
  const Element b = mesh.elements[3 * 8 + 4];
  mesh.elements[3 * 8 + 3] = {a[0], a[1], b[1], b[2]};
  mesh.elements[3 * 8 + 4] = {a[0], b[2], a[2], a[3]};
  const CleanupResult result = clean(mesh, patch);
  EXPECT_EQ(result.mesh.elements.size(), 64U);
  EXPECT_GT(result.worstShape, 0.95);
}

/// The same mesh with its vertices in the opposite order.
FaceMesh renumbered(FaceMesh mesh) {
  std::reverse(mesh.positions.begin(), mesh.positions.end());
  std::reverse(mesh.normals.begin(), mesh.normals.end());
  std::reverse(mesh.locations.begin(), mesh.locations.end());
  std::reverse(mesh.patchVertex.begin(), mesh.patchVertex.end());
  const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
  for (Element& element : mesh.elements) {
    for (std::size_t c = 0; c < cornerCount(element); ++c) element[c] = last - element[c];
  }
  return mesh;
}

TEST(CleanUp, KnowsTheWantedElementsOfABoundaryVertexWhateverItsNumber) {
  const Patch patch = testing::makeSquare(8);
  FaceMesh mesh = testing::gridMesh(patch, 8);
  // An edge that ends on the boundary is turned: one node there has one element too few, the next one too many.
  const Element a = mesh.elements[3];
  const Element b = mesh.elements[4];
  mesh.elements[3] = {a[0], a[1], b[1], b[2]};
  mesh.elements[4] = {a[0], b[2], a[2], a[3]};
  const FaceMesh reversed = renumbered(std::move(mesh));
  const CleanupResult result = clean(reversed, patch);
  EXPECT_EQ(result.mesh.elements.size(), 64U);
  EXPECT_GT(result.worstShape, 0.95);
}

TEST(Subdivide, CutsQuadrilateralsInFourAndTrianglesInThree) {
  const Patch patch = testing::makeSquare(4);
  FaceMesh mesh = testing::gridMesh(patch, 4);
  const Element quad = mesh.elements[5];
  mesh.elements[5] = {quad[0], quad[1], quad[2], kNone};
  mesh.elements.push_back({quad[0], quad[2], quad[3], kNone});
  IdMap<HalfedgeId, Vec3> middle(patch.surface.halfedgeCount());
  std::size_t boundary = 0;
  for (const HalfedgeId h : IdRange<HalfedgeId>(patch.surface.halfedgeCount())) {
    if (!patch.surface.isBoundary(h)) continue;
    ++boundary;
    middle[h] =
        (patch.surface.position(patch.surface.origin(h)) + patch.surface.position(patch.surface.target(h))) * 0.5;
  }
  const SubdividedFace cut = subdivide(mesh, patch, surfaceTree(patch.surface), middle);
  ASSERT_EQ(cut.mesh.elements.size(), 15U * 4U + 2U * 3U);
  for (const Element& element : cut.mesh.elements) EXPECT_EQ(cornerCount(element), 4U);
  // Euler: vertices - edges + elements = 1, and every edge has been halved.
  EXPECT_EQ(cut.mesh.positions.size(), 25U + 41U + 17U);
  EXPECT_EQ(static_cast<std::size_t>(std::count_if(cut.boundaryEdge.begin(), cut.boundaryEdge.end(),
                                                   [](HalfedgeId h) { return h.valid(); })),
            boundary);
  double area = 0.0;
  for (const Element& e : cut.mesh.elements) {
    const auto p = [&](std::size_t i) { return cut.mesh.positions[static_cast<std::size_t>(e[i])]; };
    const double own = 0.5 * cross(p(2) - p(0), p(3) - p(1)).z;
    EXPECT_GT(own, 0.0);
    area += own;
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(CleanUp, WithoutTopologyKeepsTheConnectivity) {
  const Patch patch = testing::makeSquare(5);
  FaceMesh mesh = testing::gridMesh(patch, 5);
  // Two quads side by side, divided the other way: two vertices with three elements and two with five.
  const Element left = mesh.elements[12];
  const Element right = mesh.elements[13];
  mesh.elements[12] = {left[0], left[1], right[1], right[2]};
  mesh.elements[13] = {left[0], right[2], left[2], left[3]};
  EXPECT_NE(clean(mesh, patch).mesh.elements, mesh.elements);
  CleanupOptions options;
  options.topology = false;
  EXPECT_EQ(clean(mesh, patch, options).mesh.elements, mesh.elements);
}

TEST(CleanUp, JoinsTrianglesToTheGoodQuadThatTheyAre) {
  const Patch patch = testing::makeSquare(5);
  const FaceMesh grid = testing::gridMesh(patch, 5);
  const auto cutAt = [&grid](std::size_t e) {
    FaceMesh mesh = grid;
    const Element quad = mesh.elements[e];
    mesh.elements[e] = {quad[0], quad[1], quad[2], kNone};
    mesh.elements.push_back({quad[0], quad[2], quad[3], kNone});
    return mesh;
  };
  CleanupOptions options;
  options.topology = false;
  const CleanupResult result = clean(cutAt(12), patch, options);
  EXPECT_EQ(result.statistics.joins, 1);
  EXPECT_EQ(result.mesh.elements.size(), grid.elements.size());
  // With a corner drawn to between its neighbours, a quad is better as two triangles.
  FaceMesh flat = cutAt(0);
  const auto at = [&](std::size_t corner) -> Vec3& {
    return flat.positions[static_cast<std::size_t>(grid.elements[0][corner])];
  };
  at(2) = at(2) * 0.05 + (at(1) + at(3)) * 0.475;
  options.sweeps = 0;
  EXPECT_EQ(clean(flat, patch, options).statistics.joins, 0);
}

TEST(CleanUp, MendsQuadrilateralsWithoutTriangles) {
  const Patch patch = testing::makeSquare(6);
  const FaceMesh mesh = gridWithDoublet(patch);
  // One of the two quads at the doublet is flat or reflex there wherever it lies.
  CleanupOptions options;
  options.topology = false;
  options.quadsOnly = true;
  const CleanupResult result = clean(mesh, patch, options);
  EXPECT_TRUE(result.degenerate.empty());
  EXPECT_GT(result.worstShape, 0.2);
  for (const Element& element : result.mesh.elements) EXPECT_EQ(cornerCount(element), 4U);
  // What stays on the boundary is known by the vertex that it was.
  ASSERT_EQ(result.before.size(), result.mesh.positions.size());
  std::size_t boundary = 0;
  for (std::size_t v = 0; v < result.before.size(); ++v) {
    if (result.mesh.patchVertex[v] == kNone) continue;
    ++boundary;
    ASSERT_NE(result.before[v], kNone);
    const auto was = static_cast<std::size_t>(result.before[v]);
    EXPECT_EQ(mesh.patchVertex[was], result.mesh.patchVertex[v]);
    EXPECT_EQ(mesh.positions[was], result.mesh.positions[v]);
  }
  EXPECT_EQ(boundary, 24U);
}

TEST(CleanUp, MendsTheSameWherePartAndFaceAreOne) {
  const Patch patch = testing::makeSquare(6);
  const TriangleBvh tree = surfaceTree(patch.surface);
  const FaceMesh mesh = gridWithDoublet(patch);
  CleanupOptions options;
  options.topology = false;
  options.quadsOnly = true;
  const CleanupResult alone = clean(mesh, patch, options);
  const std::vector<std::int32_t> triangleOf = ownTriangles(patch);
  const WholePart whole{tree, triangleOf};
  options.part = &whole;
  const CleanupResult checked = clean(mesh, patch, options);
  EXPECT_EQ(checked.mesh.elements, alone.mesh.elements);
  EXPECT_EQ(checked.mesh.positions, alone.mesh.positions);
}

TEST(CleanUp, ChangesConnectionsBeforeItCutsWhereTheCheckAgainstThePartIsKnown) {
  const Patch patch = testing::makeSquare(6);
  const TriangleBvh tree = surfaceTree(patch.surface);
  const FaceMesh mesh = gridWithDoublet(patch);
  CleanupOptions options;
  options.topology = false;
  const CleanupResult cut = clean(mesh, patch, options);
  EXPECT_GT(cut.statistics.cuts, 0);
  const std::vector<std::int32_t> triangleOf = ownTriangles(patch);
  const WholePart whole{tree, triangleOf};
  options.part = &whole;
  const CleanupResult mended = clean(mesh, patch, options);
  EXPECT_TRUE(mended.degenerate.empty());
  EXPECT_EQ(mended.statistics.cuts, 0);
  for (const Element& element : mended.mesh.elements) EXPECT_EQ(cornerCount(element), 4U);
}

TEST(CleanUp, CutsAStraightCornerWhateverTheNormalsSay) {
  // Where the outline turns back, the smooth normals face against a triangle of the part itself.
  Patch patch = testing::makeSquare(2);
  for (const VertexId v : patch.surface.vertices()) patch.normal[v] = {0, 0, -1};
  FaceMesh mesh = testing::gridMesh(patch, 2);
  // The two quads at the bottom as one with a straight corner and two triangles beside it.
  const Element left = mesh.elements[0];
  const Element right = mesh.elements[1];
  mesh.elements[0] = {left[0], left[1], right[1], left[2]};
  mesh.elements[1] = {left[0], left[2], left[3], kNone};
  mesh.elements.push_back({right[1], right[2], right[3], kNone});
  CleanupOptions options;
  options.topology = false;
  options.sweeps = 0;
  const CleanupResult result = clean(mesh, patch, options);
  EXPECT_TRUE(result.degenerate.empty());
  EXPECT_EQ(result.statistics.cuts, 1);
  // Its halves make good quads with the triangles beside it.
  EXPECT_EQ(result.statistics.joins, 2);
  EXPECT_EQ(result.mesh.elements.size(), 4U);
}

TEST(CleanUp, KeepsThinHandles) {
  // On a ring of a few elements around, a region of three or four of them can wind around it; filled like a disc, it
  // would close the hole.
  for (const auto& [around, along] : {std::pair{3, 3}, {3, 4}}) {
    const Patch patch = testing::makeTorus(around, along);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      const CleanupResult result = clean(randomlyPaired(patch, seed), patch);
      const IndexLedger ledger = indexLedger(result.mesh.positions, result.mesh.elements);
      EXPECT_TRUE(ledger.closes()) << around << " " << along << " " << seed;
      EXPECT_EQ(ledger.sum(), 0) << around << " " << along << " " << seed;
    }
  }
}

TEST(Subdivide, PutsNewVerticesExactlyBetweenWhereAsked) {
  const Patch patch = testing::makeCylinder(8, 2, 2.0);
  FaceMesh mesh = testing::verticesOf(patch);
  IdMap<HalfedgeId, Vec3> middle(patch.surface.halfedgeCount());
  for (const HalfedgeId h : IdRange<HalfedgeId>(patch.surface.halfedgeCount())) {
    middle[h] =
        (patch.surface.position(patch.surface.origin(h)) + patch.surface.position(patch.surface.target(h))) * 0.5;
  }
  for (const TriangleId t : patch.surface.triangles()) {
    const auto corners = patch.surface.corners(t);
    mesh.elements.push_back({corners[0].value, corners[1].value, corners[2].value, kNone});
  }
  // Onto a sphere around it, where what is not asked to stay between would go.
  const Patch sphere = testing::makeSphere(4);
  const auto cut = subdivide(mesh, patch, surfaceTree(sphere.surface), middle, NewVertices::between);
  for (const Element& element : cut.mesh.elements) {
    const auto p = [&](std::size_t c) { return cut.mesh.positions[static_cast<std::size_t>(element[c])]; };
    const Vec3 normal = cross(p(1) - p(0), p(3) - p(0));
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_GT(dot(normalized(cross(p((c + 1) % 4) - p(c), p((c + 3) % 4) - p(c))), normalized(normal)), 1.0 - 1e-9);
    }
  }
}

}  // namespace
}  // namespace qmcf
