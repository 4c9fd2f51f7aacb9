#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Other than two quadrilaterals at the first vertex of a coedge.
inline bool isCorner(const Coedge& coedge) { return coedge.cornerQuads != 2; }

/// The quarter turns along a loop, in total; 4 for a convex one.
std::int32_t turnOf(const BrepLoop& loop);

/// The coedges of a loop from corner to corner, from the first corner on; empty without corners.
std::vector<std::vector<Coedge>> sidesOf(const BrepLoop& loop);

/// As for meshStrip(): a face with fewer rows than this between its sides takes one.
inline constexpr double kOneRow = 1.6;

/// Rows of elements between the sides of a face, on the mean. wanted: per edge of the B-rep, the divisions that the
/// sizes ask for.
double rowsAcross(const Brep& brep, const BrepFace& face, const std::vector<double>& wanted);

/// The sides of a face that may take a single row of elements. Within a side its edges join smoothly.
struct RowSides {
  std::vector<Coedge> one;                ///< From end to end, the face on its left,
  std::vector<Coedge> other;              ///< and back.
  std::vector<std::vector<Coedge>> ends;  ///< Two; one, where the other end is a tip; or none.
};

/// Of a face between two tips, corners too sharp for anything but a triangle, or between a tip and an end with two
/// corners. Nothing for other faces.
std::optional<RowSides> taperedSides(const BrepFace& face);

/// Of a face with four corners, one quadrilateral in each; the ends are the shorter sides. Nothing for other faces.
std::optional<RowSides> fourSides(const Brep& brep, const BrepFace& face);

/// The face of a strip with its corners as a single row of quadrilaterals takes them: between slanted ends the obtuse
/// ones have an element each, too, or the row would end in triangles.
BrepFace withEnds(BrepFace face);

/// Whether a face has three corners, and each side is shorter than an element.
bool isTinyTriangle(const BrepFace& face, const std::vector<double>& wanted);

/// Whether an odd number of divisions suits a face: a single row between a tip and an end, which has one triangle, or a
/// triangle smaller than an element. With an even number they have two.
bool suitsOdd(const Brep& brep, const BrepFace& face, const std::vector<double>& wanted);

}  // namespace qmcf
