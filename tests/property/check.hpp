#pragma once

#include <string>
#include <vector>

#include "part.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf::property {

/// What is wrong with a mesh of the case: the validator's failing checks, and by counts of its own whether it conforms,
/// is oriented, has the topology known, closes its ledger, has the same divisions for both faces of an edge and keeps
/// all features. Empty if nothing.
std::vector<std::string> faultsOf(const Case& made, const MeshResult& result);

/// Meshes the case. Takes an error as a fault; result may be null.
std::vector<std::string> runCase(const Case& made, Progress& progress, MeshResult* result = nullptr);

/// What a person needs to see of a case: kind, options, triangles.
std::string describe(const Case& made);

}  // namespace qmcf::property
