#include "stand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "cavity.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/quality/turned_over.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

constexpr int kDirections = 12;
/// How far a vertex is moved, in element sizes.
constexpr std::array<double, 5> kSteps{0.08, 0.2, 0.4, 0.7, 1.1};
/// Cosine of the angle to the surface and scaled Jacobian that are as good as any here.
constexpr double kUpright = 0.15;
constexpr double kSquare = 0.15;
constexpr double kClearlyUpright = 0.85;

/// A triangle of the face near an element, if one is known.
std::int32_t facetNear(const EditMesh& mesh, const std::array<HalfedgeId, 4>& sides) {
  for (const HalfedgeId h : sides) {
    if (h.valid() && mesh.vertex(mesh.origin(h)).facet != kNone) return mesh.vertex(mesh.origin(h)).facet;
  }
  return kNone;
}

/// An element and how it stands, found out step by step.
class Standing {
 public:
  Standing(const EditMesh& mesh, FaceId f) : mesh_(mesh), sides_(mesh.sides(f)), corners_(sides_[3].valid() ? 4 : 3) {
    for (std::size_t i = 0; i < corners_; ++i) places_[i] = mesh.position(mesh.origin(sides_[i]));
    if (corners_ == 4) own_ = normalized(cross(places_[2] - places_[0], places_[3] - places_[1]));
  }

  /// By its shape alone.
  [[nodiscard]] Stand shape() const {
    Stand stand;
    for (std::size_t i = 0; i < corners_; ++i) {
      const double square = squareAt(i, areaAt(i));
      stand.square = std::min(stand.square, square);
      stand.penalty += 2.0 * std::max(0.0, kSquare - square);
      stand.turnedOver = stand.turnedOver || square <= 0.0;
    }
    return stand;
  }

  /// Once the penalty is known to be as high as `most`, the rest is left out.
  [[nodiscard]] Stand on(const RelaxationTarget& target, double most) const {
    Vec3 centre;
    for (std::size_t i = 0; i < corners_; ++i) centre += places_[i] / static_cast<double>(corners_);
    const std::int32_t facet = facetNear(mesh_, sides_);
    std::optional<Vec3> belowCentre;
    Stand stand;
    for (std::size_t i = 0; i < corners_; ++i) {
      const Vec3 area = areaAt(i);
      const Vec3 normal = normalized(area);
      // Mostly the smooth normal at the corner tells enough.
      double upright = dot(normal, mesh_.normal(mesh_.origin(sides_[i])));
      if (upright < kClearlyUpright) {
        if (!belowCentre) belowCentre = target.face.normal(target.face.closest(centre, facet).triangle);
        upright = dot(normal, *belowCentre);
      }
      if (upright < kUpright) {
        const Vec3 quarter = places_[i] + (centre - places_[i]) * 0.25;
        upright = std::max(upright, dot(normal, target.face.normal(target.face.closest(quarter, facet).triangle)));
      }
      stand.penalty += std::max(0.0, kUpright - upright);
      const double square = squareAt(i, area);
      stand.square = std::min(stand.square, square);
      stand.penalty += 2.0 * std::max(0.0, kSquare - square);
      stand.turnedOver = stand.turnedOver || upright <= 0.0 || square <= 0.0;
      if (stand.penalty >= most) return stand;
    }
    if (target.part == nullptr) return stand;
    const std::int32_t near = facet == kNone ? kNone : target.part->triangleOf[static_cast<std::size_t>(facet)];
    const TriangleBvh& part = target.part->tree;
    const double by = turnedOverBy(part, places_, corners_, part.closest(centre, near));
    stand.turnedOver = stand.turnedOver || by > 0.0;
    stand.penalty += by;
    return stand;
  }

 private:
  [[nodiscard]] Vec3 forward(std::size_t i) const { return places_[(i + 1) % corners_] - places_[i]; }
  [[nodiscard]] Vec3 backward(std::size_t i) const { return places_[(i + corners_ - 1) % corners_] - places_[i]; }
  [[nodiscard]] Vec3 areaAt(std::size_t i) const { return cross(forward(i), backward(i)); }

