import type { MeshResult } from 'qmcf';
import { BufferAttribute, BufferGeometry, type Color, Mesh, type MeshStandardMaterial, Object3D } from 'three';
import type { Frame } from './frame.js';
import { Layer } from './layer.js';
import { lineSegments, gather } from './lines.js';
import { markerPoints, type Marker } from './markers.js';
import { cornerNormals } from './normals.js';
import { qualityColor, type Palette } from './palette.js';
import { surfaceMaterial } from './part_layer.js';
import { faceTints } from './tints.js';

/** Share of the quality's own colour, unshaded, so that it can be compared with the legend. */
const qualityFlatness = 0.65;

/** How the mesh is shown. */
export interface MeshLook {
  readonly faceColors: boolean;
  readonly quality: boolean;
  readonly irregular: boolean;
}

/** The quads with their edges, the triangles in a colour of their own, and the irregular vertices. */
export class MeshLayer extends Layer {
  private paint: (() => void) | undefined;
  private readonly flatness = { value: 0 };
  private tints: Uint8Array = new Uint8Array();
  private irregular: Object3D | undefined;
  private triangles: Object3D | undefined;
  private look: MeshLook = { faceColors: true, quality: false, irregular: false };

  show(mesh: MeshResult, frame: Frame, palette: Palette): void {
    this.clear();
    const positions = frame.place(mesh.positions);
    this.add(this.surface(mesh, positions, palette));
    const pairs = Array.from(mesh.featureSegments).filter((_, i) => i % 3 !== 2);
    if (pairs.length > 0) {
      const lines = lineSegments(gather(positions, pairs), palette.sharp, 2);
      lines.renderOrder = 1;
      this.add(lines);
    }
    this.triangles = triangleOutlines(mesh, positions, palette);
    this.triangles.visible = this.look.quality;
    this.add(this.triangles);
    this.irregular = markerPoints(irregularMarkers(mesh, positions), 12, palette);
    this.irregular.visible = this.look.irregular;
    this.add(this.irregular);
  }

  setLook(look: MeshLook): void {
    const repaint = look.faceColors !== this.look.faceColors || look.quality !== this.look.quality;
    this.look = look;
    this.flatness.value = look.quality ? qualityFlatness : 0;
    if (repaint) {
      this.paint?.();
    }
    if (this.irregular && this.triangles) {
      this.irregular.visible = look.irregular;
      this.triangles.visible = look.quality;
    }
  }

  private surface(mesh: MeshResult, positions: Float32Array, palette: Palette): Mesh {
    this.tints = faceTints(mesh.elements, 4, mesh.elementFace, mesh.faceNames.length);
    const corners = mesh.elements.map((vertex, i) => (vertex < 0 ? mesh.elements[i - 1]! : vertex));
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(gather(positions, corners), 3));
    const normals = cornerNormals({ positions, corners: mesh.elements, cornersEach: 4, face: mesh.elementFace });
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.setAttribute('sides', new BufferAttribute(sideDistances(mesh.elements), 4, true));
    geometry.setIndex(new BufferAttribute(halves(mesh.elements), 1));
    const colors = new BufferAttribute(new Float32Array(3 * corners.length), 3);
    geometry.setAttribute('color', colors);
    this.paint = () => {
      for (let element = 0; element < mesh.elementFace.length; ++element) {
        const { r, g, b } = this.colorOf(mesh, element, palette);
        for (let corner = 4 * element; corner < 4 * element + 4; ++corner) {
          colors.setXYZ(corner, r, g, b);
        }
      }
      colors.needsUpdate = true;
    };
    this.paint();
    return new Mesh(geometry, withEdges(surfaceMaterial(), palette.meshEdge, this.flatness));
  }

  private colorOf(mesh: MeshResult, element: number, palette: Palette): Color {
    if (this.look.quality) {
      return qualityColor(mesh.elementScaledJacobian[element]!);
    }
    if (mesh.elements[4 * element + 3]! < 0) {
      return palette.triangle;
    }
    return this.look.faceColors
      ? palette.faces[this.tints[mesh.elementFace[element]!]!]!.clone().lerp(palette.plain, 0.2)
      : palette.plain;
  }
}

