#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qmcf/mesh/quad_mesh.hpp"

namespace qmcf::quality {

/// One element that has an edge, and how it runs along it.
struct EdgeUse {
  std::int32_t element = kNone;
  std::int8_t corner = 0;  ///< The element's corner from which its side starts.
  bool forward = false;    ///< From the edge's lower vertex to the higher one.
};

/// An edge: its vertices in ascending order and its uses.
struct EdgeRecord {
  std::int32_t low = kNone;
  std::int32_t high = kNone;
  std::int32_t firstUse = 0;
  std::int32_t useCount = 0;
};

/// Every edge of a mesh, ordered by (low, high), with the elements around it, ordered by element.
struct EdgeTable {
  std::vector<EdgeRecord> edges;
  std::vector<EdgeUse> uses;

  [[nodiscard]] std::span<const EdgeUse> usesOf(const EdgeRecord& edge) const {
    return std::span(uses).subspan(static_cast<std::size_t>(edge.firstUse), static_cast<std::size_t>(edge.useCount));
  }
};

/// Two uses in the same direction: the elements disagree about the surface's side.
bool isOrientationConflict(const EdgeTable& table, const EdgeRecord& edge);

/// How the elements of a mesh hang together. Malformed elements (see Screening::usable) take no part.
struct Structure {
  EdgeTable edges;
  std::vector<std::int32_t> elementsAround;  ///< Per vertex: elements that use it.
  std::vector<std::int32_t> fans;            ///< Per vertex: groups of its elements that are connected through edges.
  std::vector<std::uint8_t> onBoundary;      ///< Per vertex: 1 if it is on an edge with one element.
  std::vector<std::uint8_t> onNonManifold;   ///< Per vertex: 1 if it is on an edge with more than two elements.
  std::int64_t components = 0;
  std::int64_t eulerCharacteristic = 0;
  double boundaryLength = 0.0;
  double nonManifoldLength = 0.0;
};

/// Builds all of it in time linear in the number of elements (sorting around single vertices apart).
Structure buildStructure(const std::vector<Vec3>& positions, const std::vector<Element>& elements,
                         const std::vector<std::uint8_t>& usable);

}  // namespace qmcf::quality
