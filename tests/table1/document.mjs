// Puts the measured Table 1 and pictures of its meshes into docs/algorithm.md.

import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';

const ROOT = resolve(import.meta.dirname, '../..');
const DOCUMENT = join(ROOT, 'docs/algorithm.md');
const [BEGIN, END] = ['<!-- table 1 -->\n', '<!-- end of table 1 -->'];
const WIDTH = 640;

const picture = (part, mode) => `images/table1-${part.short}-${mode}.png`;

/** Draws the mesh of one part and mode for the documentation. */
export function drawMesh(part, mode, mesh) {
  const args = [join(ROOT, 'tests/tools/render.mjs'), mesh, join(ROOT, 'docs', picture(part, mode)), '--width', String(WIDTH),
    ...part.view, '--no-legend'];
  execFileSync(process.execPath, args);
}

function markdownTable([header, ...rows]) {
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [line(header), line(header.map((_, i) => (i < 2 ? '---' : '---:'))), ...rows.map(line)].join('\n');
}

/** tables: [{ quads, rows }], rows as printed, the header first. */
export function writeDocument(tables, parts) {
  const text = readFileSync(DOCUMENT, 'utf8');
  const [from, to] = [text.indexOf(BEGIN), text.indexOf(END)];
  if (from < 0 || to < from) throw new Error('docs/algorithm.md has no place for the table');
  const written = tables.map(({ quads, rows }) => `About ${quads} elements:\n\n${markdownTable(rows.map((row) => row.slice(0, -1)))}`);
  const pictures = [
    '| Q-Morph | QMCF |', '| --- | --- |',
    ...parts.map((part) => {
      const image = (mode, method) => `![${part.name}, ${method}](${picture(part, mode)})`;
      return `| ${image('qmorph', 'Q-Morph')} | ${image('qmcf', 'QMCF')} |`;
    }),
  ];
  const body = [...written, pictures.join('\n')].join('\n\n');
  writeFileSync(DOCUMENT, `${text.slice(0, from + BEGIN.length)}\n${body}\n\n${text.slice(to)}`);
}
