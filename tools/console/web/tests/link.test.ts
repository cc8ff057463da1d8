import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Link, maxPause, minPause } from "../src/link.ts";

// What a browser gives: the test decides what becomes of each connection.
class Socket {
  static readonly OPEN = 1;
  static made: Socket[] = [];
  static get last(): Socket {
    return Socket.made.at(-1)!;
  }
  readyState = 0;
  sent: string[] = [];
  onmessage = (_: { data: string }): void => {};
  onclose = (): void => {};
  readonly url: string;
  constructor(url: string) {
    this.url = url;
    Socket.made.push(this);
  }
  send(text: string): void {
    this.sent.push(text);
  }
  open(): void {
    this.readyState = Socket.OPEN;
  }
  close(): void {
    this.readyState = 3;
    this.onclose();
  }
}
Object.assign(globalThis, { WebSocket: Socket, location: { protocol: "https:", host: "a.example:1", search: "?token=abc" } });

function linked(triesAgain = true): { link: Link; said: string[] } {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  Socket.made = [];
  const said: string[] = [];
  const link = new Link({
    onmessage: (text) => void said.push(text),
    onlost: () => (said.push("lost"), triesAgain),
  });
  link.connect();
  return { link, said };
}

test("a broken connection is made anew with the same token, after a pause that grows until something is heard", () => {
  const { said } = linked();
  Socket.last.open();
  Socket.last.onmessage({ data: "hello" });
  assert.deepEqual(said, ["hello"]);
  for (let pause = minPause, tries = 1; tries < 8; pause = Math.min(2 * pause, maxPause), ++tries) {
    Socket.last.close();
    mock.timers.tick(pause - 1);
    assert.equal(Socket.made.length, tries, "it waits");
    mock.timers.tick(1);
    assert.equal(Socket.made.length, tries + 1);
    assert.equal(Socket.last.url, "wss://a.example:1/socket?token=abc");
  }
  // one that is heard again is lost as for the first time
  Socket.last.open();
  Socket.last.onmessage({ data: "hello" });
  Socket.last.close();
  mock.timers.tick(minPause);
  assert.equal(Socket.made.length, 9);
});

test("who does not want to is not connected anew", () => {
  const { said } = linked(false);
  Socket.last.close();
  mock.timers.tick(100 * maxPause);
  assert.equal(Socket.made.length, 1);
  assert.deepEqual(said, ["lost"]);
});

test("what can't be sent is said, and is not sent after the break", () => {
  const { link } = linked();
  assert.equal(link.send({ do: "early" }), false);
  Socket.last.open();
  assert.equal(link.send({ do: "save" }), true);
  Socket.last.close();
  assert.equal(link.send({ do: "late" }), false);
  const [first] = Socket.made;
  mock.timers.tick(minPause);
  Socket.last.open();
  assert.deepEqual(first!.sent, ['{"do":"save"}']);
  assert.deepEqual(Socket.last.sent, []);
});
