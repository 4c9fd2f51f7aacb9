// Writes the sample parts next to this file, and index.json, which the page's gallery shows.
//
//   node samples/generate.mjs [FOLDER]

import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { samples } from './lib/parts.mjs';

/** Every file of the samples: [{ file, bytes }]. */
export function generate() {
  const parts = samples.map(({ name, file, make }) => {
    const part = make();
    return { file, bytes: file.endsWith('.obj') ? part.toObj(name) : part.toBinaryStl(name) };
  });
  const index = samples.map(({ name, file, description }) => ({ name, file, description }));
  return [...parts, { file: 'index.json', bytes: Buffer.from(`${JSON.stringify(index, null, 2)}\n`) }];
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const folder = process.argv[2] ?? import.meta.dirname;
  mkdirSync(folder, { recursive: true });
  for (const { file, bytes } of generate()) writeFileSync(join(folder, file), bytes);
}