  [[nodiscard]] double squareAt(std::size_t i, const Vec3& area) const {
    const double lengths = norm(forward(i)) * norm(backward(i));
    return corners_ == 4 && lengths > 0.0 ? dot(area, own_) / lengths : norm(area) / std::max(lengths, 1e-300);
  }

  const EditMesh& mesh_;
  std::array<HalfedgeId, 4> sides_;
  std::size_t corners_;
  std::array<Vec3, 4> places_;
  Vec3 own_;  ///< The normal of a quadrilateral.
};

}  // namespace

Stand shapeOf(const EditMesh& mesh, FaceId f) { return Standing(mesh, f).shape(); }

Stand standOf(const EditMesh& mesh, const RelaxationTarget& target, FaceId f, double most) {
  return Standing(mesh, f).on(target, most);
}

namespace {

/// The penalties of a vertex's elements together, found out only as far as it takes to tell that they are too high.
class PenaltyAround {
 public:
  PenaltyAround(const EditMesh& mesh, const RelaxationTarget& target, VertexId v) : mesh_(mesh), target_(target) {
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { faces_.push_back(mesh.face(h)); });
    penalties_.resize(faces_.size());
  }

  /// Their sum if it is less than `most`.
  std::optional<double> below(double most) {
    // Far more than the round-off of sums in different orders.
    constexpr double kSurely = 1.0 + 1e-12;
    double least = 0.0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      penalties_[i] = shapeOf(mesh_, faces_[i]).penalty;
      least += penalties_[i];
    }
    if (least >= kSurely * most) return std::nullopt;
    const std::size_t first = decisive_;
    for (std::size_t n = 0; n < faces_.size(); ++n) {
      const std::size_t i = (first + n) % faces_.size();
      const double others = least - penalties_[i];
      const double left = kSurely * most - others;
      penalties_[i] = standOf(mesh_, target_, faces_[i], left).penalty;
      least = others + penalties_[i];
      if (penalties_[i] < left) continue;
      decisive_ = i;
      return std::nullopt;
    }
    const double sum = std::accumulate(penalties_.begin(), penalties_.end(), 0.0);
    return sum < most ? std::optional(sum) : std::nullopt;
  }

 private:
  const EditMesh& mesh_;
  const RelaxationTarget& target_;
  std::vector<FaceId> faces_;
  std::vector<double> penalties_;
  std::size_t decisive_ = 0;  ///< The element that was too much last: likely it will be again.
};

}  // namespace

bool moveToBest(EditMesh& mesh, const RelaxationTarget& target, VertexId v) {
  constexpr double kWorthwhile = 0.98;
  PenaltyAround around(mesh, target, v);
  const double before = around.below(HUGE_VAL).value_or(HUGE_VAL);
  if (!(before > 0.0)) return false;
  const EditMesh::Vertex start = mesh.vertex(v);
  const double size = wantedSize(target, start);
  const Vec3 side = mesh.position(mesh.target(mesh.outgoing(v))) - start.position;
  const Vec3 x = normalized(tangentPart(side, start.normal));
  const Vec3 y = cross(start.normal, x);
  EditMesh::Vertex best = start;
  double least = before;
  for (const double step : kSteps) {
    for (int k = 0; k < kDirections; ++k) {
      const auto turn = math::unitComplex(2.0 * math::kPi * k / kDirections);
      const Vec3 aim = start.position + (x * turn.real() + y * turn.imag()) * (step * size);
      const EditMesh::Vertex moved = projectVertex(target, start, aim);
      mesh.setVertex(v, moved);
      const auto penalty = around.below(least);
      if (!penalty) continue;
      least = *penalty;
      best = moved;
    }
  }
  const bool helps = least < kWorthwhile * before;
  mesh.setVertex(v, helps ? best : start);
  return helps;
}

Damage damageAround(const EditMesh& mesh, const RelaxationTarget& target, const std::vector<VertexId>& vertices,
                    const Damage& most) {
  const std::vector<FaceId> faces = facesAround(mesh, vertices);
  // Shapes are found out with much less work.
  Damage byShape;
  for (const FaceId f : faces) byShape += shapeOf(mesh, f);
  if (!(byShape < most)) return byShape;
  Damage damage;
  for (const FaceId f : faces) {
    damage += standOf(mesh, target, f);
    if (!(damage < most)) break;
  }
  return damage;
}

}  // namespace qmcf
