#include "natural_scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"
#include "qmcf/field/natural_size.hpp"

namespace qmcf {
namespace {

/// How far the logarithm goes from its mean, either way. Twice as much made meshes hardly more regular, and nobody who
/// asks for a number of elements expects some to be far larger than others.
constexpr double kMostLog = 0.2;
/// With this share of the ends of rows at most, or one size is as good: where sizes change for other reasons, most rows
/// end for these.
constexpr double kLeftEnds = 0.88;
/// A mesh with fewer ends than this is regular as it is.
constexpr double kFewEnds = 1.0;

}  // namespace

Result<SizeScale> naturalScale(const Brep& brep, const PreparedFaces& prepared, Progress& progress) {
  const std::vector<Patch>& patches = prepared.patches;
  std::vector<CrossField> fields = prepared.fields;
  // A closed smooth face asks for nothing: it has no edges whose rows of elements would have to end.
  for (std::size_t f = 0; f < fields.size(); ++f) {
    if (brep.faces[f].loops.empty()) fields[f] = CrossField{};
  }
  auto natural = naturalSizes(patches, fields, progress);
  if (!natural) return natural.error();
  auto& logs = natural.value();
  std::vector<IdMap<VertexId, double>> even;
  double most = -kMostLog;
  for (auto& ofPatch : logs) {
    even.emplace_back(ofPatch.size(), 0.0);
    for (double& log : ofPatch.raw()) {
      log = math::bent(log, kMostLog);
      most = std::max(most, log);
    }
  }
  const double endsBefore = expectedRowEnds(patches, fields, even);
  if (endsBefore < kFewEnds || expectedRowEnds(patches, fields, logs) > kLeftEnds * endsBefore) return SizeScale();
  std::vector<SizeScale::Face> faces;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Surface& surface = patches[p].surface;
    SizeScale::Face& face = faces.emplace_back();
    for (std::size_t v = 0; v < surface.vertexCount(); ++v) {
      face.positions.push_back(surface.position(VertexId(v)));
      face.factor.push_back(math::exp(logs[p][VertexId(v)] - most));
    }
    for (const TriangleId t : surface.triangles()) {
      const auto corners = surface.corners(t);
      face.triangles.push_back({corners[0].value, corners[1].value, corners[2].value});
    }
  }
  return SizeScale(std::move(faces));
}

}  // namespace qmcf
