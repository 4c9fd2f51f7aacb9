#include "qmcf/topology/brep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"
#include "topology/shapes.hpp"

namespace qmcf {
namespace {

using math::kPi;
using shapes::checkedBrep;
using shapes::cornerQuads;
using shapes::repaired;

std::size_t edgesOfKind(const Brep& brep, EdgeKind kind) {
  return static_cast<std::size_t>(
      std::count_if(brep.edges.begin(), brep.edges.end(), [&](const BrepEdge& e) { return e.kind == kind; }));
}

TEST(Brep, CubeHasItsFacesEdgesAndCorners) {
  const Brep brep = checkedBrep(repaired(shapes::cubeSoup(4)));
  EXPECT_EQ(brep.faces.size(), 6U);
  EXPECT_EQ(brep.edges.size(), 12U);
  EXPECT_EQ(brep.vertices.size(), 8U);
  ASSERT_EQ(brep.bodies.size(), 1U);
  EXPECT_TRUE(brep.bodies[0].closed);
  for (const BrepFace& face : brep.faces) {
    EXPECT_EQ(cornerQuads(face), (std::vector<std::int32_t>{1, 1, 1, 1}));
    EXPECT_NEAR(face.area, 1.0, 1e-12);
    for (const Coedge& coedge : face.loops[0].coedges) EXPECT_NEAR(coedge.cornerAngle, 0.5 * kPi, 1e-12);
  }
  for (const BrepEdge& edge : brep.edges) {
    EXPECT_EQ(edge.kind, EdgeKind::sharp);
    EXPECT_NEAR(edge.length, 1.0, 1e-12);
  }
}

TEST(Brep, CylinderHasThreeFacesAndTwoClosedEdges) {
  const int segments = 48;
  const Brep brep = checkedBrep(shapes::cylinder(segments, 5, 3.0));
  EXPECT_EQ(brep.faces.size(), 3U);
  ASSERT_EQ(brep.edges.size(), 2U);
  EXPECT_EQ(brep.vertices.size(), 2U);
  for (const BrepEdge& edge : brep.edges) {
    EXPECT_EQ(edge.start, edge.end);
    EXPECT_TRUE(brep.vertices[std::size_t(edge.start)].artificial);
    EXPECT_NEAR(edge.length, 2.0 * segments * math::sin(kPi / segments), 1e-9);
  }
  std::vector<std::size_t> loops;
  for (const BrepFace& face : brep.faces) {
    loops.push_back(face.loops.size());
    for (const BrepLoop& loop : face.loops) {
      ASSERT_EQ(loop.coedges.size(), 1U);
      EXPECT_EQ(loop.coedges[0].cornerQuads, 2);
    }
  }
  std::sort(loops.begin(), loops.end());
  EXPECT_EQ(loops, (std::vector<std::size_t>{1, 1, 2}));
}

/// The same mesh with its vertices in another order.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::int32_t> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t i = place.size(); i-- > 1;) {
    std::swap(place[i], place[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
  }
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < place.size(); ++v) result.positions[std::size_t(place[v])] = mesh.positions[v];
  for (auto& triangle : result.triangles) {
    for (std::int32_t& v : triangle) v = place[std::size_t(v)];
  }
  return result;
}

TEST(Brep, RimsOfATubeBeginAcrossFromEachOther) {
  const auto tube = [](double u, double v) {
    return Vec3{math::cos(2.0 * kPi * u), math::sin(2.0 * kPi * u), 3.0 * v};
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TriangleMesh mesh = shuffled(shapes::grid(40, 3, tube, true), seed);
    const Brep brep = checkedBrep(mesh);
    ASSERT_EQ(brep.vertices.size(), 2U);
    const auto start = [&](std::size_t i) { return mesh.positions[std::size_t(brep.vertices[i].point)]; };
    EXPECT_NEAR(distance(start(0), start(1)), 3.0, 1e-12) << seed;
  }
}

TEST(Brep, LShapedPrismHasOneReentrantCorner) {
  const Brep brep = checkedBrep(shapes::prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {0.5, 0.5}));
  EXPECT_EQ(brep.faces.size(), 8U);
  EXPECT_EQ(brep.edges.size(), 18U);
  EXPECT_EQ(brep.vertices.size(), 12U);
  int caps = 0;
  for (const BrepFace& face : brep.faces) {
    if (face.loops[0].coedges.size() != 6) continue;
    ++caps;
    EXPECT_EQ(cornerQuads(face), (std::vector<std::int32_t>{1, 1, 1, 1, 1, 3}));
  }
  EXPECT_EQ(caps, 2);
}

