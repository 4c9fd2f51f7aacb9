#include "qmcf/topology/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"
#include "topology/shapes.hpp"

namespace qmcf {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

RepairedMesh run(const TriangleMesh& mesh, RepairOptions options = {}) {
  SilentProgress silent;
  auto result = repair(mesh, options, silent);
  EXPECT_TRUE(result.ok());
  return result.ok() ? std::move(result).value() : RepairedMesh{};
}

std::int64_t countOf(const RepairedMesh& result, const std::string& defect) {
  for (const RepairItem& item : result.items) {
    if (item.defect == defect) return item.count;
  }
  return 0;
}

/// Every edge has two triangles that run along it in opposite directions.
bool isClosedAndOriented(const TriangleMesh& mesh) {
  std::map<Pair, int> directed;
  for (const auto& c : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++directed[{c[i], c[(i + 1) % 3]}];
  }
  return std::all_of(directed.begin(), directed.end(), [&](const auto& entry) {
    const auto reverse = directed.find({entry.first.second, entry.first.first});
    return entry.second == 1 && reverse != directed.end();
  });
}

double volumeOf(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& c : mesh.triangles) {
    const auto p = [&](std::size_t i) { return mesh.positions[std::size_t(c[i])]; };
    volume += dot(p(0), cross(p(1), p(2))) / 6.0;
  }
  return volume;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& c : mesh.triangles) {
    const auto p = [&](std::size_t i) { return mesh.positions[std::size_t(c[i])]; };
    area += 0.5 * norm(cross(p(1) - p(0), p(2) - p(0)));
  }
  return area;
}

