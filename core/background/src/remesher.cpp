#include "remesher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "qmcf/sizing/min_heap.hpp"
#include "qmcf/sizing/point_grid.hpp"

namespace qmcf {
namespace {

// Bounds of edge lengths in units of the target, from Botsch and Kobbelt 2004.
constexpr double kLongest = 4.0 / 3.0;
constexpr double kShortest = 4.0 / 5.0;
// An edge between two boundary vertices stays if it is shorter than this: there is no room for a vertex on it.
constexpr double kNarrow = 0.75;
// Slope of the triangles' lengths away from short boundary edges: steep, since triangles need not fit quads.
constexpr double kLengthSlope = 0.35;
// By how much the normal may turn along an edge longer than the elements need, in radians.
constexpr double kTurn = 0.3;
// A new triangle keeps within this angle's cosine of the smooth surface's normal.
constexpr double kMinCosine = 0.3;
// Below this, triangles may not get worse.
constexpr double kPoorQuality = 0.01;
// No new triangle may be as bad as this: its normal would mean nothing.
constexpr double kDegenerate = 1e-10;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What decides whether a triangle is acceptable.
struct Shape {
  Vec3 area;             ///< Twice the area vector.
  double quality = 0.0;  ///< 1 for an equilateral triangle, 0 for one without area: the square of 4 sqrt(3) area / sum
                         ///< of squared sides.
};

Shape shapeOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 area = cross(ab, ac);
  const double sum = squaredNorm(ab) + squaredNorm(ac) + squaredNorm(c - b);
  return {area, sum > 0.0 ? 12.0 * squaredNorm(area) / (sum * sum) : 0.0};
}

/// Whether a triangle keeps within the allowed angle of a normal of any length.
bool looksAlong(const Vec3& area, const Vec3& normal) {
  const double along = dot(area, normal);
  return along > 0.0 && along * along > kMinCosine * kMinCosine * squaredNorm(area) * squaredNorm(normal);
}

void grade(const RemeshMesh& mesh, std::vector<double>& value, double highest, double slope) {
  MinHeap heap;
  for (std::int32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (!(value[index(v)] < highest) || mesh.isVertexRemoved(v)) continue;
    // Most of them lower nothing around them, unless they get lower themselves.
    bool lowers = false;
    mesh.forEachNeighbor(v, [&](std::int32_t w) {
      lowers = lowers || value[index(v)] + slope * distance(mesh.positionOf(v), mesh.positionOf(w)) < value[index(w)];
    });
    if (lowers) heap.push(value[index(v)], v);
  }
  while (!heap.empty()) {
    const auto [key, v] = heap.pop();
    if (key > value[index(v)]) continue;
    const double own = key;
    const std::int32_t center = v;
    mesh.forEachNeighbor(center, [&](std::int32_t w) {
      const double graded = own + slope * distance(mesh.positionOf(center), mesh.positionOf(w));
      if (!(graded < value[index(w)])) return;
      value[index(w)] = graded;
      heap.push(graded, w);
    });
  }
}

}  // namespace

std::vector<std::int32_t> Remesher::renumber() {
  const std::vector<std::int32_t> newVertex = mesh_.renumber();
  const auto apply = [&](auto& values) {
    std::decay_t<decltype(values)> now(index(mesh_.vertexCount()));
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (newVertex[v] != kNone) now[index(newVertex[v])] = values[v];
    }
    values = std::move(now);
  };
  apply(targets_.nodeSize);
  apply(targets_.spacing);
  apply(awake_);
  apply(moved_);
  inner_.clear();
  return newVertex;
}

/// Lowers the sizes at vertices near a limit; gradation carries them on.
void Remesher::applyLimits() {
  if (targets_.limits.empty()) return;
  std::vector<Vec3> positions;
  std::vector<std::int32_t> ids;
  for (const SizeLimit& limit : targets_.limits) {
    ids.push_back(static_cast<std::int32_t>(positions.size()));
    positions.push_back(limit.position);
  }
  const PointGrid grid(positions, ids, targets_.base);
  for (std::int32_t v = 0; v < mesh_.vertexCount(); ++v) {
    if (mesh_.isVertexRemoved(v)) continue;
    const Vec3& p = mesh_.positionOf(v);
    double& size = size_[index(v)];
    grid.forEachNear(p, [&](std::int32_t limit) {
      const double cone =
          targets_.limits[index(limit)].size + targets_.gradation * distance(p, positions[index(limit)]);
      size = std::min(size, cone);
    });
  }
}

