#pragma once

#include <cstdint>
#include <string_view>

namespace qmcf {

/// The stages of a run, in order.
enum class Stage : std::uint8_t { read, repair, topology, sizing, background, field, front, cleanup, quality, write };

/// The stage's name; the same in C++, JSON and TypeScript.
std::string_view stageName(Stage stage);

/// Receives progress and can stop the run: one call does both. It is called on the thread that started the run only.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual ~Progress() = default;

  /// Called often from a long loop. fraction of this stage in [0, 1].
  /// Returns false when the run shall stop; the stage then returns cancelledError().
  [[nodiscard]] virtual bool report(Stage stage, double fraction) = 0;
};

/// Progress that nobody watches and that never stops a run.
class SilentProgress final : public Progress {
 public:
  [[nodiscard]] bool report(Stage /*stage*/, double /*fraction*/) override { return true; }
};

}  // namespace qmcf
