// A map of the ground about a place, on a grid of latitude and longitude: the light's energy flux, curtains, borders, and
// what cameras see.
import { ground_about, ground_of_foot } from "./globe.js";
import { element, svg } from "./parts.js";
import { path_of, pointer, labelled } from "./pointer.js";

const kSteps_deg = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30];
const kKmPerDegree = 111.2, kMargin = 0.05;

/// Parallels and meridians across the box, each { points, label, is_meridian }.
function grid_lines(ground, box) {
  const edge = [];
  for (let i = 0; i <= 20; ++i)
    for (const [x, y] of [[i / 20, 0], [i / 20, 1], [0, i / 20], [1, i / 20]]) edge.push(ground.place_of([box.x + x * box.width, -(box.y + y * box.height)]));
  const [middle_lat, middle_lon] = ground.place_of([box.x + box.width / 2, -(box.y + box.height / 2)]);
  const lats = edge.map(([lat]) => lat), lons = edge.map(([, lon]) => lon + 360 * Math.round((middle_lon - lon) / 360));
  const [south, north, west, east] = [Math.min(...lats), Math.max(...lats), Math.min(...lons), Math.max(...lons)];
  const cosine = Math.max(0.05, Math.cos(middle_lat * Math.PI / 180));
  const step_of = wanted => kSteps_deg.find(step => step >= wanted) ?? 30;
  const lat_step = step_of(box.height / kKmPerDegree / 6), lon_step = step_of(box.width / kKmPerDegree / cosine / 6);
  const along = (from, to) => Array.from({ length: 61 }, (_, i) => from + (to - from) * i / 60);
  const draw = place => { const [x, y] = ground.ground_of(place); return [x, -y]; };
  const words = (value, step, positive, negative) => `${Math.abs(value).toFixed(step < 0.1 ? 2 : step < 1 ? 1 : 0)}° ${value < 0 ? negative : positive}`;
  const lines = [];
  for (let lat = Math.ceil(south / lat_step) * lat_step; lat <= north; lat += lat_step)
    lines.push({ points: along(west, east).map(lon => draw([lat, lon])), label: words(lat, lat_step, "N", "S"), is_meridian: false });
  for (let lon = Math.ceil(west / lon_step) * lon_step; lon <= east; lon += lon_step)
    lines.push({ points: along(south, north).map(lat => draw([lat, lon])), label: words(lon - 360 * Math.round(lon / 360), lon_step, "E", "W"), is_meridian: true });
  return lines;
}

/// The energy flux as an image: the more the less transparent, by the root.
function flux_image(map) {
  const flux = map.energy_flux_mw_m2, most = flux.reduce((a, b) => Math.max(a, b), 0);
  const canvas = element("canvas", { width: map.columns, height: map.rows }), context = canvas.getContext("2d");
  const pixels = context.createImageData(map.columns, map.rows);
  for (let row = 0; row < map.rows; ++row)
    for (let column = 0; column < map.columns; ++column) {
      const share = most > 0 ? Math.sqrt(Math.max(0, flux[row * map.columns + column] ?? 0) / most) : 0;
      pixels.data.set([18, 160, 90, 255 * share], 4 * ((map.rows - 1 - row) * map.columns + column));
    }
  context.putImageData(pixels, 0, 0);
  const scale = ground_of_foot([100, 0])[0] / 100, x = (map.west_km - map.step_km / 2) * scale;
  const y = -(map.south_km + (map.rows - 0.5) * map.step_km) * scale;
  return svg("image", { href: canvas.toDataURL(), x, y, width: map.columns * map.step_km * scale, height: map.rows * map.step_km * scale,
    preserveAspectRatio: "none", class: "flux" });
}

/// The square that holds all points, with a margin.
function box_of(points) {
  const xs = points.map(([x]) => x), ys = points.map(([, y]) => y);
  const [west, east, south, north] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const size = Math.max(east - west, north - south, 20) * (1 + 2 * kMargin);
  return { x: (west + east - size) / 2, y: -(south + north + size) / 2, width: size, height: size };
}

/// A map about `centre`. `map` is a run's map of precipitation about the same place, or null; `lines` are { places, kind },
/// and `cameras` { name, place, outline }. `pointed(place, is_chosen)` and `left()` are as in pointer().
export function ground_map({ centre, map, lines, cameras, pointed, left }) {
  const ground = ground_about(centre), drawn = place => { const [x, y] = ground.ground_of(place); return [x, -y]; };
  const known = [];
  for (let i = 0; map && i < map.energy_flux_mw_m2.length; ++i)
    if (map.energy_flux_mw_m2[i] !== null)
      known.push(ground_of_foot([map.west_km + (i % map.columns) * map.step_km, map.south_km + Math.floor(i / map.columns) * map.step_km]));
  const box = box_of([...known, ...cameras.flatMap(camera => [camera.place, ...(map ? [] : camera.outline)]).map(ground.ground_of)]);
  const layer = svg("svg", { class: "ground", role: "application", "aria-label": "Map: arrows move the mark (Shift: in small steps), Enter draws the vertical there, Escape clears" });

  for (const { points, label, is_meridian } of grid_lines(ground, box)) {
    layer.append(svg("path", { class: "graticule", d: path_of(points) }));
    // The words stand where a meridian leaves below, and a parallel on the left.
    const inside = ([x, y]) => x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;
    const first = points.find(inside);
    const is_at_edge = first && (is_meridian ? first[1] > box.y + 0.9 * box.height && first[0] < box.x + 0.9 * box.width : first[0] < box.x + 0.1 * box.width);
    if (is_at_edge) layer.append(labelled("text", { class: "degrees", x: first[0], y: first[1] }, label));
  }
  if (map) layer.append(flux_image(map));
  cameras.forEach((camera, i) => {
    layer.append(svg("path", { class: `view view-${i}`, d: path_of(camera.outline.map(drawn)) }));
    const [x, y] = drawn(camera.place);
    layer.append(svg("circle", { class: "camera", cx: x, cy: y }, labelled("title", {}, camera.name)));
  });
  for (const { places, kind } of lines) layer.append(svg("path", { class: kind, d: path_of(places.map(place => place && drawn(place))) }));

  const place_of = ([x, y]) => ground.place_of([x, -y]);
  const drawing = pointer(layer, box, { pointed: (point, is_chosen) => pointed(place_of(point), is_chosen), left });
  const scale = ground_of_foot([100, 0])[0] / 100;
  return {
    layer,
    mark: place => drawing.mark(place && drawn(place)),
    line: points => drawing.line(points.map(point => point && { ...point, place: drawn(point.place) })),
    /// Flux and energy of the map's cell at a place; null where it has none.
    cell(place) {
      if (!map) return null;
      const [x, y] = ground.ground_of(place).map(km => km / scale);
      const column = Math.round((x - map.west_km) / map.step_km), row = Math.round((y - map.south_km) / map.step_km);
      if (column < 0 || row < 0 || column >= map.columns || row >= map.rows) return null;
      const flux = map.energy_flux_mw_m2[row * map.columns + column];
      return flux === null ? null : { flux, energy_kev: map.energy_kev[row * map.columns + column] };
    },
  };
}
