// A run as the page knows it: the socket, all values so far, and the instant that is looked at.

import { EventLog, type Event } from "./events.ts";
import { Link } from "./link.ts";
import { parseMessage, type Answer, type Fields, type Hello, type Message, type Shown } from "./protocol.ts";
import { Store } from "./series.ts";
import { vehicleOf, type Vehicle } from "./vehicles.ts";

/** Milliseconds without news after which a run that has such a pace is not heard any more. */
const patience = 3000;
const minPace = 0.2;
/** The server learns what was seen no more often than each so many milliseconds. */
const seenRate = 50;

export class Run {
  hello: Hello | undefined = $state.raw();
  store: Store | undefined = $state.raw();
  vehicle: Vehicle | undefined = $state.raw();
  link: "connecting" | "open" | "lost" = $state("connecting");
  /** Grows with each break: what was asked for before is no longer asked for. */
  breaks = $state(0);
  paused = $state(false);
  speed: number | "max" = $state(1);
  thinned = $state(0);
  missed = $state(0);
  error = $state("");
  /** How often jarol has refused what this page asked for. */
  refusals = $state(0);
  ended: string | undefined = $state();
  newest = $state(0);
  /** The instant that is looked at; undefined: the newest. */
  cursor: number | undefined = $state();
  playing = $state(false);
  playSpeed = $state(1);
  events: Event[] = $state.raw([]);
  faults: Map<string, number> = $state.raw(new Map());
  /** Nothing comes any more, though the run should go on. */
  silent = $state(false);
  /** Who commands at which desk, as this page knows it. */
  desks: Record<string, { commander: string | null; why?: string }> = $state.raw({});
  /** The newest message of each name that an operator's distributer has said, by desk. */
  said: Record<string, Record<string, Fields>> = $state.raw({});
  /** Called with all that one says. */
  readonly hearers = new Set<(desk: string, answer: Answer) => void>();
  /** What was changed for the next run: texts of parameters by "task.path". */
  changed: ReadonlyMap<string, string> = $state.raw(new Map());
  /** Changes whenever there is something to draw, once a frame. */
  tick = $state(0);

  private log: EventLog | undefined;
  private readonly socket = new Link({
    onmessage: (text) => {
      this.take(text);
      this.see();
    },
    onlost: () => this.lose(),
  });
  private news = false;
  private lastFrame = 0;
  private heard = 0;
  private got = 0;
  private seen = 0;
  private seenAt = -Infinity;
  private seenTimer: ReturnType<typeof setTimeout> | undefined;
  private errorTimer: ReturnType<typeof setTimeout> | undefined;

  get time(): number {
    return this.cursor ?? this.newest;
  }

  connect(): void {
    this.socket.connect();
    requestAnimationFrame((t) => this.frame(t));
  }

  // Where there is more to come of a run that was watched, it tries to connect again.
  private lose(): boolean {
    const triesAgain = this.hello !== undefined && this.ended === undefined;
    if (triesAgain && this.link === "open") this.note("the connection to jarol is lost; this page tries to connect again");
    this.link = "lost";
    ++this.breaks;
    this.desks = {};
    this.playing = false;
    clearTimeout(this.seenTimer);
    this.seenTimer = undefined;
    this.got = this.seen = 0;
    return triesAgain;
  }

  /** What this page asked for was refused: said for a while. */
  private complain(text: string): void {
    this.error = text;
    ++this.refusals;
    clearTimeout(this.errorTimer);
    this.errorTimer = setTimeout(() => (this.error = ""), 8000);
  }

  ask(what: object): void {
    this.saySeen();
    this.socket.send(what);
  }

  /** The server sends no more than what is seen soon, and knows how old that is which somebody at a desk looks at. */
  private saySeen(): void {
    clearTimeout(this.seenTimer);
    this.seenTimer = undefined;
    if (this.seen === this.got || !this.socket.send({ do: "seen", messages: this.got })) return;
    this.seen = this.got;
    this.seenAt = performance.now();
  }

