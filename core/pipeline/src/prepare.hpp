#pragma once

#include <vector>

#include "qmcf/background/background.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "qmcf/sizing/divide.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// Everything that the faces need before they can be meshed one by one.
struct PreparedFaces {
  SizeField size;
  DividedEdges divided;
  std::vector<Patch> patches;      ///< One per face of the B-rep.
  std::vector<CrossField> fields;  ///< One per patch; none in a mode that asks no field.
};

/// Size field, divided edges, background triangulations and cross fields. Edges whose chords would cut through a face
/// get more divisions until none does. Errors: those of the stages.
Result<PreparedFaces> prepareFaces(const TriangleMesh& mesh, const Brep& brep, const MeshOptions& options,
                                   Progress& progress);

}  // namespace qmcf
