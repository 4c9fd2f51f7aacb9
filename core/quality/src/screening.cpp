#include "screening.hpp"

#include <algorithm>
#include <array>

namespace qmcf::quality {
namespace {

enum class ElementDefect : std::uint8_t { none, outOfRange, nonFinite, repeatedCorner };

ElementDefect defectOf(const std::vector<Vec3>& positions, const Element& element) {
  const auto limit = static_cast<std::int64_t>(positions.size());
  const std::size_t corners = cornerCount(element);
  for (std::size_t c = 0; c < corners; ++c) {
    if (element[c] < 0 || element[c] >= limit) return ElementDefect::outOfRange;
  }
  for (std::size_t c = 0; c < corners; ++c) {
    for (std::size_t d = c + 1; d < corners; ++d) {
      if (element[c] == element[d]) return ElementDefect::repeatedCorner;
    }
  }
  for (std::size_t c = 0; c < corners; ++c) {
    if (!isFinite(positions[static_cast<std::size_t>(element[c])])) return ElementDefect::nonFinite;
  }
  return ElementDefect::none;
}

}  // namespace

Screening screenElements(const std::vector<Vec3>& positions, const std::vector<Element>& elements) {
  Screening result;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!isFinite(positions[v])) result.nonFiniteVertices.push_back(static_cast<std::int64_t>(v));
  }
  result.usable.assign(elements.size(), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto id = static_cast<std::int64_t>(e);
    switch (defectOf(positions, elements[e])) {
      case ElementDefect::none:
        result.usable[e] = 1;
        break;
      case ElementDefect::outOfRange:
        result.outOfRange.push_back(id);
        break;
      case ElementDefect::nonFinite:
        result.nonFinite.push_back(id);
        break;
      case ElementDefect::repeatedCorner:
        result.repeatedCorner.push_back(id);
        break;
    }
  }
  return result;
}

std::vector<std::int64_t> findDuplicates(const std::vector<Element>& elements,
                                         const std::vector<std::uint8_t>& usable) {
  struct Key {
    Element sorted;
    std::int32_t element;
    bool operator<(const Key& other) const {
      return sorted != other.sorted ? sorted < other.sorted : element < other.element;
    }
  };
  std::vector<Key> keys;
  keys.reserve(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (usable[e] == 0) continue;
    Key key{elements[e], static_cast<std::int32_t>(e)};
    std::sort(key.sorted.begin(), key.sorted.end());
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int64_t> result;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].sorted == keys[i - 1].sorted) result.push_back(keys[i].element);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace qmcf::quality
