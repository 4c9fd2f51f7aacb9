#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "qmcf/mesh/patch.hpp"

namespace qmcf::testing {

using Corners = std::vector<std::array<std::int32_t, 3>>;

/// A patch from a triangle soup: normals averaged by area, one size everywhere, quads wanted from the fans' angles (2
/// where the boundary bends by less than `kink` degrees), one edge of the B-rep per chain between corners.
Patch makePatch(const std::vector<Vec3>& positions, const Corners& triangles, double size, double kink = 40.0);

/// A grid of nx by ny cells over the unit square, mapped into space; cells are split along alternating diagonals.
struct Grid {
  int nx = 1;
  int ny = 1;
  bool closedX = false;
  bool closedY = false;
  std::function<Vec3(double, double)> map;
  std::function<bool(double, double)> keep;  ///< Of a cell's centre; empty: every cell.
};
Patch makeGrid(const Grid& grid, double size, double kink = 40.0);

/// The square [0, 1]^2 in the plane z = 0.
Patch makeSquare(int cells);
/// The unit disk with `rings` rings of triangles; its boundary has 6 * rings nodes.
Patch makeDisk(int rings);
/// The regular polygon of radius 1 with a hole of radius 1/2 that is a polygon too, or round; sides cut into `cells`.
Patch makePolygonRing(int sides, int cells, int layers, bool roundHole);
/// The unit sphere, from an octahedron whose edges are cut into `cells`.
Patch makeSphere(int cells);
/// The torus of radii 1 and `tube`.
Patch makeTorus(int around, int along, double tube = 0.4);
/// The tube of radius 1 and the given height around z, turned helically by `twist` radians along it. Exact normals.
Patch makeCylinder(int around, int along, double height, double twist = 0.0);
/// A cone from radius 1 at z = 0 to `top` at the given height. Exact normals.
Patch makeCone(int around, int along, double height, double top);

/// A rounded slab with the given number of holes through it, closed: a surface of that genus.
Patch makePretzel(int holes, int cells);

/// The same patch moved in space.
Patch transformed(const Patch& patch, const std::function<Vec3(const Vec3&)>& move);

}  // namespace qmcf::testing
