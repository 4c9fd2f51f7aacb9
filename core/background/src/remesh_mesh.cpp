#include "remesh_mesh.hpp"

#include <cstddef>
#include <utility>

namespace qmcf {

void RemeshMesh::build(const std::vector<std::array<std::int32_t, 3>>& triangles,
                       const std::vector<std::int32_t>& twins) {
  origin_.clear();
  for (const auto& t : triangles) origin_.insert(origin_.end(), t.begin(), t.end());
  twin_ = twins;
  mark_.assign(origin_.size(), kNone);
  outgoing_.assign(position.size(), kNone);
  stamp_.assign(position.size(), 0);
  role.assign(position.size(), VertexRole::interior);
  node.assign(position.size(), kNone);
  triangle.assign(position.size(), kNone);
  for (std::int32_t h = 0; h < halfedgeCount(); ++h) {
    std::int32_t& out = at(outgoing_, origin(h));
    if (out == kNone || twin(h) == kNone) out = h;
  }
}

std::vector<std::int32_t> RemeshMesh::renumber() {
  std::vector<std::int32_t> newVertex(position.size(), kNone);
  std::vector<std::int32_t> newTriangle(origin_.size() / 3, kNone);
  std::vector<std::int32_t> vertices;   // In the new order.
  std::vector<std::int32_t> triangles;  // Likewise.
  const auto reach = [&](std::int32_t v) {
    if (at(newVertex, v) != kNone) return;
    at(newVertex, v) = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(v);
  };
  // From the whole boundary inwards, as the front that will consume the mesh goes.
  for (std::int32_t v = 0; v < vertexCount(); ++v) {
    if (isVertexRemoved(v) || !onBoundary(v)) continue;
    for (std::int32_t w = v; at(newVertex, w) == kNone; w = target(outgoing(w))) reach(w);
  }
  std::size_t next = 0;
  for (std::int32_t seed = 0; seed < vertexCount(); ++seed) {
    if (isVertexRemoved(seed)) continue;
    reach(seed);
    for (; next < vertices.size(); ++next) {
      forEachOutgoing(vertices[next], [&](std::int32_t h) {
        if (at(newTriangle, h / 3) == kNone) {
          at(newTriangle, h / 3) = static_cast<std::int32_t>(triangles.size());
          triangles.push_back(h / 3);
        }
        reach(target(h));
        reach(apex(h));
      });
    }
  }
  reorder(vertices, triangles, newVertex, newTriangle);
  return newVertex;
}

void RemeshMesh::reorder(const std::vector<std::int32_t>& vertices, const std::vector<std::int32_t>& triangles,
                         const std::vector<std::int32_t>& newVertex, const std::vector<std::int32_t>& newTriangle) {
  const auto newHalfedge = [&](std::int32_t h) { return h == kNone ? kNone : 3 * at(newTriangle, h / 3) + h % 3; };
  RemeshMesh now;
  for (const std::int32_t v : vertices) {
    now.position.push_back(at(position, v));
    now.normal.push_back(at(normal, v));
    now.role.push_back(at(role, v));
    now.node.push_back(at(node, v));
    now.triangle.push_back(at(triangle, v));
    now.outgoing_.push_back(newHalfedge(at(outgoing_, v)));
  }
  for (const std::int32_t t : triangles) {
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      now.origin_.push_back(at(newVertex, origin(h)));
      now.twin_.push_back(newHalfedge(twin(h)));
      now.mark_.push_back(mark(h));
    }
  }
  now.stamp_.assign(vertices.size(), 0);
  *this = std::move(now);
}

std::int32_t RemeshMesh::incomingBoundary(std::int32_t v) const {
  std::int32_t last = outgoing(v);
  forEachOutgoing(v, [&last](std::int32_t h) { last = h; });
  return prev(last);
}

bool RemeshMesh::hasNeighbors(std::int32_t v, int count) const {
  const std::int32_t first = outgoing(v);
  std::int32_t h = first;
  for (int found = 1; found < count; ++found) {
    const std::int32_t last = prev(h);
    h = twin(last);
    if (h == first) return false;
    if (h == kNone) return found + 1 >= count;
  }
  return true;
}