TEST(Repair, WeldsSoupAndTreatsMinusZeroAsZero) {
  TriangleMesh soup;
  const TriangleMesh cube = shapes::cubeSoup(2);
  Random random(1);
  for (const auto& c : cube.triangles) {
    for (const std::int32_t v : c) {
      Vec3 p = cube.positions[std::size_t(v)];
      if (p.x == 0.0 && random.uniform() < 0.5) p.x = -0.0;
      soup.positions.push_back(p);
    }
    const auto n = static_cast<std::int32_t>(soup.positions.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  const RepairedMesh result = run(soup);
  EXPECT_EQ(result.mesh.positions.size(), 26U);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volumeOf(result.mesh), 1.0, 1e-12);
  EXPECT_EQ(countOf(result, "unsharedVertices"), std::int64_t(soup.positions.size()) - 26);
}

TEST(Repair, CleanMeshIsLeftAlone) {
  const TriangleMesh torus = shapes::torus(20, 10, 3.0, 1.0);
  const RepairedMesh result = run(torus);
  EXPECT_TRUE(result.items.empty());
  EXPECT_EQ(result.mesh.triangles, torus.triangles);
  EXPECT_EQ(result.mesh.positions, torus.positions);
}

TEST(Repair, DropsRepeatedCornersDuplicatesAndUnusedVertices) {
  TriangleMesh mesh = shapes::square(3);
  const std::size_t good = mesh.triangles.size();
  mesh.positions.push_back({9.0, 9.0, 9.0});
  mesh.triangles.push_back({0, 0, 1});
  auto again = mesh.triangles[2];
  std::rotate(again.begin(), again.begin() + 1, again.end());
  mesh.triangles.push_back(again);
  const RepairedMesh result = run(mesh);
  EXPECT_EQ(result.mesh.triangles.size(), good);
  EXPECT_EQ(result.mesh.positions.size(), 16U);
  EXPECT_EQ(countOf(result, "degenerateTriangles"), 1);
  EXPECT_EQ(countOf(result, "duplicateTriangles"), 1);
  for (std::size_t t = 0; t < good; ++t) EXPECT_EQ(result.triangleOrigin[t], std::int64_t(t));
}

TEST(Repair, KeepsOneSideOfADoubledSheet) {
  TriangleMesh mesh = shapes::square(3);
  const std::size_t good = mesh.triangles.size();
  for (std::size_t t = 0; t < good; ++t) {
    auto c = mesh.triangles[t];
    std::swap(c[0], c[1]);
    mesh.triangles.push_back(c);
  }
  const RepairedMesh result = run(mesh);
  EXPECT_EQ(result.mesh.triangles.size(), good);
  EXPECT_EQ(countOf(result, "zeroThicknessSheets"), std::int64_t(good));
}

TEST(Repair, RemovesAZeroThicknessFinFromASolid) {
  TriangleMesh mesh = shapes::repaired(shapes::cubeSoup(2));
  const auto tip = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({2.0, 2.0, 2.0});
  const auto c = mesh.triangles[0];
  mesh.triangles.push_back({c[0], c[1], tip});
  mesh.triangles.push_back({c[1], c[0], tip});
  const RepairedMesh result = run(mesh);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(areaOf(result.mesh), 6.0, 1e-12);
  EXPECT_EQ(countOf(result, "zeroThicknessFins"), 1);
}

/// A closed cube one triangle of which is replaced such that a zero-area triangle closes the gap.
TEST(Repair, CapIsRemovedWithoutOpeningACrack) {
  TriangleMesh mesh = shapes::repaired(shapes::cubeSoup(1));
  const auto c = mesh.triangles[0];
  const Vec3 middle = (mesh.positions[std::size_t(c[0])] + mesh.positions[std::size_t(c[1])]) * 0.5;
  const auto m = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back(middle);
  mesh.triangles[0] = {c[0], m, c[2]};
  mesh.triangles.push_back({m, c[1], c[2]});
  mesh.triangles.push_back({c[0], c[1], m});
  ASSERT_TRUE(isClosedAndOriented(mesh));
  const RepairedMesh result = run(mesh);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_EQ(countOf(result, "zeroAreaTriangles"), 1);
  EXPECT_EQ(result.mesh.positions.size(), 9U);
  EXPECT_EQ(result.mesh.triangles.size(), 14U);
  EXPECT_NEAR(areaOf(result.mesh), 6.0, 1e-12);
  // Both halves of the edge that the cap lay along are told.
  ASSERT_EQ(result.flatEdges.size(), 2U);
  double length = 0.0;
  for (const auto& ends : result.flatEdges) {
    length += distance(result.mesh.positions[std::size_t(ends[0])], result.mesh.positions[std::size_t(ends[1])]);
  }
  EXPECT_NEAR(length, distance(mesh.positions[std::size_t(c[0])], mesh.positions[std::size_t(c[1])]), 1e-12);
}

TEST(Repair, StripOfCollinearPointsIsRemovedWithoutOpeningACrack) {
  // Ten collinear points on one side of an edge, none on the other, a fan of zero-area triangles between.
  TriangleMesh mesh;
  const int n = 10;
  for (int i = 0; i <= n; ++i) mesh.positions.push_back({double(i), 0.0, 0.0});
  mesh.positions.push_back({5.0, 3.0, 1.0});
  mesh.positions.push_back({5.0, -3.0, 1.0});
  mesh.positions.push_back({5.0, 0.0, 5.0});
  const std::int32_t left = n + 1;
  const std::int32_t right = n + 2;
  const std::int32_t top = n + 3;
  for (std::int32_t i = 0; i < n; ++i) mesh.triangles.push_back({i + 1, i, left});
  for (std::int32_t i = 1; i < n; ++i) mesh.triangles.push_back({0, i, i + 1});
  mesh.triangles.push_back({0, n, right});
  mesh.triangles.insert(mesh.triangles.end(), {{0, top, left}, {left, top, n}, {right, top, 0}, {n, top, right}});
  ASSERT_TRUE(isClosedAndOriented(mesh));
  const double area = areaOf(mesh);
  const RepairedMesh result = run(mesh);
  EXPECT_EQ(countOf(result, "zeroAreaTriangles"), n - 1);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(areaOf(result.mesh), area, 1e-9);
  for (const auto& c : result.mesh.triangles) {
    const auto p = [&](std::size_t i) { return result.mesh.positions[std::size_t(c[i])]; };
    EXPECT_GT(norm(cross(p(1) - p(0), p(2) - p(0))), 1e-3);
  }
}

TEST(Repair, NeedleIsCollapsedWithoutOpeningACrack) {
  TriangleMesh mesh = shapes::repaired(shapes::cubeSoup(2));
  // Pull one corner apart into two vertices 1e-12 from each other.
  const auto c = mesh.triangles[0];
  const auto twin = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back(mesh.positions[std::size_t(c[0])] + Vec3{1e-12, 0.0, 0.0});
  mesh.triangles[0] = {twin, c[1], c[2]};
  mesh.triangles.push_back({c[0], c[1], twin});
  mesh.triangles.push_back({c[0], twin, c[2]});
  ASSERT_TRUE(isClosedAndOriented(mesh));
  const RepairedMesh result = run(mesh);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_EQ(result.mesh.positions.size(), 26U);
  EXPECT_EQ(result.mesh.triangles.size(), 48U);
}

TEST(Repair, ClosesGapsThatAreSmallerThanTheTolerance) {
  TriangleMesh mesh = shapes::cubeSoup(4);
  Random random(5);
  for (Vec3& p : mesh.positions) {
    p = p + Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)} * 2e-7;
  }
  const RepairedMesh result = run(mesh);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_EQ(result.mesh.positions.size(), 98U);
  EXPECT_EQ(countOf(result, "nearlyEqualVertices"), 6 * 25 - 98);
  EXPECT_EQ(shapes::checkedBrep(result.mesh).faces.size(), 6U);

  // Without leave to modify, the gaps are counted and stay.
  const RepairedMesh report = run(mesh, {false});
  EXPECT_EQ(report.mesh.positions.size(), mesh.positions.size());
  EXPECT_EQ(countOf(report, "nearlyEqualVertices"), 6 * 25 - 98);
}

