// Repair of triangle soups, in the order of Botsch et al. and Gueziec et al. 2001: exact identification first, then
// what changes triangles, then orientation. No
// step moves a vertex further than the tolerance.

#include "qmcf/topology/repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>

#include "coordinate_noise.hpp"
#include "qmcf/base/bounding_box.hpp"
#include "qmcf/mesh/ids.hpp"
#include "repair_state.hpp"

namespace qmcf {
namespace detail {

constexpr std::size_t kMaxElements = 100;

void note(RepairItem& item, std::int64_t id) {
  ++item.count;
  if (item.elements.size() < kMaxElements) item.elements.push_back(id);
}

void addItem(RepairState& state, RepairItem item) {
  if (item.count == 0) return;
  const auto same = std::find_if(state.items.begin(), state.items.end(),
                                 [&](const RepairItem& other) { return other.defect == item.defect; });
  if (same == state.items.end()) {
    state.items.push_back(std::move(item));
    return;
  }
  same->count += item.count;
  for (const std::int64_t id : item.elements) {
    if (same->elements.size() < kMaxElements) same->elements.push_back(id);
  }
}

void keepTriangles(RepairState& state, const std::vector<std::uint8_t>& keep) {
  TriangleMesh& mesh = state.mesh;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (keep[t] == 0) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    state.origin[kept] = state.origin[t];
    if (!mesh.labels.empty()) mesh.labels[kept] = mesh.labels[t];
    ++kept;
  }
  mesh.triangles.resize(kept);
  state.origin.resize(kept);
  if (!mesh.labels.empty()) mesh.labels.resize(kept);
}

void removeRepeatedCorners(RepairState& state) {
  const auto& triangles = state.mesh.triangles;
  std::vector<std::uint8_t> keep(triangles.size(), 1);
  RepairItem item{"degenerateTriangles", "removed: two corners are the same point", 0, {}};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& c = triangles[t];
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) continue;
    keep[t] = 0;
    note(item, state.origin[t]);
  }
  addItem(state, std::move(item));
  keepTriangles(state, keep);
}

void noteUnusedVertices(RepairState& state) {
  std::vector<std::uint8_t> used(state.mesh.positions.size(), 0);
  for (const auto& corners : state.mesh.triangles) {
    for (const std::int32_t v : corners) used[static_cast<std::size_t>(v)] = 1;
  }
  RepairItem item{"unusedVertices", "dropped: no triangle has them", 0, {}};
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) note(item, static_cast<std::int64_t>(v));
  }
  addItem(state, std::move(item));
}

void dropUnreferenced(RepairState& state) {
  TriangleMesh& mesh = state.mesh;
  std::vector<std::int32_t> renumbered(mesh.positions.size(), kNone);
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) renumbered[static_cast<std::size_t>(v)] = 0;
  }
  std::int32_t kept = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (renumbered[v] == kNone) continue;
    mesh.positions[static_cast<std::size_t>(kept)] = mesh.positions[v];
    renumbered[v] = kept++;
  }
  mesh.positions.resize(static_cast<std::size_t>(kept));
  for (auto& corners : mesh.triangles) {
    for (std::int32_t& v : corners) v = renumbered[static_cast<std::size_t>(v)];
  }
  for (auto& ends : state.flatEdges) {
    for (std::int32_t& v : ends) v = renumbered[static_cast<std::size_t>(v)];
  }
  std::erase_if(state.flatEdges, [](const auto& ends) { return ends[0] == kNone || ends[1] == kNone; });
}

namespace {

Error elementError(ErrorCode code, std::string message, std::vector<std::int64_t> elements) {
  if (elements.size() > kMaxElements) elements.resize(kMaxElements);
  return {code, std::move(message), std::move(elements)};
}

/// Beyond these, squares of coordinates overflow, or squares of areas vanish.
constexpr double kLargestCoordinate = 1e150;
constexpr double kSmallestDiagonal = 1e-60;

Result<Done> checkInput(const TriangleMesh& input) {
  constexpr auto kLargest = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (input.triangles.empty()) return Error{ErrorCode::noSurface, "The model has no triangles.", {}};
  if (input.positions.size() > kLargest || input.triangles.size() > kLargest / 6) {
    return Error{ErrorCode::tooLarge, "The model has more triangles than this program can hold.", {}};
  }
  std::vector<std::int64_t> bad;
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    for (const std::int32_t v : input.triangles[t]) {
      if (v >= 0 && static_cast<std::size_t>(v) < input.positions.size()) continue;
      bad.push_back(static_cast<std::int64_t>(t));
      break;
    }
  }
  if (!bad.empty()) {
    const std::string first = std::to_string(bad.front());
    return elementError(ErrorCode::indexOutOfRange, "Triangle " + first + " names a vertex that does not exist.",
                        std::move(bad));
  }
  for (std::size_t v = 0; v < input.positions.size(); ++v) {
    const Vec3& p = input.positions[v];
    const double largest = std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z)));
    if (isFinite(p) && largest < kLargestCoordinate) continue;
    bad.push_back(static_cast<std::int64_t>(v));
  }
  if (!bad.empty()) {
    const std::string first = std::to_string(bad.front());
    return elementError(ErrorCode::nonFiniteCoordinate,
                        "Vertex " + first + " has a coordinate that is not a number or too large to compute with.",
                        std::move(bad));
  }
  return Done{};
}

