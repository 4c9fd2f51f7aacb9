#pragma once

#include "relaxation.hpp"

namespace qmcf {

/// Relaxation moves a vertex to where its elements want it on the mean, which leaves a few elements far worse than they
/// need be. This moves the vertices inside of elements whose shape is below `enough` over the face to where the worst
/// element around them is best, by pattern search. No element around becomes worse than the worst there was.
class WorstLift {
 public:
  /// stays: per vertex, 1 if it must not move.
  WorstLift(EditMesh& mesh, const RelaxationTarget& target, double enough, const IdMap<VertexId, char>& stays);

  /// A few sweeps over those vertices that found no better place only before something near them moved. Returns whether
  /// any moved. Earlier marks of the mesh become invalid.
  bool run();
  /// To be called when a vertex was moved by others.
  void wakeAround(VertexId v);

 private:
  [[nodiscard]] std::vector<VertexId> dueVertices() const;
  bool lift(VertexId v);
  [[nodiscard]] double worstAt(VertexId v, const EditMesh::Vertex& place);

  EditMesh& mesh_;
  RelaxationTarget target_;
  double enough_;
  const IdMap<VertexId, char>& stays_;
  IdMap<VertexId, char> awake_;
};

}  // namespace qmcf
