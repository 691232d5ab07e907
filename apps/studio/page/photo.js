// A photograph: what its file says, its measurement with what that says meanwhile, the stars that were found, the report.
import { address, ask, run } from "./api.js";
import { choice, command_panel, element, field, report_frame } from "./parts.js";

const kNamed = 2.5;  // the faintest magnitude with a name in the picture; others have theirs under the mouse
const kShown = /\.(jpe?g|png|webp|avif)$/i;  // others a browser does not know

/// The rows of a table in CSV, by their column names.
function table(text) {
  const [head, ...rows] = text.trim().split(/\r?\n/).filter(line => !line.startsWith("#")).map(line => line.split(","));
  return rows.map(row => Object.fromEntries(head.map((name, i) => [name, row[i]])));
}

/// Circles about the stars of a calibration, with their names.
async function star_layer(run_name, width, height) {
  if (!(await ask("files")).some(file => file.name === run_name && file.has_stars)) return null;
  const answer = await fetch(address(run_name + "/stars.csv"));
  const kSvg = "http://www.w3.org/2000/svg";
  const layer = document.createElementNS(kSvg, "svg");
  layer.setAttribute("viewBox", `0 0 ${width} ${height}`);
  layer.setAttribute("role", "img");
  layer.setAttribute("aria-label", "Stars that were recognised");
  for (const star of table(await answer.text())) {
    const name = star.star ?? star.name, radius = width / 150;
    const circle = document.createElementNS(kSvg, "circle");
    for (const [key, value] of [["cx", star.x_px], ["cy", star.y_px], ["r", radius], ["class", "star"]]) circle.setAttribute(key, value);
    const title = document.createElementNS(kSvg, "title");
    title.textContent = `${name}, magnitude ${star.magnitude}`;
    circle.append(title);
    layer.append(circle);
    if (Number(star.magnitude) > kNamed) continue;
    const label = document.createElementNS(kSvg, "text");
    for (const [key, value] of [["x", Number(star.x_px) + 1.4 * radius], ["y", Number(star.y_px) + 0.4 * radius], ["font-size", 2 * radius], ["class", "star-name"]])
      label.setAttribute(key, value);
    label.textContent = name;
    layer.append(label);
  }
  return layer;
}

export function photo_view(name, files, changed) {
  const scenes = files.filter(file => file.kind === "scene").map(file => file.name);
  const photographs = files.filter(file => file.kind === "photograph" && file.name !== name).map(file => file.name);
  const picture = element("div", { class: "picture" });
  const image = kShown.test(name) ? element("img", { src: address(name), alt: "The photograph" }) : null;
  picture.append(image ?? element("p", {}, "A browser does not show this format; the report does."));
  const facts = element("pre", { "aria-label": "What the file says of itself" }, "…");
  run(["describe", name], { on_said: text => { facts.textContent = (facts.textContent === "…" ? "" : facts.textContent) + text; } })
    .catch(error => { facts.textContent = error.message; });

  const inputs = {
    time: element("input", { placeholder: "of the file; else 2014-02-21T19:30:40Z" }),
    site: element("input", { placeholder: "of the file; else latitude,longitude,metres" }),
    camera: choice(scenes, "by the stars or the skyline"),
    mask: choice(photographs, "found by itself"),
    line: element("input", { type: "number", min: 100, max: 2000, step: "any", placeholder: "colour; else 557.7" }),
    out: element("input", { value: name.replace(/\.[^./]*$/, "") + "_measured" }),
    map: element("input", { type: "checkbox", checked: true }),
    again: element("input", { type: "checkbox" }),
  };
  const words = () => {
    const all = ["measure", name];
    for (const [option, input] of [["--time", inputs.time], ["--site", inputs.site], ["--camera", inputs.camera],
      ["--mask", inputs.mask], ["--line", inputs.line], ["--out", inputs.out]])
      if (input.value.trim()) all.push(option, input.value.trim());
    if (!inputs.map.checked) all.push("--no-map");
    if (inputs.again.checked) all.push("--overwrite");
    return all;
  };
  const report = element("div");
  const measure = command_panel("Measure", words, async (asked, exit_code) => {
    const found = asked[asked.indexOf("--out") + 1];
    if (exit_code === 0 || exit_code === 5) await show_run(found);
    await changed();
  });
  const fields = element("div", { class: "fields", input: measure.show },
    field("Time (UTC or with a zone)", inputs.time), field("Place of the camera", inputs.site),
    field("Camera, if it is known", inputs.camera), field("Mask: white is sky", inputs.mask),
    field("Wavelength of the filter, nm", inputs.line), field("Folder of the measurement", inputs.out),
    element("label", {}, element("span", {}, inputs.map, " with a map of the electrons (minutes)")),
    element("label", {}, element("span", {}, inputs.again, " replace an earlier measurement")));

  async function show_run(run_name) {
    report.replaceChildren(report_frame(address(run_name + "/report.html")));
    picture.querySelector("svg")?.remove();
    if (image === null) return;
    await image.decode().catch(() => {});
    const layer = await star_layer(run_name, image.naturalWidth, image.naturalHeight);
    if (layer !== null) picture.append(layer);
  }
  const earlier = inputs.out.value;
  if (files.some(file => file.kind === "run" && file.name === earlier)) show_run(earlier);

  return element("article", {}, element("h2", {}, name), picture, facts, fields, measure.panel, report);
}
