// A scene: its parameters as sliders, its picture as they move, a photograph beside it, saving and fitting.
import { address, command_line, run, tell } from "./api.js";
import { live_panel } from "./live.js";
import { choice, command_panel, element, field } from "./parts.js";

const kRest_ms = 700;     // after which the picture is made in full
const kCoarse = "360x240";

/// The ends of "0.1 to 20"; null where a parameter is not a number between two.
function ends_of(limits) {
  const found = /^(-?[\d.e+]+(?:e-?\d+)?) to (-?[\d.e+]+(?:e-?\d+)?)$/i.exec(limits);
  return found ? [Number(found[1]), Number(found[2])] : null;
}

/// Between the ends by equal ratios where they span more than three decades above 0; about the value where they span
/// much more than it.
function slider_scale([low, high], value) {
  if (low > 0 && high / low > 1000) {
    const from = Math.max(low, value > 0 ? value / 30 : low), to = Math.min(high, value > 0 ? value * 30 : high);
    return { at: t => from * (to / from) ** t, of: v => Math.log(v / from) / Math.log(to / from) };
  }
  const reach = Math.max(5 * Math.abs(value), 1);
  const from = Math.max(low, high - low > 20 * reach ? value - reach : low), to = Math.min(high, high - low > 20 * reach ? value + reach : high);
  return { at: t => from + t * (to - from), of: v => (v - from) / (to - from) };
}

