// Runs a program and tells what it cost.

import { spawn } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';

const TIME_TOOL = '/usr/bin/time';
const TIME_FORMAT = 'QMCF_COST %U %S %M';
const TICKS_PER_SECOND = 100; // of /proc/PID/stat, on every Linux
const POLL_MILLISECONDS = 20;
const WALL_PER_CPU = 10; // a shared machine may be slow; a program that waits for ever has to end all the same

/** Process groups that would outlive this program when it is interrupted. */
const running = new Set();

function endGroup(pid) {
  try {
    process.kill(-pid, 'SIGKILL');
  } catch {
    // it has just ended by itself
  }
}

process.on('exit', () => running.forEach(endGroup));
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(130));

/**
 * Runs it with at most so many seconds of CPU time, and ten times that by the clock. Resolves to
 * { exit, signal, timedOut, stdout, stderr, seconds, cpuSeconds, peakMegabytes }.
 * CPU and memory come from the time program, where there is one, else from looking at /proc now and then.
 */
export function runMeasured(program, args, cpuLimit) {
  const timed = existsSync(TIME_TOOL);
  const limited = ['/bin/sh', '-c', 'ulimit -t "$0"; exec "$@"', String(Math.ceil(cpuLimit)), program, ...args];
  const command = timed ? [TIME_TOOL, '-q', '-f', TIME_FORMAT, ...limited] : limited;
  return new Promise((resolve) => {
    const started = process.hrtime.bigint();
    // A group of its own, so that the time program and what it runs end together.
    const child = spawn(command[0], command.slice(1), { detached: true, stdio: ['ignore', 'pipe', 'pipe'] });
    running.add(child.pid);
    const result = { exit: null, signal: null, timedOut: false, stdout: '', stderr: '', cpuSeconds: null, peakMegabytes: null };
    child.stdout.on('data', (data) => { result.stdout += data; });
    child.stderr.on('data', (data) => { result.stderr += data; });
    const poll = timed ? null : setInterval(() => Object.assign(result, readProc(child.pid)), POLL_MILLISECONDS);
    const timer = setTimeout(() => {
      result.timedOut = true;
      endGroup(child.pid);
    }, WALL_PER_CPU * cpuLimit * 1000);
    const finish = (exit, signal) => {
      running.delete(child.pid);
      clearTimeout(timer);
      clearInterval(poll);
      result.seconds = Number(process.hrtime.bigint() - started) / 1e9;
      takeCost(result);
      // The time program reports a signal of its child as 128 + its number.
      result.exit = exit;
      result.signal = signal ?? (timed && exit > 128 ? exit - 128 : null);
      if (result.signal && result.cpuSeconds >= 0.95 * cpuLimit) result.timedOut = true;
      resolve(result);
    };
    child.on('error', (error) => {
      result.stderr += error.message;
      finish(127, null);
    });
    child.on('close', finish);
  });
}

function takeCost(result) {
  const match = /QMCF_COST (\S+) (\S+) (\d+)\n?/.exec(result.stderr);
  if (!match) return;
  result.cpuSeconds = Number(match[1]) + Number(match[2]);
  result.peakMegabytes = Number(match[3]) / 1024;
  result.stderr = result.stderr.replace(match[0], '');
}

function readProc(pid) {
  try {
    const fields = readFileSync(`/proc/${pid}/stat`, 'latin1').replace(/^.*\) /s, '').split(' ');
    const peak = /VmHWM:\s+(\d+) kB/.exec(readFileSync(`/proc/${pid}/status`, 'latin1'));
    return {
      cpuSeconds: (Number(fields[11]) + Number(fields[12])) / TICKS_PER_SECOND,
      ...(peak && { peakMegabytes: Number(peak[1]) / 1024 }),
    };
  } catch {
    return {}; // it has just ended
  }
}