TEST(Repair, LeavesWhatIsFurtherApart) {
  const TriangleMesh apart = shapes::join(shapes::square(3), shapes::moved(shapes::square(3), [](const Vec3& p) {
                                            return p + Vec3{1.0 + 1e-4, 0.0, 0.0};
                                          }));
  const RepairedMesh result = run(apart);
  EXPECT_TRUE(result.items.empty());
  EXPECT_EQ(shapes::checkedBrep(result.mesh).bodies.size(), 2U);
}

TEST(Repair, AStrayTriangleFarAwayDoesNotMakeDetailsGaps) {
  TriangleMesh part = shapes::square(20);
  const auto first = static_cast<std::int32_t>(part.positions.size());
  part.positions.insert(part.positions.end(), {{1e6, 1e6, 0.0}, {1e6 + 1.0, 1e6, 0.0}, {1e6, 1e6 + 1.0, 0.0}});
  part.triangles.push_back({first, first + 1, first + 2});
  const RepairedMesh result = run(part);
  EXPECT_TRUE(result.items.empty());
  EXPECT_EQ(result.mesh.triangles.size(), part.triangles.size());
}

TEST(Repair, MergesCrowdsOfVerticesToOnesThatAreApart) {
  // Triangles with a corner each in a crowd far smaller than the tolerance; the other corners are nowhere near.
  constexpr double kCrowd = 1e-7;
  TriangleMesh part;
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    const auto first = static_cast<std::int32_t>(part.positions.size());
    part.positions.push_back({kCrowd * random.uniform(), kCrowd * random.uniform(), kCrowd * random.uniform()});
    const auto out = math::unitComplex(2.0 * math::kPi * i / 400);
    const auto next = math::unitComplex(2.0 * math::kPi * (i + 0.5) / 400);
    part.positions.push_back({out.real(), out.imag(), 0.0});
    part.positions.push_back({next.real(), next.imag(), 0.0});
    part.triangles.push_back({first, first + 1, first + 2});
  }
  const RepairedMesh result = run(part);
  EXPECT_EQ(countOf(result, "nearlyEqualVertices"), 399);
  EXPECT_EQ(result.mesh.positions.size(), 801U);
}

