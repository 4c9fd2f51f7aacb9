#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf::test {

/// A rectangle of nx x ny quads with the given corner and sides, its vertices row by row.
inline QuadMesh quadSheet(int nx, int ny, const Vec3& origin, const Vec3& u, const Vec3& v) {
  QuadMesh mesh;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.positions.push_back(origin + u * (double(i) / nx) + v * (double(j) / ny));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::int32_t a = j * (nx + 1) + i;
      mesh.elements.push_back({a, a + 1, a + nx + 2, a + nx + 1});
    }
  }
  mesh.elementFace.assign(mesh.elements.size(), 0);
  return mesh;
}

/// Appends `other` and merges vertices at equal positions when `weld` is set.
inline void append(QuadMesh& mesh, const QuadMesh& other, bool weld) {
  std::map<std::tuple<double, double, double>, std::int32_t> known;
  const auto keyOf = [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    known.emplace(keyOf(mesh.positions[v]), static_cast<std::int32_t>(v));
  }
  std::vector<std::int32_t> renamed;
  for (const Vec3& p : other.positions) {
    const auto found = known.find(keyOf(p));
    if (weld && found != known.end()) {
      renamed.push_back(found->second);
    } else {
      renamed.push_back(static_cast<std::int32_t>(mesh.positions.size()));
      mesh.positions.push_back(p);
    }
  }
  for (Element element : other.elements) {
    for (std::size_t c = 0; c < cornerCount(element); ++c) {
      element[c] = renamed[static_cast<std::size_t>(element[c])];
    }
    mesh.elements.push_back(element);
    mesh.elementFace.push_back(0);
  }
}

/// The surface of the cube [0, n]^3 as unit quads, facing outwards; welded, since all coordinates are whole numbers.
inline QuadMesh quadCube(int n) {
  const double s = n;
  const Vec3 x{s, 0, 0};
  const Vec3 y{0, s, 0};
  const Vec3 z{0, 0, s};
  QuadMesh mesh;
  append(mesh, quadSheet(n, n, {}, y, x), true);
  append(mesh, quadSheet(n, n, z, x, y), true);
  append(mesh, quadSheet(n, n, {}, x, z), true);
  append(mesh, quadSheet(n, n, y, z, x), true);
  append(mesh, quadSheet(n, n, {}, z, y), true);
  append(mesh, quadSheet(n, n, x, y, z), true);
  return mesh;
}

/// Each quad cut along a diagonal.
inline TriangleMesh triangulated(const QuadMesh& mesh) {
  TriangleMesh result;
  result.positions = mesh.positions;
  for (const Element& e : mesh.elements) {
    result.triangles.push_back({e[0], e[1], e[2]});
    if (cornerCount(e) == 4) result.triangles.push_back({e[0], e[2], e[3]});
  }
  return result;
}

}  // namespace qmcf::test
