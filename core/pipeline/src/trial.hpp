#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "covered_faces.hpp"
#include "mesh_faces.hpp"
#include "part.hpp"
#include "prepare.hpp"
#include "qmcf/base/parallel.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "qmcf/sizing/size_scale.hpp"

namespace qmcf {

/// What one choice of sizes leads to: the meshes of all faces, each by itself.
struct Trial {
  PreparedFaces prepared;
  CoveredFaces covered;
  std::vector<MeshedFace> faces;  ///< Per face of the B-rep.
};

/// The meshes of faces that were prepared with `options`: the part's, or these with another number of elements. Where
/// that is worth it, sizes settle with the meshes (settlesWithMeshes()). Errors: cancelled.
Result<Trial> makeTrial(const Part& part, const RunOptions& options, PreparedFaces prepared, Progress& progress);

/// Meshes the faces that the last preparation made anew, once each: where a mesh was not valid, better sizes are not
/// what is missing. Errors: cancelled.
std::optional<Error> meshChanged(const Part& part, Trial& trial, Progress& progress);

/// Calls work(face, progress) for each of the faces that are not omitted, several at a time.
template <class Work>
std::optional<Error> forEachFace(const Part& part, const Trial& trial, const std::vector<std::int32_t>& faces,
                                 Progress& progress, Work work) {
  std::vector<std::int32_t> meshed;
  std::vector<double> costs;
  for (const std::int32_t face : faces) {
    const auto f = static_cast<std::size_t>(face);
    if (trial.covered.below[f] != kNone) continue;
    meshed.push_back(face);
    costs.push_back(static_cast<double>(trial.prepared.patches[f].surface.triangleCount()));
  }
  return parallelFor(costs, threadsOf(part.options), progress,
                     [&](std::size_t i, Progress& own) { return work(meshed[i], own); });
}

}  // namespace qmcf
