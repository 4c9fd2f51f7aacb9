// A software rasteriser: polygons with depth, outlines inside them, lines and discs on top of the surface.

import { encodePng } from './png.mjs';
import { forEachDot } from './font.mjs';

const BACKGROUND = [250, 250, 248];

/** An image `scale` times as large as what is written, so that averaging smooths edges. Depth grows towards the eye. */
export class Raster {
  constructor(width, height, scale) {
    this.scale = scale;
    this.outWidth = width;
    this.outHeight = height;
    this.width = width * scale;
    this.height = height * scale;
    this.depth = new Float32Array(this.width * this.height).fill(-Infinity);
    this.rgb = new Uint8Array(this.width * this.height * 3);
    for (let pixel = 0; pixel < this.depth.length; pixel++) this.put(pixel, ...BACKGROUND);
  }

  put(pixel, r, g, b) {
    this.rgb[pixel * 3] = r;
    this.rgb[pixel * 3 + 1] = g;
    this.rgb[pixel * 3 + 2] = b;
  }

  /**
   * Fills a polygon of screen points [x, y, depth], as triangles around its middle. Its outline, `line` pixels wide
   * inside it, is in colour `ink`.
   */
  polygon(points, colour, ink, line) {
    const n = points.length;
    const middle = [0, 0, 0];
    for (const p of points) for (let k = 0; k < 3; k++) middle[k] += p[k] / n;
    const sides = points.map((p, i) => side(p, points[(i + 1) % n]));
    if (n === 3) this.triangle(points[0], points[1], points[2], sides, colour, ink, line);
    else for (let i = 0; i < n; i++) this.triangle(points[i], points[(i + 1) % n], middle, sides, colour, ink, line);
  }

