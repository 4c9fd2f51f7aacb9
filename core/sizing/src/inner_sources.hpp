#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/inner_sizes.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// What asks for sizes inside faces: given sizes, curvature and a scale. Lengths from curvature hold where a face is
/// curved and are not linear across a large flat triangle beside that; such triangles are cut until they are as small
/// as what their corners ask for, and with a scale until they are about as small as its triangles.
class InnerSources {
 public:
  /// lowestBase: the smallest base size that will be asked for. Nothing asks if neither vertexSize nor curvature nor a
  /// scale is set.
  InnerSources(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options, double lowestBase);

  [[nodiscard]] bool empty() const { return sizes_.triangles.empty(); }
  /// The sizes under a base size, graded.
  [[nodiscard]] InnerSizes sizes(double base, double gradation) const;
  /// Per edge of the B-rep: the sizes along it.
  [[nodiscard]] std::vector<EdgeSizes> alongEdges(const Brep& brep, const std::vector<EdgeCurve>& curves,
                                                  const InnerSizes& sizes) const;
  /// Which of them rule where under a base size.
  [[nodiscard]] SizeSources counts(double base) const;

 private:
  struct Piece {
    std::array<std::int32_t, 3> corner{};
    std::array<double, 3> beside{};  ///< Per side, from corner c on: what the triangles on it ask for themselves.
  };
  using Edge = std::pair<std::int32_t, std::int32_t>;

  [[nodiscard]] double fromCurvature(std::size_t v, double base) const;
  [[nodiscard]] bool isRough(const std::array<std::int32_t, 3>& corner, double own) const;
  [[nodiscard]] double length(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] std::size_t longestSide(const std::array<std::int32_t, 3>& corner) const;
  void applyScale(const SizeScale& scale);
  std::int32_t middle(std::int32_t a, std::int32_t b, double beside);
  void cut(Piece whole, double own);
  void appendFaces(const TriangleMesh& mesh, const Brep& brep, const std::vector<double>& own);

  double lowestBase_;
  double longest_;                       ///< Of a triangle's sides.
  std::size_t vertexCount_;              ///< Of the mesh.
  InnerSizes sizes_;                     ///< Without values.
  std::vector<double> given_;            ///< Per position; infinite without any.
  std::vector<double> curved_;           ///< Likewise.
  std::vector<double> factor_;           ///< Of the base size, per position; 1 without a scale.
  std::map<Edge, std::int32_t> middle_;  ///< Edges that were cut, by their ends, ascending.
};

}  // namespace qmcf
