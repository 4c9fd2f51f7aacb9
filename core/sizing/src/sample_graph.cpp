// Gradation as in Persson 2006: the largest size below the given one whose slope is bounded, by Dijkstra's algorithm.
#include "sample_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "qmcf/sizing/min_heap.hpp"
#include "qmcf/sizing/point_grid.hpp"

namespace qmcf {
namespace {

struct Piece {
  std::array<Vec3, 3> corner;
  double area;
  std::array<double, 3> size{};  ///< At the corners, where there are sizes inside the face.
};

double areaOf(const std::array<Vec3, 3>& c) { return 0.5 * norm(cross(c[1] - c[0], c[2] - c[0])); }

/// The halves of a triangle on both sides of the middle of its longest side.
std::array<Piece, 2> halves(const Piece& piece) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    const auto side = [&](std::size_t i) { return squaredNorm(piece.corner[(i + 1) % 3] - piece.corner[i]); };
    if (side(k) > side(longest)) longest = k;
  }
  const Vec3& a = piece.corner[longest];
  const Vec3& b = piece.corner[(longest + 1) % 3];
  const Vec3& c = piece.corner[(longest + 2) % 3];
  const Vec3 m = (a + b) * 0.5;
  const double first = piece.size[longest];
  const double second = piece.size[(longest + 1) % 3];
  const double third = piece.size[(longest + 2) % 3];
  const double middle = 0.5 * (first + second);
  return {Piece{{a, m, c}, 0.5 * piece.area, {first, middle, third}},
          Piece{{m, b, c}, 0.5 * piece.area, {middle, second, third}}};
}

}  // namespace

/// The sizes that some nodes of a face make around them.
class SampleGraph::Cones {
 public:
  Cones(const SampleGraph& graph, const std::vector<std::int32_t>& tips, double gradation)
      : graph_(graph), grid_(graph.position_, tips, graph.farthest(gradation)), gradation_(gradation) {}

  /// At most `highest`.
  [[nodiscard]] double at(const Vec3& p, double highest) const {
    double h = highest;
    grid_.forEachNear(p, [&](std::int32_t tip) {
      const auto n = static_cast<std::size_t>(tip);
      h = std::min(h, graph_.size_[n] + gradation_ * distance(p, graph_.position_[n]));
    });
    return h;
  }

 private:
  const SampleGraph& graph_;
  PointGrid grid_;
  double gradation_;
};

SampleGraph::SampleGraph(const EdgeSamples& samples, const Brep& brep, const std::vector<SizeLimit>& limits)
    : base_(samples.base) {
  position_.resize(brep.vertices.size());
  size_.assign(brep.vertices.size(), base_);
  highest_.assign(brep.vertices.size(), base_);
  ofEdge_.resize(samples.sizes.size());
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    const EdgeSizes& sizes = samples.sizes[e];
    for (std::size_t i = 0; i < sizes.value.size(); ++i) {
      const bool isStart = i == 0;
      const bool isEnd = i + 1 == sizes.value.size();
      auto node = static_cast<std::int32_t>(position_.size());
      if (isStart || isEnd) {
        node = isStart ? brep.edges[e].start : brep.edges[e].end;
      } else {
        position_.emplace_back();
        size_.push_back(base_);
        highest_.push_back(base_);
      }
      ofEdge_[e].push_back(node);
      const auto n = static_cast<std::size_t>(node);
      position_[n] = samples.curves[e].at(sizes.arcLength[i]);
      size_[n] = std::min(size_[n], sizes.value[i]);
      if (!samples.highest.empty()) highest_[n] = std::min(highest_[n], samples.highest[e][i]);
    }
  }
  firstLimit_ = position_.size();
  for (const SizeLimit& limit : limits) {
    position_.push_back(limit.position);
    size_.push_back(std::min(limit.size, base_));
    highest_.push_back(base_);
  }
  neighbors_.resize(position_.size());
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    const std::vector<std::int32_t>& chain = ofEdge_[e];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const double length = samples.sizes[e].arcLength[i + 1] - samples.sizes[e].arcLength[i];
      neighbors_[static_cast<std::size_t>(chain[i])].emplace_back(chain[i + 1], length);
      neighbors_[static_cast<std::size_t>(chain[i + 1])].emplace_back(chain[i], length);
    }
  }
  faces_.resize(position_.size());
  ofFace_.resize(brep.faces.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    std::vector<std::int32_t>& own = ofFace_[f];
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        const auto& chain = ofEdge_[static_cast<std::size_t>(coedge.edge)];
        own.insert(own.end(), chain.begin(), chain.end());
      }
    }
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  for (std::size_t i = 0; i < limits.size(); ++i) {
    ofFace_[static_cast<std::size_t>(limits[i].face)].push_back(static_cast<std::int32_t>(firstLimit_ + i));
  }
  for (std::size_t f = 0; f < ofFace_.size(); ++f) {
    for (const std::int32_t n : ofFace_[f]) faces_[static_cast<std::size_t>(n)].push_back(static_cast<std::int32_t>(f));
  }
}

double SampleGraph::farthest(double gradation) const {
  double smallest = base_;
  for (std::size_t n = 0; n < size_.size(); ++n) {
    if (size_[n] < highest_[n]) smallest = std::min(smallest, size_[n]);
  }
  return std::max((base_ - smallest) / gradation, base_);
}

