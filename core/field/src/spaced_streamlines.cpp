// After Jobard and Lefer, "Creating evenly-spaced streamlines of arbitrary density", 1997, with the triangles of the
// patch as the grid that finds neighbours.
#include "qmcf/field/spaced_streamlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace qmcf {
namespace {

constexpr double kParallel = 0.7;  // least cosine of two lines of the same family

/// Part of a line inside one triangle.
struct Piece {
  Vec3 from;
  Vec3 to;
  Vec3 direction;
};

double distanceToPiece(const Vec3& p, const Piece& piece) {
  const Vec3 along = piece.to - piece.from;
  const double square = squaredNorm(along);
  const double f = square > 0.0 ? std::clamp(dot(p - piece.from, along) / square, 0.0, 1.0) : 0.0;
  return distance(p, piece.from + along * f);
}

class Covering {
 public:
  Covering(const Patch& patch, const CrossField& field, const SpacedStreamlinesOptions& options)
      : patch_(patch),
        surface_(patch.surface),
        field_(field),
        options_(options),
        pieces_(patch.surface.triangleCount()),
        visited_(patch.surface.triangleCount(), 0) {}

  std::vector<Streamline> cover() {
    std::vector<Streamline> lines;
    for (const TriangleId t : surface_.triangles()) {
      const SurfacePoint seed{t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
      if (crossConfidence(field_, seed) < options_.leastConfidence) continue;
      const std::array<Vec3, 4> directions = crossDirections(surface_, field_, seed);
      for (std::size_t family = 0; family < 2; ++family) {
        if (occupied(positionOf(surface_, seed), t, directions[family], spacingAt(t))) continue;
        Streamline line = trace(seed, directions[family]);
        if (line.length < options_.shortest * spacingAt(t)) continue;
        store(line);
        lines.push_back(std::move(line));
      }
    }
    return lines;
  }

 private:
  [[nodiscard]] double spacingAt(TriangleId t) const {
    double sum = 0.0;
    for (const VertexId v : surface_.corners(t)) sum += patch_.size[v] / 3.0;
    return options_.spacing * sum;
  }

  /// Whether a line of nearly the same direction passes within the radius.
  bool occupied(const Vec3& p, TriangleId start, const Vec3& direction, double radius) {
    ++stamp_;
    std::vector<TriangleId> stack{start};
    visited_[start] = stamp_;
    while (!stack.empty()) {
      const TriangleId t = stack.back();
      stack.pop_back();
      for (const Piece& piece : pieces_[t]) {
        if (std::fabs(dot(piece.direction, direction)) > kParallel && distanceToPiece(p, piece) < radius) return true;
      }
      for (int c = 0; c < 3; ++c) {
        const HalfedgeId h = Surface::halfedge(t, c);
        const HalfedgeId back = surface_.twin(h);
        if (!back.valid() || visited_[Surface::triangle(back)] == stamp_) continue;
        const Vec3 a = surface_.position(surface_.origin(h));
        const Vec3 b = surface_.position(surface_.target(h));
        if (distanceToPiece(p, {a, b, {}}) > radius) continue;
        visited_[Surface::triangle(back)] = stamp_;
        stack.push_back(Surface::triangle(back));
      }
    }
    return false;
  }

  /// The first points of a line up to where another line, or its own beginning, is too near.
  void shorten(Streamline& line) {
    const Vec3 start = positionOf(surface_, line.points.front());
    Vec3 last = start;
    double length = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const SurfacePoint& point = line.points[i];
      const Vec3 p = positionOf(surface_, point);
      const double closest = options_.closest * spacingAt(point.triangle);
      const Vec3 direction = normalized(p - last);
      const bool around = length > 4.0 * closest && distance(p, start) < closest;
      if (around || occupied(p, point.triangle, direction, closest)) {
        line.points.resize(i + (around ? 1 : 0));
        line.length = length;
        line.end = StreamlineEnd::length;
        return;
      }
      length += distance(p, last);
      last = p;
    }
  }

  Streamline trace(const SurfacePoint& seed, const Vec3& direction) {
    StreamlineOptions options;
    options.leastConfidence = options_.leastConfidence;
    options.steps = options_.mostTriangles;
    Streamline forwards = traceStreamline(surface_, field_, seed, direction, options);
    shorten(forwards);
    const bool closed = forwards.points.size() > 2 && forwards.end == StreamlineEnd::length &&
                        distance(positionOf(surface_, forwards.points.back()), positionOf(surface_, seed)) <
                            options_.closest * spacingAt(seed.triangle);
    if (closed) return forwards;
    Streamline line = traceStreamline(surface_, field_, seed, direction * -1.0, options);
    shorten(line);
    std::reverse(line.points.begin(), line.points.end());
    line.points.insert(line.points.end(), forwards.points.begin() + 1, forwards.points.end());
    line.length += forwards.length;
    line.end = forwards.end;
    return line;
  }

  void store(const Streamline& line) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Vec3 from = positionOf(surface_, line.points[i - 1]);
      const Vec3 to = positionOf(surface_, line.points[i]);
      const Piece piece{from, to, normalized(to - from)};
      pieces_[line.points[i - 1].triangle].push_back(piece);
      if (line.points[i].triangle != line.points[i - 1].triangle) pieces_[line.points[i].triangle].push_back(piece);
    }
  }

  const Patch& patch_;
  const Surface& surface_;
  const CrossField& field_;
  const SpacedStreamlinesOptions& options_;
  IdMap<TriangleId, std::vector<Piece>> pieces_;
  IdMap<TriangleId, std::uint32_t> visited_;
  std::uint32_t stamp_ = 0;
};

}  // namespace

std::vector<Streamline> spacedStreamlines(const Patch& patch, const CrossField& field,
                                          const SpacedStreamlinesOptions& options) {
  return Covering(patch, field, options).cover();
}

}  // namespace qmcf
