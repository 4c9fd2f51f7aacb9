/** Edge lengths at the vertices of a part, in its order, from a file with one number per line. */
export interface SizesFile {
  readonly name: string;
  readonly values: Float64Array;
  /** Another one for each file that is read. */
  readonly id: number;
}

let lastId = 0;

/** Whether there are as many numbers as vertices is for the core to say. Throws a sentence that names the line. */
export function parseSizes(name: string, text: string): SizesFile {
  const lines = text.trimEnd().split('\n');
  const values = Float64Array.from(lines, (line, index) => {
    const value = line.trim() === '' ? NaN : Number(line);
    if (!(value > 0 && Number.isFinite(value))) {
      throw new Error(`Line ${index + 1}: each line must hold one edge length above 0, for one vertex of the part.`);
    }
    return value;
  });
  return { name, values, id: ++lastId };
}
