#include "prepare.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "qmcf/base/parallel.hpp"
#include "qmcf/qmorph/qmorph.hpp"
#include "qmcf/sizing/point_grid.hpp"
#include "settle_sizes.hpp"

namespace qmcf {
namespace {

/// Each round at least doubles the divisions of an edge that was too coarse; then its faces get their own triangles.
constexpr int kMaxDivisionRounds = 12;
/// Rounds in which faces that are still too coarse get their own triangles, and their neighbours what that makes of
/// them.
constexpr int kMaxGivenRounds = 8;
/// Each round halves the size at the places that are missed.
constexpr int kMissedRounds = 3;
constexpr int kMoreMissedRounds = 1;  ///< Where a preparation before has found most.
/// With ten divisions in a full turn the chords of an arc stay within a tenth of their length of it.
constexpr std::int32_t kDivisionsPerTurn = 10;

FieldOptions fieldOptions(const RunOptions& options) {
  FieldOptions field;
  field.boundary = options.alignBoundary;
  field.sharp = options.alignSharp;
  field.nonManifold = options.alignNonManifold;
  field.curvature = options.alignCurvature;
  field.strokes = options.strokes;
  return field;
}

SizingOptions sizingOptions(const RunOptions& options, const SizeScale* scale) {
  SizingOptions sizing;
  sizing.scale = scale;
  sizing.size = options.size;
  if (sizing.size && scale != nullptr) *sizing.size /= scale->mean();
  sizing.quads = options.quads;
  sizing.vertexSize = options.sizes;
  sizing.curvature = options.curvature;
  sizing.gradation = options.gradation;
  sizing.divisionsPerTurn = kDivisionsPerTurn;
  if (options.leftovers == Leftovers::cut) {
    // Each element will be cut at the middles of its edges.
    if (sizing.size) *sizing.size *= 2.0;
    for (double& size : sizing.vertexSize) size *= 2.0;
    // The middle of a chord twice as long is four times as far from its arc.
    if (sizing.curvature) *sizing.curvature *= 4.0;
    if (sizing.quads) *sizing.quads = std::max<std::int64_t>(1, *sizing.quads / 4);
    sizing.divisionsPerTurn = kDivisionsPerTurn / 2;
  }
  return sizing;
}

void useSizes(SizingOptions& sizing, const PreparedSizes& sizes) {
  sizing.size = sizes.base;
  sizing.quads.reset();
  sizing.limits = sizes.limits;
  sizing.chordSize = sizes.chordSize;
}

/// Apart from the sizes.
bool isSamePatch(const Patch& a, const Patch& b) {
  return a.surface == b.surface && a.normal == b.normal && a.cornerQuads == b.cornerQuads && a.edge == b.edge;
}

/// The sizes that a face was prepared with.
const IdMap<VertexId, double>& sizesAtFirst(const PreparedFaces& prepared, std::size_t face) {
  const IdMap<VertexId, double>& before = prepared.sizesBefore[face];
  return before.empty() ? prepared.patches[face].size : before;
}

/// The stages up to the cross fields, as often as the faces ask for smaller elements.
class Preparation {
 public:
  Preparation(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options, const SizeScale* scale,
              Settling settling, PreparedFaces before, Progress& progress)
      : mesh_(mesh),
        brep_(brep),
        options_(options),
        settling_(settling),
        result_(std::move(before)),
        progress_(progress),
        sizing_(sizingOptions(options, scale)) {
    if (options.mode == Mode::qmorph) background_.relativeSize = background_.flatSize = kMorphTriangleSize;
    minimum_.assign(brep.edges.size(), 1);
    done_.assign(brep.faces.size(), !result_.patches.empty());
    changed_.assign(brep.faces.size(), result_.patches.empty());
    result_.patches.resize(brep.faces.size());
    result_.fields.resize(brep.faces.size());
    result_.given.resize(brep.faces.size(), Given::nothing);
    result_.wantedElements.resize(brep.faces.size(), 0.0);
    result_.settled.resize(brep.faces.size(), 0);
    result_.sizesBefore.resize(brep.faces.size());
    give(std::move(result_.given));
  }

