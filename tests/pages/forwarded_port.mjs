// A port that leads to another one of this machine, as `ssh -L` does, and that can be cut and mended.
import net from 'node:net';

export class ForwardedPort {
  /** To where that address leads; `url` is the same through this port. */
  static async to(url) {
    const there = new URL(url), forwarded = new ForwardedPort();
    Object.assign(forwarded, {there, ends: new Set(), far: new Set(), port: 0});
    await forwarded.mend();
    const here = new URL(url);
    here.port = forwarded.port;
    forwarded.url = here.href;
    return forwarded;
  }

  /** Connections that are there are broken, and none is made until it is mended. */
  async cut() {
    const closed = new Promise((done) => this.server.close(done));
    for (const end of this.ends) end.destroy();
    await closed;
  }

  /** What jarol sends stays here from now on, until it is cut. */
  hold() {
    for (const far of this.far) far.pause().unpipe();
  }

  mend() {
    this.server = net.createServer((near) => {
      const far = net.connect(this.there.port, this.there.hostname);
      this.far.add(far);
      far.on('close', () => this.far.delete(far));
      for (const [one, other] of [[near, far], [far, near]]) {
        this.ends.add(one);
        one.pipe(other);
        one.on('error', () => {});
        one.on('close', () => (this.ends.delete(one), other.destroy()));
      }
    });
    this.server.unref();
    return new Promise((done) => this.server.listen(this.port, '127.0.0.1', () => {
      this.port = this.server.address().port;
      done();
    }));
  }
}