TEST(Brep, TwoSheetsCrossingInATeeAreCutAtTheirCommonEdge) {
  const TriangleMesh floor = shapes::square(8);
  const TriangleMesh wall = shapes::grid(8, 4, [](double u, double v) { return Vec3{u, 0.5, v}; });
  const TriangleMesh mesh = repaired(shapes::join(floor, wall));
  const Brep brep = checkedBrep(mesh);
  EXPECT_EQ(brep.faces.size(), 3U);
  ASSERT_EQ(edgesOfKind(brep, EdgeKind::nonManifold), 1U);
  const auto tee = std::find_if(brep.edges.begin(), brep.edges.end(),
                                [](const BrepEdge& e) { return e.kind == EdgeKind::nonManifold; });
  EXPECT_NEAR(tee->length, 1.0, 1e-12);
  ASSERT_EQ(brep.bodies.size(), 1U);
  EXPECT_FALSE(brep.bodies[0].closed);
  for (const BrepFace& face : brep.faces) EXPECT_EQ(cornerQuads(face), (std::vector<std::int32_t>{1, 1, 1, 1}));
}

TEST(Brep, WallInTheMiddleOfAFloorLeavesASlit) {
  const TriangleMesh floor = shapes::square(8);
  const TriangleMesh wall = shapes::grid(4, 3, [](double u, double v) { return Vec3{0.25 + 0.5 * u, 0.5, v}; });
  const Brep brep = checkedBrep(repaired(shapes::join(floor, wall)));
  ASSERT_EQ(brep.faces.size(), 2U);
  const BrepFace& cut = brep.faces[0];
  ASSERT_EQ(cut.loops.size(), 2U);
  const BrepLoop& slit = cut.loops[0].coedges.size() == 2 ? cut.loops[0] : cut.loops[1];
  ASSERT_EQ(slit.coedges.size(), 2U);
  EXPECT_EQ(slit.coedges[0].edge, slit.coedges[1].edge);
  EXPECT_NE(slit.coedges[0].reversed, slit.coedges[1].reversed);
  for (const Coedge& coedge : slit.coedges) {
    EXPECT_NEAR(coedge.cornerAngle, 2.0 * kPi, 1e-9);
    EXPECT_EQ(coedge.cornerQuads, 4);
  }
}

TEST(Brep, FinOnASingleMeshEdgeStillCutsTheSheet) {
  const TriangleMesh floor = shapes::square(4);
  TriangleMesh fin;
  fin.positions = {{0.25, 0.5, 0.0}, {0.5, 0.5, 0.0}, {0.4, 0.5, 1.0}};
  fin.triangles = {{0, 1, 2}};
  const Brep brep = checkedBrep(repaired(shapes::join(floor, fin)));
  ASSERT_EQ(brep.faces.size(), 2U);
  EXPECT_EQ(brep.faces[0].loops.size(), 2U);
  EXPECT_EQ(edgesOfKind(brep, EdgeKind::nonManifold), 1U);
}

TEST(Brep, SheetThatMeetsItselfInATeeStaysOneFace) {
  // In section the figure 6: the strip's end touches its own middle.
  const int columns = 24;
  TriangleMesh mesh = shapes::grid(columns, 3, [](double u, double v) {
    const bool tail = u > 0.66;
    const double a = tail ? 3.0 * kPi * (u - 2.0 / 3.0) : 3.0 * kPi * u;
    const double r = tail ? 1.0 + 2.0 * (u - 2.0 / 3.0) : 1.0;
    return std::fabs(a) < 1e-9 ? Vec3{1.0, 0.0, v} : Vec3{r * math::cos(a), r * math::sin(a), v};
  });
  const Brep brep = checkedBrep(repaired(mesh), 60.0);
  ASSERT_EQ(edgesOfKind(brep, EdgeKind::nonManifold), 1U);
  std::size_t uses = 0;
  for (const BrepFace& face : brep.faces) {
    for (const BrepLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges) {
        uses += brep.edges[std::size_t(coedge.edge)].kind == EdgeKind::nonManifold ? 1U : 0U;
      }
    }
  }
  // The ring closes there, so that its own end meets it from both sides, and the tail leaves from there.
  EXPECT_EQ(uses, 3U);
  EXPECT_EQ(brep.faces.size(), 2U);
}

