#include "inner_sources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curvature_sizes.hpp"
#include "mesh_gradation.hpp"

namespace qmcf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// In units of the base size: how small curvature may make an element.
constexpr double kLowestByCurvature = 0.1;
/// A triangle is cut when by itself it would take elements so much larger than its corners ask for, and while its
/// longest side is more than so many of these.
constexpr double kFlatter = 1.5;
constexpr double kLongest = 2.0;
/// With a scale, the longest side of a triangle in units of the scale's.
constexpr double kLongestInScale = 2.0;

std::pair<std::int32_t, std::int32_t> ascending(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

InnerSources::InnerSources(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options, double lowestBase)
    : lowestBase_(lowestBase), longest_(kInfinity), vertexCount_(mesh.positions.size()) {
  if (options.vertexSize.empty() && !options.curvature && options.scale == nullptr) return;
  sizes_.positions = mesh.positions;
  given_ = options.vertexSize;
  given_.resize(vertexCount_, kInfinity);
  std::vector<double> own(mesh.triangles.size(), kInfinity);
  curved_.assign(vertexCount_, kInfinity);
  if (options.curvature) {
    CurvatureSizes curvature = curvatureSizes(mesh, brep, *options.curvature);
    curved_ = std::move(curvature.vertex);
    own = std::move(curvature.triangle);
  }
  if (options.scale != nullptr) longest_ = kLongestInScale * options.scale->spacing();
  appendFaces(mesh, brep, own);
  factor_.assign(sizes_.positions.size(), 1.0);
  if (options.scale != nullptr) applyScale(*options.scale);
}

/// On an edge of the B-rep the faces' scales agree.
void InnerSources::applyScale(const SizeScale& scale) {
  std::vector<char> done(factor_.size(), 0);
  for (std::size_t f = 0; f + 1 < sizes_.firstOfFace.size(); ++f) {
    for (std::size_t t = sizes_.firstOfFace[f]; t < sizes_.firstOfFace[f + 1]; ++t) {
      for (const std::int32_t corner : sizes_.triangles[t]) {
        const auto v = static_cast<std::size_t>(corner);
        if (std::exchange(done[v], 1) == 0) factor_[v] = scale.at(static_cast<std::int32_t>(f), sizes_.positions[v]);
      }
    }
  }
}

double InnerSources::fromCurvature(std::size_t v, double base) const {
  return std::max(curved_[v], kLowestByCurvature * base);
}

double InnerSources::length(std::int32_t a, std::int32_t b) const {
  return distance(sizes_.positions[static_cast<std::size_t>(a)], sizes_.positions[static_cast<std::size_t>(b)]);
}

std::size_t InnerSources::longestSide(const std::array<std::int32_t, 3>& corner) const {
  std::size_t longest = 0;
  for (std::size_t c = 1; c < 3; ++c) {
    if (length(corner[c], corner[(c + 1) % 3]) > length(corner[longest], corner[(longest + 1) % 3])) longest = c;
  }
  return longest;
}

bool InnerSources::isRough(const std::array<std::int32_t, 3>& corner, double own) const {
  const std::size_t side = longestSide(corner);
  const double longest = length(corner[side], corner[(side + 1) % 3]);
  if (longest > longest_) return true;
  double smallest = lowestBase_;
  for (const std::int32_t v : corner) {
    smallest = std::min(smallest, fromCurvature(static_cast<std::size_t>(v), lowestBase_));
  }
  if (!(std::min(own, lowestBase_) > kFlatter * smallest)) return false;
  return longest > kLongest * smallest;
}

std::int32_t InnerSources::middle(std::int32_t a, std::int32_t b, double beside) {
  const auto [place, isNew] = middle_.try_emplace(ascending(a, b), static_cast<std::int32_t>(sizes_.positions.size()));
  if (isNew) {
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    sizes_.positions.push_back((sizes_.positions[i] + sizes_.positions[j]) * 0.5);
    given_.push_back(0.5 * (given_[i] + given_[j]));
    curved_.push_back(std::max(beside, std::min(curved_[i], curved_[j])));
  }
  return place->second;
}

void InnerSources::cut(Piece whole, double own) {
  std::vector<Piece> open{whole};
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    if (!isRough(piece.corner, own)) {
      sizes_.triangles.push_back(piece.corner);
      continue;
    }
    const std::size_t side = longestSide(piece.corner);
    const std::size_t after = (side + 1) % 3;
    const std::size_t before = (side + 2) % 3;
    const std::int32_t m = middle(piece.corner[side], piece.corner[after], piece.beside[side]);
    open.push_back({{piece.corner[side], m, piece.corner[before]}, {piece.beside[side], own, piece.beside[before]}});
    open.push_back({{m, piece.corner[after], piece.corner[before]}, {piece.beside[side], piece.beside[after], own}});
  }
}

