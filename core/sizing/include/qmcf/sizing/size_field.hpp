#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/inner_sizes.hpp"
#include "qmcf/sizing/size_scale.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// At most this length at a point inside a face.
struct SizeLimit {
  std::int32_t face = kNone;
  Vec3 position;
  double size = 0.0;  ///< > 0.
};

/// How large the elements shall be. Lengths are in units of the model.
struct SizingOptions {
  std::optional<double> size;  ///< Edge length everywhere, > 0; with a scale the largest. Excludes `quads`.
  /// Number of elements to aim at, 1 to 10,000,000. Excludes `vertexSize`. Default 3000 when neither of these is set.
  std::optional<std::int64_t> quads;
  /// Per vertex of the mesh: the largest length there, finite and > 0; linear in the triangles. Empty: none. Without
  /// `size`, the largest of them, once graded, takes its place.
  std::vector<double> vertexSize;
  /// How far the middle of an element's edge may be from the surface where that is curved, and from a curved edge of
  /// the B-rep, > 0. Unset: whatever the size and the turns of the edges make of it.
  std::optional<double> curvature;
  /// What the base size is multiplied by from place to place; nullptr: nothing.
  const SizeScale* scale = nullptr;
  double gradation = 0.25;            ///< Largest |grad h|, in (0, 1].
  std::int32_t divisionsPerTurn = 8;  ///< Least number of edges in a full turn of a feature edge, >= 3.
  std::vector<SizeLimit> limits;      ///< Where the elements have to be smaller.
  /// What the chords' distance from a curved edge is measured by, > 0: SizeField::chordSize. Default: `size`, or the
  /// root of area / quads.
  std::optional<double> chordSize;
};

/// Target length along one edge of the B-rep, linear between samples.
struct EdgeSizes {
  std::vector<double> arcLength;  ///< From the start of the edge, ascending, from 0 to its length.
  std::vector<double> value;      ///< Per entry of arcLength, > 0.

  /// The first sample after arc length s; the last one, where there is none, and never the first of all.
  [[nodiscard]] std::size_t sampleAfter(double s) const {
    const auto above = std::upper_bound(arcLength.begin() + 1, arcLength.end() - 1, s);
    return static_cast<std::size_t>(above - arcLength.begin());
  }
  /// Per sample: how many lengths there are from the start to it, the integral of ds / h.
  [[nodiscard]] std::vector<double> divisions() const {
    std::vector<double> sums{0.0};
    for (std::size_t i = 0; i + 1 < value.size(); ++i) {
      const double density = 0.5 * (1.0 / value[i] + 1.0 / value[i + 1]);
      sums.push_back(sums.back() + (arcLength[i + 1] - arcLength[i]) * density);
    }
    return sums;
  }
};

/// How many vertices of the mesh get their size, before gradation, from something else than the base size.
struct SizeSources {
  std::int64_t bySizes = 0;      ///< From vertexSize.
  std::int64_t byCurvature = 0;  ///< From curvature.
  std::int64_t floored = 0;      ///< Of the latter, those that would be smaller, but are a tenth of the base size.
};

/// Target edge length over the repaired mesh. Inside a face it is the least of `inner`, the cones that rise with slope
/// `gradation` from the values on the face's edges, at its vertices and at the limits, and base.
struct SizeField {
  double base = 0.0;              ///< The length asked for, or derived from the count: nowhere more.
  double nominal = 0.0;           ///< The same in the mean over the scale: base, if there is none.
  double gradation = 0.25;        ///< Largest |grad h|.
  std::vector<double> value;      ///< Per vertex of the mesh, > 0.
  std::vector<EdgeSizes> edges;   ///< Per edge of the B-rep; finer than the edge's points where these are sparse.
  std::vector<SizeLimit> limits;  ///< As given, but graded.
  InnerSizes inner;               ///< Empty where neither vertexSize nor curvature nor a scale asks for anything.
  SizeSources sources;
  std::vector<std::int32_t> minimumDivisions;  ///< Per edge of the B-rep, >= 1: what its turns ask for.
  /// Largest distance of an edge from its chords, in units of the size there and of chordSize, whichever is less.
  double mostSagitta = 0.09;
  double chordSize = std::numeric_limits<double>::infinity();  ///< The size that would be, were it the same everywhere.
};

/// The sizes: `size`, or a length such that the elements of the whole field are about `quads`. That is at most 1.7
/// times (with `curvature` 3 times) the length for a field that is the same everywhere. Nowhere above vertexSize.
/// Smaller on short edges, where a face is curved, and where a feature edge turns: at least divisionsPerTurn divisions
/// in a full turn, also in a small closed edge. Not below a tenth of base, except by the divisions of a small closed
/// edge and by limits. Then graded, and levelled where a face is one element wide: the slope there may be more.
/// Complexity O(n log n). Errors: invalidOption, cancelled.
Result<SizeField> computeSizeField(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options,
                                   Progress& progress);

}  // namespace qmcf
