#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Cell types of VTK, with its numbers.
enum class VtuCell : std::uint8_t { vertex = 1, line = 3, triangle = 5, quad = 9 };

/// A named array with a fixed number of components per point or cell. Values must be finite.
struct VtuArray {
  std::string name;
  std::size_t components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;
};

/// Names in the field data: ParaView shows them in the information panel.
struct VtuNames {
  std::string name;
  std::vector<std::string> values;
};

/// A VTK unstructured grid of any cells and arrays.
struct VtuGrid {
  std::vector<Vec3> points;
  std::vector<std::int32_t> connectivity;  ///< Points of all cells, one cell after the other.
  std::vector<VtuCell> cells;
  std::vector<VtuArray> pointData;  ///< Sizes: components * points.size().
  std::vector<VtuArray> cellData;   ///< Sizes: components * cells.size().
  std::vector<VtuNames> names;
};

/// Points a cell has: 1, 2, 3 or 4.
std::size_t vtuCellSize(VtuCell cell);

/// The grid as a .vtu file (XML, ASCII; numbers read back as the same values).
std::string writeVtu(const VtuGrid& grid);

}  // namespace qmcf
