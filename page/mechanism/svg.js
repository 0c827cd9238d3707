/** Writes shapes as an SVG file. */

import { svgElement } from "../interface/element.js";

/** Returns the text of an SVG file of some elements, in a picture of `[width, height]`. */
export function svgFile(elements, [width, height], paper, title) {
  const picture = svgElement(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, width, height },
    svgElement("title", {}, title),
    svgElement("rect", { width, height, fill: paper }),
    elements,
  );
  return new XMLSerializer().serializeToString(picture);
}

/** Returns the elements of shapes (see `shapes.js`) in a frame. */
export function written(shapes, frame, colours) {
  return shapes.map((shape) => WRITERS[shape.kind](shape, frame, colours));
}

/** Returns a line of words, its left end and middle at `[x, y]`. */
export function svgWords(text, [x, y], fill) {
  return svgElement("text", {
    x, y, fill, "font-size": 13, "font-family": "sans-serif", "dominant-baseline": "middle",
  }, text);
}

const WRITERS = {
  line: ({ points, colour, width, dash, cap, alpha }, frame, colours) =>
    svgElement("polyline", {
      points: listed(points, frame), fill: "none", stroke: colours[colour], opacity: alpha,
      "stroke-width": width, "stroke-dasharray": dash?.join(" "), "stroke-linecap": cap,
      "stroke-linejoin": "round",
    }),
  polygon: ({ points, fill, stroke, width, round }, frame, colours) => [
    round && svgElement("polygon", {
      points: listed(points, frame), fill: colours[fill], stroke: colours[stroke],
      "stroke-width": round + 2 * width, "stroke-linejoin": "round",
    }),
    svgElement("polygon", {
      points: listed(points, frame), fill: colours[fill], stroke: colours[round ? fill : stroke],
      "stroke-width": round ?? width, "stroke-linejoin": "round",
    }),
  ],
  disc({ points, radius, fill, stroke, width }, frame, colours) {
    const [cx, cy] = frame.pixel(points[0]).map(rounded);
    return svgElement("circle", {
      cx, cy, r: radius, fill: colours[fill] ?? "none", stroke: colours[stroke],
      "stroke-width": width,
    });
  },
  text({ points, text, colour, italic, bold, size = 12, align = "left" }, frame, colours) {
    const [x, y] = frame.pixel(points[0]).map(rounded);
    const anchor = { left: "start", center: "middle", right: "end" }[align];
    return svgElement("text", {
      x, y, fill: colours[colour], "font-size": size, "font-family": "sans-serif",
      "font-style": italic && "italic", "font-weight": bold && 600, "text-anchor": anchor,
      "dominant-baseline": "middle",
    }, text);
  },
};

function listed(points, frame) {
  return points.map((point) => frame.pixel(point).map(rounded).join(",")).join(" ");
}

function rounded(value) {
  return Math.round(value * 100) / 100;
}
