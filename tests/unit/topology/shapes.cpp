#include "topology/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "qmcf/base/math.hpp"
#include "qmcf/topology/repair.hpp"

namespace qmcf::shapes {

using math::kPi;

TriangleMesh grid(int columns, int rows, const std::function<Vec3(double, double)>& place, bool wrapU, bool wrapV) {
  TriangleMesh mesh;
  const int width = wrapU ? columns : columns + 1;
  const int height = wrapV ? rows : rows + 1;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) mesh.positions.push_back(place(double(i) / columns, double(j) / rows));
  }
  const auto id = [&](int i, int j) { return (j % height) * width + i % width; };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh square(int cells) {
  return grid(cells, cells, [](double u, double v) { return Vec3{u, v, 0.0}; });
}

TriangleMesh cubeSoup(int cells) {
  const auto side = [&](Vec3 origin, Vec3 x, Vec3 y) {
    return grid(cells, cells, [=](double u, double v) { return origin + x * u + y * v; });
  };
  const Vec3 o{0, 0, 0};
  const Vec3 x{1, 0, 0};
  const Vec3 y{0, 1, 0};
  const Vec3 z{0, 0, 1};
  TriangleMesh cube = side(o, y, x);
  for (const TriangleMesh& s : {side(z, x, y), side(o, x, z), side(y, z, x), side(o, z, y), side(x, y, z)}) {
    cube = join(cube, s);
  }
  return cube;
}

TriangleMesh cylinder(int segments, int rows, double height) {
  TriangleMesh mesh = grid(
      segments, rows,
      [&](double u, double v) {
        return Vec3{math::cos(2.0 * kPi * u), math::sin(2.0 * kPi * u), height * v};
      },
      true);
  const auto bottom = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({0.0, 0.0, 0.0});
  mesh.positions.push_back({0.0, 0.0, height});
  for (int i = 0; i < segments; ++i) {
    const int next = (i + 1) % segments;
    mesh.triangles.push_back({next, i, bottom});
    mesh.triangles.push_back({rows * segments + i, rows * segments + next, bottom + 1});
  }
  return mesh;
}

TriangleMesh prism(const std::vector<Vec2>& polygon, Vec2 center) {
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const Vec2& p : polygon) mesh.positions.push_back({p.x, p.y, z});
  }
  const auto n = static_cast<std::int32_t>(polygon.size());
  mesh.positions.push_back({center.x, center.y, 0.0});
  mesh.positions.push_back({center.x, center.y, 1.0});
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
    mesh.triangles.push_back({next, i, 2 * n});
    mesh.triangles.push_back({n + i, n + next, 2 * n + 1});
  }
  return mesh;
}

TriangleMesh torus(int around, int across, double major, double minor) {
  return grid(
      around, across,
      [&](double u, double v) {
        const double r = major + minor * math::cos(2.0 * kPi * v);
        return Vec3{r * math::cos(2.0 * kPi * u), r * math::sin(2.0 * kPi * u), minor * math::sin(2.0 * kPi * v)};
      },
      true, true);
}

TriangleMesh moebius(int cells, int rows) {
  TriangleMesh strip = grid(cells, rows, [](double u, double v) {
    const double a = 2.0 * kPi * u;
    const double w = v - 0.5;
    const double r = 2.0 + w * math::cos(0.5 * a);
    return Vec3{r * math::cos(a), r * math::sin(a), w * math::sin(0.5 * a)};
  });
  // The last column is the first one upside down.
  for (auto& corners : strip.triangles) {
    for (std::int32_t& v : corners) {
      if (v % (cells + 1) == cells) v = (rows - v / (cells + 1)) * (cells + 1);
    }
  }
  return strip;
}

TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto shift = static_cast<std::int32_t>(a.positions.size());
  both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
  for (auto corners : b.triangles) {
    for (std::int32_t& v : corners) v += shift;
    both.triangles.push_back(corners);
  }
  return both;
}

TriangleMesh moved(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& p : mesh.positions) p = map(p);
  return mesh;
}

TriangleMesh repaired(const TriangleMesh& mesh) {
  SilentProgress silent;
  auto result = repair(mesh, {}, silent);
  EXPECT_TRUE(result.ok());
  return result.ok() ? std::move(result).value().mesh : TriangleMesh{};
}

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

