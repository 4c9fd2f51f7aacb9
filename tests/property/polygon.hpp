#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/random.hpp"

namespace qmcf::property {

/// A point of the plane.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A region of the plane within about the unit circle: its outer loop counter-clockwise, holes clockwise.
struct Polygon {
  std::vector<std::vector<Point>> loops;
};

/// A random polygon: concave ones with spikes, combs with narrow necks, smooth blobs, crescents that end in cusps,
/// rings that are all but closed, some with holes that come close to other loops. Loops neither cross nor touch.
Polygon randomPolygon(Random& random);

/// Triangles on the points of all loops, numbered one after the other; without further points, so mostly needles. Empty
/// if rounding errors defeat it.
std::vector<std::array<std::int32_t, 3>> triangulate(const Polygon& polygon);

/// A whole number in [low, high].
int pick(Random& random, int low, int high);
/// Between low and high, all orders of magnitude alike. \pre 0 < low <= high
double pickLogarithmic(Random& random, double low, double high);

}  // namespace qmcf::property
