// From rayleighs to the screen, in the program's order: each line is blurred by its width, coloured by the sensor, what
// is out of its gamut is cut, then the sky is added, and the tone curve encodes the sum.
import { bind, kEverywhere, program, texture } from "./gl.js";
import { kLensGlsl } from "./lens.js";

// A Gaussian of a width for each line, along one side of the picture.
const kBlurGlsl = `
uniform sampler2D first_lines, last_lines;
uniform vec4 first_sigma, last_sigma;
uniform ivec2 along;
uniform int reach;
vec4 weights(vec4 sigma, float k) {
  vec4 is_sharp = step(sigma, vec4(0.05));
  vec4 spread = exp(-0.5 * k * k / max(sigma * sigma, vec4(1e-4)));
  return mix(spread, vec4(k == 0.0 ? 1.0 : 0.0), is_sharp);
}
void blurred(out vec4 first, out vec4 last) {
  ivec2 here = ivec2(gl_FragCoord.xy), most = textureSize(first_lines, 0) - 1;
  vec4 first_weight = vec4(0.0), last_weight = vec4(0.0);
  first = last = vec4(0.0);
  for (int k = -reach; k <= reach; ++k) {
    ivec2 at = clamp(here + k * along, ivec2(0), most);
    vec4 a = weights(first_sigma, float(k)), b = weights(last_sigma, float(k));
    first += a * texelFetch(first_lines, at, 0);
    last += b * texelFetch(last_lines, at, 0);
    first_weight += a;
    last_weight += b;
  }
  first /= first_weight;
  last /= last_weight;
}
`;

const kBlur = `#version 300 es
precision highp float;
layout(location = 0) out vec4 first_blurred;
layout(location = 1) out vec4 last_blurred;
${kBlurGlsl}
void main() { blurred(first_blurred, last_blurred); }`;

const kShow = `#version 300 es
precision highp float;
precision highp sampler2DArray;
${kLensGlsl}
uniform sampler2D first_lines, last_lines, stars;
uniform sampler2DArray night, tone;
uniform vec3 rgb_of_line[8];
uniform vec3 sky, eye_km;
uniform float gain, body_km;
uniform bool has_night;
out vec4 shown;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 first = texelFetch(first_lines, here, 0), last = texelFetch(last_lines, here, 0);
  vec3 aurora = first.x * rgb_of_line[0] + first.y * rgb_of_line[1] + first.z * rgb_of_line[2] + first.w * rgb_of_line[3] +
                last.x * rgb_of_line[4] + last.y * rgb_of_line[5] + last.z * rgb_of_line[6] + last.w * rgb_of_line[7];
  vec3 light = max(aurora, 0.0) + sky;
  bool is_seen;
  vec3 ray = direction_of_fragment(is_seen);
  float forward = dot(eye_km, ray) + body_km * ray.z, square = dot(eye_km, eye_km) + 2.0 * body_km * eye_km.z;
  bool is_ground = forward < 0.0 && forward * forward > square;
  if (is_seen && !is_ground) {
    light += texelFetch(stars, here, 0).rgb;
    if (has_night) {
      float azimuth = atan(ray.x, ray.y) / 6.28318530718;
      light += texture(night, vec3(azimuth, 0.5 - asin(clamp(ray.z, -1.0, 1.0)) / 3.14159265359, 0.0)).rgb;
    }
  }
  light = sqrt(clamp(light * gain, 0.0, 1.0));
  vec3 at = (light * 1023.0 + 0.5) / 1024.0;
  shown = vec4(texture(tone, vec3(at.r, 0.5, 0.0)).r, texture(tone, vec3(at.g, 0.5, 0.0)).r, texture(tone, vec3(at.b, 0.5, 0.0)).r, 1.0);
}`;

export class PicturePass {
  constructor(gl, view) {
    this.gl = gl;
    this.view = view;
    this.blur_shader = program(gl, kEverywhere, kBlur);
    this.show_shader = program(gl, kEverywhere, kShow);
    this.tone = texture(gl, view.tone, { columns: view.tone.length });
    const night = new Float32Array(4 * (view.night_columns * view.night_rows || 1));
    if (view.night_rgb) for (let i = 0; i < view.night_rgb.length; ++i) night[Math.floor(i / 3) * 4 + i % 3] = view.night_rgb[i];
    this.night = texture(gl, night, { columns: view.night_columns || 1, rows: view.night_rows || 1, channels: 4, wraps: true });
    this.sigma = new Float32Array(8);
    view.blur_px.forEach((sigma, line) => { this.sigma[line] = sigma; });
    this.rgb = new Float32Array(24);
    view.rgb_per_kilorayleigh.forEach((rgb, line) => this.rgb.set(rgb, 3 * line));
  }

  /// From one frame to another along rows or columns; `px` are pixels of the scene's camera in one of the frame.
  blur(from, to, along, px, zoom) {
    const { gl } = this, shader = this.blur_shader, sigma = this.sigma.map(width => width * zoom / px);
    gl.bindFramebuffer(gl.FRAMEBUFFER, to.frame);
    gl.viewport(0, 0, to.width, to.height);
    gl.useProgram(shader.made);
    bind(gl, shader, { first_lines: [gl.TEXTURE_2D, from.textures[0]], last_lines: [gl.TEXTURE_2D, from.textures[1]] });
    gl.uniform4fv(shader.at("first_sigma"), sigma.slice(0, 4));
    gl.uniform4fv(shader.at("last_sigma"), sigma.slice(4));
    gl.uniform2i(shader.at("along"), ...along);
    gl.uniform1i(shader.at("reach"), Math.min(200, Math.ceil(4 * Math.max(...sigma))));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  show(from, stars, see, flight, gain, width, height) {
    const { gl, view } = this, shader = this.show_shader;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.useProgram(shader.made);
    bind(gl, shader, { lens: [gl.TEXTURE_2D_ARRAY, see.lens], first_lines: [gl.TEXTURE_2D, from.textures[0]], last_lines: [gl.TEXTURE_2D, from.textures[1]],
      stars: [gl.TEXTURE_2D, stars.textures[0]], night: [gl.TEXTURE_2D_ARRAY, this.night], tone: [gl.TEXTURE_2D_ARRAY, this.tone] });
    see.apply(shader, { width, height });
    gl.uniform3fv(shader.at("rgb_of_line"), this.rgb);
    gl.uniform3f(shader.at("sky"), ...view.sky_rgb);
    gl.uniform3f(shader.at("eye_km"), ...flight.place_km);
    gl.uniform1f(shader.at("gain"), gain);
    gl.uniform1f(shader.at("body_km"), view.radius_km);
    gl.uniform1i(shader.at("has_night"), view.night_rgb ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