/// Lowers the sizes at vertices to those inside the face.
void Remesher::applyInner() {
  if (targets_.inner.empty()) return;
  inner_.resize(index(mesh_.vertexCount()));
  for (std::int32_t v = 0; v < mesh_.vertexCount(); ++v) {
    if (mesh_.isVertexRemoved(v)) continue;
    Inner& inner = inner_[index(v)];
    const Vec3& p = mesh_.positionOf(v);
    if (inner.found.triangle == kNone || inner.position != p) {
      inner = {p, targets_.inner.at(p, inner.found.triangle)};
    }
    size_[index(v)] = std::min(size_[index(v)], inner.found.size);
  }
}

void Remesher::updateSizes() {
  const auto count = index(mesh_.vertexCount());
  size_.assign(count, targets_.base);
  length_.assign(count, targets_.base * targets_.flatSize);
  for (std::size_t v = 0; v < targets_.nodeSize.size(); ++v) {
    if (mesh_.role[v] == VertexRole::node) size_[v] = std::min(size_[v], targets_.nodeSize[v]);
  }
  applyLimits();
  applyInner();
  grade(mesh_, size_, targets_.base, targets_.gradation);
  for (std::size_t v = 0; v < count; ++v) length_[v] = size_[v] * targets_.flatSize;
  shortenWhereCurved();
  for (std::size_t v = 0; v < targets_.spacing.size(); ++v) {
    if (mesh_.role[v] != VertexRole::node) continue;
    length_[v] = std::min(size_[v] * targets_.relativeSize, targets_.spacing[v]);
  }
  grade(mesh_, length_, targets_.base * targets_.flatSize, kLengthSlope);
}

/// Lowers the lengths to where the normal turns little along an edge, down to relativeSize.
void Remesher::shortenWhereCurved() {
  for (std::int32_t h = 0; h < mesh_.halfedgeCount(); ++h) {
    if (mesh_.isRemoved(h) || mesh_.twin(h) > h) continue;
    const std::int32_t a = mesh_.origin(h);
    const std::int32_t b = mesh_.target(h);
    const double turn = norm(mesh_.normal[index(a)] - mesh_.normal[index(b)]);
    if (!(turn > 0.0)) continue;
    const double length = kTurn / turn * mesh_.length(h);
    for (const std::int32_t v : {a, b}) {
      length_[index(v)] = std::min(length_[index(v)], std::max(length, size_[index(v)] * targets_.relativeSize));
    }
  }
}

double Remesher::edgeLength(std::int32_t a, std::int32_t b) const {
  return 0.5 * (length_[index(a)] + length_[index(b)]);
}

double Remesher::quality(std::int32_t a, std::int32_t b, std::int32_t c) const {
  return shapeOf(mesh_.positionOf(a), mesh_.positionOf(b), mesh_.positionOf(c)).quality;
}

bool Remesher::joinsBoundary(std::int32_t a, std::int32_t b) const {
  return mesh_.role[index(a)] != VertexRole::interior && mesh_.role[index(b)] != VertexRole::interior;
}

