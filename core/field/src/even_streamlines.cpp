// Evenly spaced streamlines: B. Jobard, W. Lefer, Creating evenly-spaced streamlines of arbitrary density, 1997.
#include "qmcf/field/even_streamlines.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "qmcf/field/streamline.hpp"

namespace qmcf {
namespace {

constexpr double kSampling = 0.2;      // distance of a line's samples, in spacings
constexpr double kNearest = 0.5;       // distance at which a line gives way to another, in spacings
constexpr double kOwnDistance = 2.0;   // arc length from which a line gives way to itself, in spacings
constexpr double kLongest = 40.0;      // of a line on either side of its seed, in spacings; another goes on from there
constexpr double kShortest = 1e-3;     // length of a segment, in spacings
constexpr double kSameFamily = 0.707;  // cosine of the angle up to which lines run the same way

/// A sample of a line that is drawn already.
struct LineSample {
  Vec3 point;
  Vec3 direction;
  std::int32_t line = 0;
  double arc = 0.0;  ///< From the line's seed, negative backwards.
};

/// The samples of all lines, in cells as wide as the spacing.
class LineSamples {
 public:
  explicit LineSamples(double spacing) : spacing_(spacing) {}

  void add(const LineSample& sample) { cells_[cellOf(sample.point)].push_back(sample); }

  /// Whether a line that runs the same way passes nearer than `reach`, at most the spacing.
  [[nodiscard]] bool blocked(const LineSample& at, double reach) const {
    const Cell centre = cellOf(at.point);
    for (std::int64_t x = centre[0] - 1; x <= centre[0] + 1; ++x) {
      for (std::int64_t y = centre[1] - 1; y <= centre[1] + 1; ++y) {
        for (std::int64_t z = centre[2] - 1; z <= centre[2] + 1; ++z) {
          const auto cell = cells_.find({x, y, z});
          if (cell == cells_.end()) continue;
          for (const LineSample& other : cell->second) {
            if (inTheWay(at, other, reach)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell cellOf(const Vec3& p) const {
    const auto along = [this](double v) { return static_cast<std::int64_t>(std::floor(v / spacing_)); };
    return {along(p.x), along(p.y), along(p.z)};
  }
  [[nodiscard]] bool inTheWay(const LineSample& at, const LineSample& other, double reach) const {
    const bool isOther = other.line != at.line || std::fabs(other.arc - at.arc) > kOwnDistance * spacing_;
    return isOther && std::fabs(dot(other.direction, at.direction)) > kSameFamily &&
           squaredNorm(other.point - at.point) < reach * reach;
  }

  double spacing_;
  std::map<Cell, std::vector<LineSample>> cells_;
};

class StreamlineDrawing {
 public:
  StreamlineDrawing(const Patch& patch, const CrossField& field, double spacing)
      : patch_(patch), field_(field), spacing_(spacing), samples_(spacing) {}

  std::vector<std::vector<Vec3>> draw() {
    for (const VertexId v : patch_.surface.vertices()) {
      const HalfedgeId h = patch_.surface.outgoing(v);
      if (!h.valid()) continue;
      SurfacePoint seed{Surface::triangle(h), {0.0, 0.0, 0.0}};
      seed.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0;
      const auto directions = crossDirections(patch_.surface, field_, seed);
      for (const std::size_t axis : {0U, 1U}) drawFrom(seed, directions[axis]);
    }
    return std::move(lines_);
  }

 private:
  void drawFrom(const SurfacePoint& seed, const Vec3& direction) {
    const auto id = static_cast<std::int32_t>(lines_.size());
    const Vec3 start = positionOf(patch_.surface, seed);
    if (samples_.blocked({start, direction, id, 0.0}, spacing_)) return;
    std::vector<Vec3> line = follow(seed, direction * -1.0, id, -1.0);
    line = {line.rbegin(), line.rend()};
    line.push_back(start);
    samples_.add({start, direction, id, 0.0});
    const std::vector<Vec3> ahead = follow(seed, direction, id, 1.0);
    line.insert(line.end(), ahead.begin(), ahead.end());
    if (line.size() > 1) lines_.push_back(std::move(line));
  }

  /// The line's points behind the seed, up to where it has to end; its samples are added.
  std::vector<Vec3> follow(const SurfacePoint& seed, const Vec3& direction, std::int32_t id, double sign) {
    const Streamline traced = traceStreamline(patch_.surface, field_, seed, direction, {.length = kLongest * spacing_});
    std::vector<Vec3> points;
    Vec3 from = positionOf(patch_.surface, seed);
    double arc = 0.0;
    double nextSample = kSampling * spacing_;
    for (std::size_t i = 1; i < traced.points.size(); ++i) {
      const Vec3 to = positionOf(patch_.surface, traced.points[i]);
      const double length = distance(from, to);
      if (length < kShortest * spacing_) continue;  // Where it passes by a vertex the direction is mere rounding.
      const Vec3 along = (to - from) * (1.0 / length);
      while (nextSample <= arc + length) {
        const LineSample sample{from + along * (nextSample - arc), along, id, sign * nextSample};
        if (samples_.blocked(sample, kNearest * spacing_)) {
          points.push_back(sample.point);
          return points;
        }
        samples_.add(sample);
        nextSample += kSampling * spacing_;
      }
      points.push_back(to);
      arc += length;
      from = to;
    }
    return points;
  }

  const Patch& patch_;
  const CrossField& field_;
  double spacing_;
  LineSamples samples_;
  std::vector<std::vector<Vec3>> lines_;
};

}  // namespace

std::vector<std::vector<Vec3>> evenStreamlines(const Patch& patch, const CrossField& field, double spacing) {
  return StreamlineDrawing(patch, field, spacing).draw();
}

}  // namespace qmcf