/// The median of the triangles' longest sides.
double medianSide(const TriangleMesh& mesh) {
  std::vector<double> longest;
  longest.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(corners[i])]; };
    longest.push_back(std::fmax(distance(p(0), p(1)), std::fmax(distance(p(1), p(2)), distance(p(2), p(0)))));
  }
  const auto middle = longest.begin() + static_cast<std::ptrdiff_t>(longest.size() / 2);
  std::nth_element(longest.begin(), middle, longest.end());
  return *middle;
}

/// A part is at most so many triangles across: a piece of it that lies farther away than that says nothing about which
/// of its details are too small to tell.
constexpr double kMostSides = 1e5;

void measure(RepairState& state) {
  const TriangleMesh& mesh = state.mesh;
  BoundingBox box;
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) box.include(mesh.positions[static_cast<std::size_t>(v)]);
  }
  state.diagonal = box.diagonal();
  const double extent = std::fmin(state.diagonal, kMostSides * medianSide(mesh));
  state.precision = std::fmax(1e-9 * extent, 4.0 * std::numeric_limits<double>::epsilon() * box.largestCoordinate());
  // Coordinates far from the origin are coarse, but beyond the cap closing gaps would eat details.
  const double resolution = std::fmin(4.0 * coordinateResolution(mesh.positions, box), 1e-5 * state.diagonal);
  state.tolerance = std::fmax(std::fmax(1e-6 * extent, resolution), state.precision);
}

/// Closes gaps and what follows from that: joining what was apart makes slivers and puts triangles on the same
/// vertices, and removing these may show another gap.
void joinPieces(RepairState& state) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const auto before = state.mesh.triangles;
    closeGaps(state);
    removeSlivers(state);
    if (!state.modify) return;
    removeDuplicates(state);
    if (state.mesh.triangles == before) return;
  }
}

/// The passes in their order; \pre the input was checked.
void runPass(RepairState& state, int pass) {
  switch (pass) {
    case 0:
      noteUnusedVertices(state);
      return weldExact(state);
    case 1:
      return removeRepeatedCorners(state);
    case 2:
      return removeDuplicates(state);
    case 3:
      return removeZeroArea(state);
    case 4:
      return joinPieces(state);
    case 5:
      return orient(state);
    case 6:
      splitLoneEdges(state);
      return noteNonManifold(state);
    default:
      return dropUnreferenced(state);
  }
}
constexpr int kPasses = 8;

}  // namespace
}  // namespace detail

Result<RepairedMesh> repair(const TriangleMesh& input, const RepairOptions& options, Progress& progress) {
  const Result<Done> checked = detail::checkInput(input);
  if (!checked) return checked.error();
  detail::RepairState state;
  state.mesh = input;
  if (state.mesh.labels.size() != state.mesh.triangles.size()) state.mesh.labels.clear();
  state.origin.resize(input.triangles.size());
  std::iota(state.origin.begin(), state.origin.end(), std::int64_t{0});
  state.modify = options.modify;
  detail::measure(state);
  if (state.diagonal < detail::kSmallestDiagonal && state.diagonal > 0.0) {
    return Error{
        ErrorCode::noSurface, "The model is less than 1e-60 across, too small to compute with; scale it up.", {}};
  }

  for (int pass = 0; pass < detail::kPasses; ++pass) {
    if (!progress.report(Stage::repair, static_cast<double>(pass) / detail::kPasses)) return cancelledError();
    detail::runPass(state, pass);
    if (state.mesh.triangles.empty()) {
      return Error{ErrorCode::noSurface, "None of the model's triangles has an area.", {}};
    }
  }
  return RepairedMesh{std::move(state.mesh), std::move(state.origin), std::move(state.items),
                      std::move(state.flatEdges)};
}

}  // namespace qmcf
