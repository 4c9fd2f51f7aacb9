#include "qmcf/front/loops.hpp"

#include <algorithm>

namespace qmcf {

std::vector<HalfedgeId> frontEdgesAt(const FrontMesh& front, VertexId v) {
  std::vector<HalfedgeId> edges;
  front.mesh().forEachOutgoing(v, [&](HalfedgeId h) {
    if (!front.isFront(h)) return;
    edges.push_back(h);
    edges.push_back(front.previousFront(h));
  });
  return edges;
}

int oddLoops(const FrontMesh& front, const std::vector<HalfedgeId>& edges) {
  std::vector<HalfedgeId> seen;
  int odd = 0;
  for (const HalfedgeId h : edges) {
    if (!front.isFront(h)) continue;
    HalfedgeId smallest = h;
    int length = 1;
    for (HalfedgeId e = front.nextFront(h); e != h; e = front.nextFront(e)) {
      smallest = std::min(smallest, e);
      ++length;
    }
    if (std::find(seen.begin(), seen.end(), smallest) != seen.end()) continue;
    seen.push_back(smallest);
    odd += length % 2;
  }
  return odd;
}

}  // namespace qmcf
