#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/quality/quality.hpp"
#include "quality/shapes.hpp"

namespace qmcf {
namespace {

using test::append;
using test::quadCube;
using test::quadSheet;
using test::triangulated;

/// How many vertices with so many elements each: {elements, vertices}.
using Kinds = std::vector<std::array<std::int64_t, 2>>;

Kinds kindsOf(const std::vector<LedgerEntry>& entries) {
  Kinds kinds;
  for (const LedgerEntry& entry : entries) kinds.push_back({entry.elements, entry.vertices});
  return kinds;
}

IndexLedger ledgerOf(const QuadMesh& mesh) {
  IndexLedger ledger = indexLedger(mesh.positions, mesh.elements);
  EXPECT_TRUE(ledger.closes());
  return ledger;
}

/// A band of n x m quads whose short ends are joined, the second one upside down if `twisted`.
QuadMesh band(int n, int m, bool twisted) {
  QuadMesh mesh;
  mesh.positions.resize(static_cast<std::size_t>(n * (m + 1)));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) mesh.positions[v] = {double(v), double(v * v), 0.0};
  const auto at = [&](int i, int j) { return i < n ? i * (m + 1) + j : (twisted ? m - j : j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) mesh.elements.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  return mesh;
}

/// An n x m torus.
QuadMesh torus(int n, int m) {
  QuadMesh mesh = band(n, m, false);
  for (Element& element : mesh.elements) {
    for (std::int32_t& v : element) v = v % (m + 1) == m ? v - m : v;
  }
  return mesh;
}

/// Each quad cut along a diagonal.
QuadMesh cut(QuadMesh mesh) {
  const TriangleMesh triangles = triangulated(mesh);
  mesh.elements.clear();
  for (const auto& t : triangles.triangles) mesh.elements.push_back({t[0], t[1], t[2], kNone});
  return mesh;
}

TEST(IndexLedger, RectangleOwesItsFourCorners) {
  const IndexLedger ledger = ledgerOf(quadSheet(5, 3, {}, {5, 0, 0}, {0, 3, 0}));
  EXPECT_EQ(kindsOf(ledger.interior), Kinds{});
  EXPECT_EQ(kindsOf(ledger.boundary), (Kinds{{1, 4}}));
  EXPECT_EQ(ledger.boundaryIndex, 4);
  EXPECT_EQ(ledger.fourEuler, 4);
  EXPECT_EQ(ledger.sheets, 1);
}

TEST(IndexLedger, CubeOwesItsEightCorners) {
  const IndexLedger ledger = ledgerOf(quadCube(4));
  EXPECT_EQ(kindsOf(ledger.interior), (Kinds{{3, 8}}));
  EXPECT_EQ(ledger.boundaryIndex, 0);
  EXPECT_EQ(ledger.fourEuler, 8);
}

TEST(IndexLedger, TorusAndBandsOweNothing) {
  for (const QuadMesh& mesh : {torus(7, 5), band(6, 3, false), band(6, 3, true)}) {
    const IndexLedger ledger = ledgerOf(mesh);
    EXPECT_EQ(kindsOf(ledger.interior), Kinds{});
    EXPECT_EQ(kindsOf(ledger.boundary), Kinds{});
    EXPECT_EQ(ledger.fourEuler, 0);
    EXPECT_EQ(ledger.sheets, 1);
  }
}

TEST(IndexLedger, EachTriangleIsWorthOne) {
  // A tetrahedron: four vertices of three elements and four triangles are 4 + 4 = 4 * 2.
  QuadMesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.elements = {{0, 2, 1, kNone}, {0, 1, 3, kNone}, {1, 2, 3, kNone}, {2, 0, 3, kNone}};
  const IndexLedger small = ledgerOf(tetrahedron);
  EXPECT_EQ(small.interiorIndex, 4);
  EXPECT_EQ(small.triangles, 4);
  EXPECT_EQ(small.fourEuler, 8);

  // Two triangles more on a torus are two units, which vertices with five elements pay back.
  QuadMesh mesh = torus(7, 5);
  const Element e = mesh.elements[9];
  mesh.elements[9] = {e[0], e[1], e[2], kNone};
  mesh.elements.push_back({e[0], e[2], e[3], kNone});
  const IndexLedger mixed = ledgerOf(mesh);
  EXPECT_EQ(mixed.triangles, 2);
  EXPECT_EQ(kindsOf(mixed.interior), (Kinds{{5, 2}}));
  EXPECT_EQ(mixed.interiorIndex, -2);

  // Of triangles alone, six at each inner vertex.
  const IndexLedger triangles = ledgerOf(cut(quadSheet(3, 3, {}, {3, 0, 0}, {0, 3, 0})));
  EXPECT_EQ(triangles.triangles, 18);
  EXPECT_EQ(kindsOf(triangles.interior), (Kinds{{6, 4}}));
  EXPECT_EQ(triangles.sum(), 4);
}

TEST(IndexLedger, HolesAreOwedByTheirCorners) {
  QuadMesh mesh = quadSheet(5, 5, {}, {5, 0, 0}, {0, 5, 0});
  mesh.elements.erase(mesh.elements.begin() + 12);
  const IndexLedger ledger = ledgerOf(mesh);
  EXPECT_EQ(kindsOf(ledger.boundary), (Kinds{{1, 4}, {3, 4}}));
  EXPECT_EQ(ledger.sum(), 0);
}

TEST(IndexLedger, NonManifoldMeshesAreTakenSheetBySheet) {
  QuadMesh fan;  // Three rectangles along one edge.
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, 2, 0}), true);
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, 0, 2}), true);
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, -2, 0}), true);
  const IndexLedger three = ledgerOf(fan);
  EXPECT_EQ(three.sheets, 3);
  EXPECT_EQ(kindsOf(three.boundary), (Kinds{{1, 12}}));
  EXPECT_EQ(three.fourEuler, 12);

  // Of two cubes that share an edge, where four elements meet, each is cut open along it and becomes a disc.
  QuadMesh cubes = quadCube(2);
  QuadMesh other = quadCube(2);
  for (Vec3& p : other.positions) p += Vec3{2, 2, 0};
  append(cubes, other, true);
  const IndexLedger discs = ledgerOf(cubes);
  EXPECT_EQ(discs.sheets, 2);
  EXPECT_EQ(discs.fourEuler, 8);
  // Two that share a point are two closed sheets.
  QuadMesh touching = quadCube(2);
  for (Vec3& p : other.positions) p += Vec3{0, 0, 2};
  append(touching, other, true);
  const IndexLedger two = ledgerOf(touching);
  EXPECT_EQ(two.sheets, 2);
  EXPECT_EQ(two.fourEuler, 16);
  EXPECT_EQ(kindsOf(two.interior), (Kinds{{3, 16}}));
}

