// One plot: signals over the time that is looked at, a scale for each unit, and what they are under the cursor.
import {canvas, colour, dashes, el, number, series, shown, ticks} from './base.js';
import {steer} from './steer.js';

const left = 60, top = 12, bottom = 30;

/** `slots`: of each plot which signal has which colour. */
export class Plot {
  constructor(time, happenings, onchange) {
    this.time = time;
    this.happenings = happenings;
    this.onchange = onchange;
    this.signals = [];  // {signal, slot}
    this.legend = el('ul', {class: 'legend', 'aria-label': 'signals of this plot'});
    this.picture = canvas('', 230, (context, width, height) => this.draw(context, width, height));
    this.mark = steer(this.picture.element, time, () => ({left, width: this.picture.box.clientWidth - left - this.right()}));
    this.element = el('article', {class: 'plot', 'aria-label': 'plot'}, this.legend, this.picture.box);
    time.watch(() => { this.picture.redraw(); this.writeValues(); });
    this.changed();
  }

  has(signal) { return this.signals.some((s) => s.signal === signal); }

  add(signal) {
    if (this.has(signal)) return;
    const used = new Set(this.signals.map((s) => s.slot));
    let slot = 0;
    while (used.has(slot)) ++slot;
    this.signals.push({signal: signal.load(), slot});
    this.changed();
  }

  remove(signal) {
    this.signals = this.signals.filter((s) => s.signal !== signal);
    this.changed();
  }

  changed() {
    this.legend.replaceChildren(...this.signals.map((s) => {
      const {unit} = shown(s.signal.unit);
      const swatch = el('span', {class: `swatch series-${s.slot % series}`, 'aria-hidden': 'true'});
      s.value = el('span', {class: 'value'});
      return el('li', {}, swatch, el('span', {class: 'name'}, s.signal.name), s.value,
        unit ? el('span', {class: 'unit'}, unit) : null,
        el('button', {type: 'button', 'aria-label': `take ${s.signal.name} out of the plot`, title: 'take out',
                      onclick: () => { this.remove(s.signal); this.onchange(); }}, '×'));
    }), ...(this.signals.length === 0 ? [el('li', {class: 'empty'}, 'Drag a signal here, or tick it in the list.')] : []));
    this.picture.element.setAttribute('aria-label', this.signals.length === 0 ? 'an empty plot'
      : 'plot of ' + this.signals.map((s) => s.signal.name).join(', ') + ' over time; its numbers stand in the list of signals');
    this.writeValues();
    this.picture.redraw();
  }

  writeValues() {
    for (const s of this.signals) {
      const at = this.time.cursor ?? this.time.to;
      s.value.textContent = number(s.signal.at(at) * shown(s.signal.unit).scale);
    }
  }

  // Room for a second scale where there is one.
  right() { return new Set(this.signals.map((s) => s.signal.unit)).size > 1 ? 60 : 14; }

  // Of each unit from the least to the greatest that is seen.
  scales() {
    const scales = new Map();
    for (const {signal} of this.signals) {
      const {unit, scale} = shown(signal.unit);
      const of = scales.get(unit) ?? {unit, min: Infinity, max: -Infinity};
      scales.set(unit, of);
      const end = signal.indexAt(this.time.to);
      for (let i = Math.max(0, signal.indexAt(this.time.from)); i <= end; ++i) {
        if (signal.low[i] * scale < of.min) of.min = signal.low[i] * scale;
        if (signal.high[i] * scale > of.max) of.max = signal.high[i] * scale;
      }
    }
    for (const of of scales.values()) {
      if (!Number.isFinite(of.min) || !Number.isFinite(of.max)) [of.min, of.max] = [0, 1];
      const room = (of.max - of.min) * 0.07 || Math.abs(of.max) * 0.1 || 1;
      of.min -= room;
      of.max += room;
    }
    return [...scales.values()];
  }