bool RemeshMesh::areNeighbors(std::int32_t a, std::int32_t b) const {
  // Around both at a time, until one is done: of the two, one often has few neighbours where the other is the hub of a
  // long fan.
  const auto touches = [this](std::int32_t h, std::int32_t v) { return target(h) == v || apex(h) == v; };
  const std::int32_t firstOfA = outgoing(a);
  const std::int32_t firstOfB = outgoing(b);
  std::int32_t ofA = firstOfA;
  std::int32_t ofB = firstOfB;
  do {
    if (touches(ofA, b) || touches(ofB, a)) return true;
    ofA = twin(prev(ofA));
    ofB = twin(prev(ofB));
  } while (ofA != kNone && ofB != kNone && ofA != firstOfA && ofB != firstOfB);
  return false;
}

std::int32_t RemeshMesh::addTriangle() {
  const std::int32_t first = halfedgeCount();
  origin_.resize(origin_.size() + 3, kNone);
  twin_.resize(twin_.size() + 3, kNone);
  mark_.resize(mark_.size() + 3, kNone);
  return first;
}

void RemeshMesh::pair(std::int32_t a, std::int32_t b) {
  at(twin_, a) = b;
  at(twin_, b) = a;
  at(mark_, a) = kNone;
  at(mark_, b) = kNone;
}

/// Gives the other side of the half-edge `from`, be it a twin or a mark, to `to`.
void RemeshMesh::hand(std::int32_t from, std::int32_t to) {
  const std::int32_t other = twin(from);
  at(twin_, to) = other;
  at(mark_, to) = mark(from);
  if (other != kNone) at(twin_, other) = to;
}

void RemeshMesh::settle(std::int32_t v, std::int32_t anyOutgoing) {
  std::int32_t h = anyOutgoing;
  do {
    if (twin(h) == kNone) break;
    h = next(twin(h));
  } while (h != anyOutgoing);
  at(outgoing_, v) = h;
}

std::int32_t RemeshMesh::split(std::int32_t h, const Vec3& where) {
  const std::int32_t m = vertexCount();
  const std::int32_t g = twin(h);
  const std::int32_t b = target(h);
  const std::int32_t c = apex(h);
  const std::int32_t bc = next(h);
  position.push_back(where);
  normal.emplace_back();
  role.push_back(VertexRole::interior);
  node.push_back(kNone);
  triangle.push_back(kNone);
  stamp_.push_back(0);
  outgoing_.push_back(kNone);

  const std::int32_t mb = addTriangle();  // The triangle m, b, c.
  at(origin_, mb) = m;
  at(origin_, mb + 1) = b;
  at(origin_, mb + 2) = c;
  hand(bc, mb + 1);
  at(origin_, bc) = m;
  pair(bc, mb + 2);
  if (at(outgoing_, b) == bc) at(outgoing_, b) = mb + 1;
  at(outgoing_, m) = mb;
  at(mark_, mb) = mark(h);
  if (g == kNone) return m;

  const std::int32_t d = apex(g);
  const std::int32_t db = prev(g);
  const std::int32_t bm = addTriangle();  // The triangle b, m, d.
  at(origin_, bm) = b;
  at(origin_, bm + 1) = m;
  at(origin_, bm + 2) = d;
  hand(db, bm + 2);
  at(origin_, g) = m;
  pair(db, bm + 1);
  pair(bm, mb);
  if (at(outgoing_, b) == g) at(outgoing_, b) = bm;
  if (at(outgoing_, d) == db) at(outgoing_, d) = bm + 2;
  return m;
}

bool RemeshMesh::canFlip(std::int32_t h) const {
  const std::int32_t g = twin(h);
  if (g == kNone) return false;
  const std::int32_t c = apex(h);
  const std::int32_t d = apex(g);
  return c != d && !areNeighbors(c, d);
}