TEST(IndexLedger, MalformedElementsTakeNoPart) {
  QuadMesh mesh = quadSheet(2, 2, {}, {2, 0, 0}, {0, 2, 0});
  mesh.elements.push_back({0, 1, 1, 2});
  mesh.elements.push_back({0, 1, 99, kNone});
  EXPECT_EQ(ledgerOf(mesh).fourEuler, 4);
  EXPECT_EQ(indexLedger({}, {}).sum(), 0);
}

TEST(IndexLedger, IsHeldAgainstThePart) {
  const auto check = [](const QualityReport& report) {
    for (const ValidityCheck& candidate : report.checks) {
      if (candidate.name == "indexLedger") return candidate;
    }
    ADD_FAILURE() << "no such check";
    return ValidityCheck{};
  };
  const TriangleMesh part = triangulated(quadCube(3));
  const QualityReport whole = measureQuality(quadCube(5), &part, {});
  EXPECT_EQ(check(whole).status, CheckStatus::pass);
  EXPECT_EQ(whole.ledger.partFourEuler, 8);

  QuadMesh open = quadCube(3);
  open.elements.pop_back();
  const QualityReport report = measureQuality(open, &part, {});
  EXPECT_EQ(check(report).status, CheckStatus::fail);
  EXPECT_FALSE(report.ledger.closes());
  EXPECT_EQ(report.ledger.sum(), 4);

  QuadMesh fan;
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, 2, 0}), true);
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, 0, 2}), true);
  append(fan, quadSheet(3, 2, {}, {3, 0, 0}, {0, -2, 0}), true);
  const TriangleMesh sheets = triangulated(fan);
  EXPECT_EQ(check(measureQuality(fan, &sheets, {})).status, CheckStatus::skip);
}

}  // namespace
}  // namespace qmcf
