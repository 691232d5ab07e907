// The page: unpacks the scene, draws it whenever something has changed, and has its controls.
import { Flight } from "./flight.js";
import { SkyView } from "./sky_view.js";
import { decoded } from "./view_data.js";

const kMoving_ms = 33, kStill_ms = 1000;  // the resolution follows the time that a picture takes while it moves, or at rest
const kFirst = 0.2, kCoarsest = 0.1;      // shares of the full width
const kRest_ms = 300;                     // after which a picture is one at rest

const canvas = document.getElementById("view"), said = document.getElementById("said");

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (typeof value === "function") made.addEventListener(name, value);
    else made.setAttribute(name, value);
  made.append(...children);
  return made;
}

function slider(words, attributes, changed) {
  const input = element("input", { type: "range", ...attributes, input: () => changed(Number(input.value)) });
  return { input, label: element("label", {}, words, input) };
}

async function begin() {
  const view = await decoded(JSON.parse(document.getElementById("scene").textContent));
  document.title = `${view.name}: vegard`;
  const { camera } = view, flight = new Flight(camera), sky = new SkyView(canvas, view);
  canvas.style.aspectRatio = `${camera.width} / ${camera.height}`;
  canvas.style.maxHeight = "82vh";
  canvas.style.width = `min(100%, calc(82vh * ${camera.width / camera.height}))`;
  const state = { time_s: 0, stops: 0, plays: false, share: kFirst, is_dirty: true, last_moved: -1e9, frame_ms: 0, drawn: 0 };
  const changed = () => { state.is_dirty = true; state.last_moved = performance.now(); };
  flight.listen(canvas, changed);
  new ResizeObserver(changed).observe(canvas);

  const moves = view.instants > 1 || view.layers.some(layer => layer.turn_deg_s !== 0 || layer.drift_km_s.some(speed => speed !== 0));
  const length_s = view.instants > 1 ? view.step_s * (view.instants - 1) : 600;
  const time = slider("Time, s", { min: 0, max: length_s, step: "any", value: 0 }, value => { state.time_s = value; changed(); });
  const exposure = slider("Exposure, stops", { min: -5, max: 5, step: 0.1, value: 0 }, value => { state.stops = value; changed(); });
  const zoom = slider("Zoom", { min: -1, max: 4, step: 0.05, value: 0 }, value => { flight.zoom = 2 ** value; changed(); });
  const play = element("button", { click: () => {
    state.plays = !state.plays;
    play.textContent = state.plays ? "Pause" : "Let time run";
    changed();
  } }, "Let time run");
  const reset = element("button", { click: () => { flight.reset(); zoom.input.value = exposure.input.value = 0; state.stops = 0; changed(); } }, "Back to the camera");
  document.getElementById("controls").append(exposure.label, zoom.label, ...(moves ? [time.label, play] : []), reset);
  const about = document.getElementById("about");
  about.append(element("p", {}, "Drag to look around, turn the wheel to zoom. W and S fly ahead and back, A and D aside, E and Q up and down, with Shift five times as fast; the arrows turn."),
    element("p", {}, `The light is that of vegard render, in rayleighs of ${view.lines_nm.join(", ")} nm. Left out: ${view.left_out.join("; ") || "nothing"}.`));

  const size = share => [Math.max(16, Math.round(Math.min(camera.width, canvas.clientWidth * devicePixelRatio) * share))].flatMap(width =>
    [width, Math.max(16, Math.round(width * camera.height / camera.width))]);
  function draw(width, height) {
    sky.resize(width, height);
    const from = performance.now();
    sky.draw(flight, state.time_s, 2 ** state.stops);
    sky.gl.readPixels(0, 0, 1, 1, sky.gl.RGBA, sky.gl.UNSIGNED_BYTE, new Uint8Array(4));  // which waits for it
    state.frame_ms = performance.now() - from;
    ++state.drawn;
    const [east, north] = flight.place_km, azimuth = (flight.azimuth_deg % 360).toFixed(0), up = flight.altitude_km(view.radius_km);
    said.textContent = `Looking to azimuth ${azimuth}°, elevation ${flight.elevation_deg.toFixed(0)}°, from ${up.toFixed(up < 10 ? 2 : 0)} km up, ` +
      `${east.toFixed(0)} km east and ${north.toFixed(0)} km north of the camera. ${width} × ${height} pixels in ${state.frame_ms.toFixed(0)} ms.`;
  }

  let before = performance.now(), is_full = false;
  function frame(now) {
    const seconds = Math.min(0.2, (now - before) / 1000);
    before = now;
    if (flight.move(seconds, view.radius_km)) changed();
    if (state.plays) {
      state.time_s = (state.time_s + seconds) % length_s;
      time.input.value = state.time_s;
      changed();
    }
    const is_at_rest = now - state.last_moved > kRest_ms;
    if (!state.holds && (state.is_dirty || (is_at_rest && !is_full))) {
      state.is_dirty = false;
      // The first picture of all tells how fast this device is.
      const within = most_ms => Math.max(kCoarsest, Math.min(1, state.share * Math.sqrt(most_ms / Math.max(0.5, state.frame_ms))));
      const share = state.drawn === 0 ? kFirst : within(is_at_rest ? kStill_ms : kMoving_ms);
      draw(...size(share));
      // The first picture's time is that of compiling shaders too.
      is_full = is_at_rest && (share === 1 || state.frame_ms > kStill_ms / 3);
      state.share = share;
    }
    requestAnimationFrame(frame);
  }
  // For whoever looks at numbers: window.vegard.still(width, height), then kilorayleighs(line).
  window.vegard = { view, flight, state, kilorayleighs: line => sky.kilorayleighs(line), still: (width, height) => {
    state.holds = true;
    draw(width, height);
    return state.frame_ms;
  } };
  requestAnimationFrame(frame);
}

begin().catch(error => {
  said.textContent = error.message;
  said.className = "bad";
});
