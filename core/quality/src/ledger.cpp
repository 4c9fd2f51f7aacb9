#include "ledger.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

#include "disjoint_sets.hpp"
#include "screening.hpp"

namespace qmcf::quality {
namespace {

/// The corners of all elements, numbered by element; those at one vertex of the sheets are one set. Sheets hang
/// together through edges with two elements and nothing else.
class CutCorners {
 public:
  CutCorners(const std::vector<Element>& elements, const EdgeTable& table)
      : elements_(elements), sets_(elements.size() * kStride), onBoundary_(elements.size() * kStride, 0) {
    for (const EdgeRecord& edge : table.edges) {
      const auto uses = table.usesOf(edge);
      if (uses.size() != 2) continue;
      for (const bool atLow : {true, false}) sets_.join(cornerAt(uses[0], atLow), cornerAt(uses[1], atLow));
    }
    for (const EdgeRecord& edge : table.edges) {
      if (edge.useCount == 2) continue;
      for (const EdgeUse& use : table.usesOf(edge)) {
        for (const bool atLow : {true, false}) onBoundary_[index(sets_.root(cornerAt(use, atLow)))] = 1;
      }
    }
  }

  /// The same number for all corners at one vertex of a sheet.
  std::size_t vertexAt(std::size_t element, std::size_t corner) {
    return index(sets_.root(static_cast<std::int32_t>(element * kStride + corner)));
  }
  [[nodiscard]] bool isOnBoundary(std::size_t vertex) const { return onBoundary_[vertex] != 0; }
  [[nodiscard]] std::size_t bound() const { return onBoundary_.size(); }

 private:
  static constexpr std::size_t kStride = 4;
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] std::int32_t cornerAt(const EdgeUse& use, bool atLow) const {
    const auto count = static_cast<std::int32_t>(cornerCount(elements_[index(use.element)]));
    const std::int32_t corner = use.forward == atLow ? use.corner : (use.corner + 1) % count;
    return use.element * static_cast<std::int32_t>(kStride) + corner;
  }

  const std::vector<Element>& elements_;
  DisjointSets sets_;
  std::vector<std::uint8_t> onBoundary_;
};

std::int64_t countSheets(std::size_t elementCount, const std::vector<std::uint8_t>& usable, const EdgeTable& table) {
  DisjointSets sheets(elementCount);
  for (const EdgeRecord& edge : table.edges) {
    const auto uses = table.usesOf(edge);
    if (uses.size() == 2) sheets.join(uses[0].element, uses[1].element);
  }
  std::int64_t count = 0;
  for (std::size_t e = 0; e < elementCount; ++e) {
    const auto id = static_cast<std::int32_t>(e);
    if (usable[e] != 0 && sheets.root(id) == id) ++count;
  }
  return count;
}

/// Irregular vertices by their number of elements; regular ones have `regular` of them.
std::vector<LedgerEntry> entries(const std::map<std::int32_t, std::int64_t>& vertices, std::int32_t regular) {
  std::vector<LedgerEntry> result;
  for (const auto& [elements, count] : vertices) {
    if (elements != regular) result.push_back({elements, count, (regular - elements) * count});
  }
  return result;
}

std::int64_t total(const std::vector<LedgerEntry>& entries) {
  std::int64_t sum = 0;
  for (const LedgerEntry& entry : entries) sum += entry.index;
  return sum;
}

}  // namespace

IndexLedger balance(const std::vector<Element>& elements, const std::vector<std::uint8_t>& usable,
                    const EdgeTable& table) {
  CutCorners corners(elements, table);
  IndexLedger ledger;
  std::int64_t elementCount = 0;
  std::vector<std::int32_t> elementsAt(corners.bound(), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (usable[e] == 0) continue;
    ++elementCount;
    if (cornerCount(elements[e]) == 3) ++ledger.triangles;
    for (std::size_t c = 0; c < cornerCount(elements[e]); ++c) ++elementsAt[corners.vertexAt(e, c)];
  }
  std::int64_t vertexCount = 0;
  std::map<std::int32_t, std::int64_t> inside;
  std::map<std::int32_t, std::int64_t> onBoundary;
  for (std::size_t v = 0; v < elementsAt.size(); ++v) {
    if (elementsAt[v] == 0) continue;
    ++vertexCount;
    ++(corners.isOnBoundary(v) ? onBoundary : inside)[elementsAt[v]];
  }
  std::int64_t edgeCount = 0;
  for (const EdgeRecord& edge : table.edges) edgeCount += edge.useCount == 2 ? 1 : edge.useCount;

  ledger.interior = entries(inside, 4);
  ledger.boundary = entries(onBoundary, 2);
  ledger.interiorIndex = total(ledger.interior);
  ledger.boundaryIndex = total(ledger.boundary);
  ledger.sheets = countSheets(elements.size(), usable, table);
  ledger.fourEuler = 4 * (vertexCount - edgeCount + elementCount);
  return ledger;
}

}  // namespace qmcf::quality

namespace qmcf {

bool IndexLedger::closes() const { return sum() == fourEuler && sum() == partFourEuler.value_or(fourEuler); }

IndexLedger indexLedger(const std::vector<Vec3>& positions, const std::vector<Element>& elements) {
  const quality::Screening screening = quality::screenElements(positions, elements);
  const quality::Structure structure = quality::buildStructure(positions, elements, screening.usable);
  return quality::balance(elements, screening.usable, structure.edges);
}

}  // namespace qmcf
