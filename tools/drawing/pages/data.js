// The numbers of a page: they stand in it as the bytes of doubles, so that they are those of the recording to the bit.

export function readData() {
  return JSON.parse(document.getElementById('data').textContent);
}

export function doubles(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float64Array.from({length: bytes.length / 8}, (_, i) => view.getFloat64(8 * i, true));
}

/** Times in seconds: listed, or as many steps from a first one. */
export function readTimes(times) {
  if (times.list !== undefined) return doubles(times.list);
  return Float64Array.from({length: times.count}, (_, i) => (times.first_ns + i * times.step_ns) / 1e9);
}

function readValues(values) {
  return typeof values === 'string' ? doubles(values) : Float64Array.of(values.same);
}

/** A signal of the page, read when it is first asked for. `low` and `high` are one where nothing is thinned. */
export class Signal {
  constructor(stated, topics, index) {
    Object.assign(this, {index, name: stated.name, unit: stated.unit, stated, topic: topics[stated.topic]});
  }

  get thinned() { return this.stated.low !== undefined; }

  load() {
    if (this.times !== undefined) return this;
    this.topic.read ??= readTimes(this.topic.times);
    this.times = this.topic.read;
    const spread = (values) => values.length === this.times.length ? values : new Float64Array(this.times.length).fill(values[0]);
    const stated = this.stated;
    this.low = spread(readValues(this.thinned ? stated.low : stated.values));
    this.high = this.thinned ? spread(readValues(stated.high)) : this.low;
    return this;
  }

  /** The last index whose time is not after `time`; -1: none. */
  indexAt(time) {
    let from = -1, to = this.times.length;
    while (to - from > 1) {
      const middle = (from + to) >> 1;
      if (this.times[middle] <= time) from = middle; else to = middle;
    }
    return from;
  }

  /** Which value it has then, as the middle of what it had meanwhile where it is thinned. */
  at(time) {
    const index = this.load().indexAt(time);
    return index < 0 ? NaN : (this.low[index] + this.high[index]) / 2;
  }
}

/** The part of the time that is looked at; plots and time lines share one. */
export class TimeWindow {
  constructor(begin, end) {
    this.begin = begin;
    this.end = Math.max(end, begin + 1e-9);
    this.from = this.begin;
    this.to = this.end;
    this.cursor = null;
    this.watchers = [];
  }

  watch(watcher) { this.watchers.push(watcher); }
  changed() { for (const watcher of this.watchers) watcher(); }

  show(from, to) {
    const min = (this.end - this.begin) * 1e-7;
    const length = Math.min(Math.max(to - from, min), this.end - this.begin);
    this.from = Math.min(Math.max(from, this.begin), this.end - length);
    this.to = this.from + length;
    this.changed();
  }

  /** Above one: closer, to that instant. */
  zoom(factor, around = (this.from + this.to) / 2) {
    this.show(around - (around - this.from) / factor, around + (this.to - around) / factor);
  }
  pan(part) {
    const by = (this.to - this.from) * part;
    this.show(this.from + by, this.to + by);
  }
  whole() { this.show(this.begin, this.end); }

  point(time) {
    this.cursor = time;
    this.changed();
  }
}
