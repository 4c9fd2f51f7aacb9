// Closest point on a triangle by its Voronoi regions: Ericson, Real-Time Collision Detection, section 5.1.5.
#include "qmcf/spatial/triangle_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace qmcf {
namespace {

constexpr std::int32_t kLeafSize = 4;
constexpr std::size_t kMostOpen = 128;  // Above all levels: no child has more than 3/4 of at most 2^31 triangles.
/// A triangle with less than this sine at its first corner may have a normal of larger error.
constexpr double kLeastSine = 1e-4;
constexpr double kPlaneError = 1e-10;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double gap(double p, double low, double high) { return p < low ? low - p : (p > high ? p - high : 0.0); }

double squaredDistanceToBox(const Vec3& p, const Vec3& low, const Vec3& high) {
  const double x = gap(p.x, low.x, high.x);
  const double y = gap(p.y, low.y, high.y);
  const double z = gap(p.z, low.z, high.z);
  return x * x + y * y + z * z;
}

/// Squared distance of p from the box around a triangle: much less work than from the triangle.
double squaredDistanceToBox(const Vec3& p, const std::array<Vec3, 3>& corner) {
  const auto& [a, b, c] = corner;
  const Vec3 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
  const Vec3 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
  return squaredDistanceToBox(p, low, high);
}

ClosestPoint weighted(const Vec3& query, const std::array<Vec3, 3>& corner, const std::array<double, 3>& weight) {
  ClosestPoint result;
  result.barycentric = weight;
  result.position = corner[0] * weight[0] + corner[1] * weight[1] + corner[2] * weight[2];
  result.squaredDistance = squaredNorm(result.position - query);
  return result;
}

/// The closest of the points of the three sides; the way out for triangles without area.
ClosestPoint closestOnSides(const Vec3& query, const std::array<Vec3, 3>& corner) {
  ClosestPoint best;
  best.squaredDistance = kInfinity;
  for (std::size_t side = 0; side < 3; ++side) {
    const std::size_t other = (side + 1) % 3;
    const Vec3 along = corner[other] - corner[side];
    const double length = squaredNorm(along);
    const double t = length > 0.0 ? std::clamp(dot(query - corner[side], along) / length, 0.0, 1.0) : 0.0;
    std::array<double, 3> weight{};
    weight[side] = 1.0 - t;
    weight[other] = t;
    const ClosestPoint candidate = weighted(query, corner, weight);
    if (candidate.squaredDistance < best.squaredDistance) best = candidate;
  }
  return best;
}

ClosestPoint closestOn(const Vec3& query, const std::array<Vec3, 3>& corner) {
  const Vec3 ab = corner[1] - corner[0];
  const Vec3 ac = corner[2] - corner[0];
  const Vec3 ap = query - corner[0];
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return weighted(query, corner, {1.0, 0.0, 0.0});
  const Vec3 bp = query - corner[1];
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return weighted(query, corner, {0.0, 1.0, 0.0});
  const Vec3 cp = query - corner[2];
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return weighted(query, corner, {0.0, 0.0, 1.0});
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  const double sum = va + vb + vc;
  if (va > 0.0 && vb > 0.0 && vc > 0.0) return weighted(query, corner, {va / sum, vb / sum, vc / sum});
  return closestOnSides(query, corner);
}

}  // namespace

ClosestPoint closestPointOnTriangle(const Vec3& query, const Vec3& a, const Vec3& b, const Vec3& c) {
  return closestOn(query, {a, b, c});
}

/// A triangle on its way into the tree.
struct TriangleBvh::Item {
  Vec3 centroid;
  std::int32_t triangle = 0;
};

/// Divides items[first, last) in the middle of its longest axis, or where that would put less than a quarter on one
/// side, at the median, where ids break ties, so that the parts are unique.
std::int32_t TriangleBvh::divide(std::vector<Item>& items, std::int32_t first, std::int32_t last) {
  const auto begin = items.begin() + first;
  const auto end = items.begin() + last;
  Vec3 low = begin->centroid;
  Vec3 high = low;
  for (auto item = begin; item != end; ++item) {
    const Vec3& c = item->centroid;
    low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
    high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
  }
  const Vec3 extent = high - low;
  const auto along = [&](double Vec3::*axis) {
    const double half = 0.5 * (low.*axis + high.*axis);
    const auto below = std::partition(begin, end, [&](const Item& item) { return item.centroid.*axis < half; });
    if (4 * std::min(below - begin, end - below) >= end - begin) return below;
    const auto median = begin + (end - begin) / 2;
    std::nth_element(begin, median, end, [axis](const Item& a, const Item& b) {
      return a.centroid.*axis != b.centroid.*axis ? a.centroid.*axis < b.centroid.*axis : a.triangle < b.triangle;
    });
    return median;
  };
  const bool isX = extent.x >= extent.y && extent.x >= extent.z;
  const auto middle = isX ? along(&Vec3::x) : along(extent.y >= extent.z ? &Vec3::y : &Vec3::z);
  return static_cast<std::int32_t>(middle - items.begin());
}

