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
#include <optional>
#include <string>

#include "qmcf/base/math.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

/// What ties the sum of the logarithms, which no turn tells: per share of the area.
constexpr double kShift = 1e-6;
/// Cotangents are clamped to this.
constexpr double kLargestCotangent = 1e3;
/// From an edge of the face on, sizes inside go back to those wanted within about so many elements. More spreads the
/// small elements of thin parts all over them, less makes rows end.
constexpr double kSpreadReach = 4.0;
/// What the turn of the field does to the sizes fades within about so many elements.
constexpr double kTurnReach = 8.0;
/// How far the logarithm of a size goes for the turn of the field, and for what a mesh came out with, either way.
constexpr double kMostForTurn = 0.3;
constexpr double kMostForMesh = 0.3;
/// A single edge counts for so much, whatever its length.
constexpr double kMostOfEdge = 1.0;

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
  const auto& turn = field.extraTurn[t];
  for (std::size_t c = 1; c < 3; ++c) {
    angle[c] = 0.25 * math::arg(cross[c] * std::conj(cross[0])) + turn[c] - turn[0];
  }
  return angle;
}

/// A term of the integral of |grad u|^2 over a triangle, between two of its corners.
struct StiffnessEntry {
  std::size_t row = 0;
  std::size_t column = 0;
  double value = 0.0;
};

double twiceAreaOf(const Surface& surface, TriangleId t) { return norm(surface.areaVector(t)); }

/// leastCotangent: 0 gives a matrix with no positive entry beside its diagonal, so that no solution leaves the range of
/// what it is made of. All zero for a triangle without an area.
std::array<StiffnessEntry, 12> stiffness(const Surface& surface, TriangleId t, double leastCotangent) {
  const auto corners = surface.corners(t);
  const auto at = [&](std::size_t c) -> const Vec3& { return surface.position(corners[c]); };
  const double twiceArea = twiceAreaOf(surface, t);
  std::array<StiffnessEntry, 12> entries;
  if (!(twiceArea > 0.0)) return entries;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = (c + 1) % 3;
    const std::size_t j = (c + 2) % 3;
    const double cotangent =
        std::clamp(dot(at(i) - at(c), at(j) - at(c)) / twiceArea, leastCotangent, kLargestCotangent);
    const double weight = 0.5 * cotangent;
    entries[4 * c] = {i, i, weight};
    entries[4 * c + 1] = {j, j, weight};
    entries[4 * c + 2] = {i, j, -weight};
    entries[4 * c + 3] = {j, i, -weight};
  }
  return entries;
}

/// leastCotangent: as for stiffness().
void addTriangle(System& system, const Surface& surface, const CrossField& field, TriangleId t,
                 const std::array<std::int32_t, 3>& unknown, double leastCotangent) {
  const double twiceArea = twiceAreaOf(surface, t);
  if (!(twiceArea > 0.0)) return;
  for (const StiffnessEntry& entry : stiffness(surface, t, leastCotangent)) {
    system.entries.emplace_back(unknown[entry.row], unknown[entry.column], entry.value);
  }
  const std::array<double, 3> angle = anglesIn(field, t);
  for (std::size_t c = 0; c < 3; ++c) {
    // The integral of the cross product of two linear functions' gradients needs no coordinates.
    system.side[unknown[c]] += 0.5 * (angle[(c + 1) % 3] - angle[(c + 2) % 3]);
    system.area[unknown[c]] += twiceArea / 6.0;
  }
}

/// The vertices inside a patch, numbered.
struct InnerUnknowns {
  explicit InnerUnknowns(const Surface& surface) {
    for (const VertexId v : surface.vertices()) of.push_back(surface.isBoundary(v) ? kNone : count++);
  }
  IdMap<VertexId, std::int32_t> of;  ///< kNone on the boundary.
  std::int32_t count = 0;
};

/// The minimum of a System over a patch and of what pulls its unknowns, the vertices inside, back to given values.
struct PulledSystem {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd side;

  /// The minimum; nothing if there is none to be had.
  [[nodiscard]] std::optional<Eigen::VectorXd> solve() const {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    Eigen::VectorXd values = factor.solve(side);
    if (factor.info() != Eigen::Success || !values.allFinite()) return std::nullopt;
    return values;
  }
};

/// value: per vertex what it is on the boundary, and pulled to inside from `reach` sizes on.
PulledSystem pulledSystem(const Patch& patch, const CrossField& field, const InnerUnknowns& inner,
                          const IdMap<VertexId, double>& value, double reach) {
  const Surface& surface = patch.surface;
  System all(static_cast<Eigen::Index>(surface.vertexCount()));
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    addTriangle(all, surface, field, t, {corners[0].value, corners[1].value, corners[2].value}, 0.0);
  }
  PulledSystem system;
  system.side = Eigen::VectorXd::Zero(inner.count);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Eigen::Triplet<double>& entry : all.entries) {
    const std::int32_t row = inner.of[VertexId(static_cast<std::int32_t>(entry.row()))];
    const VertexId other(static_cast<std::int32_t>(entry.col()));
    if (row == kNone) continue;
    if (inner.of[other] == kNone) {
      system.side[row] -= entry.value() * value[other];
    } else {
      entries.emplace_back(row, inner.of[other], entry.value());
    }
  }
  for (const VertexId v : surface.vertices()) {
    const std::int32_t i = inner.of[v];
    if (i == kNone) continue;
    const double length = reach * patch.size[v];
    const double pull = all.area[v.value] / (length * length);
    entries.emplace_back(i, i, pull);
    system.side[i] += pull * value[v] + all.side[v.value];
  }
  system.matrix.resize(inner.count, inner.count);
  system.matrix.setFromTriplets(entries.begin(), entries.end());
  return system;
}

