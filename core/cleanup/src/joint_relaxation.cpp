// Relaxation across the edges of the B-rep: the faces' meshes stay their own, the nodes that they share move in all.
#include "qmcf/cleanup/joint_relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lift_worst.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/extract.hpp"
#include "qmcf/spatial/surface_walk.hpp"
#include "relaxation.hpp"

namespace qmcf {
namespace {

/// Relaxation may make elements that are better than this worse.
constexpr double kEnough = 0.6;
/// Elements that are worse in the end are made as good as they can be.
constexpr double kLifted = 0.6;
constexpr int kLiftRounds = 3;
constexpr std::array<double, 3> kLifts{0.2, 0.1, 0.05};  ///< Steps of nodes for that, in element sizes.
constexpr double kGain = 1e-3;                           ///< The least that is worth a step.
/// A node moves at most so far towards the next one at a time, in units of their distance.
constexpr double kLongestStep = 0.4;
/// The tangent at a node is that of the chord between points so far towards its neighbours.
constexpr double kTangentReach = 0.2;
/// Divisions don't get shorter than this part of what they were.
constexpr double kShortest = 0.5;
/// Shorter moves, in element sizes, do not count.
constexpr double kStill = 1e-3;
/// Chords that are nearer to their edge than this, in element sizes, may depart further.
constexpr double kNear = 0.05;
/// Vertices so many elements away from a moved node are relaxed with it.
constexpr int kRings = 2;
constexpr int kSlidesPerRound = 3;
constexpr int kSweepsPerRound = 3;

/// A vertex of one face's mesh that is a shared node.
struct Occurrence {
  std::size_t face = 0;
  VertexId vertex;
};

/// A node that may slide along its edge.
struct Slider {
  std::size_t edge = 0;
  std::size_t index = 0;  ///< Among the edge's nodes.
};

/// The curve at any arc length; a closed one goes on and on.
Vec3 pointAt(const EdgeCurve& curve, double s) {
  if (!curve.closed) return curve.at(s);
  const double turns = std::floor(s / curve.length());
  return curve.at(s - turns * curve.length());
}

/// The largest distance of the curve's corners between two arc lengths from the chord between them.
double departure(const EdgeCurve& curve, double from, double to) {
  const Vec3 a = pointAt(curve, from);
  const Vec3 chord = pointAt(curve, to) - a;
  const double square = squaredNorm(chord);
  double largest = 0.0;
  const auto visit = [&](double begin, double end) {
    auto s = std::upper_bound(curve.arcLength.begin(), curve.arcLength.end(), begin);
    for (; s != curve.arcLength.end() && *s < end; ++s) {
      const Vec3 arm = curve.points[static_cast<std::size_t>(s - curve.arcLength.begin())] - a;
      const double along = square > 0.0 ? std::clamp(dot(arm, chord) / square, 0.0, 1.0) : 0.0;
      largest = std::max(largest, norm(arm - chord * along));
    }
  };
  const double length = curve.length();
  if (!curve.closed) {
    visit(from, to);
    return largest;
  }
  const double turns = std::floor(from / length) * length;
  visit(from - turns, std::min(to - turns, length));
  if (to - turns > length) {
    visit(-1.0, to - turns - length);  // From the point where the curve closes, itself included.
  }
  return largest;
}

class JointRelaxation {
 public:
  JointRelaxation(std::vector<JointFace>& faces, const std::vector<JointEdge>& edges, std::vector<Vec3>& nodes,
                  const JointRelaxationOptions& options)
      : faces_(faces), edges_(edges), nodes_(nodes), options_(options), occurrences_(nodes.size()) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      meshes_.emplace_back(*faces[f].mesh);
      if (faces[f].mesh->elements.empty()) continue;
      for (std::size_t v = 0; v < faces[f].node->size(); ++v) {
        const std::int32_t node = (*faces[f].node)[v];
        if (node != kNone && meshes_[f].alive(VertexId(v))) {
          occurrences_[static_cast<std::size_t>(node)].push_back({f, VertexId(v)});
        }
      }
    }
    for (std::size_t f = 0; f < faces.size(); ++f) stays_.push_back(heldVertices(f));
    for (std::size_t e = 0; e < edges.size(); ++e) {
      places_.push_back(edges[e].arcLength);
      for (std::size_t i = edges[e].slidesAtStart ? 0 : 1; i + 1 < edges[e].nodes.size(); ++i) {
        const std::vector<double>& stays = edges[e].stays;
        if (std::binary_search(stays.begin(), stays.end(), edges[e].arcLength[i])) continue;
        const std::vector<Occurrence>& at = occurrences_[nodeOf({e, i})];
        const bool isHeld = std::any_of(at.begin(), at.end(), [&](const Occurrence& o) {
          return faces[o.face].held || stays_[o.face][o.vertex] != 0;
        });
        if (!isHeld) sliders_.push_back({e, i});
      }
    }
  }

