#pragma once

#include <string>

#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// Reports as JSON text (UTF-8), with the field names of the C++ structs. Non-finite numbers become null.
std::string toJson(const QualityReport& report);
/// {repair, counts, bodies, faces, edges, vertices}: repair items; counts of everything, edges also by kind; each
/// element of the B-rep, a face with its loops.
std::string toJson(const InspectResult& result);
/// {size, quality, faces, repair, fieldSingularities, refinedPlaces, heldFaces, heldPlaces, slidNodes, elementsCut,
/// fittedSizes, sizing, sizeConformity}.
std::string toJson(const MeshResult& result);
/// The history of the faces as docs/trace.md describes it, one step a line. \pre result.trace
std::string traceJson(const MeshResult& result);

}  // namespace qmcf
