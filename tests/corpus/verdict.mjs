// What a mesh is worth: figures of the independent judge, or of `qmcf check` where there is no judge.

import { runMeasured } from './child.mjs';

const JUDGE_TIMEOUT_SECONDS = 600;

/** Resolves to { valid, failing: [names], ...figures }. */
export async function judgeMesh({ judge, qmcf, samples }, part, mesh) {
  const [program, args] = judge
    ? [process.execPath, [judge, '--json', '--samples', String(samples), '--ref', part, mesh]]
    : [qmcf, ['check', mesh, '--ref', part, '--json']];
  const result = await runMeasured(program, args, JUDGE_TIMEOUT_SECONDS);
  try {
    const report = JSON.parse(result.stdout);
    return judge ? fromJudge(report) : fromCheck(report);
  } catch {
    return { valid: false, failing: [`no verdict: ${result.stderr.trim().split('\n')[0]}`] };
  }
}

/** Mean |log2(length / size)| of the edges, by the judge, with sizes that are linear on the triangles of a mesh. */
export async function judgeSizes({ judge }, mesh, sizing) {
  const args = [judge, '--json', '--samples', '1000', '--ref', sizing.mesh, '--sizefield', sizing.sizes, mesh];
  const result = await runMeasured(process.execPath, args, JUDGE_TIMEOUT_SECONDS);
  try {
    return JSON.parse(result.stdout).size.mean_abs_log2;
  } catch {
    return null;
  }
}

function fromJudge({ validity, composition, regularity, quality, size, fidelity, features }) {
  const quads = quality.quads ?? {};
  return {
    valid: validity.valid,
    failing: validity.checks.filter(({ status }) => status === 'fail').map(({ name, count }) => `${name} ${shorten(count)}`),
    quads: composition.quads,
    triangles: composition.triangles,
    quadShare: composition.quad_share,
    regularShare: regularity.regular_share,
    irregular: regularity.irregular,
    scaledJacobian: pick(quads.scaled_jacobian),
    jacobianRatio: pick(quads.jacobian_ratio),
    jacobianRatioGauss: pick(quads.jacobian_ratio_gauss),
    aspectRatio: pick(quads.aspect_ratio),
    orthogonalQuality: pick(quads.orthogonal_quality),
    sizeError: size?.mean_abs_log2 ?? null,
    distance: fidelity?.two_sided?.max_over_size ?? null,
    sharpRecall: features?.sharp?.recall ?? null,
    boundaryRecall: features?.boundary?.recall ?? null,
    cornerRecall: features?.corners?.recall ?? null,
  };
}

function fromCheck(report) {
  const largest = Math.max(report.largestDistance ?? NaN, report.largestGap ?? NaN);
  return {
    valid: report.valid,
    failing: report.checks.filter(({ status }) => status === 'fail').map(({ name, count }) => `${name} ${count}`),
    quads: report.quads,
    triangles: report.triangles,
    quadShare: report.quadShare,
    regularShare: report.regularShare,
    irregular: report.irregularVertices,
    scaledJacobian: pick(report.scaledJacobian),
    jacobianRatio: pick(report.jacobianRatio),
    jacobianRatioGauss: pick(report.jacobianRatioGauss),
    aspectRatio: pick(report.aspectRatio),
    orthogonalQuality: pick(report.orthogonalQuality),
    sizeError: report.sizeError,
    distance: Number.isFinite(largest) && report.size > 0 ? largest / report.size : null,
    sharpRecall: report.sharpRecall,
    boundaryRecall: report.boundaryRecall,
    cornerRecall: report.cornerRecall,
  };
}

const pick = (figure) => (figure ? { mean: figure.mean, p1: figure.p1, worst: figure.worst } : null);
const shorten = (count) => (Number.isInteger(count) ? String(count) : Number(count).toPrecision(3));
