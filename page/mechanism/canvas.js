/** Draws shapes on a canvas, sharp on any screen. */

const FONT = "system-ui, sans-serif";

/** Fits a canvas to its place on the page; returns its context, scaled to CSS pixels. */
export function prepared(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const dots = window.devicePixelRatio || 1;
  const [across, down] = [Math.round(width * dots), Math.round(height * dots)];
  if (canvas.width !== across || canvas.height !== down) {
    canvas.width = across;
    canvas.height = down;
  }
  const context = canvas.getContext("2d");
  context.setTransform(dots, 0, 0, dots, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

/** Draws shapes (see `shapes.js`) in a frame with colours by name. */
export function paint(context, shapes, frame, colours) {
  for (const shape of shapes) PAINTERS[shape.kind](context, shape, frame, colours);
}

/** Writes a line of words on a picture, its left end and middle at `[right, down]`. */
export function words(context, text, [right, down], colour) {
  context.font = `13px ${FONT}`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = colour;
  context.fillText(text, right, down);
}

const PAINTERS = {
  line(context, { points, colour, width, dash, cap, alpha }, frame, colours) {
    path(context, points, frame);
    context.globalAlpha = alpha ?? 1;
    context.setLineDash(dash ?? []);
    context.lineCap = cap ?? "butt";
    context.lineJoin = "round";
    context.lineWidth = width;
    context.strokeStyle = colours[colour];
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  },
  polygon(context, { points, fill, stroke, width, round }, frame, colours) {
    path(context, points, frame);
    context.closePath();
    context.lineJoin = "round";
    if (round) {
      context.lineWidth = round + 2 * width;
      context.strokeStyle = colours[stroke];
      context.stroke();
      context.lineWidth = round;
      context.strokeStyle = colours[fill];
      context.stroke();
    }
    context.fillStyle = colours[fill];
    context.fill();
    if (!round) outline(context, stroke, width, colours);
  },
  disc(context, { points, radius, fill, stroke, width }, frame, colours) {
    const [x, y] = frame.pixel(points[0]);
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill) {
      context.fillStyle = colours[fill];
      context.fill();
    }
    if (stroke) outline(context, stroke, width, colours);
  },
  text(context, { points, text, colour, italic, bold, size = 12, align = "left" }, frame, colours) {
    const [at, y] = frame.pixel(points[0]);
    context.font = `${italic ? "italic " : ""}${bold ? "600 " : ""}${size}px ${FONT}`;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colours.paper;
    const { canvas } = context;
    const right = canvas.width / context.getTransform().a - context.measureText(text).width - 4;
    const x = align === "left" ? Math.min(at, right) : at; // a name at the edge is not cut off
    context.strokeText(text, x, y);
    context.fillStyle = colours[colour];
    context.fillText(text, x, y);
  },
};

function outline(context, stroke, width, colours) {
  context.lineWidth = width;
  context.strokeStyle = colours[stroke];
  context.stroke();
}

function path(context, points, frame) {
  context.beginPath();
  points.forEach((point, i) => {
    const [x, y] = frame.pixel(point);
    if (i) context.lineTo(x, y);
    else context.moveTo(x, y);
  });
}
