import type { Stage } from './tables.js';

/** A triangle mesh in plain buffers. */
export interface TriangleBuffers {
  /** x, y, z of each vertex, in units of the model. */
  readonly positions: Float64Array | Float32Array;
  /** Three vertices of each triangle, counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
}

/** The content of an OBJ, STL or PLY file (the format is found from the content), or a triangle mesh in buffers. */
export type ModelInput = ArrayBuffer | Uint8Array | TriangleBuffers;

/** Which advancing front makes the quads: by cross field and size field, or the original Q-Morph. */
export type Mode = 'qmcf' | 'qmorph';

/** A line between two different points [x, y, z]. */
export interface Stroke {
  readonly from: readonly [number, number, number];
  readonly to: readonly [number, number, number];
}

/** All options of a run; the names are those of the C++ struct. The core checks the values. */
export interface MeshOptions {
  /** Element edge length in units of the model, greater than 0. Excludes {@link MeshOptions.quads}. */
  size?: number | undefined;
  /**
   * Number of elements to aim at, 1 to 10,000,000. Excludes {@link MeshOptions.sizes}. Default 3000 if neither size nor
   * sizes is set.
   */
  quads?: number | undefined;
  /**
   * Largest element edge length at each vertex of the model, each greater than 0, linear in the triangles. The vertices
   * are those of the buffers or of the file, in order; STL has none: there the different points stand for them, in the
   * order of their first appearance. Without {@link MeshOptions.size} these are the sizes, with it the smaller of both
   * is.
   */
  sizes?: Float64Array | Float32Array | readonly number[] | undefined;
  /**
   * Chord error in units of the model, greater than 0: how far the middle of an element's edge may be from a face where
   * that is curved, and from a curved edge. Elements get no smaller by it than a tenth of the size. Default: unset,
   * curved faces have no smaller elements than flat ones.
   */
  curvature?: number | undefined;
  /**
   * Let the size vary, mostly by less than 1.5 and by 3 at most either way, to fit the cross field and the sizes on the
   * edges of faces, where that promises better elements: fewer of their rows end inside faces. The number of elements
   * and the mean size are kept. Needs mode `qmcf`, and `size` where there are `sizes`. Default true with a number of
   * elements, else false.
   */
  fitSizes?: boolean | undefined;
  /** Dihedral angle in degrees, between 0 and 180, from which an edge is sharp. Default 30. */
  featureAngle?: number | undefined;
  /** False: defects of the input are reported and left as they are. Default true. */
  repair?: boolean | undefined;
  /** Default `qmcf`. */
  mode?: Mode | undefined;
  /**
   * True: no triangles. Those that are left become quadrilaterals in pairs, with all that lies between two of them; where
   * that is not possible, every element of a mesh of twice the size is cut at the middles of its edges. Default false.
   */
  allQuad?: boolean | undefined;
  /** Largest slope of the size field before it settles inside faces, above 0 and at most 1. Default 0.25. */
  gradation?: number | undefined;
  /** Field constraint: boundary edges. Default true. */
  alignBoundary?: boolean | undefined;
  /** Field constraint: sharp edges. Default true. */
  alignSharp?: boolean | undefined;
  /** Field constraint: non-manifold edges. Default true. */
  alignNonManifold?: boolean | undefined;
  /** Field constraint: principal curvature. Default true. */
  alignCurvature?: boolean | undefined;
  /**
   * Field constraint: lines that the field shall follow, a short one to give the direction at a point. They hold at the
   * vertices within half an element; edges come first, and where lines contradict each other, the nearer one. Default none.
   */
  strokes?: readonly Stroke[] | undefined;
  /** Of the native program, 1 to 256: faces worked on at a time. Ignored here; the mesh does not depend on it. */
  threads?: number | undefined;
  /** Record how each face is meshed, step by step: {@link MeshResult.trace}. Default false. */
  trace?: boolean | undefined;
}

/** The names of all options, for interfaces that are made from them. */
export const meshOptionNames = [
  'size',
  'quads',
  'sizes',
  'curvature',
  'fitSizes',
  'featureAngle',
  'mode',
  'allQuad',
  'repair',
  'gradation',
  'alignBoundary',
  'alignSharp',
  'alignNonManifold',
  'alignCurvature',
  'strokes',
  'threads',
  'trace',
] as const satisfies readonly (keyof MeshOptions)[];

/** Where a run is. */
export interface ProgressReport {
  readonly stage: Stage;
  /** Share of this stage that is done, 0 to 1. */
  readonly fraction: number;
}

/** How a run is watched and stopped. */
export interface RunControl {
  /** Aborting it rejects the promise with code `cancelled`. */
  signal?: AbortSignal | undefined;
  /** Called some 20 times a second and at every new stage. */
  onProgress?: ((progress: ProgressReport) => void) | undefined;
  /** Give the input's buffers away instead of copying them: they are detached. Default false. */
  transferInput?: boolean | undefined;
}

/** Why an edge of the recovered B-rep is an edge. */
export type EdgeKind = 'nonManifold' | 'boundary' | 'sharp' | 'label';

/** One kind of defect of the input, what was done about it and where. */
export interface RepairItem {
  readonly defect: string;
  /** What was done, for a person. */
  readonly action: string;
  readonly count: number;
  /** Ids in the input, at most 100. */
  readonly elements: readonly number[];
}

/** The repaired input and the faces, edges and vertices that were recovered from it. */
export interface InspectResult {
  /** x, y, z of each vertex after repair. */
  readonly positions: Float64Array;
  /** Three vertices of each triangle. */
  readonly triangles: Int32Array;
  /** Per triangle: its face. */
  readonly triangleFace: Int32Array;
  /** Vertices along all edges, one edge after the other. */
  readonly edgePoints: Int32Array;
  /** Edge `e` is `edgePoints[edgeOffsets[e]]` up to, not including, `edgePoints[edgeOffsets[e + 1]]`. */
  readonly edgeOffsets: Int32Array;
  /** Per edge. */
  readonly edgeKinds: readonly EdgeKind[];
  /** Per face: from the file, or "face N". */
  readonly faceNames: readonly string[];
  readonly report: InspectReport;
}

/** How much of everything there is. */
export interface PartCounts {
  readonly points: number;
  readonly triangles: number;
  readonly bodies: number;
  readonly faces: number;
  readonly loops: number;
  /** In all and by kind. */
  readonly edges: Readonly<Record<'total' | EdgeKind, number>>;
  readonly vertices: number;
}

/** A connected component. */
export interface BodyReport {
  readonly closed: boolean;
  readonly faces: readonly number[];
}

/** One use of an edge by a loop; the face is on its left. */
export interface CoedgeReport {
  readonly edge: number;
  /** The loop runs from the edge's end to its start. */
  readonly reversed: boolean;
  /** Quads wanted at its first vertex, 1 to 4. */
  readonly cornerQuads: number;
}

/** A connected piece of the surface between edges. */
export interface PartFaceReport {
  readonly name: string;
  readonly body: number;
  /** Number of triangles. */
  readonly triangles: number;
  readonly area: number;
  readonly loops: readonly (readonly CoedgeReport[])[];
}

/** A chain of edges of the triangulation between two vertices of the part. */
export interface EdgeReport {
  readonly kind: EdgeKind;
  readonly start: number;
  readonly end: number;
  /** Number of points. */
  readonly points: number;
  readonly length: number;
}

/** A point where edges end. */
export interface VertexReport {
  readonly point: number;
  /** Put on a closed smooth edge only so that it has an end. */
  readonly artificial: boolean;
}

/** What was found in and done to the input. */
export interface InspectReport {
  readonly repair: readonly RepairItem[];
  readonly counts: PartCounts;
  readonly bodies: readonly BodyReport[];
  readonly faces: readonly PartFaceReport[];
  readonly edges: readonly EdgeReport[];
  readonly vertices: readonly VertexReport[];
}

/** One cross per point of the faces' background triangulations: four directions at right angles. */
export interface Crosses {
  /** x, y, z of each point. */
  readonly positions: Float64Array;
  /** x, y, z of one of the four unit directions; the others follow by quarter turns about the normal. */
  readonly directions: Float64Array;
  /** x, y, z of the unit normal. */
  readonly normals: Float64Array;
  /** Element size wanted there. */
  readonly sizes: Float64Array;
  /** What pins the cross: 0 nothing, 1 a boundary, 2 a sharp or 3 a non-manifold edge, 4 curvature, 5 the user. */
  readonly constrained: Uint8Array;
  /** 1 where a pin to curvature was taken back because it contradicted its surroundings. */
  readonly removed: Uint8Array;
  /** The face that the cross belongs to. */
  readonly faces: Int32Array;
}

/** Points where the field has no direction. */
export interface Singularities {
  readonly positions: Float64Array;
  readonly normals: Float64Array;
  /** Quarter turns: +1 becomes a vertex with three quads, -1 one with five. */
  readonly indices: Int32Array;
  readonly faces: Int32Array;
}

/** Lines along the crosses at even distances, an element or more, for pictures. */
export interface Streamlines {
  /** x, y, z of the points of all lines, one line after the other. */
  readonly positions: Float64Array;
  /** Line `l` has the points `offsets[l]` up to, not including, `offsets[l + 1]`. */
  readonly offsets: Int32Array;
}

/** The cross field of every face. */
export interface FieldResult {
  /** The element size that the field was made for. */
  readonly size: number;
  readonly crosses: Crosses;
  readonly singularities: Singularities;
  readonly streamlines: Streamlines;
}

/**
 * Mean, worst and quantiles of one metric over the elements; null where nothing was measured, as over the triangles of a
 * mesh without any, or where there is no finite value.
 */
export interface Distribution {
  readonly mean: number | null;
  readonly worst: number | null;
  /** The worst 1 % of the elements are worse than this. */
  readonly p1: number | null;
  readonly median: number | null;
  /** Elements left out because the metric is not finite. */
  readonly infinite: number;
}

/** What a check came to: `warn` is worth knowing, `fail` makes the mesh invalid, `skip` can't be decided. */
export type CheckStatus = 'pass' | 'warn' | 'fail' | 'skip';

/** One check of the validator. */
export interface ValidityCheck {
  readonly name: string;
  readonly status: CheckStatus;
  /** Defects found; 0 unless the status is `warn` or `fail`. */
  readonly count: number;
  readonly elements: readonly number[];
  /** For a person; empty when passed. */
  readonly sentence: string;
}

/** The irregular vertices of one kind in a ledger. */
export interface LedgerEntry {
  /** At each of the vertices. */
  readonly elements: number;
  readonly vertices: number;
  /** Of all of them together, in quarter turns. */
  readonly index: number;
}

/**
 * What irregular vertices, boundary and triangles of a mesh are worth in quarter turns: in all, four times its Euler
 * characteristic. Sheets that meet in edges with more than two elements are cut apart there.
 */
export interface IndexLedger {
  /** Inner vertices with other than four elements, worth 4 - elements each. */
  readonly interior: readonly LedgerEntry[];
  /** Vertices on the boundary with other than two elements, worth 2 - elements each. */
  readonly boundary: readonly LedgerEntry[];
  readonly interiorIndex: number;
  readonly boundaryIndex: number;
  /** Worth 1 each. */
  readonly triangles: number;
  readonly sum: number;
  readonly sheets: number;
  /** Four times the Euler characteristic of all sheets. */
  readonly fourEuler: number;
  /** The same of the input; null where the input leaves it undecided. */
  readonly partFourEuler: number | null;
  /** The sum is what mesh and input say. */
  readonly closes: boolean;
}

/** What a mesh is and how good it is. Lengths are in units of the model, angles in degrees. */
export interface QualityReport {
  readonly vertices: number;
  readonly quads: number;
  readonly triangles: number;
  /** quads / elements. */
  readonly quadShare: number;
  /** Interior vertices with exactly four elements, all quads / interior vertices; null where there are none. */
  readonly regularShare: number | null;
  readonly interiorVertices: number;
  readonly irregularVertices: number;
  /** Interior vertices with only two elements. */
  readonly doublets: number;
  readonly boundaryEdges: number;
  readonly components: number;
  readonly eulerCharacteristic: number;
  readonly ledger: IndexLedger;
  readonly area: number;
  /** This and the following ones are over the quads. */
  readonly scaledJacobian: Distribution;
  readonly jacobianRatio: Distribution;
  readonly jacobianRatioGauss: Distribution;
  readonly aspectRatio: Distribution;
  readonly edgeRatio: Distribution;
  readonly orthogonalQuality: Distribution;
  readonly minAngle: Distribution;
  readonly maxAngle: Distribution;
  readonly skewness: Distribution;
  readonly warpage: Distribution;
  /** Over the triangles. */
  readonly triangleScaledJacobian: Distribution;
  /** The target length that {@link QualityReport.sizeError} and the recalls were measured with. */
  readonly size: number;
  /** Mean |log2(edge length / size)|. */
  readonly sizeError: number;
  /** Of element centres from the input, weighted by area. */
  readonly meanDistance?: number | null;
  /** Of vertices and element centres from the input. */
  readonly largestDistance?: number | null;
  /**
   * Of the input from the mesh, measured at some 2000 of its vertices and at the centres of some 2000 of its triangles,
   * evenly spread, not at all of them.
   */
  readonly largestGap?: number | null;
  /** Those of these places that are farther from the mesh than 1.5 target lengths. */
  readonly missed?: readonly (readonly [number, number, number])[];
  /** Share of the input's sharp edge length that the mesh keeps. */
  readonly sharpRecall?: number | null;
  /** The same of its boundary; absent when it has none. */
  readonly boundaryRecall?: number | null;
  /** The same of its non-manifold edges. */
  readonly nonManifoldRecall?: number | null;
  /** Share of the input's feature corners that have a vertex. */
  readonly cornerRecall?: number | null;
  readonly checks: readonly ValidityCheck[];
  /** No check failed. */
  readonly valid: boolean;
}

/** How one face was meshed. */
export interface FaceReport {
  readonly face: number;
  /** The step of the ladder that worked. */
  readonly method: 'qmcf' | 'qmorph' | 'strip' | 'recombined' | 'triangles' | 'given' | 'omitted';
  /** Why the earlier steps did not; empty for the first. */
  readonly reason: string;
  readonly quads: number;
  readonly triangles: number;
}

/** Edge lengths against the size field that the run worked with. */
export interface SizeConformity {
  /** Mean |log2(length / target)|; 0 is perfect. */
  readonly meanAbsLog2: number;
  /** 5 % of the edges are shorter, in units of the target. */
  readonly p5: number;
  readonly median: number;
  readonly p95: number;
  /** Share of the edges between 1/sqrt2 and sqrt2 of the target. */
  readonly withinSqrt2: number;
}

/** How many vertices of the repaired model have another size than the one everywhere, before it was graded, and why. */
export interface SizeSources {
  /** {@link MeshOptions.sizes} asked for it. */
  readonly bySizes: number;
  /** {@link MeshOptions.curvature} asked for it. */
  readonly byCurvature: number;
  /** Of the latter, those that would be smaller but are a tenth of the size. */
  readonly floored: number;
}

/** Everything a person should know about a mesh. */
export interface MeshReport {
  readonly size: number;
  readonly quality: QualityReport;
  readonly faces: readonly FaceReport[];
  readonly repair: readonly RepairItem[];
  readonly fieldSingularities: number;
  /** Where elements of the size asked for could not follow the part, so that there are smaller ones. */
  readonly refinedPlaces: number;
  /** Faces that were not relaxed together with the others, across their edges, because they would not be valid then. */
  readonly heldFaces: number;
  /** Places in the others where nothing was, for the same reason. */
  readonly heldPlaces: number;
  /** Nodes that the others moved along their edges by more than a tenth of the element size. */
  readonly slidNodes: number;
  /** Whether every element was cut, since pairing triangles gave no whole, valid mesh: {@link MeshOptions.allQuad}. */
  readonly elementsCut: boolean;
  /** Whether sizes vary to fit the field, by 5 % at least: {@link MeshOptions.fitSizes}. */
  readonly fittedSizes: boolean;
  readonly sizing: SizeSources;
  /** The lengths of the mesh's edges in units of the target at their midpoints. */
  readonly sizeConformity: SizeConformity;
}

/** The arrays of a quad-dominant mesh. */
export interface MeshArrays {
  /** x, y, z of each vertex. */
  readonly positions: Float64Array;
  /** Four vertices of each element, counter-clockwise; the fourth of a triangle is -1. */
  readonly elements: Int32Array;
  /** Per element: its face. */
  readonly elementFace: Int32Array;
  /** Edges of the mesh on edges of the part, three numbers each: two vertices and the edge of the part. */
  readonly featureSegments: Int32Array;
  /** Per face: from the file, or "face N". */
  readonly faceNames: readonly string[];
}

/** What a step of a face's history is; docs/trace.md tells them apart. */
export type TraceKind =
  | 'start'
  | 'star'
  | 'seed'
  | 'quad'
  | 'collision'
  | 'closure'
  | 'seam'
  | 'transition'
  | 'leftover'
  | 'paired'
  | 'strip'
  | 'triangulated'
  | 'cleanup'
  | 'smooth'
  | 'doublet'
  | 'pair'
  | 'collapse'
  | 'refill'
  | 'cavity'
  | 'untangle'
  | 'subdivision';

/** One change of a face's mesh. What would be empty or 0 is absent. */
export interface TraceStep {
  readonly kind: TraceKind;
  /** Present where the mesh begins anew, without vertices and elements: the loops of the face. */
  readonly boundary?: readonly (readonly number[])[];
  /** The front edge that it was made on. */
  readonly base?: readonly [number, number];
  /** How desperate the front was, 0 to 2. */
  readonly pass?: number;
  /** Attempts since the last step that were rolled back. */
  readonly undone?: number;
  /** From and to of front edges that were put off since the last step, the first 32. */
  readonly failed?: readonly number[];
  /** Vertex, x, y, z of each vertex that is new or has moved. */
  readonly vertices?: readonly number[];
  /** Element and its four corners, -1 for no fourth, of each element that is new or has other corners. */
  readonly elements?: readonly number[];
  /** Elements that are gone. */
  readonly removed?: readonly number[];
  /** From, to and state of front edges: how many side edges are missing, 0 to 2, or 3 where a seam shall be closed. */
  readonly states?: readonly number[];
}

/** How one face was meshed. */
export interface FaceTrace extends Pick<FaceReport, 'face' | 'method' | 'reason'> {
  readonly steps: readonly TraceStep[];
}

/** How all faces were meshed, each by itself. */
export interface MeshTrace {
  readonly format: 'qmcf-trace';
  readonly version: 1;
  /** The point of the coordinates x, y, z is `origin + unit * (x, y, z)`. */
  readonly origin: readonly [number, number, number];
  readonly unit: number;
  readonly faces: readonly FaceTrace[];
}

/** Formats that a mesh can be written in; the names are the file name extensions. */
export const outputFormats = ['obj', 'vtu', 'ply', 'stl', 'msh', 'inp', 'bdf'] as const;

/** A format that a mesh can be written in. */
export type OutputFormat = (typeof outputFormats)[number];

/** A mesh and what there is to know about it. */
export interface MeshResult extends MeshArrays {
  /** The element size that was asked for, or that followed from the count. */
  readonly size: number;
  /** Per element: 1 is a square or an equilateral triangle, 0 or less is unusable. */
  readonly elementScaledJacobian: Float64Array;
  readonly report: MeshReport;
  /** If the option `trace` asked for it. */
  readonly trace?: MeshTrace;
  /** The content of a file of this mesh. Errors: `unsupportedOutput`, `cancelled` after the mesher was disposed of. */
  file(format: OutputFormat): Promise<Uint8Array<ArrayBuffer>>;
}
