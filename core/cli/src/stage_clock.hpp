#pragma once

#include <array>
#include <cstddef>
#include <ctime>

#include "qmcf/base/progress.hpp"

namespace qmcf::cli {

/// Passes progress on and adds up the CPU time of all threads that each stage takes. What comes between two reports
/// counts for the stage of the first.
class StageClock final : public Progress {
 public:
  static constexpr std::size_t kStages = static_cast<std::size_t>(Stage::write) + 1;

  explicit StageClock(Progress& outer) : outer_(outer) {}

  [[nodiscard]] bool report(Stage stage, double fraction) override;
  /// CPU seconds up to now, by stage.
  [[nodiscard]] std::array<double, kStages> seconds();

 private:
  void tick();

  Progress& outer_;
  std::array<double, kStages> seconds_{};
  Stage stage_ = Stage::read;
  std::clock_t last_ = std::clock();
};

}  // namespace qmcf::cli
