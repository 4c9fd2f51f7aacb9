// The parts of the figures that are no samples: small stand-ins for those in the paper's figures.

import { arc, Part } from '../../samples/lib/part.mjs';

const SEGMENTS = 64;

/** A flat L with a round hole, turned so that no edge runs along an axis. */
function flatPart() {
  const turn = (x, y) => {
    const [c, s] = [Math.cos(0.45), Math.sin(0.45)];
    return [c * x - s * y, s * x + c * y, 0];
  };
  const place = (points) => points.map(([x, y]) => turn(x, y));
  const part = new Part();
  part.planar([place([[0, 0], [4, 0], [4, 1.6], [1.6, 1.6], [1.6, 4], [0, 4]]), place(arc(0.8, 0.8, 0.4, SEGMENTS))], [0, 0, 1]);
  return part;
}

/** A tube of radius 1 along z that is cut obliquely at the top. */
function obliqueTube() {
  const rows = Array.from({ length: 41 }, (_, i) =>
    Array.from({ length: SEGMENTS }, (_, j) => {
      const angle = (2 * Math.PI * j) / SEGMENTS;
      const [x, y] = [Math.cos(angle), Math.sin(angle)];
      return [x, y, (i / 40) * (2.6 + 1.1 * x)];
    }));
  const part = new Part();
  part.grid(rows, { closedColumns: true });
  return part;
}

/** A tube on a sheet that goes on under it: three faces meet in a circle. */
function tubeOnSheet() {
  const circle = (z) => arc(0, 0, 0.8, SEGMENTS).map(([x, y]) => [x, y, z]);
  const part = new Part();
  part.planar([[[-2, -1.6, 0], [2, -1.6, 0], [2, 1.6, 0], [-2, 1.6, 0]], circle(0)], [0, 0, 1]);
  part.planar([circle(0)], [0, 0, 1]);
  part.strip(circle(0), circle(1.4), { closed: true });
  return part;
}

/** A sphere of radius 1: latitudes and longitudes, poles on the z axis. */
function sphere() {
  const rows = Array.from({ length: 33 }, (_, i) =>
    Array.from({ length: SEGMENTS }, (_, j) => {
      const [latitude, longitude] = [Math.PI * (i / 32 - 0.5), (2 * Math.PI * j) / SEGMENTS];
      return [Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude)];
    }));
  const part = new Part();
  part.grid(rows, { closedColumns: true });
  return part;
}

export const parts = { flatPart, obliqueTube, tubeOnSheet, sphere };
