// Marches a ray through one layer: at each step the foot of the field line, the map's light there, and the profile at
// the step's altitude. The foot is found as in sim/emit/footprint/foot_body.h, with directions of fall from a table.
import { kLensGlsl } from "./lens.js";

export const kLightShader = `#version 300 es
precision highp float;
precision highp sampler2DArray;
layout(location = 0) out vec4 first_lines;
layout(location = 1) out vec4 last_lines;
${kLensGlsl}
uniform vec3 eye_km;            // from the ground below the scene's camera
uniform float body_km, feet_km;  // the body's radius, and the feet's altitude
uniform mat3 layer_from_enu;
uniform sampler2DArray map_before, map_after;  // flux, and flux times ln energy, shift, ln stretch
uniform float after_share, pixel_rad;
uniform sampler2DArray dark, fall, profile, transmission;
uniform bool is_shell, has_air;
uniform float face_cells, cell_km, dark_texels;
uniform vec2 along, first_texel, texels, dark_first, dark_cells, drifted_km;
uniform float bottom_km, top_km, peak_km, ln_first, ln_step, energies, profile_rows, profile_bottom_km, profile_step_km;

const int kMostSteps = 6000;
const float kFallNodes = 33.0;
const float kShareOfPixel = 0.6;  // of its width, that a texel of the map has
const float kCells = 0.75, kRise_km = 1.0, kLongest_km = 4.0;  // of a step: in texels, in altitude, at all

vec4 first_sum = vec4(0.0), last_sum = vec4(0.0);

// The texel of a foot on the sphere of feet, its face, and where on it: 0 to 1 over the table of falls.
vec2 texel_of(vec3 foot, out float face, out vec2 share, out float texels_per_km) {
  if (!is_shell) {
    vec2 at = foot.xy - drifted_km;
    vec2 in_map = vec2(dot(at, along), at.y * along.x - at.x * along.y);
    vec2 texel = (in_map - first_texel) / cell_km;
    face = 0.0;
    share = texel / max(texels - 1.0, 1.0);
    texels_per_km = 1.0 / cell_km;
    return texel;
  }
  vec3 size = abs(foot);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  float ahead = axis == 0 ? foot.x : axis == 1 ? foot.y : foot.z;
  vec2 uv = (axis == 0 ? foot.yz : axis == 1 ? foot.zx : foot.xy) / abs(ahead);
  face = float(2 * axis) + (ahead < 0.0 ? 1.0 : 0.0);
  share = uv * 0.5 + 0.5;
  texels_per_km = 0.5 * face_cells * (1.0 + dot(uv, uv)) / (body_km + feet_km);
  return share * face_cells + 0.5 - first_texel;
}

vec3 fall_at(vec3 foot) {
  float face, speed;
  vec2 share;
  texel_of(foot, face, share, speed);
  vec2 at = (clamp(share, 0.0, 1.0) * (kFallNodes - 1.0) + 0.5) / kFallNodes;
  return normalize(texture(fall, vec3(at, face)).xyz);
}

void march(vec3 from, float square, float forward, vec3 ray, float first_km, float length_km) {
  float feet = body_km + feet_km;
  float above_feet = feet_km * (feet_km + 2.0 * body_km);
  vec3 foot = from * (feet / sqrt(square + body_km * body_km));
  float at_km = 0.0, step_km = min(0.5, length_km), moved_km = 100.0;
  for (int i = 0; i < kMostSteps && at_km < length_km; ++i) {
    step_km = min(step_km, length_km - at_km);
    float middle = at_km + 0.5 * step_km;
    vec3 place = from + ray * middle;
    float here2 = square + middle * (2.0 * forward + middle);
    float radius = sqrt(here2 + body_km * body_km);
    float altitude = here2 / (radius + body_km);
    // The foot, from that of the last step.
    vec3 falls;
    bool is_there = true;
    int turns = moved_km > 10.0 ? 4 : 2;
    for (int turn = 0; turn < turns; ++turn) {
      falls = fall_at(foot);
      float above = here2 - above_feet, rise = dot(place, falls), root2 = rise * rise - above;
      is_there = root2 > 1.0 && rise < -1.0;
      foot = is_there ? place + falls * (above / (sqrt(max(root2, 1.0)) - rise)) : place * (feet / radius);
    }
    float face, texels_per_km;
    vec2 share;
    vec2 texel = texel_of(foot, face, share, texels_per_km);
    is_there = is_there && (is_shell || foot.z > 0.0);
    vec3 up = foot / feet;
    vec3 along_feet = ray - falls * (dot(ray, up) / min(dot(falls, up), -0.05));
    float speed = max(length(along_feet) * texels_per_km, 1e-6);
    // Coarser maps where a pixel is wider than a texel: its light is a mean, not that of its middle.
    float pixel_km = (first_km + middle) * pixel_rad;
    float coarse = max(kShareOfPixel * pixel_km * (is_shell ? texels_per_km : 1.0 / cell_km), 1.0), level = log2(coarse);
    // Darkness around, and beyond the map.
    vec2 cell = floor((texel - dark_first) / dark_texels);
    vec2 nearest = clamp(cell, vec2(0.0), dark_cells - 1.0);
    float away = texelFetch(dark, ivec3(nearest, face), 0).r;
    if (!is_shell) away = max(away, length(max(max(-texel, texel - texels + 1.0), 0.0)) - 1.0);
    away -= 2.0 * (coarse - 1.0);
    vec2 inside = step(vec2(-1.0), texel) * step(texel, texels);
    if (is_there && inside.x * inside.y > 0.0) {
      vec3 at = vec3((texel + 0.5) / texels, face);
      vec4 lit = textureLod(map_before, at, level);
      if (after_share > 0.0) lit = mix(lit, textureLod(map_after, at, level), after_share);
      if (lit.r > 0.0) {
        lit.gba /= lit.r;
        float off = altitude - lit.b - peak_km;
        float read = peak_km + (off > 0.0 ? off * exp(-lit.a) : off);
        float row = (read - profile_bottom_km) / profile_step_km;
        if (row > 0.0 && row < profile_rows - 1.0) {
          float energy = ln_step > 0.0 ? clamp((lit.g - ln_first) / ln_step, 0.0, energies - 1.0) : 0.0;
          vec2 entry = vec2((row + 0.5) / profile_rows, (energy + 0.5) / energies);
          float path = lit.r * step_km;
          first_sum += path * texture(profile, vec3(entry, 0.0));
          last_sum += path * texture(profile, vec3(entry, 1.0));
        }
      }
    }
    at_km += step_km;
    float climb = abs(forward + middle) / radius;
    float fine = min(min(kCells * coarse / speed, max(kRise_km, 0.3 * pixel_km) / max(climb, 0.01)), max(kLongest_km, pixel_km));
    float skipped = is_there ? max(0.0, 0.98 * away / speed - 0.5 * step_km - 0.5 * fine) : fine;
    moved_km = step_km + skipped;
    at_km += skipped;
    step_km = fine;
  }
}

void main() {
  bool is_seen;
  vec3 ray_enu = direction_of_fragment(is_seen);
  first_lines = last_lines = vec4(0.0);
  if (!is_seen) return;
  vec3 ray = layer_from_enu * ray_enu, from = layer_from_enu * (eye_km + vec3(0.0, 0.0, body_km));
  float square = dot(eye_km, eye_km) + 2.0 * body_km * eye_km.z;
  float forward = dot(eye_km, ray_enu) + body_km * ray_enu.z;
  float chord2 = forward * forward - square;
  float end = forward < 0.0 && chord2 > 0.0 ? -forward - sqrt(chord2) : 1e9;
  float outer2 = chord2 + top_km * (top_km + 2.0 * body_km), inner2 = chord2 + bottom_km * (bottom_km + 2.0 * body_km);
  if (outer2 <= 0.0) return;
  float outer = sqrt(outer2), inner = inner2 > 0.0 ? sqrt(inner2) : -1.0;
  for (int part = 0; part < 2; ++part) {
    float first = part == 0 ? -forward - outer : -forward + inner;
    float last = part == 0 && inner >= 0.0 ? -forward - inner : -forward + outer;
    if (part == 1 && inner < 0.0) break;
    first = max(first, 0.0);
    last = min(last, end);
    if (last - first < 1e-3) continue;
    march(from + ray * first, square + first * (2.0 * forward + first), forward + first, ray, first, last - first);
  }
  if (has_air) {
    float elevation = degrees(asin(clamp(ray_enu.z, -1.0, 1.0)));
    float at = ((elevation + 90.0) * 2.0 + 0.5) / 361.0;
    first_sum *= texture(transmission, vec3(at, 0.5, 0.0));
    last_sum *= texture(transmission, vec3(at, 0.5, 1.0));
  }
  first_lines = first_sum;
  last_lines = last_sum;
}`;
