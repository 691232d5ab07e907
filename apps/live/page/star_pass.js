// Stars and planets: each a Gaussian in pixels of the picture, as the program draws them.
import { program } from "./gl.js";

const kVertex = `#version 300 es
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 rgb;
uniform vec2 size;
uniform float width;
out vec3 light;
void main() {
  light = rgb;
  gl_Position = vec4(place / size * vec2(2.0, -2.0) + vec2(-1.0, 1.0), 0.0, 1.0);
  gl_PointSize = width;
}`;
const kFragment = `#version 300 es
precision highp float;
in vec3 light;
uniform float width, sigma;
out vec4 rgb;
void main() {
  vec2 off = (gl_PointCoord - 0.5) * width / sigma;
  rgb = vec4(light * exp(-0.5 * dot(off, off)), 1.0);
}`;

export class StarPass {
  constructor(gl, view, lens) {
    this.gl = gl;
    this.view = view;
    this.lens = lens;
    this.shader = program(gl, kVertex, kFragment);
    this.array = gl.createVertexArray();
    this.buffer = gl.createBuffer();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    for (const [place, count, from] of [[0, 2, 0], [1, 3, 8]]) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, count, gl.FLOAT, false, 20, from);
    }
    gl.bindVertexArray(null);
  }

  draw(target, flight, px) {
    const { gl, view, shader } = this, { right, down, forward } = flight.axes();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!view.stars) return;
    const sigma = Math.max(0.5, view.star_sigma_px / px), seen = [];
    const dot = (a, i) => a[0] * view.stars[i] + a[1] * view.stars[i + 1] + a[2] * view.stars[i + 2];
    for (let i = 0; i < view.stars.length; i += 6) {
      const at = this.lens.pixel([dot(right, i), dot(down, i), dot(forward, i)], flight.zoom);
      if (at === null || at.x < 0 || at.y < 0 || at.x > target.width * px || at.y > target.height * px) continue;
      const share = 1 / (2 * Math.PI * sigma * sigma * at.steradian * px * px);
      seen.push(at.x / px, at.y / px, view.stars[i + 3] * share, view.stars[i + 4] * share, view.stars[i + 5] * share);
    }
    gl.useProgram(shader.made);
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(seen), gl.STREAM_DRAW);
    gl.uniform2f(shader.at("size"), target.width, target.height);
    gl.uniform1f(shader.at("sigma"), sigma);
    gl.uniform1f(shader.at("width"), Math.max(2, Math.ceil(8 * sigma)));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.drawArrays(gl.POINTS, 0, seen.length / 5);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
  }
}
