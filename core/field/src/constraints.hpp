#pragma once

#include "curvature.hpp"
#include "qmcf/field/cross_field.hpp"
#include "solve.hpp"

namespace qmcf {

/// Pins the boundary vertices on edges of the kinds that the options name. Always consistent: along the boundary the
/// connection moves the cross of the edges to itself.
void pinBoundary(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds, const FieldOptions& options,
                 FieldConditions& conditions);

/// Pins free vertices along the strokes.
void pinStrokes(const Patch& patch, const IdMap<VertexId, TangentFrame>& frames,
                const std::vector<FieldStroke>& strokes, FieldConditions& conditions);

/// Length of the boundary over the root of the area: where it is large the boundary steers the field by itself
/// (QuadWild's rule, B3 of docs/algorithm.md).
double boundaryDensity(const Patch& patch, const FieldMatrices& matrices);

/// Lets the principal directions pull; with options.mask only where no vertex is pinned, nor any neighbour (alpha of
/// Eq. 4). Replaces the pulls that there were.
void pullToCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                     FieldConditions& conditions);

/// Pins the free vertices with reliable principal directions to these.
void pinCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                  FieldConditions& conditions);

/// Frees vertices pinned to curvature where crosses contradict each other: the corners of a triangle around which they
/// turn, and the ends of an edge along which they differ by more than kLargestTurn (section 3.2.3). Only vertices that
/// are `known` count: the pinned ones before a solve, all of them after it. Returns how many were freed.
std::int32_t removeInconsistentPins(const Patch& patch, const Connection& connection, const FieldVector& crosses,
                                    const std::vector<std::uint8_t>& known, FieldConditions& conditions);

}  // namespace qmcf
