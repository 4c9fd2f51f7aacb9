import type { InspectResult, MeshResult } from 'qmcf';
import { Ray, Raycaster, Vector2, Vector3, type PerspectiveCamera, type Sphere } from 'three';
import type { Target } from '../state.js';
import { EdgePicker } from './edge_picker.js';
import { outlineOf, type Markable, type Outline } from './highlight_layer.js';
import { elementTriangles } from './mesh_layer.js';
import { SurfacePicker } from './surface_picker.js';

/** Finds what is drawn at a place of the screen, and where a face, edge or element is. */
export class Inspector {
  private part: { readonly result: InspectResult; readonly positions: Float32Array } | undefined;
  private mesh: { readonly result: MeshResult; readonly positions: Float32Array } | undefined;
  // Made when they are first needed.
  private faces: SurfacePicker | undefined;
  private edges: EdgePicker | undefined;
  private elements: { readonly picker: SurfacePicker; readonly element: Int32Array } | undefined;
  private readonly raycaster = new Raycaster();

  setPart(result: InspectResult, positions: Float32Array): void {
    this.part = { result, positions };
    this.faces = undefined;
    this.edges = undefined;
  }

  setMesh(result: MeshResult | undefined, positions: Float32Array): void {
    this.mesh = result && { result, positions };
    this.elements = undefined;
  }

  /**
   * @param onMesh - Whether it is the mesh that is seen, not the part.
   * @param x - In CSS pixels from the left of the view, which is `width` wide and `height` high; `y` from its top.
   */
  pick(camera: PerspectiveCamera, onMesh: boolean, x: number, y: number, width: number, height: number): Target | undefined {
    camera.updateMatrixWorld();
    this.raycaster.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), camera);
    return onMesh ? this.pickElement() : this.pickOnPart(camera, x, y, width, height);
  }

  outlineOf(target: Target, onMesh: boolean): Outline | undefined {
    if (!this.part) {
      return undefined;
    }
    const seen: Markable = {
      part: this.part.result,
      partPositions: this.part.positions,
      mesh: onMesh ? this.mesh?.result : undefined,
      meshPositions: this.mesh?.positions ?? new Float32Array(),
    };
    return outlineOf(target, seen);
  }

  /**
   * From where to look at an element: from its front, a little from where the camera was, and where nothing else is in
   * the way; if there is no such place within `wanted`, from as far away as nothing is.
   *
   * @param before - The unit direction from what was looked at so far to the camera.
   */
  lookout(
    { center, radius }: Sphere,
    normal: Vector3,
    before: Vector3,
    wanted: number,
  ): { direction: Vector3; distance: number } {
    const aside = before.clone().addScaledVector(normal, -before.dot(normal)).normalize();
    const across = new Vector3().crossVectors(normal, aside);
    const tilted = (a: number, b: number) => normal.clone().addScaledVector(aside, a).addScaledVector(across, b).normalize();
    // Never exactly along the axis that the camera turns about.
    const directions = [0.4, 1, -0.4, -1].flatMap((a) => [0, 0.5, -0.5, 1, -1].map((b) => tilted(a, b)));
    let best = { direction: directions[0]!, distance: 0 };
    for (const direction of directions) {
      const distance = Math.min(wanted, 0.9 * this.freeDistance(center, direction, 0.02 * radius));
      if (distance > best.distance) {
        best = { direction, distance };
      }
      if (distance === wanted) {
        break;
      }
    }
    return { direction: best.direction, distance: Math.max(best.distance, 2 * radius) };
  }

  /** How far it is from a point of the mesh to what is next in that direction. */
  private freeDistance(from: Vector3, direction: Vector3, start: number): number {
    const ray = new Ray(from.clone().addScaledVector(direction, start), direction);
    return this.elementPicker()?.picker.pick(ray)?.distance ?? Infinity;
  }

  private facePicker(): SurfacePicker | undefined {
    if (this.part) {
      this.faces ??= new SurfacePicker(this.part.positions, this.part.result.triangles);
    }
    return this.faces;
  }

  private elementPicker(): Inspector['elements'] {
    if (this.mesh && !this.elements) {
      const { corners, element } = elementTriangles(this.mesh.result.elements);
      this.elements = { picker: new SurfacePicker(this.mesh.positions, corners), element };
    }
    return this.elements;
  }

  private pickOnPart(camera: PerspectiveCamera, x: number, y: number, width: number, height: number): Target | undefined {
    if (!this.part) {
      return undefined;
    }
    const { result, positions } = this.part;
    this.edges ??= new EdgePicker(result, positions);
    const hit = this.facePicker()?.pick(this.raycaster.ray);
    const edge = this.edges.pick(camera, x, y, width, height, hit?.distance ?? Infinity);
    if (edge !== undefined) {
      return { kind: 'edge', id: edge };
    }
    return hit && { kind: 'face', id: result.triangleFace[hit.triangle]! };
  }

  private pickElement(): Target | undefined {
    const elements = this.elementPicker();
    const hit = elements?.picker.pick(this.raycaster.ray);
    return hit && { kind: 'element', id: elements!.element[hit.triangle]! };
  }
}
