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
  std::vector<HalfedgeId> left;  // Edges of loops that have not been counted yet.
  for (const HalfedgeId h : edges) {
    if (front.isFront(h)) left.push_back(h);
  }
  int odd = 0;
  while (!left.empty()) {
    const HalfedgeId first = left.back();
    HalfedgeId h = first;
    int length = 0;
    do {
      left.erase(std::remove(left.begin(), left.end(), h), left.end());
      h = front.nextFront(h);
      ++length;
    } while (h != first);
    odd += length % 2;
  }
  return odd;
}

}  // namespace qmcf
