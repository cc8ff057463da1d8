// The plan at the submarine's desk: as it is drawn, and as the vehicle has it.

import type { Commander } from "./commander.svelte.ts";
import type { LatLon } from "./geodesy.ts";
import type { Spot } from "./map.ts";
import { check, drawingOf, drawingOfDraft, specificationOf, type Drawn, type Finding, type Kind, type Maneuver } from "./plan.ts";
import type { Answer, Fields } from "./protocol.ts";
import type { Run } from "./run.svelte.ts";
import { limitsOf, phaseOf } from "./submarine.ts";

/** Of answers to PlanDB and PlanControl, as in IMC. */
const success = 1;
/** What a page may send at once (server.h), less what stands around it. */
const maxBytes = 15_000;

export class Planning {
  name = $state("plan");
  maneuvers: Maneuver[] = $state([]);
  /** What a press on the map adds; empty: nothing. */
  adding: Kind | "" = $state("");
  selected = $state(-1);
  /** The plan that the vehicle has loaded, as it says. */
  loaded: { name: string; specification: Fields } | undefined = $state.raw();
  /** How it goes with what was sent. */
  status = $state("");
  failed = $state(false);
  /** What is loaded is what is drawn. */
  agrees = $state(false);

  private readonly run: Run;
  private requests = Math.floor(Math.random() * 60_000);
  private readonly waiting = new Map<string, (answer: Fields) => void>();

  constructor(run: Run) {
    this.run = run;
    run.hearers.add((desk, answer) => this.hear(desk, answer));
  }

  /** Of the operator whose distributer speaks IMC. */
  private get operator() {
    return this.run.hello?.distributers.find((one) => one.type === "LauvOperator");
  }
  /** From which north and east are measured. */
  get origin(): LatLon {
    const read = (path: string) => Number(this.operator?.parameters?.find((one) => one.path === path)?.value ?? "0");
    return { lat: read("latitude"), lon: read("longitude") };
  }
  get findings(): Finding[] {
    const found = check(this.name, this.maneuvers, limitsOf(this.run.hello!));
    const bytes = JSON.stringify(this.specification).length;
    if (bytes > maxBytes) found.push({ text: "the plan is too long to be sent at once", mild: false });
    return found;
  }
  get sound(): boolean {
    return this.findings.every(({ mild }) => mild);
  }
  private get specification() {
    return specificationOf(this.name, this.maneuvers, this.origin);
  }
  get draft(): Drawn[] {
    return this.agrees ? [] : drawingOfDraft(this.maneuvers);
  }
  get inVehicle(): Drawn[] {
    return this.loaded ? drawingOf(this.loaded.specification, this.origin) : [];
  }
  /** The maneuver that is flown; empty: none. */
  get flown(): string {
    const said = this.run.said[this.operator?.name ?? ""];
    return phaseOf(said?.["VehicleState"], said?.["PlanControlState"], "none").maneuver ?? "";
  }

  changed(): void {
    this.agrees = false;
  }
  add(spot: Spot): void {
    if (this.adding === "") return;
    this.changed();
    const last = this.maneuvers[this.selected];
    if (this.adding === "FollowPath" && last?.kind === "FollowPath" && this.selected === this.maneuvers.length - 1) {
      last.spots.push(spot);
      return;
    }
    this.append(this.adding, [spot]);
  }
  append(kind: Kind, spots: Spot[]): void {
    this.changed();
    const { depth, speed, radius, duration } = this.maneuvers.at(-1) ?? { depth: 3, speed: 1.2, radius: 15, duration: 60 };
    this.maneuvers.push({ kind, spots, depth, speed, radius, duration });
    this.selected = this.maneuvers.length - 1;
  }
  remove(index: number): void {
    this.changed();
    this.maneuvers.splice(index, 1);
    this.selected = Math.min(this.selected, this.maneuvers.length - 1);
  }
  move(index: number, by: number): void {
    const to = index + by;
    if (to < 0 || to >= this.maneuvers.length) return;
    this.changed();
    const [one] = this.maneuvers.splice(index, 1);
    this.maneuvers.splice(to, 0, one!);
    this.selected = to;
  }
  clear(): void {
    this.changed();
    this.maneuvers = [];
    this.selected = -1;
    this.status = "";
  }

  /** Stores it in the vehicle, has it loaded, and asks what is loaded: that is drawn then. */
  async send(commander: Commander): Promise<void> {
    const { name, specification } = this;
    this.agrees = false;
    this.say("is being sent …");
    const before = JSON.stringify(specification);
    for (const [message, op, arg] of [
      ["PlanDB", "SET", specification],
      ["PlanControl", "LOAD", undefined],
      ["PlanControl", "GET", undefined],
    ] as const) {
      const answer = await this.ask(commander, message, { op, plan_id: name, ...(arg && { arg }) });
      if (answer?.["type"] !== success)
        return this.say(answer ? `is refused: ${String(answer["info"])}` : "is not answered by the vehicle; send it again", true);
    }
    this.agrees = before === JSON.stringify(this.specification) && this.loaded?.name === name;
    this.say("is loaded");
  }
  async start(commander: Commander): Promise<void> {
    const answer = await this.ask(commander, "PlanControl", { op: "START", plan_id: this.name });
    if (answer?.["type"] === success) return this.say("is flown");
    this.say(answer ? `does not start: ${String(answer["info"])}` : "is not answered by the vehicle; start it again", true);
  }

  private say(text: string, failed = false): void {
    this.status = text;
    this.failed = failed;
  }

  // Nothing: no answer came.
  private ask(commander: Commander, message: "PlanDB" | "PlanControl", fields: Fields): Promise<Fields | undefined> {
    this.requests = (this.requests + 1) % 65_536;
    const key = `${message} ${this.requests}`;
    commander.send(message, { type: "REQUEST", request_id: this.requests, ...fields });
    return new Promise((resolve) => {
      const timer = setTimeout(() => done(undefined), 5000);
      const done = (answer: Fields | undefined) => {
        clearTimeout(timer);
        this.waiting.delete(key);
        resolve(answer);
      };
      this.waiting.set(key, done);
    });
  }

  private hear(desk: string, { message, fields }: Answer): void {
    if (desk !== this.operator?.name) return;
    if (message === "LogBookEntry") this.run.note(String(fields["text"]), "operator");
    const plan = fields["arg"] as { abbrev?: string; fields?: Fields } | null | undefined;
    if (message === "PlanControl" && plan?.abbrev === "PlanSpecification" && plan.fields)
      this.loaded = { name: String(fields["plan_id"]), specification: plan.fields };
    if (message === "PlanDB" || message === "PlanControl") this.waiting.get(`${message} ${String(fields["request_id"])}`)?.(fields);
  }
}