/// The system behind sizesOfMesh().
PulledSystem meshSystem(const Patch& patch, const FaceMesh& mesh, const InnerUnknowns& inner) {
  const Surface& surface = patch.surface;
  PulledSystem system;
  system.side = Eigen::VectorXd::Zero(inner.count);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](VertexId row, VertexId column, double value) {
    if (inner.of[row] != kNone && inner.of[column] != kNone)
      entries.emplace_back(inner.of[row], inner.of[column], value);
  };
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    const double size = (patch.size[corners[0]] + patch.size[corners[1]] + patch.size[corners[2]]) / 3.0;
    for (const StiffnessEntry& entry : stiffness(surface, t, 0.0)) {
      add(corners[entry.row], corners[entry.column], size * size * entry.value);
    }
  }
  const std::vector<SizedEdge> edges = sizedEdges(patch, mesh);
  double mean = 0.0;
  if (inner.count == static_cast<std::int32_t>(surface.vertexCount())) {
    for (const SizedEdge& edge : edges) {
      mean += std::clamp(edge.log, -kMostOfEdge, kMostOfEdge) / static_cast<double>(edges.size());
    }
  }
  for (const SizedEdge& edge : edges) {
    // Half an element for each edge, half of that for each end.
    const double weight = 0.25 * edge.size * edge.size;
    const double log = std::clamp(edge.log - mean, -kMostOfEdge, kMostOfEdge);
    for (const std::int32_t end : edge.ends) {
      const SurfacePoint& point = mesh.locations[static_cast<std::size_t>(end)];
      const auto corners = surface.corners(point.triangle);
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = weight * point.barycentric[i];
        for (std::size_t j = 0; j < 3; ++j) add(corners[i], corners[j], share * point.barycentric[j]);
        if (inner.of[corners[i]] != kNone) system.side[inner.of[corners[i]]] += share * log;
      }
    }
  }
  system.matrix.resize(inner.count, inner.count);
  system.matrix.setFromTriplets(entries.begin(), entries.end());
  return system;
}

Error notComputed(const Patch& patch) {
  return {ErrorCode::internal,
          "The sizes inside face " + std::to_string(patch.face) + " could not be computed.",
          {patch.face}};
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
      addTriangle(system, surface, fields[p], t, {of[corners[0]], of[corners[1]], of[corners[2]]}, -kLargestCotangent);
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

Result<IdMap<VertexId, double>> spreadSizes(const Patch& patch, Progress& progress) {
  if (!progress.report(Stage::field, 0.0)) return cancelledError();
  IdMap<VertexId, double> sizes = patch.size;
  const InnerUnknowns inner(patch.surface);
  const auto [least, most] = std::minmax_element(sizes.raw().begin(), sizes.raw().end());
  if (inner.count == 0 || *least == *most) return sizes;
  // The unit of length has no influence.
  const double unit = *least;
  IdMap<VertexId, double> logs;
  for (const double size : sizes.raw()) logs.push_back(math::log(size / unit));
  const auto spread = pulledSystem(patch, CrossField{}, inner, logs, kSpreadReach).solve();
  if (!spread) return notComputed(patch);
  for (const VertexId v : patch.surface.vertices()) {
    if (inner.of[v] != kNone) sizes[v] = unit * math::exp((*spread)[inner.of[v]]);
  }
  return sizes;
}

Result<IdMap<VertexId, double>> turnedSizes(const Patch& patch, const CrossField& field, Progress& progress) {
  if (!progress.report(Stage::field, 1.0)) return cancelledError();
  IdMap<VertexId, double> sizes = patch.size;
  const InnerUnknowns inner(patch.surface);
  if (inner.count == 0 || field.cross.empty()) return sizes;
  const IdMap<VertexId, double> none(sizes.size(), 0.0);
  const auto logs = pulledSystem(patch, field, inner, none, kTurnReach).solve();
  if (!logs) return notComputed(patch);
  for (const VertexId v : patch.surface.vertices()) {
    if (inner.of[v] != kNone) sizes[v] *= math::exp(math::bent((*logs)[inner.of[v]], kMostForTurn));
  }
  return sizes;
}

std::vector<SizedEdge> sizedEdges(const Patch& patch, const FaceMesh& mesh) {
  std::vector<SizedEdge> edges;
  for (const std::array<std::int32_t, 2>& ends : edgesOf(mesh)) {
    const auto a = static_cast<std::size_t>(ends[0]);
    const auto b = static_cast<std::size_t>(ends[1]);
    const double size = 0.5 * (interpolate(patch.surface, patch.size, mesh.locations[a]) +
                               interpolate(patch.surface, patch.size, mesh.locations[b]));
    edges.push_back({ends, size, math::log(distance(mesh.positions[a], mesh.positions[b]) / size)});
  }
  return edges;
}

Result<IdMap<VertexId, double>> sizesOfMesh(const Patch& patch, const FaceMesh& mesh, Progress& progress) {
  if (!progress.report(Stage::field, 1.0)) return cancelledError();
  IdMap<VertexId, double> sizes = patch.size;
  const InnerUnknowns inner(patch.surface);
  if (inner.count == 0 || mesh.elements.empty()) return sizes;
  const auto logs = meshSystem(patch, mesh, inner).solve();
  if (!logs) return notComputed(patch);
  for (const VertexId v : patch.surface.vertices()) {
    if (inner.of[v] != kNone) sizes[v] *= math::exp(math::bent((*logs)[inner.of[v]], kMostForMesh));
  }
  return sizes;
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
