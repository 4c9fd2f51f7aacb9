#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

/// Small models whose topology is known, and checks that hold for every B-rep.
namespace qmcf::shapes {

/// A grid of columns x rows cells, two triangles each, with vertex (i, j) at place(i / columns, j / rows).
/// Closed in a direction when wrapU or wrapV is set.
TriangleMesh grid(int columns, int rows, const std::function<Vec3(double, double)>& place, bool wrapU = false,
                  bool wrapV = false);

/// A flat unit square in the plane z = 0, seen from above.
TriangleMesh square(int cells);

/// The unit cube with cells x cells squares on each side, as six separate sheets that share no vertex.
TriangleMesh cubeSoup(int cells);

/// A cylinder of radius 1 from z = 0 to z = height, with caps that are fans around their centre.
TriangleMesh cylinder(int segments, int rows, double height);

/// A prism of height 1 over a polygon (counter-clockwise) that is star-shaped about `center`; its caps are fans.
TriangleMesh prism(const std::vector<Vec2>& polygon, Vec2 center);

TriangleMesh torus(int around, int across, double major, double minor);

/// A strip of the given number of cells with a half turn.
TriangleMesh moebius(int cells, int rows);

/// Adds the triangles of b after those of a; vertices are not shared.
TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b);

TriangleMesh moved(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map);

/// repair() without a defect in the call itself.
TriangleMesh repaired(const TriangleMesh& mesh);

/// Runs recoverBrep and checks everything that must hold for any mesh: triangles belong to one face, every face is a
/// manifold surface whose boundary is its loops, each edge is used as often as it has triangles, corner angles are
/// those of the face's surface, Gauss-Bonnet.
Brep checkedBrep(const TriangleMesh& mesh, double featureAngle = 30.0);

/// The corner quads of all loops of a face, sorted.
std::vector<std::int32_t> cornerQuads(const BrepFace& face);

}  // namespace qmcf::shapes
