// The graph drawn where jarol has laid it out, as on the page of the console and by jarol graph --svg.
import {svg} from './base.js';

const textHeight = 13;

const curveText = (curve) => curve.map(([x, y], i) => `${i === 0 ? 'M' : i === 1 ? 'C' : ' '}${x.toFixed(1)},${y.toFixed(1)}`).join('');

export function drawGraph(drawing, name) {
  if (drawing.nodes.length === 0) return null;
  const [x, y, width, height] = drawing.core;
  const arrow = svg('marker', {id: 'arrow', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto'},
    svg('path', {d: 'M0,0 L8,4 L0,8 z', class: 'arrow'}));
  const arrows = drawing.arrows.filter(({curve}) => curve.length > 0).map(({curve, connections, text}) =>
    svg('path', {d: curveText(curve), class: 'edge' + (connections.length === 0 ? ' outside' : ''), 'marker-end': 'url(#arrow)'}, svg('title', {}, text)));
  const boxes = drawing.nodes.map((node) => {
    const [left, top] = [node.x - node.width / 2, node.y - node.height / 2];
    return svg('g', {class: 'node ' + node.kind + (node.lines.some((line) => line.startsWith('LET ')) ? ' let' : '')},
      svg('title', {}, [node.name, ...node.lines].join(', ')),
      svg('rect', {x: left, y: top, width: node.width, height: node.height, rx: node.kind === 'task' ? 7 : 2}),
      [node.name, ...node.lines].map((line, i) =>
        svg('text', {x: node.x, y: top + 18 + i * textHeight, class: i === 0 ? 'title' : 'small'}, line)));
  });
  const drawn = svg('svg', {viewBox: `0 0 ${drawing.width} ${drawing.height}`, width: drawing.width, height: drawing.height, class: 'graph', role: 'img',
    'aria-label': `the graph ${name}: ` + drawing.arrows.filter(({connections}) => connections.length > 0).map(({text}) => text.replaceAll('\n', '; ')).join('; ')},
    svg('defs', {}, arrow), svg('rect', {x, y, width, height, rx: 10, class: 'core'}), arrows, boxes);
  // what is smaller nobody reads; it is scrolled
  drawn.style.minWidth = Math.round(drawing.width * 0.8) + 'px';
  return drawn;
}
