// Texts as they were and will be: undo and redo.

export interface Step {
  text: string;
  /** What led to it, as in "rename depth". */
  label: string;
}

export class History {
  private steps: Step[];
  private at = 0;
  private bytes: number;
  // what is typed in one go is one step
  private typing = 0;

  private readonly room: number;

  constructor(text: string, room = 64 << 20) {
    this.room = room;
    this.steps = [{ text, label: "" }];
    this.bytes = text.length;
  }

  get text(): string {
    return this.steps[this.at]!.text;
  }
  get undoes(): string | undefined {
    return this.at > 0 ? this.steps[this.at]!.label : undefined;
  }
  get redoes(): string | undefined {
    return this.steps[this.at + 1]?.label;
  }

  add(text: string, label: string, now = 0): void {
    if (text === this.text) return;
    const goesOn = now > 0 && now - this.typing < 1000 && this.at === this.steps.length - 1 && this.steps[this.at]!.label === label;
    this.typing = now;
    for (const step of this.steps.splice(this.at + 1)) this.bytes -= step.text.length;
    if (goesOn && this.at > 0) {
      this.bytes += text.length - this.text.length;
      this.steps[this.at]!.text = text;
      return;
    }
    this.steps.push({ text, label });
    this.bytes += text.length;
    ++this.at;
    // the first stays: it is what was opened
    while (this.bytes > this.room && this.at > 2) {
      this.bytes -= this.steps.splice(1, 1)[0]!.text.length;
      --this.at;
    }
  }

  undo(): string {
    this.typing = 0;
    this.at = Math.max(0, this.at - 1);
    return this.text;
  }
  redo(): string {
    this.typing = 0;
    this.at = Math.min(this.steps.length - 1, this.at + 1);
    return this.text;
  }
}
