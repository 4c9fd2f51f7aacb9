#include "size_conformity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "qmcf/base/math.hpp"
#include "qmcf/spatial/surface_tree.hpp"

namespace qmcf {
namespace {

/// An edge of the mesh by its ends, and the face of the first element on it.
struct MeasuredEdge {
  std::array<std::int32_t, 2> ends{};
  std::int32_t face = kNone;
};

/// Each edge once, ordered by face as the elements are.
std::vector<MeasuredEdge> edgesOf(const QuadMesh& mesh) {
  // Per vertex, the larger ends of its edges so far, at most one for each use of an edge.
  std::vector<std::size_t> first(mesh.positions.size() + 1, 0);
  const auto forEachSide = [&mesh](auto visit) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const Element& element = mesh.elements[e];
      const std::size_t corners = cornerCount(element);
      for (std::size_t c = 0; c < corners; ++c) visit(e, std::minmax(element[c], element[(c + 1) % corners]));
    }
  };
  forEachSide([&](std::size_t, const auto& ends) { ++first[static_cast<std::size_t>(ends.first) + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::int32_t> larger(first.back());
  std::vector<std::size_t> count(mesh.positions.size(), 0);
  std::vector<MeasuredEdge> edges;
  edges.reserve(larger.size());
  forEachSide([&](std::size_t e, const auto& ends) {
    const auto v = static_cast<std::size_t>(ends.first);
    const auto begin = larger.begin() + static_cast<std::ptrdiff_t>(first[v]);
    const auto end = begin + static_cast<std::ptrdiff_t>(count[v]);
    if (std::find(begin, end, ends.second) != end) return;
    *end = ends.second;
    ++count[v];
    edges.push_back({{ends.first, ends.second}, mesh.elementFace[e]});
  });
  return edges;
}

/// The size of a patch at the point of it that is closest.
class PatchSizes {
 public:
  explicit PatchSizes(const Patch& patch) : patch_(patch), tree_(surfaceTree(patch.surface)) {}

  /// Fast where points that follow each other are near each other.
  [[nodiscard]] double at(const Vec3& p) {
    const ClosestPoint near = tree_.closest(p, last_);
    last_ = near.triangle;
    const std::array<VertexId, 3> corners = patch_.surface.corners(TriangleId(near.triangle));
    double size = 0.0;
    for (std::size_t c = 0; c < 3; ++c) size += near.barycentric[c] * patch_.size[corners[c]];
    return size;
  }

 private:
  const Patch& patch_;
  TriangleBvh tree_;
  std::int32_t last_ = -1;
};

std::vector<Vec3> middlesOf(const QuadMesh& mesh, const std::vector<MeasuredEdge>& edges) {
  std::vector<Vec3> middles;
  middles.reserve(edges.size());
  for (const MeasuredEdge& edge : edges) {
    const auto end = [&](std::size_t i) -> const Vec3& {
      return mesh.positions[static_cast<std::size_t>(edge.ends[i])];
    };
    middles.push_back((end(0) + end(1)) * 0.5);
  }
  return middles;
}

/// What has a value per vertex of the mesh, at the points of it that are closest to some. Fast where points that follow
/// each other are near each other.
std::vector<double> valuesAt(const std::vector<Vec3>& points, const TriangleMesh& mesh,
                             const std::vector<double>& value) {
  const TriangleBvh tree(mesh.positions, mesh.triangles);
  std::vector<double> result;
  result.reserve(points.size());
  std::int32_t last = -1;
  for (const Vec3& p : points) {
    const ClosestPoint near = tree.closest(p, last);
    last = near.triangle;
    const auto& corners = mesh.triangles[static_cast<std::size_t>(near.triangle)];
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) sum += near.barycentric[c] * value[static_cast<std::size_t>(corners[c])];
    result.push_back(sum);
  }
  return result;
}

/// One field in units of another at each point.
std::vector<double> ratios(const std::vector<Vec3>& points, const TriangleMesh& repaired, const SizeField& field,
                           const SizeField& unit) {
  std::vector<double> ratio = field.value;
  for (std::size_t v = 0; v < ratio.size(); ++v) ratio[v] /= unit.value[v];
  return valuesAt(points, repaired, ratio);
}

}  // namespace

SizeConformity sizeConformity(const QuadMesh& mesh, const TriangleMesh& repaired, const PreparedFaces& prepared,
                              const SizeField* asked, double coarsening) {
  const std::vector<MeasuredEdge> edges = edgesOf(mesh);
  const std::vector<double> change =
      asked == nullptr ? std::vector<double>{} : ratios(middlesOf(mesh, edges), repaired, *asked, prepared.size);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < edges.size();) {
    const std::int32_t face = edges[i].face;
    PatchSizes sizes(prepared.patches[static_cast<std::size_t>(face)]);
    for (; i < edges.size() && edges[i].face == face; ++i) {
      const Vec3& a = mesh.positions[static_cast<std::size_t>(edges[i].ends[0])];
      const Vec3& b = mesh.positions[static_cast<std::size_t>(edges[i].ends[1])];
      const double size = sizes.at((a + b) * 0.5) * (change.empty() ? 1.0 : change[i]);
      lengths.push_back(distance(a, b) * coarsening / size);
    }
  }
  SizeConformity result;
  if (lengths.empty()) return result;
  std::sort(lengths.begin(), lengths.end());
  const auto count = static_cast<double>(lengths.size());
  constexpr double kSqrt2 = 1.4142135623730951;
  for (const double length : lengths) {
    result.meanAbsLog2 += std::fabs(math::log2(length)) / count;
    result.withinSqrt2 += length * kSqrt2 >= 1.0 && length <= kSqrt2 ? 1.0 / count : 0.0;
  }
  const auto percentile = [&](double share) { return lengths[static_cast<std::size_t>(share * (count - 1.0))]; };
  result.p5 = percentile(0.05);
  result.median = percentile(0.5);
  result.p95 = percentile(0.95);
  return result;
}