/** The elements cut into triangles: three vertices each, and the element of each. */
export function elementTriangles(elements: Int32Array): { corners: Int32Array; element: Int32Array } {
  const index = halves(elements);
  const element = new Int32Array(index.length / 3).map((_, t) => Math.floor(index[3 * t]! / 4));
  return { corners: new Int32Array(index).map((corner) => elements[corner]!), element };
}

/** A border around each triangle, for when its colour says something else. */
function triangleOutlines({ elements }: MeshResult, positions: Float32Array, palette: Palette): Object3D {
  const pairs: number[] = [];
  for (let i = 0; i < elements.length; i += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = elements.subarray(i, i + 4);
    if (d < 0) {
      pairs.push(a, b, b, c, c, a);
    }
  }
  if (pairs.length === 0) {
    return new Object3D();
  }
  const lines = lineSegments(gather(positions, pairs), palette.triangle, 3);
  lines.renderOrder = 2;
  return lines;
}

/** Two triangles of each quad, one of each triangle. */
function halves(elements: Int32Array): Uint32Array {
  const index: number[] = [];
  for (let i = 0; i < elements.length; i += 4) {
    index.push(i, i + 1, i + 2);
    if (elements[i + 3]! >= 0) {
      index.push(i, i + 2, i + 3);
    }
  }
  return new Uint32Array(index);
}

/** Per corner: how far it is from each side, 0 or 1, so that the fragment shader knows how near a side is. */
function sideDistances(elements: Int32Array): Uint8Array {
  const quad = [0, 255, 255, 0, 0, 0, 255, 255, 255, 0, 0, 255, 255, 255, 0, 0];
  const triangle = [0, 255, 0, 255, 0, 0, 255, 255, 255, 0, 0, 255, 255, 255, 255, 255];
  const out = new Uint8Array(4 * elements.length);
  for (let i = 0; i < elements.length; i += 4) {
    out.set(elements[i + 3]! < 0 ? triangle : quad, 4 * i);
  }
  return out;
}

/**
 * Draws the elements' sides in the fragment shader: always in front, with soft borders, and fading where elements are
 * smaller than a few pixels. `flatness` is the share of the surface's colour that no light changes.
 */
function withEdges(material: MeshStandardMaterial, color: Color, flatness: { value: number }): MeshStandardMaterial {
  material.onBeforeCompile = (shader) => {
    shader.uniforms['edgeColor'] = { value: color };
    shader.uniforms['flatness'] = flatness;
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute vec4 sides;\nvarying vec4 vSides;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvSides = sides;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec4 vSides;\nuniform vec3 edgeColor;\nuniform float flatness;')
      .replace(
        '#include <opaque_fragment>',
        /* glsl */ `
        vec4 perPixel = max(fwidth(vSides), vec4(1e-6));
        vec4 pixels = vSides / perPixel;
        float nearest = min(min(pixels.x, pixels.y), min(pixels.z, pixels.w));
        float edge = 1.0 - smoothstep(0.35, 1.15, nearest);
        float crowding = max(max(perPixel.x, perPixel.y), max(perPixel.z, perPixel.w));
        edge *= mix(0.82, 0.22, smoothstep(0.12, 0.45, crowding));
        outgoingLight = mix(mix(outgoingLight, diffuseColor.rgb, flatness), edgeColor, edge);
        #include <opaque_fragment>`,
      );
  };
  return material;
}

/** Interior vertices with another number of elements than four. */
function irregularMarkers(mesh: MeshResult, positions: Float32Array): Marker[] {
  const vertices = positions.length / 3;
  const uses = new Int32Array(vertices);
  const onBorder = new Uint8Array(vertices);
  mesh.featureSegments.forEach((vertex, i) => {
    if (i % 3 !== 2) {
      onBorder[vertex] = 1;
    }
  });
  for (const vertex of mesh.elements) {
    if (vertex >= 0) {
      uses[vertex]! += 1;
    }
  }
  const markers: Marker[] = [];
  for (let v = 0; v < vertices; ++v) {
    if (uses[v] !== 4 && uses[v]! > 0 && !onBorder[v]) {
      markers.push({ index: 4 - uses[v]!, position: [positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!] });
    }
  }
  return markers;
}
