#include "face_uses.hpp"

#include <cstddef>

namespace qmcf {

std::vector<std::vector<std::int32_t>> oddUses(const Brep& brep) {
  std::vector<std::vector<std::int32_t>> uses(brep.edges.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        auto& of = uses[static_cast<std::size_t>(coedge.edge)];
        if (!of.empty() && of.back() == face) {
          of.pop_back();
        } else {
          of.push_back(face);
        }
      }
    }
  }
  return uses;
}

}  // namespace qmcf
