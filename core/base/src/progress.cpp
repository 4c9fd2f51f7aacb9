#include "qmcf/base/progress.hpp"

#include <array>

namespace qmcf {

std::string_view stageName(Stage stage) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"read", "repair", "topology", "sizing", "background", "field", "front", "cleanup", "quality", "write"});
  return kNames[static_cast<std::size_t>(stage)];
}

}  // namespace qmcf
