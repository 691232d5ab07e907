// The scene's lens: which angle off the axis a place of the picture shows, by the program's table of radii.

const kSteps = 2048;

export class Lens {
  constructor(camera) {
    this.camera = camera;
    this.radius = camera.radius_px;
    this.last_radius_px = this.radius[this.radius.length - 1];
    this.angle_step = camera.last_angle_rad / (this.radius.length - 1);
    // The other way round, for even steps of the radius.
    this.angle = new Float32Array(kSteps);
    for (let i = 0, k = 0; i < kSteps; ++i) {
      const radius = i / (kSteps - 1) * this.last_radius_px;
      while (k < this.radius.length - 2 && this.radius[k + 1] < radius) ++k;
      this.angle[i] = (k + (radius - this.radius[k]) / Math.max(1e-9, this.radius[k + 1] - this.radius[k])) * this.angle_step;
    }
  }

  /// The pixel of a direction in camera axes (right, down, forward) at a zoom, and the solid angle of a pixel there;
  /// null where the lens shows nothing.
  pixel([right, down, forward], zoom) {
    const across = Math.hypot(right, down), angle = Math.atan2(across, forward), place = angle / this.angle_step;
    const i = Math.floor(place);
    if (i >= this.radius.length - 2) return null;
    const slope = (this.radius[i + 1] - this.radius[i]) / this.angle_step;
    const radius = this.radius[i] + (place - i) * this.angle_step * slope;
    const scale = across > 0 ? radius * zoom / across : 0, { camera } = this;
    const steradian = Math.sin(angle) / Math.max(1e-9, radius * slope) || 1 / slope ** 2;
    return { x: camera.principal_x_px + right * scale * camera.side, y: camera.principal_y_px + down * scale * camera.aspect,
             steradian: (angle < 1e-6 ? 1 / slope ** 2 : steradian) / (zoom * zoom * camera.aspect) };
  }
}

/// The direction of a fragment, for shaders that see through the lens: `is_seen` is false where it shows nothing.
export const kLensGlsl = `
uniform sampler2DArray lens;
uniform float px, last_radius, aspect, side, zoom, rows;
uniform vec2 principal;
uniform mat3 enu_from_camera;
vec3 direction_of_fragment(out bool is_seen) {
  vec2 place = vec2(gl_FragCoord.x, rows - gl_FragCoord.y) * px - principal;
  place = vec2(place.x * side, place.y / aspect) / zoom;
  float radius = length(place);
  is_seen = radius <= last_radius;
  float angle = texture(lens, vec3((radius / last_radius * ${(kSteps - 1).toFixed(1)} + 0.5) / ${kSteps.toFixed(1)}, 0.5, 0.0)).r;
  vec2 across = radius > 0.0 ? place / radius * sin(angle) : vec2(0.0);
  return enu_from_camera * vec3(across, cos(angle));
}
`;