void RemeshMesh::flip(std::int32_t h) {
  const std::int32_t g = twin(h);
  const std::int32_t a = origin(h);
  const std::int32_t b = origin(g);
  const std::int32_t c = apex(h);
  const std::int32_t d = apex(g);
  // The two triangles become d, c, a and c, d, b: each outer edge moves one slot on, to its own triangle or the other.
  struct Outer {
    std::int32_t twin;
    std::int32_t mark;
  };
  const auto outer = [this](std::int32_t e) { return Outer{twin(e), mark(e)}; };
  const Outer bc = outer(next(h));
  const Outer ca = outer(prev(h));
  const Outer ad = outer(next(g));
  const Outer db = outer(prev(g));
  // A vertex on the boundary keeps the edge that leaves it there, in its new slot; others take any.
  const auto leaving = [&](std::int32_t v, std::int32_t any) {
    const std::int32_t e = outgoing(v);
    if (twin(e) != kNone) return any;
    if (e == next(h)) return prev(g);
    if (e == prev(h)) return next(h);
    if (e == next(g)) return prev(h);
    return e == prev(g) ? next(g) : e;
  };
  const std::int32_t fromA = leaving(a, prev(h));
  const std::int32_t fromB = leaving(b, prev(g));
  const std::int32_t fromC = leaving(c, next(h));
  const std::int32_t fromD = leaving(d, next(g));
  const auto place = [this](std::int32_t e, std::int32_t from, const Outer& beyond) {
    at(origin_, e) = from;
    at(twin_, e) = beyond.twin;
    at(mark_, e) = beyond.mark;
    if (beyond.twin != kNone) at(twin_, beyond.twin) = e;
  };
  place(next(h), c, ca);
  place(prev(h), a, ad);
  place(next(g), d, db);
  place(prev(g), b, bc);
  at(origin_, h) = d;
  at(origin_, g) = c;
  at(outgoing_, a) = fromA;
  at(outgoing_, b) = fromB;
  at(outgoing_, c) = fromC;
  at(outgoing_, d) = fromD;
}

bool RemeshMesh::canCollapse(std::int32_t h, std::int32_t removed) {
  const std::int32_t g = twin(h);
  const std::int32_t kept = origin(h) == removed ? target(h) : origin(h);
  const VertexRole fate = role[static_cast<std::size_t>(removed)];
  if (fate == VertexRole::node) return false;
  if (fate == VertexRole::point && g != kNone) return false;
  // A triangle that hangs on by one edge only would leave an edge without triangles.
  for (const std::int32_t side : {h, g}) {
    if (side != kNone && twin(next(side)) == kNone && twin(prev(side)) == kNone) return false;
  }
  ++visit_;
  forEachNeighbor(removed, [this](std::int32_t v) { at(stamp_, v) = visit_; });
  int common = 0;
  forEachNeighbor(kept, [&](std::int32_t v) { common += at(stamp_, v) == visit_ ? 1 : 0; });
  if (common != (g == kNone ? 1 : 2)) return false;
  // An apex inside the surface needs three neighbours afterwards.
  for (const std::int32_t side : {h, g}) {
    if (side == kNone || onBoundary(apex(side))) continue;
    if (!hasNeighbors(apex(side), 4)) return false;
  }
  return true;
}

/// Removes the triangle of h, whose edge has shrunk to a point, and joins its other two sides.
/// Returns a half-edge that leaves that point.
std::int32_t RemeshMesh::closeTriangle(std::int32_t h) {
  const std::int32_t n = next(h);
  const std::int32_t p = prev(h);
  const std::int32_t x = origin(p);
  const std::int32_t beyondN = twin(n);
  const std::int32_t beyondP = twin(p);
  if (beyondN != kNone) {
    at(twin_, beyondN) = beyondP;
    if (beyondP == kNone) at(mark_, beyondN) = mark(p);
  }
  if (beyondP != kNone) {
    at(twin_, beyondP) = beyondN;
    if (beyondN == kNone) at(mark_, beyondP) = mark(n);
  }
  for (const std::int32_t e : {h, n, p}) at(origin_, e) = kNone;
  settle(x, beyondN != kNone ? beyondN : next(beyondP));
  return beyondP != kNone ? beyondP : next(beyondN);
}

void RemeshMesh::collapse(std::int32_t h, std::int32_t removed) {
  const std::int32_t g = twin(h);
  const std::int32_t kept = origin(h) == removed ? target(h) : origin(h);
  std::int32_t e = outgoing(removed);
  const std::int32_t first = e;
  do {
    at(origin_, e) = kept;
    e = twin(prev(e));
  } while (e != kNone && e != first);
  at(outgoing_, removed) = kNone;
  std::int32_t leaving = closeTriangle(h);
  if (g != kNone) {
    const std::int32_t other = closeTriangle(g);
    if (isRemoved(leaving)) leaving = other;
  }
  settle(kept, leaving);
}

}  // namespace qmcf
