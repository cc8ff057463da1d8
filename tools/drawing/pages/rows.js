// A picture of rows over time, as of tasks: each draws what falls into the time that is looked at.
import {canvas, colour, number, ticks} from './base.js';
import {steer} from './steer.js';

const rowsTop = 6, rowsBottom = 28, rowHeight = 26;

/** `rows`: {name, draw(pen, from, to)}; `unit`: {name, length} of the labels, in the window's time. */
export function rowsOf(label, rows, time, unit) {
  const longest = Math.max(...rows.map((row) => row.name.length));
  const left = () => Math.min(150, Math.max(64, longest * 7 + 14)), right = 14;
  const picture = canvas(label, rowsTop + rows.length * rowHeight + rowsBottom, (context, width, height) => {
    const area = {left: left(), width: width - left() - right};
    const x = (t) => area.left + (t - time.from) / (time.to - time.from) * area.width;
    context.textBaseline = 'middle';
    context.strokeStyle = colour('line');
    context.beginPath();
    context.fillStyle = colour('ink-soft');
    context.textAlign = 'center';
    for (const tick of ticks(time.from / unit.length, time.to / unit.length, Math.max(2, area.width / 90))) {
      const at = Math.round(x(tick * unit.length)) + 0.5;
      context.moveTo(at, rowsTop);
      context.lineTo(at, height - rowsBottom);
      context.fillText(number(tick, 9), at, height - rowsBottom + 14);
    }
    context.stroke();
    context.textAlign = 'right';
    context.fillText(unit.name, area.left - 10, height - rowsBottom + 14);
    rows.forEach((row, i) => {
      const y = rowsTop + i * rowHeight;
      context.fillStyle = colour('ink');
      context.textAlign = 'right';
      context.fillText(row.name.length > 19 ? row.name.slice(0, 18) + '…' : row.name, area.left - 10, y + rowHeight / 2);
      context.fillStyle = colour('line');
      context.fillRect(area.left, y + rowHeight - 1, area.width, 1);
      context.save();
      context.beginPath();
      context.rect(area.left, y, area.width, rowHeight);
      context.clip();
      row.draw({context, x, y: y + 4, height: rowHeight - 9, perPx: (time.to - time.from) / area.width}, time.from, time.to);
      context.restore();
    });
    if (mark.from !== null) {
      context.fillStyle = colour('mark');
      context.fillRect(x(mark.from), rowsTop, x(mark.to) - x(mark.from), height - rowsTop - rowsBottom);
    }
    if (time.cursor !== null && time.cursor >= time.from && time.cursor <= time.to) {
      context.fillStyle = colour('ink-soft');
      context.fillRect(Math.round(x(time.cursor)), rowsTop, 1, height - rowsTop - rowsBottom);
    }
  });
  const mark = steer(picture.element, time, () => ({left: left(), width: picture.box.clientWidth - left() - right}));
  time.watch(picture.redraw);
  return picture.box;
}