  draw(context, width, height) {
    const {time} = this, right = this.right();
    const plotWidth = width - left - right, plotHeight = height - top - bottom;
    const x = (t) => left + (t - time.from) / (time.to - time.from) * plotWidth;
    const scales = this.scales();
    const y = (scale, value) => top + (1 - (value - scale.min) / (scale.max - scale.min)) * plotHeight;
    this.drawGrid(context, {x, y, scales, width, height});
    context.save();
    context.beginPath();
    context.rect(left, top, plotWidth, plotHeight);
    context.clip();
    this.drawHappenings(context, x, height);
    for (const s of this.signals) {
      const {unit, scale} = shown(s.signal.unit);
      const of = scales.find((each) => each.unit === unit);
      this.drawSignal(context, s, x, (value) => y(of, value * scale));
    }
    if (this.mark.from !== null) {
      context.fillStyle = colour('mark');
      context.fillRect(x(this.mark.from), top, x(this.mark.to) - x(this.mark.from), plotHeight);
    }
    if (time.cursor !== null && time.cursor >= time.from && time.cursor <= time.to) {
      context.fillStyle = colour('ink-soft');
      context.fillRect(Math.round(x(time.cursor)), top, 1, plotHeight);
    }
    context.restore();
  }

  drawGrid(context, {x, y, scales, width, height}) {
    const right = this.right();
    const plotWidth = width - left - right;
    context.fillStyle = colour('ink-soft');
    context.strokeStyle = colour('line');
    context.lineWidth = 1;
    context.textBaseline = 'middle';
    context.beginPath();
    context.textAlign = 'center';
    for (const t of ticks(this.time.from, this.time.to, Math.max(2, plotWidth / 90))) {
      const at = Math.round(x(t)) + 0.5;
      context.moveTo(at, top);
      context.lineTo(at, height - bottom);
      if (at > left - 8 && at < width - right + 8) context.fillText(number(t, 9), at, height - bottom + 14);
    }
    context.textAlign = 'right';
    context.fillText('s', left - 8, height - bottom + 14);
    // the first scale stands left, the second right; others have none
    scales.slice(0, 2).forEach((scale, i) => {
      context.textAlign = i === 0 ? 'right' : 'left';
      for (const value of ticks(scale.min, scale.max, 4)) {
        const at = Math.round(y(scale, value)) + 0.5;
        if (i === 0) {
          context.moveTo(left, at);
          context.lineTo(width - right, at);
        }
        context.fillText(number(value), i === 0 ? left - 8 : width - right + 8, at);
      }
    });
    context.stroke();
  }

  drawHappenings(context, x, height) {
    context.fillStyle = colour('fault');
    for (const {instant, fault} of this.happenings) {
      if (instant < this.time.from || instant > this.time.to) continue;
      context.globalAlpha = fault ? 0.55 : 0.3;
      context.fillRect(Math.round(x(instant)), top, 1, height - top - bottom);
    }
    context.globalAlpha = 1;
  }

  // What is published holds until the next value comes; many values in one pixel are its least and greatest.
  drawSignal(context, {signal, slot}, x, y) {
    const from = Math.max(0, signal.indexAt(this.time.from)), to = signal.indexAt(this.time.to);
    if (to < 0) return;
    context.strokeStyle = context.fillStyle = colour('series-' + slot % series);
    context.lineWidth = 1.8;
    const perPx = (to - from + 1) / Math.max(1, x(this.time.to) - x(this.time.from));
    if (signal.thinned) {
      context.globalAlpha = 0.3;
      for (let i = from; i <= to; ++i) {
        if (Number.isNaN(signal.low[i])) continue;
        const begin = x(signal.times[i]), next = i < to ? x(signal.times[i + 1]) : begin + 2;
        context.fillRect(begin, y(signal.high[i]), Math.max(1, next - begin), Math.max(1, y(signal.low[i]) - y(signal.high[i])));
      }
      context.globalAlpha = 1;
    }
    context.setLineDash(perPx > 1 ? [] : dashes[slot % series]);
    context.beginPath();
    let pen = false, column = NaN, min = 0, max = 0;
    for (let i = from; i <= to; ++i) {
      const value = (signal.low[i] + signal.high[i]) / 2;
      if (!Number.isFinite(value)) {
        pen = false;
        continue;
      }
      const at = x(signal.times[i]), high = y(value);
      if (perPx > 2 && pen && Math.floor(at) === column) {
        min = Math.min(min, high);
        max = Math.max(max, high);
        context.lineTo(at, min);
        context.lineTo(at, max);
        context.lineTo(at, high);
        continue;
      }
      column = Math.floor(at);
      min = max = high;
      if (!pen) context.moveTo(at, high);
      else {
        if (!signal.thinned && perPx < 0.5) context.lineTo(at, y((signal.low[i - 1] + signal.high[i - 1]) / 2));
        context.lineTo(at, high);
      }
      pen = true;
    }
    if (pen && !signal.thinned) context.lineTo(x(Math.min(this.time.to, this.time.end)), y(signal.low[to]));
    context.stroke();
    context.setLineDash([]);
  }
}
