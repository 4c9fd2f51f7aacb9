#include "field/patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace qmcf::testing {
namespace {

constexpr double kPi = std::numbers::pi;

double fanAngle(const Surface& surface, VertexId v) {
  double sum = 0.0;
  surface.forEachOutgoing(v, [&](HalfedgeId h) { sum += surface.angle(h); });
  return sum;
}

/// Numbers the chains of boundary half-edges between corners.
void nameEdges(Patch& patch) {
  const Surface& surface = patch.surface;
  std::int32_t edges = 0;
  for (const HalfedgeId loop : surface.boundaryLoops()) {
    HalfedgeId start = loop;
    for (HalfedgeId h = surface.nextBoundary(loop); h != loop && patch.cornerQuads[surface.origin(start)] == 2;
         h = surface.nextBoundary(h)) {
      start = h;
    }
    HalfedgeId h = start;
    do {
      patch.edge[h] = edges;
      h = surface.nextBoundary(h);
      if (patch.cornerQuads[surface.origin(h)] != 2 || h == start) ++edges;
    } while (h != start);
  }
}

}  // namespace

Patch makePatch(const std::vector<Vec3>& positions, const Corners& triangles, double size, double kink) {
  Result<Surface> built = Surface::build(positions, triangles);
  EXPECT_TRUE(built.ok()) << (built.ok() ? "" : built.error().message);
  Patch patch;
  patch.face = 0;
  patch.surface = std::move(built).value();
  const Surface& surface = patch.surface;
  patch.normal.resize(surface.vertexCount());
  for (const TriangleId t : surface.triangles()) {
    for (const VertexId v : surface.corners(t)) patch.normal[v] += surface.areaVector(t);
  }
  for (const VertexId v : surface.vertices()) patch.normal[v] = normalized(patch.normal[v]);
  patch.size.resize(surface.vertexCount(), size);
  patch.node.resize(surface.vertexCount(), kNone);
  patch.cornerQuads.resize(surface.vertexCount(), 0);
  patch.edge.resize(surface.halfedgeCount(), kNone);
  std::int32_t nodes = 0;
  for (const VertexId v : surface.vertices()) {
    if (!surface.isBoundary(v)) continue;
    patch.node[v] = nodes++;
    const double angle = fanAngle(surface, v);
    const bool straight = std::fabs(angle - kPi) < kink * kPi / 180.0;
    patch.cornerQuads[v] = straight ? 2 : std::clamp(static_cast<std::int32_t>(std::lround(2.0 * angle / kPi)), 1, 4);
  }
  nameEdges(patch);
  return patch;
}

Patch makeGrid(const Grid& grid, double size, double kink) {
  std::map<std::pair<int, int>, std::int32_t> number;
  std::vector<Vec3> positions;
  const auto vertex = [&](int i, int j) {
    const std::pair key{grid.closedX ? i % grid.nx : i, grid.closedY ? j % grid.ny : j};
    const auto [it, isNew] = number.try_emplace(key, static_cast<std::int32_t>(positions.size()));
    if (isNew) {
      positions.push_back(
          grid.map(static_cast<double>(key.first) / grid.nx, static_cast<double>(key.second) / grid.ny));
    }
    return it->second;
  };
  Corners triangles;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      if (grid.keep && !grid.keep((i + 0.5) / grid.nx, (j + 0.5) / grid.ny)) continue;
      const std::int32_t a = vertex(i, j);
      const std::int32_t b = vertex(i + 1, j);
      const std::int32_t c = vertex(i + 1, j + 1);
      const std::int32_t d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return makePatch(positions, triangles, size, kink);
}

Patch makeSquare(int cells) {
  return makeGrid({.nx = cells,
                   .ny = cells,
                   .map =
                       [](double x, double y) {
                         return Vec3{x, y, 0.0};
                       },
                   .keep = {}},
                  1.0 / cells);
}

