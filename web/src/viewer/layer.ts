import { Group, type BufferGeometry, type Material, type Object3D } from 'three';

interface Drawable extends Object3D {
  geometry?: BufferGeometry;
  material?: Material | Material[];
}

/** Some objects of the scene that come and go together. */
export class Layer extends Group {
  /** Frees what is on the graphics card and empties the layer. */
  override clear(): this {
    this.traverse((object) => {
      const { geometry, material } = object as Drawable;
      geometry?.dispose();
      for (const one of Array.isArray(material) ? material : material ? [material] : []) {
        one.dispose();
      }
    });
    return super.clear();
  }
}