TEST(Repair, SplitsEdgesAtTJunctions) {
  // Each side of the cube is divided differently, so that no two sides fit.
  TriangleMesh cube;
  const std::array<int, 6> cells{1, 2, 3, 5, 7, 4};
  for (std::size_t side = 0; side < 6; ++side) {
    TriangleMesh all = shapes::cubeSoup(cells[side]);
    const std::size_t perSide = all.triangles.size() / 6;
    const auto begin = all.triangles.begin() + static_cast<std::ptrdiff_t>(side * perSide);
    all.triangles = {begin, begin + static_cast<std::ptrdiff_t>(perSide)};
    cube = shapes::join(cube, all);
  }
  const RepairedMesh result = run(cube);
  EXPECT_GT(countOf(result, "tJunctions"), 0);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volumeOf(result.mesh), 1.0, 1e-6);
  EXPECT_NEAR(areaOf(result.mesh), 6.0, 1e-6);
  const Brep brep = shapes::checkedBrep(result.mesh);
  EXPECT_EQ(brep.faces.size(), 6U);
  EXPECT_EQ(brep.edges.size(), 12U);
}

TEST(Repair, RemovesSliversAndKeepsTheSurfaceClosed) {
  // A torus with vertices almost on the middle of some edges: one sliver each.
  TriangleMesh mesh = shapes::torus(48, 24, 3.0, 1.0);
  const std::size_t good = mesh.triangles.size();
  for (std::size_t t = 0; t < good; t += 17) {
    const auto c = mesh.triangles[t];
    const auto m = static_cast<std::int32_t>(mesh.positions.size());
    const auto at = [&](std::size_t i) { return mesh.positions[std::size_t(c[i])]; };
    mesh.positions.push_back((at(0) + at(1)) * 0.5 + (at(2) - at(0)) * 1e-7);
    mesh.triangles[t] = {c[0], m, c[2]};
    mesh.triangles.push_back({m, c[1], c[2]});
    mesh.triangles.push_back({c[0], c[1], m});
  }
  const double area = areaOf(mesh);
  const RepairedMesh result = run(mesh);
  EXPECT_EQ(countOf(result, "sliverTriangles"), std::int64_t((good + 16) / 17));
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(areaOf(result.mesh), area, 1e-4);
  EXPECT_EQ(result.mesh.positions.size(), mesh.positions.size());
  EXPECT_EQ(shapes::checkedBrep(result.mesh).faces.size(), 1U);
}

TEST(Repair, OrientsRandomlyTurnedTrianglesOutward) {
  TriangleMesh mesh = shapes::torus(24, 12, 3.0, 1.0);
  const double volume = volumeOf(mesh);
  Random random(7);
  std::int64_t turned = 0;
  for (auto& c : mesh.triangles) {
    if (random.uniform() < 0.4) {
      std::swap(c[0], c[1]);
      ++turned;
    }
  }
  const RepairedMesh result = run(mesh);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volumeOf(result.mesh), volume, 1e-9);
  EXPECT_EQ(countOf(result, "misorientedTriangles"), turned);
}

TEST(Repair, TurnsShellsOutwardsOnlyInContradictoryFiles) {
  const auto inverted = [](TriangleMesh mesh) {
    for (auto& c : mesh.triangles) std::swap(c[0], c[1]);
    return mesh;
  };
  const TriangleMesh cube = shapes::repaired(shapes::cubeSoup(2));
  EXPECT_NEAR(volumeOf(run(inverted(cube)).mesh), -1.0, 1e-12);
  EXPECT_EQ(countOf(run(inverted(cube)), "inwardShells"), 1);

  TriangleMesh contradictory = inverted(cube);
  std::swap(contradictory.triangles[0][0], contradictory.triangles[0][1]);
  EXPECT_NEAR(volumeOf(run(contradictory).mesh), 1.0, 1e-12);

  const TriangleMesh hollow = shapes::join(cube, inverted(shapes::moved(cube, [](const Vec3& p) {
                                             return Vec3{0.25, 0.25, 0.25} + p * 0.5;
                                           })));
  EXPECT_NEAR(volumeOf(run(hollow).mesh), 1.0 - 0.125, 1e-12);
}

