#!/usr/bin/env python3
"""Pages of `vegard export --web` in headless Chromium, from disk: their light against that of `vegard render`.

usage: live.py VEGARD SOURCE_FOLDER [--screenshots FOLDER] [--width PX] [SCENE.toml ...]
exit code 77 where Chromium or numpy is not installed

Every emission line's picture by the software driver differs from the program's by at most 3 % of its peak, as a root of
the mean square, and what the screen shows by at most 3 % of white. Scenes that are named are compared in place of the
test's own, which are small, at another width if one is given; the frame time is said.
"""

import base64
import json
import pathlib
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError:
    np = None

from chromium import Browser, chromium

MOST = 0.03  # of the peak
SMALL = """
[site]
latitude_deg = 67.0
longitude_deg = 20.0
{site}
[field]
{field}
[camera]
width = 240
height = 160
{camera}
[sensor]
gain_per_kilorayleigh = 0.05
[blur]
width_deg = [0.5, 0.3, 0.3]
{rest}
"""
UNIFORM = "inclination_deg = 77.0\ndeclination_deg = 6.0"
NORTH = "hfov_deg = 80.0\nazimuth_deg = 10.0\nelevation_deg = 25.0"
# Kinds of what is claimed: bands of a box in a reference field, as seen by a fish-eye; a shell from orbit in a dipole; a
# rayed sheet with an undulating border, in the air; a curve of varied energy that drifts and whose rays move, after a while.
SCENES = {
    "bands": SMALL.format(site='time_utc = "2013-09-18T20:00:00Z"', field='model = "igrf"', camera="""model = "equisolid"
focal_px = 130
azimuth_deg = 355
elevation_deg = 31""", rest="""[[footprint]]
center_km = [0, 150]
size_km = [900, 330]
cell_km = 1.5
width_km = 4
energy_kev = 4
energy_flux_mw_m2 = 30
east_km = [-400, -120, 60, 200, 400]
north_km = [60, -30, -60, -45, 10]
point_energy = [0.5, 1, 2, 1, 0.5]
"""),
    "shell": SMALL.format(site="altitude_m = 400e3", field='model = "dipole"', camera="""hfov_deg = 60.0
azimuth_deg = 8.0
elevation_deg = -20.0""", rest="""[[footprint]]
shape = "shell"
face_cells = 512
width_km = 40
energy_flux_mw_m2 = 10
latitude_deg = [72, 73, 74, 73, 72]
longitude_deg = [0, 15, 30, 45, 60]
"""),
    "rayed": SMALL.format(site="", field=UNIFORM, camera=NORTH, rest="""[air]
model = "standard"
[[sheet]]
form = "rayed_band"
center_km = [20.0, 200.0]
bearing_deg = 105.0
length_km = 500
points_per_px = 8
ibc = 3
"""),
    "curve": SMALL.format(site="", field=UNIFORM, camera=NORTH, rest="""[[sheet]]
course = "curve"
east_km = [-200, -50, 100, 250]
north_km = [160, 210, 180, 240]
point_energy_kev = [2, 3, 6, 4]
point_brightness = [0.6, 1, 1.2, 0.8]
width_km = 3
beams = 20000
drift_km_s = [1, -1.5]
ray_contrast = 0.4
ray_width_km = 10
ray_speed_km_s = 1
[emission]
lag = "none"
"""),
}
TIMES_S = {"curve": 20}  # at which a scene is compared; 0: the others
COLOURS = """(async png => { const image = new Image(); image.src = 'data:image/png;base64,' + png; await image.decode();
  const { width, height } = image, flat = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  const pixels = from => { flat.drawImage(from, 0, 0); return flat.getImageData(0, 0, width, height).data; };
  const expected = pixels(image), found = pixels(document.getElementById('view'));
  let sum = 0;
  for (let i = 0; i < found.length; ++i) sum += (found[i] - expected[i]) ** 2;
  window.off_of_white = Math.sqrt(sum / (0.75 * found.length)) / 255; })"""
COLUMNS = """(line => { const light = vegard.kilorayleighs(line); const bytes = new Uint8Array(light.buffer); let text = '';
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192)); return btoa(text); })"""


def at_width(vegard, scene, width_px):
    """Words that give the scene's picture another width; none for its own."""
    if width_px is None:
        return []
    said = subprocess.run([vegard, "params", scene, "--json"], check=True, capture_output=True, text=True).stdout
    values = {row["path"]: row["value"] for row in json.loads(said)["parameters"]}
    scale = width_px / int(values["camera.width"])
    changes = {"camera.width": width_px, "camera.height": round(int(values["camera.height"]) * scale)}
    if "pinhole" not in values["camera.model"]:
        changes["camera.focal_px"] = float(values["camera.focal_px"]) * scale
    return [word for path, value in changes.items() for word in ("--set", f"{path}={value}")]


