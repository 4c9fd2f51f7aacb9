#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf::testing {

/// The vertices of a patch, without elements.
inline FaceMesh verticesOf(const Patch& patch) {
  FaceMesh mesh;
  for (const VertexId v : patch.surface.vertices()) {
    const HalfedgeId h = patch.surface.outgoing(v);
    SurfacePoint location{Surface::triangle(h), {0, 0, 0}};
    location.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0;
    mesh.positions.push_back(patch.surface.position(v));
    mesh.normals.push_back(patch.normal[v]);
    mesh.locations.push_back(location);
    mesh.patchVertex.push_back(patch.surface.isBoundary(v) ? v.value : kNone);
  }
  return mesh;
}

/// The cells x cells grid of quads of a square patch.
inline FaceMesh gridMesh(const Patch& patch, int cells) {
  FaceMesh mesh = verticesOf(patch);
  const Surface& surface = patch.surface;
  const auto vertexAt = [&](int i, int j) {
    const Vec3 wanted{static_cast<double>(i) / cells, static_cast<double>(j) / cells, 0.0};
    for (const VertexId v : surface.vertices()) {
      if (distance(surface.position(v), wanted) < 1e-9) return v.value;
    }
    return kNone;
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.elements.push_back({vertexAt(i, j), vertexAt(i + 1, j), vertexAt(i + 1, j + 1), vertexAt(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace qmcf::testing
