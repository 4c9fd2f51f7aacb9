#include "sizing_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace qmcf::cli {
namespace {

/// Per vertex: whether it is the first one at its point.
std::vector<bool> firstAtPoint(const std::vector<Vec3>& positions) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto point = [&](std::size_t v) {
    return std::tuple(positions[v].x + 0.0, positions[v].y + 0.0, positions[v].z + 0.0);  // -0 becomes 0.
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::tuple(point(a), a) < std::tuple(point(b), b); });
  std::vector<bool> first(positions.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i == 0 || point(order[i]) != point(order[i - 1]);
  }
  return first;
}

}  // namespace

std::string sizingText(const ReadModel& model, const std::vector<double>& size) {
  const bool isStl = model.format == InputFormat::stlAscii || model.format == InputFormat::stlBinary;
  std::vector<bool> written(size.size(), true);
  if (isStl) written = firstAtPoint(model.mesh.positions);
  std::string text;
  for (std::size_t v = 0; v < size.size(); ++v) {
    if (!written[v]) continue;
    constexpr std::size_t kMostDigits = 32;
    char digits[kMostDigits];
    const auto [end, error] = std::to_chars(digits, digits + kMostDigits, size[v]);
    (void)error;  // 32 characters hold the shortest form of every double.
    text.append(digits, end).push_back('\n');
  }
  return text;
}

}  // namespace qmcf::cli