TEST(Brep, MoebiusStripIsCutIntoOneOrientedFace) {
  const TriangleMesh mesh = repaired(shapes::moebius(40, 4));
  const Brep brep = checkedBrep(mesh);
  ASSERT_EQ(brep.faces.size(), 1U);
  EXPECT_EQ(brep.faces[0].loops.size(), 1U);
  const FaceSurface& face = brep.cuts[0];
  EXPECT_EQ(face.surface.eulerCharacteristic(), 1);
}

TEST(Brep, OpenSheetHasOneFaceAndItsFourCorners) {
  const Brep brep = checkedBrep(shapes::square(6));
  ASSERT_EQ(brep.faces.size(), 1U);
  EXPECT_EQ(brep.edges.size(), 4U);
  EXPECT_EQ(brep.vertices.size(), 4U);
  EXPECT_EQ(edgesOfKind(brep, EdgeKind::boundary), 4U);
  EXPECT_EQ(cornerQuads(brep.faces[0]), (std::vector<std::int32_t>{1, 1, 1, 1}));
  EXPECT_FALSE(brep.bodies[0].closed);
}

TEST(Brep, TorusIsOneFaceWithoutLoops) {
  const TriangleMesh mesh = shapes::torus(60, 30, 3.0, 1.0);
  const Brep brep = checkedBrep(mesh);
  ASSERT_EQ(brep.faces.size(), 1U);
  EXPECT_TRUE(brep.faces[0].loops.empty());
  EXPECT_TRUE(brep.edges.empty());
  EXPECT_TRUE(brep.bodies[0].closed);
  EXPECT_EQ(brep.cuts[0].surface.eulerCharacteristic(), 0);
}

TEST(Brep, TwoSheetsTouchingInACornerShareTheVertexOnly) {
  const TriangleMesh other = shapes::moved(shapes::square(4), [](const Vec3& p) {
    return Vec3{p.x + 1.0, p.y + 1.0, 0.0};
  });
  const Brep brep = checkedBrep(repaired(shapes::join(shapes::square(4), other)));
  EXPECT_EQ(brep.faces.size(), 2U);
  EXPECT_EQ(brep.bodies.size(), 2U);
  EXPECT_EQ(brep.edges.size(), 8U);
  EXPECT_EQ(brep.vertices.size(), 7U);
}

TEST(Brep, SmoothBoundaryTouchingAFloorInOnePointHasAVertexThere) {
  // A disc standing on the middle of a floor: the disc's boundary is smooth, but the point belongs to both.
  TriangleMesh disc;
  const int segments = 64;
  disc.positions.push_back({0.5, 0.5, 1.0});
  for (int i = 0; i < segments; ++i) {
    const double a = 2.0 * kPi * i / segments;
    disc.positions.push_back({0.5 + math::sin(a), 0.5, i == 0 ? 0.0 : 1.0 - math::cos(a)});
    disc.triangles.push_back({0, i + 1, (i + 1) % segments + 1});
  }
  const TriangleMesh mesh = repaired(shapes::join(shapes::square(4), disc));
  const Brep brep = checkedBrep(mesh);
  EXPECT_EQ(brep.faces.size(), 2U);
  const auto touching = std::find_if(brep.vertices.begin(), brep.vertices.end(), [&](const BrepVertex& v) {
    return mesh.positions[std::size_t(v.point)] == Vec3{0.5, 0.5, 0.0};
  });
  ASSERT_NE(touching, brep.vertices.end());
  EXPECT_FALSE(touching->artificial);
}

TEST(Brep, ConesTouchingAtTheirApexAreSeparateLocalVertices) {
  const auto cone = [](double sign) {
    return shapes::grid(
        40, 6,
        [=](double u, double v) {
          return Vec3{v * math::cos(2.0 * kPi * u), v * math::sin(2.0 * kPi * u), sign * 0.3 * v};
        },
        true);
  };
  const TriangleMesh mesh = repaired(shapes::join(cone(1.0), cone(-1.0)));
  const Brep brep = checkedBrep(mesh);
  ASSERT_EQ(brep.faces.size(), 2U);
  for (std::int32_t f = 0; f < 2; ++f) {
    const FaceSurface& face = brep.cuts[static_cast<std::size_t>(f)];
    EXPECT_EQ(face.surface.eulerCharacteristic(), 1);
  }
}

