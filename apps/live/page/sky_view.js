// A view of the scene on a canvas: its passes in their order, at any size.
import { drop_target, target, texture } from "./gl.js";
import { Lens } from "./lens.js";
import { LightPass } from "./light_pass.js";
import { PicturePass } from "./picture_pass.js";
import { StarPass } from "./star_pass.js";

export class SkyView {
  constructor(canvas, view) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
    if (gl === null) throw new Error("this browser has no WebGL2, which draws the live view");
    if (gl.getExtension("EXT_color_buffer_float") === null) throw new Error("this device cannot draw light in floats (EXT_color_buffer_float)");
    const most = gl.getParameter(gl.MAX_3D_TEXTURE_SIZE), widest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    for (const layer of view.layers)
      if (Math.max(layer.columns, layer.rows) > widest || layer.faces > most) throw new Error(`this device is too small for the map of ${layer.name}`);
    this.gl = gl;
    this.canvas = canvas;
    this.view = view;
    this.lens = new Lens(view.camera);
    this.lens_texture = texture(gl, this.lens.angle, { columns: this.lens.angle.length });
    this.light = new LightPass(gl, view);
    this.stars = new StarPass(gl, view, this.lens);
    this.picture = new PicturePass(gl, view);
  }

  resize(width, height) {
    if (this.frames && this.canvas.width === width && this.canvas.height === height) return;
    const { gl } = this;
    for (const frame of this.frames ?? []) drop_target(gl, frame);
    this.canvas.width = width;
    this.canvas.height = height;
    this.frames = [target(gl, width, height, 2), target(gl, width, height, 2), target(gl, width, height, 1)];
  }

  /// Draws the scene; `gain` is on the sensor's light.
  draw(flight, time_s, gain) {
    const { gl, view: { camera } } = this, { width, height } = this.canvas, [light, other, stars] = this.frames;
    const px = camera.width / width, { right, down, forward } = flight.axes();
    const see = { lens: this.lens_texture, pixel_rad: px * this.lens.angle_step / (this.lens.radius[1] * flight.zoom), apply: (shader, on) => {
      for (const [name, value] of [["px", px], ["rows", on.height], ["last_radius", this.lens.last_radius_px], ["aspect", camera.aspect],
        ["side", camera.side], ["zoom", flight.zoom]]) gl.uniform1f(shader.at(name), value);
      gl.uniform2f(shader.at("principal"), camera.principal_x_px, camera.principal_y_px);
      gl.uniformMatrix3fv(shader.at("enu_from_camera"), false, [...right, ...down, ...forward]);
    } };
    this.light.draw(light, see, flight, time_s);
    this.picture.blur(light, other, [1, 0], px, flight.zoom);
    this.picture.blur(other, light, [0, 1], px, flight.zoom);
    this.stars.draw(stars, flight, px);
    this.picture.show(light, stars, see, flight, gain, width, height);
  }

  /// Kilorayleighs of a line as they were drawn last, [row][column] from the top.
  kilorayleighs(line) {
    const { gl } = this, { width, height } = this.canvas, four = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.frames[0].frame);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + Math.floor(line / 4));
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, four);
    const made = new Float32Array(width * height);
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) made[y * width + x] = four[((height - 1 - y) * width + x) * 4 + line % 4];
    return made;
  }
}
