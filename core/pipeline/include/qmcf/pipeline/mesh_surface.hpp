#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/trace.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/quality/quality.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/topology/brep.hpp"
#include "qmcf/topology/repair.hpp"

namespace qmcf {

/// Which advancing front makes the quads.
enum class Mode : std::uint8_t {
  qmcf,    ///< Side edges placed by cross field and size field (the paper).
  qmorph,  ///< The original Q-Morph (Owen et al. 1999), the paper's baseline. It asks no cross field.
};
/// The mode's name; the same in C++, JSON and TypeScript.
std::string_view modeName(Mode mode);

/// All options of a run. The same names are used in C++, JSON and TypeScript.
struct MeshOptions {
  std::optional<double> size;  ///< Element edge length in units of the model, > 0. Excludes quads.
  /// Number of elements to aim at, 1 to 10,000,000. Excludes size and sizes. Default 3000 if neither is set.
  std::optional<std::int64_t> quads;
  /// Per vertex of the input: the largest element edge length there, in units of the model, finite and > 0; linear in
  /// the triangles. Empty: none. Without size these are the sizes, with it the smaller of both is. Excludes quads.
  std::vector<double> sizes;
  /// Chord error, in units of the model, > 0: how far the middle of an element's edge may be from a face where that is
  /// curved, and from a curved edge of the part. Elements get no smaller by it than a tenth of the size; a number of
  /// elements holds with it, up to where three times the size would be needed elsewhere. Unset: curved faces have no
  /// smaller elements than flat ones.
  std::optional<double> curvature;
  /// Let the size vary, mostly by less than 1.5 and by 3 at most either way, to fit the cross field and the sizes on
  /// the edges of faces, where that promises better elements: fewer of their rows end inside faces. The number of
  /// elements and the mean size are kept. Needs mode qmcf, and size where there are sizes. Unset: where a number of
  /// elements is asked for, or nothing is.
  std::optional<bool> fitSizes;
  double featureAngle = 30.0;  ///< Dihedral angle in degrees, (0, 180), from which an edge is sharp.
  Mode mode = Mode::qmcf;      ///< The advancing front.
  /// No triangles: those that are left become quadrilaterals in pairs, with all that lies between two of them. Where
  /// that is not possible, every element of a mesh of twice the size is cut at the middles of its edges.
  bool allQuad = false;
  bool repair = true;                ///< false: defects of the input are reported and left as they are.
  double gradation = 0.25;           ///< Largest slope of the size field before it settles inside faces, (0, 1].
  bool alignBoundary = true;         ///< Field constraint: boundary edges.
  bool alignSharp = true;            ///< Field constraint: sharp edges.
  bool alignNonManifold = true;      ///< Field constraint: non-manifold edges.
  bool alignCurvature = true;        ///< Field constraint: principal curvature.
  std::vector<FieldStroke> strokes;  ///< Field constraint: lines to follow (FieldOptions::strokes); finite, not points.
  /// Faces worked on at a time, 1 to 256. Default: as many as the machine has hardware threads. The mesh does not
  /// depend on it. Ignored where the library is built without threads (WebAssembly).
  std::optional<std::int64_t> threads;
  bool trace = false;  ///< Record how each face was meshed, step by step: MeshResult::trace.
};

/// How one face was meshed.
struct FaceReport {
  std::int32_t face = kNone;
  std::string method;  ///< "qmcf", "qmorph", "strip", "recombined", "triangles", "given": what worked; "omitted".
  std::string reason;  ///< Why the earlier steps did not; empty for the first.
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
};

/// The target edge lengths as the front has them: linear on the background triangulations of the faces, joined at the
/// nodes of their edges. Where faces want different lengths at a node, the geometric mean.
struct SizingMesh {
  QuadMesh triangles;
  std::vector<double> size;  ///< Per vertex.
};

/// The input as the later stages see it; enough to draw the part.
struct InspectResult {
  RepairedMesh repaired;
  Brep brep;
};

/// The cross field of every face.
struct FieldResult {
  InspectResult input;
  double size = 0.0;               ///< The element size the field was made for.
  std::vector<Patch> patches;      ///< One per face of the B-rep.
  std::vector<CrossField> fields;  ///< One per patch.
};

/// The lengths of a mesh's edges in units of the target at their midpoints: the size field for the size or number of
/// elements asked for.
struct SizeConformity {
  double meanAbsLog2 = 0.0;  ///< Mean |log2(length / target)|; 0 is perfect.
  double p5 = 0.0;           ///< 5 % of the edges are shorter, in units of the target.
  double median = 0.0;
  double p95 = 0.0;
  double withinSqrt2 = 0.0;  ///< Share of the edges between 1/sqrt2 and sqrt2.
};

/// How the faces were meshed, each by itself: up to where their meshes are relaxed together.
struct MeshTrace {
  TraceScale scale;              ///< Of the coordinates.
  std::vector<FaceTrace> faces;  ///< Per face of the B-rep; without steps where it is omitted.
};

/// A mesh and everything a person should know about it.
struct MeshResult {
  InspectResult input;
  double size = 0.0;
  QuadMesh mesh;
  QualityReport quality;
  std::vector<FaceReport> faces;
  std::int64_t fieldSingularities = 0;  ///< 0 in a mode without a cross field.
  SizeConformity sizeConformity;
  bool elementsCut = false;        ///< Every element was cut, as MeshOptions::allQuad says.
  bool fittedSizes = false;        ///< Sizes vary to fit the field (MeshOptions::fitSizes), by 5 % at least.
  SizeSources sizing;              ///< How many vertices of the repaired input have another size than `size`, and why.
  std::vector<double> vertexSize;  ///< Per vertex of the input: the target edge length there.
  std::int64_t refinedPlaces = 0;  ///< Where elements of the size asked for could not follow the part: smaller there.
  /// Faces that were not relaxed together with the others, across their edges, because they would not be valid then.
  std::int64_t heldFaces = 0;
  std::int64_t heldPlaces = 0;     ///< Places in the others where nothing was, for the same reason.
  std::int64_t slidNodes = 0;      ///< Nodes that the others moved along their edges by more than a tenth of the size.
  std::optional<MeshTrace> trace;  ///< If it was asked for.
};

/// Repair and B-rep only; of the options, repair and featureAngle matter. Errors: as repair() and recoverBrep().
Result<InspectResult> inspectSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress);
/// Up to the cross field.
Result<FieldResult> computeField(const TriangleMesh& input, const MeshOptions& options, Progress& progress);
/// The whole way: a quad-dominant mesh of the input, or an error that says why there is none. The mesh is valid unless
/// all else failed and defects of the part itself are in the way: quality.valid tells, quality.checks say where.
Result<MeshResult> meshSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress);
/// The same. sizing: gets the sizes that the mesh was made with.
Result<MeshResult> meshWithSizing(const TriangleMesh& input, const MeshOptions& options, Progress& progress,
                                  SizingMesh& sizing);

/// The error for the first option out of range, if any.
std::optional<Error> validateOptions(const MeshOptions& options);

}  // namespace qmcf
