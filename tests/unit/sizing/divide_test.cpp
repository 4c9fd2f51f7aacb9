#include "qmcf/sizing/divide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "qmcf/base/random.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "sizing/parts.hpp"

namespace qmcf {
namespace {

struct Divided {
  TriangleMesh mesh;
  Brep brep;
  SizeField field;
  DividedEdges edges;
};

Divided divide(TriangleMesh mesh, double size, const std::vector<std::int32_t>& minimum = {}) {
  Divided d;
  d.mesh = std::move(mesh);
  d.brep = parts::brepOf(d.mesh);
  SizingOptions options;
  options.size = size;
  SilentProgress progress;
  Result<SizeField> field = computeSizeField(d.mesh, d.brep, options, progress);
  EXPECT_TRUE(field.ok());
  d.field = std::move(field).value();
  d.edges = divideEdges(d.mesh, d.brep, d.field, minimum);
  return d;
}

std::int64_t divisions(const Divided& d, std::int32_t edge) {
  return static_cast<std::int64_t>(d.edges.edges[static_cast<std::size_t>(edge)].nodes.size()) - 1;
}

std::int64_t oddFaces(const Divided& d) {
  std::int64_t odd = 0;
  for (const BrepFace& face : d.brep.faces) {
    std::int64_t sum = 0;
    for (const BrepLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges) sum += divisions(d, coedge.edge);
    }
    odd += sum % 2;
  }
  return odd;
}

/// Integral of ds / h over [from, to] of an edge, by the midpoint rule.
double integral(const EdgeSizes& sizes, double from, double to) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / kSteps;
    sum += (to - from) / kSteps / interpolate(sizes.arcLength, sizes.value, s);
  }
  return sum;
}

double distanceToCurve(const EdgeCurve& curve, const Vec3& p) {
  double best = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const Vec3 along = curve.points[i + 1] - curve.points[i];
    const double t = std::clamp(dot(p - curve.points[i], along) / squaredNorm(along), 0.0, 1.0);
    best = std::min(best, distance(curve.points[i] + along * t, p));
  }
  return best;
}

TEST(DivideEdges, EveryFaceOfABoxOfAnySizeIsEven) {
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const Divided d = divide(parts::box(random.uniform(0.5, 9.0), random.uniform(0.5, 9.0), random.uniform(0.5, 9.0)),
                             random.uniform(0.2, 1.5));
    EXPECT_EQ(d.edges.oddFaces, 0);
    EXPECT_EQ(oddFaces(d), 0);
    for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
      const double wanted = integral(d.field.edges[e], 0.0, d.brep.edges[e].length);
      EXPECT_NEAR(static_cast<double>(divisions(d, static_cast<std::int32_t>(e))), std::max(wanted, 1.0), 1.5);
    }
  }
}

/// A block of columns with heights of 1 to 3: flat faces of many outlines, beside each other in many ways.
TriangleMesh columns(std::uint64_t seed) {
  constexpr int kCount = 5;
  Random random(seed);
  int height[kCount + 2][kCount + 2] = {};
  for (int i = 1; i <= kCount; ++i) {
    for (int j = 1; j <= kCount; ++j) height[i][j] = 1 + static_cast<int>(random.next() % 3);
  }
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> vertices;
  const auto vertex = [&](int x, int y, int z) {
    const auto added = vertices.try_emplace({x, y, z}, static_cast<std::int32_t>(mesh.positions.size()));
    if (added.second) mesh.positions.push_back({1.0 * x, 1.3 * y, 0.7 * z});
    return added.first->second;
  };
  const auto quad = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 1; i <= kCount; ++i) {
    for (int j = 1; j <= kCount; ++j) {
      const int h = height[i][j];
      const int x = i;
      const int y = j;
      quad(vertex(x, y, h), vertex(x + 1, y, h), vertex(x + 1, y + 1, h), vertex(x, y + 1, h));
      quad(vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0));
      for (int z = height[i - 1][j]; z < h; ++z)
        quad(vertex(x, y + 1, z), vertex(x, y, z), vertex(x, y, z + 1), vertex(x, y + 1, z + 1));
      for (int z = height[i + 1][j]; z < h; ++z)
        quad(vertex(x + 1, y, z), vertex(x + 1, y + 1, z), vertex(x + 1, y + 1, z + 1), vertex(x + 1, y, z + 1));
      for (int z = height[i][j - 1]; z < h; ++z)
        quad(vertex(x, y, z), vertex(x + 1, y, z), vertex(x + 1, y, z + 1), vertex(x, y, z + 1));
      for (int z = height[i][j + 1]; z < h; ++z)
        quad(vertex(x + 1, y + 1, z), vertex(x, y + 1, z), vertex(x, y + 1, z + 1), vertex(x + 1, y + 1, z + 1));
    }
  }
  return mesh;
}

