#include "part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "polygon.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf::property {
namespace {

std::size_t countPoints(const Polygon& polygon) {
  std::size_t count = 0;
  for (const auto& loop : polygon.loops) count += loop.size();
  return count;
}

std::int32_t number(std::size_t i) { return static_cast<std::int32_t>(i); }

/// A layer of points is followed by the next one; `stride` points each.
void addSides(TriangleMesh& mesh, const Polygon& polygon, std::size_t from, std::size_t to, bool swapDiagonal) {
  std::size_t first = 0;
  for (const auto& loop : polygon.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const std::int32_t a = number(from + first + i);
      const std::int32_t b = number(from + first + j);
      const std::int32_t c = number(to + first + j);
      const std::int32_t d = number(to + first + i);
      if (swapDiagonal) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
    first += loop.size();
  }
}

void addCap(TriangleMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles, std::size_t first,
            bool turned) {
  for (const auto& t : triangles) {
    const std::int32_t shift = number(first);
    mesh.triangles.push_back({t[0] + shift, t[turned ? 2 : 1] + shift, t[turned ? 1 : 2] + shift});
  }
}

template <class Place>
void addLayer(TriangleMesh& mesh, const Polygon& polygon, Place place) {
  for (const auto& loop : polygon.loops) {
    for (const Point& p : loop) mesh.positions.push_back(place(p));
  }
}

void makeSheet(Case& made, const Polygon& polygon, const std::vector<std::array<std::int32_t, 3>>& triangles) {
  made.name = "sheet";
  addLayer(made.part, polygon, [](const Point& p) { return Vec3{p.x, p.y, 0.0}; });
  addCap(made.part, triangles, 0, false);
  made.boundaryLoops = static_cast<std::int64_t>(polygon.loops.size());
  made.eulerCharacteristic = 2 - made.boundaryLoops;
}

void makeExtrusion(Case& made, const Polygon& polygon, const std::vector<std::array<std::int32_t, 3>>& triangles,
                   Random& random) {
  made.name = "extrusion";
  const double height = pickLogarithmic(random, 0.02, 3.0);
  const std::size_t count = countPoints(polygon);
  const int layers = pick(random, 1, 3);
  for (int layer = 0; layer <= layers; ++layer) {
    const double z = height * layer / layers;
    addLayer(made.part, polygon, [z](const Point& p) { return Vec3{p.x, p.y, z}; });
  }
  addCap(made.part, triangles, 0, true);
  for (int layer = 0; layer < layers; ++layer) {
    const auto from = static_cast<std::size_t>(layer) * count;
    addSides(made.part, polygon, from, from + count, layer % 2 == 1);
  }
  addCap(made.part, triangles, static_cast<std::size_t>(layers) * count, false);
  made.eulerCharacteristic = 4 - 2 * static_cast<std::int64_t>(polygon.loops.size());
}

/// The polygon's x becomes the radius, its y the height.
void makeRevolution(Case& made, const Polygon& polygon, const std::vector<std::array<std::int32_t, 3>>& triangles,
                    Random& random) {
  const bool whole = pick(random, 0, 1) == 1;
  made.name = whole ? "full revolution" : "partial revolution";
  const double offset = random.uniform(1.1, 3.0);
  const double sweep = whole ? 2.0 * math::kPi : random.uniform(0.3, 5.5);
  const int steps =
      std::max(3, static_cast<int>(static_cast<double>(pick(random, 16, 48)) * sweep / (2.0 * math::kPi)));
  const std::size_t count = countPoints(polygon);
  for (int step = 0; step < steps + (whole ? 0 : 1); ++step) {
    const double angle = sweep * step / steps;
    const double c = math::cos(angle);
    const double s = math::sin(angle);
    addLayer(made.part, polygon, [=](const Point& p) { return Vec3{(offset + p.x) * c, (offset + p.x) * s, p.y}; });
  }
  for (int step = 0; step < steps; ++step) {
    const auto from = static_cast<std::size_t>(step) * count;
    const std::size_t to = whole && step + 1 == steps ? 0 : from + count;
    addSides(made.part, polygon, to, from, step % 2 == 1);
  }
  if (whole) {
    // Each loop sweeps a torus of its own: the outside and the cavities.
    made.components = static_cast<std::int64_t>(polygon.loops.size());
    return;
  }
  addCap(made.part, triangles, 0, false);
  addCap(made.part, triangles, static_cast<std::size_t>(steps) * count, true);
  made.eulerCharacteristic = 4 - 2 * static_cast<std::int64_t>(polygon.loops.size());
}

/// A random profile turned round an axis that it starts and ends on.
void makeVase(Case& made, Random& random) {
  made.name = "vase";
  const int rings = pick(random, 1, 12);
  const int steps = pick(random, 16, 48);
  TriangleMesh& mesh = made.part;
  mesh.positions.push_back({0.0, 0.0, 0.0});
  double z = 0.0;
  const double roughness = random.uniform(0.0, 0.45);
  for (int ring = 0; ring < rings; ++ring) {
    z += pickLogarithmic(random, 0.05, 0.5);
    const double radius = 0.5 + random.uniform(-roughness, roughness);
    for (int step = 0; step < steps; ++step) {
      const double angle = 2.0 * math::kPi * step / steps;
      mesh.positions.push_back({radius * math::cos(angle), radius * math::sin(angle), z});
    }
  }
  mesh.positions.push_back({0.0, 0.0, z + random.uniform(-0.02, 0.5)});
  const auto at = [steps](int ring, int step) { return 1 + ring * steps + step % steps; };
  for (int step = 0; step < steps; ++step) {
    mesh.triangles.push_back({0, at(0, step + 1), at(0, step)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, step), at(ring, step + 1), at(ring + 1, step + 1)});
      mesh.triangles.push_back({at(ring, step), at(ring + 1, step + 1), at(ring + 1, step)});
    }
    mesh.triangles.push_back({at(rings - 1, step), at(rings - 1, step + 1), at(rings, 0)});
  }
  made.eulerCharacteristic = 2;
}

