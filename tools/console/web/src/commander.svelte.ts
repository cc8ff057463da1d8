// One page commands an operator of the graph, others watch: what all desks have in common.

import type { DeskDescription } from "./protocol.ts";
import type { Run } from "./run.svelte.ts";

export class Commander {
  private readonly own = Math.random().toString(36).slice(2, 12);
  private readonly run: () => Run;
  private readonly type: string;
  private sequence = 0;
  /** After so many breaks of the connection it has asked for the command, and not let go since, though the server's word may not
   * be here yet. After another break it would have to ask anew. */
  private asked: number | undefined = $state();

  /** Of the operator whose distributer has that type. */
  constructor(run: () => Run, type: string) {
    this.run = run;
    this.type = type;
  }

  get desk(): DeskDescription {
    return this.run().hello!.desks!.find((desk) => desk.type === this.type)!;
  }
  private get seat(): { commander: string | null; why?: string } | undefined {
    return this.run().desks[this.desk.name];
  }
  /** There is a run to command. */
  get open(): boolean {
    return this.run().link === "open" && this.run().ended === undefined && !this.run().silent;
  }
  private get holds(): boolean {
    return this.asked === this.run().breaks;
  }
  get commands(): boolean {
    return this.holds && this.seat?.commander === this.own && this.open;
  }
  get another(): boolean {
    const commander = this.seat?.commander;
    return commander !== undefined && commander !== null && commander !== this.own;
  }
  /** Who commands, in words. */
  get text(): string {
    const name = this.desk.name;
    if (this.run().ended !== undefined) return "The run has ended";
    if (this.run().silent || this.run().link === "lost") return `Nothing comes from jarol any more: ${name} does without this page`;
    if (this.commands) return `You command ${name}`;
    if (this.another) return `Another page commands ${name}; this one watches`;
    return this.seat?.why ? `Nobody commands: ${this.seat.why}` : `Nobody commands ${name}`;
  }

  take(sticks: Record<string, number>): void {
    this.sequence = 0;
    this.asked = this.run().breaks;
    this.run().ask({ do: "take", desk: this.desk.name, as: this.own, sticks });
  }
  release(): void {
    // also of what is on its way
    if (this.holds && !this.another) this.run().ask({ do: "release", desk: this.desk.name });
    this.asked = undefined;
  }
  send(message: string, fields?: object): void {
    if (!this.holds) return;
    const { name } = this.desk;
    this.run().ask({ do: "send", desk: name, sequence: ++this.sequence, t: performance.now(), message, fields });
  }
  /** Commands nothing, and is heard. */
  stay(): void {
    this.run().ask({ do: "alive", desk: this.desk.name });
  }

  /** Calls `turn` each so many milliseconds; whoever looks elsewhere does not command: then `letGo` is called. */
  attend(rate: number, turn: () => void, letGo: () => void): () => void {
    const timer = setInterval(turn, rate);
    const hidden = () => document.hidden && letGo();
    window.addEventListener("blur", letGo);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      clearInterval(timer);
      letGo();
      window.removeEventListener("blur", letGo);
      document.removeEventListener("visibilitychange", hidden);
    };
  }
}
