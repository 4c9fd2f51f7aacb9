#include "triangle_edges.hpp"

#include <algorithm>

namespace qmcf::detail {

TriangleEdges::TriangleEdges(const Triangles& triangles, std::size_t vertexCount)
    : triangles_(&triangles), vertexCount_(vertexCount) {
  // Half-edges bucketed by their smaller vertex, then sorted by the larger one within each (short) bucket.
  struct Use {
    VertexId larger;
    HalfedgeId halfedge;
    bool operator<(const Use& other) const {
      return larger != other.larger ? larger < other.larger : halfedge < other.halfedge;
    }
  };
  std::vector<std::size_t> bucket(vertexCount + 1, 0);
  for (const HalfedgeId h : halfedges()) ++bucket[std::min(origin(h), target(h)).index() + 1];
  for (std::size_t v = 0; v < vertexCount; ++v) bucket[v + 1] += bucket[v];
  std::vector<Use> sorted(halfedgeCount());
  std::vector<std::size_t> fill(bucket.begin(), bucket.end() - 1);
  for (const HalfedgeId h : halfedges()) {
    const auto [smaller, larger] = std::minmax({origin(h), target(h)});
    sorted[fill[smaller.index()]++] = {larger, h};
  }

  uses_.resize(halfedgeCount());
  edge_.resize(halfedgeCount());
  for (std::size_t v = 0; v < vertexCount; ++v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(bucket[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(bucket[v + 1]));
    for (std::size_t i = bucket[v]; i < bucket[v + 1]; ++i) {
      if (i == bucket[v] || sorted[i - 1].larger != sorted[i].larger) {
        ends_.push_back({VertexId(v), sorted[i].larger});
        firstUse_.push_back(i);
      }
      uses_[i] = sorted[i].halfedge;
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
