#pragma once

#include <vector>

#include "qmcf/cleanup/cleanup.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// Where vertices may move to.
struct RelaxationTarget {
  const Patch& patch;       ///< Sizes and normals.
  const TriangleBvh& face;  ///< The face's input triangles.
  double sizeScale = 1.0;   ///< Element length in units of the patch's sizes.
  bool onPatch = false;     ///< Project on the patch's triangles instead: near, and cheaper, for what is only tried.
  /// What elements are checked against in the end; nullptr: they are not checked here.
  const WholePart* part = nullptr;
};

/// The size of elements that is wanted at a vertex.
double wantedSize(const RelaxationTarget& target, const EditMesh::Vertex& vertex);

/// The place on the face nearest to a position, with normal and location.
EditMesh::Vertex projectVertex(const RelaxationTarget& target, const EditMesh::Vertex& from, const Vec3& position);

/// Where the square (equilateral triangle) that fits the face of h best has its corner at origin(h), in the tangent
/// plane of normal; size: the edge length wanted there.
Vec3 idealCorner(const EditMesh& mesh, HalfedgeId h, const Vec3& normal, double size);

/// One sweep of successive over-relaxation over the given vertices: each moves towards the mean of the places that the
/// best-fitting squares (equilateral triangles) of its elements give it and somewhat further, is projected, and stays
/// where it was if an element around it would become worse than both before and `enough`. Boundary vertices don't move.
void relax(EditMesh& mesh, const std::vector<VertexId>& vertices, const RelaxationTarget& target, double enough);

/// Sweeps over all vertices of a mesh that leave out those around which nothing has moved since they were visited last.
class LazyRelaxation {
 public:
  /// isAwake: whether all vertices are in the beginning.
  LazyRelaxation(EditMesh& mesh, const RelaxationTarget& target, double enough, bool isAwake = true);
  /// The vertices marked here stay where they are from now on.
  void hold(const IdMap<VertexId, char>& stays) { stays_ = stays; }

  /// From now on vertices go to the face itself; all are awake.
  void land();
  /// To be called after a change of the mesh with the vertices that it touched; new ones are awake.
  void wake(const std::vector<VertexId>& vertices);
  /// As relax(), for the vertices that are awake. Returns false once nothing moves by more than a hundredth of the
  /// element size. Earlier marks of the mesh become invalid.
  bool sweep();

 private:
  EditMesh& mesh_;
  RelaxationTarget target_;
  double enough_;
  IdMap<VertexId, char> awake_;
  IdMap<VertexId, char> stays_;  ///< Empty: none.
};

}  // namespace qmcf
