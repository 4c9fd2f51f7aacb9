#include "stage_clock.hpp"

namespace qmcf::cli {

void StageClock::tick() {
  const std::clock_t now = std::clock();
  seconds_[static_cast<std::size_t>(stage_)] += static_cast<double>(now - last_) / CLOCKS_PER_SEC;
  last_ = now;
}

bool StageClock::report(Stage stage, double fraction) {
  tick();
  stage_ = stage;
  return outer_.report(stage, fraction);
}

std::array<double, StageClock::kStages> StageClock::seconds() {
  tick();
  return seconds_;
}

}  // namespace qmcf::cli
