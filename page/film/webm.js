/** WebM files: encoded frames of VP9 in the Matroska container (RFC 9559). */

const ID = {
  header: [0x1a, 0x45, 0xdf, 0xa3], readVersion: [0x42, 0xf7], documentType: [0x42, 0x82],
  documentVersion: [0x42, 0x87], documentReadVersion: [0x42, 0x85],
  segment: [0x18, 0x53, 0x80, 0x67],
  information: [0x15, 0x49, 0xa9, 0x66], scale: [0x2a, 0xd7, 0xb1], duration: [0x44, 0x89],
  muxer: [0x4d, 0x80], writer: [0x57, 0x41],
  tracks: [0x16, 0x54, 0xae, 0x6b], track: [0xae], number: [0xd7], identity: [0x73, 0xc5],
  kind: [0x83], lacing: [0x9c], codec: [0x86], video: [0xe0], width: [0xb0], height: [0xba],
  cluster: [0x1f, 0x43, 0xb6, 0x75], time: [0xe7], block: [0xa3],
};
const MILLISECOND = 1_000_000; // ns: the unit of times
const VIDEO = 1;
const KEY = 0x80;

/**
 * Returns the parts of a file.
 *
 * @param frames `{data, isKey}` in order; the first is a key frame, and one is every few seconds
 * @param seconds that all of them last together, each as long as the others
 */
export function webm({ frames, width, height, seconds }) {
  const step = (1000 * seconds) / frames.length;
  const clusters = [];
  frames.forEach(({ data, isKey }, i) => {
    const time = Math.round(i * step);
    if (isKey) clusters.push({ begin: time, blocks: [] });
    const { begin, blocks } = clusters.at(-1);
    const since = new DataView(new ArrayBuffer(2));
    since.setInt16(0, time - begin);
    const head = [0x80 | 1, ...new Uint8Array(since.buffer), isKey ? KEY : 0];
    blocks.push(part("block", new Uint8Array(head), data));
  });
  return [
    ...part("header", number("readVersion", 1), text("documentType", "webm"),
      number("documentVersion", 4), number("documentReadVersion", 2)),
    ...part("segment",
      part("information", number("scale", MILLISECOND), real("duration", 1000 * seconds),
        text("muxer", "jointplay"), text("writer", "jointplay")),
      part("tracks", part("track", number("number", 1), number("identity", 1), number("kind", VIDEO),
        number("lacing", 0), text("codec", "V_VP9"),
        part("video", number("width", width), number("height", height)))),
      clusters.map(({ begin, blocks }) => part("cluster", number("time", begin), blocks))),
  ];
}

/** Returns an element: its id, its length in eight bytes, its content. */
function part(name, ...content) {
  const parts = content.flat(Infinity);
  const length = new DataView(new ArrayBuffer(8));
  length.setBigUint64(0, BigInt(parts.reduce((sum, one) => sum + one.byteLength, 0)));
  length.setUint8(0, 1);
  return [new Uint8Array(ID[name]), new Uint8Array(length.buffer), ...parts];
}

function number(name, value) {
  const bytes = new DataView(new ArrayBuffer(8));
  bytes.setBigUint64(0, BigInt(value));
  return part(name, new Uint8Array(bytes.buffer));
}

function real(name, value) {
  const bytes = new DataView(new ArrayBuffer(8));
  bytes.setFloat64(0, value);
  return part(name, new Uint8Array(bytes.buffer));
}

function text(name, value) {
  return part(name, new TextEncoder().encode(value));
}
