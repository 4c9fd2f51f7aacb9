#include "choose_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "count_correction.hpp"
#include "natural_scale.hpp"
#include "prepare.hpp"
#include "settle_sizes.hpp"

namespace qmcf {
namespace {

/// How often the faces are meshed again for a number of elements that is nearer to the one asked for. Large numbers
/// come out nearer by themselves.
constexpr int kMostTrials = 2;
constexpr std::int64_t kManyElements = 10'000;
/// Share of the number that it is off by after all these from which on one more is tried, and up to which: small
/// features need more elements than are wanted.
constexpr double kFarOff = 0.05;
constexpr double kOutOfReach = 0.12;
/// The field hardly changes with the size: so many elements tell enough of it.
constexpr std::int64_t kFieldElements = 3000;
/// How often, from which share on, and up to which a larger base makes up for what settled sizes add to the number of
/// elements. Where small features are everywhere, larger elements between them would be of no use.
constexpr int kMostMakeUps = 2;
constexpr double kMadeUp = 0.04;
constexpr double kMostMadeUp = 1.5;

/// Faces that are not meshed by the first way tried.
std::ptrdiff_t fallbacks(const Trial& trial) {
  return std::count_if(trial.faces.begin(), trial.faces.end(),
                       [](const MeshedFace& face) { return !face.report.reason.empty(); });
}

/// The number of elements, once the faces are joined.
double elementCount(const Trial& trial, const RunOptions& options) {
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  for (const MeshedFace& face : trial.faces) {
    quads += face.report.quads;
    triangles += face.report.triangles;
  }
  return static_cast<double>(options.leftovers == Leftovers::cut ? 4 * quads + 3 * triangles : quads + triangles);
}

/// Meshes the faces with one choice of sizes after the other.
class SizeChoice {
 public:
  SizeChoice(const Part& part, Progress& progress) : part_(part), options_(part.options), progress_(progress) {}

  Result<ChosenSizes> run() {
    if (options_.fitSizes.value_or(false)) {
      if (const auto error = fit()) return *error;
    }
    if (!prepared_) {
      if (const auto error = prepare(options_, settlingOf(options_))) return *error;
    }
    if (options_.quads && options_.fitSizes.value_or(false)) {
      if (const auto error = makeUpForSettled()) return *error;
    }
    auto first = makeTrial(part_, options_, *std::exchange(prepared_, std::nullopt), progress_);
    if (!first) return first.error();
    chosen_.trial = std::move(first).value();
    chosen_.askedBase = chosen_.trial.prepared.size.base;
    if (!options_.quads) return std::move(chosen_);
    if (const auto error = correct(*part_.options.quads, *options_.quads > kManyElements ? 1 : kMostTrials))
      return *error;
    return std::move(chosen_);
  }

 private:
  [[nodiscard]] double count(const Trial& trial) const { return elementCount(trial, part_.options); }
  [[nodiscard]] const SizeScale* scale() const { return chosen_.scale.empty() ? nullptr : &chosen_.scale; }

  std::optional<Error> prepare(const RunOptions& options, Settling settling) {
    auto prepared = prepareFaces(part_.mesh, part_.brep, options, scale(), settling, limits_, progress_);
    if (!prepared) return prepared.error();
    prepared_ = std::move(prepared).value();
    limits_ = prepared_->size.limits;
    return std::nullopt;
  }

  /// The options for larger elements, if those that are asked for are many.
  [[nodiscard]] std::optional<RunOptions> coarser() const {
    const std::int64_t enough = options_.leftovers == Leftovers::cut ? 4 * kFieldElements : kFieldElements;
    double area = 0.0;
    for (const BrepFace& face : part_.brep.faces) area += face.area;
    const double least = std::sqrt(area / static_cast<double>(enough));
    RunOptions coarse = options_;
    if (options_.quads && *options_.quads > enough) {
      coarse.quads = enough;
    } else if (options_.size && *options_.size < least) {
      coarse.size = least;
    } else {
      return std::nullopt;
    }
    return coarse;
  }

