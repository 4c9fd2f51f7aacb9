#include "edit_soup.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

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

const std::vector<std::int32_t>& EditSoup::around(std::int32_t v) const {
  looked_ += around_[at(v)].size();
  return around_[at(v)];
}

std::array<std::int32_t, 2> EditSoup::fewerFirst(std::int32_t a, std::int32_t b) const {
  return around_[at(a)].size() <= around_[at(b)].size() ? std::array{a, b} : std::array{b, a};
}

bool EditSoup::hasBoth(std::int32_t triangle, std::int32_t a, std::int32_t b) const {
  const auto& corners = state_.mesh.triangles[at(triangle)];
  return alive(triangle) && has(corners, a) && has(corners, b);
}

bool EditSoup::areConnected(std::int32_t a, std::int32_t b) const {
  const std::vector<std::int32_t>& near = around(fewerFirst(a, b)[0]);
  return std::any_of(near.begin(), near.end(), [&](std::int32_t t) { return hasBoth(t, a, b); });
}

std::vector<std::int32_t> EditSoup::trianglesAt(std::int32_t a, std::int32_t b) const {
  std::vector<std::int32_t> found;
  const std::vector<std::int32_t>& near = around(fewerFirst(a, b)[0]);
  std::copy_if(near.begin(), near.end(), std::back_inserter(found), [&](std::int32_t t) { return hasBoth(t, a, b); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditSoup::mayMerge(std::int32_t a, std::int32_t b) const {
  const auto [fewer, other] = fewerFirst(a, b);
  std::vector<std::int32_t> neighbours;
  for (const std::int32_t t : around(fewer)) {
    const auto& corners = state_.mesh.triangles[at(t)];
    if (alive(t) && has(corners, fewer)) neighbours.insert(neighbours.end(), corners.begin(), corners.end());
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  const std::int32_t apart = other;
  const auto common = std::count_if(neighbours.begin(), neighbours.end(),
                                    [&](std::int32_t v) { return v != a && v != b && areConnected(v, apart); });
  return static_cast<std::size_t>(common) == trianglesAt(a, b).size();
}

std::vector<std::int32_t> EditSoup::merge(std::int32_t kept, std::int32_t gone) {
  looked_ += around_[at(gone)].size();
  std::vector<std::int32_t> moved = std::exchange(around_[at(gone)], {});
  std::erase_if(moved, [&](std::int32_t t) {
    auto& corners = state_.mesh.triangles[at(t)];
    if (!alive(t) || !has(corners, gone)) return true;
    if (has(corners, kept)) {
      kill(t);
      return true;
    }
    std::replace(corners.begin(), corners.end(), gone, kept);
    return false;
  });
  around_[at(kept)].insert(around_[at(kept)].end(), moved.begin(), moved.end());
  return moved;
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