TEST(DivideEdges, FacesStayEvenWhileRowsAreBalanced) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const double size : {0.13, 0.21, 0.34}) {
      const Divided d = divide(columns(seed), size);
      EXPECT_EQ(d.edges.oddFaces, 0);
      EXPECT_EQ(oddFaces(d), 0) << "seed " << seed << ", size " << size;
    }
  }
}

TEST(DivideEdges, MinimaAreKeptAndFacesStayEven) {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    std::vector<std::int32_t> minimum;
    for (int e = 0; e < 12; ++e) minimum.push_back(1 + static_cast<std::int32_t>(random.uniform(0.0, 12.0)));
    const Divided d = divide(parts::box(3.0, 4.0, 5.0), 1.0, minimum);
    EXPECT_EQ(oddFaces(d), 0);
    for (std::int32_t e = 0; e < 12; ++e) EXPECT_GE(divisions(d, e), minimum[static_cast<std::size_t>(e)]);
  }
}

TEST(DivideEdges, DivisionsThatAFaceAskedForPassThroughTheCornersOfCoarsePolygons) {
  // A rim of a ring so narrow that no chord may miss it: divisions far below the size used to cut each corner, however
  // many there were.
  constexpr int kSegments = 27;
  const Divided d = divide(parts::disk(kSegments, 1.0), 0.3, {200});
  const EdgeDivision& rim = d.edges.edges[0];
  int corners = 0;
  for (const Vec3& p : d.mesh.positions) {
    corners += std::any_of(rim.nodes.begin(), rim.nodes.end(),
                           [&](std::int32_t node) {
                             return distance(d.edges.nodes[static_cast<std::size_t>(node)], p) < 1e-12;
                           })
                   ? 1
                   : 0;
  }
  EXPECT_EQ(corners, kSegments);
}

TEST(DivideEdges, OppositeSidesOfABoxAgree) {
  const Divided d = divide(parts::box(3.3, 4.7, 5.2), 0.7);
  for (const BrepFace& face : d.brep.faces) {
    const auto& sides = face.loops[0].coedges;
    ASSERT_EQ(sides.size(), 4U);
    EXPECT_EQ(divisions(d, sides[0].edge), divisions(d, sides[2].edge));
    EXPECT_EQ(divisions(d, sides[1].edge), divisions(d, sides[3].edge));
  }
}

TEST(DivideEdges, RimsOfANarrowRingAgreeAndThoseOfAWideOneNeedNot) {
  const Divided narrow = divide(parts::annulus(96, 0.75, 1.0), 0.25);
  ASSERT_EQ(narrow.edges.edges.size(), 2U);
  EXPECT_EQ(divisions(narrow, 0), divisions(narrow, 1));
  // The outer rim is 1.9 times as long.
  const Divided curved = divide(parts::annulus(96, 1.0, 1.9), 0.75);
  ASSERT_EQ(curved.edges.edges.size(), 2U);
  EXPECT_EQ(divisions(curved, 0), divisions(curved, 1));
  const Divided wide = divide(parts::annulus(96, 0.3, 2.0), 0.1);
  ASSERT_EQ(wide.edges.edges.size(), 2U);
  EXPECT_GT(std::max(divisions(wide, 0), divisions(wide, 1)), 3 * std::min(divisions(wide, 0), divisions(wide, 1)));
}

TEST(DivideEdges, RimsAgreeBetweenFacesWithNoOtherEdge) {
  // A flat frustum: the disks at both ends are bounded by one rim each, which can only change by two.
  constexpr std::int32_t kSegments = 96;
  TriangleMesh frustum = parts::annulus(kSegments, 1.0, 1.5);
  for (std::int32_t i = 0; i < kSegments; ++i) frustum.positions[static_cast<std::size_t>(i)].z = 0.6;
  for (std::int32_t i = 1; i + 1 < kSegments; ++i) {
    frustum.triangles.push_back({0, i, i + 1});
    frustum.triangles.push_back({kSegments, kSegments + i + 1, kSegments + i});
  }
  const Divided d = divide(frustum, 0.75);
  ASSERT_EQ(d.brep.faces.size(), 3U);
  ASSERT_EQ(d.edges.edges.size(), 2U);
  EXPECT_EQ(d.edges.oddFaces, 0);
  EXPECT_EQ(divisions(d, 0), divisions(d, 1));
}

