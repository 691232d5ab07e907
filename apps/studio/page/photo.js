// A photograph: what its file says, its measurement with what that says meanwhile, a mask by hand, the stars that were found,
// the report.
import { address, run } from "./api.js";
import { mask_editor } from "./mask.js";
import { choice, choose, command_panel, element, field } from "./parts.js";
import { run_parts } from "./run.js";
import { star_editor } from "./stars.js";

const kShown = /\.(jpe?g|png|webp|avif)$/i;  // others a browser does not know

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
    report.replaceChildren(await run_parts(run_name));
    await edit_stars(run_name);
  }
  /// The camera that was found is taken for the next measurement.
  async function calibrated(asked, exit_code) {
    await changed();
    if (exit_code !== 0 && exit_code !== 5) return;
    choose(inputs.camera, asked[asked.indexOf("-o") + 1]);
    measure.show();
  }
  const mask = element("div");
  async function edit_mask() {
    if (image === null) return;
    await image.decode().catch(() => {});
    const editor = mask_editor({ photo: name, picture, image, others: photographs, made: async made => {
      choose(inputs.mask, made);
      inputs.mask.dispatchEvent(new Event("input", { bubbles: true }));
      await changed();
    } });
    inputs.mask.addEventListener("input", () => editor.show(kShown.test(inputs.mask.value) ? inputs.mask.value : ""));
    mask.replaceChildren(editor.panel);
  }
  const stars = element("div");
  async function edit_stars(run_name) {
    if (image === null) return;
    await image.decode().catch(() => {});
    const said = option => ({ "--time": inputs.time, "--site": inputs.site, "--mask": inputs.mask })[option].value.trim();
    stars.replaceChildren(await star_editor({ photo: name, picture, image, run_name, said, calibrated }));
  }
  edit_mask();
  const earlier = inputs.out.value;
  if (files.some(file => file.kind === "run" && file.name === earlier)) show_run(earlier);
  else edit_stars("");

  return element("article", {}, element("h2", {}, name), picture, facts, fields, measure.panel, mask, stars, report);
}
