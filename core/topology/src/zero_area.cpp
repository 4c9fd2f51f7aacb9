#include <algorithm>
#include <array>
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

}  // namespace

void removeZeroArea(RepairState& state) {
  TriangleMesh& mesh = state.mesh;
  const auto isFlat = [&](const Shape& shape) { return shape.height <= state.precision; };
  RepairItem item{"zeroAreaTriangles", state.modify ? "removed, their neighbours joined" : "found", 0, {}};
  std::priority_queue<Candidate> queue;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Shape shape = shapeOf(mesh, static_cast<std::int32_t>(t));
    if (!isFlat(shape)) continue;
    note(item, state.origin[t]);
    queue.push({shape.longest, static_cast<std::int32_t>(t)});
  }
  addItem(state, std::move(item));
  if (queue.empty() || !state.modify) return;

  EditSoup soup(state);
  std::size_t budget = 50 * queue.size() + 1000;
  while (!queue.empty()) {
    const Candidate candidate = queue.top();
    queue.pop();
    if (!soup.alive(candidate.triangle)) continue;
    const Shape shape = shapeOf(mesh, candidate.triangle);
    if (!isFlat(shape)) continue;
    const auto corners = mesh.triangles[at(candidate.triangle)];
    if (budget-- == 0) break;
    if (shape.shortest <= state.precision) {
      const std::int32_t a = corners[shape.shortestEdge];
      const std::int32_t b = corners[(shape.shortestEdge + 1) % 3];
      soup.merge(std::min(a, b), std::max(a, b));
      for (const std::int32_t t : soup.around(std::min(a, b))) {
        if (!soup.alive(t)) continue;
        const Shape moved = shapeOf(mesh, t);
        if (isFlat(moved)) queue.push({moved.longest, t});
      }
      continue;
    }
    const std::int32_t a = corners[shape.longestEdge];
    const std::int32_t b = corners[(shape.longestEdge + 1) % 3];
    for (const std::int32_t t : soup.splitEdge(a, b, corners[(shape.longestEdge + 2) % 3])) {
      const Shape part = shapeOf(mesh, t);
      if (isFlat(part)) queue.push({part.longest, t});
    }
  }
  // What the budget did not reach would break the later stages.
  for (; !queue.empty(); queue.pop()) {
    const std::int32_t t = queue.top().triangle;
    if (soup.alive(t) && isFlat(shapeOf(mesh, t))) soup.kill(t);
  }
  soup.finish();
}

}  // namespace qmcf::detail