/// Whether the triangles around `removed` stay acceptable when it moves to `kept`.
bool Remesher::keepsShape(std::int32_t removed, std::int32_t kept, double longest) {
  double worstBefore = 1.0;
  double worstAfter = 1.0;
  bool good = true;
  mesh_.forEachOutgoing(removed, [&](std::int32_t h) {
    if (!good) return;
    const std::int32_t b = mesh_.target(h);
    const std::int32_t c = mesh_.apex(h);
    worstBefore = std::min(worstBefore, quality(removed, b, c));
    if (b == kept || c == kept) return;
    const Vec3& p = mesh_.positionOf(kept);
    const Vec3 normal = mesh_.normal[index(kept)] + mesh_.normal[index(b)] + mesh_.normal[index(c)];
    const Shape after = shapeOf(p, mesh_.positionOf(b), mesh_.positionOf(c));
    good = looksAlong(after.area, normal);
    worstAfter = std::min(worstAfter, after.quality);
  });
  if (!good || worstAfter < std::max(kDegenerate, std::min(kPoorQuality, worstBefore))) return false;
  mesh_.forEachNeighbor(removed, [&](std::int32_t v) {
    if (v == kept || !good) return;
    const double length = distance(mesh_.positionOf(kept), mesh_.positionOf(v));
    if (length > longest) good = false;
    if (joinsBoundary(kept, v) && mesh_.role[index(removed)] == VertexRole::interior &&
        length > kNarrow * edgeLength(kept, v) && !mesh_.areNeighbors(kept, v)) {
      good = false;
    }
  });
  return good;
}

bool Remesher::tryCollapse(std::int32_t h, std::int32_t removed) {
  const std::int32_t kept = mesh_.origin(h) == removed ? mesh_.target(h) : mesh_.origin(h);
  const bool isPoint = mesh_.role[index(removed)] == VertexRole::point;
  const double longest = isPoint ? HUGE_VAL : kLongest * edgeLength(removed, kept);
  if (!mesh_.canCollapse(h, removed) || !keepsShape(removed, kept, longest)) return false;
  mesh_.collapse(h, removed);
  wakeAround(kept);
  return true;
}

std::int32_t Remesher::removePoints() {
  std::int32_t left = 0;
  for (std::int32_t v = 0; v < mesh_.vertexCount(); ++v) {
    if (mesh_.isVertexRemoved(v) || mesh_.role[index(v)] != VertexRole::point) continue;
    std::int32_t first = mesh_.outgoing(v);
    std::int32_t second = mesh_.incomingBoundary(v);
    if (mesh_.length(second) < mesh_.length(first)) std::swap(first, second);
    if (!tryCollapse(first, v) && !tryCollapse(second, v)) ++left;
  }
  return left;
}

bool Remesher::forcePoint(std::int32_t v) {
  for (const std::int32_t h : {mesh_.outgoing(v), mesh_.incomingBoundary(v)}) {
    if (!mesh_.canCollapse(h, v)) continue;
    mesh_.collapse(h, v);
    return true;
  }
  return false;
}

std::int32_t Remesher::collapseShort() {
  std::int32_t collapsed = 0;
  for (std::int32_t h = 0; h < mesh_.halfedgeCount(); ++h) {
    if (mesh_.isRemoved(h) || mesh_.twin(h) < h) continue;
    const std::int32_t a = mesh_.origin(h);
    const std::int32_t b = mesh_.target(h);
    if (mesh_.length(h) >= kShortest * edgeLength(a, b)) continue;
    const bool aGoes = mesh_.role[index(a)] == VertexRole::interior;
    const bool bGoes = mesh_.role[index(b)] == VertexRole::interior;
    if ((aGoes && tryCollapse(h, a)) || (bGoes && tryCollapse(h, b))) ++collapsed;
  }
  return collapsed;
}

bool Remesher::isTooLong(std::int32_t h, double scale) const {
  const std::int32_t a = mesh_.origin(h);
  const std::int32_t b = mesh_.target(h);
  return mesh_.length(h) > scale * (joinsBoundary(a, b) ? kNarrow : kLongest) * edgeLength(a, b) && isLongInSliver(h) &&
         isLongInSliver(mesh_.twin(h));
}

/// Whether splitting the edge does not cut the triangle of h into more slivers: false for a short side of a sliver.
bool Remesher::isLongInSliver(std::int32_t h) const {
  constexpr double kSliver = 0.01;
  const double length = mesh_.length(h);
  return (length >= mesh_.length(RemeshMesh::next(h)) && length >= mesh_.length(RemeshMesh::prev(h))) ||
         quality(mesh_.origin(h), mesh_.target(h), mesh_.apex(h)) > kSliver;
}

