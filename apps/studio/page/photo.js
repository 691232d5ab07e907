// A photograph: what its file says, its measurement, alone or together with others, with what that says meanwhile, a mask by hand,
// the stars that were found, the report.
import { address, run } from "./api.js";
import { mask_editor } from "./mask.js";
import { choose, command_panel, element, field } from "./parts.js";
import { run_parts } from "./run.js";
import { star_editor } from "./stars.js";
import { known_fields, known_inputs, together_fields } from "./together.js";

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

  const known = known_inputs(scenes, photographs), others = together_fields(scenes, photographs);
  const stem = file => file.replace(/\.[^./]*$/, "");
  const alone = stem(name) + "_measured";
  const inputs = {
    line: element("input", { type: "number", min: 100, max: 2000, step: "any", placeholder: "colour; else 557.7" }),
    out: element("input", { placeholder: alone }),
    map: element("input", { type: "checkbox", checked: true }),
    again: element("input", { type: "checkbox" }),
  };
  const out = () => inputs.out.value.trim() ||
    [stem(name), ...others.chosen().map(one => stem(one.photo.value).split("/").pop())].join("_") + "_measured";
  const words = () => {
    const pictures = others.chosen(), all = ["measure", name, ...pictures.map(one => one.photo.value)];
    // Each option once for every photograph or not at all; an empty word leaves it to the file.
    for (const option of Object.keys(known)) {
      const values = [known, ...pictures.map(one => one.known)].map(one => one[option].value.trim());
      if (values.some(value => value)) values.forEach(value => all.push(option, value));
    }
    if (inputs.line.value.trim()) all.push("--line", inputs.line.value.trim());
    all.push("--out", out());
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
  const fields = element("div", { input: () => { inputs.out.placeholder = out(); measure.show(); } },
    element("div", { class: "fields" }, ...known_fields(known),
      field("Wavelength of the filter, nm", inputs.line), field("Folder of the measurement", inputs.out),
      element("label", {}, element("span", {}, inputs.map, " with a map of the electrons (minutes)")),
      element("label", {}, element("span", {}, inputs.again, " replace an earlier measurement"))), others.panel);

  async function show_run(run_name) {
    report.replaceChildren(await run_parts(run_name));
    await edit_stars(run_name);
  }
  /// The camera that was found is taken for the next measurement.
  async function calibrated(asked, exit_code) {
    await changed();
    if (exit_code !== 0 && exit_code !== 5) return;
    choose(known["--camera"], asked[asked.indexOf("-o") + 1]);
    measure.show();
  }
  const mask = element("div");
  async function edit_mask() {
    if (image === null) return;
    await image.decode().catch(() => {});
    const editor = mask_editor({ photo: name, picture, image, others: photographs, made: async made => {
      choose(known["--mask"], made);
      known["--mask"].dispatchEvent(new Event("input", { bubbles: true }));
      await changed();
    } });
    known["--mask"].addEventListener("input", () => editor.show(kShown.test(known["--mask"].value) ? known["--mask"].value : ""));
    mask.replaceChildren(editor.panel);
  }
  const stars = element("div");
  async function edit_stars(run_name) {
    if (image === null) return;
    await image.decode().catch(() => {});
    const said = option => known[option].value.trim();
    stars.replaceChildren(await star_editor({ photo: name, picture, image, run_name, said, calibrated }));
  }
  edit_mask();
  if (files.some(file => file.kind === "run" && file.name === alone)) show_run(alone);
  else edit_stars("");

  return element("article", {}, element("h2", {}, name), picture, facts, fields, measure.panel, mask, stars, report);
}
