// A page's socket to jarol, which connects anew after a break.

/** Milliseconds until the first try; before each next one it waits twice as long, at most `maxPause`. */
export const minPause = 500;
export const maxPause = 10_000;

export interface LinkUser {
  onmessage(text: string): void;
  /** The connection broke, or could not be had. Whether to try again. */
  onlost(): boolean;
}

export class Link {
  private readonly user: LinkUser;
  private socket: WebSocket | undefined;
  private pause = minPause;

  constructor(user: LinkUser) {
    this.user = user;
  }

  /** With the token of the page's address. */
  connect(): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket${location.search}`);
    this.socket = socket;
    socket.onmessage = (event: MessageEvent<string>) => {
      this.pause = minPause;
      this.user.onmessage(event.data);
    };
    socket.onclose = () => {
      this.socket = undefined;
      if (!this.user.onlost()) return;
      setTimeout(() => this.connect(), this.pause);
      this.pause = Math.min(2 * this.pause, maxPause);
    };
  }

  /** Whether it could be sent. What could not is not kept: after a break it could mean something else. */
  send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }
}
