#include <algorithm>
#include <array>
#include <map>
#include <queue>

#include "edit_soup.hpp"
#include "repair_state.hpp"

namespace qmcf::detail {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Sizes of a triangle: corner c lies opposite its longest edge.
struct Shape {
  double shortest = 0.0;
  double longest = 0.0;
  double height = 0.0;  ///< Over the longest edge.
  std::size_t shortestEdge = 0;
  std::size_t longestEdge = 0;
};

Shape shapeOf(const TriangleMesh& mesh, std::int32_t t) {
  const auto& c = mesh.triangles[at(t)];
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i)
    length[i] = distance(mesh.positions[at(c[i])], mesh.positions[at(c[(i + 1) % 3])]);
  Shape shape;
  for (std::size_t i = 1; i < 3; ++i) {
    if (length[i] < length[shape.shortestEdge]) shape.shortestEdge = i;
    if (length[i] > length[shape.longestEdge]) shape.longestEdge = i;
  }
  shape.shortest = length[shape.shortestEdge];
  shape.longest = length[shape.longestEdge];
  const Vec3 origin = mesh.positions[at(c[0])];
  const double area = norm(cross(mesh.positions[at(c[1])] - origin, mesh.positions[at(c[2])] - origin));
  shape.height = shape.longest > 0.0 ? area / shape.longest : 0.0;
  return shape;
}

/// Longest edge first: splitting it can't bring back a longer one in the same collinear strip.
struct Candidate {
  double longest = 0.0;
  std::int32_t triangle = 0;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.longest != b.longest ? a.longest < b.longest : a.triangle > b.triangle;
  }
};

/// Removes flat triangles one by one without ever opening the surface: a needle loses its short edge, a cap its longest
/// one, which is split, with all triangles at it, at the vertex that lies on it.
class Flattener {
 public:
  /// Triangles up to `height` high are flat. keepsTopology: refuse to merge vertices where that would pinch the
  /// surface.
  Flattener(RepairState& state, double height, bool keepsTopology)
      : state_(state), height_(height), keepsTopology_(keepsTopology) {}

  void run(RepairItem item) {
    std::vector<Candidate> found;
    for (std::size_t t = 0; t < state_.mesh.triangles.size(); ++t) {
      const Shape shape = shapeOf(state_.mesh, static_cast<std::int32_t>(t));
      if (shape.height > height_) continue;
      note(item, state_.origin[t]);
      found.push_back({shape.longest, static_cast<std::int32_t>(t)});
    }
    addItem(state_, std::move(item));
    if (found.empty() || !state_.modify) return;
    EditSoup soup(state_);
    // Around an edge with many triangles, each split doubles what the next one splits.
    std::size_t budget = kStep * (50 * found.size() + 1000);
    for (const Candidate& candidate : found) queue_.push(candidate);
    while (!queue_.empty() && budget > 0) {
      const std::int32_t t = queue_.top().triangle;
      queue_.pop();
      const std::size_t looked = soup.looked();
      const std::size_t made = soup.alive(t) ? flatten(soup, t) : 0;
      budget -= std::min(kStep * (1 + made) + soup.looked() - looked, budget);
    }
    // What is left would break the later stages if it had no area at all.
    for (std::size_t t = 0; t < state_.mesh.triangles.size(); ++t) {
      const auto id = static_cast<std::int32_t>(t);
      if (soup.alive(id) && shapeOf(state_.mesh, id).height <= state_.precision) soup.kill(id);
    }
    soup.finish();
  }

 private:
  /// What a step counts, and a triangle that is split or made, in triangles looked at.
  static constexpr std::size_t kStep = 512;

  void push(const EditSoup& soup, std::int32_t t) {
    if (!soup.alive(t)) return;
    const Shape shape = shapeOf(state_.mesh, t);
    if (shape.height <= height_) queue_.push({shape.longest, t});
  }

  /// What was refused at a vertex may be possible now that others are there.
  void retryAt(const EditSoup& soup, std::int32_t vertex) {
    const auto [first, last] = refused_.equal_range(vertex);
    for (auto it = first; it != last; ++it) {
      const auto& corners = state_.mesh.triangles[at(it->second)];
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) push(soup, it->second);
    }
    refused_.erase(first, last);
  }

  /// Returns how many triangles were split or made.
  std::size_t flatten(EditSoup& soup, std::int32_t t) {
    const Shape shape = shapeOf(state_.mesh, t);
    if (shape.height > height_) return 0;
    const auto corners = state_.mesh.triangles[at(t)];
    if (shape.shortest <= height_) {
      const std::int32_t a = corners[shape.shortestEdge];
      const std::int32_t b = corners[(shape.shortestEdge + 1) % 3];
      if (keepsTopology_ && !soup.mayMerge(a, b)) {
        for (const std::int32_t corner : corners) refused_.emplace(corner, t);
        return 0;
      }
      const std::int32_t kept = std::min(a, b);
      for (const std::int32_t moved : soup.merge(kept, std::max(a, b))) push(soup, moved);
      retryAt(soup, kept);
      return 0;
    }
    const std::int32_t a = corners[shape.longestEdge];
    const std::int32_t b = corners[(shape.longestEdge + 1) % 3];
    const std::int32_t middle = corners[(shape.longestEdge + 2) % 3];
    state_.flatEdges.push_back({a, middle});
    state_.flatEdges.push_back({middle, b});
    const std::vector<std::int32_t> parts = soup.splitEdge(a, b, middle);
    for (const std::int32_t part : parts) push(soup, part);
    return parts.size();
  }

  RepairState& state_;
  double height_;
  bool keepsTopology_;
  std::priority_queue<Candidate> queue_;
  std::multimap<std::int32_t, std::int32_t> refused_;  ///< By the corners: triangles whose vertices could not merge.
};

}  // namespace

void removeZeroArea(RepairState& state) {
  const char* action = state.modify ? "removed, their neighbours joined" : "found";
  Flattener(state, state.precision, false).run({"zeroAreaTriangles", action, 0, {}});
}

void removeSlivers(RepairState& state) {
  const char* action = state.modify ? "removed, their neighbours joined" : "found";
  Flattener(state, state.tolerance, true).run({"sliverTriangles", action, 0, {}});
}

}  // namespace qmcf::detail
