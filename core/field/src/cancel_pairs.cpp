#include "cancel_pairs.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "qmcf/base/math.hpp"
#include "singularities.hpp"

namespace qmcf {
namespace {

constexpr int kRounds = 4;
constexpr double kReach = 8.0;        // elements within which a pair is removed when that lowers the energy
constexpr double kMargin = 4.0;       // elements around a pair that are smoothed
constexpr double kCloseGrowth = 2.0;  // of the energy around that removing a close pair may cost
constexpr double kFar = std::numeric_limits<double>::infinity();

using RealMatrix = Eigen::SparseMatrix<double>;

/// A way through triangles from a singularity to one of opposite sign.
struct Pair {
  double distance = 0.0;  ///< In elements.
  TriangleId start;
  TriangleId end;
  std::vector<HalfedgeId> crossed;  ///< From start to end, each in the triangle that is left.
};

class Canceller {
 public:
  Canceller(const Patch& patch, const Connection& connection, const FieldMatrices& matrices,
            const FieldConditions& conditions, double close, FieldVector& field)
      : patch_(patch),
        surface_(patch.surface),
        connection_(connection),
        matrices_(matrices),
        conditions_(conditions),
        close_(close),
        cross_(patch.surface.vertexCount()),
        far_(patch.surface.triangleCount(), kFar),
        from_(patch.surface.triangleCount()),
        near_(patch.surface.vertexCount(), kFar),
        unknown_(patch.surface.vertexCount(), kNone),
        jump_(patch.surface.halfedgeCount(), 0) {
    cross_.raw().assign(field.data(), field.data() + field.size());
    index_ = triangleIndices(surface_, connection_, cross_);
  }

  Result<std::int32_t> round(Progress& progress) {
    std::vector<Pair> pairs;
    for (const TriangleId t : surface_.triangles()) {
      if (index_[t] > 0) findPair(t, pairs);
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return std::tie(a.distance, a.start, a.end) < std::tie(b.distance, b.start, b.end);
    });
    std::int32_t removed = 0;
    for (const Pair& pair : pairs) {
      if (!progress.report(Stage::field, 0.92)) return cancelledError();
      if (index_[pair.start] > 0 && index_[pair.end] < 0 && remove(pair)) ++removed;
    }
    return removed;
  }

  [[nodiscard]] const IdMap<VertexId, Complex>& cross() const { return cross_; }

 private:
  [[nodiscard]] double sizeAlong(HalfedgeId h) const {
    return 0.5 * (patch_.size[surface_.origin(h)] + patch_.size[surface_.target(h)]);
  }
  [[nodiscard]] bool pinned(VertexId v) const { return conditions_.isPinned(v); }
  [[nodiscard]] double pull(VertexId v) const { return conditions_.pull[v.value] * matrices_.area[v.value]; }
  [[nodiscard]] Vec3 centre(TriangleId t) const { return positionOf(surface_, {t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}); }

  /// The nearest triangle of negative index, through edges whose turn can still change.
  void findPair(TriangleId start, std::vector<Pair>& pairs) {
    using Entry = std::pair<double, TriangleId>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<TriangleId> reached{start};
    far_[start] = 0.0;
    queue.emplace(0.0, start);
    while (!queue.empty()) {
      const auto [distance, t] = queue.top();
      queue.pop();
      if (distance > far_[t]) continue;
      if (index_[t] < 0) {
        pairs.push_back({distance, start, t, wayTo(start, t)});
        break;
      }
      for (int c = 0; c < 3; ++c) {
        const HalfedgeId h = Surface::halfedge(t, c);
        if (surface_.isBoundary(h) || (pinned(surface_.origin(h)) && pinned(surface_.target(h)))) continue;
        const TriangleId next = Surface::triangle(surface_.twin(h));
        const double further = far_[t] + qmcf::distance(centre(t), centre(next)) / sizeAlong(h);
        if (further > kReach || further >= far_[next]) continue;
        if (far_[next] == kFar) reached.push_back(next);
        far_[next] = further;
        from_[next] = h;
        queue.emplace(further, next);
      }
    }
    for (const TriangleId t : reached) far_[t] = kFar;
  }

  [[nodiscard]] std::vector<HalfedgeId> wayTo(TriangleId start, TriangleId end) const {
    std::vector<HalfedgeId> way;
    for (TriangleId t = end; t != start; t = Surface::triangle(from_[t])) way.push_back(from_[t]);
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// The free vertices within kMargin elements of the pair's way, in ascending order.
  [[nodiscard]] std::vector<VertexId> region(const Pair& pair) {
    using Entry = std::pair<double, VertexId>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<VertexId> reached;
    const auto reach = [&](VertexId v, double distance) {
      if (distance > kMargin || distance >= near_[v]) return;
      if (near_[v] == kFar) reached.push_back(v);
      near_[v] = distance;
      queue.emplace(distance, v);
    };
    for (const HalfedgeId h : pair.crossed) {
      reach(surface_.origin(h), 0.0);
      reach(surface_.target(h), 0.0);
    }
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > near_[v] || pinned(v)) continue;
      surface_.forEachOutgoing(v, [&, from = distance](HalfedgeId h) {
        reach(surface_.target(h), from + surface_.length(h) / sizeAlong(h));
      });
    }
    for (const VertexId v : reached) near_[v] = kFar;
    std::erase_if(reached, [&](VertexId v) { return pinned(v); });
    std::sort(reached.begin(), reached.end());
    return reached;
  }

