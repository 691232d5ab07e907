// The light of all layers, in kilorayleighs of each line, added up in two pictures of four lines.
import { bind, kEverywhere, program, texture } from "./gl.js";
import { kLightShader } from "./light_shader.js";

/// Numbers of lines, [place][line], as two layers of four channels.
function by_fours(values, places, lines) {
  const made = new Float32Array(2 * 4 * places);
  for (let place = 0; place < places; ++place)
    for (let line = 0; line < lines; ++line) made[(Math.floor(line / 4) * places + place) * 4 + line % 4] = values[place * lines + line];
  return made;
}

/// One texture of a map: the flux of each texel, and the flux times ln energy, shift and ln stretch, so that means over
/// texels are weighted by it.
function map_texture(gl, map, layer) {
  const texels = layer.columns * layer.rows * layer.faces, made = new Float32Array(4 * texels);
  [map.flux, map.ln_energy, map.shift_km, map.ln_stretch].forEach((values, channel) => {
    if (values) for (let i = 0; i < texels; ++i) made[4 * i + channel] = channel === 0 ? values[i] : values[i] * map.flux[i];
  });
  return texture(gl, made, { columns: layer.columns, rows: layer.rows, layers: layer.faces, channels: 4, half: true, coarser: true });
}

const turned = ([x, y, z], angle) => [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle), z];

export class LightPass {
  constructor(gl, view) {
    this.gl = gl;
    this.view = view;
    this.shader = program(gl, kEverywhere, kLightShader);
    const lines = view.lines_nm.length;
    const elevations = view.transmission ? view.transmission.length / lines : 1;
    this.air = texture(gl, by_fours(view.transmission ?? new Float32Array(lines), elevations, lines), { columns: elevations, layers: 2, channels: 4 });
    this.layers = view.layers.map(layer => {
      const profile_rows = layer.rate.length / lines / layer.energies;
      const places = profile_rows * layer.energies;
      // The largest is 1, since half floats may hold it.
      const scale = layer.rate.reduce((most, rate) => Math.max(most, rate), 1e-30);
      const flux = layer.maps.reduce((most, map) => map.flux.reduce((m, f) => Math.max(m, f), most), 1e-30);
      const maps = layer.maps.map(map => map_texture(gl, { ...map, flux: map.flux.map(f => f / flux) }, layer));
      const fall = new Float32Array(layer.fall.length / 3 * 4);
      for (let i = 0; i < layer.fall.length; ++i) fall[Math.floor(i / 3) * 4 + i % 3] = layer.fall[i];
      return { layer, profile_rows, scale: scale * flux, maps,
        dark: texture(gl, layer.dark, { columns: layer.dark_columns, rows: layer.dark_rows, layers: layer.faces, exact: true }),
        fall: texture(gl, fall, { columns: view.fall_nodes, rows: view.fall_nodes, layers: layer.faces, channels: 4 }),
        profile: texture(gl, by_fours(layer.rate.map(rate => rate * flux), places, lines), { columns: profile_rows, rows: layer.energies, layers: 2, channels: 4 }) };
    });
  }

  /// Draws the light at a time of the scene's clock, in seconds from its start.
  draw(target, see, flight, time_s) {
    const { gl, view, shader } = this, array = gl.TEXTURE_2D_ARRAY;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.useProgram(shader.made);
    const number = (name, value) => gl.uniform1f(shader.at(name), value);
    const pair = (name, x, y) => gl.uniform2f(shader.at(name), x, y);
    for (const { layer, profile_rows, maps, dark, fall, profile } of this.layers) {
      const place = maps.length > 1 ? Math.min(maps.length - 1, Math.max(0, time_s / view.step_s)) : 0;
      const before = Math.min(Math.floor(place), maps.length - 1), after = Math.min(before + 1, maps.length - 1);
      bind(gl, shader, { lens: [array, see.lens], map_before: [array, maps[before]], map_after: [array, maps[after]],
        dark: [array, dark], fall: [array, fall], profile: [array, profile], transmission: [array, this.air] });
      see.apply(shader, target);
      gl.uniform3f(shader.at("eye_km"), ...flight.place_km);
      const turn = -layer.turn_deg_s * time_s * Math.PI / 180;
      gl.uniformMatrix3fv(shader.at("layer_from_enu"), false, layer.axes.flatMap(axis => layer.is_shell ? turned(axis, turn) : axis));
      gl.uniform1i(shader.at("is_shell"), layer.is_shell ? 1 : 0);
      gl.uniform1i(shader.at("has_air"), view.transmission ? 1 : 0);
      pair("along", ...layer.along);
      pair("first_texel", layer.first_column, layer.first_row);
      pair("texels", layer.columns, layer.rows);
      pair("dark_first", layer.dark_first_column, layer.dark_first_row);
      pair("dark_cells", layer.dark_columns, layer.dark_rows);
      pair("drifted_km", ...(layer.is_shell ? [0, 0] : layer.drift_km_s.map(speed => speed * time_s)));
      for (const name of ["cell_km", "face_cells", "dark_texels", "bottom_km", "top_km", "peak_km", "ln_first", "ln_step", "energies"])
        number(name, layer[name]);
      for (const name of ["profile_bottom_km", "profile_step_km"]) number(name, view[name]);
      number("profile_rows", profile_rows);
      number("after_share", place - before);
      number("pixel_rad", see.pixel_rad);
      number("body_km", view.radius_km);
      number("feet_km", view.foot_altitude_km);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.disable(gl.BLEND);
  }
}
