#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Where a front failed to advance, and on which of its passes: trying again is in vain until something near has
/// changed. Narrow faces make fronts of which nearly every edge has to wait for its neighbours; trying all of them
/// after each success would take the square of their number.
class FailedAttempts {
 public:
  static constexpr std::size_t kPasses = 3;

  /// Notes what the next commit is going to change.
  void noteChange(const EditMesh& mesh);
  /// An attempt from a front edge has failed because of what is near.
  void noteFailure(HalfedgeId h, int pass);
  /// Whether nothing near a front edge has changed since an attempt from it failed on this pass.
  [[nodiscard]] bool isVain(const FrontMesh& front, HalfedgeId h, int pass) const;

 private:
  /// What one commit changed lies within this ball.
  struct Change {
    Vec3 centre;
    double radius = 0.0;
  };

  std::vector<Change> changes_;
  std::vector<std::array<std::size_t, kPasses>> failures_;  ///< Per half-edge and pass: changes before it; 0 for none.
};

}  // namespace qmcf
