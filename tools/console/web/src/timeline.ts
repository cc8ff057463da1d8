// When tasks run: their logical executions by period and LET, and who has a core when each takes its WCET.

import type { Hello, Task } from "./protocol.ts";

export interface Logical {
  k: number; // which activation
  release: number;
  end: number; // of its LET, or its deadline
}

/** Activations whose logical execution touches the window; at most so many, the newest. */
export function activationsOf(task: Task, from: number, to: number, max = 500): Logical[] {
  const length = task.let ?? task.deadline;
  // what is a rounding error before an instant is that instant
  const slip = task.period * 1e-6;
  const last = Math.floor((to - task.offset + slip) / task.period);
  const first = Math.max(0, last - max + 1, Math.ceil((from - task.offset - length - slip) / task.period));
  const found: Logical[] = [];
  for (let k = first; k <= last; ++k) {
    const release = task.offset + k * task.period;
    found.push({ k, release, end: release + length });
  }
  return found;
}

export interface Execution {
  task: number;
  begin: number;
  end: number;
}

/** The schedule over the window, whose last round repeats; nothing after its begin where no more of it is known. */
export function executionsOf(schedule: Hello["schedule"], from: number, to: number): Execution[] {
  if (!schedule || schedule.until <= 0) return [];
  const found: Execution[] = [];
  const add = (task: number, begin: number, end: number): void => {
    if (end > from && begin < to) found.push({ task, begin, end });
  };
  for (const [task, begin, end] of schedule.slices) add(task, begin, end);
  const { round, until } = schedule;
  if (round === undefined) return found;
  const first = Math.max(1, Math.floor((from - until) / round) + 1);
  for (let k = first; until + (k - 1) * round < to; ++k)
    for (const [task, begin, end] of schedule.slices)
      if (end > until - round) add(task, Math.max(begin, until - round) + k * round, end + k * round);
  return found;
}

/** What the window is as long as: two rounds of the schedule, but as long as the longest period twice where that is long. */
export function windowOf(hello: Hello): number {
  const longest = Math.max(0.001, ...hello.tasks.map((task) => task.period));
  const round = hello.schedule?.round ?? longest;
  return Math.max(round, longest) * 2;
}