TEST(Brep, LabelsDivideASmoothSheetWhenTheyAreRegions) {
  TriangleMesh mesh = shapes::square(8);
  mesh.labelNames = {"left", "right"};
  for (const auto& c : mesh.triangles) {
    double x = 0.0;
    for (const std::int32_t v : c) x += mesh.positions[std::size_t(v)].x / 3.0;
    mesh.labels.push_back(x < 0.5 ? 0 : 1);
  }
  const Brep brep = checkedBrep(mesh);
  ASSERT_EQ(brep.faces.size(), 2U);
  EXPECT_EQ(edgesOfKind(brep, EdgeKind::label), 1U);
  std::vector<std::string> names{brep.faces[0].name, brep.faces[1].name};
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"left", "right"}));

  // A label of its own for each triangle says nothing.
  for (std::size_t t = 0; t < mesh.labels.size(); ++t) mesh.labels[t] = static_cast<std::int32_t>(t);
  EXPECT_EQ(checkedBrep(mesh).faces.size(), 1U);
}

/// A unit square folded along x = 0.5 by angle(y) radians.
TriangleMesh foldedSheet(int cells, const std::function<double(double)>& angle) {
  return shapes::grid(cells, cells, [&](double u, double v) {
    if (u <= 0.5) return Vec3{u, v, 0.0};
    const double a = angle(v);
    return Vec3{0.5 + (u - 0.5) * math::cos(a), v, (u - 0.5) * math::sin(a)};
  });
}

TEST(Brep, CreaseThatWeakensStaysOneEdge) {
  // From 60 degrees at one end to 20 at the other: with a feature angle of 30 the last part is below it.
  const Brep brep = checkedBrep(foldedSheet(32, [](double v) { return (60.0 - 40.0 * v) * kPi / 180.0; }));
  EXPECT_EQ(brep.faces.size(), 2U);
  EXPECT_EQ(edgesOfKind(brep, EdgeKind::sharp), 1U);
}

TEST(Brep, ShortCreaseInASmoothFaceIsNoise) {
  // Just above the feature angle over a few elements, in the middle of a gentle fold.
  const auto angle = [](double v) {
    const double s = std::min(1.0, std::fabs(v - 0.5) / 0.3);
    return 30.15 * (1.0 - s * s) * (1.0 - s * s) * kPi / 180.0;
  };
  EXPECT_EQ(edgesOfKind(checkedBrep(foldedSheet(64, angle), 30.0), EdgeKind::sharp), 0U);
  // The same crease where it is longer counts.
  EXPECT_EQ(edgesOfKind(checkedBrep(foldedSheet(64, angle), 25.0), EdgeKind::sharp), 1U);
}

TEST(Brep, RoundOffDoesNotDecideAboutTheFeatureAngle) {
  // Sides of twelve turn by exactly 30 degrees, wherever they are and whatever a file keeps of their coordinates.
  for (const double shift : {0.0, 10.0, -70.0}) {
    std::vector<Vec2> polygon;
    for (int i = 0; i < 12; ++i) {
      const double angle = 0.3 + shift + 2.0 * math::kPi * i / 12.0;
      polygon.push_back({math::cos(angle), math::sin(angle)});
    }
    const auto stored = [shift](double x) { return static_cast<double>(static_cast<float>(x + shift)); };
    const TriangleMesh exact = shapes::prism(polygon, {0.0, 0.0});
    const TriangleMesh rounded = shapes::moved(exact, [&](const Vec3& p) {
      return Vec3{stored(p.x), stored(p.y), stored(p.z)};
    });
    for (const TriangleMesh& mesh : {exact, rounded}) EXPECT_EQ(edgesOfKind(checkedBrep(mesh), EdgeKind::sharp), 36U);
  }
}

TEST(Brep, WhereACreaseIsInterruptedItsEdgeHasStops) {
  // 52 degrees at both ends, 22 in the middle: continued there, and the ends of the sharp parts are remembered.
  const auto angle = [](double v) { return (22.0 + 30.0 * (2.0 * v - 1.0) * (2.0 * v - 1.0)) * kPi / 180.0; };
  const Brep brep = checkedBrep(foldedSheet(32, angle));
  ASSERT_EQ(edgesOfKind(brep, EdgeKind::sharp), 1U);
  for (const BrepEdge& edge : brep.edges) {
    EXPECT_EQ(edge.stops.size(), edge.kind == EdgeKind::sharp ? 2U : 0U);
    for (const std::int32_t stop : edge.stops) {
      EXPECT_GT(stop, 0);
      EXPECT_LT(static_cast<std::size_t>(stop), edge.points.size() - 1);
    }
  }
}

