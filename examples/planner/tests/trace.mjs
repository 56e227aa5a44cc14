// CPU times of the threads of a page between marks of its clock, from Chromium's trace: unlike times of the clock they
// hardly depend on what else runs on the machine.

const categories =
  'toplevel,devtools.timeline,disabled-by-default-devtools.timeline,blink.user_timing,__metadata';

/** Records while `work` runs; returns the tasks of the main thread and of workers, and the marks, in ms. */
export async function traced(page, work) {
  const client = await page.context().newCDPSession(page);
  const events = [];
  client.on('Tracing.dataCollected', ({ value }) => events.push(...value));
  await client.send('Tracing.start', { categories, transferMode: 'ReportEvents' });
  await work();
  const complete = new Promise((done) => client.once('Tracing.tracingComplete', done));
  await client.send('Tracing.end');
  await complete;
  await client.detach();
  const thread = (event) => `${event.pid}/${event.tid}`;
  const named = (name) =>
    new Set(events.filter((e) => e.name === 'thread_name' && e.args.name === name).map(thread));
  const tasksOf = (name) => {
    const threads = named(name);
    return events
      .filter(
        (e) => e.tdur !== undefined && e.name === 'ThreadControllerImpl::RunTask' && threads.has(thread(e)),
      )
      .map((e) => ({ begin: e.ts / 1000, wall: e.dur / 1000, cpu: e.tdur / 1000 }));
  };
  return {
    main: tasksOf('CrRendererMain'),
    worker: tasksOf('DedicatedWorker thread'),
    marks: events
      .filter((e) => e.cat === 'blink.user_timing')
      .map((e) => ({ name: e.name, time: e.ts / 1000 }))
      .sort((a, b) => a.time - b.time),
  };
}

/** CPU, ms, that tasks took between two times; a task across a border counts by its share. */
export function cpuBetween(tasks, begin, end) {
  let sum = 0;
  for (const task of tasks) {
    const inside = Math.min(end, task.begin + task.wall) - Math.max(begin, task.begin);
    if (inside > 0) sum += task.cpu * Math.min(1, inside / Math.max(task.wall, 1e-3));
  }
  return sum;
}
