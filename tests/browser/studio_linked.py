#!/usr/bin/env python3
"""Photographs and maps linked in the studio, in headless Chromium: a map's photograph beside it, and two photographs of one arc
with their lines of sight. What is marked is compared with the geometry of a sphere, computed here.

usage: studio_linked.py VEGARD SOURCE_FOLDER [SCREENSHOTS]     exit code 77 where Chromium is not installed
"""

import math
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

from chromium import Browser, chromium
from studio import SCHEMES, WIDTHS_PX, Page

EARTH_KM, HEIGHT_KM = 6371.0, 105.0
GROUND, SAID = "document.querySelector('svg.ground')", "document.querySelector('.pointed').textContent"
ARC = """seed = 47
[site]
latitude_deg = {latitude}
longitude_deg = 20.0
[field]
model = "dipole"
[camera]
model = "equidistant"
width = 280
height = 280
focal_px = 90.0
elevation_deg = 90.0
[sensor]
gain_per_kilorayleigh = 0.05
[[sheet]]
form = "homogeneous_arc"
center_km = [0.0, {north}]
bearing_deg = 90.0
profile = "maxwellian"
energy_kev = 6.0
ibc = 2.5
"""
STATIONS = {"a": (67.0, 20.0, 110.0), "b": (66.280542, 20.0, 191.4)}


def photo(number):
    return f"document.querySelectorAll('.linked .picture svg')[{number}]"


def mark(layer):
    """Where the mark of a layer is, in its units; None without one."""
    return f"""(() => {{ const d = {layer}.querySelector('.cross').getAttribute('d'); if (!d) return null;
      const [x, y, wide] = d.match(/-?[\\d.]+(?:e-?\\d+)?/g).map(Number); return [x + wide / 2, y]; }})()"""


def dots(layer):
    """The marked heights of a layer's line of sight, and where they are."""
    return f"""Object.fromEntries([...{layer}.querySelectorAll('.sight circle')].map(dot => [dot.textContent,
      [Number(dot.getAttribute('cx')), Number(dot.getAttribute('cy'))]]))"""


def angle_to(elevation_deg, height_km):
    """Seen from the Earth's centre, from an observer on the sphere to what it sees at a height."""
    return math.radians(90 - elevation_deg) - math.asin(math.sin(math.radians(90 - elevation_deg)) * EARTH_KM / (EARTH_KM + height_km))


def elevation_of(angle, height_km):
    return math.degrees(math.atan2(math.cos(angle) - EARTH_KM / (EARTH_KM + height_km), math.sin(angle)))


def vector(latitude_deg, longitude_deg, height_km=0.0):
    lat, lon, r = math.radians(latitude_deg), math.radians(longitude_deg), EARTH_KM + height_km
    return [r * math.cos(lat) * math.cos(lon), r * math.cos(lat) * math.sin(lon), r * math.sin(lat)]


def seen_from(station, place):
    """The pixel of a camera that looks to the zenith: east is right, north is down."""
    latitude, longitude, _ = STATIONS[station]
    lat, lon = math.radians(latitude), math.radians(longitude)
    d = [p - q for p, q in zip(vector(*place), vector(latitude, longitude))]
    east = -math.sin(lon) * d[0] + math.cos(lon) * d[1]
    north = -math.sin(lat) * (math.cos(lon) * d[0] + math.sin(lon) * d[1]) + math.cos(lat) * d[2]
    up = math.cos(lat) * (math.cos(lon) * d[0] + math.sin(lon) * d[1]) + math.sin(lat) * d[2]
    level = math.hypot(east, north)
    theta = math.atan2(level, up)
    return [140 + 90 * theta * east / level, 140 + 90 * theta * north / level]


def place_at(station, pixel, height_km):
    """The place at a height that such a camera sees at a pixel."""
    latitude, longitude, _ = STATIONS[station]
    x, y = (pixel[0] - 140) / 90, (pixel[1] - 140) / 90
    theta = math.hypot(x, y)
    angle, azimuth = angle_to(90 - math.degrees(theta), height_km), math.atan2(x, y)
    lat = math.radians(latitude)
    there = math.asin(math.sin(lat) * math.cos(angle) + math.cos(lat) * math.sin(angle) * math.cos(azimuth))
    turn = math.atan2(math.sin(azimuth) * math.sin(angle) * math.cos(lat), math.cos(angle) - math.sin(lat) * math.sin(there))
    return math.degrees(there), longitude + math.degrees(turn), height_km


def near(page, found, expected, within, what):
    page.expect(found is not None and math.dist(found, expected) < within, f"{what}: {found} is not {expected}")


