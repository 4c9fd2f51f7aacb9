#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "edge_samples.hpp"

namespace qmcf {

/// All samples of all edges as a graph; the samples at a B-rep vertex are one node. Limits inside faces are nodes too.
class SampleGraph {
 public:
  SampleGraph(const EdgeSamples& samples, const Brep& brep, const std::vector<SizeLimit>& limits);

  /// Limits the slope of the sizes, along edges and straight across the faces beside them.
  void grade(double gradation);
  /// About how many quads of these sizes, and no larger ones than `inner`, the surface takes, but at least as many as
  /// so many divisions per edge need. \pre grade() was called.
  [[nodiscard]] double count(const TriangleMesh& mesh, const Brep& brep, const InnerSizes& inner, double gradation,
                             const std::vector<double>& divisions) const;
  /// Copies the sizes to the samples and the limits that the graph was made of.
  void store(EdgeSamples& samples, std::vector<SizeLimit>& limits) const;

 private:
  class Cones;

  [[nodiscard]] double countOnFace(const TriangleMesh& mesh, const BrepFace& face, const Cones& cones) const;
  [[nodiscard]] double countUnder(const InnerSizes& inner, std::size_t face, const Cones& cones) const;
  /// How far from a node its cone meets the base size, at most.
  [[nodiscard]] double farthest(double gradation) const;

  double base_;
  std::size_t firstLimit_ = 0;  ///< The nodes from here on are limits.
  std::vector<Vec3> position_;
  std::vector<double> size_;
  std::vector<double> highest_;                    ///< Per node: what it has to be below to be the tip of a cone.
  std::vector<std::vector<std::int32_t>> ofEdge_;  ///< Per edge, per sample: its node.
  std::vector<std::vector<std::pair<std::int32_t, double>>> neighbors_;  ///< Per node, along edges: node and length.
  std::vector<std::vector<std::int32_t>> faces_;                         ///< Per node: the faces beside it.
  std::vector<std::vector<std::int32_t>> ofFace_;                        ///< Per face: its nodes, ascending.
};

}  // namespace qmcf
