import { svg } from '../dom.js';

const icon = (body: string) =>
  `<svg viewBox="0 0 20 20" width="18" height="18" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${body}</svg>`;

export const icons = {
  open: () => svg(icon('<path d="M10 13V4M6.5 7.5 10 4l3.5 3.5M4 13v2.5h12V13"/>')),
  gallery: () =>
    svg(
      icon(
        '<rect x="3.5" y="3.5" width="5.5" height="5.5" rx="1"/><rect x="11" y="3.5" width="5.5" height="5.5" rx="1"/><rect x="3.5" y="11" width="5.5" height="5.5" rx="1"/><rect x="11" y="11" width="5.5" height="5.5" rx="1"/>',
      ),
    ),
  fit: () => svg(icon('<path d="M3.5 7V3.5H7M13 3.5h3.5V7M16.5 13v3.5H13M7 16.5H3.5V13"/><circle cx="10" cy="10" r="2"/>')),
  zoom: () => svg(icon('<circle cx="8.5" cy="8.5" r="5"/><path d="m12.2 12.2 4.3 4.3M8.5 6.5v4M6.5 8.5h4"/>')),
  close: () => svg(icon('<path d="m5 5 10 10M15 5 5 15"/>')),
  download: () => svg(icon('<path d="M10 4v9M6.5 9.5 10 13l3.5-3.5M4 13.5V16h12v-2.5"/>')),
  play: () => svg(icon('<path d="M7 4.5v11l8.5-5.5z" fill="currentColor"/>')),
  pause: () => svg(icon('<path d="M7 5v10M13 5v10" stroke-width="2.6"/>')),
  stepBack: () => svg(icon('<path d="M12.5 5v10L6 10z" fill="currentColor"/>')),
  stepForward: () => svg(icon('<path d="M7.5 5v10l6.5-5z" fill="currentColor"/>')),
  previousEvent: () => svg(icon('<path d="M4.5 5v10M14.5 5v10L8 10z" fill="currentColor"/>')),
  nextEvent: () => svg(icon('<path d="M15.5 5v10M5.5 5v10l6.5-5z" fill="currentColor"/>')),
  check: () => svg(icon('<path d="m4.5 10.5 3.5 3.5 7.5-8"/>')),
  warn: () => svg(icon('<path d="M10 3.5 17 16H3zM10 8v3.5M10 13.8v.1"/>')),
};

/** A patch of three and one of five quads around a vertex: the mark of the page. */
export function mark(): SVGElement {
  return svg(`<svg viewBox="0 0 32 32" width="30" height="30" aria-hidden="true">
    <rect width="32" height="32" rx="8" fill="var(--accent)"/>
    <g fill="none" stroke="var(--accent-ink)" stroke-width="2" stroke-linecap="round" stroke-linejoin="round">
      <path d="M16 16V6.5M16 16 7.2 21.2M16 16l8.8 5.2"/>
      <path d="m16 6.5 9.2 4.1-.4 10.6L16 26l-8.8-4.8-.4-10.6Z" opacity=".7"/>
    </g>
    <circle cx="16" cy="16" r="2.6" fill="var(--accent-ink)"/>
  </svg>`);
}

/** The sign of a singularity or irregular vertex, as the viewport draws it. */
export function indexSign(index: 1 | -1): SVGElement {
  const corners = index > 0 ? 3 : 5;
  const points = Array.from({ length: corners }, (_, i) => {
    const angle = (2 * Math.PI * i) / corners;
    return `${(8 + 7 * Math.sin(angle)).toFixed(2)},${((index > 0 ? 9.5 : 8.4) - 7 * Math.cos(angle)).toFixed(2)}`;
  });
  const color = index > 0 ? '--positive' : '--negative';
  return svg(
    `<svg viewBox="0 0 16 16" width="14" height="14" aria-hidden="true"><polygon points="${points.join(' ')}" style="fill:var(${color})" stroke="#fff" stroke-width="1.2" stroke-linejoin="round"/></svg>`,
  );
}
