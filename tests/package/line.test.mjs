// The queue in front of the worker and the worker's own end of it: what can't be provoked with the real ones together.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { installed } from './packed.mjs';

const { Line } = await import(join(installed, 'dist/line.js'));
const { serve } = await import(join(installed, 'dist/serve.js'));

/** A platform whose workers do what the test says. */
function fakePlatform(sharedMemory) {
  const threads = [];
  return {
    sharedMemory,
    threads,
    spawn(events) {
      const thread = {
        events,
        messages: [],
        alive: true,
        post: (message) => thread.messages.push(message),
        terminate: () => (thread.alive = false),
        hold: () => {},
        lastId: () => thread.messages.at(-1).id,
      };
      threads.push(thread);
      return thread;
    },
  };
}

function start(line) {
  const run = { task: { name: 'inspect' }, transfer: [], onProgress: undefined };
  run.result = new Promise((resolve, reject) => Object.assign(run, { resolve, reject }));
  line.add(run);
  return run;
}

const code = async (promise) => (await promise.then(() => 'done', (error) => error)).code;

for (const [outOfMemory, expected] of [[true, 'tooLarge'], [false, 'internal']]) {
  test(`a crash (out of memory: ${outOfMemory}) is ${expected}, and the next run gets a new worker`, async () => {
    const platform = fakePlatform(true);
    const line = new Line(platform, {});
    const [first, second] = [start(line), start(line)];
    const [thread] = platform.threads;
    thread.events.onMessage({ kind: 'crashed', id: thread.lastId(), outOfMemory, message: 'unreachable' });
    assert.equal(await code(first.result), expected);
    assert.equal(thread.alive, false);
    assert.equal(platform.threads.length, 2);
    const next = platform.threads[1];
    next.events.onMessage({ kind: 'done', id: next.lastId(), value: 42 });
    assert.equal(await second.result, 42);
  });
}

test('a worker that ends by itself fails its run', async () => {
  const platform = fakePlatform(true);
  const run = start(new Line(platform, {}));
  platform.threads[0].events.onFailure('script not found');
  assert.equal(await code(run.result), 'internal');
});

test('without shared memory a cancelled run costs the worker, at once', async () => {
  const platform = fakePlatform(false);
  const line = new Line(platform, {});
  const run = start(line);
  line.cancel(run);
  assert.equal(await code(run.result), 'cancelled');
  assert.equal(platform.threads[0].alive, false);
  assert.equal(platform.threads[0].messages[0].cancelFlag, undefined);
});

test('with shared memory a cancelled run is told to stop, and its worker is kept', async () => {
  const platform = fakePlatform(true);
  const line = new Line(platform, {});
  const [first, second] = [start(line), start(line)];
  const [thread] = platform.threads;
  const id = thread.lastId();
  line.cancel(first);
  assert.equal(await code(first.result), 'cancelled');
  assert.equal(new Int32Array(thread.messages[0].cancelFlag)[0], id);
  thread.events.onMessage({ kind: 'failed', id, error: { code: 'cancelled', message: '', elements: [] } });
  assert.equal(thread.alive, true);
  assert.equal(thread.lastId(), id + 1);
  thread.events.onMessage({ kind: 'done', id: id + 1, value: 1 });
  assert.equal(await second.result, 1);
});

test('a worker that does not notice the flag is replaced', async () => {
  const platform = fakePlatform(true);
  const line = new Line(platform, {});
  const [first, second] = [start(line), start(line)];
  line.cancel(first);
  await code(first.result);
  while (platform.threads.length < 2) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.equal(platform.threads[0].alive, false);
  const next = platform.threads[1];
  next.events.onMessage({ kind: 'done', id: next.lastId(), value: 'again' });
  assert.equal(await second.result, 'again');
});

test('a run that can not be sent fails, and the ones behind it go on', async () => {
  const platform = fakePlatform(true);
  const line = new Line(platform, {});
  const [thread] = platform.threads;
  const post = thread.post;
  thread.post = () => {
    thread.post = post;
    throw new Error('not cloneable');
  };
  const [first, second] = [start(line), start(line)];
  assert.equal(await code(first.result), 'malformedInput');
  thread.events.onMessage({ kind: 'done', id: thread.lastId(), value: 7 });
  assert.equal(await second.result, 7);
});

for (const [error, outOfMemory] of [
  [new RangeError('WebAssembly.instantiate(): Out of memory: Cannot allocate Wasm memory for new instance'), true],
  [new RangeError('could not allocate memory'), true],
  [new WebAssembly.LinkError('memory import has no maximum limit'), false],
]) {
  test(`an instance that can not be made is told: ${error.message}`, async (context) => {
    context.mock.method(WebAssembly, 'instantiate', () => Promise.reject(error));
    const posted = await new Promise((resolve) =>
      serve({
        post: resolve,
        onMessage: (handler) => {
          handler({ kind: 'start', module: {} });
          handler({ kind: 'run', id: 3, task: { name: 'inspect', input: {}, options: {} } });
        },
      }),
    );
    assert.deepEqual(posted, { kind: 'crashed', id: 3, outOfMemory, message: error.message });
  });
}