def light_of_program(vegard, scene, words, folder):
    """Rayleighs by the lines' names, [row][column]."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python"))
    import exr

    subprocess.run([vegard, "render", scene, *words, "--quiet", "--overwrite", "--lines", folder / "lines.exr", "-o", folder / "shown.png"], check=True)
    return exr.read(folder / "lines.exr")


def rms_of_peak(found, expected):
    return float(np.sqrt(np.mean((found - expected) ** 2)) / expected.max())


def fly(browser):
    """What keys, the wheel and the mouse do. Complaints."""
    browser.value("vegard.state.holds = false, vegard.flight.reset(), 0")
    number = browser.value("vegard.state.drawn")
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key="e", code="KeyE", windowsVirtualKeyCode=69)
        until = time.monotonic() + 30
        while kind == "keyDown" and browser.value(f"vegard.flight.place_km[2] < 1 || vegard.state.drawn < {number + 2}"):
            if time.monotonic() > until:
                return ["E does not fly up"]
            time.sleep(0.02)
    x, y = browser.value("(box => [box.x + box.width / 2, box.y + box.height / 2])(document.getElementById('view').getBoundingClientRect())")
    before = browser.value("vegard.flight.azimuth_deg")
    for kind, at_x in (("mousePressed", x), ("mouseMoved", x + 60), ("mouseReleased", x + 60)):
        browser.call("Input.dispatchMouseEvent", type=kind, x=at_x, y=y, button="left", buttons=1, clickCount=1)
    browser.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-200)
    until = time.monotonic() + 30
    while not browser.value(f"vegard.flight.azimuth_deg !== {before} && vegard.flight.zoom > 1.2"):
        if time.monotonic() > until:
            return ["the mouse does not turn and zoom"]
        time.sleep(0.02)
    return []


def compare(browser, vegard, scene, words, folder, screenshots):
    time_s = TIMES_S.get(pathlib.Path(scene).stem, 0)
    runs = ["--seconds", str(time_s), "--instants", "2"] if time_s else []
    page = folder / "page.html"
    begun = time.monotonic()
    subprocess.run([vegard, "export", scene, *words, *runs, "--quiet", "--overwrite", "--web", page], check=True)
    exported_s = time.monotonic() - begun
    browser.open(page.as_uri(), 1000, "dark")
    until = time.monotonic() + 60
    while not browser.value("window.vegard !== undefined"):
        said = browser.value("document.getElementById('said').className === 'bad' ? document.getElementById('said').textContent : ''")
        if said or time.monotonic() > until:
            return [f"it does not begin: {said}"]
        time.sleep(0.02)
    size = browser.value("[vegard.view.camera.width, vegard.view.camera.height]")
    browser.value(f"vegard.state.time_s = {time_s}")
    frame_ms = browser.value(f"vegard.still({size[0]}, {size[1]})")
    lines = light_of_program(vegard, scene, [*words, "--set", f"time.start_s={time_s}"], folder)
    complaints, worst = [], 0.0
    for number, line_nm in enumerate(browser.value("vegard.view.lines_nm")):
        name = f"{line_nm} nm"
        expected = lines[f"rayleigh.{round(10 * line_nm)}"]
        found = 1e3 * np.frombuffer(base64.b64decode(browser.value(f"{COLUMNS}({number})")), "<f4").reshape(size[1], size[0])
        off = rms_of_peak(found, expected)
        worst = max(worst, off)
        if screenshots:
            print(f"  {name}: rms {100 * off:.2f} % of the peak {expected.max():.0f} R, sums {found.sum() / expected.sum():.3f}")
        if not off <= MOST:
            complaints.append(f"line {name}: rms {100 * off:.1f} % of the peak, sums {found.sum() / expected.sum():.3f}")
    shown = base64.b64encode((folder / "shown.png").read_bytes()).decode()
    browser.value(f"{COLOURS}('{shown}'), 0")
    while (of_white := browser.value("window.off_of_white")) is None:
        time.sleep(0.02)
    if not of_white <= MOST:
        complaints.append(f"colours: rms {100 * of_white:.1f} % of white")
    if screenshots:
        browser.screenshot(screenshots / f"live_{pathlib.Path(scene).stem}.png")
    for event in browser.events:
        what, said = event["method"], event["params"]
        if what == "Runtime.exceptionThrown" or (what == "Log.entryAdded" and said["entry"]["level"] == "error"):
            complaints.append(str(said)[:300])
        if what == "Network.requestWillBeSent" and not said["request"]["url"].startswith(("file:", "data:", "blob:")):
            complaints.append(f"it loads {said['request']['url'][:200]}")
    print(f"{pathlib.Path(scene).stem}: rms at most {100 * worst:.2f} % of a line's peak, {100 * of_white:.2f} % of white; page of {page.stat().st_size / 1e6:.1f} MB in {exported_s:.1f} s; "
          f"{size[0]} x {size[1]} in {frame_ms:.0f} ms")
    return complaints


def main(words):
    if chromium() is None or np is None:
        print("Chromium or numpy is not installed")
        return 77
    given = {}
    for option in ("--screenshots", "--width"):
        if option in words:
            at = words.index(option)
            given[option] = words[at + 1]
            del words[at:at + 2]
    screenshots = pathlib.Path(given["--screenshots"]).resolve() if "--screenshots" in given else None
    width_px = int(given["--width"]) if "--width" in given else None
    vegard, scenes = pathlib.Path(words[0]).resolve(), [pathlib.Path(name).resolve() for name in words[2:]]
    broken = 0
    with tempfile.TemporaryDirectory(prefix="vegard-live-test-") as name:
        folder = pathlib.Path(name).resolve()
        if not scenes:
            for called, text in SCENES.items():
                (folder / f"{called}.toml").write_text(text)
                scenes.append(folder / f"{called}.toml")
        browser = Browser(has_webgl=True)
        try:
            for scene in scenes:
                complaints = compare(browser, vegard, scene, at_width(vegard, scene, width_px), folder, screenshots)
                if scene == scenes[0]:
                    complaints += fly(browser)
                for complaint in complaints:
                    print(f"FAILED: {scene.stem}: {complaint}", file=sys.stderr)
                    broken += 1
        finally:
            browser.close()
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