void Remesher::splitEdge(std::int32_t h) {
  const std::int32_t a = mesh_.origin(h);
  const std::int32_t b = mesh_.target(h);
  const std::int32_t c = mesh_.apex(h);
  const std::int32_t d = mesh_.apex(mesh_.twin(h));
  const Vec3 middle = (mesh_.positionOf(a) + mesh_.positionOf(b)) * 0.5;
  Vec3 normal = normalized(mesh_.normal[index(a)] + mesh_.normal[index(b)]);
  if (normal == Vec3{}) normal = mesh_.normal[index(a)];
  const std::int32_t m = mesh_.split(h, middle);
  mesh_.normal[index(m)] = normal;
  size_.push_back(0.5 * (size_[index(a)] + size_[index(b)]));
  length_.push_back(0.5 * (length_[index(a)] + length_[index(b)]));
  awake_.push_back(1);
  moved_.push_back(1);
  wakeAround(m);
  const FaceReference::Foot foot =
      reference_.project(middle, normal, std::max(mesh_.triangle[index(a)], mesh_.triangle[index(b)]));
  mesh_.normal[index(m)] = foot.normal;
  mesh_.triangle[index(m)] = foot.triangle;
  // New edges must not call for more splits than those at the middle would: else splitting might never end.
  const double whole = distance(mesh_.positionOf(a), mesh_.positionOf(b));
  for (const std::int32_t v : {a, b, c, d}) {
    const double most = v == a || v == b ? 0.75 * whole : distance(middle, mesh_.positionOf(v));
    if (distance(foot.position, mesh_.positionOf(v)) > std::max(most, kLongest * edgeLength(m, v))) return;
  }
  const std::array<std::int32_t, 4> ring{a, d, b, c};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& p = mesh_.positionOf(ring[i]);
    const Vec3& q = mesh_.positionOf(ring[(i + 1) % 4]);
    if (!looksAlong(shapeOf(foot.position, p, q).area, foot.normal)) return;
  }
  mesh_.position[index(m)] = foot.position;
}

std::int32_t Remesher::splitLong(double scale) {
  std::int32_t count = 0;
  // Longest first: the new edge in a triangle whose longest edge is halved is shorter than that one. In any other order
  // slivers multiply without bound.
  MinHeap heap;
  const auto pushIfLong = [&](std::int32_t h) {
    if (mesh_.twin(h) == kNone) return;
    const std::int32_t canonical = std::min(h, mesh_.twin(h));
    if (isTooLong(canonical, scale)) heap.push(-mesh_.length(canonical), canonical);
  };
  for (std::int32_t h = 0; h < mesh_.halfedgeCount(); ++h) {
    if (!mesh_.isRemoved(h) && h < mesh_.twin(h)) pushIfLong(h);
  }
  while (!heap.empty()) {
    const auto [key, h] = heap.pop();
    if (key != -mesh_.length(h) || !isTooLong(h, scale)) continue;
    splitEdge(h);
    ++count;
    // The edges around the new vertex may have got new ids.
    mesh_.forEachOutgoing(mesh_.target(h), [&](std::int32_t out) {
      pushIfLong(out);
      pushIfLong(RemeshMesh::next(out));
    });
  }
  return count;
}

