import type { InspectResult, MeshResult } from 'qmcf';
import { Raycaster, Vector2, type PerspectiveCamera } from 'three';
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

  private pickOnPart(camera: PerspectiveCamera, x: number, y: number, width: number, height: number): Target | undefined {
    if (!this.part) {
      return undefined;
    }
    const { result, positions } = this.part;
    this.faces ??= new SurfacePicker(positions, result.triangles);
    this.edges ??= new EdgePicker(result, positions);
    const hit = this.faces.pick(this.raycaster.ray);
    const edge = this.edges.pick(camera, x, y, width, height, hit?.distance ?? Infinity);
    if (edge !== undefined) {
      return { kind: 'edge', id: edge };
    }
    return hit && { kind: 'face', id: result.triangleFace[hit.triangle]! };
  }

  private pickElement(): Target | undefined {
    if (!this.mesh) {
      return undefined;
    }
    if (!this.elements) {
      const { corners, element } = elementTriangles(this.mesh.result.elements);
      this.elements = { picker: new SurfacePicker(this.mesh.positions, corners), element };
    }
    const hit = this.elements.picker.pick(this.raycaster.ray);
    return hit && { kind: 'element', id: this.elements.element[hit.triangle]! };
  }
}