Patch makeDisk(int rings) {
  std::vector<Vec3> positions{{0.0, 0.0, 0.0}};
  const auto node = [](int ring, int i) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
  Corners triangles;
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = kPi * i / (3.0 * ring);
      positions.push_back({std::cos(angle) * ring / rings, std::sin(angle) * ring / rings, 0.0});
    }
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < ring; ++i) {
        const std::int32_t inner = node(ring - 1, sector * (ring - 1) + i);
        const std::int32_t outer = node(ring, sector * ring + i);
        const std::int32_t next = node(ring, sector * ring + i + 1);
        triangles.push_back({inner, outer, next});
        if (i + 1 < ring) triangles.push_back({inner, next, node(ring - 1, sector * (ring - 1) + i + 1)});
      }
    }
  }
  return makePatch(positions, triangles, 1.0 / rings);
}

Patch makePolygonRing(int sides, int cells, int layers, bool roundHole) {
  const auto corner = [sides](int i) {
    const double angle = 2.0 * kPi * i / sides;
    return Vec3{std::cos(angle), std::sin(angle), 0.0};
  };
  const auto map = [=](double x, double y) {
    const double along = x * sides;
    const int side = std::min(static_cast<int>(std::floor(along + 1e-9)), sides - 1);
    const double f = along - side;
    const Vec3 outer = corner(side) * (1.0 - f) + corner(side + 1) * f;
    const Vec3 inner = (roundHole ? normalized(outer) : outer) * 0.5;
    return outer * (1.0 - y) + inner * y;
  };
  // x runs counter-clockwise and y inwards.
  return makeGrid({.nx = sides * cells, .ny = layers, .closedX = true, .map = map, .keep = {}},
                  2.0 * std::sin(kPi / sides) / cells, 15.0);
}

Patch makeSphere(int cells) {
  std::map<std::array<int, 3>, std::int32_t> number;
  std::vector<Vec3> positions;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, isNew] = number.try_emplace(p, static_cast<std::int32_t>(positions.size()));
    if (isNew) {
      // Sines of the barycentric coordinates spread the vertices more evenly than the coordinates themselves.
      const auto spread = [cells](int k) { return std::sin(0.5 * kPi * k / cells); };
      positions.push_back(normalized(Vec3{spread(p[0]), spread(p[1]), spread(p[2])}));
    }
    return it->second;
  };
  Corners triangles;
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = (octant & 1) != 0 ? -1 : 1;
    const int sy = (octant & 2) != 0 ? -1 : 1;
    const int sz = (octant & 4) != 0 ? -1 : 1;
    const auto at = [&](int i, int j) { return vertex({sx * i, sy * j, sz * (cells - i - j)}); };
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      if (sx * sy * sz > 0) {
        triangles.push_back({a, b, c});
      } else {
        triangles.push_back({a, c, b});
      }
    };
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; i + j < cells; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < cells) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return makePatch(positions, triangles, 0.5 * kPi / cells);
}

Patch makeTorus(int around, int along, double tube) {
  const auto map = [tube](double x, double y) {
    const double a = 2.0 * kPi * x;
    const double b = 2.0 * kPi * y;
    const double r = 1.0 + tube * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), tube * std::sin(b)};
  };
  return makeGrid({.nx = around, .ny = along, .closedX = true, .closedY = true, .map = map, .keep = {}},
                  2.0 * kPi / around);
}

Patch makeCylinder(int around, int along, double height, double twist) {
  const auto map = [=](double x, double y) {
    const double a = 2.0 * kPi * x + twist * y;
    return Vec3{std::cos(a), std::sin(a), height * y};
  };
  Patch patch = makeGrid({.nx = around, .ny = along, .closedX = true, .map = map, .keep = {}}, 2.0 * kPi / around);
  for (const VertexId v : patch.surface.vertices()) {
    patch.normal[v] = normalized(tangentPart(patch.surface.position(v), {0.0, 0.0, 1.0}));
  }
  return patch;
}

