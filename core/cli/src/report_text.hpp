#pragma once

#include <cstdint>
#include <string>

#include "qmcf/io/read.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "qmcf/topology/statistics.hpp"

namespace qmcf::cli {

/// Lines of text for a person, each with a label in front and a line end behind.

/// What the file holds.
std::string modelText(const std::string& path, const ReadModel& model);
/// The state of the model before repair.
std::string statisticsText(const MeshStatistics& statistics);
/// What was repaired, one line for each item, and the recovered part.
std::string partText(const InspectResult& result);
/// Each face, edge and vertex of the recovered part.
std::string elementsText(const Brep& brep);
/// The mesh, and the faces that could not be meshed in the first way.
std::string meshText(const MeshResult& result);
/// Shape, fidelity and checks. hasCreases: false where sharp edges are what the part's curvature was cut into.
std::string qualityText(const QualityReport& report, bool hasCreases = true);
/// Whether the part has edges that count as sharp ones.
bool hasCreases(const Brep& brep);

/// A number with four significant digits.
std::string shortNumber(double value);
/// "1 face", "2 faces".
std::string counted(std::int64_t count, const std::string& singular, const std::string& plural);

}  // namespace qmcf::cli
