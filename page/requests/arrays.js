/** Columns of numbers as the service stores them: NumPy's archive, a third of the bytes of JSON. */

import { getBytes, withQuery } from "./service.js";

const END_OF_ARCHIVE = 0x06054b50;
const END_LENGTH = 22; // bytes, without a comment

/**
 * Returns what a GET answers: `{columns: {name: Float64Array}, units: {name: unit}, complete}`.
 *
 * Members of the archive are stored, not compressed (`numpy.savez`).
 */
export async function getArrays(path, query, signal) {
  const archive = await getBytes(withQuery(path, query), "application/x-npz", signal);
  const found = { columns: {}, units: {}, complete: true };
  for (const { name, start } of members(new DataView(archive))) {
    const { type, data } = array(archive, start);
    if (type === "<f8") found.columns[name] = new Float64Array(data);
    else if (type === "|b1") found.complete = new Uint8Array(data)[0] === 1;
    else if (type.startsWith("<U")) found.units = pairs(data, Number(type.slice(2)));
  }
  return found;
}

/** Yields name and place of each member, from the directory at the end of the archive. */
function* members(view) {
  const end = view.byteLength - END_LENGTH;
  if (end < 0 || view.getUint32(end, true) !== END_OF_ARCHIVE) throw new Error("No archive came.");
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; left--) {
    const [nameLength, extra, comment] = [28, 30, 32].map((one) => view.getUint16(at + one, true));
    const name = new TextDecoder().decode(new Uint8Array(view.buffer, at + 46, nameLength));
    const local = view.getUint32(at + 42, true);
    const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    yield { name: name.replace(/\.npy$/, ""), start };
    at += 46 + nameLength + extra + comment;
  }
}

/** Reads one array (numpy.lib.format, version 1): its type, and its numbers as bytes. */
function array(archive, start) {
  const length = new DataView(archive).getUint16(start + 8, true);
  const header = new TextDecoder().decode(new Uint8Array(archive, start + 10, length));
  const type = /'descr': '(.*?)'/.exec(header)[1];
  const shape = /'shape': \((.*?)\)/.exec(header)[1].split(",").filter((one) => one.trim());
  const width = Number(type.slice(2)) * (type[1] === "U" ? 4 : 1);
  const count = shape.reduce((product, one) => product * Number(one), 1);
  const begin = start + 10 + length;
  return { type, data: archive.slice(begin, begin + count * width) };
}

/** Returns rows of two texts of a fixed width, as an object. */
function pairs(data, width) {
  const letters = new Uint32Array(data);
  const texts = [];
  for (let at = 0; at < letters.length; at += width) {
    const text = letters.subarray(at, at + width);
    texts.push(String.fromCodePoint(...text.filter(Boolean)));
  }
  return Object.fromEntries(texts.flatMap((text, i) => (i % 2 ? [] : [[text, texts[i + 1]]])));
}
