// The editor as the page knows it: the text and what was before, what jarol says of it, and what is chosen.

import { Link } from "../link.ts";
import { findingOf, type Finding } from "./findings.ts";
import { endText, GraphText, type Connection, type Kind, type Part } from "./graph_text.ts";
import { History } from "./history.ts";
import type { Catalogue, Checked, Drawn, Hello, Message, Suggestion, Trial, Verdict, Version } from "./protocol.ts";
import { CannotEdit, typed } from "./splice.ts";

export type Chosen = { kind: Kind; name: string } | { kind: "connection"; from: string; to: string } | { kind: "graph" };

/** Until what was typed is looked at. */
const patience = 150;

export class Editor {
  hello: Hello | undefined = $state.raw();
  link: "connecting" | "open" | "lost" = $state("connecting");
  graph: GraphText = $state.raw(new GraphText(""));
  /** What is drawn: of the text before, until the new one has come. */
  drawn: Drawn | undefined = $state.raw();
  drawnGraph: GraphText = $state.raw(new GraphText(""));
  verdict: Verdict | undefined = $state.raw();
  findings: Finding[] = $state.raw([]);
  suggestions: Suggestion[] = $state.raw([]);
  chosen: Chosen = $state.raw({ kind: "graph" });
  profile = $state("");
  /** Why an edit was not made, or what went wrong. */
  refusal = $state("");
  /** What stands on the disk where that is not what was opened. */
  conflict: Version | undefined = $state.raw();
  /** The hash of what was opened or saved last, and its text. */
  base: Version = $state.raw({ text: "", hash: "" });
  disk = $state("");
  trial: Trial | undefined = $state.raw();
  trialPage = $state("");
  undoes: string | undefined = $state();
  redoes: string | undefined = $state();
  /** Of the text that was asked about last. */
  asked = $state(0);

  /** Shows a line of the text. */
  goTo: (line: number) => void = () => {};

  private history = new History("");
  private readonly socket = new Link({
    onmessage: (text) => this.take(JSON.parse(text) as Message),
    onlost: () => this.lose(),
  });
  private texts = new Map<number, GraphText>();
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** The text that is being saved, one at a time. */
  private sent: string | undefined;
  /** A save was asked for meanwhile. */
  private savesAgain = false;
  /** A text that was sent, whose answer never came. */
  private unanswered: string | undefined;
  /** What the text of the file is asked for, while it is on its way: to take the place of what is here, or to be compared with it. */
  private opening: "load" | "compare" | undefined;

  get catalogue(): Catalogue {
    return this.hello!.catalogue;
  }
  get isDirty(): boolean {
    return this.graph.text !== this.base.text;
  }
  get isJudged(): boolean {
    return this.verdict?.id === this.asked;
  }
  /** The drawing is of the text as it is; of what is no YAML there is none. */
  get isDrawn(): boolean {
    return this.drawn?.id === this.asked || !this.graph.isGood;
  }
  get check(): Checked | undefined {
    return this.verdict?.check;
  }
  /** The file has changed on the disk since it was opened or saved here. */
  get isBehind(): boolean {
    return this.disk !== "" && this.disk !== this.base.hash;
  }

  connect(): void {
    this.socket.connect();
  }

  // What was asked for may be done or not. It tries to connect anew where it was connected: the edits are here.
  private lose(): boolean {
    this.link = "lost";
    this.unanswered = this.sent ?? this.unanswered;
    this.sent = undefined;
    this.savesAgain = false;
    this.opening = undefined;
    return this.hello !== undefined;
  }

  private ask(what: object): boolean {
    const isSent = this.socket.send(what);
    if (!isSent) this.refusal = "not done: the connection to jarol edit is lost; do it again once it is back";
    return isSent;
  }

  private take(message: Message): void {
    if ("hello" in message) {
      this.link = "open";
      if (!this.hello) this.profile = message.hello.profile;
      this.hello = message.hello;
      document.title = `${message.hello.file} · Jarol`;
      this.open("compare");
      this.ask({ do: "trial" });
    } else if ("opened" in message) this.opened(message.opened);
    else if ("verdict" in message) this.judged(message.verdict);
    else if ("drawn" in message) this.draw(message.drawn);
    else if ("suggested" in message) {
      if (message.suggested.id === this.asked) this.suggestions = message.suggested.list;
    } else if ("saved" in message) {
      this.base = { text: this.sent!, hash: message.saved.hash };
      this.disk = message.saved.hash;
      this.conflict = undefined;
      if (this.endSave() && this.isDirty) this.save();
    } else if ("conflict" in message) {
      this.conflict = message.conflict;
      this.disk = message.conflict.hash;
      this.endSave();
    } else if ("unsaved" in message) {
      this.refusal = message.unsaved.why;
      this.endSave();
    } else if ("disk" in message) {
      this.disk = message.disk.hash;
      // nothing of here is lost
      if (this.isBehind && !this.isDirty && this.sent === undefined) this.open("compare");
    } else if ("trial" in message) {
      // one that ended before this page came, or that it has seen end
      if (message.trial.state === "ended" && (this.trial?.state ?? "ended") === "ended") return;
      this.trial = message.trial;
      if (message.trial.state === "running") this.trialPage = "";
      if (message.trial.state === "watched") {
        // the machine's name as this page has it
        const url = new URL(message.trial.url);
        url.hostname = location.hostname;
        this.trialPage = url.href;
      }
    } else if ("error" in message) {
      this.refusal = message.error;
      // it may be that the file can't be read
      this.opening = undefined;
    }
  }

