#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/background/background.hpp"
#include "qmcf/sizing/divide.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "run_options.hpp"

namespace qmcf {

/// The number of threads that the options ask for.
std::int32_t threadsOf(const RunOptions& options);

/// What a face is made of: elements of the wanted size, or the part's own triangles, which fit whatever else fails.
enum class Given : std::uint8_t { nothing, pairs, triangles };

/// How the sizes inside faces come from those on their edges (E7 of docs/algorithm.md): as the size field has them,
/// spread as rows of elements go on, or made to suit the crosses as well.
enum class Settling : std::uint8_t { none, spread, turned };

/// What the options ask for.
Settling settlingOf(const RunOptions& options);

/// Everything that the faces need before they can be meshed one by one.
struct PreparedFaces {
  SizeField size;
  DividedEdges divided;
  std::vector<Patch> patches;                  ///< One per face of the B-rep.
  std::vector<CrossField> fields;              ///< One per patch; empty ones in a mode that asks no field.
  std::vector<std::int32_t> minimumDivisions;  ///< Per edge: what its faces asked for, >= 1.
  std::vector<std::int32_t> changed;           ///< Faces that the last call made anew, ascending.
  std::vector<Given> given;                    ///< Per face.
  std::vector<double> wantedElements;          ///< Per face, where sizes are settled: how many there would be if not.
  std::vector<std::uint8_t> settled;           ///< Per face: 1 if sizes changed noticeably when they were.
  /// Per face: the sizes before they followed a mesh (meshSettled()); empty where they didn't.
  std::vector<IdMap<VertexId, double>> sizesBefore;
};

/// What a preparation was made with.
struct PreparedSizes {
  double base = 0.0;
  std::vector<SizeLimit> limits;
  std::vector<std::int32_t> minimumDivisions;
  double chordSize = 0.0;
};

/// Size field, divided edges, background triangulations and cross fields. Edges whose chords would cut through a face
/// get more divisions until none does; places that the triangulation can't follow get smaller elements.
/// settling: what happens to the sizes inside faces; below, what the options ask for (settlingOf()). scale: what the
/// size is multiplied by from place to place, here and below; nullptr: nothing. A size given in the options is the mean
/// one then. limits: places known to need smaller elements, from a preparation with other sizes. Errors: those of the
/// stages.
Result<PreparedFaces> prepareFaces(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                   const SizeScale* scale, Settling settling, const std::vector<SizeLimit>& limits,
                                   Progress& progress);

/// The inner sizes of these faces, which are spread, turn, too. faces: ascending. Errors: those of turnedSizes().
std::optional<Error> turnSizes(PreparedFaces& prepared, const std::vector<std::int32_t>& faces,
                               const RunOptions& options, Progress& progress);

/// The same with smaller elements at `limits` and the base size as it was. Faces out of their reach keep all they have,
/// apart from the numbers of the shared nodes.
Result<PreparedFaces> refineFaces(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                  const SizeScale* scale, PreparedFaces prepared, const std::vector<SizeLimit>& limits,
                                  Progress& progress);

/// The same, from the beginning, with the sizes and divisions that `before` had, and some faces made of the part's own
/// triangles; their edges are divided at the part's own points.
Result<PreparedFaces> prepareGiven(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                                   const SizeScale* scale, const PreparedSizes& before, const std::vector<Given>& given,
                                   Progress& progress);

/// Takes the faces out of now.changed that are what they were in `before`, apart from the numbers of the shared nodes:
/// their meshes would be, too, and the sizes that these led to.
void keepUnchanged(const PreparedFaces& before, PreparedFaces& now);

/// The size field with these sizes. Errors: cancelled.
Result<SizeField> sizeField(const TriangleMesh& mesh, const Brep& brep, const RunOptions& options,
                            const SizeScale* scale, const PreparedSizes& sizes, Progress& progress);

}  // namespace qmcf
