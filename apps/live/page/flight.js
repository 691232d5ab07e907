// Where the eye is and where it looks, and how keys and the mouse change that. Places are in km east, north and up of
// the ground below the scene's camera.

const kRadians = Math.PI / 180;

export class Flight {
  constructor(camera) {
    this.camera = camera;
    this.reset();
    this.held = new Set();
  }

  reset() {
    this.place_km = [0, 0, this.camera.altitude_km];
    this.azimuth_deg = this.camera.azimuth_deg;
    this.elevation_deg = this.camera.elevation_deg;
    this.roll_deg = this.camera.roll_deg;
    this.zoom = 1;
  }

  /// Right, down and forward in east, north and up, as the program's camera has them.
  axes() {
    const [a, e, r] = [this.azimuth_deg, this.elevation_deg, this.roll_deg].map(angle => angle * kRadians);
    const level = [Math.cos(a), -Math.sin(a), 0], up = [-Math.sin(a) * Math.sin(e), -Math.cos(a) * Math.sin(e), Math.cos(e)];
    return { right: level.map((x, i) => x * Math.cos(r) + up[i] * Math.sin(r)),
             down: up.map((x, i) => -(x * Math.cos(r) - level[i] * Math.sin(r))),
             forward: [Math.sin(a) * Math.cos(e), Math.cos(a) * Math.cos(e), Math.sin(e)] };
  }

  altitude_km(radius_km) {
    const [east, north, up] = this.place_km;
    return Math.hypot(east, north, up + radius_km) - radius_km;
  }

  /// As if the sky were dragged by a share of the picture's height.
  look(right, down) {
    const scale = 60 / this.zoom;
    this.azimuth_deg = (this.azimuth_deg - right * scale / Math.max(0.2, Math.cos(this.elevation_deg * kRadians)) + 720) % 360;
    this.elevation_deg = Math.max(-90, Math.min(90, this.elevation_deg + down * scale));
  }

  /// Moves by the keys that are held. Returns whether anything has changed.
  move(seconds, radius_km) {
    const held = key => (this.held.has(key) ? 1 : 0);
    const { right, forward } = this.axes();
    const ahead = held("KeyW") - held("KeyS"), aside = held("KeyD") - held("KeyA"), rise = held("KeyE") - held("KeyQ");
    const turn = held("ArrowRight") - held("ArrowLeft"), tilt = held("ArrowUp") - held("ArrowDown");
    if (!ahead && !aside && !rise && !turn && !tilt) return false;
    const speed = Math.max(20, 0.3 * this.altitude_km(radius_km)) * (held("ShiftLeft") || held("ShiftRight") ? 5 : 1);
    this.place_km = this.place_km.map((x, i) => x + seconds * speed * (ahead * forward[i] + aside * right[i] + (i === 2 ? rise : 0)));
    const below = this.altitude_km(radius_km);
    if (below < 0.001) this.place_km[2] += 0.001 - below;
    this.look(-turn * seconds, tilt * seconds);
    return true;
  }

  /// Listens to a canvas and to the page's keys; `changed` is called for what the mouse does.
  listen(canvas, changed) {
    const keys = new Set(["KeyW", "KeyA", "KeyS", "KeyD", "KeyE", "KeyQ", "ShiftLeft", "ShiftRight",
      "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"]);
    const is_typing = event => event.target.closest("input, button, a") !== null;
    document.addEventListener("keydown", event => {
      if (!keys.has(event.code) || is_typing(event) || event.ctrlKey || event.metaKey) return;
      this.held.add(event.code);
      event.preventDefault();
      changed();
    });
    document.addEventListener("keyup", event => this.held.delete(event.code));
    window.addEventListener("blur", () => this.held.clear());
    canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      this.look(event.movementX / canvas.clientHeight, event.movementY / canvas.clientHeight);
      changed();
    });
    canvas.addEventListener("wheel", event => {
      this.zoom = Math.max(0.3, Math.min(30, this.zoom * Math.exp(-event.deltaY / 500)));
      event.preventDefault();
      changed();
    }, { passive: false });
  }
}