  Result<std::int64_t> run(Progress& progress) {
    const std::vector<Vec3> before = nodes_;
    std::vector<LazyRelaxation> relaxations;
    for (std::size_t f = 0; f < meshes_.size(); ++f) {
      relaxations.emplace_back(meshes_[f], targetOf(f), kEnough, false);
      relaxations.back().hold(stays_[f]);
    }
    for (int round = 0; round < options_.rounds; ++round) {
      if (!progress.report(Stage::cleanup, static_cast<double>(round) / options_.rounds)) return cancelledError();
      std::vector<std::vector<VertexId>> moved(meshes_.size());
      bool isStill = true;
      for (int i = 0; i < kSlidesPerRound; ++i) {
        for (const Slider& slider : sliders_) {
          if (!slide(slider)) continue;
          isStill = false;
          for (const Occurrence& at : occurrences_[nodeOf(slider)]) moved[at.face].push_back(at.vertex);
        }
      }
      if (isStill) break;
      for (std::size_t f = 0; f < meshes_.size(); ++f) {
        if (moved[f].empty()) continue;
        relaxations[f].wake(around(meshes_[f], moved[f]));
        for (int i = 0; i < kSweepsPerRound && relaxations[f].sweep(); ++i) {
        }
        meshes_[f].commit();
      }
    }
    if (!liftAll(progress)) return cancelledError();
    for (std::size_t f = 0; f < meshes_.size(); ++f) *faces_[f].mesh = extract(meshes_[f], faces_[f].mesh->patchVertex);
    return countMoved(before);
  }

 private:
  /// Per vertex of a face's mesh, 1 if it is in one of the held places.
  [[nodiscard]] IdMap<VertexId, char> heldVertices(std::size_t face) const {
    const std::vector<Ball>& places = faces_[face].heldPlaces;
    const EditMesh& mesh = meshes_[face];
    IdMap<VertexId, char> stays(mesh.vertexCapacity(), 0);
    if (places.empty()) return stays;
    for (const VertexId v : IdRange<VertexId>(stays.size())) {
      if (!mesh.alive(v)) continue;
      const bool isHeld = std::any_of(places.begin(), places.end(), [&](const Ball& place) {
        return squaredNorm(mesh.position(v) - place.centre) <= place.radius * place.radius;
      });
      stays[v] = isHeld ? 1 : 0;
    }
    return stays;
  }

  /// Makes the worst elements better. Returns false when progress asked to stop.
  bool liftAll(Progress& progress) {
    std::vector<WorstLift> lifts;
    for (std::size_t f = 0; f < meshes_.size(); ++f) lifts.emplace_back(meshes_[f], targetOf(f), kLifted, stays_[f]);
    for (int round = 0; round < kLiftRounds; ++round) {
      if (!progress.report(Stage::cleanup, 1.0)) return false;
      bool isStill = true;
      for (std::size_t f = 0; f < meshes_.size(); ++f) {
        if (!faces_[f].held && lifts[f].run()) isStill = false;
      }
      for (const Slider& slider : sliders_) {
        if (!lift(slider)) continue;
        isStill = false;
        for (const Occurrence& at : occurrences_[nodeOf(slider)]) lifts[at.face].wakeAround(at.vertex);
      }
      for (EditMesh& mesh : meshes_) mesh.commit();
      if (isStill) break;
    }
    return true;
  }

  [[nodiscard]] std::size_t nodeOf(const Slider& slider) const {
    return static_cast<std::size_t>(edges_[slider.edge].nodes[slider.index]);
  }

  [[nodiscard]] RelaxationTarget targetOf(std::size_t face) const {
    return {*faces_[face].patch, *faces_[face].target, options_.sizeScale};
  }