  /// Some faces are made of the part's own triangles.
  void give(std::vector<Given> given) {
    result_.given = std::move(given);
    asGiven_.assign(brep_.edges.size(), 0);
    for (std::size_t f = 0; f < result_.given.size(); ++f) {
      if (result_.given[f] == Given::nothing) continue;
      for (const BrepLoop& loop : brep_.faces[f].loops) {
        for (const Coedge& coedge : loop.coedges) asGiven_[static_cast<std::size_t>(coedge.edge)] = 1;
      }
    }
  }

  /// As keepBaseSize(), with what another preparation had.
  void keepSizes(const PreparedSizes& sizes) {
    useSizes(sizing_, sizes);
    minimum_ = sizes.minimumDivisions;
  }

  /// From now on the base size is what it was, whatever number of elements that makes.
  void keepBaseSize() {
    keepSizes({result_.size.base, result_.size.limits, result_.minimumDivisions, result_.size.chordSize});
  }

  Result<PreparedFaces> run(const std::vector<SizeLimit>& limits) {
    if (const auto error = computeSizes(limits)) return *error;
    int missedRounds = limits.empty() ? kMissedRounds : kMoreMissedRounds;
    for (int round = 0; round < kMaxDivisionRounds + kMaxGivenRounds; ++round) {
      divide();
      if (const auto error = triangulate()) return *error;
      if (!tooCoarse_.empty()) {
        if (round + 1 >= kMaxDivisionRounds || !raiseMinimum()) giveUnfinished();
      } else if (!missed_.empty() && missedRounds > 0) {
        --missedRounds;
        if (const auto error = computeSizes(missed_)) return *error;
      } else {
        return finish();
      }
    }
    const std::string first = tooCoarse_.empty() ? "" : ", first at edge " + std::to_string(tooCoarse_.front());
    return Error{ErrorCode::internal,
                 "The faces beside " + std::to_string(tooCoarse_.size()) +
                     " edges could not be triangulated with any number of divisions of these" + first + ".",
                 {tooCoarse_.begin(), tooCoarse_.end()}};
  }

 private:
  std::optional<Error> computeSizes(const std::vector<SizeLimit>& more) {
    const double base = result_.size.base;
    sizing_.limits.insert(sizing_.limits.end(), more.begin(), more.end());
    auto size = computeSizeField(mesh_, brep_, sizing_, progress_);
    if (!size) return size.error();
    result_.size = std::move(size).value();
    if (result_.size.base != base) done_.assign(done_.size(), false);
    for (const SizeLimit& limit : more) done_[static_cast<std::size_t>(limit.face)] = false;
    return std::nullopt;
  }

  /// Divides the edges; faces whose edges keep their nodes keep their triangulations.
  void divide() {
    const DividedEdges before = std::move(result_.divided);
    result_.divided =
        divideEdges(mesh_, brep_, result_.size, minimum_, asGiven_, options_.leftovers == Leftovers::paired);
    const DividedEdges& now = result_.divided;
    if (before.edges.empty()) return;
    std::vector<std::int32_t> newNode(before.nodes.size(), kNone);
    std::vector<bool> kept(brep_.edges.size(), false);
    for (std::size_t e = 0; e < brep_.edges.size(); ++e) {
      const EdgeDivision& was = before.edges[e];
      const EdgeDivision& is = now.edges[e];
      kept[e] = was.arcLength == is.arcLength;
      for (std::size_t i = 0; kept[e] && i < is.nodes.size(); ++i) {
        newNode[static_cast<std::size_t>(was.nodes[i])] = is.nodes[i];
        kept[e] = before.nodeSize[static_cast<std::size_t>(was.nodes[i])] ==
                  now.nodeSize[static_cast<std::size_t>(is.nodes[i])];
      }
    }
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      for (const BrepLoop& loop : brep_.faces[f].loops) {
        for (const Coedge& coedge : loop.coedges) {
          if (!kept[static_cast<std::size_t>(coedge.edge)]) done_[f] = false;
        }
      }
      if (!done_[f]) continue;
      for (std::int32_t& node : result_.patches[f].node.raw()) {
        if (node != kNone) node = newNode[static_cast<std::size_t>(node)];
      }
    }
  }

  void take(std::size_t f, BackgroundResult background) {
    tooCoarse_.insert(tooCoarse_.end(), background.tooCoarse.begin(), background.tooCoarse.end());
    missed_.insert(missed_.end(), background.missed.begin(), background.missed.end());
    changed_[f] = true;
    done_[f] = background.tooCoarse.empty();
    if (!done_[f]) return;
    result_.patches[f] = std::move(background.patch);
    result_.sizesBefore[f] = {};
  }

