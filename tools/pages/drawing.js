// The graph drawn in layers, from what comes in to what goes out: each node stands right of those that feed it.
import {svg} from './base.js';

const nodeWidth = 138, nodeHeight = 52, gapX = 50, gapY = 18, room = 14;

/** Layer of each node; connections that close a circle do not count. */
export function layersOf(nodes, edges) {
  const next = new Map(nodes.map((node) => [node.id, []]));
  for (const edge of edges) next.get(edge.from)?.push(edge.to);
  const back = new Set(), state = new Map();
  const visit = (id) => {
    state.set(id, 1);
    for (const to of next.get(id)) {
      if (state.get(to) === 1) back.add(id + '\n' + to);
      else if (!state.has(to)) visit(to);
    }
    state.set(id, 2);
  };
  const fed = new Set(edges.map((edge) => edge.to));
  for (const {id} of nodes) if (!fed.has(id)) visit(id);
  for (const {id} of nodes) if (!state.has(id)) visit(id);
  const layer = new Map(nodes.map((node) => [node.id, 0]));
  for (let round = 0; round < nodes.length; ++round) {
    let moved = false;
    for (const {from, to} of edges) {
      if (back.has(from + '\n' + to) || !layer.has(from) || !layer.has(to) || layer.get(to) > layer.get(from)) continue;
      layer.set(to, layer.get(from) + 1);
      moved = true;
    }
    if (!moved) break;
  }
  return layer;
}

// Each near the middle of its neighbours, so that few arrows cross.
function order(columns, edges) {
  const place = new Map();
  const number = () => columns.forEach((column) => column.forEach((node, i) => place.set(node.id, i - column.length / 2)));
  number();
  for (let round = 0; round < 8; ++round) {
    for (const column of round % 2 ? [...columns].reverse() : columns) {
      const middle = new Map(column.map((node) => {
        const near = edges.flatMap((e) => e.from === node.id ? [e.to] : e.to === node.id ? [e.from] : []).map((id) => place.get(id));
        return [node.id, near.length ? near.reduce((a, b) => a + b) / near.length : place.get(node.id)];
      }));
      column.sort((a, b) => middle.get(a.id) - middle.get(b.id));
      number();
    }
  }
}

// A connection across several layers goes through a place of its own in each, so that it passes no node.
function bent(edges, layer) {
  const bends = [], pieces = [];
  edges.forEach((edge, i) => {
    const ids = [];
    for (let l = layer.get(edge.from) + 1; l < layer.get(edge.to); ++l) {
      const id = `bend ${i} ${l}`;
      layer.set(id, l);
      bends.push({id, bend: true});
      ids.push(id);
    }
    edge.bends = ids;
    [edge.from, ...ids].forEach((id, k) => pieces.push({from: id, to: ids[k] ?? edge.to}));
  });
  return {bends, pieces};
}

/** Outside systems stand at the left for what they give, and once more at the right for what they get. */
function split({nodes, edges}) {
  const worlds = new Map(nodes.filter((node) => node.kind === 'world').map((node) => [node.id, node]));
  const core = nodes.filter((node) => node.kind !== 'world'), ends = new Map();
  const made = edges.map((edge) => {
    const from = worlds.get(edge.from), to = worlds.get(edge.to);
    if (from) ends.set(edge.from + ' <', {...from, id: edge.from + ' <', side: 'from'});
    if (to) ends.set(edge.to + ' >', {...to, id: edge.to + ' >', side: 'to'});
    return {...edge, from: from ? edge.from + ' <' : edge.from, to: to ? edge.to + ' >' : edge.to};
  });
  return {nodes: [...ends.values(), ...core], edges: made};
}

export function drawGraph(drawing, name) {
  const {nodes, edges} = split(drawing);
  if (nodes.length === 0) return null;
  const layer = layersOf(nodes, edges);
  const last = Math.max(...layer.values());
  for (const node of nodes) {
    if (node.side === 'to' || (node.kind === 'out' && last > 0)) layer.set(node.id, Math.max(layer.get(node.id), node.side ? last : last - 1));
  }
  const {bends, pieces} = bent(edges, layer);
  const columns = Array.from({length: last + 1}, (_, i) => [...nodes, ...bends].filter((node) => layer.get(node.id) === i));
  order(columns, pieces);
  const heightOf = (node) => node.bend ? 10 : nodeHeight;
  const tall = columns.map((column) => column.reduce((sum, node) => sum + heightOf(node) + gapY, -gapY));
  const height = Math.max(...tall) + 2 * room, width = (last + 1) * (nodeWidth + gapX) - gapX + 2 * room;
  const place = new Map();
  columns.forEach((column, i) => {
    let y = (height - tall[i]) / 2;
    for (const node of column) {
      place.set(node.id, {x: room + i * (nodeWidth + gapX), y, middle: y + heightOf(node) / 2, layer: i});
      y += heightOf(node) + gapY;
    }
  });
  const arrow = svg('marker', {id: 'arrow', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto'},
    svg('path', {d: 'M0,0 L8,4 L0,8 z', class: 'arrow'}));
  const drawn = edges.map((edge) => {
    const a = place.get(edge.from), b = place.get(edge.to);
    let x = a.x + nodeWidth, y = a.middle, path = `M${x},${y}`;
    if (b.layer <= a.layer) path += ` C${x + 60},${height} ${b.x - 60},${height} ${b.x},${b.middle}`;
    else for (const id of [...(edge.bends ?? []), edge.to]) {
      const {x: x2, middle: y2} = place.get(id), half = (x2 - x) / 2;
      path += ` C${x + half},${y} ${x2 - half},${y2} ${x2},${y2}`;
      if (id !== edge.to) path += ` L${x2 + nodeWidth},${y2}`;
      [x, y] = [x2 + nodeWidth, y2];
    }
    return svg('path', {d: path, class: 'edge' + (edge.outside ? ' outside' : ''), 'marker-end': 'url(#arrow)'}, svg('title', {}, edge.label));
  });
  const boxes = nodes.map((node) => {
    const {x, y} = place.get(node.id);
    const lines = [node.name, node.type, node.let ? `${node.timing}, LET ${node.let}` : node.timing].filter(Boolean);
    const middle = y + nodeHeight / 2 - (lines.length - 1) * 7.5;
    return svg('g', {class: 'node ' + node.kind + (node.let ? ' let' : '')},
      svg('title', {}, lines.join(', ')),
      svg('rect', {x, y, width: nodeWidth, height: nodeHeight, rx: node.kind === 'task' ? 9 : 2}),
      lines.map((line, i) => svg('text', {x: x + nodeWidth / 2, y: middle + i * 15 + 4, class: i === 0 ? 'title' : 'small'},
        line.length > 21 ? line.slice(0, 20) + '…' : line)));
  });
  const drawnGraph = svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, class: 'graph', role: 'img', 'aria-label': `the graph ${name}: ` +
    drawing.edges.map((e) => e.outside ? '' : e.label).filter(Boolean).join('; ')}, svg('defs', {}, arrow), drawn, boxes);
  // what is smaller nobody reads; it is scrolled
  drawnGraph.style.minWidth = Math.round(width * 0.8) + 'px';
  return drawnGraph;
}
