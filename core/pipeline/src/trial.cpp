#include "trial.hpp"

#include <string>
#include <utility>

#include "settled_face.hpp"

namespace qmcf {
namespace {

/// Two faces between the same edges that are nearer to each other than this, in units of the base, get one mesh.
constexpr double kTellApart = 0.25;

CoveredFaces noneCovered(const Brep& brep) {
  return {std::vector<std::int32_t>(brep.faces.size(), kNone), std::vector<std::uint8_t>(brep.faces.size(), 0)};
}

MeshedFace omittedFace(std::int32_t face, std::int32_t below) {
  MeshedFace omitted;
  omitted.report.face = face;
  omitted.report.method = "omitted";
  omitted.report.reason = "it lies on face " + std::to_string(below) + ", nearer than elements of this size can tell";
  return omitted;
}

/// Meshes what changed. settles: sizes settle with the meshes.
std::optional<Error> meshFaces(const Part& part, Trial& trial, bool settles, Progress& progress) {
  for (const std::int32_t face : trial.prepared.changed) {
    const auto f = static_cast<std::size_t>(face);
    if (trial.covered.below[f] != kNone) trial.faces[f] = omittedFace(face, trial.covered.below[f]);
  }
  const auto mesh = [&](std::int32_t face, Progress& own) -> std::optional<Error> {
    auto meshed = settles ? meshSettled(part, trial.prepared, face, own) : meshFace(part, trial.prepared, face, own);
    if (!meshed) return meshed.error();
    trial.faces[static_cast<std::size_t>(face)] = std::move(meshed).value();
    return std::nullopt;
  };
  return forEachFace(part, trial, trial.prepared.changed, progress, mesh);
}

}  // namespace

Result<Trial> makeTrial(const Part& part, const RunOptions& options, PreparedFaces prepared, Progress& progress) {
  // Elements that are cut up have a vertex of their own each, so that those of two layers always are told apart.
  auto covered = options.leftovers == Leftovers::cut ? noneCovered(part.brep)
                                                     : coveredFaces(part, kTellApart * prepared.size.base, progress);
  if (!covered) return covered.error();
  Trial trial{std::move(prepared), std::move(covered).value(), std::vector<MeshedFace>(part.brep.faces.size())};
  const bool settles = settlesWithMeshes(part, trial.prepared);
  if (const auto error = meshFaces(part, trial, settles, progress)) return *error;
  return trial;
}

std::optional<Error> meshChanged(const Part& part, Trial& trial, Progress& progress) {
  return meshFaces(part, trial, false, progress);
}

}  // namespace qmcf