bool Remesher::wantsFlip(std::int32_t h) const {
  constexpr double kFlat = 0.9995;
  constexpr double kGain = 1e-6;
  constexpr double kGoodEnough = 0.12;
  // Either diagonal of a square makes triangles of 0.75; of no other quadrilateral do both as well.
  constexpr double kBest = 0.76;
  const std::int32_t a = mesh_.origin(h);
  const std::int32_t b = mesh_.target(h);
  const std::int32_t c = mesh_.apex(h);
  const std::int32_t d = mesh_.apex(mesh_.twin(h));
  const Vec3& pa = mesh_.positionOf(a);
  const Vec3& pb = mesh_.positionOf(b);
  const Vec3& pc = mesh_.positionOf(c);
  const Vec3& pd = mesh_.positionOf(d);
  const Shape left = shapeOf(pa, pb, pc);
  const Shape right = shapeOf(pb, pa, pd);
  const double before = std::min(left.quality, right.quality);
  const bool leavesBoundary = joinsBoundary(a, b) && !joinsBoundary(c, d);
  if (before > kBest && !leavesBoundary) return false;
  const Shape newA = shapeOf(pd, pc, pa);
  const Shape newB = shapeOf(pc, pd, pb);
  const double after = std::min(newA.quality, newB.quality);
  if (after < kDegenerate) return false;
  if (!(after > before + kGain) && !(leavesBoundary && after > kGoodEnough)) return false;
  const double across = distance(pc, pd);
  if (joinsBoundary(c, d) && !joinsBoundary(a, b) && across > kNarrow * edgeLength(c, d)) return false;
  const Vec3 around = mesh_.normal[index(c)] + mesh_.normal[index(d)];
  if (!looksAlong(newA.area, around + mesh_.normal[index(a)])) return false;
  if (!looksAlong(newB.area, around + mesh_.normal[index(b)])) return false;
  // Across a fold of two facets much larger than the target, a flip would cut a corner off.
  const double large = 2.5 * edgeLength(a, b);
  if (mesh_.length(h) < large && across < large) return true;
  return dot(normalized(left.area), normalized(right.area)) > kFlat;
}

/// Whether an edge between two triangles of a plane, one of them a needle, is not Delaunay: the angles opposite it are
/// more than half a turn together.
bool Remesher::wantsNeedleFlip(std::int32_t h) const {
  constexpr double kFlat = 0.9999;
  constexpr double kRoundOff = 1e-12;
  const Vec3& a = mesh_.positionOf(mesh_.origin(h));
  const Vec3& b = mesh_.positionOf(mesh_.target(h));
  const Vec3& c = mesh_.positionOf(mesh_.apex(h));
  const Vec3& d = mesh_.positionOf(mesh_.apex(mesh_.twin(h)));
  const Shape left = shapeOf(a, b, c);
  const Shape right = shapeOf(b, a, d);
  if (std::min(left.quality, right.quality) >= kPoorQuality) return false;
  if (!(dot(normalized(left.area), normalized(right.area)) > kFlat)) return false;
  const Vec3 normal = left.area + right.area;
  for (const auto& [p, q, r] : {std::array{d, c, a}, std::array{c, d, b}}) {
    const Vec3 area = cross(q - p, r - p);
    if (!(dot(area, normal) > kFlat * norm(area) * norm(normal))) return false;
  }
  const double atC = norm(cross(a - c, b - c));
  const double atD = norm(cross(b - d, a - d));
  const double sine = atC * dot(b - d, a - d) + atD * dot(a - c, b - c);
  return sine < -kRoundOff * norm(a - c) * norm(b - c) * norm(b - d) * norm(a - d);
}

bool Remesher::flipNeedles(Progress& progress) {
  std::vector<std::int32_t> due;
  for (std::int32_t h = 0; h < mesh_.halfedgeCount(); ++h) due.push_back(h);
  // Two rails of n nodes, joined from one end, take n^2 / 2 flips, and each flip asks four edges again.
  constexpr double kMost = 2e8;
  const auto count = static_cast<double>(due.size());
  auto budget = static_cast<std::int64_t>(std::min(kMost, 16.0 * count + count * count / 8.0));
  constexpr std::int64_t kBetweenReports = 1 << 18;
  for (; !due.empty() && budget > 0; --budget) {
    if (budget % kBetweenReports == 0 && !progress.report(Stage::background, 0.0)) return false;
    const std::int32_t h = due.back();
    due.pop_back();
    if (mesh_.isRemoved(h) || mesh_.twin(h) == kNone || !wantsNeedleFlip(h) || !mesh_.canFlip(h)) continue;
    for (const std::int32_t v : {mesh_.origin(h), mesh_.target(h), mesh_.apex(h), mesh_.apex(mesh_.twin(h))}) {
      wake(v);
    }
    mesh_.flip(h);
    for (const std::int32_t side : {h, mesh_.twin(h)}) {
      due.push_back(RemeshMesh::next(side));
      due.push_back(RemeshMesh::prev(side));
    }
  }
  return true;
}

