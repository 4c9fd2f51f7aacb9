// Gradation as in Persson 2006: the largest size below the given one whose slope is bounded, by Dijkstra's algorithm.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "edge_samples.hpp"
#include "qmcf/sizing/min_heap.hpp"

namespace qmcf {
namespace {

/// All samples of all edges; the samples at a B-rep vertex are one node.
struct Nodes {
  std::vector<Vec3> position;
  std::vector<double> size;
  std::vector<std::vector<std::int32_t>> ofEdge;                        ///< Per edge, per sample.
  std::vector<std::vector<std::pair<std::int32_t, double>>> neighbors;  ///< Along edges: node, length.
  std::vector<std::vector<std::int32_t>> faces;                         ///< Faces beside a node.
  std::vector<std::vector<std::int32_t>> ofFace;
};

Nodes collectNodes(const EdgeSamples& samples, const Brep& brep) {
  Nodes nodes;
  nodes.position.resize(brep.vertices.size());
  nodes.size.assign(brep.vertices.size(), samples.base);
  nodes.ofEdge.resize(samples.sizes.size());
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    const EdgeSizes& sizes = samples.sizes[e];
    for (std::size_t i = 0; i < sizes.value.size(); ++i) {
      const bool isStart = i == 0;
      const bool isEnd = i + 1 == sizes.value.size();
      auto node = static_cast<std::int32_t>(nodes.position.size());
      if (isStart || isEnd) {
        node = isStart ? brep.edges[e].start : brep.edges[e].end;
      } else {
        nodes.position.emplace_back();
        nodes.size.push_back(samples.base);
      }
      nodes.ofEdge[e].push_back(node);
      const auto n = static_cast<std::size_t>(node);
      nodes.position[n] = samples.curves[e].at(sizes.arcLength[i]);
      nodes.size[n] = std::min(nodes.size[n], sizes.value[i]);
    }
  }
  nodes.neighbors.resize(nodes.position.size());
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    const std::vector<std::int32_t>& chain = nodes.ofEdge[e];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const double length = samples.sizes[e].arcLength[i + 1] - samples.sizes[e].arcLength[i];
      nodes.neighbors[static_cast<std::size_t>(chain[i])].emplace_back(chain[i + 1], length);
      nodes.neighbors[static_cast<std::size_t>(chain[i + 1])].emplace_back(chain[i], length);
    }
  }
  nodes.faces.resize(nodes.position.size());
  nodes.ofFace.resize(brep.faces.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    std::vector<std::int32_t>& own = nodes.ofFace[f];
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        const auto& chain = nodes.ofEdge[static_cast<std::size_t>(coedge.edge)];
        own.insert(own.end(), chain.begin(), chain.end());
      }
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const std::int32_t n : own) nodes.faces[static_cast<std::size_t>(n)].push_back(static_cast<std::int32_t>(f));
  }
  return nodes;
}

/// The nodes of one face in cubes, for neighbours within one cube's width.
class FaceGrid {
 public:
  FaceGrid(const std::vector<Vec3>& position, const std::vector<std::int32_t>& nodes, double width) : width_(width) {
    entries_.reserve(nodes.size());
    for (const std::int32_t n : nodes) entries_.push_back({cellOf(position[static_cast<std::size_t>(n)]), n});
    std::sort(entries_.begin(), entries_.end());
  }

  template <class Visit>
  void forEachNear(const Vec3& p, Visit visit) const {
    const Cell center = cellOf(p);
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // The three cells along z follow each other in the order of the entries.
        const Cell first{center[0] + dx, center[1] + dy, center[2] - 1};
        const Cell last{center[0] + dx, center[1] + dy, center[2] + 1};
        auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{first, kNone});
        for (; it != entries_.end() && it->first <= last; ++it) visit(it->second);
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cell, std::int32_t>;

  [[nodiscard]] Cell cellOf(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / width_)), static_cast<std::int64_t>(std::floor(p.y / width_)),
            static_cast<std::int64_t>(std::floor(p.z / width_))};
  }

  double width_;
  std::vector<Entry> entries_;
};

}  // namespace

void gradeEdges(EdgeSamples& samples, const Brep& brep, double gradation) {
  Nodes nodes = collectNodes(samples, brep);
  double smallest = samples.base;
  for (const double size : nodes.size) smallest = std::min(smallest, size);
  // No cone reaches farther than this before it meets the base size.
  const double farthest = std::max((samples.base - smallest) / gradation, samples.base);
  std::vector<FaceGrid> grids;
  grids.reserve(nodes.ofFace.size());
  for (const auto& own : nodes.ofFace) grids.emplace_back(nodes.position, own, farthest);

  std::vector<std::int32_t> through(nodes.size.size(), kNone);  // The face through which a node got its size.
  MinHeap heap;
  for (std::size_t n = 0; n < nodes.size.size(); ++n) {
    if (nodes.size[n] < samples.base) heap.push(nodes.size[n], static_cast<std::int32_t>(n));
  }
  const auto relax = [&](std::int32_t node, double size, std::int32_t face) {
    const auto n = static_cast<std::size_t>(node);
    if (!(size < nodes.size[n])) return;
    nodes.size[n] = size;
    through[n] = face;
    heap.push(size, node);
  };
  while (!heap.empty()) {
    // No structured binding: clang before 16 can't capture one in a lambda.
    const MinHeap::Entry entry = heap.pop();
    const double size = entry.first;
    const std::int32_t node = entry.second;
    const auto n = static_cast<std::size_t>(node);
    if (size > nodes.size[n]) continue;
    for (const auto& [neighbor, length] : nodes.neighbors[n]) relax(neighbor, size + gradation * length, kNone);
    for (const std::int32_t face : nodes.faces[n]) {
      // What came straight through a face has reached all of that face already.
      if (face == through[n]) continue;
      grids[static_cast<std::size_t>(face)].forEachNear(nodes.position[n], [&](std::int32_t other) {
        const double way = distance(nodes.position[n], nodes.position[static_cast<std::size_t>(other)]);
        relax(other, size + gradation * way, face);
      });
    }
  }
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    for (std::size_t i = 0; i < samples.sizes[e].value.size(); ++i) {
      samples.sizes[e].value[i] = nodes.size[static_cast<std::size_t>(nodes.ofEdge[e][i])];
    }
  }
}

}  // namespace qmcf