/// Divisions of the edges that run along x at height y, in sum.
std::int64_t divisionsAt(const Divided& d, double y) {
  std::int64_t sum = 0;
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    const auto& points = d.brep.edges[e].points;
    const auto isThere = [&](std::int32_t p) { return d.mesh.positions[static_cast<std::size_t>(p)].y == y; };
    if (isThere(points.front()) && isThere(points.back())) sum += divisions(d, static_cast<std::int32_t>(e));
  }
  return sum;
}

TEST(DivideEdges, SidesOfAnLMatchInSum) {
  // Each side by itself would be rounded: 7 below, 3 and 3 above.
  const Divided d = divide(parts::sheet({0, 3.4, 6.8}, {0, 5, 10}, [](int i, int j) { return i == 0 || j == 0; }), 1.0);
  EXPECT_EQ(d.edges.oddFaces, 0);
  EXPECT_EQ(divisionsAt(d, 0.0), divisionsAt(d, 5.0) + divisionsAt(d, 10.0));
}

TEST(DivideEdges, NoSideOfATriangularFaceIsAsLongAsTheOthers) {
  // The sides of a quarter of a disk are 1, 1 and pi / 2 radii long.
  for (double radius = 3.0; radius < 6.0; radius += 0.25) {
    const Divided d = divide(parts::disk(48, radius, 0.25), 1.0);
    ASSERT_EQ(d.brep.faces.size(), 1U);
    EXPECT_EQ(oddFaces(d), 0);
    std::int64_t all = 0;
    std::int64_t longest = 0;
    for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
      all += divisions(d, static_cast<std::int32_t>(e));
      if (d.brep.edges[e].length > 1.2 * radius) longest += divisions(d, static_cast<std::int32_t>(e));
    }
    EXPECT_EQ(all - 2 * longest, 2) << radius;
  }
}

TEST(DivideEdges, SidesBetweenSlantedEndsMatchWhereThereIsOneRow) {
  // A prism over a trapezoid with corners of 45 and 135 degrees, whose sides by their lengths would have 12 and 10
  // divisions, or 12 and 4.
  const auto trapezoid = [](double height) {
    TriangleMesh mesh;
    for (const double z : {0.0, 5.3}) {
      mesh.positions.insert(mesh.positions.end(),
                            {{0, 0, z}, {12, 0, z}, {12 - height, height, z}, {height, height, z}});
    }
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
    for (std::int32_t i = 0; i < 4; ++i) {
      const std::int32_t j = (i + 1) % 4;
      mesh.triangles.insert(mesh.triangles.end(), {{i, j, j + 4}, {i, j + 4, i + 4}});
    }
    return divide(mesh, 1.0);
  };
  const Divided narrow = trapezoid(1.0);
  EXPECT_EQ(divisionsAt(narrow, 0.0), divisionsAt(narrow, 1.0));
  const Divided wide = trapezoid(4.0);
  EXPECT_GT(divisionsAt(wide, 0.0), divisionsAt(wide, 4.0) + 4);
}

TEST(DivideEdges, OuterSidesOfANarrowFrameHaveTwoDivisionsMore) {
  // Each side by itself would be rounded: 11 outside, 8 inside.
  const auto isFrame = [](int i, int j) { return i != 1 || j != 1; };
  const Divided d = divide(parts::sheet({0, 1.2, 9.4, 10.6}, {0, 1.2, 12.4, 13.6}, isFrame), 1.0);
  EXPECT_EQ(d.edges.oddFaces, 0);
  EXPECT_EQ(divisionsAt(d, 0.0), divisionsAt(d, 1.2) + 2);
  EXPECT_EQ(divisionsAt(d, 13.6), divisionsAt(d, 12.4) + 2);
}

TEST(DivideEdges, SheetsAtANonManifoldEdgeAreEven) {
  for (const double size : {0.13, 0.21, 0.34, 0.55}) {
    const Divided d = divide(parts::tee(), size);
    EXPECT_EQ(d.edges.oddFaces, 0);
    EXPECT_EQ(oddFaces(d), 0);
  }
}

