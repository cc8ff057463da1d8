// How numbers of many runs lie: a histogram, and one number against another.
import {canvas, colour, count, number, shown, ticks} from './base.js';

const inset = {left: 64, right: 18, top: 14, bottom: 44};

// What a picture of two axes has in common; `xs`, `ys`: {from, to, title, words}.
function drawAxes(context, width, height, xs, ys) {
  const wide = width - inset.left - inset.right, high = height - inset.top - inset.bottom;
  const x = (v) => inset.left + (v - xs.from) / (xs.to - xs.from || 1) * wide;
  const y = (v) => inset.top + (1 - (v - ys.from) / (ys.to - ys.from || 1)) * high;
  context.strokeStyle = colour('line');
  context.fillStyle = colour('ink-soft');
  context.textBaseline = 'middle';
  context.textAlign = 'center';
  context.beginPath();
  for (const v of xs.words ? xs.words.map((_, i) => i) : ticks(xs.from, xs.to, Math.max(2, wide / 80))) {
    context.moveTo(Math.round(x(v)) + 0.5, inset.top);
    context.lineTo(Math.round(x(v)) + 0.5, height - inset.bottom);
    context.fillText(xs.words ? xs.words[v].slice(0, 14) : number(v), x(v), height - inset.bottom + 13);
  }
  context.textAlign = 'right';
  for (const v of ticks(ys.from, ys.to, 5)) {
    context.moveTo(inset.left, Math.round(y(v)) + 0.5);
    context.lineTo(width - inset.right, Math.round(y(v)) + 0.5);
    context.fillText(number(v), inset.left - 8, y(v));
  }
  context.stroke();
  context.fillStyle = colour('ink');
  context.textAlign = 'center';
  context.fillText(xs.title, inset.left + wide / 2, height - 10, wide);
  context.save();
  context.translate(11, inset.top + high / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(ys.title, 0, 0, high);
  context.restore();
  return {x, y};
}

function drawLimit(context, from, to) {
  context.strokeStyle = colour('series-1');
  context.lineWidth = 2;
  context.setLineDash([6, 4]);
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  context.setLineDash([]);
  context.lineWidth = 1;
}

export function titled(name, unit) { return unit ? `${name}, ${unit}` : name; }

export function histogramOf({name, unit, histogram, limits}) {
  const {unit: shownUnit, scale} = shown(unit);
  const {from, width: step, good, others} = histogram;
  const all = good.map((n, i) => n + others[i]);
  const end = from + (step || 1) * good.length;
  const low = Math.min(from, ...limits), high = Math.max(end, ...limits), room = (high - low) * 0.03;
  const words = `histogram of ${name}: ` + all.map((n, i) => n > 0 ? `${count(n, 'run')} from ${number((from + i * step) * scale, 3)}` : '').filter(Boolean).join(', ');
  return canvas(words.slice(0, 900), 240, (context, width, height) => {
    const {x, y} = drawAxes(context, width, height, {from: (low - room) * scale, to: (high + room) * scale, title: titled(name, shownUnit)},
      {from: 0, to: Math.max(1, ...all) * 1.05, title: 'runs'});
    good.forEach((n, i) => {
      const left = x((from + i * (step || 1)) * scale), right = x((from + (i + 1) * (step || 1)) * scale);
      context.fillStyle = colour('series-0');
      context.fillRect(left + 0.5, y(n), Math.max(1, right - left - 1), y(0) - y(n));
      context.fillStyle = colour('series-1');
      context.fillRect(left + 0.5, y(all[i]), Math.max(1, right - left - 1), y(n) - y(all[i]));
    });
    for (const limit of limits) drawLimit(context, [x(limit * scale), inset.top], [x(limit * scale), height - inset.bottom]);
  }).box;
}

/** `across`, `up`: {name, unit, values, words, limits}; `good`: of each run; calls back with the run under the pointer. */
export function scatterOf(across, up, good, onpoint) {
  const xs = {...shown(across.unit), ...range(across)}, ys = {...shown(up.unit), ...range(up)};
  const at = {};
  const picture = canvas(`${up.name} against ${across.name}, ${count(across.values.length, 'run')}`, 320, (context, width, height) => {
    Object.assign(at, drawAxes(context, width, height,
      {from: xs.from * xs.scale, to: xs.to * xs.scale, title: titled(across.name, xs.unit), words: across.words},
      {from: ys.from * ys.scale, to: ys.to * ys.scale, title: titled(up.name, ys.unit)}));
    const size = across.values.length > 3000 ? 1.6 : across.values.length > 300 ? 2.6 : 4;
    for (const which of [true, false]) {
      context.fillStyle = context.strokeStyle = colour(which ? 'series-0' : 'series-1');
      context.globalAlpha = across.values.length > 3000 ? 0.45 : 0.8;
      across.values.forEach((value, i) => {
        if (good[i] !== which || Number.isNaN(up.values[i]) || Number.isNaN(value)) return;
        const px = at.x(value * xs.scale), py = at.y(up.values[i] * ys.scale);
        context.beginPath();
        if (which) {
          context.arc(px, py, size, 0, 7);
          context.fill();
        } else {
          // a shape of its own, too
          context.lineWidth = Math.max(1.4, size / 2);
          context.moveTo(px - size, py - size);
          context.lineTo(px + size, py + size);
          context.moveTo(px + size, py - size);
          context.lineTo(px - size, py + size);
          context.stroke();
        }
      });
    }
    context.globalAlpha = 1;
    context.lineWidth = 1;
    for (const limit of up.limits ?? []) drawLimit(context, [inset.left, at.y(limit * ys.scale)], [width - inset.right, at.y(limit * ys.scale)]);
    for (const limit of across.limits ?? []) drawLimit(context, [at.x(limit * xs.scale), inset.top], [at.x(limit * xs.scale), height - inset.bottom]);
  });
  const nearest = (event) => {
    let best = -1, min = 18 ** 2;
    across.values.forEach((value, i) => {
      const d = (at.x(value * xs.scale) - event.offsetX) ** 2 + (at.y(up.values[i] * ys.scale) - event.offsetY) ** 2;
      if (d < min) [best, min] = [i, d];
    });
    onpoint(best);
  };
  picture.element.addEventListener('pointermove', nearest);
  picture.element.addEventListener('pointerdown', nearest);
  return picture.box;
}

function range({values, limits = [], words}) {
  if (words) return {from: -0.5, to: words.length - 0.5};
  let from = Math.min(Infinity, ...limits), to = Math.max(-Infinity, ...limits);
  for (const value of values) {
    if (value < from) from = value;
    if (value > to) to = value;
  }
  if (!Number.isFinite(from)) [from, to] = [0, 1];
  const room = (to - from) * 0.05 || Math.abs(from) * 0.1 || 1;
  return {from: from - room, to: to + room};
}
