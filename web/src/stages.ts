import type { ProgressReport, Stage } from 'qmcf';
import { stages } from 'qmcf';

interface StageRow {
  /** What the stage does, for a person. */
  readonly label: string;
  /** Its usual share of a run's time. */
  readonly share: number;
  /** Stages of one phase alternate, face by face; a phase begins when all earlier ones are done. */
  readonly phase: number;
}

const stageTable: Record<Stage, StageRow> = {
  read: { label: 'Reading the file', share: 3, phase: 0 },
  repair: { label: 'Repairing', share: 3, phase: 1 },
  topology: { label: 'Finding faces and edges', share: 4, phase: 2 },
  sizing: { label: 'Setting element sizes', share: 4, phase: 3 },
  background: { label: 'Triangulating the faces', share: 32, phase: 4 },
  field: { label: 'Solving the cross field', share: 10, phase: 5 },
  front: { label: 'Advancing the front', share: 14, phase: 6 },
  cleanup: { label: 'Advancing the front', share: 20, phase: 6 },
  quality: { label: 'Checking the result', share: 10, phase: 7 },
  write: { label: 'Writing the file', share: 1, phase: 8 },
};

const lastStage = { open: 'topology', field: 'field', mesh: 'quality' } as const satisfies Record<string, Stage>;

/** What a stage does, for a person. */
export function stageLabel(stage: Stage): string {
  return stageTable[stage].label;
}

/** Follows one task; what it says never goes back. */
export class TaskProgress {
  private readonly rows: readonly Stage[];
  private readonly done = new Map<Stage, number>();

  constructor(task: keyof typeof lastStage) {
    this.rows = stages.slice(0, stages.indexOf(lastStage[task]) + 1);
  }

  /** How much of the whole task is done, 0 to 1. */
  follow({ stage, fraction }: ProgressReport): number {
    this.done.set(stage, Math.min(1, Math.max(this.done.get(stage) ?? 0, fraction)));
    let sum = 0;
    let total = 0;
    for (const row of this.rows) {
      const isOver = stageTable[row].phase < stageTable[stage].phase;
      if (isOver) {
        this.done.set(row, 1);
      }
      total += stageTable[row].share;
      sum += stageTable[row].share * (this.done.get(row) ?? 0);
    }
    return sum / total;
  }
}