  private opened(version: Version): void {
    const isFirst = this.base.hash === "";
    const loads = this.opening === "load";
    this.opening = undefined;
    this.disk = version.hash;
    if (version.text === this.unanswered) this.base = version;
    this.unanswered = undefined;
    if (!isFirst && !loads && this.isDirty && version.text !== this.graph.text) {
      this.conflict = version.hash === this.base.hash ? undefined : version;
      this.judgeAgain();
      return;
    }
    this.base = version;
    this.conflict = undefined;
    // what was there before can be had back
    if (isFirst) this.history = new History(version.text);
    else this.history.add(version.text, "load from disk");
    this.show(version.text);
  }

  private open(to: "load" | "compare"): void {
    const isAsked = this.opening !== undefined;
    if (!isAsked || to === "load") this.opening = to;
    if (!isAsked && !this.ask({ do: "open" })) this.opening = undefined;
  }

  /** What is on the disk takes the place of the text; undo brings that back. */
  load(): void {
    this.open("load");
  }

  /** Over the version that was opened, or another one that was looked at. While a text is being saved, what is edited
   * meanwhile is saved behind it. */
  save(over = this.base.hash): void {
    if (this.sent !== undefined) {
      this.savesAgain = true;
      return;
    }
    if (!this.isDirty && over === this.base.hash && this.disk === over) return;
    this.refusal = "";
    const { text } = this.graph;
    if (this.ask({ do: "save", text, over })) this.sent = text;
  }

  // Whether another save was asked for.
  private endSave(): boolean {
    const again = this.savesAgain;
    this.savesAgain = false;
    this.sent = undefined;
    return again;
  }

  private show(text: string, wait = 0): void {
    this.graph = new GraphText(text);
    this.undoes = this.history.undoes;
    this.redoes = this.history.redoes;
    this.refusal = "";
    if (this.chosen.kind === "connection") {
      const { from, to } = this.chosen;
      if (!this.findConnection(from, to)) this.chosen = { kind: "graph" };
    } else if (this.chosen.kind !== "graph" && !this.graph.find(this.chosen.kind, this.chosen.name) && this.graph.isGood)
      this.chosen = { kind: "graph" };
    clearTimeout(this.timer);
    const id = ++this.asked;
    this.texts.set(id, this.graph);
    for (const old of this.texts.keys()) if (old < id - 200) this.texts.delete(old);
    // after a break it is asked for again
    const judge = (): void => void this.socket.send({ do: "judge", id, text, profile: this.profile });
    if (wait === 0) judge();
    else this.timer = setTimeout(judge, wait);
  }

  judgeAgain(): void {
    this.show(this.graph.text);
  }

  /** An edit by drawing or form; why it can't be made is shown. */
  edit(label: string, change: (graph: GraphText) => GraphText): boolean {
    try {
      const made = change(this.graph);
      if (made.text === this.graph.text) return true;
      this.history.add(made.text, label);
      this.show(made.text);
      return true;
    } catch (why) {
      if (!(why instanceof CannotEdit)) throw why;
      this.refusal = why.message;
      return false;
    }
  }

  /** By hand, in the text as a browser shows it. */
  type(value: string): void {
    const text = typed(this.graph.text, value);
    this.history.add(text, "typing", Date.now());
    this.show(text, patience);
  }

  undo(): void {
    if (this.undoes !== undefined) this.show(this.history.undo());
  }
  redo(): void {
    if (this.redoes !== undefined) this.show(this.history.redo());
  }

  private judged(verdict: Verdict): void {
    const graph = this.texts.get(verdict.id);
    if (verdict.id !== this.asked || !graph) return;
    this.verdict = verdict;
    if (verdict.problems.length > 0) this.suggestions = [];
    this.findings = verdict.problems.map((problem) => findingOf(problem, graph, this.hello?.file));
  }

  private draw(drawn: Drawn): void {
    const graph = this.texts.get(drawn.id);
    if (drawn.id !== this.asked || !graph) return;
    // of a text that can't be read nothing can be drawn
    if (!graph.isGood && (drawn.drawing?.nodes.length ?? 0) === 0) return;
    this.drawn = drawn;
    this.drawnGraph = graph;
  }

  run(length: string, watched: boolean): void {
    this.refusal = "";
    this.ask({ do: "run", text: this.graph.text, profile: this.profile, for: length, watched });
  }
  stop(): void {
    this.ask({ do: "stop" });
  }

  choosePart(part: Part): void {
    this.chosen = { kind: part.kind, name: part.name };
  }
  chooseConnection(connection: Connection): void {
    this.chosen = { kind: "connection", from: endText(connection.from), to: endText(connection.to) };
  }
  findConnection(from: string, to: string): Connection | undefined {
    return this.graph.connections.find((c) => endText(c.from) === from && endText(c.to) === to);
  }
  get chosenPart(): Part | undefined {
    const { chosen } = this;
    return chosen.kind === "connection" || chosen.kind === "graph" ? undefined : this.graph.find(chosen.kind, chosen.name);
  }
  get chosenConnection(): Connection | undefined {
    return this.chosen.kind === "connection" ? this.findConnection(this.chosen.from, this.chosen.to) : undefined;
  }
}