export async function scene_view(name, files, changed) {
  const photographs = files.filter(file => file.kind === "photograph").map(file => file.name);
  const { output, exit_code } = await run(["params", name, "--json"]);
  if (exit_code !== 0) throw new Error(`${name} is no scene that can be read: vegard params ${name}`);
  const parameters = JSON.parse(output).parameters;
  const first = new Map(parameters.map(parameter => [parameter.path, parameter.value]));
  let changes = new Map();
  const before = [];  // for undo
  const changed_words = () => [...changes].flatMap(([path, value]) => ["--set", `${path}=${value}`]);

  // The picture: coarse at once, in full at rest. Of what was asked for meanwhile only the last counts.
  const image = element("img", { alt: "The scene's picture" });
  const wiped = element("img", { class: "wiped", alt: "The photograph", hidden: true });
  const status = element("p", { role: "status" });
  const shown = element("code", { class: "command", "aria-label": "The command that makes this picture" });
  let wanted = 0, resting = null, at_work = false;
  const coarse_words = () => ["preview", name, ...changed_words(), "--frames", "1", "--turn", "0", "--size", kCoarse];
  const full_words = () => ["render", name, ...changed_words()];
  async function draw(words) {
    if (at_work) return;
    at_work = true;
    const number = wanted, from = performance.now();
    let said = "";
    try {
      const end = await run(words, { shown: true, on_said: text => { said += text; } });
      if (end.exit_code === 0) {
        image.src = `picture/${end.job}`;
        await image.decode().catch(() => {});
        status.textContent = `Drawn in ${((performance.now() - from) / 1000).toFixed(1)} s.`;
        status.className = "";
      } else {
        status.textContent = said.trim();
        status.className = "bad";
      }
    } catch (error) {
      status.textContent = error.message;
      status.className = "bad";
    }
    at_work = false;
    if (number !== wanted) draw(coarse_words());
  }
  function update() {
    ++wanted;
    shown.textContent = command_line([...full_words(), "-o", "picture.png"]);
    draw(coarse_words());
    clearTimeout(resting);
    resting = setTimeout(async function full() {
      if (at_work) resting = setTimeout(full, 100);
      else draw(full_words());
    }, kRest_ms);
    fit.show();
    live.show();
  }
  function set(path, value) {
    if ((changes.get(path) ?? first.get(path)) === value) return;
    before.push(new Map(changes));
    if (value === first.get(path)) changes.delete(path);
    else changes.set(path, value);
    update();
  }

  // Parameters.
  const list = element("div", { class: "parameters" });
  const search = element("input", { type: "search", placeholder: "energy, camera, sheet …", input: show_list });
  function row(parameter) {
    const value = changes.get(parameter.path) ?? parameter.value;
    const ends = ends_of(parameter.limits), number = Number(value);
    const is_number = ends !== null && value !== "" && Number.isFinite(number);
    const id = `p-${parameter.path}`;
    const scale = is_number ? slider_scale(ends, number) : null;
    const box = element("input", { id, value, change: () => { set(parameter.path, box.value); show_list(); } });
    const slider = scale && element("input", { type: "range", min: 0, max: 1, step: 0.001, value: scale.of(number), "aria-label": parameter.path,
      input: () => { box.value = String(Number(scale.at(Number(slider.value)).toPrecision(4))); set(parameter.path, box.value); } });
    return element("div", { class: changes.has(parameter.path) ? "parameter changed" : "parameter" },
      element("label", { for: id }, parameter.path + (parameter.unit ? ` (${parameter.unit})` : "")), box, slider,
      element("span", { class: "meaning" }, `${parameter.meaning}${parameter.limits ? "; " + parameter.limits : ""}`));
  }
  function show_list() {
    const asked = search.value.trim().toLowerCase();
    const found = parameters.filter(parameter => asked ? (parameter.path + " " + parameter.meaning).toLowerCase().includes(asked)
      : changes.has(parameter.path) || (parameter.can_be_free && /^(sheet|layer|volume|node|sun|footprint|camera)/.test(parameter.path)));
    const is_camera = parameter => /^camera/.test(parameter.path);
    found.sort((a, b) => is_camera(a) - is_camera(b));  // what shines first
    list.replaceChildren(...found.slice(0, 60).map(row));
    if (found.length > 60) list.append(element("p", {}, `and ${found.length - 60} more: search for them`));
  }

  // Beside a photograph.
  const beside = choice(photographs, "no photograph");
  const wipe = element("input", { type: "range", min: 0, max: 100, value: 50, "aria-label": "Wipe between scene and photograph", input: show_wipe });
  function show_wipe() {
    wiped.hidden = !beside.value;
    if (beside.value && wiped.getAttribute("src") !== address(beside.value)) wiped.src = address(beside.value);
    wiped.style.clipPath = `inset(0 0 0 ${wipe.value}%)`;
  }
  beside.addEventListener("change", () => { show_wipe(); fit.show(); });
  const mask = choice(photographs, "none");
  mask.addEventListener("change", () => fit.show());

  // Saving; the fit is of the file, so that changes must be saved first.
  const to = element("input", { value: name.replace(/\.toml$/, "") + "_changed.toml" });
  const kept = element("p", { role: "status" });  // its own: pictures that are drawn meanwhile have another
  const save = element("button", { click: async () => {
    try {
      const saved = await tell("save", { scene: name, changes: [...changes].map(([path, value]) => `${path}=${value}`), to: to.value });
      kept.textContent = `Saved as ${saved.name}.`;
      kept.className = "";
      await changed();
    } catch (error) {
      kept.textContent = error.message;
      kept.className = "bad";
    }
  } }, "Save");
  const undo = element("button", { click: () => {
    if (before.length === 0) return;
    changes = before.pop();
    update();
    show_list();
  } }, "Undo");
  const fit = command_panel("Fit to the photograph", () => {
    const photo = beside.value || "PHOTO";
    return ["fit", name, ...changed_words(), "--photo", photo, ...(mask.value ? ["--mask", mask.value] : []), "--out", `runs/${photo.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}_fitted`];
  }, () => changed());

  const live = live_panel(name, changed_words);

  show_list();
  update();
  return element("article", {}, element("h2", {}, name),
    element("div", { class: "two" },
      element("div", {}, element("div", { class: "picture" }, image, wiped), status, shown,
        element("div", { class: "row" }, undo, field("Beside", beside), field("Wipe", wipe), field("Mask of the fit", mask)),
        element("div", { class: "row" }, field("Save as", to), save), kept,
        element("p", {}, "The free numbers of a fit are those of fit.free in the scene."), fit.panel, live.panel),
      element("div", {}, field("Parameters", search), list)));
}