Patch makeCone(int around, int along, double height, double top) {
  const auto map = [=](double x, double y) {
    const double a = 2.0 * kPi * x;
    const double r = 1.0 + (top - 1.0) * y;
    return Vec3{r * std::cos(a), r * std::sin(a), height * y};
  };
  Patch patch = makeGrid({.nx = around, .ny = along, .closedX = true, .map = map, .keep = {}}, 2.0 * kPi / around);
  for (const VertexId v : patch.surface.vertices()) {
    const Vec3 radial = normalized(tangentPart(patch.surface.position(v), {0.0, 0.0, 1.0}));
    patch.normal[v] = normalized(radial * height + Vec3{0.0, 0.0, 1.0 - top});
  }
  return patch;
}

Patch makePretzel(int holes, int cells) {
  // Blocks in three rows, the odd ones of the middle row left out; their outer sides cut into cells.
  const auto solid = [holes](int i, int j, int k) {
    const bool inside = i >= 0 && i < 2 * holes + 1 && j >= 0 && j < 3 && k == 0;
    return inside && !(j == 1 && i % 2 == 1);
  };
  std::map<std::array<int, 3>, std::int32_t> number;
  std::vector<Vec3> positions;
  Corners triangles;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, isNew] = number.try_emplace(p, static_cast<std::int32_t>(positions.size()));
    if (isNew) positions.push_back({1.0 * p[0] / cells, 1.0 * p[1] / cells, 1.0 * p[2] / cells});
    return it->second;
  };
  const auto addSide = [&](const std::array<int, 3>& block, std::size_t axis, int direction) {
    for (int a = 0; a < cells; ++a) {
      for (int b = 0; b < cells; ++b) {
        const auto at = [&](int u, int v) {
          std::array<int, 3> p{block[0] * cells, block[1] * cells, block[2] * cells};
          p[axis] += direction > 0 ? cells : 0;
          p[(axis + 1) % 3] += direction > 0 ? u : v;
          p[(axis + 2) % 3] += direction > 0 ? v : u;
          return vertex(p);
        };
        triangles.push_back({at(a, b), at(a + 1, b), at(a + 1, b + 1)});
        triangles.push_back({at(a, b), at(a + 1, b + 1), at(a, b + 1)});
      }
    }
  };
  for (int i = 0; i < 2 * holes + 1; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (std::size_t axis = 0; axis < 3 && solid(i, j, 0); ++axis) {
        for (const int direction : {-1, 1}) {
          std::array<int, 3> neighbour{i, j, 0};
          neighbour[axis] += direction;
          if (!solid(neighbour[0], neighbour[1], neighbour[2])) addSide({i, j, 0}, axis, direction);
        }
      }
    }
  }
  constexpr int kRounding = 12;
  for (int round = 0; round < kRounding; ++round) {
    std::vector<Vec3> sum(positions.size());
    std::vector<double> count(positions.size(), 0.0);
    for (const auto& corners : triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum[static_cast<std::size_t>(corners[c])] += positions[static_cast<std::size_t>(corners[(c + 1) % 3])];
        count[static_cast<std::size_t>(corners[c])] += 1.0;
      }
    }
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = (positions[v] + sum[v] / count[v]) * 0.5;
  }
  return makePatch(positions, triangles, 1.0 / cells);
}

Patch transformed(const Patch& patch, const std::function<Vec3(const Vec3&)>& move) {
  Patch result = patch;
  std::vector<Vec3> positions;
  Corners triangles;
  for (const VertexId v : patch.surface.vertices()) positions.push_back(move(patch.surface.position(v)));
  for (const TriangleId t : patch.surface.triangles()) {
    const auto [a, b, c] = patch.surface.corners(t);
    triangles.push_back({a.value, b.value, c.value});
  }
  result.surface = Surface::build(positions, triangles).value();
  for (const VertexId v : patch.surface.vertices()) {
    result.normal[v] = move(patch.normal[v]) - move({0.0, 0.0, 0.0});
  }
  return result;
}

}  // namespace qmcf::testing
