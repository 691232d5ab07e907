// Stars over a photograph: those that were recognised, and those that are added or dropped by hand. A click on a circle
// drops its star or takes it back; a click beside them adds a star, by its name among the nearest of the catalogue.
import { address, ask, table_of, upload } from "./api.js";
import { command_panel, element, field, picture_place, svg } from "./parts.js";

const kNamed = 2.5;     // the faintest magnitude with a name in the picture; others have theirs under the mouse
const kOffered = 8;     // stars near a click

/// The stars of a run's table; none if it has none.
async function stars_of(run_name) {
  if (!run_name || !(await ask("files")).some(file => file.name === run_name && file.has.includes("stars.csv"))) return [];
  return (await table_of(run_name + "/stars.csv")).map(star => ({ name: star.star ?? star.name, magnitude: Number(star.magnitude), x: Number(star.x_px), y: Number(star.y_px),
    is_used: star.used === undefined || star.used === "1", is_mine: false }));
}

/// An editor of the stars in a photograph. `picture` is the element around its image; `said(option)` are the words of the
/// user for time, site and mask; time and site are else those of the run's camera; `calibrated` is called as command_panel() does.
export async function star_editor({ photo, picture, image, run_name, said, calibrated }) {
  const { naturalWidth: width, naturalHeight: height } = image, radius = Math.max(4, width / 150);
  const recognised = await stars_of(run_name), stars = [...recognised];
  const sky = recognised.length > 0 ? await ask(`sky?camera=${encodeURIComponent(run_name + "/camera.toml")}`).catch(() => null) : null;
  picture.querySelector("svg.stars")?.remove();
  const layer = svg("svg", { class: "stars", viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "Stars that were recognised or added" });
  picture.append(layer);
  const chooser = element("div", { class: "row", role: "group", "aria-label": "Add a star" }), count = element("p", { role: "status" });

  function draw() {
    layer.replaceChildren();
    for (const star of stars) {
      const circle = svg("circle", { cx: star.x, cy: star.y, r: radius, tabindex: 0, role: "button", "aria-pressed": star.is_used,
        class: `star${star.is_used ? "" : " dropped"}${star.is_mine ? " mine" : ""}` });
      const title = svg("title", {});
      title.textContent = `${star.name}${Number.isFinite(star.magnitude) ? `, magnitude ${star.magnitude}` : ""}: ${star.is_used ? "drop it" : "take it back"}`;
      const toggle = event => { event.stopPropagation(); star.is_used = !star.is_used; draw(); };
      circle.addEventListener("click", toggle);
      circle.addEventListener("keydown", event => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); toggle(event); } });
      circle.append(title);
      layer.append(circle);
      if (!star.is_mine && !(star.magnitude <= kNamed)) continue;
      const label = svg("text", { x: star.x + 1.4 * radius, y: star.y + 0.4 * radius, "font-size": 2 * radius, class: "star-name" });
      label.textContent = star.name;
      layer.append(label);
    }
    count.textContent = `${stars.filter(star => star.is_used).length} stars, ${stars.filter(star => star.is_mine).length} of them by hand, ` +
      `${stars.filter(star => !star.is_used).length} dropped. Click a star to drop it, beside it to add one.`;
    calibrate.show();
  }

  /// Asks for the name of the star at a place, the nearest of the catalogue first.
  function offer(x, y) {
    const near = (sky?.stars ?? []).map(([name, magnitude, at_x, at_y]) => ({ name, magnitude, px: Math.hypot(at_x - x, at_y - y) }))
      .sort((a, b) => a.px - b.px).slice(0, kOffered);
    const add = (written, magnitude) => {
      const name = written.trim();
      if (!name || name.includes(",")) return;  // a comma ends a cell of the table
      for (const star of stars) if (star.name === name) star.is_used = false;  // it is here, not there
      stars.push({ name, magnitude, x, y, is_used: true, is_mine: true });
      chooser.replaceChildren();
      draw();
    };
    const named = element("input", { placeholder: "Vega, alf Lyr, HIP 91262", keydown: event => { if (event.key === "Enter") add(named.value, NaN); } });
    const mark = layer.querySelector("circle.asked") ?? layer.appendChild(svg("circle", { class: "star asked", r: radius }));
    mark.setAttribute("cx", x);
    mark.setAttribute("cy", y);
    chooser.replaceChildren(
      element("span", {}, `The star at ${x.toFixed(0)}, ${y.toFixed(0)} px is`),
      ...near.map(star => element("button", { click: () => add(star.name, star.magnitude) }, `${star.name} (${star.magnitude.toFixed(1)} mag, ${star.px.toFixed(0)} px)`)),
      field("another", named), element("button", { click: () => add(named.value, NaN) }, "Add"),
      element("button", { click: () => { chooser.replaceChildren(); draw(); } }, "None"));
    (chooser.querySelector("button") ?? named).focus();
  }
  layer.addEventListener("click", event => {
    offer(...picture_place(layer, event));
  });

  const stem = photo.replace(/^.*\//, "").replace(/\.[^./]*$/, "");
  let stars_file = `${stem}_stars.csv`;
  const used = () => stars.filter(star => star.is_used);
  // A camera that another has written stays; this page's own is replaced.
  const camera = element("input", { value: `${stem}_camera.toml`, input: () => calibrate.show() }), written = new Set();
  const words = () => {
    // The time of a camera's file is the middle of the exposure already.
    const time = said("--time") ? ["--time", said("--time")] : sky?.time_utc ? ["--time", sky.time_utc, "--exposure", "0"] : [];
    const site = said("--site") || (sky && `${sky.latitude_deg},${sky.longitude_deg},${sky.altitude_m}`);
    const place = [...time, ...(site ? ["--site", site] : [])];
    // From a table where stars have been recognised; else the program recognises the others from those by hand, where the
    // mask is white.
    const by = recognised.length > 0 ? [stars_file] : used().flatMap(star => ["--star", `${star.name}=${star.x.toFixed(1)},${star.y.toFixed(1)}`]);
    const mask = recognised.length === 0 && said("--mask") ? ["--mask", said("--mask")] : [];
    return ["calibrate", ...by, "--image", photo, ...mask, ...place, "-o", camera.value, ...(written.has(camera.value) ? ["--overwrite"] : [])];
  };
  const ended = async (asked, exit_code) => {
    if (exit_code === 0 || exit_code === 5) written.add(asked[asked.indexOf("-o") + 1]);
    await calibrated(asked, exit_code);
  };
  const calibrate = command_panel("Calibrate with these stars", words, ended, async () => {
    if (recognised.length === 0) return;
    const rows = used().map(star => `${star.x.toFixed(3)},${star.y.toFixed(3)},${star.name}`);
    stars_file = (await upload(new File([["x_px,y_px,star", ...rows, ""].join("\n")], `${stem}_stars.csv`))).name;
    calibrate.show();
  });
  draw();
  return element("section", {}, element("h3", {}, "Stars"), count, chooser, field("the camera's file", camera), calibrate.panel);
}