  /// Finds sizes that fit the field. Without them the part is meshed with even ones, whatever the reason: there is
  /// nothing to be had then, or what fails here fails there, too.
  std::optional<Error> fit() {
    const auto onlyCancelled = [](const Error& error) {
      return error.code == ErrorCode::cancelled ? std::optional(error) : std::nullopt;
    };
    const std::optional<RunOptions> coarse = coarser();
    if (const auto error = prepare(coarse ? *coarse : options_, Settling::spread)) return onlyCancelled(*error);
    auto scale = naturalScale(part_.brep, *prepared_, progress_);
    if (!scale) {
      prepared_.reset();
      return onlyCancelled(scale.error());
    }
    chosen_.scale = std::move(scale).value();
    if (coarse || !chosen_.scale.empty()) {
      prepared_.reset();
      return std::nullopt;
    }
    // Even sizes are what this was prepared with.
    return turnSizes(*prepared_, prepared_->changed, options_, progress_);
  }

  /// Asks for fewer elements of the size field, so that with settled sizes there are as many as it would make without.
  std::optional<Error> makeUpForSettled() {
    double wanted = 0.0;
    for (const double elements : prepared_->wantedElements) wanted += elements;
    for (int round = 0; round < kMostMakeUps; ++round) {
      double settled = 0.0;
      for (const Patch& patch : prepared_->patches) settled += expectedElements(patch);
      if (std::fabs(settled / wanted - 1.0) < kMadeUp) break;
      const double enough = static_cast<double>(*options_.quads) * wanted / settled;
      const double least = static_cast<double>(*part_.options.quads) / kMostMadeUp;
      const std::int64_t fewer = roundedCount(std::max(enough, least));
      if (fewer == *options_.quads) break;
      options_.quads = fewer;
      if (const auto error = prepare(options_, settlingOf(options_))) return error;
    }
    return std::nullopt;
  }

  /// Tries numbers of elements that come out nearer to the one wanted.
  std::optional<Error> correct(std::int64_t wanted, int trials) {
    const auto miss = [wanted](double made) { return std::fabs(made - static_cast<double>(wanted)); };
    // What is asked of the field for as many elements as are wanted.
    const double share = static_cast<double>(*options_.quads) / static_cast<double>(wanted);
    CountTrial tried{wanted, count(chosen_.trial)};
    std::int64_t asked = correctedCount(tried, wanted);
    const auto isWorthAnother = [&] {
      const double off = miss(tried.made) / static_cast<double>(wanted);
      return off > kFarOff && off < kOutOfReach;
    };
    for (; asked != tried.asked && (trials > 0 || (trials == 0 && isWorthAnother())); --trials) {
      options_.quads = roundedCount(static_cast<double>(asked) * share);
      if (const auto error = prepare(options_, settlingOf(options_))) return error;
      auto corrected = makeTrial(part_, options_, *std::exchange(prepared_, std::nullopt), progress_);
      if (!corrected) return corrected.error();
      const CountTrial now{asked, count(corrected.value())};
      asked = correctedCount(tried, now, wanted);
      if (miss(now.made) < miss(tried.made) && fallbacks(corrected.value()) <= fallbacks(chosen_.trial)) {
        chosen_.trial = std::move(corrected).value();
        tried = now;
      }
    }
    return std::nullopt;
  }

  const Part& part_;
  RunOptions options_;
  Progress& progress_;
  std::optional<PreparedFaces> prepared_;  ///< For the next trial.
  std::vector<SizeLimit> limits_;          ///< Where elements have to be smaller whatever their number.
  ChosenSizes chosen_;
};

}  // namespace

Result<ChosenSizes> chooseSizes(const Part& part, Progress& progress) { return SizeChoice(part, progress).run(); }

}  // namespace qmcf
