// A mask by hand: outlines of what is left out of a photograph, dragged over it or set corner by corner, by the keyboard
// too. The mask is made by `vegard mask`, which takes the outlines as polygons.
import { address } from "./api.js";
import { choice, command_panel, element, field, picture_place, svg } from "./parts.js";

const kClick_px = 5;        // of the screen: less is a click, no drag
const kClose_px = 12;       // of the screen, from the first corner
const kMostCorners = 60;    // of an outline that was dragged

/// A line without the points that are nearer than `near_px` to the rest (Douglas and Peucker 1973,
/// doi:10.3138/FM57-6770-U75U-7727).
function simplified(points, near_px) {
  if (points.length < 3) return points;
  const [ax, ay] = points[0], [bx, by] = points.at(-1), long = Math.hypot(bx - ax, by - ay);
  const off = points.map(([x, y]) => long > 0 ? Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / long : Math.hypot(x - ax, y - ay));
  const farthest = off.indexOf(Math.max(...off));
  if (off[farthest] <= near_px) return [points[0], points.at(-1)];
  return [...simplified(points.slice(0, farthest + 1), near_px).slice(0, -1), ...simplified(points.slice(farthest), near_px)];
}

/// The corners of a dragged line, few enough for a command.
function corners_of(line) {
  let corners = line;
  for (let near_px = 0.5; near_px === 0.5 || corners.length > kMostCorners; near_px *= 1.5) corners = simplified(line, near_px);
  return corners;
}

