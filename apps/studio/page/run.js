// A run: its photographs and its map, as far as it has these, and its report.
import { address, ask, table_of } from "./api.js";
import { ground_about, ground_of_foot } from "./globe.js";
import { linked_view } from "./linked.js";
import { element, report_frame } from "./parts.js";

const kShown = /\.(jpe?g|png|webp|avif)$/i;  // others a browser does not know
const kBorder_km = 105;

const json_of = async name => (await fetch(address(name))).json();

/// The words of a command line, as sim::quoted_for_shell() writes them.
export const words_of = line => (line.match(/(?:[^\s'\\]|\\.|'[^']*')+/g) ?? []).map(word => word.replace(/'([^']*)'|\\(.)/g, "$1$2"));

/// The photograph and camera of a command that has both (border, map): { photo, camera }, null without.
function picture_of(command) {
  const words = words_of(command), after = option => words[words.indexOf(option) + 1];
  const photo = words.includes("--photo") ? after("--photo") : null;
  const file = words.includes("--camera") ? after("--camera") : words.slice(2).find(word => word.endsWith(".toml"));
  const changes = words.filter((word, i) => words[i - 1] === "--set" && /^(site|camera)\./.test(word));
  return photo && file && kShown.test(photo) ? { photo, camera: { file, changes } } : null;
}

/// The points of a table as lines, by a column.
function lines_by(rows, column, place_of) {
  const lines = new Map();
  for (const row of rows) lines.set(row[column], [...(lines.get(row[column]) ?? []), place_of(row)]);
  return [...lines.values()].map(places => places.filter(place => place !== null)).filter(places => places.length > 1);
}

/// The claimed borders of a table, where they are if they are 105 km high.
async function borders_of(folder) {
  const rows = (await table_of(`${folder}/border.csv`)).filter(row => row.latitude_105km_deg && Number(row.aurora_probability) >= 0.9);
  return lines_by(rows, "trace", row => [Number(row.latitude_105km_deg), Number(row.longitude_105km_deg), kBorder_km])
    .map(places => ({ places, kind: "border" }));
}

/// A map's curtains at the height of their lower borders. That the field is tilted moves these by 3 km at most from the feet.
async function curtains_of(folder, map) {
  const { place_of } = ground_about([map.latitude_deg, map.longitude_deg]);
  const foot = row => place_of(ground_of_foot([Number(row.east_km), Number(row.north_km)]));
  return lines_by(await table_of(`${folder}/curtains.csv`), "curtain", row => [...foot(row), Number(row.lower_border_km) || map.height_km])
    .map(places => ({ places, kind: "curtain" }));
}

/// What linked_view() needs of one photograph's measurement.
async function of_measurement(folder) {
  const { stages } = await json_of(`${folder}/measure.json`);
  const has = file => (stages ?? []).some(stage => stage.files.includes(file));
  const border = (stages ?? []).find(stage => stage.command.startsWith("vegard border "));
  return { picture: border ? picture_of(border.command) : null, lines: has("border/border.csv") ? await borders_of(`${folder}/border`) : [],
    map_folder: has("map/precipitation.fits") ? `${folder}/map` : null };
}

async function with_map(pictures, lines, map_folder) {
  const map = map_folder ? await ask(`map?run=${encodeURIComponent(map_folder)}`) : null;
  return { pictures, map, lines: map ? [...lines, ...await curtains_of(map_folder, map)] : lines, earth: "sphere", is_refracted: true };
}

/// What linked_view() needs of a run; null if the run has no photograph with a known camera.
async function linked_of(run) {
  const has = file => run.has.includes(file);
  if (has("together.json")) {
    const { command, pictures, border, pairs } = await json_of(`${run.name}/together.json`);
    const alone = await Promise.all((pictures ?? []).map((_, i) => of_measurement(`${run.name}/picture_${i + 1}`)));
    const words = words_of(command), is_sphere = words[words.indexOf("--earth") + 1] === "sphere";
    const heights = [border, ...(pairs ?? []).map(pair => pair.border)].filter(one => one?.height_km);
    return { pictures: alone.map(one => one.picture), map: null, lines: [], earth: is_sphere ? "sphere" : "wgs84", is_refracted: !is_sphere, height_km: heights[0]?.height_km };
  }
  if (has("measure.json")) {
    const { picture, lines, map_folder } = await of_measurement(run.name);
    return with_map([picture], lines, map_folder);
  }
  if (has("map.json")) return with_map([picture_of((await json_of(`${run.name}/map.json`)).command)], [], run.name);
  return null;
}

/// Photographs and map of a run, or why they are not shown; null where it has none.
async function linked_part(run, files) {
  try {
    const linked = await linked_of(run);
    if (linked === null) return null;
    const is_here = picture => picture !== null && files.some(file => file.name === picture.photo);
    if (linked.pictures.every(is_here)) return await linked_view(linked);
    return element("p", {}, "No map beside the photograph: it is not in this folder, its camera is not known, or a browser does not show its format.");
  } catch (error) {
    return element("p", { class: "bad" }, error.message);
  }
}

/// The parts of a run's view: photographs and map, and the report.
export async function run_parts(name) {
  const files = await ask("files"), run = files.find(file => file.name === name);
  return element("div", {}, run ? await linked_part(run, files) : null, report_frame(address(`${name}/report.html`)));
}
