#include "prepare.hpp"

#include <algorithm>
#include <utility>

#include "qmcf/qmorph/qmorph.hpp"

namespace qmcf {
namespace {

/// Each round at least doubles the divisions of an edge that was too coarse, down to the input's own segments.
constexpr int kMaxDivisionRounds = 12;
/// With ten divisions in a full turn the chords of an arc stay within a tenth of their length of it.
constexpr std::int32_t kDivisionsPerTurn = 10;

FieldOptions fieldOptions(const MeshOptions& options) {
  FieldOptions field;
  field.boundary = options.alignBoundary;
  field.sharp = options.alignSharp;
  field.nonManifold = options.alignNonManifold;
  field.curvature = options.alignCurvature;
  return field;
}

/// Passes a stage's own fraction on as the share of one face out of many.
class FaceProgress final : public Progress {
 public:
  FaceProgress(Progress& outer, std::size_t face, std::size_t count) : outer_(outer), face_(face), count_(count) {}
  [[nodiscard]] bool report(Stage stage, double fraction) override {
    return outer_.report(stage, (static_cast<double>(face_) + fraction) / static_cast<double>(count_));
  }

 private:
  Progress& outer_;
  std::size_t face_;
  std::size_t count_;
};

/// Raises the lower bounds of the edges that a face found too coarse. Returns whether any could be raised.
bool refineEdges(const Brep& brep, const DividedEdges& divided, const std::vector<std::int32_t>& tooCoarse,
                 std::vector<std::int32_t>& minimum) {
  minimum.resize(brep.edges.size(), 1);
  bool raised = false;
  for (const std::int32_t edge : tooCoarse) {
    const auto e = static_cast<std::size_t>(edge);
    const auto now = static_cast<std::int32_t>(divided.edges[e].nodes.size()) - 1;
    const std::int32_t wanted = 2 * std::max(now, minimum[e]);
    if (wanted > minimum[e]) {
      minimum[e] = wanted;
      raised = true;
    }
  }
  return raised;
}

}  // namespace

Result<PreparedFaces> prepareFaces(const TriangleMesh& mesh, const Brep& brep, const MeshOptions& options,
                                   Progress& progress) {
  PreparedFaces prepared;
  SizingOptions sizing;
  sizing.size = options.size;
  sizing.quads = options.quads;
  sizing.gradation = options.gradation;
  sizing.divisionsPerTurn = kDivisionsPerTurn;
  auto size = computeSizeField(mesh, brep, sizing, progress);
  if (!size) return size.error();
  prepared.size = std::move(size).value();

  BackgroundOptions background;
  if (options.mode == Mode::qmorph) background.relativeSize = kMorphTriangleSize;

  const std::size_t faces = brep.faces.size();
  prepared.patches.resize(faces);
  std::vector<std::int32_t> minimum;
  std::vector<bool> done(faces, false);
  for (int round = 0; round < kMaxDivisionRounds; ++round) {
    DividedEdges divided = divideEdges(mesh, brep, prepared.size, minimum);
    // Faces whose edges kept their divisions keep their triangulations.
    for (std::size_t f = 0; round > 0 && f < faces; ++f) {
      for (const BrepLoop& loop : brep.faces[f].loops) {
        for (const Coedge& coedge : loop.coedges) {
          const auto e = static_cast<std::size_t>(coedge.edge);
          if (divided.edges[e].nodes != prepared.divided.edges[e].nodes) done[f] = false;
        }
      }
    }
    prepared.divided = std::move(divided);
    std::vector<std::int32_t> tooCoarse;
    for (std::size_t f = 0; f < faces; ++f) {
      if (done[f]) continue;
      FaceProgress faceProgress(progress, f, faces);
      auto built = buildBackground(mesh, brep, static_cast<std::int32_t>(f), prepared.size, prepared.divided,
                                   background, faceProgress);
      if (!built) return built.error();
      const auto& coarse = built.value().tooCoarse;
      tooCoarse.insert(tooCoarse.end(), coarse.begin(), coarse.end());
      done[f] = coarse.empty();
      if (coarse.empty()) prepared.patches[f] = std::move(built.value().patch);
    }
    if (tooCoarse.empty()) break;
    std::sort(tooCoarse.begin(), tooCoarse.end());
    tooCoarse.erase(std::unique(tooCoarse.begin(), tooCoarse.end()), tooCoarse.end());
    if (!refineEdges(brep, prepared.divided, tooCoarse, minimum) || round + 1 == kMaxDivisionRounds) {
      return Error{ErrorCode::internal,
                   "Some faces could not be triangulated with any number of divisions of their edges.",
                   {tooCoarse.begin(), tooCoarse.end()}};
    }
  }

  if (options.mode == Mode::qmorph) return prepared;
  std::vector<std::uint8_t> kinds;
  for (const BrepEdge& edge : brep.edges) kinds.push_back(static_cast<std::uint8_t>(edge.kind));
  for (std::size_t f = 0; f < faces; ++f) {
    FaceProgress faceProgress(progress, f, faces);
    auto field = computeCrossField(prepared.patches[f], kinds, fieldOptions(options), faceProgress);
    if (!field) return field.error();
    prepared.fields.push_back(std::move(field).value());
  }
  return prepared;
}

}  // namespace qmcf
