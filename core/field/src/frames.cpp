#include "frames.hpp"

#include <cmath>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// e^(i (angle in space - angle of the connection)) of a neighbour, the former measured in the given frame.
std::complex<double> deviation(const TangentFrame& frame, const Vec3& towards, double angle) {
  const std::complex<double> inSpace(dot(towards, frame.x), dot(towards, frame.y));
  return math::normalized(inSpace) * math::unitComplex(-angle);
}

TangentFrame tangentFrame(const Patch& patch, const Connection& connection, VertexId v) {
  const Surface& surface = patch.surface;
  TangentFrame frame;
  frame.normal = patch.normal[v];
  frame.x = anyTangent(frame.normal);
  frame.y = cross(frame.normal, frame.x);
  const Vec3 p = surface.position(v);
  const HalfedgeId first = surface.outgoing(v);
  std::complex<double> turn = 0.0;
  if (surface.isBoundary(v)) {
    HalfedgeId last = first;
    surface.forEachOutgoing(v, [&](HalfedgeId h) { last = h; });
    turn = deviation(frame, surface.position(surface.target(first)) - p, 0.0) +
           deviation(frame, surface.position(surface.opposite(last)) - p, connection.total[v]);
  } else {
    surface.forEachOutgoing(v, [&](HalfedgeId h) {
      turn += deviation(frame, surface.position(surface.target(h)) - p, connection.angle[h]);
    });
  }
  turn = math::normalized(turn);
  if (turn == std::complex<double>(0.0)) turn = 1.0;
  const Vec3 x = normalized(frame.x * turn.real() + frame.y * turn.imag());
  return {x, cross(frame.normal, x), frame.normal};
}

}  // namespace

Vec3 anyTangent(const Vec3& n) {
  const Vec3 axis = std::fabs(n.x) <= std::fabs(n.y) && std::fabs(n.x) <= std::fabs(n.z) ? Vec3{1.0, 0.0, 0.0}
                    : std::fabs(n.y) <= std::fabs(n.z)                                   ? Vec3{0.0, 1.0, 0.0}
                                                                                         : Vec3{0.0, 0.0, 1.0};
  return normalized(cross(n, axis));
}

double angleIn(const TangentFrame& frame, const Vec3& direction) {
  return math::atan2(dot(direction, frame.y), dot(direction, frame.x));
}

std::complex<double> crossAlong(const TangentFrame& frame, const Vec3& direction) {
  const std::complex<double> u = math::normalized({dot(direction, frame.x), dot(direction, frame.y)});
  return math::normalized((u * u) * (u * u));
}

IdMap<VertexId, TangentFrame> tangentFrames(const Patch& patch, const Connection& connection) {
  IdMap<VertexId, TangentFrame> frames(patch.surface.vertexCount());
  for (const VertexId v : patch.surface.vertices()) frames[v] = tangentFrame(patch, connection, v);
  return frames;
}

}  // namespace qmcf
