// A socket of a console as a page has it, without a browser: many of them cost little, and they may do what no page does.
import {randomBytes} from 'node:crypto';
import {connect} from 'node:net';

export class Watcher {
  /** `status` is that of the answer: 101 where it watches. One that does not read takes nothing more of what is sent. */
  static open(url, {origin = undefined, reads = true} = {}) {
    const to = new URL(url);
    const watcher = new Watcher();
    const socket = (watcher.socket = connect({port: Number(to.port), host: to.hostname}));
    socket.on('error', () => {});
    socket.on('close', () => watcher.over());
    watcher.closed = new Promise((over) => (watcher.over = over));
    return new Promise((opened) => {
      socket.on('data', (data) => {
        watcher.bytes = Buffer.concat([watcher.bytes, data]);
        if (watcher.status === 0) {
          const end = watcher.bytes.indexOf('\r\n\r\n');
          if (end < 0) return;
          watcher.status = Number(watcher.bytes.toString('latin1', 9, 12));
          watcher.bytes = watcher.bytes.subarray(end + 4);
          if (!reads) socket.pause();
          opened(watcher);
        }
        if (watcher.status === 101) watcher.take();
      });
      socket.write(`GET /socket${to.search} HTTP/1.1\r\nHost: ${to.host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n` +
        `Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ${randomBytes(16).toString('base64')}\r\n${origin ? `Origin: ${origin}\r\n` : ''}\r\n`);
    });
  }

  status = 0;
  /** Messages so far, and of each key of theirs the newest. */
  count = 0;
  newest = {};
  closeCode = 0;
  closeReason = '';
  bytes = Buffer.alloc(0);
  text = [];

  // frames, of which several may be one message
  take() {
    for (;;) {
      if (this.bytes.length < 2) return;
      const short = this.bytes[1] & 127, from = short === 126 ? 4 : short === 127 ? 10 : 2;
      if (this.bytes.length < from) return;
      const length = short === 126 ? this.bytes.readUInt16BE(2) : short === 127 ? Number(this.bytes.readBigUInt64BE(2)) : short;
      if (this.bytes.length < from + length) return;
      const [kind, payload] = [this.bytes[0] & 15, this.bytes.subarray(from, from + length)];
      const isLast = (this.bytes[0] & 128) !== 0;
      this.bytes = this.bytes.subarray(from + length);
      if (kind === 8) {
        [this.closeCode, this.closeReason] = [payload.readUInt16BE(0), payload.toString('utf8', 2)];
        this.socket.end();
      } else if (kind === 9) {
        this.frame(10, payload);
      } else if (kind < 2) {
        this.text.push(payload);
        if (!isLast) continue;
        ++this.count;
        Object.assign(this.newest, JSON.parse(Buffer.concat(this.text.splice(0)).toString('utf8')));
      }
    }
  }

  frame(kind, payload) {
    const head = Buffer.alloc(payload.length < 126 ? 2 : 10);
    head[0] = 128 | kind;
    head[1] = 128 | Math.min(payload.length, payload.length < 126 ? 125 : 127);
    if (payload.length >= 126) head.writeBigUInt64BE(BigInt(payload.length), 2);
    // masked by zeros
    this.socket.write(Buffer.concat([head, Buffer.alloc(4), payload]));
  }

  send(text) { this.frame(1, Buffer.from(text)); }
  sendBytes(bytes) { this.frame(2, Buffer.from(bytes)); }
  ask(what) { this.send(JSON.stringify(what)); }
  goOn() { this.socket.resume(); }
  cut() { this.socket.destroy(); }

  /** Until that has come to be of what it has got. */
  async until(is) {
    for (const end = Date.now() + 60_000; !is(this.newest); ) {
      if (Date.now() > end) throw new Error(`it did not come to be: ${is}; it has ${Object.keys(this.newest)}`);
      await new Promise((done) => setTimeout(done, 10));
    }
  }
}
