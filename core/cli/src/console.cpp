#include "console.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace qmcf::cli {
namespace {

// A signal handler can reach nothing but an object of this kind.
volatile std::sig_atomic_t interrupted = 0;

extern "C" void onInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

constexpr auto kInterval = std::chrono::milliseconds(100);

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

ConsoleProgress::ConsoleProgress(bool quiet) : visible_(!quiet && ::isatty(STDERR_FILENO) != 0) {}

ConsoleProgress::~ConsoleProgress() { clear(); }

bool ConsoleProgress::report(Stage stage, double fraction) {
  if (interrupted != 0) return false;
  if (!visible_) return true;
  const Clock::time_point now = Clock::now();
  if (shown_ && stage == stage_ && now - last_ < kInterval) return true;
  shown_ = true;
  stage_ = stage;
  last_ = now;
  const std::string name(stageName(stage));
  std::fprintf(stderr, "\r%-12s %3d %%\x1b[K", name.c_str(), static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0)));
  std::fflush(stderr);
  return true;
}

void ConsoleProgress::clear() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

void warn(const std::string& message, const std::string& subject) {
  const std::string text = "qmcf: " + (subject.empty() ? "" : subject + ": ") + message + "\n";
  std::fputs(text.c_str(), stderr);
}

int fail(const Error& error, const std::string& subject) {
  warn(error.message, subject);
  return errorExitStatus(error.code);
}

}  // namespace qmcf::cli