  triangle(a, b, c, sides, colour, ink, line) {
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area === 0 || !Number.isFinite(area)) return;
    const x0 = Math.max(0, Math.floor(Math.min(a[0], b[0], c[0])));
    const x1 = Math.min(this.width - 1, Math.ceil(Math.max(a[0], b[0], c[0])));
    const y0 = Math.max(0, Math.floor(Math.min(a[1], b[1], c[1])));
    const y1 = Math.min(this.height - 1, Math.ceil(Math.max(a[1], b[1], c[1])));
    for (let y = y0; y <= y1; y++) {
      for (let x = x0; x <= x1; x++) {
        const px = x + 0.5;
        const py = y + 0.5;
        const wa = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) / area;
        const wb = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) / area;
        const wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const depth = wa * a[2] + wb * b[2] + wc * c[2];
        const pixel = y * this.width + x;
        if (depth <= this.depth[pixel]) continue;
        this.depth[pixel] = depth;
        const [r, g, bl] = isNearSide(sides, px, py, line) ? ink : colour;
        this.put(pixel, r, g, bl);
      }
    }
  }

  /** A line between two points [x, y, depth], seen where it is not more than `bias` behind the surface. */
  line(a, b, width, colour, bias) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const steps = Math.max(1, Math.ceil(length));
    const radius = width / 2;
    for (let i = 0; i <= steps; i++) {
      const t = i / steps;
      const at = [0, 1, 2].map((k) => a[k] + (b[k] - a[k]) * t);
      this.stamp(at, radius, colour, bias);
    }
  }

  /** A disc at a point [x, y, depth] with a light rim, whole if its middle is not more than `bias` behind the surface. */
  disc(at, radius, colour, bias) {
    const [x, y] = [Math.floor(at[0]), Math.floor(at[1])];
    if (x < 0 || y < 0 || x >= this.width || y >= this.height) return;
    let hidden = true;
    for (let dy = -1; dy <= 1; dy++) {
      for (let dx = -1; dx <= 1; dx++) {
        const pixel = Math.min(this.height - 1, Math.max(0, y + dy)) * this.width + Math.min(this.width - 1, Math.max(0, x + dx));
        if (at[2] + bias >= this.depth[pixel]) hidden = false;
      }
    }
    if (hidden) return;
    this.stamp([at[0], at[1], Infinity], radius * 1.3, [255, 255, 255], 0);
    this.stamp([at[0], at[1], Infinity], radius, colour, 0);
  }

  stamp([cx, cy, depth], radius, colour, bias) {
    const x0 = Math.max(0, Math.floor(cx - radius));
    const x1 = Math.min(this.width - 1, Math.ceil(cx + radius));
    const y0 = Math.max(0, Math.floor(cy - radius));
    const y1 = Math.min(this.height - 1, Math.ceil(cy + radius));
    for (let y = y0; y <= y1; y++) {
      for (let x = x0; x <= x1; x++) {
        if ((x + 0.5 - cx) ** 2 + (y + 0.5 - cy) ** 2 > radius * radius) continue;
        const pixel = y * this.width + x;
        if (depth + bias >= this.depth[pixel]) this.put(pixel, ...colour);
      }
    }
  }

  /** Text with its upper left corner at (x, y) of the written image. */
  text(x, y, text, colour, size = 2) {
    const dot = size * this.scale;
    forEachDot(text, (column, row) => {
      for (let dy = 0; dy < dot; dy++) {
        for (let dx = 0; dx < dot; dx++) {
          const px = Math.round(x * this.scale + column * dot + dx);
          const py = Math.round(y * this.scale + row * dot + dy);
          if (px >= 0 && py >= 0 && px < this.width && py < this.height) this.put(py * this.width + px, ...colour);
        }
      }
    });
  }

  /** A filled rectangle in pixels of the written image. */
  box(x, y, width, height, colour) {
    const right = Math.min(this.width, (x + width) * this.scale);
    const bottom = Math.min(this.height, (y + height) * this.scale);
    for (let py = y * this.scale; py < bottom; py++) {
      for (let px = x * this.scale; px < right; px++) this.put(py * this.width + px, ...colour);
    }
  }

  /** Averages down to the written size, at (left, top) of a larger image. */
  copyTo(target, targetWidth, left, top) {
    const { scale, width, rgb } = this;
    const area = scale * scale;
    for (let y = 0; y < this.outHeight; y++) {
      for (let x = 0; x < this.outWidth; x++) {
        for (let k = 0; k < 3; k++) {
          let sum = 0;
          for (let sy = 0; sy < scale; sy++) {
            for (let sx = 0; sx < scale; sx++) sum += rgb[((y * scale + sy) * width + x * scale + sx) * 3 + k];
          }
          target[((top + y) * targetWidth + left + x) * 3 + k] = sum / area;
        }
      }
    }
  }
}

function side(p, q) {
  const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
  const length = Math.hypot(dx, dy);
  return length > 0 ? { x: p[0], y: p[1], dx: dx / length, dy: dy / length, length } : null;
}

function isNearSide(sides, x, y, width) {
  for (const s of sides) {
    if (s === null) continue;
    const across = (x - s.x) * s.dy - (y - s.y) * s.dx;
    if (across > width || across < -width) continue;
    const along = (x - s.x) * s.dx + (y - s.y) * s.dy;
    if (along >= -width && along <= s.length + width) return true;
  }
  return false;
}

/** Puts rasters of equal size side by side, `columns` in a row, under a header as wide as they are, and encodes it all. */
export function encodeSheet(header, rasters, columns) {
  const { outWidth, outHeight } = rasters[0];
  const rows = Math.ceil(rasters.length / columns);
  const width = outWidth * columns;
  const top = header === null ? 0 : header.outHeight;
  const height = top + outHeight * rows;
  const rgb = new Uint8Array(width * height * 3).fill(255);
  if (header !== null) header.copyTo(rgb, width, 0, 0);
  rasters.forEach((raster, i) => {
    raster.copyTo(rgb, width, (i % columns) * outWidth, top + Math.floor(i / columns) * outHeight);
  });
  return encodePng(width, height, rgb);
}