Pair pairOf(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

void checkLoop(const Brep& brep, const FaceSurface& face, const BrepLoop& loop,
               const std::vector<HalfedgeId>& halfedges, std::map<Pair, int>& uses) {
  std::size_t next = 0;
  for (const Coedge& coedge : loop.coedges) {
    const BrepEdge& edge = brep.edges[std::size_t(coedge.edge)];
    std::vector<std::int32_t> points = edge.points;
    if (coedge.reversed) std::reverse(points.begin(), points.end());
    for (std::size_t i = 0; i + 1 < points.size(); ++i, ++next) {
      ASSERT_LT(next, halfedges.size());
      const HalfedgeId h = halfedges[next];
      ASSERT_TRUE(face.surface.isBoundary(h));
      EXPECT_EQ(face.vertexPoint[face.surface.origin(h).index()], points[i]);
      EXPECT_EQ(face.vertexPoint[face.surface.target(h).index()], points[i + 1]);
      EXPECT_EQ(face.edge[h], coedge.edge);
      EXPECT_EQ(face.surface.nextBoundary(h), halfedges[(next + 1) % halfedges.size()]);
      ++uses[pairOf(points[i], points[i + 1])];
      if (i > 0) continue;
      double angle = 0.0;
      face.surface.forEachOutgoing(face.surface.origin(h), [&](HalfedgeId g) { angle += face.surface.angle(g); });
      EXPECT_NEAR(angle, coedge.cornerAngle, 1e-9);
      EXPECT_GE(coedge.cornerQuads, 1);
      EXPECT_LE(coedge.cornerQuads, 4);
    }
  }
  EXPECT_EQ(next, halfedges.size());
}

void checkGaussBonnet(const Surface& surface) {
  for (const HalfedgeId h : surface.halfedges()) {
    if (surface.length(h) == 0.0) return;  // Such a triangle has no angles.
  }
  double curvature = 0.0;
  for (const VertexId v : surface.vertices()) {
    curvature += surface.isBoundary(v) ? kPi : 2.0 * kPi;
    surface.forEachOutgoing(v, [&](HalfedgeId h) { curvature -= surface.angle(h); });
  }
  EXPECT_NEAR(curvature, 2.0 * kPi * double(surface.eulerCharacteristic()), 1e-6);
}

void checkFace(const Brep& brep, std::size_t f, std::map<Pair, int>& uses) {
  const FaceSurface& face = brep.cuts[f];
  ASSERT_EQ(face.surface.triangleCount(), brep.faces[f].triangles.size()) << "face " << f;
  EXPECT_EQ(face.triangleOrigin, brep.faces[f].triangles);
  ASSERT_EQ(face.loops.size(), brep.faces[f].loops.size());
  std::size_t boundary = 0;
  for (const HalfedgeId h : face.surface.halfedges()) {
    boundary += face.surface.isBoundary(h) ? 1U : 0U;
    EXPECT_EQ(face.surface.isBoundary(h), face.edge[h] != kNone);
  }
  std::size_t inLoops = 0;
  for (std::size_t i = 0; i < face.loops.size(); ++i) {
    checkLoop(brep, face, brep.faces[f].loops[i], face.loops[i], uses);
    inLoops += face.loops[i].size();
  }
  EXPECT_EQ(inLoops, boundary);
  checkGaussBonnet(face.surface);
}

}  // namespace

Brep checkedBrep(const TriangleMesh& mesh, double featureAngle) {
  SilentProgress silent;
  auto result = recoverBrep(mesh, {featureAngle, {}}, silent);
  EXPECT_TRUE(result.ok());
  if (!result.ok()) return {};
  Brep brep = std::move(result).value();

  std::map<Pair, int> triangleUses;
  for (const auto& c : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++triangleUses[pairOf(c[i], c[(i + 1) % 3])];
  }
  std::map<Pair, int> uses;
  std::vector<std::int32_t> faceOf(mesh.triangles.size(), kNone);
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    for (const std::int32_t t : brep.faces[f].triangles) faceOf[std::size_t(t)] = static_cast<std::int32_t>(f);
    checkFace(brep, f, uses);
  }
  EXPECT_EQ(faceOf, brep.triangleFace);
  for (const BrepEdge& edge : brep.edges) {
    EXPECT_EQ(edge.points.front(), brep.vertices[std::size_t(edge.start)].point);
    EXPECT_EQ(edge.points.back(), brep.vertices[std::size_t(edge.end)].point);
    for (std::size_t i = 1; i < edge.points.size(); ++i) {
      const Pair ends = pairOf(edge.points[i - 1], edge.points[i]);
      EXPECT_EQ(uses[ends], triangleUses[ends]);
      uses.erase(ends);
    }
  }
  for (const auto& [ends, count] : uses) EXPECT_EQ(count, 0) << "a loop runs along what is no edge";
  return brep;
}

std::vector<std::int32_t> cornerQuads(const BrepFace& face) {
  std::vector<std::int32_t> quads;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) quads.push_back(coedge.cornerQuads);
  }
  std::sort(quads.begin(), quads.end());
  return quads;
}

}  // namespace qmcf::shapes