/// Divides the items until few enough are left for a leaf each, and puts them into the order of the leaves. Depth
/// first, so that what is near in space is near in memory.
void TriangleBvh::makeNodes(std::vector<Item>& items) {
  nodes_.reserve(items.size() + 1);
  nodes_.push_back({{}, {}, 0, static_cast<std::int32_t>(items.size())});
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    const auto [first, count] = std::pair(nodes_[n].first, nodes_[n].count);
    if (count <= kLeafSize) {
      std::sort(items.begin() + first, items.begin() + first + count,
                [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
      continue;
    }
    const std::int32_t middle = divide(items, first, first + count);
    const std::size_t left = nodes_.size();
    nodes_[n].first = static_cast<std::int32_t>(left);
    nodes_[n].count = 0;
    nodes_.push_back({{}, {}, first, middle - first});
    nodes_.push_back({{}, {}, middle, first + count - middle});
    open.push_back(left + 1);
    open.push_back(left);
  }
}

TriangleBvh::TriangleBvh(const std::vector<Vec3>& positions,
                         const std::vector<std::array<std::int32_t, 3>>& triangles) {
  if (triangles.empty()) return;
  const auto corners = [&](std::int32_t t) {
    const auto& ids = triangles[static_cast<std::size_t>(t)];
    return std::array<Vec3, 3>{positions[static_cast<std::size_t>(ids[0])], positions[static_cast<std::size_t>(ids[1])],
                               positions[static_cast<std::size_t>(ids[2])]};
  };
  std::vector<Item> items(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = corners(static_cast<std::int32_t>(t));
    items[t] = {(a + b + c) / 3.0, static_cast<std::int32_t>(t)};
  }

  makeNodes(items);
  order_.reserve(items.size());
  for (const Item& item : items) order_.push_back(item.triangle);

  place_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    place_[static_cast<std::size_t>(order_[i])] = static_cast<std::int32_t>(i);
  }
  triangles_.reserve(order_.size());
  normals_.reserve(order_.size());
  planes_.reserve(order_.size());
  for (const std::int32_t t : order_) {
    const auto [a, b, c] = corners(t);
    triangles_.push_back({a, b, c});
    const Vec3 area = cross(b - a, c - a);
    normals_.push_back(normalized(area));
    const bool isExact = norm(area) > kLeastSine * distance(a, b) * distance(a, c);
    planes_.push_back(isExact ? normals_.back() : Vec3{});
  }
  fitBoxes();
}

/// Children come after their parents, so that one backward pass does it.
void TriangleBvh::fitBoxes() {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.low = {kInfinity, kInfinity, kInfinity};
    node.high = -node.low;
    const auto include = [&node](const Vec3& low, const Vec3& high) {
      node.low = {std::min(node.low.x, low.x), std::min(node.low.y, low.y), std::min(node.low.z, low.z)};
      node.high = {std::max(node.high.x, high.x), std::max(node.high.y, high.y), std::max(node.high.z, high.z)};
    };
    if (node.count == 0) {
      for (std::int32_t child = node.first; child < node.first + 2; ++child) {
        include(nodes_[static_cast<std::size_t>(child)].low, nodes_[static_cast<std::size_t>(child)].high);
      }
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      for (const Vec3& corner : triangles_[static_cast<std::size_t>(i)]) include(corner, corner);
    }
  }
  constexpr double kRoundOff = 1e-14;  // Of the coordinates.
  roundOff_ = kRoundOff * std::sqrt(std::max(squaredNorm(nodes_[0].low), squaredNorm(nodes_[0].high)));
}

