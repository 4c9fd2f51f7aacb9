// field_speed [RINGS]
// CPU seconds to assemble and solve the cross field of a wavy disk of so many rings of triangles, in JSON. Default:
// 183, which makes 101,017 vertices. The digest tells whether two programs came to the same field, bit for bit.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#endif

#include "qmcf/base/math.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {
namespace {

/// A disk in waves: pinned along its rim, guided by curvature of either sign, with singularities.
Patch makeDisk(int rings) {
  std::vector<Vec3> positions{{0.0, 0.0, 0.0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto node = [](int ring, int i) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double radius = static_cast<double>(ring) / rings;
      const double x = radius * math::cos(math::kPi * i / (3.0 * ring));
      const double y = radius * math::sin(math::kPi * i / (3.0 * ring));
      positions.push_back({x, y, 0.05 * math::sin(9.0 * x) * math::cos(7.0 * y)});
    }
    for (int sector = 0; sector < 6; ++sector) {
      for (int i = 0; i < ring; ++i) {
        const std::int32_t inner = node(ring - 1, sector * (ring - 1) + i);
        const std::int32_t next = node(ring, sector * ring + i + 1);
        triangles.push_back({inner, node(ring, sector * ring + i), next});
        if (i + 1 < ring) triangles.push_back({inner, next, node(ring - 1, sector * (ring - 1) + i + 1)});
      }
    }
  }
  Patch patch;
  patch.face = 0;
  patch.surface = Surface::build(positions, triangles).value();
  const std::size_t vertices = patch.surface.vertexCount();
  patch.normal.resize(vertices);
  for (const TriangleId t : patch.surface.triangles()) {
    for (const VertexId v : patch.surface.corners(t)) patch.normal[v] += patch.surface.areaVector(t);
  }
  for (const VertexId v : patch.surface.vertices()) patch.normal[v] = normalized(patch.normal[v]);
  patch.size.resize(vertices, 1.0 / rings);
  patch.node.resize(vertices, kNone);
  patch.cornerQuads.resize(vertices, 0);
  patch.edge.resize(patch.surface.halfedgeCount(), kNone);
  return patch;
}

#ifdef __EMSCRIPTEN__
// Emscripten's std::clock() counts real time.
EM_JS(double, cpuSeconds, (), {
  const used = process.cpuUsage();
  return 1e-6 * (used.user + used.system);
});
#else
double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
#endif

/// FNV-1a over the bytes of the crosses.
std::uint64_t digest(const CrossField& field) {
  std::uint64_t hash = 14695981039346656037U;
  const auto& raw = field.cross.raw();
  const auto* bytes = reinterpret_cast<const unsigned char*>(raw.data());
  for (std::size_t i = 0; i < raw.size() * sizeof(raw[0]); ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
  return hash;
}

int measure(int rings) {
  const Patch patch = makeDisk(rings);
  const double start = cpuSeconds();
  SilentProgress progress;
  const Result<CrossField> field = computeCrossField(patch, {}, FieldOptions{}, progress);
  const double seconds = cpuSeconds() - start;
  if (!field) {
    std::fprintf(stderr, "%s\n", field.error().message.c_str());
    return 1;
  }
  std::printf(
      "{\"vertices\": %zu, \"seconds\": %.3f, \"energy\": %.6f, \"singularities\": %zu, \"digest\": \"%016llx\"}\n",
      patch.surface.vertexCount(), seconds, field.value().energy, field.value().singularities.size(),
      static_cast<unsigned long long>(digest(field.value())));
  return 0;
}

}  // namespace
}  // namespace qmcf

int main(int count, char** arguments) {
  const int rings = count > 1 ? std::atoi(arguments[1]) : 183;
  if (rings < 2) {
    std::fprintf(stderr, "usage: field_speed [RINGS]\n");
    return 2;
  }
  return qmcf::measure(rings);
}
