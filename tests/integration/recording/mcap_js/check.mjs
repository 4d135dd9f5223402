// Reads recordings with the MCAP format's own library and compares every message with what bleedsim's reader gave.
//   node check.mjs FOLDER
// FOLDER holds NAME.mcap and NAME.json (see make_files.cpp). Run where the packages of package.json are installed.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { crc32 } from "@foxglove/crc";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers, protobufFromBinaryDescriptor } from "@mcap/support";

const POINTS = "/bleed/v1/points";
const FRAMES = "/bleed/v1/frame";

/** The file as @mcap/core wants to read it. */
function readable(bytes) {
  return {
    size: async () => BigInt(bytes.byteLength),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  };
}

/** Message types by schema id, made of the descriptors in the file and nothing else. */
function messageTypes(reader) {
  const types = new Map();
  for (const schema of reader.schemasById.values()) {
    assert.equal(schema.encoding, "protobuf");
    const type = protobufFromBinaryDescriptor(schema.data).lookupType(schema.name);
    type.root.resolveAll();
    types.set(schema.id, type);
  }
  return types;
}

/** A name as protobuf's JSON has it, without regard to the style. */
const plain = (name) => name.replaceAll("_", "").toLowerCase();

/** Compares a decoded message with protobuf JSON, field by field; `path` names the field. */
function compare(ours, type, theirs, path) {
  const expected = new Map(Object.entries(ours).map(([name, value]) => [plain(name), value]));
  for (const field of type.fieldsArray) {
    const value = theirs[field.name];
    const other = expected.get(plain(field.name));
    const here = `${path}.${field.name}`;
    expected.delete(plain(field.name));
    if (other === undefined) {
      assert.ok(!Object.hasOwn(theirs, field.name), `${here} is not in ours`);
    } else if (field.repeated) {
      assert.equal(value.length, other.length, here);
      value.forEach((entry, i) => compareValue(other[i], field, entry, `${here}[${i}]`));
    } else {
      compareValue(other, field, value, here);
    }
  }
  assert.deepEqual([...expected.keys()], [], `${path} lacks fields`);
}

function compareValue(ours, field, theirs, path) {
  if (field.resolvedType?.fieldsArray) return compare(ours, field.resolvedType, theirs, path);
  if (field.resolvedType) return assert.equal(field.resolvedType.valuesById[theirs] ?? theirs, ours, path);
  if (field.type === "bytes") return assert.equal(Buffer.from(theirs).toString("base64"), ours, path);
  if (field.type === "float") return assert.equal(Math.fround(theirs), Math.fround(ours), path);
  if (typeof theirs === "object") return assert.equal(theirs.toString(), ours, path);
  return assert.equal(theirs, ours, path);
}

/** The values of one attribute of a frame, decoded as idl/recording.proto says. */
function attribute(frame, semantic) {
  const payload = new DataView(frame.payload.buffer, frame.payload.byteOffset, frame.payload.byteLength);
  let at = 0;
  for (const block of frame.attributes) {
    const kind = block.scalarType ?? block.scalar_type;
    const bytes = kind === 2 ? 2 : 4;
    const count = frame.count * block.components;
    if (block.semantic === semantic) {
      const take = [
        (i) => payload.getFloat32(at + 4 * i, true),
        (i) => payload.getUint32(at + 4 * i, true),
        (i) => Math.fround(block.offset + Math.fround(block.scale * payload.getUint16(at + 2 * i, true))),
      ];
      return Array.from({ length: count }, (_, i) => take[kind](i));
    }
    at += count * bytes;
  }
  throw new Error(`no attribute ${semantic}`);
}

