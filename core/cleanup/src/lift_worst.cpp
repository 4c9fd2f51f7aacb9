#include "lift_worst.hpp"

#include <algorithm>
#include <cstddef>

#include "qmcf/base/math.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

constexpr int kSweeps = 6;
constexpr int kDirections = 8;
/// Lengths of the moves that are tried, in element sizes: the first, and the last once halving has gone that far.
constexpr double kLongest = 0.2;
constexpr double kShortest = 0.02;
constexpr int kMostMoves = 12;
/// A better worst shape is better by this much; what is worse by so much in the tangent plane is not on the face
/// either.
constexpr double kGain = 1e-3;
constexpr double kOffPlane = 0.15;

}  // namespace

WorstLift::WorstLift(EditMesh& mesh, const RelaxationTarget& target, double enough, const IdMap<VertexId, char>& stays)
    : mesh_(mesh), target_(target), enough_(enough), stays_(stays), awake_(mesh.vertexCapacity(), 1) {}

bool WorstLift::run() {
  bool movedAny = false;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool moved = false;
    for (const VertexId v : dueVertices()) {
      awake_[v] = 0;
      if (!lift(v)) continue;
      moved = true;
      wakeAround(v);
    }
    if (!moved) break;
    movedAny = true;
  }
  return movedAny;
}

void WorstLift::wakeAround(VertexId v) {
  awake_[v] = 1;
  mesh_.forEachOutgoing(v, [&](HalfedgeId h) {
    for (HalfedgeId e = mesh_.next(h); e != h; e = mesh_.next(e)) awake_[mesh_.origin(e)] = 1;
  });
}

/// The vertices inside of elements that are not good enough, each once, ascending.
std::vector<VertexId> WorstLift::dueVertices() const {
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < mesh_.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh_.kind(f) == FaceKind::removed) continue;
    const auto isDue = [&](HalfedgeId h) {
      if (!h.valid()) return false;
      const VertexId v = mesh_.origin(h);
      return awake_[v] != 0 && stays_[v] == 0 && !mesh_.isBoundary(v);
    };
    const auto sides = mesh_.sides(f);
    if (std::none_of(sides.begin(), sides.end(), isDue) || faceShape(mesh_, f) >= enough_) continue;
    for (const HalfedgeId h : sides) {
      if (isDue(h)) vertices.push_back(mesh_.origin(h));
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

double WorstLift::worstAt(VertexId v, const EditMesh::Vertex& place) {
  mesh_.setVertex(v, place);
  return worstShapeAround(mesh_, v);
}

bool WorstLift::lift(VertexId v) {
  double worst = worstShapeAround(mesh_, v);
  const double square = worstSquareAround(mesh_, v);
  double length = kLongest;
  bool moved = false;
  for (int move = 0; move < kMostMoves && length >= kShortest && worst < enough_; ++move) {
    const EditMesh::Vertex from = mesh_.vertex(v);
    const double size = wantedSize(target_, from);
    const Vec3 side = mesh_.position(mesh_.target(mesh_.outgoing(v))) - from.position;
    const Vec3 x = normalized(tangentPart(side, from.normal));
    const Vec3 y = cross(from.normal, x);
    EditMesh::Vertex best = from;
    double bestWorst = worst + kGain;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2.0 * math::kPi * d / kDirections;
      EditMesh::Vertex tried = from;
      tried.position += (x * math::cos(angle) + y * math::sin(angle)) * (length * size);
      // Projecting is what takes long.
      if (worstAt(v, tried) <= bestWorst - kOffPlane) continue;
      tried = projectVertex(target_, from, tried.position);
      const double now = worstAt(v, tried);
      if (now <= bestWorst || worstSquareAround(mesh_, v) < square) continue;
      best = tried;
      bestWorst = now;
    }
    mesh_.setVertex(v, best);
    if (bestWorst > worst + kGain) {
      worst = bestWorst;
      moved = true;
    } else {
      length *= 0.5;
    }
  }
  mesh_.commitUnwatched();
  return moved;
}

}  // namespace qmcf
