#include "qmcf/base/parallel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace qmcf {
namespace {

constexpr std::array<std::int32_t, 4> kThreadCounts{1, 2, 7, 64};

/// Something to do that takes a while.
double toil(std::size_t rounds) {
  double x = 1.0;
  for (std::size_t i = 0; i < rounds; ++i) x = std::sqrt(x + static_cast<double>(i));
  return x;
}

/// Checks what every Progress is promised, and stops at a given fraction.
class Watcher final : public Progress {
 public:
  explicit Watcher(double stopAt = 2.0) : stopAt_(stopAt) {}
  [[nodiscard]] bool report(Stage stage, double fraction) override {
    EXPECT_EQ(std::this_thread::get_id(), thread_);
    EXPECT_GE(fraction, last[stage]);
    EXPECT_LE(fraction, 1.0);
    last[stage] = fraction;
    ++calls;
    return fraction < stopAt_;
  }
  std::map<Stage, double> last;
  int calls = 0;

 private:
  std::thread::id thread_ = std::this_thread::get_id();
  double stopAt_;
};

std::vector<double> unevenCosts(std::size_t count) {
  std::vector<double> costs;
  for (std::size_t i = 0; i < count; ++i) costs.push_back(static_cast<double>((i * 7919) % 101));
  return costs;
}

Error errorOf(std::size_t index) {
  return {ErrorCode::malformedInput, "Piece " + std::to_string(index), {static_cast<std::int64_t>(index)}};
}

TEST(ParallelFor, DoesEachPieceOnce) {
  for (const std::int32_t threads : kThreadCounts) {
    std::vector<int> times(1000, 0);
    Watcher watcher;
    const auto error = parallelFor(unevenCosts(times.size()), threads, watcher, [&](std::size_t i, Progress&) {
      ++times[i];
      return std::optional<Error>();
    });
    EXPECT_FALSE(error);
    for (const int n : times) EXPECT_EQ(n, 1);
  }
}

TEST(ParallelFor, HasNothingToDoWithoutPieces) {
  Watcher watcher;
  const auto never = [](std::size_t, Progress&) { return std::optional<Error>(errorOf(0)); };
  EXPECT_FALSE(parallelFor({}, 4, watcher, never));
  EXPECT_EQ(watcher.calls, 0);
}

TEST(ParallelFor, ReportsOnTheCallersThreadAndNeverBackwards) {
  for (const std::int32_t threads : kThreadCounts) {
    Watcher watcher;
    const auto error = parallelFor(unevenCosts(60), threads, watcher, [](std::size_t i, Progress& progress) {
      for (const Stage stage : {Stage::front, Stage::cleanup}) {
        for (int step = 0; step <= 20; ++step) {
          toil(200 * (i % 5));
          EXPECT_TRUE(progress.report(stage, step / 20.0));
        }
        EXPECT_TRUE(progress.report(stage, 0.5));  // A stage that counts anew.
      }
      return std::optional<Error>();
    });
    EXPECT_FALSE(error);
    EXPECT_GT(watcher.calls, 0);
    EXPECT_NEAR(watcher.last[Stage::cleanup], 1.0, 1e-9);
  }
}

TEST(ParallelFor, TellsTheErrorOfTheSmallestIndexWhicheverCameFirst) {
  for (const std::int32_t threads : kThreadCounts) {
    for (int round = 0; round < 20; ++round) {
      SilentProgress silent;
      // Pieces 40, 41 … fail at once, piece 13 after a while, and all before 13 succeed.
      const auto error = parallelFor(unevenCosts(80), threads, silent, [](std::size_t i, Progress& progress) {
        if (i >= 40) return std::optional<Error>(errorOf(i));
        for (int step = 0; step < 10; ++step) {
          toil(i == 13 ? 3000 : 100);
          if (!progress.report(Stage::front, step / 10.0)) return std::optional<Error>(cancelledError());
        }
        return i == 13 || i == 20 ? std::optional<Error>(errorOf(i)) : std::nullopt;
      });
      ASSERT_TRUE(error);
      EXPECT_EQ(error->code, ErrorCode::malformedInput);
      EXPECT_EQ(error->elements, std::vector<std::int64_t>{13});
    }
  }
}

TEST(ParallelFor, StopsAllPiecesWhenTheCallerDoes) {
  for (const std::int32_t threads : kThreadCounts) {
    Watcher watcher(0.01);
    std::atomic<int> finished{0};
    // Each goes on until it is told to stop, in practice.
    const auto work = [&](std::size_t, Progress& progress) {
      for (int step = 0; step < 10'000'000; ++step) {
        toil(100);
        if (!progress.report(Stage::field, 0.9)) return std::optional<Error>(cancelledError());
      }
      ++finished;
      return std::optional<Error>();
    };
    const auto error = parallelFor(std::vector<double>(50, 1.0), threads, watcher, work);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::cancelled);
    EXPECT_EQ(finished, 0);
  }
}

TEST(ParallelFor, CanBeStoppedWhileTheCallerWaitsForOthers) {
  // The caller's own piece is over at once; the other one goes on until it is told to stop.
  Watcher watcher(0.9);
  const std::thread::id caller = std::this_thread::get_id();
  const auto error = parallelFor({1.0, 1.0}, 2, watcher, [&](std::size_t, Progress& progress) {
    if (std::this_thread::get_id() == caller) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return std::optional<Error>();
    }
    while (progress.report(Stage::front, 0.95)) toil(100);
    return std::optional<Error>(cancelledError());
  });
  // A system that has no second thread lets the caller do both pieces.
  if (watcher.calls > 0) {
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::cancelled);
  }
}

TEST(ParallelFor, ThrowsWhatAPieceThrew) {
  for (const std::int32_t threads : kThreadCounts) {
    SilentProgress silent;
    const auto work = [](std::size_t i, Progress&) {
      if (i == 7) throw std::runtime_error("seven");
      return i > 7 ? std::optional<Error>(errorOf(i)) : std::nullopt;
    };
    EXPECT_THROW(static_cast<void>(parallelFor(std::vector<double>(30, 1.0), threads, silent, work)),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace qmcf