TEST(DivideEdges, CirclesHaveEightDivisionsWhenTheSizeIsLarge) {
  for (const int segments : {32, 100}) {
    const Divided d = divide(parts::disk(segments, 1.0), 3.0);
    ASSERT_EQ(d.edges.edges.size(), 1U);
    EXPECT_EQ(divisions(d, 0), 8) << segments;
    EXPECT_EQ(d.edges.edges[0].nodes.front(), d.edges.edges[0].nodes.back());
  }
}

/// Largest distance of an edge's points from the chords between its nodes.
double largestSagitta(const Divided& d, std::size_t e) {
  const EdgeDivision& division = d.edges.edges[e];
  EdgeCurve chords;
  for (const std::int32_t node : division.nodes) chords.points.push_back(d.edges.nodes[static_cast<std::size_t>(node)]);
  double largest = 0.0;
  for (const Vec3& p : edgeCurve(d.mesh, d.brep.edges[e]).points)
    largest = std::max(largest, distanceToCurve(chords, p));
  return largest;
}

TEST(DivideEdges, ChordsStayWithinATenthOfTheSizeOfCoarsePolygons) {
  // Eight chords of a polygon of 12 or 13 sides would have to leave out corners.
  for (const int segments : {9, 10, 11, 12, 13, 14, 17}) {
    const Divided d = divide(parts::disk(segments, 1.0), 3.0);
    const double h = math::kPi / 4.0;
    EXPECT_LT(largestSagitta(d, 0), 0.11 * h) << segments;
    EXPECT_LE(divisions(d, 0), segments + 2) << segments;
  }
}

TEST(DivideEdges, ChordsFollowARoundedCornerBetweenLongSides) {
  // No chord cuts off a small arc in the middle of an edge, wherever the equal parts fall.
  for (const double length : {5.0, 5.3, 5.6, 5.9, 6.2, 6.5}) {
    // A fan from the first point: along -y = 0.5, an eighth of a turn round the origin, then up at 45 degrees.
    TriangleMesh mesh;
    mesh.positions = {{-length, 9.0, 0.0}, {-length, -0.5, 0.0}};
    for (int i = 0; i <= 6; ++i) mesh.positions.push_back(parts::onCircle(0.5, -0.25 + 0.125 * i / 6.0));
    mesh.positions.push_back(mesh.positions.back() + Vec3{length, length, 0.0});
    const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
    for (std::int32_t i = 1; i < last; ++i) mesh.triangles.push_back({0, i, i + 1});
    const Divided d = divide(mesh, 1.0);
    for (std::size_t e = 0; e < d.brep.edges.size(); ++e) EXPECT_LT(largestSagitta(d, e), 0.12) << length;
  }
}

TEST(DivideEdges, StopsOfAnEdgeBecomeNodes) {
  Divided d = divide(parts::plateWithHole(5.0, {}, 1.0, 64), 0.9);
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    if (d.brep.edges[e].points.size() < 60) continue;
    d.brep.edges[e].stops = {7, 29};
    const DividedEdges divided = divideEdges(d.mesh, d.brep, d.field);
    for (const std::int32_t stop : d.brep.edges[e].stops) {
      const Vec3 p = d.mesh.positions[static_cast<std::size_t>(d.brep.edges[e].points[static_cast<std::size_t>(stop)])];
      double nearest = HUGE_VAL;
      for (const Vec3& node : divided.nodes) nearest = std::min(nearest, distance(node, p));
      EXPECT_LT(nearest, 1e-9);
    }
  }
}

TEST(DivideEdges, TinyHolesHaveEightDivisions) {
  const Divided d = divide(parts::plateWithHole(5.0, {}, 0.01, 32), 1.0);
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    if (d.brep.edges[e].start == d.brep.edges[e].end) {
      EXPECT_GE(divisions(d, static_cast<std::int32_t>(e)), 8);
    }
  }
}

TEST(DivideEdges, QuarterArcHasTwoDivisionsWhenTheSizeIsLarge) {
  const Divided d = divide(parts::disk(24, 1.0, 0.25), 1.5);
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    if (d.brep.edges[e].points.size() > 2) {
      EXPECT_GE(divisions(d, static_cast<std::int32_t>(e)), 2);
    }
  }
}

TEST(DivideEdges, CornersOfACoarsePolygonGetNodes) {
  const Divided d = divide(parts::disk(12, 1.0), 0.2);
  for (const Vec3& corner : d.mesh.positions) {
    double nearest = HUGE_VAL;
    for (const Vec3& node : d.edges.nodes) nearest = std::min(nearest, distance(node, corner));
    EXPECT_LT(nearest, 1e-9);
  }
}

