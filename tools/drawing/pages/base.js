// What all parts of a page share: elements, numbers in words, the colours of the browser's setting.

/** An element with attributes and children; on... is a listener. */
export function el(name, attributes = {}, ...children) {
  return build(document.createElement(name), attributes, children);
}

export function svg(name, attributes = {}, ...children) {
  return build(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);
}

function build(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? '' : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

/** A table; `columns`: [title, is a number]; a cell is text or an element. */
export function table(caption, columns, rows) {
  return el('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': caption},
    el('table', {}, el('caption', {class: 'unseen'}, caption),
      el('thead', {}, el('tr', {}, columns.map(([title, number]) =>
        el('th', {scope: 'col', class: number ? 'number' : null}, title)))),
      el('tbody', {}, rows.map((row) => el('tr', {}, row.map((cell, i) =>
        el(i === 0 ? 'th' : 'td', {scope: i === 0 ? 'row' : null, class: columns[i][1] ? 'number' : null}, cell)))))));
}

/** A command that one can copy. */
export function command(text) {
  const button = el('button', {type: 'button', class: 'copy', 'aria-label': 'copy the command'}, 'Copy');
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      const range = document.createRange();
      range.selectNodeContents(button.previousElementSibling);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      document.execCommand('copy');
    }
    button.textContent = 'Copied';
    setTimeout(() => { button.textContent = 'Copy'; }, 1500);
  });
  return el('div', {class: 'command'}, el('code', {tabindex: 0}, text), button);
}

/** A section of the page, and its entry in the list of contents. */
export function section(id, title, text, ...children) {
  return el('section', {id, 'aria-labelledby': id + '-title'},
    el('h2', {id: id + '-title'}, title), text ? el('p', {class: 'lead'}, text) : null, ...children);
}

/** A number that counts. */
export function plain(number) { return number.toLocaleString('en-US'); }

export function count(number, one, many = one + 's') {
  return `${plain(number)} ${number === 1 ? one : many}`;
}

/** Up to so many digits that count. */
export function number(value, digits = 5) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 2)).split('e');
    return `${Number(mantissa)}·10${superscript(Number(exponent))}`.replace('-', '−');
  }
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

function superscript(exponent) {
  return [...String(exponent)].map((c) => c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]).join('');
}

/** Nanoseconds, in the unit that suits them. */
export function duration(ns, digits = 4) {
  if (ns === null || ns === undefined) return '–';
  const size = Math.abs(ns);
  for (const [unit, length] of [['s', 1e9], ['ms', 1e6], ['µs', 1e3]])
    if (size >= length) return `${number(ns / length, digits)} ${unit}`;
  return `${number(ns, digits)} ns`;
}

/** What people read in place of radians; `scale` takes the number there. */
export function shown(unit) {
  if (unit === 'rad' || unit.startsWith('rad/'))
    return {unit: unit === 'rad' ? '°' : '°' + unit.slice(3), scale: 180 / Math.PI};
  return {unit: unit.replace('^2', '²').replace('degC', '°C'), scale: 1};
}

/** Round numbers that cut a range into some `wanted` parts. */
export function ticks(from, to, wanted) {
  if (!(to > from)) return [from];
  const rough = (to - from) / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((s) => s * power).find((s) => s >= rough * 0.999);
  const found = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; ++i) found.push(Number((i * step).toPrecision(12)));
  return found;
}

/** A colour of the style sheet. */
export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

export const series = 8;  // --series-0 to --series-7, each with a dash of its own
export const dashes = [[], [7, 3], [2, 3], [9, 3, 2, 3], [5, 2], [1, 2], [12, 4], [4, 2, 1, 2]];

/** Calls back when the browser goes from light to dark or back, or the page is printed. */
export function onColours(draw) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
}

/** A canvas that keeps the size of its box, sharp on any screen; `draw(context, width, height)`. */
export function canvas(label, height, draw) {
  const element = el('canvas', {role: 'img', 'aria-label': label, tabindex: 0});
  const box = el('div', {class: 'canvas'}, element);
  box.style.height = height + 'px';
  let asked = false;
  const paint = () => {
    asked = false;
    const {width, height: high} = box.getBoundingClientRect();
    if (width < 2 || high < 2) return;
    const ratio = devicePixelRatio || 1;
    element.width = Math.round(width * ratio);
    element.height = Math.round(high * ratio);
    const context = element.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, high);
    context.font = '12px ' + getComputedStyle(document.body).fontFamily;
    draw(context, width, high);
  };
  const redraw = () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(paint);
  };
  new ResizeObserver(redraw).observe(box);
  onColours(redraw);
  return {box, element, redraw};
}