/** Numbers of 4 bytes out of our JSON. */
function numbers(Kind, base64) {
  const bytes = Buffer.from(base64, "base64");
  return new Kind(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

/** The frame as decoded here against what bleedsim's reader made of it. */
function compareFrame(frame, ours) {
  assert.deepEqual(Float32Array.from(attribute(frame, 0)), numbers(Float32Array, ours.positions));
  assert.deepEqual(Uint32Array.from(attribute(frame, 1)), numbers(Uint32Array, ours.ids));
}

/** The points of a cloud against the frame that they belong to; `error` is what 16 bits may cost. */
function comparePoints(cloud, ours, error) {
  const stride = cloud.pointStride ?? cloud.point_stride;
  assert.deepEqual(
    cloud.fields.slice(0, 4).map((field) => [field.name, field.offset, field.type]),
    [["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["id", 12, 5]],
  );
  assert.equal(cloud.frameId ?? cloud.frame_id, "theatre");
  const data = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const positions = numbers(Float32Array, ours.positions);
  const ids = numbers(Uint32Array, ours.ids);
  assert.equal(cloud.data.byteLength, stride * ids.length);
  ids.forEach((id, i) => {
    assert.equal(data.getUint32(i * stride + 12, true), id);
    for (let axis = 0; axis < 3; axis++) {
      const difference = Math.abs(data.getFloat32(i * stride + 4 * axis, true) - positions[3 * i + axis]);
      assert.ok(difference <= error, `point ${i} is off by ${difference}`);
    }
  });
}

/** Every chunk, read from the start without the index: chunk checksums. */
function readAsStream(bytes, decompressHandlers) {
  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true, includeChunks: true });
  stream.append(bytes);
  const counts = { messages: 0, chunks: 0, compressions: new Set() };
  for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
    if (record.type === "Message") counts.messages++;
    if (record.type !== "Chunk") continue;
    counts.chunks++;
    counts.compressions.add(record.compression);
    assert.notEqual(record.uncompressedCrc, 0);
  }
  assert.ok(stream.done());
  return counts;
}

async function check(folder, name, decompressHandlers) {
  const bytes = new Uint8Array(readFileSync(join(folder, `${name}.mcap`)));
  const expected = JSON.parse(readFileSync(join(folder, `${name}.json`), "utf8"));
  const reader = await McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });
  assert.notEqual(reader.footer.summaryCrc, 0);
  assert.equal(crc32(bytes.subarray(0, Number(reader.dataEndOffset))), reader.dataSectionCrc);

  const streamed = readAsStream(bytes, decompressHandlers);
  assert.deepEqual([...streamed.compressions], [expected.compression]);
  assert.equal(Number(reader.statistics.chunkCount), streamed.chunks);
  assert.equal(Number(reader.statistics.messageCount), streamed.messages);
  assert.ok(streamed.chunks > 0);

  const types = messageTypes(reader);
  const left = [...expected.messages];
  let frames = 0;
  let points = 0;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    assert.equal(channel.messageEncoding, "protobuf");
    const type = types.get(channel.schemaId);
    const decoded = type.toObject(type.decode(message.data), { defaults: true });
    if (channel.topic === POINTS) {
      comparePoints(decoded, expected.frames[points++], expected.max_position_error);
      continue;
    }
    const ours = left.shift();
    assert.equal(channel.topic, ours.topic);
    assert.equal(String(message.logTime), ours.log_time_ns);
    compare(ours.message, type, type.decode(message.data), `${name}: ${channel.topic}`);
    if (channel.topic === FRAMES) compareFrame(decoded, expected.frames[frames++]);
  }
  assert.equal(left.length, 0, "messages are missing");
  assert.equal(points, expected.points);
  for (const [topic, count] of Object.entries(expected.index)) {
    let found = 0;
    for await (const message of reader.readMessages({ topics: [topic] })) found += message.data.byteLength > 0 ? 1 : 0;
    assert.equal(found, count, `${topic} by the index`);
  }
  console.log(`${name}: ${streamed.messages} messages in ${streamed.chunks} chunks, ${points} clouds`);
}

const folder = process.argv[2];
const handlers = await loadDecompressHandlers();
const names = readdirSync(folder).filter((file) => file.endsWith(".mcap")).map((file) => file.slice(0, -5)).sort();
assert.ok(names.length > 0, `there are no recordings in ${folder}`);
for (const name of names) await check(folder, name, handlers);
