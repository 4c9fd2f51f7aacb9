#include <cmath>
#include <map>
#include <utility>

#include "io_support.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// The outline in a tilted plane as an OBJ with one face.
std::string polygonObj(const std::vector<Vec2>& outline, double scale = 1.0, Vec3 offset = {}) {
  std::string text;
  std::string face = "f";
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 p = outline[i] * scale;
    // Exact in doubles: a plane with the axes (1, 0, 1) and (0, 1, -2).
    char line[200];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x + offset.x, p.y + offset.y,
                  p.x - 2.0 * p.y + offset.z);
    text += line;
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}

double outlineArea(const std::vector<Vec2>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) area += cross(outline[i], outline[(i + 1) % outline.size()]) / 2.0;
  return area;
}

/// Triangles that all look the same way and whose areas add up to the polygon's cover it without overlap; each inner
/// edge occurs once in each direction and each outer edge once.
void expectTriangulation(const std::vector<Vec2>& outline, double scale = 1.0, Vec3 offset = {}) {
  const ReadModel model = readOk(polygonObj(outline, scale, offset));
  ASSERT_EQ(model.mesh.triangles.size(), outline.size() - 2);
  const Vec3 normal = normalized(cross(Vec3{1, 0, 1}, Vec3{0, 1, -2}));
  double area = 0.0;
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (std::size_t t = 0; t < model.mesh.triangles.size(); ++t) {
    const double triangleArea = dot(areaVector(model.mesh, t), normal);
    EXPECT_GT(triangleArea, 0.0);
    area += std::fabs(triangleArea);
    const auto& v = model.mesh.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) ++sides[{v[c], v[(c + 1) % 3]}];
  }
  const double expected = outlineArea(outline) * norm(cross(Vec3{1, 0, 1}, Vec3{0, 1, -2})) * scale * scale;
  EXPECT_NEAR(area / expected, 1.0, 1e-6);
  const auto count = static_cast<std::int32_t>(outline.size());
  for (const auto& [side, uses] : sides) {
    EXPECT_EQ(uses, 1);
    const bool isOuter = side.second == (side.first + 1) % count;
    EXPECT_EQ(sides.count({side.second, side.first}), isOuter ? 0U : 1U);
  }
}

const std::vector<Vec2> kArrow{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};
const std::vector<Vec2> kComb{{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1}, {5, 3}, {4, 3},
                              {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};

TEST(Polygon, ConcaveQuadrilateralIsCutInside) {
  for (std::size_t first = 0; first < 4; ++first) {
    std::vector<Vec2> outline;
    for (std::size_t i = 0; i < 4; ++i) outline.push_back(kArrow[(first + i) % 4]);
    expectTriangulation(outline);
  }
}

TEST(Polygon, ConvexQuadrilateralIsCutAlongItsShorterDiagonal) {
  const ReadModel model = readOk("v 0 0 0\nv 2 1 0\nv 4 0 0\nv 2 -1 0\nf 1 4 3 2\n");
  EXPECT_EQ(areaVector(model.mesh, 0), (Vec3{0.0, 0.0, 2.0}));
  EXPECT_EQ(areaVector(model.mesh, 1), (Vec3{0.0, 0.0, 2.0}));
}

TEST(Polygon, BentQuadrilateralIsCutFromItsFirstCorner) {
  const ReadModel model = readOk("v 0 0 0\nv 2 1 1\nv 4 0 0\nv 2 -1 1\nf 1 4 3 2\n");
  EXPECT_EQ(model.mesh.triangles[0], (std::array{0, 3, 2}));
  EXPECT_EQ(model.mesh.triangles[1], (std::array{0, 2, 1}));
}

TEST(Polygon, ConcavePolygonsAreCovered) {
  expectTriangulation(kComb);
  expectTriangulation({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {0, 1}});
  std::vector<Vec2> spiral;
  for (int i = 0; i < 200; ++i)
    spiral.push_back(math::unitComplex(0.1 * i).real() * (1.0 + 0.05 * i) * Vec2{1, 0} +
                     math::unitComplex(0.1 * i).imag() * (1.0 + 0.05 * i) * Vec2{0, 1});
  for (int i = 200; i-- > 0;)
    spiral.push_back(math::unitComplex(0.1 * i).real() * (0.9 + 0.05 * i) * Vec2{1, 0} +
                     math::unitComplex(0.1 * i).imag() * (0.9 + 0.05 * i) * Vec2{0, 1});
  if (outlineArea(spiral) < 0.0) spiral = std::vector<Vec2>(spiral.rbegin(), spiral.rend());
  expectTriangulation(spiral);
}

TEST(Polygon, StraightCornersGiveNoFlatTriangles) {
  expectTriangulation({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  expectTriangulation({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 3}});
}

TEST(Polygon, HolesJoinedByABridgeStayHoles) {
  expectTriangulation({{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}});
}

TEST(Polygon, SizeAndPlaceDoNotMatter) {
  expectTriangulation(kComb, 1e-30);
  expectTriangulation(kComb, 1e30);
  expectTriangulation(kComb, 1.0, {1e6, -1e6, 1e6});
  expectTriangulation(kArrow, 1e-30);
}

TEST(Polygon, LargePolygonsAreFast) {
  // A wheel with 20,000 teeth: a quadratic method would need billions of steps.
  std::vector<Vec2> wheel;
  constexpr int kTeeth = 20000;
  for (int i = 0; i < 2 * kTeeth; ++i) {
    const std::complex<double> direction = math::unitComplex(math::kPi * i / kTeeth);
    const double radius = i % 2 == 0 ? 1.0 : 0.99;
    wheel.push_back({direction.real() * radius, direction.imag() * radius});
  }
  expectTriangulation(wheel);
}

TEST(Polygon, NonsenseStillGivesAllTriangles) {
  const std::vector<std::vector<Vec2>> outlines{{{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 3}, {1, -1}},
                                                {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}},
                                                {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}};
  for (const auto& outline : outlines) {
    EXPECT_EQ(readOk(polygonObj(outline)).mesh.triangles.size(), outline.size() - 2);
  }
  EXPECT_EQ(readOk("v 1e308 0 0\nv -1e308 1e308 0\nv 0 0 1e308\nv 1 1 1\nv 2 2 2\nf 1 2 3 4 5\n").mesh.triangles.size(),
            3U);
}

}  // namespace
}  // namespace qmcf