std::vector<double> sizesAt(const std::vector<Vec3>& points, const TriangleMesh& repaired, const SizeField& size,
                            double coarsening) {
  std::vector<double> sizes = valuesAt(points, repaired, size.value);
  for (double& h : sizes) h /= coarsening;
  return sizes;
}

std::vector<double> settledSizesAt(const std::vector<Vec3>& points, const TriangleMesh& repaired,
                                   const PreparedFaces& prepared, const SizeField* asked, double coarsening) {
  TriangleMesh all;
  std::vector<double> sizes;
  for (const Patch& patch : prepared.patches) {
    const auto first = static_cast<std::int32_t>(all.positions.size());
    for (const VertexId v : patch.surface.vertices()) {
      all.positions.push_back(patch.surface.position(v));
      sizes.push_back(patch.size[v] / coarsening);
    }
    for (const TriangleId t : patch.surface.triangles()) {
      const std::array<VertexId, 3> corners = patch.surface.corners(t);
      all.triangles.push_back({first + corners[0].value, first + corners[1].value, first + corners[2].value});
    }
  }
  std::vector<double> result = valuesAt(points, all, sizes);
  if (asked == nullptr) return result;
  const std::vector<double> change = ratios(points, repaired, *asked, prepared.size);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] *= change[i];
  return result;
}

SizingMesh sizingMeshOf(const TriangleMesh& repaired, const PreparedFaces& prepared, const SizeField* asked,
                        double coarsening) {
  SizingMesh sizing;
  QuadMesh& mesh = sizing.triangles;
  std::vector<double> logs;
  std::vector<double> count;
  std::vector<std::int32_t> vertexOfNode(prepared.divided.nodes.size(), kNone);
  for (const Patch& patch : prepared.patches) {
    IdMap<VertexId, std::int32_t> vertex;
    for (const VertexId v : patch.surface.vertices()) {
      const std::int32_t node = patch.node[v];
      std::int32_t id = node == kNone ? kNone : vertexOfNode[static_cast<std::size_t>(node)];
      if (id == kNone) {
        id = static_cast<std::int32_t>(mesh.positions.size());
        mesh.positions.push_back(patch.surface.position(v));
        logs.push_back(0.0);
        count.push_back(0.0);
        if (node != kNone) vertexOfNode[static_cast<std::size_t>(node)] = id;
      }
      logs[static_cast<std::size_t>(id)] += math::log(patch.size[v] / coarsening);
      count[static_cast<std::size_t>(id)] += 1.0;
      vertex.push_back(id);
    }
    for (const TriangleId t : patch.surface.triangles()) {
      const std::array<VertexId, 3> corners = patch.surface.corners(t);
      mesh.elements.push_back({vertex[corners[0]], vertex[corners[1]], vertex[corners[2]], kNone});
      mesh.elementFace.push_back(patch.face);
    }
  }
  for (std::size_t v = 0; v < logs.size(); ++v) sizing.size.push_back(math::exp(logs[v] / count[v]));
  if (asked == nullptr) return sizing;
  const std::vector<double> change = ratios(mesh.positions, repaired, *asked, prepared.size);
  for (std::size_t v = 0; v < change.size(); ++v) sizing.size[v] *= change[v];
  return sizing;
}

}  // namespace qmcf