  /// Turn of u along h with the full turns that the pair's way adds.
  [[nodiscard]] double wantedTurn(HalfedgeId h) const {
    return crossTurn(surface_, connection_, cross_, h) + 2.0 * math::kPi * jump_[h];
  }

  /// Smooths the angles of the region's crosses with the turns along all edges given up to a gradient.
  [[nodiscard]] bool smooth(const std::vector<VertexId>& free) {
    for (std::size_t i = 0; i < free.size(); ++i) unknown_[free[i]] = static_cast<std::int32_t>(i);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd side = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
    const auto couple = [&](VertexId v, VertexId w, double turn) {
      const double weight = std::sqrt(std::norm(matrices_.energy.coeff(v.value, w.value)));
      entries.emplace_back(unknown_[v], unknown_[v], weight);
      if (unknown_[w] != kNone) entries.emplace_back(unknown_[v], unknown_[w], -weight);
      side[unknown_[v]] += weight * turn;
    };
    for (const VertexId v : free) {
      entries.emplace_back(unknown_[v], unknown_[v], pull(v));
      side[unknown_[v]] += pull(v) * math::arg(conditions_.guide[v.value] * std::conj(cross_[v]));
      surface_.forEachOutgoing(v, [&](HalfedgeId h) {
        couple(v, surface_.target(h), wantedTurn(h));
        const HalfedgeId before = Surface::prev(h);
        if (surface_.isBoundary(before)) couple(v, surface_.origin(before), -wantedTurn(before));
      });
    }
    RealMatrix system(side.size(), side.size());
    system.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<RealMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factor(system);
    for (const VertexId v : free) unknown_[v] = kNone;
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd turn = factor.solve(side);
    for (std::size_t i = 0; i < free.size(); ++i) {
      cross_[free[i]] *= math::unitComplex(turn[static_cast<Eigen::Index>(i)]);
    }
    return true;
  }

  /// Energy of the crosses given, as far as it depends on the region. Edges inside it count twice, those to pinned and
  /// other crosses around once: a pair may go where the field inside gets smoother and leans a little more on these.
  [[nodiscard]] double energy(const std::vector<VertexId>& free) const {
    double sum = 0.0;
    for (const VertexId v : free) {
      surface_.forEachOutgoing(v, [&](HalfedgeId h) {
        const double weight = std::sqrt(std::norm(matrices_.energy.coeff(v.value, surface_.target(h).value)));
        sum += weight * (1.0 - math::cos(crossTurn(surface_, connection_, cross_, h)));
      });
      sum += pull(v) * (1.0 - (cross_[v] * std::conj(conditions_.guide[v.value])).real());
    }
    return sum;
  }

  /// The triangles with a corner in the region, and their indices as the crosses are now.
  [[nodiscard]] std::vector<std::pair<TriangleId, std::int32_t>> indicesAround(
      const std::vector<VertexId>& free) const {
    std::vector<std::pair<TriangleId, std::int32_t>> indices;
    for (const VertexId v : free) {
      surface_.forEachOutgoing(v, [&](HalfedgeId h) { indices.emplace_back(Surface::triangle(h), 0); });
    }
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    for (auto& [t, index] : indices) index = triangleIndex(surface_, connection_, cross_, t);
    return indices;
  }

  bool remove(const Pair& pair) {
    const std::vector<VertexId> free = region(pair);
    if (free.empty()) return false;
    std::vector<Complex> before;
    before.reserve(free.size());
    for (const VertexId v : free) before.push_back(cross_[v]);
    for (const HalfedgeId h : pair.crossed) {
      jump_[h] = -1;
      jump_[surface_.twin(h)] = 1;
    }
    const double energyBefore = energy(free);
    const bool solved = smooth(free);
    for (const HalfedgeId h : pair.crossed) jump_[h] = jump_[surface_.twin(h)] = 0;
    const auto after = indicesAround(free);
    std::int32_t change = 0;
    for (const auto& [t, index] : after) change += std::abs(index) - std::abs(index_[t]);
    const double allowed = pair.distance < close_ ? kCloseGrowth * energyBefore : energyBefore;
    if (solved && change < 0 && energy(free) <= allowed) {
      for (const auto& [t, index] : after) index_[t] = index;
      return true;
    }
    for (std::size_t i = 0; i < free.size(); ++i) cross_[free[i]] = before[i];
    return false;
  }

  const Patch& patch_;
  const Surface& surface_;
  const Connection& connection_;
  const FieldMatrices& matrices_;
  const FieldConditions& conditions_;
  double close_;
  IdMap<VertexId, Complex> cross_;
  IdMap<TriangleId, std::int32_t> index_;
  IdMap<TriangleId, double> far_;
  IdMap<TriangleId, HalfedgeId> from_;
  IdMap<VertexId, double> near_;
  IdMap<VertexId, std::int32_t> unknown_;
  IdMap<HalfedgeId, std::int32_t> jump_;
};

}  // namespace

Result<std::int32_t> cancelPairs(const Patch& patch, const Connection& connection, const FieldMatrices& matrices,
                                 const FieldConditions& conditions, double distance, FieldVector& field,
                                 Progress& progress) {
  Canceller canceller(patch, connection, matrices, conditions, distance, field);
  std::int32_t total = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Result<std::int32_t> removed = canceller.round(progress);
    if (!removed) return removed.error();
    total += removed.value();
    if (removed.value() == 0) break;
  }
  const auto& cross = canceller.cross().raw();
  std::copy(cross.begin(), cross.end(), field.data());
  return total;
}

}  // namespace qmcf
