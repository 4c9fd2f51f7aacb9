#include "qmcf/cleanup/joint_relaxation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cleanup/grid_mesh.hpp"
#include "field/patches.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/spatial/surface_tree.hpp"

namespace qmcf {
namespace {

constexpr int kCells = 6;

/// The unit square as one face: its grid, four edges, and a node at each vertex of the boundary.
class Square {
 public:
  Square()
      : patch(testing::makeSquare(kCells)), tree(surfaceTree(patch.surface)), mesh(testing::gridMesh(patch, kCells)) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      nodes.push_back(mesh.positions[v]);
      node.push_back(mesh.patchVertex[v] == kNone ? kNone : static_cast<std::int32_t>(v));
    }
    const std::array<Vec3, 4> corners{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
    for (std::size_t side = 0; side < 4; ++side) {
      const Vec3 from = corners[side];
      const Vec3 to = corners[(side + 1) % 4];
      JointEdge edge{{{from, to}, {0.0, 1.0}, false}, {}, {}, false};
      for (int i = 0; i <= kCells; ++i) {
        edge.nodes.push_back(vertexAt(from + (to - from) * (static_cast<double>(i) / kCells)));
        edge.arcLength.push_back(static_cast<double>(i) / kCells);
      }
      edges.push_back(std::move(edge));
    }
  }

  [[nodiscard]] std::int32_t vertexAt(const Vec3& wanted) const {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      if (distance(mesh.positions[v], wanted) < 1e-9) return static_cast<std::int32_t>(v);
    }
    return kNone;
  }

  /// Moves an inner node of an edge by a share of a cell.
  void shift(std::size_t side, std::size_t index, double cells) {
    JointEdge& edge = edges[side];
    edge.arcLength[index] += cells / kCells;
    const auto v = static_cast<std::size_t>(edge.nodes[index]);
    nodes[v] = mesh.positions[v] = edge.curve.at(edge.arcLength[index]);
  }

  std::int64_t relax(int rounds = JointRelaxationOptions{}.rounds, bool held = false,
                     const std::vector<Ball>& heldPlaces = {}) {
    std::vector<JointFace> faces{{&mesh, &node, &patch, &tree, held, heldPlaces}};
    SilentProgress silent;
    JointRelaxationOptions options;
    options.rounds = rounds;
    const auto moved = relaxTogether(faces, edges, nodes, options, silent);
    EXPECT_TRUE(moved.ok());
    return moved.ok() ? moved.value() : -1;
  }

  Patch patch;
  TriangleBvh tree;
  FaceMesh mesh;
  std::vector<std::int32_t> node;
  std::vector<Vec3> nodes;
  std::vector<JointEdge> edges;
};

TEST(RelaxTogether, LeavesAPerfectGridAlone) {
  Square square;
  const std::vector<Vec3> before = square.nodes;
  EXPECT_EQ(square.relax(), 0);
  EXPECT_EQ(square.nodes, before);
}

TEST(RelaxTogether, SlidesNodesBackWhereTheElementsWantThem) {
  const Square perfect;
  Square sheared;
  for (std::size_t i = 1; i < kCells; ++i) {
    sheared.shift(0, i, 0.3);
    sheared.shift(2, i, 0.3);  // Runs the other way.
  }
  EXPECT_GT(sheared.relax(), kCells);
  for (std::size_t n = 0; n < sheared.nodes.size(); ++n) {
    EXPECT_LT(distance(sheared.nodes[n], perfect.nodes[n]), 0.05 / kCells) << n;
    EXPECT_LT(distance(sheared.mesh.positions[n], perfect.mesh.positions[n]), 0.05 / kCells) << n;
    if (sheared.node[n] != kNone) {
      EXPECT_EQ(sheared.nodes[n], sheared.mesh.positions[n]);
    }
  }
}

TEST(RelaxTogether, KeepsWhatIsInHeldPlaces) {
  Square square;
  for (std::size_t i = 1; i < kCells; ++i) {
    square.shift(0, i, 0.3);
    square.shift(2, i, 0.3);
  }
  square.mesh.positions[static_cast<std::size_t>(square.vertexAt({0.5, 0.5, 0.0}))].x += 0.6 / kCells;
  const std::vector<Vec3> before = square.mesh.positions;
  // Half of the lower side, and what is above it.
  const Ball place{{0.0, 0.0, 0.0}, 0.55};
  EXPECT_GT(square.relax(JointRelaxationOptions{}.rounds, false, {place}), kCells / 2);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const bool stayed = square.mesh.positions[v] == before[v];
    if (distance(before[v], place.centre) <= place.radius) {
      EXPECT_TRUE(stayed) << v;
    } else {
      moved += stayed ? 0 : 1;
    }
  }
  EXPECT_GT(moved, static_cast<std::size_t>(kCells));
}

