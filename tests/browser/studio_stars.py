#!/usr/bin/env python3
"""Stars by hand in the studio, in headless Chromium: one is dropped, one added by its name among the nearest, and the camera
calibrated from what is left; then two alone, of a photograph in which none were recognised.

usage: studio_stars.py VEGARD SOURCE_FOLDER [SCREENSHOTS]     exit code 77 where Chromium is not installed
"""

import json
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import urllib.request
import zlib

from chromium import Browser, chromium
from studio import SCHEMES, WIDTHS_PX, Page

CIRCLE = "[...document.querySelectorAll('svg circle')].find(circle => circle.textContent.startsWith('{}'))"
COMMAND = "[...document.querySelectorAll('code.command')].map(code => code.textContent).find(words => words.startsWith('vegard calibrate'))"


def png_of_pgm(file):
    """A PGM of two bytes a pixel as PNG, which browsers know."""
    head, width, height, most, rest = file.read_bytes().split(None, 4)
    assert head == b"P5" and most == b"65535"
    width, height = int(width), int(height)
    rows = b"".join(b"\0" + rest[2 * width * y : 2 * width * (y + 1)] for y in range(height))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)), (b"IDAT", zlib.compress(rows, 1)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks)


def click(page, x_px, y_px):
    """Where the picture has this pixel."""
    page.browser.value(f"""(() => {{ const layer = document.querySelector('.picture svg');
      layer.scrollIntoView({{ block: 'start' }});
      const at = new DOMPoint({x_px}, {y_px}).matrixTransform(layer.getScreenCTM());
      document.elementFromPoint(at.x, at.y).dispatchEvent(new MouseEvent('click', {{ bubbles: true, clientX: at.x, clientY: at.y }})); return 0; }})()""")


def run_it(page):
    page.browser.value("[...document.querySelectorAll('button')].find(button => button.textContent === 'Calibrate with these stars').click(), 0")
    end = page.wait("[...document.querySelectorAll('section p')].map(p => p.textContent).find(words => /^(Done|Ended|Refused|No|A file)/.test(words))",
                    "the calibration ends")
    page.expect(end.startswith("Done"), end + page.browser.value("[...document.querySelectorAll('pre')].map(pre => pre.textContent).join('\\n')"))


def main(words):
    if chromium() is None:
        print("Chromium is not installed")
        return 77
    vegard, source = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve()
    screenshots = pathlib.Path(words[2]).resolve() if len(words) > 2 else None
    with tempfile.TemporaryDirectory(prefix="vegard-stars-test-") as name:
        folder = pathlib.Path(name).resolve()
        subprocess.run([sys.executable, source / "tests/cli/made_stars.py", source / "data/stars/bright_stars.csv"], cwd=folder, check=True)
        (folder / "night.png").write_bytes(png_of_pgm(folder / "stars.pgm"))
        (folder / "other.png").write_bytes((folder / "night.png").read_bytes())
        run = folder / "night_measured"
        run.mkdir()
        (run / "report.html").write_text("<!doctype html><title>made</title>")
        (run / "camera.toml").write_text((folder / "camera.toml").read_text().replace("[camera]", 'time_utc = "2000-01-01T12:00:00Z"\n[camera]'))
        studio = subprocess.Popen([vegard, "studio", "--no-browser"], cwd=folder, stdout=subprocess.PIPE, text=True)
        studio.stdout.readline()
        page = Page(Browser(), studio.stdout.readline().strip())
        try:
            # Its recognised stars are those of the catalogue where its camera has them, one of them left out.
            with urllib.request.urlopen(page.address + "sky?camera=night_measured/camera.toml") as answer:
                sky = [star for star in json.load(answer)["stars"] if star[1] < 3.0]
            found = {star[0]: star[2:] for star in sky}
            rows = [f"{star},{magnitude},{x},{y},{int(star != 'Rigel')}" for star, magnitude, x, y in sky]
            (run / "stars.csv").write_text("\n".join(["# made", "name,magnitude,x_px,y_px,used", *rows, ""]))
            page.browser.open(page.address + "#night.png", WIDTHS_PX[-1], SCHEMES[0])
            page.wait(CIRCLE.format("Vega,") + " !== undefined", "the recognised stars are shown")
            click(page, *found["Vega"])
            page.wait(CIRCLE.format("Vega,") + ".classList.contains('dropped')", "a click drops a star")
            # Deneb is dropped, and added again a pixel off.
            click(page, *found["Deneb"])
            page.wait("document.querySelectorAll('circle.dropped').length === 3", "a second is dropped")
            x_px, y_px = found["Deneb"][0] + 8.0, found["Deneb"][1]
            click(page, x_px, y_px)
            page.wait("[...document.querySelectorAll('button')].some(button => /^Deneb \\(/.test(button.textContent))", "its name is among the nearest")
            page.browser.value("[...document.querySelectorAll('button')].find(button => /^Deneb \\(/.test(button.textContent)).click(), 0")
            page.wait("document.querySelectorAll('circle.mine').length === 1", "it is added")
            page.look("stars", screenshots)
            run_it(page)
            command = page.browser.value(COMMAND)
            page.expect(command == "vegard calibrate night_stars.csv --image night.png --time 2000-01-01T12:00:00Z --exposure 0 --site 65,150,0 -o night_camera.toml", command)
            rows = (folder / "night_stars.csv").read_text().splitlines()
            page.expect(not any(row.endswith(",Vega") for row in rows), "the dropped star is not in the table")
            mine = [[float(number) for number in row.split(",")[:2]] for row in rows if row.endswith(",Deneb")]
            page.expect(len(mine) == 1 and abs(mine[0][0] - x_px) < 1.0 and abs(mine[0][1] - y_px) < 1.0, f"the added star is where it was clicked: {mine}")
            page.expect((folder / "night_camera.toml").exists(), "the camera is written")
            # Without a calibration: names are typed, and the program recognises the others.
            page.browser.value("location.hash = 'other.png', 0")
            page.wait("document.querySelector('#view h2')?.textContent === 'other.png' && document.querySelector('.picture svg') !== null", "the other photograph is shown")
            for star in ("Vega", "Capella", "Deneb"):
                click(page, *found[star])
                page.wait("document.querySelector('input[placeholder^=Vega]') !== null", "it asks for a name")
                page.browser.value(f"""(() => {{ const box = document.querySelector('input[placeholder^=Vega]'); box.value = '{star}';
                  box.dispatchEvent(new KeyboardEvent('keydown', {{ key: 'Enter' }})); return 0; }})()""")
            page.browser.value("""(() => { for (const [name, value] of [['Time', '2000-01-01T12:00:00Z'], ['Place', '65,150,0']]) {
                const input = [...document.querySelectorAll('.fields label')].find(label => label.textContent.startsWith(name)).querySelector('input');
                input.value = value; } return 0; })()""")
            run_it(page)
            page.expect((folder / "other_camera.toml").exists(), "the other camera is written")
            page.events()
        finally:
            page.browser.close()
            studio.send_signal(signal.SIGINT)
        page.expect(studio.wait(timeout=30) == 0, "Ctrl-C ends the studio well")
    return 1 if page.broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
