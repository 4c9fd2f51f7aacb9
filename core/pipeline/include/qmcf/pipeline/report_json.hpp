#pragma once

#include <string>

#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// Reports as JSON text (UTF-8), with the field names of the C++ structs. Non-finite numbers become null.
std::string toJson(const QualityReport& report);
/// repair items, counts of bodies, faces, loops, edges by kind, vertices, and each face and edge.
std::string toJson(const InspectResult& result);
/// size, quality, faces, repair items, singularities.
std::string toJson(const MeshResult& result);

}  // namespace qmcf
