// WebGL2 in the few pieces that the passes are made of.

/// A program of a vertex and a fragment shader; `at(name)` is the place of a uniform.
export function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const places = new Map();
  const at = name => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
    return places.get(name);
  };
  return { made, at };
}

const kFormats = { 1: ["RED", "R32F", "R16F"], 2: ["RG", "RG32F", "RG16F"], 4: ["RGBA", "RGBA32F", "RGBA16F"] };

/// A texture of floats, [layer][row][column][channel]: of 32 bits where the device can interpolate these. `exact` ones
/// are read without interpolation, and always of 32 bits; `coarser` ones have means over 2 x 2, 4 x 4 … texels too.
export function texture(gl, values, { columns, rows = 1, layers = 1, channels = 1, exact = false, half = false, wraps = false, coarser = false }) {
  const made = gl.createTexture(), target = gl.TEXTURE_2D_ARRAY;
  const [format, whole, short] = kFormats[channels];
  const is_whole = exact || (!half && gl.getExtension("OES_texture_float_linear") !== null);
  gl.bindTexture(target, made);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage3D(target, 0, gl[is_whole ? whole : short], columns, rows, layers, 0, gl[format], gl.FLOAT, values);
  for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, which, exact ? gl.NEAREST : gl.LINEAR);
  if (coarser) {
    gl.generateMipmap(target);
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  }
  gl.texParameteri(target, gl.TEXTURE_WRAP_S, wraps ? gl.REPEAT : gl.CLAMP_TO_EDGE);
  gl.texParameteri(target, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return made;
}

/// A frame of `count` pictures of floats to draw in; that of light is added up by blending.
export function target(gl, width, height, count) {
  const frame = gl.createFramebuffer(), textures = [];
  const format = gl.getExtension("EXT_float_blend") !== null ? gl.RGBA32F : gl.RGBA16F;
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  for (let i = 0; i < count; ++i) {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
    for (const which of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, which, gl.CLAMP_TO_EDGE);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, made, 0);
    textures.push(made);
  }
  gl.drawBuffers(textures.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
  return { frame, textures, width, height };
}

export function drop_target(gl, old) {
  if (!old) return;
  for (const one of old.textures) gl.deleteTexture(one);
  gl.deleteFramebuffer(old.frame);
}

/// Binds textures to the units 0, 1 … and tells the program, by { name: [target, texture] }.
export function bind(gl, of, textures) {
  Object.entries(textures).forEach(([name, [kind, which]], unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(kind, which);
    gl.uniform1i(of.at(name), unit);
  });
}

/// Covers everything that is drawn on.
export const kEverywhere = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
