// Photographs beside the map of what they show, linked: what is pointed at in one is marked in the others, at one height;
// a click draws its line of sight there, marked by the height.
import { address, tell } from "./api.js";
import { place_words } from "./globe.js";
import { ground_map } from "./ground.js";
import { element, field, svg } from "./parts.js";
import { path_of, pointer } from "./pointer.js";

const kUsual_km = 105;
const kHeights_km = Array.from({ length: 45 }, (_, i) => 80 + 5 * i);  // of a line of sight, 80 to 300 km
const kMarked_km = [80, 100, 120, 150, 200, 250, 300];
const label_of = height_km => kMarked_km.includes(height_km) ? `${height_km} km` : "";

/// Calls what is asked for one at a time; of what comes meanwhile the last, but what must not be left out first.
function in_turn(failed) {
  let at_work = false, next = null, chosen = null;
  return async function ask(work, is_chosen) {
    if (at_work) {
      if (is_chosen) chosen = work;
      else next = work;
      return;
    }
    at_work = true;
    await work().catch(failed);
    at_work = false;
    const waiting = chosen ?? next;
    if (chosen) chosen = null;
    else next = null;
    if (waiting) ask(waiting, false);
  };
}

/// `pictures` are { photo, camera: { file, changes } }, the photographs of one light; `map` is the map of precipitation or
/// null, `lines` are { places: [latitude, longitude, height in km], kind } that are drawn over all. `earth` and `is_refracted` are as
/// apps/studio/studio_sights.h has them, `height_km` is that of the light, if it is known.
export async function linked_view({ pictures, map, lines, earth, is_refracted, height_km }) {
  const asked = (name, order, more) => tell(name, { cameras: order.map(i => pictures[i].camera), earth, is_refracted, ...more });
  const all = pictures.map((_, i) => i);
  const height = element("input", { type: "number", min: 60, max: 1000, step: "any", value: Math.round(height_km ?? kUsual_km) });
  const chosen_km = () => Math.min(1000, Math.max(60, Number(height.value) || kUsual_km));
  const { views } = await asked("views", all, { height_km: chosen_km() });
  const said = element("p", { role: "status", class: "pointed" }, "Point at something in a photograph or on the map; click, or press Enter, for its line of sight.");
  const queue = in_turn(error => { said.textContent = error.message; });
  let again = () => {};  // what was pointed at last, for another height
  const ask = (work, is_chosen) => { again = () => queue(work, is_chosen); again(); };
  height.addEventListener("input", () => again());

  const left = () => { again = () => {}; [...layers, ground].forEach(drawing => { drawing.line([]); drawing.mark(null); }); };
  const figures = pictures.map(({ photo }, i) => {
    const layer = svg("svg", { role: "application", "aria-label": `${photo}: arrows move the mark (Shift: in small steps), Enter draws the line of sight, Escape clears` });
    const lens = svg("g");
    layer.append(lens);
    return { layer, lens, drawing: pointer(layer, { x: 0, y: 0, width: views[i].width, height: views[i].height },
      { pointed: (pixel, is_chosen) => ask(() => pointed_in(i, pixel, is_chosen), is_chosen), left }) };
  });
  const layers = figures.map(figure => figure.drawing);
  const ground = ground_map({ centre: map ? [map.latitude_deg, map.longitude_deg] : views[0].place, map, lines,
    cameras: views.map((view, i) => ({ name: pictures[i].photo, place: view.place, outline: view.outline })),
    pointed: (place, is_chosen) => ask(() => pointed_on_map(place, is_chosen), is_chosen), left });

  /// What is at a place, in words.
  function words_at(place) {
    const cell = ground.cell(place);
    if (!cell) return "";
    const flux = map.flux_is_absolute ? `${cell.flux.toPrecision(2)} mW/m²` : `${cell.flux.toPrecision(2)} (relative)`;
    return `; energy flux ${flux}${cell.energy_kev ? `, ${cell.energy_kev.toPrecision(2)} keV` : ""}`;
  }

  async function pointed_in(i, pixel, is_chosen) {
    const order = [i, ...all.filter(other => other !== i)];
    const { azimuth_deg, elevation_deg, points } = await asked("sight", order, { pixel, heights_km: [chosen_km(), ...(is_chosen ? kHeights_km : [])] });
    const at = points.find(point => point.height_km === chosen_km());
    order.slice(1).forEach((picture, k) => layers[picture].mark(at?.pixels[k + 1] ?? null));
    ground.mark(at?.place ?? null);
    if (is_chosen) {
      const line = points.filter((point, k) => k > 0 || point !== at);
      layers[i].line([]);
      order.slice(1).forEach((picture, k) => layers[picture].line(line.map(point => point.pixels[k + 1] && { place: point.pixels[k + 1], label: label_of(point.height_km) })));
      ground.line(line.map(point => ({ place: point.place, label: label_of(point.height_km) })));
    }
    said.textContent = azimuth_deg === null ? "This is outside of the lens's picture."
      : `Azimuth ${azimuth_deg.toFixed(2)}°, elevation ${elevation_deg.toFixed(2)}°; ` + (at
        ? `at ${at.height_km} km: ${place_words(at.place)}, ${at.distance_km.toFixed(0)} km away${words_at(at.place)}.`
        : `it does not reach ${chosen_km()} km.`);
  }

  async function pointed_on_map(place, is_chosen) {
    const heights = [chosen_km(), ...(is_chosen ? kHeights_km : [])];
    const { pixels } = await asked("seen", all, { places: heights.map(km => [...place, km]) });
    layers.forEach((layer, i) => {
      layer.mark(pixels[0][i]);
      if (is_chosen) layer.line(pixels.slice(1).map((of_place, k) => of_place[i] && { place: of_place[i], label: label_of(kHeights_km[k]) }));
    });
    if (is_chosen) ground.line([]);
    const unseen = pictures.filter((_, i) => pixels[0][i] === null).map(picture => picture.photo);
    said.textContent = `${place_words(place)}${words_at(place)}${unseen.length > 0 ? `; at ${chosen_km()} km not in ${unseen.join(", ")}` : ""}.`;
  }

  // Borders and curtains over the photographs.
  for (const { places, kind } of lines) {
    const { pixels } = await asked("seen", all, { places });
    figures.forEach(({ lens }, i) => lens.append(svg("path", { class: kind, d: path_of(pixels.map(of_place => of_place[i])) })));
  }

  const shown = kind => lines.some(line => line.kind === kind);
  const legend = ["North up", map && `green: energy flux${map.flux_is_absolute ? "" : " (relative)"}`, shown("curtain") && "violet: curtains", shown("border") && "orange: borders, if 105 km high",
    `dotted${pictures.length > 1 ? ", dashed" : ""}: in view at ${chosen_km()} km`].filter(Boolean).join("; ");
  return element("section", { class: "linked-view" }, element("h3", {}, pictures.length > 1 ? "Lines of sight" : "On the map"),
    element("div", { class: "row" }, field("Height of the light, km", height)), said,
    element("div", { class: "linked" },
      ...pictures.map(({ photo }, i) => element("figure", {},
        element("div", { class: "picture" }, element("img", { src: address(photo), alt: photo }), figures[i].layer),
        element("figcaption", {}, photo, pictures.length > 1 ? `; on the map ${i === 1 ? "dashed" : "dotted"}` : ""))),
      element("figure", {}, ground.layer, element("figcaption", {}, legend))));
}
