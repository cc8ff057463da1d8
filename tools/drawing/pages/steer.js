// How time is steered on a picture: by mouse, touch and keys. Dragging marks what to look at; with Shift, or by finger,
// it moves; two fingers and Ctrl with the wheel come closer.
import {el} from './base.js';

/** `area()`: {left, width} in px of the element. */
export function steer(element, time, area) {
  const timeAt = (x) => {
    const {left, width} = area();
    return time.from + (x - left) / width * (time.to - time.from);
  };
  const touches = new Map();
  let drag = null;
  const mark = {get from() { return drag?.kind === 'mark' ? Math.min(drag.start, drag.now) : null; },
                get to() { return drag?.kind === 'mark' ? Math.max(drag.start, drag.now) : null; }};

  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    touches.set(event.pointerId, event.offsetX);
    if (touches.size === 2) {
      const [a, b] = touches.values();
      drag = {kind: 'pinch', a: timeAt(a), b: timeAt(b)};
    } else {
      const moves = event.shiftKey || event.pointerType === 'touch';
      drag = {kind: moves ? 'move' : 'mark', start: timeAt(event.offsetX), now: timeAt(event.offsetX), x: event.offsetX};
    }
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    if (touches.has(event.pointerId)) touches.set(event.pointerId, event.offsetX);
    if (drag?.kind === 'pinch' && touches.size === 2) {
      const {left, width} = area();
      const [x, y] = touches.values();
      const perPx = (drag.b - drag.a) / (y - x || 1);
      if (perPx > 0) time.show(drag.a - (x - left) * perPx, drag.a - (x - left) * perPx + width * perPx);
    } else if (drag?.kind === 'move') {
      const by = drag.start - timeAt(event.offsetX);
      time.show(time.from + by, time.to + by);
    } else {
      if (drag) drag.now = timeAt(event.offsetX);
      time.point(timeAt(event.offsetX));
    }
  });
  const release = (event) => {
    touches.delete(event.pointerId);
    const done = drag;
    drag = null;
    if (done?.kind === 'mark' && Math.abs(event.offsetX - done.x) > 4)
      time.show(Math.min(done.start, done.now), Math.max(done.start, done.now));
    else time.changed();
  };
  element.addEventListener('pointerup', release);
  element.addEventListener('pointercancel', release);
  element.addEventListener('pointerleave', () => { if (!drag) time.point(null); });
  element.addEventListener('dblclick', () => time.whole());
  element.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    time.zoom(Math.exp(-event.deltaY / 300), timeAt(event.offsetX));
  }, {passive: false});
  element.addEventListener('keydown', (event) => {
    const act = {ArrowLeft: () => time.pan(-0.2), ArrowRight: () => time.pan(0.2), '+': () => time.zoom(1.5),
                 '=': () => time.zoom(1.5), '-': () => time.zoom(1 / 1.5), 0: () => time.whole(), Home: () => time.whole()}[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  return mark;
}

/** The same by buttons, and what is looked at in words. */
export function timeButtons(time) {
  const shows = el('span', {class: 'shows', role: 'status'});
  const write = () => {
    const digits = Math.max(0, Math.min(9, 2 - Math.floor(Math.log10(time.to - time.from))));
    shows.textContent = `${time.from.toFixed(digits)} to ${time.to.toFixed(digits)} s`;
  };
  time.watch(write);
  write();
  const button = (text, label, act) => el('button', {type: 'button', 'aria-label': label, title: label, onclick: act}, text);
  return el('div', {class: 'buttons'},
    button('−', 'zoom out', () => time.zoom(1 / 1.6)), button('+', 'zoom in', () => time.zoom(1.6)),
    button('‹', 'earlier', () => time.pan(-0.3)), button('›', 'later', () => time.pan(0.3)),
    button('All', 'the whole run', () => time.whole()), shows);
}
