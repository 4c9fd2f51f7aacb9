#pragma once

#include <optional>
#include <vector>

#include "qmcf/mesh/trace.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "qmcf/topology/brep.hpp"
#include "run_options.hpp"

namespace qmcf {

/// A part that is to be meshed, and what all its meshes have in common. Refers to what it was made of.
struct Part {
  Part(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options);

  const TriangleMesh& mesh;
  const Brep& brep;
  const RunOptions& options;
  std::optional<TraceScale> traceScale;  ///< Of the histories, if they are asked for.
  std::vector<TriangleBvh> faceTrees;    ///< Per face, over its input triangles.
};

}  // namespace qmcf
