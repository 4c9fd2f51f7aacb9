#include "qmcf/mesh/edit_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "qmcf/base/random.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

Surface squareGrid(int cells) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) positions.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const std::int32_t a = j * (cells + 1) + i;
      triangles.push_back({a, a + 1, a + cells + 2});
      triangles.push_back({a, a + cells + 2, a + cells + 1});
    }
  }
  return Surface::build(std::move(positions), triangles).value();
}

EditMesh editable(const Surface& surface) {
  return EditMesh(surface, IdMap<VertexId, Vec3>(surface.vertexCount(), Vec3{0, 0, 1}));
}

/// Every link agrees with every other, and the mesh is a disk.
void expectSound(const EditMesh& mesh) {
  std::int64_t vertices = 0;
  std::int64_t halfedges = 0;
  std::int64_t borders = 0;
  std::int64_t faces = 0;
  for (std::size_t i = 0; i < mesh.halfedgeCapacity(); ++i) {
    const HalfedgeId h(i);
    if (!mesh.alive(h)) continue;
    ++halfedges;
    ASSERT_EQ(mesh.prev(mesh.next(h)), h);
    ASSERT_EQ(mesh.face(mesh.next(h)), mesh.face(h));
    ASSERT_NE(mesh.kind(mesh.face(h)), FaceKind::removed);
    const HalfedgeId t = mesh.twin(h);
    if (!t.valid()) {
      ++borders;
      ASSERT_EQ(mesh.outgoing(mesh.origin(h)), h) << "a boundary vertex starts at its boundary edge";
      continue;
    }
    ASSERT_EQ(mesh.twin(t), h);
    ASSERT_EQ(mesh.origin(t), mesh.target(h));
  }
  for (std::size_t i = 0; i < mesh.vertexCapacity(); ++i) {
    const VertexId v(i);
    if (!mesh.alive(v)) continue;
    ++vertices;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { ASSERT_EQ(mesh.origin(h), v); });
  }
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed) continue;
    ++faces;
    ASSERT_EQ(mesh.face(mesh.halfedge(f)), f);
  }
  EXPECT_EQ(vertices - (halfedges + borders) / 2 + faces, 1) << "Euler characteristic of a disk";
}

/// A random edit that is allowed where it falls; returns whether there was one.
bool randomEdit(EditMesh& mesh, Random& random) {
  const HalfedgeId h(static_cast<std::int32_t>(random.next() % mesh.halfedgeCapacity()));
  if (!mesh.alive(h)) return false;
  const HalfedgeId t = mesh.twin(h);
  const Vec3 middle = (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))) * 0.5;
  switch (random.next() % 4) {
    case 0:
      if (!t.valid() || mesh.connected(mesh.origin(mesh.prev(h)), mesh.origin(mesh.prev(t)))) return false;
      mesh.flip(h);
      return true;
    case 1:
      mesh.splitTriangle(mesh.face(h), {middle, {0, 0, 1}, {}});
      return true;
    case 2:
      if (!t.valid()) return false;
      mesh.splitEdge(h, {middle, {0, 0, 1}, {}});
      return true;
    default:
      if (!mesh.canCollapse(h)) return false;
      mesh.collapse(h);
      return true;
  }
}

TEST(EditMesh, StaysAManifoldDiskUnderRandomEdits) {
  EditMesh mesh = editable(squareGrid(6));
  Random random(7);
  int edits = 0;
  for (int i = 0; i < 4000; ++i) edits += randomEdit(mesh, random) ? 1 : 0;
  EXPECT_GT(edits, 500);
  expectSound(mesh);
}

TEST(EditMesh, RollsBackToExactlyWhatItWas) {
  EditMesh mesh = editable(squareGrid(5));
  Random random(11);
  for (int i = 0; i < 300; ++i) randomEdit(mesh, random);
  mesh.commit();
  const EditMesh before = mesh;
  const std::size_t mark = mesh.mark();
  for (int i = 0; i < 500; ++i) randomEdit(mesh, random);
  EXPECT_GT(mesh.mark(), mark);
  mesh.rollback(mark);
  ASSERT_EQ(mesh.halfedgeCapacity(), before.halfedgeCapacity());
  ASSERT_EQ(mesh.vertexCapacity(), before.vertexCapacity());
  ASSERT_EQ(mesh.faceCapacity(), before.faceCapacity());
  for (std::size_t i = 0; i < mesh.halfedgeCapacity(); ++i) {
    const HalfedgeId h(i);
    ASSERT_EQ(mesh.alive(h), before.alive(h));
    if (!mesh.alive(h)) continue;
    EXPECT_EQ(mesh.origin(h), before.origin(h));
    EXPECT_EQ(mesh.next(h), before.next(h));
    EXPECT_EQ(mesh.twin(h), before.twin(h));
    EXPECT_EQ(mesh.face(h), before.face(h));
  }
  expectSound(mesh);
}

TEST(EditMesh, FillsARegionAndRemovesWhatWasInside) {
  EditMesh mesh = editable(squareGrid(4));
  // The 2 x 2 cells in the middle: 8 boundary edges around one inner vertex.
  const std::vector<VertexId> ring{VertexId(6),  VertexId(7),  VertexId(8),  VertexId(13),
                                   VertexId(18), VertexId(17), VertexId(16), VertexId(11)};
  std::vector<HalfedgeId> boundary;
  for (std::size_t i = 0; i < ring.size(); ++i) boundary.push_back(mesh.find(ring[i], ring[(i + 1) % ring.size()]));
  std::vector<FaceId> region;
  mesh.forEachOutgoing(VertexId(12), [&](HalfedgeId h) { region.push_back(mesh.face(h)); });
  for (const HalfedgeId h : boundary) {
    if (std::find(region.begin(), region.end(), mesh.face(h)) == region.end()) region.push_back(mesh.face(h));
  }
  ASSERT_EQ(region.size(), 8U);
  const EditMesh::Vertex middle{{2, 2, 0}, {0, 0, 1}, {}};
  const auto quads = mesh.fill(boundary, region, {{0, 1, 8, 7}, {1, 2, 3, 8}, {8, 3, 4, 5}, {7, 8, 5, 6}}, {middle});
  EXPECT_EQ(quads.size(), 4U);
  EXPECT_FALSE(mesh.alive(VertexId(12)));
  for (const FaceId f : quads) EXPECT_NEAR(faceShape(mesh, f), 1.0, 1e-12);
  expectSound(mesh);
}

TEST(EditMesh, CutsAQuadIntoTwoTriangles) {
  EditMesh mesh = editable(squareGrid(1));
  const HalfedgeId diagonal = mesh.find(VertexId(0), VertexId(3));
  const HalfedgeId twin = mesh.twin(diagonal);
  const FaceId quad = mesh.fill({mesh.next(diagonal), mesh.prev(diagonal), mesh.next(twin), mesh.prev(twin)},
                                {mesh.face(diagonal), mesh.face(twin)}, FaceKind::element);
  EXPECT_EQ(mesh.cornerCount(quad), 4);
  const HalfedgeId first = mesh.halfedge(quad);
  mesh.cut(first, mesh.next(mesh.next(first)));
  expectSound(mesh);
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    if (mesh.kind(FaceId(i)) == FaceKind::removed) continue;
    EXPECT_EQ(mesh.cornerCount(FaceId(i)), 3);
  }
}

}  // namespace
}  // namespace qmcf
