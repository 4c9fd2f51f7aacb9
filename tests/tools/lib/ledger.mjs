// The Gauss-Bonnet ledger of a mesh, counted again from its elements alone: what the program's report says has to agree.

import { readFileSync } from 'node:fs';

/** The elements of an OBJ file as lists of 0-based vertices. */
export function readElements(file) {
  return readFileSync(file, 'utf8')
    .split('\n')
    .filter((line) => line.startsWith('f '))
    .map((line) => line.slice(2).trim().split(/\s+/).map((corner) => parseInt(corner, 10) - 1));
}

const keyOf = (a, b) => (a < b ? `${a},${b}` : `${b},${a}`);

/** Groups of the elements around one vertex that hang together through edges with two elements; closed: no edge is open. */
function fansAt(vertex, around, elements, uses) {
  const spokes = around.map((e) => {
    const corners = elements[e];
    const at = corners.indexOf(vertex);
    return [corners.at(at - 1), corners[(at + 1) % corners.length]].map((other) => keyOf(vertex, other));
  });
  const left = new Set(around.keys());
  const fans = [];
  while (left.size > 0) {
    const fan = { size: 0, closed: true };
    const waiting = [left.values().next().value];
    left.delete(waiting[0]);
    while (waiting.length > 0) {
      const i = waiting.pop();
      ++fan.size;
      for (const spoke of spokes[i]) {
        if (uses.get(spoke) !== 2) fan.closed = false;
        else for (const j of left) if (spokes[j].includes(spoke)) waiting.push(j), left.delete(j);
      }
    }
    fans.push(fan);
  }
  return fans;
}

/** { interiorIndex, boundaryIndex, triangles, sum, fourEuler } of a mesh cut where edges have more than two elements. */
export function countLedger(elements) {
  const uses = new Map();
  const around = new Map();
  elements.forEach((corners, e) => {
    corners.forEach((a, i) => {
      const key = keyOf(a, corners[(i + 1) % corners.length]);
      uses.set(key, (uses.get(key) ?? 0) + 1);
      if (!around.has(a)) around.set(a, []);
      around.get(a).push(e);
    });
  });
  const ledger = { interiorIndex: 0, boundaryIndex: 0, triangles: elements.filter(({ length }) => length === 3).length };
  let vertices = 0;
  for (const [vertex, list] of around) {
    for (const { size, closed } of fansAt(vertex, list, elements, uses)) {
      ++vertices;
      if (closed) ledger.interiorIndex += 4 - size;
      else ledger.boundaryIndex += 2 - size;
    }
  }
  let edges = 0;
  for (const count of uses.values()) edges += count === 2 ? 1 : count;
  ledger.sum = ledger.interiorIndex + ledger.boundaryIndex + ledger.triangles;
  ledger.fourEuler = 4 * (vertices - edges + elements.length);
  return ledger;
}

/** What is wrong with the ledger that a report has for a mesh; null if nothing. */
export function ledgerFault(report, elements) {
  if (!report.ledger) return 'no ledger';
  const counted = countLedger(elements);
  for (const [name, value] of Object.entries(counted)) {
    if (report.ledger[name] !== value) return `ledger: ${name} is ${value}, reported as ${report.ledger[name]}`;
  }
  for (const part of ['interior', 'boundary']) {
    const total = report.ledger[part].reduce((sum, { index }) => sum + index, 0);
    if (total !== counted[`${part}Index`]) return `ledger: the ${part}'s entries add up to ${total}`;
  }
  if (counted.sum !== counted.fourEuler || !report.ledger.closes) return 'ledger: does not close';
  return null;
}
