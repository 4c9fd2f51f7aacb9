#include "edit_soup.hpp"

#include <algorithm>
#include <iterator>

namespace qmcf::detail {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

bool has(const std::array<std::int32_t, 3>& corners, std::int32_t v) {
  return corners[0] == v || corners[1] == v || corners[2] == v;
}

}  // namespace

EditSoup::EditSoup(RepairState& state)
    : state_(state), alive_(state.mesh.triangles.size(), 1), around_(state.mesh.positions.size()) {
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    for (const std::int32_t v : state.mesh.triangles[t]) around_[at(v)].push_back(static_cast<std::int32_t>(t));
  }
}

std::vector<std::int32_t> EditSoup::trianglesAt(std::int32_t a, std::int32_t b) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t t : around_[at(a)]) {
    const auto& corners = state_.mesh.triangles[at(t)];
    if (alive(t) && has(corners, a) && has(corners, b)) found.push_back(t);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditSoup::mayMerge(std::int32_t a, std::int32_t b) const {
  const auto neighbours = [&](std::int32_t v) {
    std::vector<std::int32_t> found;
    for (const std::int32_t t : around_[at(v)]) {
      const auto& corners = state_.mesh.triangles[at(t)];
      if (alive(t) && has(corners, v)) found.insert(found.end(), corners.begin(), corners.end());
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  };
  const std::vector<std::int32_t> ofA = neighbours(a);
  const std::vector<std::int32_t> ofB = neighbours(b);
  std::vector<std::int32_t> common;
  std::set_intersection(ofA.begin(), ofA.end(), ofB.begin(), ofB.end(), std::back_inserter(common));
  // a and b themselves are among them.
  return common.size() == trianglesAt(a, b).size() + 2;
}

void EditSoup::merge(std::int32_t kept, std::int32_t gone) {
  const std::vector<std::int32_t> moved = std::move(around_[at(gone)]);
  around_[at(gone)].clear();
  for (const std::int32_t t : moved) {
    auto& corners = state_.mesh.triangles[at(t)];
    if (!alive(t) || !has(corners, gone)) continue;
    if (has(corners, kept)) {
      kill(t);
      continue;
    }
    std::replace(corners.begin(), corners.end(), gone, kept);
    around_[at(kept)].push_back(t);
  }
}

std::vector<std::int32_t> EditSoup::splitEdge(std::int32_t a, std::int32_t b, std::int32_t v) {
  std::vector<std::int32_t> changed;
  TriangleMesh& mesh = state_.mesh;
  for (const std::int32_t t : trianglesAt(a, b)) {
    if (has(mesh.triangles[at(t)], v)) {
      kill(t);
      continue;
    }
    std::array<std::int32_t, 3> near = mesh.triangles[at(t)];
    std::array<std::int32_t, 3> far = near;
    std::replace(near.begin(), near.end(), b, v);
    std::replace(far.begin(), far.end(), a, v);
    const auto added = static_cast<std::int32_t>(mesh.triangles.size());
    mesh.triangles[at(t)] = near;
    mesh.triangles.push_back(far);
    if (!mesh.labels.empty()) mesh.labels.push_back(mesh.labels[at(t)]);
    state_.origin.push_back(state_.origin[at(t)]);
    alive_.push_back(1);
    around_[at(v)].push_back(t);
    for (const std::int32_t corner : far) around_[at(corner)].push_back(added);
    changed.insert(changed.end(), {t, added});
  }
  return changed;
}

std::int32_t EditSoup::addVertex(const Vec3& position) {
  state_.mesh.positions.push_back(position);
  around_.emplace_back();
  return static_cast<std::int32_t>(around_.size() - 1);
}

void EditSoup::finish() { keepTriangles(state_, alive_); }

}  // namespace qmcf::detail