  private see(): void {
    ++this.got;
    const wait = this.seenAt + seenRate - performance.now();
    if (wait <= 0) this.saySeen();
    else this.seenTimer ??= setTimeout(() => this.saySeen(), wait);
  }

  look(t: number): void {
    this.playing = false;
    this.cursor = Math.min(Math.max(t, 0), this.newest);
    ++this.tick;
  }

  follow(): void {
    this.playing = false;
    this.cursor = undefined;
    ++this.tick;
  }

  play(): void {
    if (this.time >= this.newest) this.cursor = 0;
    this.playing = !this.playing;
  }

  private take(text: string): void {
    let message: Message;
    try {
      message = parseMessage(text);
    } catch (wrong) {
      this.error = String(wrong instanceof Error ? wrong.message : wrong);
      return;
    }
    // who commands is said also while the run is stuck
    if (!("desk" in message) || message.now > this.newest) this.heard = performance.now();
    if ("hello" in message) this.begin(message.hello);
    else if ("missed" in message) this.missed += message.missed;
    else if ("error" in message) this.complain(message.error);
    else if ("ended" in message) this.ended = message.ended;
    else this.show(message);
    this.news = true;
  }

  /** Also after a break: what was shown so far comes anew, as to a page that comes late. */
  private begin(hello: Hello): void {
    const isFirst = this.hello === undefined;
    this.hello = hello;
    this.store = new Store(hello.outputs);
    this.vehicle = vehicleOf(this.store);
    this.log = new EventLog(hello);
    this.events = [];
    this.faults = new Map();
    this.said = {};
    this.thinned = this.missed = this.newest = 0;
    this.link = "open";
    document.title = `${hello.graph} · Jarol`;
    if (hello.clock === "recorded" && isFirst) this.cursor = 0;
  }

  private show(shown: Shown): void {
    if (shown.paused !== undefined) this.paused = shown.paused;
    if (shown.speed !== undefined) this.speed = shown.speed;
    if (shown.thinned !== undefined) this.thinned = shown.thinned;
    if (shown.events) {
      this.log?.addRunEvents(shown.events);
      const faults = new Map(this.faults);
      for (const event of shown.events) if (event.task) faults.set(event.task, (faults.get(event.task) ?? 0) + 1);
      this.faults = faults;
    }
    if (shown.desk) this.desks = { ...this.desks, ...shown.desk };
    if (shown.answers) this.hear(shown.answers);
    if (shown.samples) {
      this.store?.add(shown.samples);
      this.log?.look(shown.samples);
    }
    this.newest = Math.max(this.newest, shown.now);
    if (this.log && this.log.all.length + this.log.dropped !== this.events.length) this.events = [...this.log.all];
  }

  private hear(answers: Record<string, Answer[]>): void {
    const said = { ...this.said };
    for (const [desk, its] of Object.entries(answers)) {
      const newest = (said[desk] = { ...said[desk] });
      for (const answer of its) {
        newest[answer.message] = answer.fields;
        for (const hear of this.hearers) hear(desk, answer);
      }
    }
    this.said = said;
  }

  /** In the list of what happened, at the newest instant. */
  note(text: string, kind: Event["kind"] = "page"): void {
    this.log?.add({ t: this.newest, kind, text });
    this.events = [...(this.log?.all ?? [])];
    this.news = true;
  }

  private frame(t: number): void {
    const passed = Math.min(0.1, (t - this.lastFrame) / 1000);
    this.lastFrame = t;
    if (this.playing) {
      const next = (this.cursor ?? 0) + passed * this.playSpeed;
      this.cursor = Math.min(next, this.newest);
      if (next >= this.newest) this.playing = false;
      this.news = true;
    }
    const comes = this.link === "open" && this.ended === undefined && !this.paused && this.hello?.clock !== "recorded";
    const fast = this.speed === "max" || this.speed >= minPace;
    this.silent = comes && fast && performance.now() - this.heard > patience;
    if (this.news) {
      this.news = false;
      ++this.tick;
    }
    requestAnimationFrame((next) => this.frame(next));
  }
}