TEST(DivideEdges, NodesLieOnTheEdgeAtEqualPartsOfTheIntegral) {
  const Divided d = divide(parts::plateWithHole(5.0, {3.0, 1.0, 0.0}, 0.5, 64), 1.0);
  ASSERT_GE(d.edges.nodes.size(), d.brep.vertices.size());
  ASSERT_EQ(d.edges.nodes.size(), d.edges.nodeSize.size());
  for (std::size_t v = 0; v < d.brep.vertices.size(); ++v) {
    EXPECT_EQ(d.edges.nodes[v], d.mesh.positions[static_cast<std::size_t>(d.brep.vertices[v].point)]);
  }
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    const EdgeDivision& division = d.edges.edges[e];
    const EdgeCurve curve = edgeCurve(d.mesh, d.brep.edges[e]);
    EXPECT_EQ(division.nodes.front(), d.brep.edges[e].start);
    EXPECT_EQ(division.nodes.back(), d.brep.edges[e].end);
    ASSERT_EQ(division.nodes.size(), division.arcLength.size());
    const double whole = integral(d.field.edges[e], 0.0, curve.length());
    for (std::size_t i = 0; i + 1 < division.nodes.size(); ++i) {
      EXPECT_LT(division.arcLength[i], division.arcLength[i + 1]);
      const auto node = static_cast<std::size_t>(division.nodes[i]);
      EXPECT_LT(distanceToCurve(curve, d.edges.nodes[node]), 1e-12);
      const double part = integral(d.field.edges[e], division.arcLength[i], division.arcLength[i + 1]);
      EXPECT_NEAR(part, whole / static_cast<double>(division.nodes.size() - 1), 0.03 * part);
    }
  }
}

TEST(DivideEdges, GivenEdgesKeepTheirOwnPoints) {
  // The outline is cut as the size asks, the hole at its own 64 points, and the parity is made up for elsewhere.
  const TriangleMesh mesh = parts::plateWithHole(5.0, {3.0, 1.0, 0.0}, 0.5, 63);
  const Brep brep = parts::brepOf(mesh);
  SizingOptions options;
  options.size = 1.0;
  SilentProgress progress;
  const Result<SizeField> size = computeSizeField(mesh, brep, options, progress);
  ASSERT_TRUE(size.ok());
  std::vector<std::uint8_t> asGiven(brep.edges.size(), 0);
  std::size_t round = brep.edges.size();
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    if (brep.edges[e].points.size() > 20) round = e;
  }
  ASSERT_LT(round, brep.edges.size());
  asGiven[round] = 1;
  const DividedEdges divided = divideEdges(mesh, brep, size.value(), {}, asGiven);
  EXPECT_EQ(divided.oddFaces, 0);
  const BrepEdge& edge = brep.edges[round];
  const EdgeDivision& division = divided.edges[round];
  ASSERT_EQ(division.nodes.size(), edge.points.size());
  for (std::size_t i = 0; i < division.nodes.size(); ++i) {
    EXPECT_EQ(divided.nodes[static_cast<std::size_t>(division.nodes[i])],
              mesh.positions[static_cast<std::size_t>(edge.points[i])]);
  }
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    EXPECT_GE(divided.edges[e].nodes.size(), 4U);
  }
}