/// An editor of the mask. `picture` is the element around the photograph's image; `others` are pictures that may be masks;
/// `made` is called with the name of a mask that was made. Returns the panel and show(mask), which lays a mask over the
/// picture; "" takes it away.
export function mask_editor({ photo, picture, image, others, made }) {
  const { naturalWidth: width, naturalHeight: height } = image;
  let outlines = [], open = [], drag = null, cross = null, is_drawing = false;

  const layer = svg("svg", { class: "mask-layer", viewBox: `0 0 ${width} ${height}`, role: "application",
    "aria-label": "Outline what is left out: arrows move the cross (Shift: by one pixel), Enter sets a corner, C closes, Backspace undoes" });
  const shown = element("img", { class: "masked", alt: "The mask: dark parts are left out", hidden: true });
  picture.append(shown, layer);
  const said = element("p", { role: "status" });

  const clamped = ([x, y]) => [Math.min(width, Math.max(0, x)), Math.min(height, Math.max(0, y))];
  const path = (points, end) => "M" + points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join("L") + end;
  /// Pixels of the picture to one of the screen.
  const scale = () => width / Math.max(1, layer.getBoundingClientRect().width);

  function draw() {
    layer.classList.toggle("drawing", is_drawing);
    layer.setAttribute("tabindex", is_drawing ? 0 : -1);
    const radius = 4 * scale();
    const line = drag && drag.length > 1 ? [...open, ...drag] : open;
    layer.replaceChildren(
      ...outlines.map(outline => svg("path", { class: "outline", d: path(outline, "Z") })),
      ...(line.length > 0 ? [svg("path", { class: "outline open", d: path(line, "") })] : []),
      ...open.map(([x, y]) => svg("circle", { class: "corner", cx: x, cy: y, r: radius })),
      ...(is_drawing && cross ? [svg("path", { class: "cross",
        d: `M${cross[0] - 3 * radius},${cross[1]}h${6 * radius}M${cross[0]},${cross[1] - 3 * radius}v${6 * radius}` })] : []));
    const parts = [`${outlines.length} ${outlines.length === 1 ? "part is" : "parts are"} outlined`];
    if (open.length > 0) parts.push(`${open.length} ${open.length === 1 ? "corner" : "corners"} of the next`);
    if (is_drawing && cross) parts.push(`the cross is at ${cross.map(Math.round).join(", ")} px`);
    said.textContent = parts.join("; ") + ".";
    undo.disabled = outlines.length === 0 && open.length === 0;
    close.disabled = open.length < 3;
    panel.show();
  }
  function add_corner(place) {
    const [x, y] = clamped(place), first = open[0], last = open.at(-1);
    if (open.length > 2 && Math.hypot(x - first[0], y - first[1]) < kClose_px * scale()) return end_outline();
    if (!last || Math.hypot(x - last[0], y - last[1]) >= 1) open.push([x, y]);
    draw();
  }
  function end_outline() {
    if (open.length > 2) {
      outlines.push(open);
      open = [];
    }
    draw();
  }
  function take_back() {
    if (open.length > 0) open.pop();
    else outlines.pop();
    draw();
  }

  layer.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    layer.setPointerCapture?.(event.pointerId);
    drag = [clamped(picture_place(layer, event))];
    cross = null;
  });
  layer.addEventListener("pointermove", event => {
    if (drag === null) return;
    const place = clamped(picture_place(layer, event)), [x, y] = drag.at(-1);
    if (Math.hypot(place[0] - x, place[1] - y) < 2 * scale()) return;
    drag.push(place);
    draw();
  });
  layer.addEventListener("pointerup", () => {
    if (drag === null) return;
    const line = drag, reach = Math.max(...line.map(([x, y]) => Math.hypot(x - line[0][0], y - line[0][1])));
    drag = null;
    if (reach < kClick_px * scale()) return add_corner(line[0]);
    open.push(...corners_of(line));
    end_outline();
  });
  layer.addEventListener("pointercancel", () => { drag = null; draw(); });
  layer.addEventListener("keydown", event => {
    const step = event.shiftKey ? 1 : width / 50;
    const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (move) {
      const [x, y] = cross ?? [width / 2, height / 2];
      cross = clamped([x + move[0], y + move[1]]);
      draw();
    } else if (event.key === "Enter" || event.key === " ") {
      add_corner(cross ??= [width / 2, height / 2]);
    } else if (event.key === "c" || event.key === "C") {
      end_outline();
    } else if (event.key === "Backspace" || (event.key === "z" && event.ctrlKey)) {
      take_back();
    } else {
      return;
    }
    event.preventDefault();
  });

  const draws = element("button", { "aria-pressed": "false", click: () => {
    is_drawing = !is_drawing;
    draws.setAttribute("aria-pressed", String(is_drawing));
    draw();
    if (is_drawing) layer.focus();
  } }, "Outline what is left out");
  const close = element("button", { click: end_outline }, "Close the outline");
  const undo = element("button", { click: take_back }, "Undo");

  // What vegard finds by itself.
  const finders = [["outside of a fisheye's circle", ["--circle", "auto"]], ["below the skyline", ["--horizon", "auto"]], ["captions", ["--text"]],
    ["stars", ["--stars"]], ["hot pixels", ["--hot"]], ["what is clipped", ["--saturated"]]]
    .map(([name, words]) => ({ name, words, box: element("input", { type: "checkbox" }) }));
  const drawn = choice(others, "none");
  const stem = photo.replace(/^.*\//, "").replace(/\.[^./]*$/, "");
  let free = `${stem}_mask.png`;
  for (let number = 2; others.includes(free); ++number) free = `${stem}_mask_${number}.png`;
  const out = element("input", { value: free }), written = new Set();  // this page's own are replaced
  const panel = command_panel("Make the mask", () => ["mask", photo,
    ...outlines.flatMap(outline => ["--polygon", ...outline.map(corner => corner.map(Math.round).join(","))]),
    ...finders.filter(finder => finder.box.checked).flatMap(finder => finder.words),
    ...(drawn.value ? ["--draw", drawn.value] : []), "-o", out.value.trim(), ...(written.has(out.value.trim()) ? ["--overwrite"] : [])],
  async (asked, exit_code) => {
    if (exit_code !== 0) return;
    const mask = asked[asked.indexOf("-o") + 1];
    written.add(mask);
    panel.show();
    await made(mask);
  });

  function show(mask) {
    shown.hidden = !mask;
    // A mask that was made again has the same name.
    if (mask) shown.src = `${address(mask)}?${Date.now()}`;
  }
  draw();
  return { show, panel: element("section", { class: "mask" }, element("h3", {}, "Mask"),
    element("p", {}, "Drag around what is no sky, or click its corners: trees, houses, the Moon. With the keyboard: arrows move a cross " +
      "(Shift: by one pixel), Enter sets a corner, C closes the outline, Backspace undoes."),
    element("div", { class: "row" }, draws, close, undo), said,
    element("div", { class: "row", role: "group", "aria-label": "Left out as well", input: panel.show }, element("span", {}, "Left out as well:"),
      ...finders.map(finder => element("label", {}, finder.box, finder.name))),
    element("div", { class: "row", input: panel.show }, field("with another mask", drawn), field("the mask's file", out)), panel.panel) };
}