const RepairItem* itemOf(const RepairedMesh& result, const std::string& defect) {
  for (const RepairItem& item : result.items) {
    if (item.defect == defect) return &item;
  }
  return nullptr;
}

TEST(Repair, SaysWhichElementsEachItemIsAbout) {
  using Ids = std::vector<std::int64_t>;
  // Four squares of two triangles side by side; each defect has a place of its own.
  TriangleMesh mesh = shapes::grid(4, 1, [](double u, double v) { return Vec3{4.0 * u, v, 0.0}; });
  const auto add = [&](const Vec3& p) {
    mesh.positions.push_back(p);
    return static_cast<std::int32_t>(mesh.positions.size() - 1);
  };
  const std::int32_t unused = add({9, 9, 9});
  const std::int32_t twin = add(mesh.positions[0]);
  mesh.triangles.push_back({twin, 1, add({0.5, -1.0, 0.0})});  // 8: on the vertex 0 by another number
  mesh.triangles.push_back({3, 3, 4});                         // 9: no triangle
  mesh.triangles.push_back(mesh.triangles[2]);                 // 10: twice
  const std::int32_t third = add({2.5, 0.0, 1.0});
  mesh.triangles.push_back({2, 3, third});                                    // 11
  mesh.triangles.push_back({3, 2, add({2.5, -1.0, -1.0})});                   // 12: third triangle at edge 2 3
  mesh.triangles.push_back({4, add({5.0, 0.0, 1.0}), add({5.0, 1.0, 1.0})});  // 13: touches in vertex 4
  const RepairedMesh result = run(mesh);
  const auto idsOf = [&](const char* defect) {
    const RepairItem* const item = itemOf(result, defect);
    return item == nullptr ? Ids{} : item->elements;
  };
  EXPECT_EQ(idsOf("unusedVertices"), Ids{unused});
  EXPECT_EQ(idsOf("duplicateVertices"), Ids{twin});
  EXPECT_EQ(idsOf("degenerateTriangles"), Ids{9});
  EXPECT_EQ(idsOf("duplicateTriangles"), Ids{10});
  EXPECT_EQ(countOf(result, "nonManifoldEdges"), 1);
  EXPECT_EQ(idsOf("nonManifoldVertices"), Ids{4});
  for (const RepairItem& item : result.items) EXPECT_FALSE(item.action.empty());
}

TEST(Repair, CrackIsZippedAndSaysWhere) {
  // Two halves of a sheet, divided in 3 and in 4 along their common side: two inner vertices of the one lie on edges of
  // the other and three the other way round.
  const auto half = [](int cells, double left) {
    return shapes::grid(2, cells, [=](double u, double v) { return Vec3{left + u, v, 0.0}; });
  };
  const TriangleMesh left = half(3, 0.0);
  const TriangleMesh mesh = shapes::join(left, half(4, 1.0));
  const RepairedMesh result = run(mesh);
  const RepairItem* const zipped = itemOf(result, "tJunctions");
  ASSERT_NE(zipped, nullptr);
  EXPECT_EQ(zipped->count, 5);
  for (const std::int64_t v : zipped->elements) {
    EXPECT_EQ(mesh.positions[std::size_t(v)].x, 1.0);
    EXPECT_NE(mesh.positions[std::size_t(v)].y * (1.0 - mesh.positions[std::size_t(v)].y), 0.0);
  }
  const Brep brep = shapes::checkedBrep(result.mesh);
  EXPECT_EQ(brep.bodies.size(), 1U);
  EXPECT_EQ(brep.faces.size(), 1U);
  EXPECT_NEAR(areaOf(result.mesh), 2.0, 1e-12);

  // Without leave to modify all is found and nothing zipped.
  const RepairedMesh report = run(mesh, {false});
  EXPECT_EQ(countOf(report, "tJunctions"), 5);
  EXPECT_EQ(itemOf(report, "tJunctions")->action, "found");
  EXPECT_EQ(shapes::checkedBrep(report.mesh).bodies.size(), 2U);
}