TEST(RelaxTogether, MakesTheWorstElementsBetterInTheEnd) {
  const auto worst = [](const FaceMesh& mesh) {
    double shape = 1.0;
    for (const Element& element : mesh.elements) shape = std::min(shape, elementShape(mesh, element));
    return shape;
  };
  // A vertex inside, and a node on an edge, are far from where they should be.
  for (const bool onEdge : {false, true}) {
    Square square;
    if (onEdge) {
      square.shift(0, 3, 0.8);
      square.mesh.positions[static_cast<std::size_t>(square.vertexAt({0.5, 1.0 / kCells, 0.0}))].x -= 0.7 / kCells;
    } else {
      square.mesh.positions[static_cast<std::size_t>(square.vertexAt({0.5, 0.5, 0.0}))] +=
          Vec3{0.6, 0.6, 0.0} / static_cast<double>(kCells);
    }
    const double before = worst(square.mesh);
    EXPECT_LT(before, 0.6) << onEdge;
    Square held = square;
    held.relax(0, true);
    EXPECT_EQ(worst(held.mesh), before) << onEdge;
    square.relax(0);
    EXPECT_GT(worst(square.mesh), 0.6) << onEdge;
  }
}

TEST(RelaxTogether, KeepsANodeThatAChordNeeds) {
  // The lower edge bulges to a point half a cell below its third node, which is there.
  Square square;
  JointEdge& edge = square.edges[0];
  const std::size_t third = 2;
  const Vec3 peak{static_cast<double>(third) / kCells + 0.02, -0.5 / kCells, 0.0};
  edge.curve.points = {{0, 0, 0},
                       square.nodes[static_cast<std::size_t>(edge.nodes[1])],
                       peak,
                       square.nodes[static_cast<std::size_t>(edge.nodes[3])],
                       {1, 0, 0}};
  edge.curve.arcLength = {0.0};
  for (std::size_t i = 1; i < edge.curve.points.size(); ++i) {
    edge.curve.arcLength.push_back(edge.curve.arcLength.back() +
                                   distance(edge.curve.points[i - 1], edge.curve.points[i]));
  }
  const double longer = edge.curve.length() - 1.0;
  for (std::size_t i = third + 1; i <= kCells; ++i) edge.arcLength[i] += longer;
  edge.arcLength[third] = edge.curve.arcLength[2];
  const auto v = static_cast<std::size_t>(edge.nodes[third]);
  square.nodes[v] = square.mesh.positions[v] = peak;
  square.relax();
  EXPECT_LT(distance(square.nodes[v], peak), 0.06 / kCells);
}

TEST(RelaxTogether, TurnsTheNodesOfAClosedEdgeWithTheVertexThatClosesIt) {
  // An annulus of quads whose inner ring of nodes is turned by a third of an element.
  constexpr int kAround = 24;
  constexpr int kLayers = 3;
  constexpr double kTurn = 2.0 * 3.141592653589793 / kAround;
  testing::Grid grid;
  grid.nx = kAround;
  grid.ny = kLayers;
  grid.closedX = true;
  grid.map = [](double x, double y) {
    const double angle = x * kTurn * kAround;
    const double radius = 1.0 + 0.25 * kLayers * y;
    return Vec3{radius * std::cos(-angle), radius * std::sin(-angle), 0.0};
  };
  const Patch patch = testing::makeGrid(grid, 0.25);
  const TriangleBvh tree = surfaceTree(patch.surface);
  FaceMesh mesh = testing::verticesOf(patch);
  const std::vector<std::int32_t> node = mesh.patchVertex;
  std::vector<Vec3> nodes = mesh.positions;
  const auto vertexAt = [&](int i, int j) {
    const Vec3 wanted = grid.map(static_cast<double>(i % kAround) / kAround, static_cast<double>(j) / kLayers);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      if (distance(patch.surface.position(VertexId(v)), wanted) < 1e-9) return static_cast<std::int32_t>(v);
    }
    return kNone;
  };
  const double facing = patch.normal[VertexId(std::size_t{0})].z;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kLayers; ++j) {
      Element quad{vertexAt(i, j), vertexAt(i, j + 1), vertexAt(i + 1, j + 1), vertexAt(i + 1, j)};
      if (facing > 0.0) std::swap(quad[1], quad[3]);
      mesh.elements.push_back(quad);
    }
  }
  // Fine enough that its chords don't matter.
  JointEdge inner;
  constexpr int kFine = 20 * kAround;
  inner.curve.closed = inner.slidesAtStart = true;
  for (int i = 0; i <= kFine; ++i) inner.curve.points.push_back(grid.map(static_cast<double>(i) / kFine, 0.0));
  inner.curve.arcLength = {0.0};
  for (std::size_t i = 1; i < inner.curve.points.size(); ++i) {
    inner.curve.arcLength.push_back(inner.curve.arcLength.back() +
                                    distance(inner.curve.points[i - 1], inner.curve.points[i]));
  }
  for (int i = 0; i <= kAround; ++i) {
    inner.nodes.push_back(vertexAt(i, 0));
    inner.arcLength.push_back(inner.curve.length() * (i + 1.0 / 3.0) / kAround);
    const auto v = static_cast<std::size_t>(inner.nodes.back());
    nodes[v] = mesh.positions[v] = grid.map((i % kAround + 1.0 / 3.0) / kAround, 0.0);
  }
  std::vector<JointFace> faces{{&mesh, &node, &patch, &tree}};
  SilentProgress silent;
  JointRelaxationOptions options;
  options.rounds = 30;
  ASSERT_TRUE(relaxTogether(faces, {inner}, nodes, options, silent).ok());
  for (int i = 0; i < kAround; ++i) {
    const auto v = static_cast<std::size_t>(vertexAt(i, 0));
    EXPECT_LT(distance(nodes[v], grid.map(static_cast<double>(i) / kAround, 0.0)), 0.02) << i;
  }
}

}  // namespace
}  // namespace qmcf