void placeAnywhere(TriangleMesh& mesh, Random& random) {
  const double scale = pickLogarithmic(random, 1e-3, 1e3);
  const double yaw = random.uniform(0.0, 2.0 * math::kPi);
  const double pitch = pick(random, 0, 1) * random.uniform(0.0, math::kPi);
  const Vec3 shift{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
  for (Vec3& p : mesh.positions) {
    const Vec3 q{p.x * math::cos(yaw) - p.y * math::sin(yaw), p.x * math::sin(yaw) + p.y * math::cos(yaw), p.z};
    const Vec3 r{q.x, q.y * math::cos(pitch) - q.z * math::sin(pitch), q.y * math::sin(pitch) + q.z * math::cos(pitch)};
    p = (r + shift) * scale;
  }
}

double diagonalOf(const TriangleMesh& mesh) {
  Vec3 low = mesh.positions[0];
  Vec3 high = low;
  for (const Vec3& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return distance(low, high);
}

}  // namespace

Case makeCase(std::uint64_t seed, const Limits& limits) {
  Random random(seed);
  Case made;
  Polygon polygon;
  std::vector<std::array<std::int32_t, 3>> triangles;
  while (triangles.empty()) {
    polygon = randomPolygon(random);
    triangles = triangulate(polygon);
  }
  switch (pick(random, 0, 6)) {
    case 0:
    case 1:
      makeSheet(made, polygon, triangles);
      break;
    case 2:
    case 3:
      makeExtrusion(made, polygon, triangles, random);
      break;
    case 4:
    case 5:
      makeRevolution(made, polygon, triangles, random);
      break;
    default:
      makeVase(made, random);
  }
  placeAnywhere(made.part, random);
  made.options.size = diagonalOf(made.part) * limits.smallest * pickLogarithmic(random, 1.0, limits.sizeRange);
  made.options.mode = pick(random, 0, 2) == 0 ? Mode::qmorph : Mode::qmcf;
  made.options.allQuad = pick(random, 0, 3) == 0;
  const double size = *made.options.size;
  if (pick(random, 0, 3) == 0) made.options.curvature = size * pickLogarithmic(random, 1e-3, 0.3);
  if (pick(random, 0, 3) == 0) {
    for (std::size_t v = 0; v < made.part.positions.size(); ++v) {
      made.options.sizes.push_back(size * pickLogarithmic(random, 0.3, 3.0));
    }
  }
  made.options.fitSizes = made.options.mode == Mode::qmcf && pick(random, 0, 3) == 0;
  return made;
}

}  // namespace qmcf::property
