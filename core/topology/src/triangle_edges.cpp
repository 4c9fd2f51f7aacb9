#include "triangle_edges.hpp"

#include <algorithm>

namespace qmcf::detail {

TriangleEdges::TriangleEdges(const Triangles& triangles, std::size_t vertexCount)
    : triangles_(&triangles), vertexCount_(vertexCount) {
  // Half-edges bucketed by their smaller vertex, then sorted by the larger one within each (short) bucket.
  const auto ordered = [&](HalfedgeId h) {
    const VertexId a = origin(h);
    const VertexId b = target(h);
    return a < b ? std::array{a, b} : std::array{b, a};
  };
  std::vector<std::size_t> bucket(vertexCount + 1, 0);
  for (const HalfedgeId h : halfedges()) ++bucket[ordered(h)[0].index() + 1];
  for (std::size_t v = 0; v < vertexCount; ++v) bucket[v + 1] += bucket[v];
  uses_.resize(halfedgeCount());
  std::vector<std::size_t> fill(bucket.begin(), bucket.end() - 1);
  for (const HalfedgeId h : halfedges()) uses_[fill[ordered(h)[0].index()]++] = h;

  edge_.resize(halfedgeCount());
  for (std::size_t v = 0; v < vertexCount; ++v) {
    const auto begin = uses_.begin() + static_cast<std::ptrdiff_t>(bucket[v]);
    const auto end = uses_.begin() + static_cast<std::ptrdiff_t>(bucket[v + 1]);
    std::sort(begin, end, [&](HalfedgeId g, HalfedgeId h) {
      const VertexId a = ordered(g)[1];
      const VertexId b = ordered(h)[1];
      return a != b ? a < b : g < h;
    });
    for (std::size_t i = bucket[v]; i < bucket[v + 1]; ++i) {
      const auto pair = ordered(uses_[i]);
      if (i == bucket[v] || ends_[EdgeId(ends_.size() - 1)] != pair) {
        ends_.push_back(pair);
        firstUse_.push_back(i);
      }
      edge_[uses_[i]] = EdgeId(ends_.size() - 1);
    }
  }
  firstUse_.push_back(uses_.size());
}

Fans buildFans(const TriangleEdges& edges, const IdMap<EdgeId, std::uint8_t>& cut) {
  Fans fans;
  fans.ofCorner.resize(edges.halfedgeCount(), kNone);
  const auto walk = [&](HalfedgeId first, bool open) {
    const auto fan = static_cast<std::int32_t>(fans.first.size());
    fans.first.push_back(first);
    fans.open.push_back(open);
    for (HalfedgeId h = first; h.valid() && fans.ofCorner[h] == kNone;) {
      fans.ofCorner[h] = fan;
      const HalfedgeId incoming = Surface::prev(h);
      h = cut[edges.edge(incoming)] != 0 ? HalfedgeId() : edges.other(incoming);
    }
  };
  for (const HalfedgeId h : edges.halfedges()) {
    if (cut[edges.edge(h)] != 0) walk(h, true);
  }
  for (const HalfedgeId h : edges.halfedges()) {
    if (fans.ofCorner[h] == kNone) walk(h, false);
  }
  return fans;
}

VertexEdges::VertexEdges(const TriangleEdges& edges, const IdMap<EdgeId, std::uint8_t>& keep)
    : first_(edges.vertexCount() + 1, 0) {
  for (const EdgeId e : edges.edges()) {
    if (keep[e] == 0) continue;
    for (const VertexId v : edges.ends(e)) ++first_[v.index() + 1];
  }
  for (std::size_t v = 0; v < edges.vertexCount(); ++v) first_[v + 1] += first_[v];
  list_.resize(first_.back());
  std::vector<std::size_t> fill(first_.begin(), first_.end() - 1);
  for (const EdgeId e : edges.edges()) {
    if (keep[e] == 0) continue;
    for (const VertexId v : edges.ends(e)) list_[fill[v.index()]++] = e;
  }
}

}  // namespace qmcf::detail
