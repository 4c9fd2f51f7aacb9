#include "qmcf/mesh/trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "field/patches.hpp"
#include "front/face_mesh_checks.hpp"
#include "front/trace_replay.hpp"
#include "qmcf/front/advancing_front.hpp"

namespace qmcf {
namespace {

constexpr TraceScale kScale{{-2.0, -2.0, -2.0}, 1.0 / 65536.0};

struct Recorded {
  FrontResult front;
  FaceTrace trace;
};

Recorded record(const Patch& patch) {
  SilentProgress silent;
  const std::vector<std::uint8_t> kinds(patch.surface.halfedgeCount(), 1);
  const auto field = computeCrossField(patch, kinds, FieldOptions{}, silent);
  Recorded result;
  TraceRecorder recorder(result.trace, kScale);
  auto front = advanceFront(patch, field.value(), FrontOptions{}, silent, &recorder);
  EXPECT_TRUE(front.ok());
  result.front = std::move(front).value();
  const auto alone = advanceFront(patch, field.value(), FrontOptions{}, silent);
  EXPECT_EQ(alone.value().mesh.elements, result.front.mesh.elements) << "recording changed the mesh";
  EXPECT_TRUE(alone.value().mesh.positions == result.front.mesh.positions);
  return result;
}

std::int64_t countSteps(const FaceTrace& trace, TraceKind kind) {
  return std::count_if(trace.steps.begin(), trace.steps.end(),
                       [kind](const TraceStep& step) { return step.kind == kind; });
}

/// The elements by the places of their corners, each from its smallest corner on, in order.
template <class Position>
std::vector<std::vector<std::array<double, 3>>> sorted(const std::vector<Element>& elements, Position position) {
  std::vector<std::vector<std::array<double, 3>>> result;
  for (const Element& element : elements) {
    auto& corners = result.emplace_back();
    for (std::size_t i = 0; i < cornerCount(element); ++i) corners.push_back(position(element[i]));
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

void expectReplayed(const Recorded& recorded) {
  testing::TraceReplay replay;
  for (const TraceStep& step : recorded.trace.steps) replay.apply(step);
  EXPECT_TRUE(replay.frontEdges().empty());
  std::vector<Element> elements;
  for (const auto& [e, corners] : replay.elements) elements.push_back(corners);
  const FaceMesh& mesh = recorded.front.mesh;
  const auto rounded = [](double x) { return std::floor((x + 2.0) * 65536.0 + 0.5); };
  const auto expected = sorted(mesh.elements, [&](std::int32_t v) {
    const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
    return std::array<double, 3>{rounded(p.x), rounded(p.y), rounded(p.z)};
  });
  const auto replayed = sorted(elements, [&](std::int32_t v) {
    const auto& p = replay.positions.at(v);
    return std::array<double, 3>{double(p[0]), double(p[1]), double(p[2])};
  });
  EXPECT_EQ(replayed, expected);
}

TEST(Trace, OfAGridHasAQuadAStepAndEveryFrontClosed) {
  const Recorded recorded = record(testing::makeSquare(10));
  expectReplayed(recorded);
  EXPECT_EQ(recorded.trace.steps.front().kind, TraceKind::start);
  EXPECT_EQ(recorded.trace.steps.front().boundary.size(), 1U);
  EXPECT_EQ(recorded.trace.steps.front().boundary[0].size(), 40U);
  EXPECT_EQ(recorded.trace.steps.front().states.size(), 40U);
  std::size_t made = 0;
  for (const TraceStep& step : recorded.trace.steps) made += step.elements.size();
  EXPECT_GE(made, 100U);
  EXPECT_GT(countSteps(recorded.trace, TraceKind::quad), 50);
}

TEST(Trace, RepeatsWhatTheFrontDidOnAllKindsOfFaces) {
  for (const Patch& patch :
       {testing::makeDisk(10), testing::makePolygonRing(5, 8, 6, false), testing::makeCylinder(30, 12, 2.0),
        testing::withSize(testing::makeSphere(6), 0.25), testing::withSize(testing::makeTorus(40, 16), 0.2)}) {
    const Recorded recorded = record(patch);
    expectReplayed(recorded);
    const FrontStatistics& statistics = recorded.front.statistics;
    EXPECT_EQ(countSteps(recorded.trace, TraceKind::star), statistics.stars);
    EXPECT_EQ(countSteps(recorded.trace, TraceKind::seam), statistics.seams);
    EXPECT_EQ(countSteps(recorded.trace, TraceKind::collision), statistics.collisions);
    std::int64_t undone = 0;
    for (const TraceStep& step : recorded.trace.steps) {
      undone += step.undone;
      EXPECT_LE(step.failed.size(), 64U);
    }
    EXPECT_LE(undone, statistics.rollbacks);
  }
}

TEST(Trace, IsTheSameEachTime) {
  const Patch patch = testing::makeDisk(8);
  EXPECT_EQ(record(patch).trace, record(patch).trace);
}

}  // namespace
}  // namespace qmcf
