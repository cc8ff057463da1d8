// How this browser's user likes the page: kept by the browser.

const key = "jarol.console.2";

export class Settings {
  theme: "light" | "dark" = $state(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  /** Parts in percent. */
  left = $state(42);
  upper = $state(61);
  lower = $state(66);
  /** The view that has all the room; empty: none. */
  whole = $state("");
  camera: "follow" | "overview" = $state("follow");
  /** Which of several views in one place is shown. */
  tabs: Record<string, string> = $state({});
  /** Seconds that plots show; 0: all. */
  window = $state(0);

  constructor() {
    try {
      const kept = JSON.parse(localStorage.getItem(key) ?? "{}") as Record<string, unknown>;
      if (kept["theme"] === "light" || kept["theme"] === "dark") this.theme = kept["theme"];
      for (const part of ["left", "upper", "lower"] as const)
        if (typeof kept[part] === "number") this.set(part, kept[part]);
      const tabs = kept["tabs"];
      if (typeof tabs === "object" && tabs !== null)
        for (const [place, name] of Object.entries(tabs)) if (typeof name === "string") this.tabs[place] = name;
      if (kept["camera"] === "overview") this.camera = "overview";
      if (typeof kept["window"] === "number") this.window = kept["window"];
    } catch {
      // what was kept is of no use, or nothing is kept here
    }
  }

  set(part: "left" | "upper" | "lower", percent: number): void {
    this[part] = Math.min(85, Math.max(15, percent));
  }

  keep(): void {
    const { theme, left, upper, lower, camera, tabs, window } = this;
    try {
      localStorage.setItem(key, JSON.stringify({ theme, left, upper, lower, camera, tabs, window }));
    } catch {
      // this browser keeps nothing
    }
  }
}
