const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** 12,946 */
export function count(value: number): string {
  return whole.format(value);
}

/** "1 face", "12,946 triangles" */
export function counted(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** A length to four significant digits, without an exponent where that is readable. */
export function length(value: number): string {
  return Number(value.toPrecision(4)).toString();
}

/** In place of what was not measured. */
export const none = '–';

/** 0.0 % to 100 %; never "100 %" for what is not all. */
export function percent(share: number | null | undefined): string {
  if (share === null || share === undefined) {
    return none;
  }
  const rounded = Math.floor(share * 1000) / 10;
  return `${rounded === 100 ? '100' : rounded.toFixed(1)} %`;
}

/** Three decimals, or a dash where there is no finite value. */
export function figure(value: number | null | undefined): string {
  return value === null || value === undefined ? none : value.toFixed(3);
}

/** 0.8 s, 12 s, 1 min 05 s */
export function duration(seconds: number): string {
  if (seconds < 60) {
    return `${seconds < 10 ? seconds.toFixed(1) : seconds.toFixed(0)} s`;
  }
  return `${Math.floor(seconds / 60)} min ${String(Math.floor(seconds % 60)).padStart(2, '0')} s`;
}

/** "duplicateVertices" becomes "duplicate vertices". */
export function words(identifier: string): string {
  return identifier.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
}
