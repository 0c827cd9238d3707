/** MP4 files: encoded frames of H.264 in the ISO base media format (ISO/IEC 14496-12 and -15). */

const SECOND = 90_000; // units of a frame's duration
const MILLISECOND = 1000; // units a second of the film's
const UPRIGHT = [0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x40000000]; // matrix of the picture
const DOTS = 0x480000; // 72 an inch
const SHOWN = 3; // flags of a track that is enabled and played

/**
 * Returns the parts of a file.
 *
 * @param frames `{data, isKey}` in order
 * @param seconds that all of them last together, each as long as the others
 * @param described the decoder's configuration, as the encoder gives it
 */
export function mp4({ frames, width, height, seconds, described }) {
  const lasting = Math.round(seconds * 1000);
  const begin = box("ftyp", letters("isom"), words(0x200), letters("isomiso2avc1mp41"));
  const size = frames.reduce((sum, { data }) => sum + data.byteLength, 0);
  const table = (place) => box("moov",
    box("mvhd", words(0, 0, 0, MILLISECOND, lasting, 0x10000), halves(0x100, 0),
      words(0, 0, ...UPRIGHT, 0, 0, 0, 0, 0, 0, 2)),
    box("trak",
      box("tkhd", words(SHOWN, 0, 0, 1, 0, lasting, 0, 0), halves(0, 0, 0, 0),
        words(...UPRIGHT, width << 16, height << 16)),
      box("mdia",
        box("mdhd", words(0, 0, 0, SECOND, ends(frames.length, frames.length, seconds)), halves(0x55c4, 0)),
        box("hdlr", words(0, 0), letters("vide"), words(0, 0, 0), letters("film\0")),
        box("minf",
          box("vmhd", words(1), halves(0, 0, 0, 0)),
          box("dinf", box("dref", words(0, 1), box("url ", words(1)))),
          samples({ frames, width, height, seconds, described, place })))));
  const length = (parts) => parts.reduce((sum, one) => sum + one.byteLength, 0);
  const place = length(begin) + length(table(0)) + 8; // of the first frame in the file
  return [...begin, ...table(place), words(size + 8), letters("mdat"), ...frames.map(({ data }) => data)];
}

/** Returns the table of frames: how long, how large and where each is. */
function samples({ frames, width, height, seconds, described, place }) {
  const count = frames.length;
  const durations = frames.map((_, i) => ends(i + 1, count, seconds) - ends(i, count, seconds));
  const keys = frames.flatMap(({ isKey }, i) => (isKey ? [i + 1] : []));
  return box("stbl",
    box("stsd", words(0, 1), box("avc1",
      halves(0, 0, 0, 1, 0, 0), words(0, 0, 0), halves(width, height), words(DOTS, DOTS, 0),
      halves(1), new Uint8Array(32), halves(24, 0xffff),
      box("avcC", new Uint8Array(described)))),
    box("stts", words(0, count, ...durations.flatMap((one) => [1, one]))),
    box("stss", words(0, keys.length, ...keys)),
    box("stsc", words(0, 1, 1, count, 1)),
    box("stsz", words(0, 0, count, ...frames.map(({ data }) => data.byteLength))),
    box("stco", words(0, 1, place)));
}

/** Returns when a frame ends, of `count` that last some seconds together. */
function ends(index, count, seconds) {
  return Math.round((SECOND * seconds * index) / count);
}

function box(name, ...content) {
  const parts = content.flat(Infinity);
  const length = parts.reduce((sum, one) => sum + one.byteLength, 8);
  return [words(length), letters(name), ...parts];
}

/** Returns numbers of four bytes. */
function words(...values) {
  const bytes = new DataView(new ArrayBuffer(4 * values.length));
  values.forEach((value, i) => bytes.setUint32(4 * i, value));
  return new Uint8Array(bytes.buffer);
}

/** Returns numbers of two bytes. */
function halves(...values) {
  const bytes = new DataView(new ArrayBuffer(2 * values.length));
  values.forEach((value, i) => bytes.setUint16(2 * i, value));
  return new Uint8Array(bytes.buffer);
}

function letters(text) {
  return new TextEncoder().encode(text);
}
