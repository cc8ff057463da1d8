// Parameters of tasks, and what to call for a run with others: nothing changes in the run that is watched.

import type { Hello, Parameter } from "./protocol.ts";

/** Why the text can't be the parameter's value; empty: it can. */
export function wrongValue(parameter: Parameter, text: string): string {
  if (parameter.words) return parameter.words.includes(text) ? "" : `one of ${parameter.words.join(", ")}`;
  if (parameter.kind === "bool") return text === "true" || text === "false" ? "" : "true or false";
  if (parameter.kind === "text") return "";
  const value = Number(text);
  if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text.trim()) || !Number.isFinite(value)) return "a number";
  if (parameter.kind === "integer" && !Number.isInteger(value)) return "a whole number";
  const { min, max } = parameter;
  if ((min !== undefined && value < min) || (max !== undefined && value > max))
    return `a number from ${min ?? "any"} to ${max ?? "any"}`;
  return "";
}

/** As a shell takes it, whatever is in it. */
export function quoted(word: string): string {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`;
}

/** Of a run with what this one was begun with, and with what is changed: texts by "task.path". */
export function commandOf(hello: Hello, changed: ReadonlyMap<string, string>): string {
  const { file, profile, set, seed } = hello.given ?? { file: hello.file, profile: "", set: [], seed: 0 };
  const words = ["jarol", "run", file];
  if (profile) words.push("--profile", profile);
  if (seed) words.push("--seed", String(seed));
  // an operator at the page needs one
  if (hello.desks && hello.desks.length > 0) words.push("--console");
  // what is changed takes the place of what was set
  const anew = (each: string): boolean => changed.has(each.slice(0, each.indexOf("=")).replace(/^tasks\.(\w+)\.parameters\./, "$1."));
  for (const each of set) if (!anew(each)) words.push("--set", each);
  for (const task of hello.tasks)
    for (const parameter of task.parameters) {
      const text = changed.get(`${task.name}.${parameter.path}`);
      if (text === undefined || text === parameter.value) continue;
      words.push("--set", `tasks.${task.name}.parameters.${parameter.path}=${text}`);
    }
  return words.map(quoted).join(" ");
}