TEST(Repair, MoebiusStripIsReportedAndConsistentElsewhere) {
  const RepairedMesh result = run(shapes::moebius(30, 4));
  EXPECT_GT(countOf(result, "oneSidedEdges"), 0);
  std::map<Pair, int> directed;
  for (const auto& c : result.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++directed[{c[i], c[(i + 1) % 3]}];
  }
  const auto conflicts = std::count_if(directed.begin(), directed.end(), [](const auto& e) { return e.second == 2; });
  EXPECT_EQ(conflicts, countOf(result, "oneSidedEdges"));
  EXPECT_FALSE(itemOf(result, "oneSidedEdges")->elements.empty());
  EXPECT_EQ(countOf(result, "nonManifoldVertices"), 0);
}

TEST(Repair, ReportsWithoutChangingWhenAsked) {
  TriangleMesh mesh = shapes::torus(12, 8, 3.0, 1.0);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  mesh.triangles.push_back(mesh.triangles[9]);
  const RepairedMesh result = run(mesh, {false});
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_EQ(countOf(result, "misorientedTriangles"), 1);
  EXPECT_EQ(countOf(result, "duplicateTriangles"), 1);
}

TEST(Repair, KeepsLabelsAndOriginsInStep) {
  TriangleMesh mesh = shapes::square(3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.labels.push_back(static_cast<std::int32_t>(t));
  mesh.triangles[4] = {1, 1, 2};
  const RepairedMesh result = run(mesh);
  ASSERT_EQ(result.mesh.labels.size(), result.mesh.triangles.size());
  for (std::size_t t = 0; t < result.mesh.labels.size(); ++t) {
    EXPECT_EQ(result.mesh.labels[t], result.triangleOrigin[t]);
  }
}

TEST(Repair, RefusesWhatIsNoSurface) {
  SilentProgress silent;
  const auto codeOf = [&](const TriangleMesh& mesh) { return repair(mesh, {}, silent).error().code; };
  EXPECT_EQ(codeOf({}), ErrorCode::noSurface);
  TriangleMesh line;
  line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}};
  EXPECT_EQ(codeOf(line), ErrorCode::noSurface);
  EXPECT_EQ(codeOf(shapes::moved(shapes::square(1), [](const Vec3& p) { return p * 1e-61; })), ErrorCode::noSurface);
  line.triangles = {{0, 1, 3}};
  EXPECT_EQ(codeOf(line), ErrorCode::indexOutOfRange);
  line.triangles = {{0, 1, -1}};
  EXPECT_EQ(codeOf(line), ErrorCode::indexOutOfRange);
  line.positions[1].y = std::numeric_limits<double>::quiet_NaN();
  line.triangles = {{0, 1, 2}};
  EXPECT_EQ(codeOf(line), ErrorCode::nonFiniteCoordinate);
  class Stop final : public Progress {
    bool report(Stage, double) override { return false; }
  } stop;
  EXPECT_EQ(repair(shapes::square(2), {}, stop).error().code, ErrorCode::cancelled);
}

TEST(Repair, IsIndependentOfSizeAndOffset) {
  TriangleMesh mesh = shapes::cubeSoup(3);
  for (const double scale : {1e-30, 1.0, 1e9}) {
    const auto result = run(shapes::moved(mesh, [&](const Vec3& p) { return p * scale; }));
    EXPECT_EQ(result.mesh.positions.size(), 56U) << scale;
    EXPECT_EQ(shapes::checkedBrep(result.mesh).faces.size(), 6U) << scale;
  }
  const auto shifted = run(shapes::moved(mesh, [](const Vec3& p) { return p + Vec3{1 << 26, 0, 0}; }));
  EXPECT_EQ(shapes::checkedBrep(shifted.mesh).faces.size(), 6U);
}

}  // namespace
}  // namespace qmcf
