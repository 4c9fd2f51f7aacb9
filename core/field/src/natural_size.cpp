// The size field that goes with a cross field, as the scaling that Gmsh computes for its quasi-structured meshes
// (Reberol, Georgiadis and Remacle 2021), here over all faces of a part at once.
#include "qmcf/field/natural_size.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// What ties the sum of the logarithms, which no turn tells: per share of the area.
constexpr double kShift = 1e-6;
/// Cotangents are clamped to this.
constexpr double kLargestCotangent = 1e3;

/// Numbers the vertices of all patches: nodes have theirs, those inside follow.
class Unknowns {
 public:
  explicit Unknowns(const std::vector<Patch>& patches) {
    for (const Patch& patch : patches) {
      for (const std::int32_t node : patch.node.raw()) count_ = std::max(count_, node + 1);
    }
    for (const Patch& patch : patches) {
      IdMap<VertexId, std::int32_t>& of = of_.emplace_back();
      for (const std::int32_t node : patch.node.raw()) of.push_back(node == kNone ? count_++ : node);
    }
  }
  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] const IdMap<VertexId, std::int32_t>& of(std::size_t patch) const { return of_[patch]; }

 private:
  std::int32_t count_ = 0;
  std::vector<IdMap<VertexId, std::int32_t>> of_;
};

/// The sum over the triangles of the integral of |grad u - g|^2, g being what the field asks for.
struct System {
  explicit System(Eigen::Index count) : side(Eigen::VectorXd::Zero(count)), area(Eigen::VectorXd::Zero(count)) {}

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd side;
  Eigen::VectorXd area;  ///< Per unknown: a third of the triangles around it.
};

/// Angles of the field at the corners of a triangle, relative to the first one's.
std::array<double, 3> anglesIn(const CrossField& field, TriangleId t) {
  std::array<double, 3> angle{};
  // Around a singularity they are not those of one function.
  if (field.cross.empty() || field.index[t] != 0) return angle;
  const auto& cross = field.corner[t];
  const auto& turn = field.tangentTurn[t];
  for (std::size_t c = 1; c < 3; ++c) {
    angle[c] = 0.25 * math::arg(cross[c] * std::conj(cross[0])) + turn[c] - turn[0];
  }
  return angle;
}

void addTriangle(System& system, const Surface& surface, const CrossField& field, TriangleId t,
                 const std::array<std::int32_t, 3>& unknown) {
  const auto corners = surface.corners(t);
  const auto at = [&](std::size_t c) -> const Vec3& { return surface.position(corners[c % 3]); };
  const double twiceArea = norm(cross(at(1) - at(0), at(2) - at(0)));
  if (!(twiceArea > 0.0)) return;
  const std::array<double, 3> angle = anglesIn(field, t);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = (c + 1) % 3;
    const std::size_t j = (c + 2) % 3;
    const double cotangent =
        std::clamp(dot(at(i) - at(c), at(j) - at(c)) / twiceArea, -kLargestCotangent, kLargestCotangent);
    const double weight = 0.5 * cotangent;
    system.entries.emplace_back(unknown[i], unknown[i], weight);
    system.entries.emplace_back(unknown[j], unknown[j], weight);
    system.entries.emplace_back(unknown[i], unknown[j], -weight);
    system.entries.emplace_back(unknown[j], unknown[i], -weight);
    // The integral of the cross product of two linear functions' gradients needs no coordinates.
    system.side[unknown[c]] += 0.5 * (angle[i] - angle[j]);
    system.area[unknown[c]] += twiceArea / 6.0;
  }
}

/// The integral of expectedRowEnds() over a triangle.
double rowEndsIn(const Patch& patch, const CrossField& field, const IdMap<VertexId, double>& logs, TriangleId t) {
  const auto corners = patch.surface.corners(t);
  const auto at = [&](std::size_t c) -> const Vec3& { return patch.surface.position(corners[c % 3]); };
  const Vec3 area = cross(at(1) - at(0), at(2) - at(0));
  const double twiceArea = norm(area);
  if (!(twiceArea > 0.0)) return 0.0;
  const std::array<double, 3> angle = anglesIn(field, t);
  Vec3 growth;
  Vec3 turn;
  double even = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double log = math::log(patch.size[corners[c]]) + logs[corners[c]];
    // Turned by a right angle and times twice the area: the gradient of the function that is 1 at this corner.
    const Vec3 opposite = at(c + 1) - at(c + 2);
    growth += opposite * log;
    turn += opposite * angle[c];
    even += patch.size[corners[c]] / 3.0;
  }
  return 0.5 * norm(growth + cross(area / twiceArea, turn)) / even;
}

}  // namespace

Result<std::vector<IdMap<VertexId, double>>> naturalSizes(const std::vector<Patch>& patches,
                                                          const std::vector<CrossField>& fields, Progress& progress) {
  if (!progress.report(Stage::field, 1.0)) return cancelledError();
  const Unknowns unknowns(patches);
  System system(unknowns.count());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Surface& surface = patches[p].surface;
    for (const TriangleId t : surface.triangles()) {
      const auto corners = surface.corners(t);
      const auto& of = unknowns.of(p);
      addTriangle(system, surface, fields[p], t, {of[corners[0]], of[corners[1]], of[corners[2]]});
    }
  }
  const double area = system.area.sum();
  for (Eigen::Index i = 0; i < unknowns.count(); ++i) {
    // Nodes that no patch has are tied to 0.
    system.entries.emplace_back(i, i, system.area[i] > 0.0 ? kShift * system.area[i] / area : 1.0);
  }
  Eigen::SparseMatrix<double> matrix(unknowns.count(), unknowns.count());
  matrix.setFromTriplets(system.entries.begin(), system.entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Eigen::VectorXd logs = factor.solve(system.side);
  if (factor.info() != Eigen::Success || !logs.allFinite()) {
    return Error{ErrorCode::internal, "The sizes that fit the cross field could not be computed.", {}};
  }
  const double mean = logs.dot(system.area) / area;
  std::vector<IdMap<VertexId, double>> result(patches.size());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const std::int32_t i : unknowns.of(p).raw()) result[p].push_back(logs[i] - mean);
  }
  return result;
}

double expectedRowEnds(const std::vector<Patch>& patches, const std::vector<CrossField>& fields,
                       const std::vector<IdMap<VertexId, double>>& logs) {
  double sum = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (fields[p].cross.empty()) continue;
    for (const TriangleId t : patches[p].surface.triangles()) {
      if (fields[p].index[t] == 0) sum += rowEndsIn(patches[p], fields[p], logs[p], t);
    }
  }
  return sum;
}

}  // namespace qmcf
