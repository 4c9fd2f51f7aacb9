#include "soup.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace qmcf::fuzz {
namespace {

/// Takes the input byte by byte; zeros when it is used up.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}
  [[nodiscard]] bool empty() const { return next_ >= bytes_.size(); }
  unsigned take() { return empty() ? 0U : static_cast<unsigned>(bytes_[next_++]); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
};

/// Two bytes: the place in a lattice of 5 x 5 x 5, and a shift that is far below, near or above the weld tolerance.
Vec3 takePoint(ByteSource& source) {
  constexpr std::array<double, 8> kShifts{0.0, 0.0, 1e-14, 1e-9, 3e-7, 2e-6, 1e-4, 0.25};
  const unsigned place = source.take() % 125U;
  const unsigned shift = source.take();
  Vec3 point{static_cast<double>(place % 5U), static_cast<double>(place / 5U % 5U), static_cast<double>(place / 25U)};
  const double length = kShifts[shift & 7U];
  if ((shift & 8U) != 0) point.x += length;
  if ((shift & 16U) != 0) point.y -= length;
  if ((shift & 32U) != 0) point.z += length;
  return point;
}

}  // namespace

TriangleMesh soupFromBytes(std::span<const std::byte> bytes) {
  ByteSource source(bytes);
  constexpr std::array<int, 8> kExponents{0, 0, 0, 0, -100, 30, -190, 300};
  TriangleMesh mesh;
  const unsigned shape = source.take();
  const double scale = std::ldexp(1.0, kExponents[shape & 7U]);
  const double offset = (shape & 8U) != 0 ? 1e6 : 0.0;
  const unsigned points = 3U + source.take() % 60U;
  for (unsigned i = 0; i < points; ++i) {
    const Vec3 p = takePoint(source);
    mesh.positions.push_back({(p.x + offset) * scale, p.y * scale, p.z * scale});
  }
  const bool labelled = (shape & 16U) != 0;
  while (!source.empty()) {
    std::array<std::int32_t, 3> corners{};
    for (std::int32_t& corner : corners) corner = static_cast<std::int32_t>(source.take() % points);
    mesh.triangles.push_back(corners);
    if (labelled) mesh.labels.push_back(corners[0] % 3);
  }
  if (labelled) mesh.labelNames = {"a", "b", "c"};
  return mesh;
}

}  // namespace qmcf::fuzz
