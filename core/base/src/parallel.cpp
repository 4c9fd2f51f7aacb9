#include "qmcf/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

// WebAssembly has neither threads nor exceptions; locks cost nothing there.
#if !defined(__EMSCRIPTEN__)
#define QMCF_HAS_THREADS
#include <exception>
#include <system_error>
#include <thread>
#endif

namespace qmcf {
namespace {

constexpr std::size_t kStages = static_cast<std::size_t>(Stage::write) + 1;
constexpr std::size_t kNoIndex = std::numeric_limits<std::size_t>::max();

using Lock = std::unique_lock<std::mutex>;

/// Share of the costs, at least a little, so that pieces without any count as well.
std::vector<double> sharesOf(const std::vector<double>& costs) {
  const double total = std::accumulate(costs.begin(), costs.end(), 0.0);
  const double least = total > 0.0 ? 1e-3 * total / static_cast<double>(costs.size()) : 1.0;
  std::vector<double> shares;
  double sum = 0.0;
  for (const double cost : costs) {
    shares.push_back(std::max(cost, least));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

std::vector<std::size_t> dearestFirst(const std::vector<double>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  return order;
}

/// The pieces of one parallelFor(): who takes which, what is done, and what went wrong.
class Pieces {
 public:
  Pieces(const std::vector<double>& costs, Progress& outer, const IndexedWork& work)
      : shares_(sharesOf(costs)), order_(dearestFirst(costs)), outer_(outer), work_(work) {}

  /// Takes pieces and does them until none is left. isCaller: on the thread that may call the outer progress.
  void runThread(bool isCaller) {
    for (std::size_t i = take(); i != kNoIndex; i = take()) {
      PieceProgress progress(*this, i, isCaller);
      std::optional<Error> error = attempt(i, progress);
      finish(i, std::move(error), progress.done);
    }
  }

  std::optional<Error> run(std::int32_t threads) {
#if defined(QMCF_HAS_THREADS)
    std::vector<std::thread> team;
    try {
      const std::size_t helpers = std::min(static_cast<std::size_t>(threads), order_.size()) - 1;
      for (std::size_t t = 0; t < helpers; ++t) team.emplace_back([this] { runThread(false); });
    } catch (const std::system_error&) {
      // The system has no thread to spare: those that there are do all the work.
    }
    runThread(true);
    try {
      reportUntilDone();
      reportEnd();
    } catch (...) {
      stopWith(std::current_exception());
    }
    for (std::thread& thread : team) thread.join();
    if (exception_) std::rethrow_exception(exception_);
#else
    static_cast<void>(threads);
    runThread(true);
    reportEnd();
#endif
    return stopped_ ? cancelledError() : error_;
  }

 private:
  using StageShares = std::array<double, kStages>;

  /// Adds what one piece reports to the whole.
  class PieceProgress final : public Progress {
   public:
    PieceProgress(Pieces& pieces, std::size_t index, bool isCaller)
        : pieces_(pieces), index_(index), isCaller_(isCaller) {}
    [[nodiscard]] bool report(Stage stage, double fraction) override {
      double& reached = done[static_cast<std::size_t>(stage)];
      const double more = std::max(0.0, std::min(fraction, 1.0) - reached);
      reached += more;
      return pieces_.advance(index_, stage, more, isCaller_);
    }
    StageShares done{};  ///< Per stage: the fraction reached.

   private:
    Pieces& pieces_;
    std::size_t index_;
    bool isCaller_;
  };

  /// However the work was shared, the caller hears of the end, and can still stop.
  void reportEnd() {
    std::optional<Stage> stage;
    double reached = 0.0;
    {
      const Lock lock(mutex_);
      if (stopped_ || firstFailed_ != kNoIndex || !latest_) return;
      stage = latest_;
      reached = std::min(1.0, sum_[static_cast<std::size_t>(*stage)]);
    }
    static_cast<void>(tell(*stage, reached));
  }

  std::size_t take() {
    const Lock lock(mutex_);
    while (!stopped_ && taken_ < order_.size()) {
      const std::size_t i = order_[taken_++];
      if (i > firstFailed_) continue;
      ++running_;
      return i;
    }
    return kNoIndex;
  }

  /// Returns whether the piece shall go on.
  bool advance(std::size_t index, Stage stage, double more, bool isCaller) {
    double reached = 0.0;
    {
      const Lock lock(mutex_);
      double& sum = sum_[static_cast<std::size_t>(stage)];
      sum += more * shares_[index];
      reached = std::min(1.0, sum);
      latest_ = stage;
      if (stopped_ || index > firstFailed_) return false;
    }
    return !isCaller || tell(stage, reached);
  }

  /// \pre on the calling thread, without the lock
  bool tell(Stage stage, double fraction) {
    if (outer_.report(stage, fraction)) return true;
    const Lock lock(mutex_);
    stopped_ = true;
    return false;
  }

  std::optional<Error> attempt(std::size_t index, Progress& progress) {
#if defined(QMCF_HAS_THREADS)
    try {
      return work_(index, progress);
    } catch (...) {
      const Lock lock(mutex_);
      if (index < firstFailed_) fail(index, std::nullopt, std::current_exception());
      return std::nullopt;
    }
#else
    return work_(index, progress);
#endif
  }

  void finish(std::size_t index, std::optional<Error> error, const StageShares& done) {
    const Lock lock(mutex_);
    for (std::size_t s = 0; s < kStages; ++s) sum_[s] += (1.0 - done[s]) * shares_[index];
    if (error && index < firstFailed_) fail(index, std::move(error), nullptr);
    --running_;
    changed_.notify_one();
  }

#if defined(QMCF_HAS_THREADS)
  using Exception = std::exception_ptr;
#else
  using Exception = std::nullptr_t;
#endif

  void fail(std::size_t index, std::optional<Error> error, Exception exception) {
    firstFailed_ = index;
    error_ = std::move(error);
    exception_ = std::move(exception);
  }

#if defined(QMCF_HAS_THREADS)
  void stopWith(Exception exception) {
    const Lock lock(mutex_);
    stopped_ = true;
    exception_ = std::move(exception);
  }

  /// The caller has nothing left to do: it passes on what the others report until they are done as well.
  void reportUntilDone() {
    constexpr auto kInterval = std::chrono::milliseconds(20);
    for (;;) {
      std::optional<Stage> stage;
      double reached = 0.0;
      {
        Lock lock(mutex_);
        if (!stopped_ && running_ > 0) changed_.wait_for(lock, kInterval);
        if (stopped_ || running_ == 0) return;
        stage = latest_;
        if (stage) reached = std::min(1.0, sum_[static_cast<std::size_t>(*stage)]);
      }
      if (stage && !tell(*stage, reached)) return;
    }
  }
#endif

  const std::vector<double> shares_;
  const std::vector<std::size_t> order_;
  Progress& outer_;
  const IndexedWork& work_;

  std::mutex mutex_;  ///< Guards all that follows.
  std::condition_variable changed_;
  std::size_t taken_ = 0;  ///< Pieces of order_ that were handed out or left out.
  std::size_t running_ = 0;
  std::size_t firstFailed_ = kNoIndex;
  bool stopped_ = false;
  std::optional<Stage> latest_;
  StageShares sum_{};  ///< Per stage: share of the whole that is done.
  std::optional<Error> error_;
  Exception exception_ = nullptr;
};

}  // namespace

std::int32_t hardwareThreads() {
#if defined(QMCF_HAS_THREADS)
  return static_cast<std::int32_t>(std::max(1U, std::thread::hardware_concurrency()));
#else
  return 1;
#endif
}

std::optional<Error> parallelFor(const std::vector<double>& costs, std::int32_t threads, Progress& progress,
                                 const IndexedWork& work) {
  if (costs.empty()) return std::nullopt;
  return Pieces(costs, progress, work).run(threads);
}

}  // namespace qmcf
