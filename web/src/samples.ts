import list from '../../samples/index.json';

/** A part that comes with the page. */
export interface Sample {
  readonly name: string;
  readonly file: string;
  readonly description: string;
  readonly url: string;
  /** Address of a picture, if there is one. */
  readonly picture: string | undefined;
}

const models = import.meta.glob<string>('../../samples/*.{obj,stl,ply}', {
  query: '?url',
  import: 'default',
  eager: true,
});
const pictures = import.meta.glob<string>('../../samples/pictures/*.webp', {
  query: '?url',
  import: 'default',
  eager: true,
});

export const samples: readonly Sample[] = list.flatMap((entry) => {
  const url = models[`../../samples/${entry.file}`];
  const picture = pictures[`../../samples/pictures/${entry.file.replace(/\.\w+$/, '.webp')}`];
  return url === undefined ? [] : [{ ...entry, url, picture }];
});
