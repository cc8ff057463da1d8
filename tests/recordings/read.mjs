// Reads recordings with the npm readers of MCAP and ROS 2 messages.
//   read.mjs dump FILE            a line for each number: topic, time in ns, path and bits
//   read.mjs compare FILE CSV...  every published number is the one of the trace, bit for bit; pairs of files
import {createRequire} from 'node:module';
import {open, readFile} from 'node:fs/promises';
import {pathToFileURL} from 'node:url';

// the packages lie where the build has installed them
const require = createRequire(pathToFileURL(process.env.JAROL_NODE_MODULES + '/'));
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');

const view = new DataView(new ArrayBuffer(8));
const setters = {
  bool: (v) => view.setUint8(0, v ? 1 : 0), int8: (v) => view.setInt8(0, v), uint8: (v) => view.setUint8(0, v),
  int16: (v) => view.setInt16(0, v, true), uint16: (v) => view.setUint16(0, v, true),
  int32: (v) => view.setInt32(0, v, true), uint32: (v) => view.setUint32(0, v, true),
  int64: (v) => view.setBigInt64(0, v, true), uint64: (v) => view.setBigUint64(0, v, true),
  float32: (v) => view.setFloat32(0, v, true), float64: (v) => view.setFloat64(0, v, true),
};

function bits(type, value) {
  view.setBigUint64(0, 0n, true);
  setters[type](value);
  return view.getBigUint64(0, true);
}

// Calls visit(path, type, value) for each number, and for the length of each sequence.
function walk(definitions, definition, message, prefix, visit) {
  for (const field of definition.definitions) {
    if (field.isConstant) continue;
    const path = prefix + field.name, value = message[field.name];
    const one = (at, v) => {
      if (!field.isComplex) return visit(at, field.type, v);
      walk(definitions, definitions.find((d) => d.name === field.type), v, at + '.', visit);
    };
    if (!field.isArray) {
      one(path, value);
      continue;
    }
    if (field.arrayLength === undefined) visit(path + '.length', 'uint32', value.length);
    for (let i = 0; i < value.length; ++i) one(path + '.' + i, value[i]);
  }
}

class Decoder {
  constructor(channel, schema) {
    if (schema.encoding !== 'ros2msg' || channel.messageEncoding !== 'cdr')
      throw new Error(`${channel.topic} is ${schema.encoding}, ${channel.messageEncoding}`);
    this.definitions = parse(new TextDecoder().decode(schema.data), {ros2: true});
    this.root = this.definitions.find((d) => d.name === undefined) ?? this.definitions[0];
    this.reader = new MessageReader(this.definitions);
    this.topic = channel.topic;
    this.wrapped = channel.metadata.get('wrapped') === 'yes';
  }
  walk(data, visit) {
    const message = this.reader.readMessage(data);
    if (this.reader.lastReadHadTrailingBytes()) throw new Error(`${this.topic}: bytes are left after the message`);
    walk(this.definitions, this.root, message, '', visit);
  }
}

class File {
  constructor(handle) {
    this.handle = handle;
  }
  async size() {
    return BigInt((await this.handle.stat()).size);
  }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const {bytesRead} = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    return buffer.subarray(0, bytesRead);
  }
}

const decompressHandlers = await loadDecompressHandlers();

// Every message, by the index and from the begin on as a stream: both see as many.
async function readAll(path, visit) {
  const handle = await open(path);
  let indexed = 0n, streamed = 0n, last = -1n;
  const reader = await McapIndexedReader.Initialize({readable: new File(handle), decompressHandlers});
  const decoders = new Map();
  for await (const message of reader.readMessages()) {
    if (message.logTime < last) throw new Error(`${path}: times run back`);
    last = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    if (!decoders.has(channel.id)) decoders.set(channel.id, new Decoder(channel, reader.schemasById.get(channel.schemaId)));
    visit(decoders.get(channel.id), message);
    ++indexed;
  }
  if (indexed !== reader.statistics.messageCount) throw new Error(`${path}: ${indexed} messages, not as counted`);
  let attachments = 0;
  for await (const attachment of reader.readAttachments()) attachments += attachment.data.length > 0 ? 1 : 0;
  await handle.close();
  const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
  stream.append(await readFile(path));
  for (let record; (record = stream.nextRecord());) streamed += record.type === 'Message' ? 1n : 0n;
  if (!stream.done() || streamed !== indexed) throw new Error(`${path}: ${streamed} messages as a stream, ${indexed} by index`);
  return {messages: indexed, attachments};
}