def on_a_map(page, screenshots):
    page.wait(f"{GROUND} !== null && document.querySelector('.linked img')?.naturalWidth === 96", "photograph and map side by side")
    # The camera stands at 67 degrees and looks north, 33 degrees high, with 60 degrees across 96 pixels.
    focal_px, north_km = 48 / math.tan(math.radians(30)), 186.0
    y_px = 32 - focal_px * math.tan(math.radians(elevation_of(north_km / EARTH_KM, HEIGHT_KM) - 33))
    page.mouse(GROUND, [(10, -100), (0, -north_km)])
    page.wait(SAID + ".startsWith('68.67°')", "a place of the map is told")
    near(page, page.browser.value(mark(photo(0))), [48, y_px], 0.5, "the place of the map in the photograph")
    # The band is there, and dark sky is 60 km farther south.
    said = page.browser.value(SAID)
    page.expect(re.search(r"energy flux [\d.e+-]+ \(relative\), [\d.]+ keV", said), said)
    flux = float(re.search(r"energy flux ([\d.e+-]+)", said)[1])
    page.mouse(GROUND, [(0, -126)])
    page.wait(SAID + ".startsWith('68.13°')", "another place")
    there = re.search(r"energy flux ([\d.e+-]+)", page.browser.value(SAID))
    page.expect(there and float(there[1]) < 0.3 * flux, f"the band's light is where it is: {flux}, {there and there[1]}")
    # And back, from the photograph.
    page.mouse(photo(0), [(30, 40), (48, y_px)])
    page.wait(SAID + ".includes('at 105 km: 68.6')", "a direction is told")
    near(page, page.browser.value(mark(GROUND)), [0, -north_km], 2.0, "the direction's place on the map")
    said = page.browser.value(SAID)
    page.expect(re.match(r"Azimuth (0|360)\.0\d°, elevation 2\d\.\d\d°; at 105 km: 68\.6\d° N, [-\d.]+° [EW], 2\d\d km away; energy flux", said), said)
    # By the keyboard: another height, then a line of sight, then none.
    page.tab_to("element.type === 'number'", "the height")
    page.browser.value("document.activeElement.select(), 0")
    for key in "120":
        page.press(key)
    page.tab_to("element.getAttribute('aria-label')?.startsWith('band.png')", "the photograph")
    page.press("ArrowUp", 3)
    page.press("ArrowDown", 2, shift=True)
    page.wait(f"{SAID}.includes('at 120 km') && Math.abs({mark(photo(0))}[1] - ({y_px} - 3 * 96 / 50 + 2 * 96 / 500)) < 0.01", "arrows move the mark")
    page.press("Enter")
    page.wait(f"Object.keys({dots(GROUND)}).length === 7", "its line of sight is on the map")
    page.press("Escape")
    page.wait(f"Object.keys({dots(GROUND)}).length === 0 && {mark(photo(0))} === null", "it is taken away")
    page.expect(page.browser.value("document.querySelectorAll('.linked .picture .curtain').length") > 0, "curtains are over the photograph")
    page.mouse(photo(0), [(48, y_px)], "left")
    page.wait(f"Object.keys({dots(GROUND)}).length === 7", "a click draws a line of sight")
    page.look("map_linked", screenshots)


def side_by_side(page, screenshots):
    page.browser.value("location.hash = 'both', 0")
    page.wait("[...document.querySelectorAll('.linked img')].filter(image => image.naturalWidth === 280).length === 2", "two photographs side by side")
    height_km = page.browser.value("Number(document.querySelector('.linked-view input').value)")
    page.expect(85 < height_km < 110, f"the height is that of the border: {height_km}")
    pixel = [170, 190]
    place = place_at("a", pixel, height_km)
    page.mouse(photo(0), [(160, 160), pixel])
    page.wait(SAID + f".includes('{place[0]:.2f}° N, {place[1]:.2f}° E')", f"the place is told: {place}")
    near(page, page.browser.value(mark(photo(1))), seen_from("b", place), 0.3, "the place in the other photograph")
    # A click: its line of sight in the other photograph and on the map, by height.
    page.mouse(photo(0), [pixel], "left")
    page.wait(f"Object.keys({dots(photo(1))}).length === 7", "the line of sight, 80 to 300 km")
    clicked = page.browser.value(mark(photo(0)))
    near(page, clicked, pixel, 1.0, "the click")  # clicks are at whole pixels of the screen
    pixel = clicked
    for words, found in page.browser.value(dots(photo(1))).items():
        near(page, found, seen_from("b", place_at("a", pixel, float(words.removesuffix(" km")))), 0.3, words)
    for words, (x, y) in page.browser.value(dots(GROUND)).items():
        latitude, longitude, _ = place_at("a", pixel, float(words.removesuffix(" km")))
        # The map is about the first camera; its distances from there are true.
        lat, lat0, turn = math.radians(latitude), math.radians(67.0), math.radians(longitude - 20.0)
        km = EARTH_KM * math.acos(math.sin(lat) * math.sin(lat0) + math.cos(lat) * math.cos(lat0) * math.cos(turn))
        page.expect(abs(math.hypot(x, y) - km) < 0.1 and abs(math.atan2(x, -y) - math.atan2(pixel[0] - 140, pixel[1] - 140)) < 1e-3, f"{words} on the map")
    page.look("pair", screenshots)
    # From the second photograph by the keyboard, and from the map.
    page.tab_to("element.getAttribute('aria-label')?.startsWith('b.png')", "the second photograph")
    page.press("Escape")
    page.press("ArrowDown", 4)
    page.press("Enter")
    page.wait(f"Object.keys({dots(photo(0))}).length > 0", "the second photograph's line of sight in the first")
    there = [140, 140 + 4 * 280 / 50]
    near(page, page.browser.value(mark(photo(0))), seen_from("a", place_at("b", there, height_km)), 0.3, "the other way round")
    page.mouse(GROUND, [(20, -90), (30, -110)], "none")
    page.wait(SAID + ".startsWith('67.9')", "a place of the map")
    latitude, longitude = (float(number) for number in re.match(r"([\d.]+)° N, ([\d.]+)° E", page.browser.value(SAID)).groups())
    for number, station in enumerate("ab"):  # told to 0.01 degrees
        near(page, page.browser.value(mark(photo(number))), seen_from(station, (latitude, longitude, height_km)), 0.8, f"the map's place in {station}")


