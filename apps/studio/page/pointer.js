// A layer of a picture or map on which a place is pointed at, by the mouse or by the keyboard's arrows, and on which marks
// and lines are drawn. Places are in the layer's own units.
import { picture_place, svg } from "./parts.js";

const kApart_px = 16;  // of words

/// An element of SVG with words.
export function labelled(tag, attributes, words) {
  const made = svg(tag, attributes);
  made.textContent = words;
  return made;
}

/// `layer` is an SVG whose view is the box { x, y, width, height }. `pointed(place, is_chosen)` is called as the mouse or
/// the arrows move, and with is_chosen for a click or Enter; `left()` for Escape. Returns the drawing functions.
export function pointer(layer, box, { pointed, left }) {
  const line = svg("g", { class: "sight" }), mark = svg("path", { class: "cross" });
  layer.append(line, mark);
  layer.setAttribute("tabindex", 0);
  layer.setAttribute("viewBox", `${box.x} ${box.y} ${box.width} ${box.height}`);
  let at = null, drawn = [];
  // Sizes in pixels of the screen, whatever the layer's size is.
  const unit = () => box.width / Math.max(1, layer.getBoundingClientRect().width);
  const resized = new ResizeObserver(() => { layer.style.setProperty("--px", `${unit()}px`); draw_mark(); draw_line(); });
  resized.observe(layer);

  function draw_mark() {
    const arm = 9 * unit();
    mark.setAttribute("d", at === null ? "" : `M${at[0] - arm},${at[1]}h${2 * arm}M${at[0]},${at[1] - arm}v${2 * arm}`);
  }
  function draw_line() {
    // Words that would lie over others are in the dots' titles alone.
    const dots = drawn.filter(point => point?.label), near = kApart_px * unit();
    const apart = (a, b) => Math.hypot(a.place[0] - b.place[0], a.place[1] - b.place[1]);
    const worded = dots.reduce((kept, dot) => kept.every(other => apart(dot, other) > near) ? [...kept, dot] : kept, []);
    line.replaceChildren(svg("path", { d: path_of(drawn.map(point => point?.place ?? null)) }),
      ...dots.map(({ place: [x, y], label }) => svg("circle", { cx: x, cy: y }, labelled("title", {}, label))),
      ...worded.map(({ place: [x, y], label }) => labelled("text", { x, y }, label)));
  }
  /// Marked at once; what else there is to tell may take its time.
  function point(place, is_chosen) {
    at = place;
    draw_mark();
    pointed(place, is_chosen);
  }
  layer.addEventListener("pointermove", event => point(picture_place(layer, event), false));
  layer.addEventListener("click", event => point(picture_place(layer, event), true));
  layer.addEventListener("keydown", event => {
    const step = box.width / (event.shiftKey ? 500 : 50), [x, y] = at ?? [box.x + box.width / 2, box.y + box.height / 2];
    const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (move) point([Math.min(box.x + box.width, Math.max(box.x, x + move[0])), Math.min(box.y + box.height, Math.max(box.y, y + move[1]))], false);
    else if (event.key === "Enter" || event.key === " ") point([x, y], true);
    else if (event.key === "Escape") left();
    else return;
    event.preventDefault();
  });

  return {
    /// Marks a place; null: none.
    mark(place) {
      at = place;
      draw_mark();
    },
    /// A line through points, each null or { place, label }; those with a label get a dot and their words.
    line(points) {
      drawn = points;
      draw_line();
    },
  };
}

/// The path of a line through places; one that is null interrupts it.
export function path_of(places) {
  let path = "", is_begun = false;
  for (const place of places) {
    if (place !== null) path += `${is_begun ? "L" : "M"}${place[0].toFixed(2)},${place[1].toFixed(2)}`;
    is_begun = place !== null;
  }
  return path;
}
