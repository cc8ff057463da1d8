// The editor as the page knows it: the text and what was before, what jarol says of it, and what is chosen.

import { GraphText, type Connection, type Kind, type Part } from "./graph_text.ts";
import { History } from "./history.ts";
import type { Catalogue, Checked, Drawn, Hello, Message, Problem, Suggestion, Trial, Verdict, Version } from "./protocol.ts";
import { CannotEdit, offsetAt, typed } from "./splice.ts";

export type Chosen = { kind: Kind; name: string } | { kind: "connection"; from: string; to: string } | { kind: "graph" };

/** A problem with where it is drawn. */
export interface Finding {
  problem: Problem;
  /** Of the file that is edited; undefined: another one. */
  offset?: number;
  part?: string;
  connection?: number;
}

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
  saving = $state(false);
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
  private socket: WebSocket | undefined;
  private texts = new Map<number, GraphText>();
  private timer: ReturnType<typeof setTimeout> | undefined;
  private saved = "";
  private loading = false;

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
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.socket = new WebSocket(`${scheme}://${location.host}/socket${location.search}`);
    this.socket.onopen = () => (this.link = "open");
    this.socket.onmessage = (event: MessageEvent<string>) => this.take(JSON.parse(event.data) as Message);
    this.socket.onclose = () => (this.link = "lost");
  }

  private ask(what: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(what));
    else this.refusal = "jarol edit has ended; what you have edited is still in the text here, to be copied";
  }

  private take(message: Message): void {
    if ("hello" in message) {
      this.hello = message.hello;
      this.profile = message.hello.profile;
      document.title = `${message.hello.file} · Jarol`;
      this.load();
    } else if ("opened" in message) this.begin(message.opened);
    else if ("verdict" in message) this.judged(message.verdict);
    else if ("drawn" in message) this.draw(message.drawn);
    else if ("suggested" in message) {
      if (message.suggested.id === this.asked) this.suggestions = message.suggested.list;
    } else if ("saved" in message) {
      this.base = { text: this.saved, hash: message.saved.hash };
      this.disk = message.saved.hash;
      this.conflict = undefined;
      this.saving = false;
    } else if ("conflict" in message) {
      this.conflict = message.conflict;
      this.disk = message.conflict.hash;
      this.saving = false;
    } else if ("disk" in message) {
      this.disk = message.disk.hash;
      // nothing of here is lost
      if (this.isBehind && !this.isDirty && !this.saving) this.load();
    } else if ("trial" in message) {
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
      this.saving = false;
    }
  }

  private begin(version: Version): void {
    this.base = version;
    this.disk = version.hash;
    this.conflict = undefined;
    if (this.loading && this.history.text !== "") {
      // what was there before can be had back
      this.history.add(version.text, "load from disk");
    } else this.history = new History(version.text);
    this.loading = false;
    this.show(version.text);
  }

  /** What is on the disk takes the place of the text; undo brings that back. */
  load(): void {
    this.loading = this.history.text !== "";
    this.ask({ do: "open" });
  }

  /** Over the version that was opened, or another one that was looked at. */
  save(over = this.base.hash): void {
    this.refusal = "";
    this.saving = true;
    this.saved = this.graph.text;
    this.ask({ do: "save", text: this.saved, over });
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
    const judge = (): void => this.ask({ do: "judge", id, text, profile: this.profile });
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
    this.findings = verdict.problems.map((problem) => {
      if (problem.file !== this.hello?.file || problem.line < 1) return { problem };
      const offset = offsetAt(graph.text, problem.line, problem.column);
      const { part, connection } = graph.at(offset);
      return { problem, offset, ...(part ? { part: `${part.kind} ${part.name}` } : {}), ...(connection ? { connection: graph.connections.indexOf(connection) } : {}) };
    });
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
    const end = ({ name, field }: { name: string; field: string }): string => (field ? `${name}.${field}` : name);
    this.chosen = { kind: "connection", from: end(connection.from), to: end(connection.to) };
  }
  findConnection(from: string, to: string): Connection | undefined {
    const end = ({ name, field }: { name: string; field: string }): string => (field ? `${name}.${field}` : name);
    return this.graph.connections.find((c) => end(c.from) === from && end(c.to) === to);
  }
  get chosenPart(): Part | undefined {
    const { chosen } = this;
    return chosen.kind === "connection" || chosen.kind === "graph" ? undefined : this.graph.find(chosen.kind, chosen.name);
  }
  get chosenConnection(): Connection | undefined {
    return this.chosen.kind === "connection" ? this.findConnection(this.chosen.from, this.chosen.to) : undefined;
  }
}