  [[nodiscard]] double sizeAt(const Occurrence& at) const {
    const Patch& patch = *faces_[at.face].patch;
    return options_.sizeScale * interpolate(patch.surface, patch.size, meshes_[at.face].vertex(at.vertex).location);
  }

  /// Where the elements of all faces want a node.
  [[nodiscard]] Vec3 wanted(const std::vector<Occurrence>& occurrences) const {
    Vec3 sum;
    int count = 0;
    for (const Occurrence& at : occurrences) {
      const EditMesh& mesh = meshes_[at.face];
      const double size = sizeAt(at);
      mesh.forEachOutgoing(at.vertex, [&](HalfedgeId h) {
        sum += idealCorner(mesh, h, mesh.normal(at.vertex), size);
        ++count;
      });
    }
    return sum / count;
  }

  [[nodiscard]] double worstAround(const std::vector<Occurrence>& occurrences) const {
    double worst = 1.0;
    for (const Occurrence& at : occurrences) worst = std::min(worst, worstShapeAround(meshes_[at.face], at.vertex));
    return worst;
  }

  [[nodiscard]] double worstSquare(const std::vector<Occurrence>& occurrences) const {
    double worst = 1.0;
    for (const Occurrence& at : occurrences) worst = std::min(worst, worstSquareAround(meshes_[at.face], at.vertex));
    return worst;
  }

  /// Arc lengths of the nodes before and after one; on a closed edge they may lie before its start or past its end.
  [[nodiscard]] std::array<double, 2> neighbours(const std::vector<double>& s, const Slider& slider) const {
    const double before = slider.index > 0 ? s[slider.index - 1] : s[s.size() - 2] - edges_[slider.edge].curve.length();
    return {before, s[slider.index + 1]};
  }

  /// How far a node may go back and ahead along its edge in one step.
  [[nodiscard]] std::array<double, 2> room(const Slider& slider) const {
    const std::vector<double>& places = places_[slider.edge];
    const double s = places[slider.index];
    const auto [before, after] = neighbours(places, slider);
    const auto [firstBefore, firstAfter] = neighbours(edges_[slider.edge].arcLength, slider);
    const double first = edges_[slider.edge].arcLength[slider.index];
    return {std::clamp(s - before - kShortest * (first - firstBefore), 0.0, kLongestStep * (s - before)),
            std::clamp(after - s - kShortest * (firstAfter - first), 0.0, kLongestStep * (after - s))};
  }

  /// Moves a node along its edge to where its elements want it. Returns whether it moved.
  bool slide(const Slider& slider) {
    const std::size_t node = nodeOf(slider);
    const std::vector<Occurrence>& occurrences = occurrences_[node];
    if (occurrences.empty()) return false;
    const EdgeCurve& curve = edges_[slider.edge].curve;
    const double s = places_[slider.edge][slider.index];
    const auto [before, after] = neighbours(places_[slider.edge], slider);
    const auto [back, ahead] = room(slider);
    const Vec3 tangent =
        normalized(pointAt(curve, s + kTangentReach * (after - s)) - pointAt(curve, s - kTangentReach * (s - before)));
    const double size = sizeAt(occurrences.front());
    const double step = std::clamp(dot(wanted(occurrences) - nodes_[node], tangent), -back, ahead);
    return std::abs(step) > kStill * size && move(slider, step, std::min(kEnough, worstAround(occurrences)));
  }

  /// Moves a node along its edge to where the worst of its elements is better, if that is a bad one. Returns whether it
  /// moved.
  bool lift(const Slider& slider) {
    const std::vector<Occurrence>& occurrences = occurrences_[nodeOf(slider)];
    if (occurrences.empty()) return false;
    const double worst = worstAround(occurrences);
    if (worst >= kLifted) return false;
    const double size = sizeAt(occurrences.front());
    const auto [back, ahead] = room(slider);
    for (const double length : kLifts) {
      for (const double step : {-std::min(length * size, back), std::min(length * size, ahead)}) {
        if (std::abs(step) > kStill * size && move(slider, step, worst + kGain)) return true;
      }
    }
    return false;
  }