  /// Drops what was missed where a limit that was there before asks for hardly larger elements: what these miss, the
  /// same limit again won't reach.
  void dropAskedFor() {
    constexpr double kHardlyLarger = 1.1;
    constexpr double kSamePlace = 0.5;  // In units of the limit, which is at most the base size.
    const std::vector<SizeLimit>& limits = sizing_.limits;
    if (missed_.empty() || limits.empty()) return;
    std::vector<Vec3> positions;
    std::vector<std::int32_t> ids;
    for (const SizeLimit& limit : limits) {
      ids.push_back(static_cast<std::int32_t>(positions.size()));
      positions.push_back(limit.position);
    }
    const PointGrid grid(positions, ids, result_.size.base);
    std::erase_if(missed_, [&](const SizeLimit& limit) {
      bool isThere = false;
      grid.forEachNear(limit.position, [&](std::int32_t id) {
        const SizeLimit& before = limits[static_cast<std::size_t>(id)];
        isThere = isThere || (before.face == limit.face && before.size <= kHardlyLarger * limit.size &&
                              distance(before.position, limit.position) <= kSamePlace * limit.size);
      });
      return isThere;
    });
  }

  std::optional<Error> triangulate() {
    tooCoarse_.clear();
    missed_.clear();
    std::vector<std::size_t> due;
    std::vector<double> areas;
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      if (done_[f]) continue;
      due.push_back(f);
      areas.push_back(brep_.faces[f].area);
    }
    std::vector<BackgroundResult> built(due.size());
    const auto build = [&](std::size_t i, Progress& progress) -> std::optional<Error> {
      const auto face = static_cast<std::int32_t>(due[i]);
      if (result_.given[due[i]] != Given::nothing) {
        built[i].patch = givenTriangles(brep_, face, result_.size, result_.divided);
        return std::nullopt;
      }
      auto background = buildBackground(mesh_, brep_, face, result_.size, result_.divided, background_, progress);
      if (!background) return background.error();
      built[i] = std::move(background).value();
      return std::nullopt;
    };
    if (const auto error = parallelFor(areas, threadsOf(options_), progress_, build)) return *error;
    for (std::size_t i = 0; i < due.size(); ++i) take(due[i], std::move(built[i]));
    dropAskedFor();
    std::sort(tooCoarse_.begin(), tooCoarse_.end());
    tooCoarse_.erase(std::unique(tooCoarse_.begin(), tooCoarse_.end()), tooCoarse_.end());
    return std::nullopt;
  }

  /// Faces that no number of divisions was enough for get their own triangles.
  void giveUnfinished() {
    std::vector<Given> given = std::move(result_.given);
    for (std::size_t f = 0; f < given.size(); ++f) {
      if (!done_[f]) given[f] = Given::pairs;
    }
    give(std::move(given));
  }

  /// Doubles the lower bounds of the edges that a face found too coarse. Returns whether any could be raised.
  bool raiseMinimum() {
    bool raised = false;
    for (const std::int32_t edge : tooCoarse_) {
      const auto e = static_cast<std::size_t>(edge);
      if (asGiven_[e] != 0) continue;
      const auto now = static_cast<std::int32_t>(result_.divided.edges[e].nodes.size()) - 1;
      const std::int32_t wanted = 2 * std::max(now, minimum_[e]);
      if (wanted <= minimum_[e]) continue;
      minimum_[e] = wanted;
      raised = true;
    }
    return raised;
  }