def measured_together(page):
    """From the page: what it runs is what was run by hand for `both`, but for what only simulated skies need."""
    page.browser.value("location.hash = 'a.png', 0")
    page.wait("document.querySelector('h2').textContent === 'a.png' || document.querySelector('article h2')?.textContent === 'a.png'", "the photograph")
    put = """((name, value, number = 0) => { const input = [...document.querySelectorAll('.fields label')]
      .filter(label => label.textContent.startsWith(name) && label.closest('[hidden]') === null)[number].querySelector('input,select');
      input.value = value; input.dispatchEvent(new Event('input', { bubbles: true })); return input.value === value; })"""
    for name, value, number in (("Camera", "a.toml", 0), ("Time", "2014-02-21T19:30:40Z", 0), ("The same aurora", "b.png", 0), ("Camera", "b.toml", 1),
                                ("Time", "2014-02-21T19:30:43Z", 1), ("Place", "66.280542,20", 1)):
        page.expect(page.browser.value(f"{put}('{name}', '{value}', {number})"), f"{name} is {value}")
    command = page.browser.value("document.querySelector('code.command').textContent")
    page.expect(command == "vegard measure a.png b.png --time 2014-02-21T19:30:40Z --time 2014-02-21T19:30:43Z --site '' --site 66.280542,20 "
                "--camera a.toml --camera b.toml --out a_b_measured", command)
    page.browser.value("document.querySelector('button.first').click(), 0")
    end = page.wait("[...document.querySelectorAll('section p')].map(p => p.textContent).find(words => /^(Done|Ended|Refused|No|A file)/.test(words))",
                    "the measurement ends")
    page.expect(end.startswith("Done"), end)
    page.wait("document.querySelectorAll('.linked .picture svg').length === 2", "both photographs are shown")


def main(words):
    if chromium() is None:
        print("Chromium is not installed")
        return 77
    vegard, source = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve()
    screenshots = pathlib.Path(words[2]).resolve() if len(words) > 2 else None
    with tempfile.TemporaryDirectory(prefix="vegard-linked-test-") as name:
        folder = pathlib.Path(name).resolve()

        def made(codes, *command):
            end = subprocess.run([vegard, *command], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            if end.returncode not in codes:
                sys.exit(f"FAILED: {command}: exit code {end.returncode}\n{end.stdout}{end.stderr}")

        for scene in ("map.toml", "map_light.toml"):
            shutil.copy(source / "tests/cli/scenes" / scene, folder)
        made({0}, "render", "map_light.toml", "-o", "band.png")
        made({5}, "map", "map.toml", "--photo", "band.png", "--out", "band", "--replicates", "2", "--sparsity", "16")
        for station, (latitude, _, north) in STATIONS.items():
            scene = ARC.format(latitude=latitude, north=north)
            (folder / f"{station}.scene.toml").write_text(scene)
            (folder / f"{station}.toml").write_text(scene[scene.index("[site]"):scene.index("[field]")] + scene[scene.index("[camera]"):scene.index("[sensor]")])
            made({0}, "render", f"{station}.scene.toml", "-o", f"{station}.png")
        (folder / "sky.pgm").write_bytes(b"P5 280 280 255\n" + b"\xff" * (280 * 280))
        made({0, 5}, "measure", "a.png", "b.png", "--mask", "sky.pgm", "--mask", "sky.pgm", "--camera", "a.toml", "--camera", "b.toml", "--earth", "sphere",
             "--pointing-error", "0.05", "--time", "2014-02-21T19:30:40Z", "--time", "2014-02-21T19:30:43Z", "--out", "both")
        studio = subprocess.Popen([vegard, "studio", "--no-browser"], cwd=folder, stdout=subprocess.PIPE, text=True)
        studio.stdout.readline()
        page = Page(Browser(), studio.stdout.readline().strip())
        try:
            page.browser.open(page.address + "#band", WIDTHS_PX[-1], SCHEMES[0])
            on_a_map(page, screenshots)
            side_by_side(page, screenshots)
            measured_together(page)
            page.look("together", screenshots)
            page.events()
        finally:
            page.browser.close()
            studio.send_signal(signal.SIGINT)
        page.expect(studio.wait(timeout=30) == 0, "Ctrl-C ends the studio well")
    return 1 if page.broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