/// A flat part with this outline, counter-clockwise, as a fan from its first point. \pre it sees all others
TriangleMesh fan(const std::vector<Vec3>& outline) {
  TriangleMesh mesh;
  mesh.positions = outline;
  for (std::int32_t i = 1; i + 1 < static_cast<std::int32_t>(outline.size()); ++i)
    mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

/// The edge between the points nearest to two places.
std::int32_t edgeBetween(const Divided& d, const Vec3& from, const Vec3& to) {
  const auto at = [&](std::int32_t vertex) -> const Vec3& {
    return d.mesh.positions[static_cast<std::size_t>(d.brep.vertices[static_cast<std::size_t>(vertex)].point)];
  };
  for (std::size_t e = 0; e < d.brep.edges.size(); ++e) {
    const Vec3& a = at(d.brep.edges[e].start);
    const Vec3& b = at(d.brep.edges[e].end);
    if (std::min(distance(a, from) + distance(b, to), distance(a, to) + distance(b, from)) < 1e-9)
      return static_cast<std::int32_t>(e);
  }
  ADD_FAILURE() << "no such edge";
  return 0;
}

TEST(DivideEdges, ARowFromATipToAnEndHasAnOddNumber) {
  // Two sides and an end of one element: the row begins with a triangle.
  for (const double size : {0.9, 1.0, 1.1, 1.25}) {
    const Divided d = divide(fan({{0.0, 0.0, 0.0}, {9.0, -0.3, 0.0}, {9.0, 0.3, 0.0}}), size);
    ASSERT_EQ(d.brep.edges.size(), 3U);
    EXPECT_EQ(d.edges.oddFaces, 1);
    EXPECT_EQ(divisions(d, edgeBetween(d, {0, 0, 0}, {9.0, -0.3, 0})),
              divisions(d, edgeBetween(d, {0, 0, 0}, {9.0, 0.3, 0})));
    EXPECT_EQ(divisions(d, edgeBetween(d, {9.0, -0.3, 0}, {9.0, 0.3, 0})), 1);
  }
}

TEST(DivideEdges, ATriangleSmallerThanAnElementIsOne) {
  const Divided d = divide(fan({{0.0, 0.0, 0.0}, {0.24, 0.0, 0.0}, {0.12, 0.2, 0.0}}), 1.0);
  for (std::int32_t e = 0; e < 3; ++e) EXPECT_EQ(divisions(d, e), 1);
  EXPECT_EQ(d.edges.oddFaces, 1);
}

TEST(DivideEdges, SlantedEndsOfALongRowHaveOneElement) {
  // The ends are 1.6 long, the row 1.3 high.
  const Divided d = divide(fan({{0.0, 0.0, 0.0}, {24.0, 0.0, 0.0}, {23.1, 1.3, 0.0}, {0.9, 1.3, 0.0}}), 1.0);
  EXPECT_EQ(divisions(d, edgeBetween(d, {0, 0, 0}, {0.9, 1.3, 0})), 1);
  EXPECT_EQ(divisions(d, edgeBetween(d, {24.0, 0, 0}, {23.1, 1.3, 0})), 1);
  EXPECT_EQ(divisions(d, edgeBetween(d, {0, 0, 0}, {24.0, 0, 0})),
            divisions(d, edgeBetween(d, {23.1, 1.3, 0}, {0.9, 1.3, 0})));
}

TEST(DivideEdges, NodesOfANarrowRowLieAcrossFromEachOther) {
  // A row of 10 by 0.2. Two walls meet one of its sides, with a corner between them that is no corner of the row.
  constexpr double kCorner = 5.4;
  TriangleMesh mesh = fan({{10.0, 0.2, 0.0}, {0.0, 0.2, 0.0}, {0.0, 0.0, 0.0}, {kCorner, 0.0, 0.0}, {10.0, 0.0, 0.0}});
  for (const Vec3& p : {Vec3{0.0, 0.0, -2.0}, {kCorner, 0.0, -2.0}, {kCorner, -2.0, -2.0}, {10.0, -2.0, -2.0}}) {
    mesh.positions.push_back(p);
  }
  parts::addQuad(mesh, 3, 2, 5, 6);
  parts::addQuad(mesh, 4, 3, 7, 8);
  const Divided d = divide(mesh, 1.0);
  std::vector<double> above;
  std::vector<double> below;
  for (const Vec3& node : d.edges.nodes) {
    if (node.z == 0.0) (node.y > 0.1 ? above : below).push_back(node.x);
  }
  std::sort(above.begin(), above.end());
  std::sort(below.begin(), below.end());
  ASSERT_EQ(above.size(), below.size());
  EXPECT_NE(std::find(below.begin(), below.end(), kCorner), below.end());
  for (std::size_t i = 0; i < above.size(); ++i) EXPECT_NEAR(above[i], below[i], 1e-9);
}

TEST(DivideEdges, IsTheSameEveryTime) {
  const Divided a = divide(parts::plateWithHole(5.0, {3.0, 1.0, 0.0}, 0.5, 64), 0.3);
  const Divided b = divide(parts::plateWithHole(5.0, {3.0, 1.0, 0.0}, 0.5, 64), 0.3);
  EXPECT_EQ(a.edges.nodes, b.edges.nodes);
  EXPECT_EQ(a.edges.nodeSize, b.edges.nodeSize);
}

}  // namespace
}  // namespace qmcf
