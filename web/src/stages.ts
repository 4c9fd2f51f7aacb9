import type { ProgressReport, Stage } from 'qmcf';
import { stages } from 'qmcf';

/** What each stage does, for a person, and its usual share of a run's time. */
const stageTable: Record<Stage, { readonly label: string; readonly share: number }> = {
  read: { label: 'Reading the file', share: 3 },
  repair: { label: 'Repairing', share: 3 },
  topology: { label: 'Finding faces and edges', share: 4 },
  sizing: { label: 'Setting element sizes', share: 4 },
  background: { label: 'Triangulating the faces', share: 22 },
  field: { label: 'Solving the cross field', share: 12 },
  front: { label: 'Advancing the front', share: 36 },
  cleanup: { label: 'Cleaning up', share: 10 },
  quality: { label: 'Checking the result', share: 6 },
  write: { label: 'Writing the file', share: 1 },
};

const lastStage = { open: 'topology', field: 'field', mesh: 'quality' } as const satisfies Record<string, Stage>;

/** What a stage does, for a person. */
export function stageLabel(stage: Stage): string {
  return stageTable[stage].label;
}

/** How much of the whole task is done. */
export function overallFraction(task: keyof typeof lastStage, { stage, fraction }: ProgressReport): number {
  let done = 0;
  let total = 0;
  const current = stages.indexOf(stage);
  for (const [i, name] of stages.slice(0, stages.indexOf(lastStage[task]) + 1).entries()) {
    const { share } = stageTable[name];
    total += share;
    done += i < current ? share : i === current ? share * Math.min(1, Math.max(0, fraction)) : 0;
  }
  return Math.min(1, done / total);
}