TEST(Brep, WhereTheAngleOfACreaseIsUnknownItsEdgeHasStops) {
  const TriangleMesh mesh = foldedSheet(8, [](double) { return 60.0 * kPi / 180.0; });
  const Brep whole = checkedBrep(mesh);
  const auto crease = std::find_if(whole.edges.begin(), whole.edges.end(),
                                   [](const BrepEdge& edge) { return edge.kind == EdgeKind::sharp; });
  ASSERT_NE(crease, whole.edges.end());
  ASSERT_GE(crease->points.size(), 8U);
  EXPECT_TRUE(crease->stops.empty());
  BrepOptions options;
  options.flatEdges = {{crease->points[4], crease->points[3]}, {crease->points[4], crease->points[5]}, {0, 0}};
  SilentProgress silent;
  const auto result = recoverBrep(mesh, options, silent);
  ASSERT_TRUE(result.ok());
  const BrepEdge& same = result.value().edges[static_cast<std::size_t>(crease - whole.edges.begin())];
  EXPECT_EQ(same.points, crease->points);
  EXPECT_EQ(same.stops, (std::vector<std::int32_t>{3, 5}));
}

TEST(Brep, LongCreaseThatFadesOutStaysAsASlit) {
  const Brep brep = checkedBrep(foldedSheet(32, [](double v) { return 80.0 * (1.0 - v) * (1.0 - v) * kPi / 180.0; }));
  ASSERT_EQ(brep.faces.size(), 1U);
  ASSERT_EQ(edgesOfKind(brep, EdgeKind::sharp), 1U);
  ASSERT_EQ(brep.faces[0].loops.size(), 1U);
  EXPECT_EQ(brep.faces[0].loops[0].coedges.size(), 7U);
}

TEST(Brep, NoiseOnASmoothSurfaceMakesNoFaces) {
  // Rough enough that many single edges are above the feature angle, here and there.
  TriangleMesh mesh = shapes::torus(90, 45, 3.0, 1.0);
  Random random(3);
  for (Vec3& p : mesh.positions) {
    p = p + Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)} * 0.025;
  }
  int above = 0;
  const Surface surface = Surface::build(mesh.positions, mesh.triangles).value();
  for (const HalfedgeId h : surface.halfedges()) {
    const Vec3 a = normalized(surface.areaVector(Surface::triangle(h)));
    const Vec3 b = normalized(surface.areaVector(Surface::triangle(surface.twin(h))));
    above += dot(a, b) < math::cos(kPi / 6.0) ? 1 : 0;
  }
  EXPECT_GT(above, 100);
  const Brep brep = checkedBrep(mesh);
  EXPECT_EQ(brep.faces.size(), 1U);
  EXPECT_TRUE(brep.edges.empty());
}

TEST(Brep, SliverBesideACreaseBelongsToOneSide) {
  // A fold of 90 degrees with slivers, thinner than single precision resolves, along the crease.
  const double thin = 1e-9;
  TriangleMesh mesh;
  const int n = 8;
  for (const Vec3& p : {Vec3{-1, 0, 0}, Vec3{0, 0, 0}, Vec3{thin, 0, 0.3 * thin}, Vec3{0, 0, -1}}) {
    for (int i = 0; i <= n; ++i) mesh.positions.push_back({p.x, double(i) / n, p.z});
  }
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = row * (n + 1) + i;
      mesh.triangles.push_back({a, a + n + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + 1});
    }
  }
  const Brep brep = checkedBrep(mesh);
  EXPECT_EQ(brep.faces.size(), 2U);
  EXPECT_EQ(edgesOfKind(brep, EdgeKind::sharp), 1U);
}

TEST(Brep, RefusesAnEmptyMeshAndCanBeCancelled) {
  SilentProgress silent;
  EXPECT_EQ(recoverBrep({}, {}, silent).error().code, ErrorCode::noSurface);
  class Stop final : public Progress {
    bool report(Stage, double) override { return false; }
  } stop;
  EXPECT_EQ(recoverBrep(shapes::square(2), {}, stop).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace qmcf