  /// Moves a node along its edge, in all faces, unless an element is worse than `least` then, or a chord departs
  /// further from the edge than before. Returns whether it moved.
  bool move(const Slider& slider, double step, double least) {
    const std::size_t node = nodeOf(slider);
    const std::vector<Occurrence>& occurrences = occurrences_[node];
    const EdgeCurve& curve = edges_[slider.edge].curve;
    const double s = places_[slider.edge][slider.index];
    const auto [before, after] = neighbours(places_[slider.edge], slider);
    const double near = kNear * sizeAt(occurrences.front());
    const double allowed = std::max({departure(curve, before, s), departure(curve, s, after), near});
    if (departure(curve, before, s + step) > allowed || departure(curve, s + step, after) > allowed) return false;
    const double square = worstSquare(occurrences);
    std::vector<EditMesh::Vertex> old;
    for (const Occurrence& at : occurrences) {
      old.push_back(meshes_[at.face].vertex(at.vertex));
      meshes_[at.face].setVertex(at.vertex, onFace(at, pointAt(curve, s + step)));
    }
    if (worstAround(occurrences) < least || worstSquare(occurrences) < square) {
      for (std::size_t i = 0; i < old.size(); ++i)
        meshes_[occurrences[i].face].setVertex(occurrences[i].vertex, old[i]);
      return false;
    }
    setPlace(slider, s + step);
    nodes_[node] = pointAt(curve, s + step);
    return true;
  }

  void setPlace(const Slider& slider, double s) {
    std::vector<double>& places = places_[slider.edge];
    places[slider.index] = s;
    if (slider.index == 0) places.back() = s + edges_[slider.edge].curve.length();
  }

  /// A node's vertex of one face at another place of the edge.
  [[nodiscard]] EditMesh::Vertex onFace(const Occurrence& at, const Vec3& position) const {
    const Patch& patch = *faces_[at.face].patch;
    EditMesh::Vertex vertex = meshes_[at.face].vertex(at.vertex);
    vertex.position = position;
    vertex.location = walkToClosest(patch.surface, vertex.location.triangle, position);
    vertex.normal = normalized(interpolate(patch.surface, patch.normal, vertex.location));
    return vertex;
  }

  /// The vertices within kRings elements of some, each once, in ascending order.
  static std::vector<VertexId> around(const EditMesh& mesh, const std::vector<VertexId>& start) {
    IdMap<VertexId, char> isIn(mesh.vertexCapacity());
    std::vector<VertexId> front;
    const auto add = [&isIn](std::vector<VertexId>& to, VertexId v) {
      if (isIn[v] != 0) return;
      isIn[v] = 1;
      to.push_back(v);
    };
    for (const VertexId v : start) add(front, v);
    for (int ring = 0; ring < kRings; ++ring) {
      std::vector<VertexId> next;
      for (const VertexId v : front) {
        mesh.forEachOutgoing(v, [&](HalfedgeId h) {
          for (const HalfedgeId side : mesh.sides(mesh.face(h))) {
            if (side.valid()) add(next, mesh.origin(side));
          }
        });
      }
      front = std::move(next);
    }
    std::vector<VertexId> all;
    for (const VertexId v : IdRange<VertexId>(mesh.vertexCapacity())) {
      if (isIn[v] != 0) all.push_back(v);
    }
    return all;
  }

  [[nodiscard]] std::int64_t countMoved(const std::vector<Vec3>& before) const {
    constexpr double kFar = 0.1;
    std::int64_t count = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (occurrences_[n].empty()) continue;
      if (distance(nodes_[n], before[n]) > kFar * sizeAt(occurrences_[n].front())) ++count;
    }
    return count;
  }

  std::vector<JointFace>& faces_;
  const std::vector<JointEdge>& edges_;
  std::vector<Vec3>& nodes_;
  JointRelaxationOptions options_;
  std::vector<EditMesh> meshes_;
  std::vector<IdMap<VertexId, char>> stays_;  ///< Per face: heldVertices().
  std::vector<std::vector<Occurrence>> occurrences_;
  std::vector<std::vector<double>> places_;
  std::vector<Slider> sliders_;
};

}  // namespace

Result<std::int64_t> relaxTogether(std::vector<JointFace>& faces, const std::vector<JointEdge>& edges,
                                   std::vector<Vec3>& nodes, const JointRelaxationOptions& options,
                                   Progress& progress) {
  return JointRelaxation(faces, edges, nodes, options).run(progress);
}

}  // namespace qmcf