// RFC 4180 as far as a trace uses it.
function cellsOf(line) {
  const cells = [];
  for (const match of line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g))
    cells.push(match[1] !== undefined ? match[1].replaceAll('""', '"') : match[2]);
  return cells;
}

function numberOf(type, text) {
  if (type === 'int64' || type === 'uint64') return BigInt(text);
  if (type === 'bool') return text !== '0';
  return Number(text);
}

const nanoseconds = (seconds) => {
  const [whole, part = ''] = seconds.split('.');
  return BigInt(whole) * 1000000000n + BigInt(part.padEnd(9, '0'));
};

async function compare(path, csv) {
  const lines = (await readFile(csv, 'utf8')).split('\n').filter((line) => line !== '');
  const columns = new Map(cellsOf(lines[0]).map((name, i) => [name, i]));
  const rows = new Map(lines.slice(1).map((line) => cellsOf(line)).map((cells) => [nanoseconds(cells[0]), cells]));
  let published = 0;
  for (const cells of rows.values()) published += cells.slice(1).filter((cell) => cell !== '').length;
  let compared = 0;
  const {attachments} = await readAll(path, (decoder, message) => {
    if (decoder.topic.startsWith('jarol/')) return decoder.walk(message.data, () => {});
    const row = rows.get(message.logTime);
    const lists = new Map();  // the elements of each sequence, as the trace has them in one cell
    decoder.walk(message.data, (at, type, value) => {
      const field = decoder.wrapped ? at.replace(/^values?\.?/, '') : at;
      const name = decoder.topic + (field === '' ? '' : '.' + field);
      const element = name.match(/^(.*)\.(\d+|length)$/);
      if (element && lists.has(element[1]) && element[2] !== 'length') {
        check(name, type, value, lists.get(element[1])[Number(element[2])]);
        return;
      }
      const is_list = element && element[2] === 'length' && !columns.has(name);
      const column = columns.get(is_list ? element[1] : name);
      if (column === undefined) throw new Error(`${path}: the trace has no column ${name}`);
      const should = row?.[column];
      if (should === undefined || should === '') throw new Error(`${path}: nothing in the trace for ${name} at ${message.logTime}`);
      row[column] = '';  // once
      ++compared;
      if (!is_list) return check(name, type, value, should);
      const list = should.startsWith('"') ? [...JSON.parse(should)].map((c) => String(c.codePointAt(0)))
                                          : should.slice(1, -1).split(',').map((t) => t.trim()).filter((t) => t !== '');
      lists.set(element[1], list);
      if (list.length !== value) throw new Error(`${path}: ${name} at ${message.logTime} is ${value}, should be ${list.length}`);
    });
    function check(name, type, value, should) {
      if (should === undefined || bits(type, value) !== bits(type, numberOf(type, should)))
        throw new Error(`${path}: ${name} at ${message.logTime} is ${value}, should be ${should}`);
    }
  });
  if (compared !== published) throw new Error(`${path}: ${compared} numbers, and ${published} in the trace`);
  if (attachments === 0) throw new Error(`${path}: no attachment`);
  return compared;
}

const [what, ...files] = process.argv.slice(2);
if (what === 'dump') {
  await readAll(files[0], (decoder, message) => {
    decoder.walk(message.data, (path, type, value) => {
      console.log(`${decoder.topic} ${message.logTime} ${path} ${bits(type, value).toString(16)}`);
    });
  });
} else {
  let compared = 0;
  for (let i = 0; i + 1 < files.length; i += 2) compared += await compare(files[i], files[i + 1]);
  console.log(`${compared} numbers are the same`);
}
