#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "face_reference.hpp"
#include "face_sizes.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "remesh_mesh.hpp"

namespace qmcf {

/// What the vertices of a remesh aim at.
struct RemeshTargets {
  double base = 0.0;              ///< Size of the quad mesh away from everything.
  double gradation = 0.25;        ///< Largest slope of the size.
  double relativeSize = 0.8;      ///< Length of triangle edges in units of the size, at nodes and where it is curved.
  double flatSize = 1.7;          ///< The same far from the nodes where the face is flat; at least relativeSize.
  std::vector<double> nodeSize;   ///< Per vertex of the mesh: size at nodes, 0 elsewhere.
  std::vector<SizeLimit> limits;  ///< Those inside this face.
  FaceSizes inner;                ///< Largest sizes inside this face.
  std::vector<double> spacing;    ///< Per vertex of the mesh: distance of nodes to their neighbours, 0 elsewhere.
};

/// Isotropic remeshing of a face with a fixed boundary of nodes: Botsch and Kobbelt 2004, with the order and the checks
/// that coarse CAD facets need. Every operation keeps the topology and turns no triangle over.
class Remesher {
 public:
  Remesher(RemeshMesh& mesh, const FaceReference& reference, RemeshTargets targets)
      : mesh_(mesh),
        reference_(reference),
        targets_(std::move(targets)),
        awake_(static_cast<std::size_t>(mesh.vertexCount()), 1),
        moved_(awake_) {}

  /// RemeshMesh::renumber() of the mesh and of what is known about its vertices; sizes are to be updated afterwards.
  std::vector<std::int32_t> renumber();

  /// Computes `size` and `length` for all vertices, by gradation from nodes and curved places along the mesh's edges.
  void updateSizes();
  /// Removes boundary points along the boundary where no triangle turns over; returns how many are left.
  std::int32_t removePoints();
  /// Removes a boundary point even where triangles turn over. Returns false if the topology does not allow it.
  bool forcePoint(std::int32_t v);
  /// Shrinks short edges inside; returns how many.
  std::int32_t collapseShort();
  /// Splits edges inside that are longer than `scale` targets, and edges between two boundary vertices where there is
  /// room for a vertex; returns how many.
  std::int32_t splitLong(double scale);
  /// Makes needles of flat regions Delaunay by flips, so that fans of them don't have to be split into small pieces.
  /// Returns false when progress asked to stop.
  [[nodiscard]] bool flipNeedles(Progress& progress);
  /// Flips edges where that makes better triangles.
  void flipEdges();
  /// Moves vertices inside towards the middle of their neighbours, then onto the face. Leaves out those around which
  /// nothing has changed since they came to rest.
  void smooth(int sweeps);

  [[nodiscard]] const std::vector<double>& size() const { return size_; }

 private:
  /// What was last found in targets_.inner, and where.
  struct Inner {
    Vec3 position;
    FaceSizes::Found found;
  };

  void applyLimits();
  void applyInner();
  void shortenWhereCurved();
  [[nodiscard]] double edgeLength(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] double quality(std::int32_t a, std::int32_t b, std::int32_t c) const;
  [[nodiscard]] bool tryCollapse(std::int32_t h, std::int32_t removed);
  [[nodiscard]] bool keepsShape(std::int32_t removed, std::int32_t kept, double longest);
  [[nodiscard]] bool wantsNeedleFlip(std::int32_t h) const;
  [[nodiscard]] bool wantsFlip(std::int32_t h) const;
  void wake(std::int32_t v) { awake_[static_cast<std::size_t>(v)] = 1; }
  void wakeAround(std::int32_t v);
  void smoothVertex(std::int32_t v);
  [[nodiscard]] bool tryMove(std::int32_t v, const Vec3& to, const Vec3& normal);
  void splitEdge(std::int32_t h);
  [[nodiscard]] bool isTooLong(std::int32_t h, double scale) const;
  [[nodiscard]] bool isLongInSliver(std::int32_t h) const;
  [[nodiscard]] bool joinsBoundary(std::int32_t a, std::int32_t b) const;

  RemeshMesh& mesh_;
  const FaceReference& reference_;
  RemeshTargets targets_;
  std::vector<double> size_;    ///< Per vertex: target size of the quad mesh.
  std::vector<double> length_;  ///< Per vertex: target length of triangle edges.
  std::vector<Inner> inner_;    ///< Per vertex.
  std::vector<char> awake_;     ///< Per vertex: something near it has changed since it was smoothed.
  std::vector<char> moved_;     ///< Per vertex: it has moved since it was projected.
};

}  // namespace qmcf