void Remesher::flipEdges() {
  constexpr int kSweeps = 4;
  // An edge that did not want to flip does not either as long as its triangles are the same.
  std::vector<std::int8_t> lastFlip(index(mesh_.vertexCount()), -1);  // Per vertex: sweep of the last flip around it.
  for (std::int8_t sweep = 0; sweep < kSweeps; ++sweep) {
    std::int32_t flipped = 0;
    for (std::int32_t h = 0; h < mesh_.halfedgeCount(); ++h) {
      if (mesh_.isRemoved(h) || mesh_.twin(h) < h) continue;
      const std::array<std::int32_t, 4> corners{mesh_.origin(h), mesh_.target(h), mesh_.apex(h),
                                                mesh_.apex(mesh_.twin(h))};
      const bool changed =
          std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) { return lastFlip[index(v)] + 1 >= sweep; });
      if (!changed || !wantsFlip(h) || !mesh_.canFlip(h)) continue;
      mesh_.flip(h);
      for (const std::int32_t v : corners) {
        lastFlip[index(v)] = sweep;
        wake(v);
      }
      ++flipped;
    }
    if (flipped == 0) return;
  }
}

bool Remesher::tryMove(std::int32_t v, const Vec3& to, const Vec3& normal) {
  double worstAfter = 1.0;
  bool good = true;
  mesh_.forEachOutgoing(v, [&](std::int32_t h) {
    if (!good) return;
    const Shape after = shapeOf(to, mesh_.positionOf(mesh_.target(h)), mesh_.positionOf(mesh_.apex(h)));
    good = looksAlong(after.area, normal);
    worstAfter = std::min(worstAfter, after.quality);
  });
  if (!good) return false;
  if (worstAfter < kPoorQuality) {
    double worstBefore = 1.0;
    mesh_.forEachOutgoing(
        v, [&](std::int32_t h) { worstBefore = std::min(worstBefore, quality(v, mesh_.target(h), mesh_.apex(h))); });
    if (worstAfter < worstBefore) return false;
  }
  mesh_.position[index(v)] = to;
  return true;
}

void Remesher::wakeAround(std::int32_t v) {
  wake(v);
  mesh_.forEachNeighbor(v, [this](std::int32_t w) { wake(w); });
}

void Remesher::smoothVertex(std::int32_t v) {
  // Of the target length: shorter moves don't make better triangles.
  constexpr double kStill = 0.01;
  const Vec3 p = mesh_.positionOf(v);
  Vec3 sum;
  double weights = 0.0;
  mesh_.forEachNeighbor(v, [&](std::int32_t w) {
    const double weight = distance(p, mesh_.positionOf(w)) / edgeLength(v, w);
    sum += mesh_.positionOf(w) * weight;
    weights += weight;
  });
  if (!(weights > 0.0)) return;
  const Vec3& normal = mesh_.normal[index(v)];
  const Vec3 step = tangentPart(sum / weights - p, normal);
  if (!tryMove(v, p + step, normal) && !tryMove(v, p + step * 0.3, normal)) return;
  moved_[index(v)] = 1;
  if (norm(step) > kStill * length_[index(v)]) wakeAround(v);
}

void Remesher::smooth(int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::int32_t v = 0; v < mesh_.vertexCount(); ++v) {
      if (std::exchange(awake_[index(v)], 0) == 0) continue;
      if (!mesh_.isVertexRemoved(v) && mesh_.role[index(v)] == VertexRole::interior) smoothVertex(v);
    }
  }
  for (std::int32_t v = 0; v < mesh_.vertexCount(); ++v) {
    if (std::exchange(moved_[index(v)], 0) == 0) continue;
    if (mesh_.isVertexRemoved(v) || mesh_.role[index(v)] != VertexRole::interior) continue;
    const FaceReference::Foot foot =
        reference_.project(mesh_.positionOf(v), mesh_.normal[index(v)], mesh_.triangle[index(v)]);
    if (!tryMove(v, foot.position, foot.normal)) continue;
    mesh_.normal[index(v)] = foot.normal;
    mesh_.triangle[index(v)] = foot.triangle;
  }
}

}  // namespace qmcf
