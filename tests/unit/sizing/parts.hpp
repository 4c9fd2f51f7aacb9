#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

/// Small parts tessellated the way CAD programs do it: no vertices inside planar faces, needles along cylinders.
namespace qmcf::parts {

/// Adds the quadrilateral a, b, c, d as two triangles.
inline void addQuad(TriangleMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// A square with a crack from one side to its middle, `open` wide there. The lower side of the crack is shorter, so
/// that equal divisions of both are not across from each other.
inline TriangleMesh crackedSquare(double open) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},     {1, 0.5 * open, 0},    {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0},
                    {0.94, -1, 0}, {0.94, -0.5 * open, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}};
  return mesh;
}

inline TriangleMesh box(double x, double y, double z) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back({(i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0});
  }
  addQuad(mesh, 0, 2, 3, 1);
  addQuad(mesh, 4, 5, 7, 6);
  addQuad(mesh, 0, 1, 5, 4);
  addQuad(mesh, 2, 6, 7, 3);
  addQuad(mesh, 0, 4, 6, 2);
  addQuad(mesh, 1, 3, 7, 5);
  return mesh;
}

inline Vec3 onCircle(double radius, double turn, double z = 0.0) {
  return {radius * math::cos(2.0 * math::kPi * turn), radius * math::sin(2.0 * math::kPi * turn), z};
}

/// The part of a disk between two turns (0 to 1: the whole disk) as a fan from its centre or, whole, from a rim vertex.
inline TriangleMesh disk(int segments, double radius, double turns = 1.0) {
  TriangleMesh mesh;
  const bool whole = turns >= 1.0;
  if (!whole) mesh.positions.push_back({});
  for (int i = 0; i < segments + (whole ? 0 : 1); ++i) {
    mesh.positions.push_back(onCircle(radius, turns * i / segments));
  }
  const auto count = static_cast<std::int32_t>(mesh.positions.size());
  for (std::int32_t i = 1; i + 1 < count; ++i) mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

/// A strip between two rings of points, closed.
inline TriangleMesh strip(const std::vector<Vec3>& inner, const std::vector<Vec3>& outer) {
  TriangleMesh mesh;
  mesh.positions = inner;
  mesh.positions.insert(mesh.positions.end(), outer.begin(), outer.end());
  const auto n = static_cast<std::int32_t>(inner.size());
  for (std::int32_t i = 0; i < n; ++i) addQuad(mesh, i, n + i, n + (i + 1) % n, (i + 1) % n);
  return mesh;
}

inline std::vector<Vec3> ring(int segments, double radius, double z = 0.0, double phase = 0.0) {
  std::vector<Vec3> points;
  for (int i = 0; i < segments; ++i) points.push_back(onCircle(radius, static_cast<double>(i) / segments + phase, z));
  return points;
}

inline TriangleMesh annulus(int segments, double inner, double outer) {
  return strip(ring(segments, inner), ring(segments, outer));
}

/// The side of a cylinder around z, seen from outside, in `rows` rows.
inline TriangleMesh cylinderSide(int segments, int rows, double radius, double height) {
  TriangleMesh mesh;
  for (int row = 0; row <= rows; ++row) {
    const std::vector<Vec3> points = ring(segments, radius, height * row / rows);
    mesh.positions.insert(mesh.positions.end(), points.begin(), points.end());
  }
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t i = 0; i < segments; ++i) {
      const std::int32_t j = (i + 1) % segments;
      addQuad(mesh, row * segments + i, row * segments + j, (row + 1) * segments + j, (row + 1) * segments + i);
    }
  }
  return mesh;
}

/// The square [-half, half]^2 with a round hole at `center`; only the corners and the hole have vertices.
/// \pre segments is a multiple of 4.
inline TriangleMesh plateWithHole(double half, Vec3 center, double radius, std::int32_t segments) {
  TriangleMesh mesh;
  for (const Vec3& offset : ring(segments, radius)) mesh.positions.push_back(center + offset);
  const std::array<Vec3, 4> corners{Vec3{half, half, 0}, {-half, half, 0}, {-half, -half, 0}, {half, -half, 0}};
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  const std::int32_t quarter = segments / 4;
  for (std::int32_t q = 0; q < 4; ++q) {
    const std::int32_t corner = segments + q;
    for (std::int32_t i = 0; i < quarter; ++i) {
      mesh.triangles.push_back({q * quarter + i, corner, (q * quarter + i + 1) % segments});
    }
    mesh.triangles.push_back({(q + 1) * quarter % segments, corner, segments + (q + 1) % 4});
  }
  return mesh;
}

/// The unit sphere as a blown-up cube of cells x cells squares a side.
inline TriangleMesh sphere(int cells) {
  TriangleMesh mesh;
  const auto at = [&](int side, int i, int j) {
    const double u = 2.0 * i / cells - 1.0;
    const double v = 2.0 * j / cells - 1.0;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const std::array<double, 3> c{sign, u * sign, v};
    const auto axis = static_cast<std::size_t>(side / 2);
    return normalized(Vec3{c[(3 - axis) % 3], c[(4 - axis) % 3], c[(5 - axis) % 3]});
  };
  const auto add = [&](const Vec3& p) {
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
      if (distance(mesh.positions[k], p) < 1e-9) return static_cast<std::int32_t>(k);
    }
    mesh.positions.push_back(p);
    return static_cast<std::int32_t>(mesh.positions.size() - 1);
  };
  for (int side = 0; side < 6; ++side) {
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        addQuad(mesh, add(at(side, i, j)), add(at(side, i + 1, j)), add(at(side, i + 1, j + 1)),
                add(at(side, i, j + 1)));
      }
    }
  }
  return mesh;
}

/// A flat sheet of rectangles between the given lines; `keep` says which stay.
template <class Keep>
TriangleMesh sheet(const std::vector<double>& xs, const std::vector<double>& ys, Keep keep) {
  TriangleMesh mesh;
  const auto columns = static_cast<std::int32_t>(xs.size());
  const auto rows = static_cast<std::int32_t>(ys.size());
  for (const double y : ys) {
    for (const double x : xs) mesh.positions.push_back({x, y, 0.0});
  }
  for (std::int32_t j = 0; j + 1 < rows; ++j) {
    for (std::int32_t i = 0; i + 1 < columns; ++i) {
      const std::int32_t a = j * columns + i;
      if (keep(i, j)) addQuad(mesh, a, a + 1, a + columns + 1, a + columns);
    }
  }
  return mesh;
}

/// Three unit sheets that meet in one edge along z, divided as asked along that edge and around.
inline TriangleMesh tee() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.push_back(onCircle(1.0 + 0.13 * i, i / 3.0));
    mesh.positions.push_back(onCircle(1.0 + 0.13 * i, i / 3.0, 1.0));
    addQuad(mesh, 0, first, first + 1, 1);
  }
  return mesh;
}

inline Brep brepOf(const TriangleMesh& mesh) {
  SilentProgress progress;
  Result<Brep> brep = recoverBrep(mesh, {}, progress);
  return std::move(brep).value();
}

}  // namespace qmcf::parts
