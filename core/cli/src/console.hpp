#pragma once

#include <chrono>
#include <string>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"

namespace qmcf::cli {

/// The first Ctrl-C (or a polite kill) asks the run to stop, the second one ends the program at once.
void catchInterrupts();

/// Shows stage and percentage on standard error when that is a terminal, and stops the run after an interrupt.
class ConsoleProgress final : public Progress {
 public:
  explicit ConsoleProgress(bool quiet);
  ~ConsoleProgress() override;
  ConsoleProgress(const ConsoleProgress&) = delete;
  ConsoleProgress& operator=(const ConsoleProgress&) = delete;

  [[nodiscard]] bool report(Stage stage, double fraction) override;
  /// Removes the line, so that other output can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool shown_ = false;
  Stage stage_ = Stage::read;
  Clock::time_point last_;
};

/// Prints "qmcf: subject: message" on standard error.
void warn(const std::string& message, const std::string& subject);
/// The same for an error, which also tells the exit status.
int fail(const Error& error, const std::string& subject = {});

}  // namespace qmcf::cli