/// Whether a triangle's plane, and so the triangle, is farther away than that, whatever round-off says: much less work
/// than the triangle's closest point, and on a surface that bends little it leaves out nearly all whose boxes overlap.
bool TriangleBvh::isPlaneBeyond(std::size_t index, const Vec3& query, double squaredDistance) const {
  const Vec3 arm = query - triangles_[index][0];
  const double error = kPlaneError * (std::fabs(arm.x) + std::fabs(arm.y) + std::fabs(arm.z)) + roundOff_;
  const double height = std::fabs(dot(planes_[index], arm)) - error;
  return height > 0.0 && height * height > squaredDistance;
}

/// most: squared distance beyond which nothing is looked for.
template <class Accept>
ClosestPoint TriangleBvh::search(const Vec3& query, std::int32_t hint, double most, Accept accept) const {
  struct Entry {
    std::int32_t node;
    double squaredDistance;
  };
  ClosestPoint best;
  best.squaredDistance = most;
  if (hint >= 0) {
    const auto index = static_cast<std::size_t>(place_[static_cast<std::size_t>(hint)]);
    if (accept(index)) {
      best = closestOn(query, triangles_[index]);
      best.triangle = hint;
      if (best.squaredDistance <= roundOff_ * roundOff_) return best;
    }
  }
  std::array<Entry, kMostOpen> stack;  // One entry a level.
  std::size_t top = 0;
  stack[top++] = {0, 0.0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.squaredDistance > best.squaredDistance) continue;
    const Node* node = &nodes_[static_cast<std::size_t>(entry.node)];
    double nearest = entry.squaredDistance;
    while (node->count == 0 && nearest <= best.squaredDistance) {
      const std::int32_t left = node->first;
      const Node* children = &nodes_[static_cast<std::size_t>(left)];
      const double toLeft = squaredDistanceToBox(query, children[0].low, children[0].high);
      const double toRight = squaredDistanceToBox(query, children[1].low, children[1].high);
      const bool leftFirst = toLeft <= toRight;
      const double farther = leftFirst ? toRight : toLeft;
      if (farther <= best.squaredDistance) stack[top++] = {leftFirst ? left + 1 : left, farther};
      nearest = leftFirst ? toLeft : toRight;
      node = leftFirst ? children : children + 1;
    }
    if (nearest > best.squaredDistance) continue;
    for (std::int32_t i = node->first; i < node->first + node->count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      if (squaredDistanceToBox(query, triangles_[index]) > best.squaredDistance || !accept(index)) continue;
      if (isPlaneBeyond(index, query, best.squaredDistance)) continue;
      const ClosestPoint candidate = closestOn(query, triangles_[index]);
      const bool closer = candidate.squaredDistance < best.squaredDistance;
      const bool tie = candidate.squaredDistance == best.squaredDistance && order_[index] < best.triangle;
      if (!closer && !tie) continue;
      best = candidate;
      best.triangle = order_[index];
    }
  }
  return best;
}

ClosestPoint TriangleBvh::closest(const Vec3& query, std::int32_t hint) const {
  return search(query, hint, kInfinity, [](std::size_t) { return true; });
}

ClosestPoint TriangleBvh::closest(const Vec3& query, const Vec3& normal, double minCosine, std::int32_t hint) const {
  const ClosestPoint best =
      search(query, hint, kInfinity, [&](std::size_t index) { return dot(normals_[index], normal) >= minCosine; });
  return best.triangle >= 0 ? best : closest(query);
}

ClosestPoint TriangleBvh::closestFacing(const Vec3& normal, const Vec3& query, double reach) const {
  if (empty()) return {};
  return search(query, -1, reach * reach, [&](std::size_t index) { return dot(normals_[index], normal) >= 0.0; });
}

bool TriangleBvh::isAnyFacing(const Vec3& normal, const Vec3& query, double reach) const {
  if (empty()) return false;
  const double most = reach * reach;
  std::array<std::int32_t, kMostOpen> open;  // One entry a level, and the node itself.
  std::size_t top = 0;
  open[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(open[--top])];
    if (squaredDistanceToBox(query, node.low, node.high) > most) continue;
    if (node.count == 0) {
      open[top++] = node.first;
      open[top++] = node.first + 1;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      if (!(dot(normals_[index], normal) > 0.0) || isPlaneBeyond(index, query, most)) continue;
      if (closestOn(query, triangles_[index]).squaredDistance <= most) return true;
    }
  }
  return false;
}

}  // namespace qmcf
