import type { FaceTrace, MeshTrace, TraceKind, TraceStep } from 'qmcf';

/** Corners of an element; the fourth of a triangle is -1. */
export type Corners = readonly [number, number, number, number];

/** An edge of the front, with the open region on its left. */
export interface FrontEdge {
  readonly from: number;
  readonly to: number;
  /** How many of its side edges are missing, 0 to 2; 3 where a seam shall be closed; undefined where nothing was said. */
  readonly state: number | undefined;
}

const limit = 2 ** 26;
const keyOf = (from: number, to: number): number => from * limit + to;

/** The mesh of one face at some step. */
export class FaceReplay {
  /** Whole-number coordinates of each vertex. */
  readonly positions: number[] = [];
  readonly elements = new Map<number, Corners>();
  /** Elements that the last step made or changed. */
  fresh: ReadonlySet<number> = new Set();
  last: TraceStep | undefined;
  private readonly boundary = new Map<number, readonly [number, number]>();
  private readonly states = new Map<number, number>();

  apply(step: TraceStep): void {
    if (step.boundary) {
      this.begin(step.boundary);
    }
    const { vertices = [], elements = [], removed = [], states = [] } = step;
    for (let i = 0; i < vertices.length; i += 4) {
      for (let axis = 0; axis < 3; ++axis) {
        this.positions[3 * vertices[i]! + axis] = vertices[i + 1 + axis]!;
      }
    }
    for (const element of removed) {
      this.elements.delete(element);
    }
    const fresh = new Set<number>();
    for (let i = 0; i < elements.length; i += 5) {
      fresh.add(elements[i]!);
      this.elements.set(elements[i]!, elements.slice(i + 1, i + 5) as unknown as Corners);
    }
    for (let i = 0; i < states.length; i += 3) {
      this.states.set(keyOf(states[i]!, states[i + 1]!), states[i + 2]!);
    }
    this.fresh = step.boundary ? new Set() : fresh;
    this.last = step;
  }

  /** What lies between elements and open region: open loops do not occur. */
  front(): FrontEdge[] {
    const sides = new Map<number, readonly [number, number]>();
    for (const corners of this.elements.values()) {
      const count = corners[3] < 0 ? 3 : 4;
      for (let i = 0; i < count; ++i) {
        const [from, to] = [corners[i]!, corners[(i + 1) % count]!];
        sides.set(keyOf(from, to), [from, to]);
      }
    }
    const edges: FrontEdge[] = [];
    const add = (from: number, to: number) => edges.push({ from, to, state: this.states.get(keyOf(from, to)) });
    for (const [key, [from, to]] of this.boundary) {
      if (!sides.has(key)) {
        add(from, to);
      }
    }
    for (const [key, [from, to]] of sides) {
      if (!sides.has(keyOf(to, from)) && !this.boundary.has(key)) {
        add(to, from);
      }
    }
    return edges;
  }

  private begin(loops: readonly (readonly number[])[]): void {
    this.positions.length = 0;
    this.elements.clear();
    this.boundary.clear();
    this.states.clear();
    for (const loop of loops) {
      loop.forEach((from, i) => {
        const to = loop[(i + 1) % loop.length]!;
        this.boundary.set(keyOf(from, to), [from, to]);
      });
    }
  }
}

/** All steps of one face, or of all faces one after the other, and where in them the player is. */
export class Playback {
  /** The faces that are finished before the present one, and how they ended. */
  readonly finished: FaceReplay[] = [];
  current = new FaceReplay();
  private readonly faces: readonly FaceTrace[];
  private readonly starts: number[] = [];
  private faceAt = 0;
  private at = 0;

  constructor(
    readonly trace: MeshTrace,
    face: number | undefined,
  ) {
    this.faces = trace.faces.filter(({ face: f, steps }) => steps.length > 0 && (face === undefined || f === face));
    let start = 0;
    for (const { steps } of this.faces) {
      this.starts.push(start);
      start += steps.length;
    }
    this.starts.push(start);
    this.restart(0);
  }

  /** Number of steps; positions go from 0 to one less. */
  get length(): number {
    return this.starts.at(-1)!;
  }

  get position(): number {
    return this.at;
  }

  /** The face that is being meshed. */
  get face(): FaceTrace | undefined {
    return this.faces[this.faceAt];
  }

  get elementCount(): number {
    return this.finished.reduce((sum, { elements }) => sum + elements.size, this.current.elements.size);
  }

  /** Goes to a position, forwards step by step, backwards from the start of the face. */
  seek(position: number): void {
    const target = Math.max(0, Math.min(this.length - 1, Math.round(position)));
    if (target < this.at) {
      const face = this.starts.findLastIndex((start) => start <= target);
      this.restart(Math.min(face, this.faces.length - 1));
    }
    while (this.at < target) {
      this.advance();
    }
  }

  /** The nearest position after (or before) this one whose step is of one of the kinds, if there is one. */
  find(kinds: ReadonlySet<TraceKind>, direction: 1 | -1): number | undefined {
    for (let at = this.at + direction; at >= 0 && at < this.length; at += direction) {
      const face = Math.min(this.starts.findLastIndex((start) => start <= at), this.faces.length - 1);
      if (kinds.has(this.faces[face]!.steps[at - this.starts[face]!]!.kind)) {
        return at;
      }
    }
    return undefined;
  }

  private restart(face: number): void {
    while (this.finished.length > face) {
      this.finished.pop();
    }
    this.faceAt = face;
    this.at = this.starts[face]!;
    this.current = new FaceReplay();
    const first = this.faces[face]?.steps[0];
    if (first) {
      this.current.apply(first);
    }
  }

  private advance(): void {
    ++this.at;
    if (this.at === this.starts[this.faceAt + 1]) {
      this.finished.push(this.current);
      this.restart(this.faceAt + 1);
    } else {
      this.current.apply(this.faces[this.faceAt]!.steps[this.at - this.starts[this.faceAt]!]!);
    }
  }
}