  Result<PreparedFaces> finish() {
    std::vector<std::uint8_t> kinds;
    for (const BrepEdge& edge : brep_.edges) kinds.push_back(static_cast<std::uint8_t>(edge.kind));
    result_.changed.clear();
    std::vector<double> costs;
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      if (!changed_[f]) continue;
      result_.changed.push_back(static_cast<std::int32_t>(f));
      costs.push_back(static_cast<double>(result_.patches[f].surface.triangleCount()));
    }
    const auto solve = [&](std::size_t i, Progress& progress) -> std::optional<Error> {
      const auto f = static_cast<std::size_t>(result_.changed[i]);
      if (settling_ != Settling::none) {
        if (auto error = spreadInside(result_, f, options_, progress)) return error;
      }
      if (result_.given[f] != Given::nothing || options_.mode == Mode::qmorph) return std::nullopt;
      auto field = computeCrossField(result_.patches[f], kinds, fieldOptions(options_), progress);
      if (!field) return field.error();
      result_.fields[f] = std::move(field).value();
      return std::nullopt;
    };
    if (const auto error = parallelFor(costs, threadsOf(options_), progress_, solve)) return *error;
    if (settling_ == Settling::turned) {
      if (const auto error = turnSizes(result_, result_.changed, options_, progress_)) return *error;
    }
    result_.minimumDivisions = minimum_;
    return std::move(result_);
  }

  const TriangleMesh& mesh_;
  const Brep& brep_;
  const RunOptions& options_;
  Settling settling_;
  PreparedFaces result_;
  Progress& progress_;
  SizingOptions sizing_;
  BackgroundOptions background_;
  std::vector<std::uint8_t> asGiven_;    ///< Per edge: divided at the part's own points.
  std::vector<std::int32_t> minimum_;    ///< Per edge: divisions that its faces asked for.
  std::vector<bool> done_;               ///< Per face: the triangulation fits sizes and divisions.
  std::vector<bool> changed_;            ///< Per face: triangulated anew since the start.
  std::vector<std::int32_t> tooCoarse_;  ///< Edges, ascending.
  std::vector<SizeLimit> missed_;
};

}  // namespace

std::int32_t threadsOf(const RunOptions& options) {
  return options.threads ? static_cast<std::int32_t>(*options.threads) : hardwareThreads();
}

Settling settlingOf(const RunOptions& options) {
  return options.fitSizes.value_or(false) ? Settling::turned : Settling::none;
}

Result<PreparedFaces> prepareFaces(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                   const SizeScale* scale, Settling settling, const std::vector<SizeLimit>& limits,
                                   Progress& progress) {
  return Preparation(mesh, brep, options, scale, settling, {}, progress).run(limits);
}

std::optional<Error> turnSizes(PreparedFaces& prepared, const std::vector<std::int32_t>& faces,
                               const RunOptions& options, Progress& progress) {
  std::vector<double> costs;
  for (const std::int32_t face : faces) {
    costs.push_back(static_cast<double>(prepared.patches[static_cast<std::size_t>(face)].surface.triangleCount()));
  }
  const auto turn = [&](std::size_t i, Progress& own) {
    return turnInside(prepared, static_cast<std::size_t>(faces[i]), options, own);
  };
  return parallelFor(costs, threadsOf(options), progress, turn);
}

Result<PreparedFaces> refineFaces(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                  const SizeScale* scale, PreparedFaces prepared, const std::vector<SizeLimit>& limits,
                                  Progress& progress) {
  Preparation preparation(mesh, brep, options, scale, settlingOf(options), std::move(prepared), progress);
  preparation.keepBaseSize();
  return preparation.run(limits);
}

Result<PreparedFaces> prepareGiven(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                   const SizeScale* scale, const PreparedSizes& before, const std::vector<Given>& given,
                                   Progress& progress) {
  Preparation preparation(mesh, brep, options, scale, settlingOf(options), {}, progress);
  preparation.keepSizes(before);
  preparation.give(given);
  return preparation.run({});
}

void keepUnchanged(const PreparedFaces& before, PreparedFaces& now) {
  std::erase_if(now.changed, [&](std::int32_t face) {
    const auto f = static_cast<std::size_t>(face);
    if (before.given[f] != now.given[f] || !isSamePatch(before.patches[f], now.patches[f]) ||
        sizesAtFirst(before, f) != sizesAtFirst(now, f)) {
      return false;
    }
    now.patches[f].size = before.patches[f].size;
    now.sizesBefore[f] = before.sizesBefore[f];
    now.settled[f] = before.settled[f];
    return true;
  });
}

Result<SizeField> sizeField(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                            const SizeScale* scale, const PreparedSizes& sizes, Progress& progress) {
  SizingOptions sizing = sizingOptions(options, scale);
  useSizes(sizing, sizes);
  return computeSizeField(mesh, brep, sizing, progress);
}

}  // namespace qmcf
