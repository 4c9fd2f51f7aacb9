#include "choose_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "count_correction.hpp"
#include "join_faces.hpp"
#include "natural_scale.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

/// How often the faces are meshed again for a number of elements that is nearer to the one asked for, or with sizes
/// that fit the field. Large numbers come out nearer by themselves.
constexpr int kMostTrials = 2;
constexpr std::int64_t kManyElements = 10'000;
/// What a triangle is worth here: a row that ends costs about a tenth of this. In shapeCost() it is more, since where a
/// triangle can be avoided at all it shall be.
constexpr double kTriangleBadness = 0.5;

/// Faces that are not meshed by the first way tried.
std::ptrdiff_t fallbacks(const Trial& trial) {
  return std::count_if(trial.faces.begin(), trial.faces.end(),
                       [](const MeshedFace& face) { return !face.report.reason.empty(); });
}

/// The number of elements, once the faces are joined.
double elementCount(const Trial& trial, const MeshOptions& options) {
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  for (const MeshedFace& face : trial.faces) {
    quads += face.report.quads;
    triangles += face.report.triangles;
  }
  return static_cast<double>(options.allQuad ? 4 * quads + 3 * triangles : quads + triangles);
}

/// Meshes the faces with one choice of sizes after the other.
class SizeChoice {
 public:
  SizeChoice(const Part& part, Progress& progress) : part_(part), options_(part.options), progress_(progress) {}

  Result<ChosenSizes> run() {
    auto first = makeTrial(part_, options_, nullptr, progress_);
    if (!first) return first.error();
    chosen_.trial = std::move(first).value();
    chosen_.askedBase = chosen_.trial.prepared.size.base;
    int trials = kMostTrials;
    if (options_.fitSizes) {
      --trials;
      if (const auto error = fit()) return *error;
    }
    if (!options_.quads) return std::move(chosen_);
    if (*options_.quads > kManyElements) trials = std::min(trials, 1);
    if (const auto error = correct(*options_.quads, trials)) return *error;
    return std::move(chosen_);
  }

 private:
  [[nodiscard]] double count(const Trial& trial) const { return elementCount(trial, part_.options); }
  [[nodiscard]] const SizeScale* scale() const { return chosen_.scale.empty() ? nullptr : &chosen_.scale; }

  /// How far the elements are from squares, once the faces are relaxed together. Rows end at as many places as the root
  /// of the number of elements, so that trials with a few more or fewer compare.
  Result<double> badness(const Trial& trial) {
    SharedNodes shared = sharedNodes(trial.prepared.divided);
    std::vector<SharedFace> faces;
    for (const MeshedFace& face : trial.faces) faces.push_back(shareFace(face, trial.prepared));
    const std::vector<char> held(faces.size(), 0);
    const auto slid = relaxJoint(part_, trial.prepared, faces, held, shared, 1.0, progress_);
    if (!slid) return slid.error();
    double sum = 0.0;
    for (const SharedFace& face : faces) {
      const auto triangles = static_cast<double>(face.report.triangles);
      sum += shapeCost(face.mesh) - (kTriangleCost - kTriangleBadness) * triangles;
    }
    return sum / std::sqrt(std::max(count(trial), 1.0));
  }

  /// There is a mesh already: what else goes wrong is no reason to give that up.
  static std::optional<Error> onlyCancelled(const Error& error) {
    return error.code == ErrorCode::cancelled ? std::optional(error) : std::nullopt;
  }

  /// Tries sizes that fit the field.
  std::optional<Error> fit() {
    auto scale = naturalScale(part_.brep, chosen_.trial.prepared, progress_);
    if (!scale) return onlyCancelled(scale.error());
    if (scale.value().empty()) return std::nullopt;
    // For the same number as the first trial, or one of both would have more elements where they are needed.
    auto fitted = makeTrial(part_, options_, &scale.value(), progress_);
    if (!fitted) return onlyCancelled(fitted.error());
    const auto before = badness(chosen_.trial);
    if (!before) return before.error();
    const auto after = badness(fitted.value());
    if (!after) return after.error();
    if (fallbacks(fitted.value()) > fallbacks(chosen_.trial) || !(after.value() < before.value())) return std::nullopt;
    chosen_.trial = std::move(fitted).value();
    chosen_.scale = std::move(scale).value();
    chosen_.askedBase = chosen_.trial.prepared.size.base;
    return std::nullopt;
  }

  /// Tries numbers of elements that come out nearer to the one wanted.
  std::optional<Error> correct(std::int64_t wanted, int trials) {
    const auto miss = [wanted](double made) { return std::fabs(made - static_cast<double>(wanted)); };
    CountTrial tried{wanted, count(chosen_.trial)};
    options_.quads = correctedCount(tried, wanted);
    for (; trials > 0 && *options_.quads != tried.asked; --trials) {
      auto corrected = makeTrial(part_, options_, scale(), progress_);
      if (!corrected) return corrected.error();
      const CountTrial now{*options_.quads, count(corrected.value())};
      options_.quads = correctedCount(tried, now, wanted);
      if (miss(now.made) < miss(tried.made) && fallbacks(corrected.value()) <= fallbacks(chosen_.trial)) {
        chosen_.trial = std::move(corrected).value();
        tried = now;
      }
    }
    return std::nullopt;
  }

  const Part& part_;
  MeshOptions options_;
  Progress& progress_;
  ChosenSizes chosen_;
};

}  // namespace

Result<ChosenSizes> chooseSizes(const Part& part, Progress& progress) { return SizeChoice(part, progress).run(); }

}  // namespace qmcf