void InnerSources::appendFaces(const TriangleMesh& mesh, const Brep& brep, const std::vector<double>& own) {
  // What the triangles beside an edge ask for themselves matters only where one of them will be cut.
  std::vector<Edge> edges;
  const auto forEachSide = [&](std::size_t t, auto visit) {
    const auto& corner = mesh.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) visit(c, ascending(corner[c], corner[(c + 1) % 3]));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (isRough(mesh.triangles[t], own[t])) forEachSide(t, [&](std::size_t, Edge edge) { edges.push_back(edge); });
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<double> beside(edges.size(), kInfinity);
  const auto find = [&](Edge edge) {
    const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
    return place != edges.end() && *place == edge ? &beside[static_cast<std::size_t>(place - edges.begin())] : nullptr;
  };
  for (std::size_t t = 0; t < mesh.triangles.size() && !edges.empty(); ++t) {
    forEachSide(t, [&](std::size_t, Edge edge) {
      if (double* const size = find(edge)) *size = std::min(*size, own[t]);
    });
  }
  sizes_.triangles.reserve(mesh.triangles.size());
  for (const BrepFace& face : brep.faces) {
    sizes_.firstOfFace.push_back(sizes_.triangles.size());
    for (const std::int32_t triangle : face.triangles) {
      const auto t = static_cast<std::size_t>(triangle);
      Piece whole{mesh.triangles[t], {}};
      forEachSide(t, [&](std::size_t c, Edge edge) {
        const double* const size = find(edge);
        whole.beside[c] = size != nullptr ? *size : own[t];
      });
      cut(whole, own[t]);
    }
  }
  sizes_.firstOfFace.push_back(sizes_.triangles.size());
}

InnerSizes InnerSources::sizes(double base, double gradation) const {
  InnerSizes sizes = sizes_;
  sizes.value.reserve(sizes.positions.size());
  for (std::size_t v = 0; v < sizes.positions.size(); ++v) {
    sizes.value.push_back(std::min({base * factor_[v], given_[v], fromCurvature(v, base)}));
  }
  MeshGradation(sizes.positions, sizes.triangles).grade(sizes.value, base, gradation);
  return sizes;
}

std::vector<EdgeSizes> InnerSources::alongEdges(const Brep& brep, const std::vector<EdgeCurve>& curves,
                                                const InnerSizes& sizes) const {
  struct Stretch {
    std::int32_t a;
    std::int32_t b;
    double from;
    double to;
  };
  std::vector<EdgeSizes> result(brep.edges.size());
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const std::vector<std::int32_t>& points = brep.edges[e].points;
    const std::vector<double>& arcLength = curves[e].arcLength;
    const auto append = [&](std::int32_t v, double s) {
      result[e].arcLength.push_back(s);
      result[e].value.push_back(sizes.value[static_cast<std::size_t>(v)]);
    };
    append(points.front(), 0.0);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      std::vector<Stretch> open{{points[i], points[i + 1], arcLength[i], arcLength[i + 1]}};
      while (!open.empty()) {
        const Stretch stretch = open.back();
        open.pop_back();
        const auto found = middle_.find(ascending(stretch.a, stretch.b));
        if (found == middle_.end()) {
          append(stretch.b, stretch.to);
          continue;
        }
        const double s = 0.5 * (stretch.from + stretch.to);
        open.push_back({found->second, stretch.b, s, stretch.to});
        open.push_back({stretch.a, found->second, stretch.from, s});
      }
    }
  }
  return result;
}

SizeSources InnerSources::counts(double base) const {
  SizeSources counts;
  if (empty()) return counts;
  for (std::size_t v = 0; v < vertexCount_; ++v) {
    const double curved = fromCurvature(v, base);
    if (std::min(given_[v], curved) >= base * factor_[v]) continue;
    ++(given_[v] <= curved ? counts.bySizes : counts.byCurvature);
    if (curved < given_[v] && curved > curved_[v]) ++counts.floored;
  }
  return counts;
}

}  // namespace qmcf