void SampleGraph::grade(double gradation) {
  MinHeap heap;
  for (std::size_t n = 0; n < size_.size(); ++n) {
    if (size_[n] < highest_[n]) heap.push(size_[n], static_cast<std::int32_t>(n));
  }
  if (heap.empty()) return;
  const double reach = farthest(gradation);
  std::vector<PointGrid> grids;
  grids.reserve(ofFace_.size());
  for (const auto& own : ofFace_) grids.emplace_back(position_, own, reach);
  std::vector<std::int32_t> through(size_.size(), kNone);  // The face through which a node got its size.
  const auto relax = [&](std::int32_t node, double size, std::int32_t face) {
    const auto n = static_cast<std::size_t>(node);
    if (!(size < size_[n])) return;
    size_[n] = size;
    through[n] = face;
    heap.push(size, node);
  };
  while (!heap.empty()) {
    const MinHeap::Entry entry = heap.pop();
    const double size = entry.first;
    const auto n = static_cast<std::size_t>(entry.second);
    if (size > size_[n]) continue;
    for (const auto& [neighbor, length] : neighbors_[n]) relax(neighbor, size + gradation * length, kNone);
    for (const std::int32_t face : faces_[n]) {
      // What came straight through a face has reached all of that face already.
      if (face == through[n]) continue;
      grids[static_cast<std::size_t>(face)].forEachNear(position_[n], [&](std::int32_t other) {
        const double way = distance(position_[n], position_[static_cast<std::size_t>(other)]);
        relax(other, size + gradation * way, face);
      });
    }
  }
}

/// Integral of 1 / h^2 by samples: one for each piece of about half an element of the base size.
double SampleGraph::countOnFace(const TriangleMesh& mesh, const BrepFace& face, const Cones& cones) const {
  const double sampleArea = 0.5 * base_ * base_;
  double sum = 0.0;
  const auto addSample = [&](const Vec3& p, double area) {
    const double h = cones.at(p, base_);
    sum += area / (h * h);
  };
  double pending = 0.0;  // Area of small triangles that no sample stands for yet.
  std::vector<Piece> open;
  for (const std::int32_t t : face.triangles) {
    Piece whole{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t v = mesh.triangles[static_cast<std::size_t>(t)][c];
      whole.corner[c] = mesh.positions[static_cast<std::size_t>(v)];
    }
    whole.area = areaOf(whole.corner);
    open.assign(1, whole);
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      if (piece.area > sampleArea) {
        for (const Piece& half : halves(piece)) open.push_back(half);
        continue;
      }
      pending += piece.area;
      if (pending < 0.5 * sampleArea) continue;
      addSample((piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3.0, pending);
      pending = 0.0;
    }
  }
  return sum + pending / (base_ * base_);
}

/// The same where there are sizes inside the face: samples in pieces of about half an element of these.
double SampleGraph::countUnder(const InnerSizes& inner, std::size_t face, const Cones& cones) const {
  double sum = 0.0;
  std::vector<Piece> open;
  for (std::size_t t = inner.firstOfFace[face]; t < inner.firstOfFace[face + 1]; ++t) {
    Piece whole{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(inner.triangles[t][c]);
      whole.corner[c] = inner.positions[v];
      whole.size[c] = inner.value[v];
    }
    whole.area = areaOf(whole.corner);
    open.assign(1, whole);
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      const double smallest = *std::min_element(piece.size.begin(), piece.size.end());
      if (piece.area > 0.5 * smallest * smallest) {
        for (const Piece& half : halves(piece)) open.push_back(half);
        continue;
      }
      const Vec3 middle = (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3.0;
      const double h = cones.at(middle, (piece.size[0] + piece.size[1] + piece.size[2]) / 3.0);
      sum += piece.area / (h * h);
    }
  }
  return sum;
}

namespace {

double leastElements(const BrepFace& face, const std::vector<double>& divisions) {
  double outline = 0.0;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) outline += divisions[static_cast<std::size_t>(coedge.edge)];
  }
  return fewestQuads(outline, 2.0 - static_cast<double>(face.loops.size()));
}

}  // namespace

double SampleGraph::count(const TriangleMesh& mesh, const Brep& brep, const InnerSizes& inner, double gradation,
                          const std::vector<double>& divisions) const {
  double sum = 0.0;
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    std::vector<std::int32_t> tips;
    for (const std::int32_t n : ofFace_[f]) {
      const auto node = static_cast<std::size_t>(n);
      if (size_[node] < highest_[node]) tips.push_back(n);
    }
    double count = 0.0;
    if (!inner.empty()) {
      count = countUnder(inner, f, Cones(*this, tips, gradation));
    } else if (tips.empty()) {
      count = brep.faces[f].area / (base_ * base_);
    } else {
      count = countOnFace(mesh, brep.faces[f], Cones(*this, tips, gradation));
    }
    sum += std::max(count, leastElements(brep.faces[f], divisions));
  }
  return sum;
}

void SampleGraph::store(EdgeSamples& samples, std::vector<SizeLimit>& limits) const {
  for (std::size_t i = 0; i < limits.size(); ++i) limits[i].size = size_[firstLimit_ + i];
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    for (std::size_t i = 0; i < samples.sizes[e].value.size(); ++i) {
      samples.sizes[e].value[i] = size_[static_cast<std::size_t>(ofEdge_[e][i])];
    }
  }
}

}  // namespace qmcf
