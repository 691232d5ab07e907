#!/usr/bin/env python3
"""A mask by hand in the studio, in headless Chromium: one part dragged with the mouse, one set by the keyboard, one taken back;
the mask is written, shown over the photograph, and taken by the measurement.

usage: studio_mask.py VEGARD SOURCE_FOLDER [SCREENSHOTS]     exit code 77 where Chromium is not installed
"""

import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

from chromium import Browser, chromium
from studio import SCHEMES, WIDTHS_PX, Page

LAYER = "document.querySelector('.mask-layer')"
SAID = "document.querySelector('.mask p[role=status]').textContent"
COMMAND = "document.querySelector('.mask code.command').textContent"
# Around the left end of the arc, of 720 x 480 pixels; its corners are those of a line that turns at each.
DRAGGED = [(20, 300), (60, 290), (100, 300), (140, 330), (150, 400), (120, 440), (60, 450), (15, 430), (10, 350)]
INSIDE, OUTSIDE = (80, 380), (300, 100)
PIXELS = """(async () => { const image = new Image(); image.src = 'file/source_mask.png?' + Math.random(); await image.decode();
  const canvas = document.createElement('canvas'); canvas.width = image.naturalWidth; canvas.height = image.naturalHeight;
  const context = canvas.getContext('2d'); context.drawImage(image, 0, 0);
  window.mask_at = (x, y) => context.getImageData(x, y, 1, 1).data[0];
  window.mask_size = [canvas.width, canvas.height]; })(), 0"""


def button(words):
    return f"[...document.querySelectorAll('.mask button')].find(button => button.textContent === '{words}')"


def make(page):
    page.browser.value(f"window.mask_size = undefined, {button('Make the mask')}.click(), 0")
    end = page.wait("[...document.querySelectorAll('.mask section p')].map(p => p.textContent).find(words => /^(Done|Ended|Refused|No|A file)/.test(words))",
                    "the mask is made")
    page.expect(end == "Done.", end)
    page.browser.value(PIXELS)
    page.wait("window.mask_size !== undefined", "the mask is a picture")
    page.expect(page.browser.value("window.mask_size") == [720, 480], "it is as large as the photograph")


def draw(page, screenshots):
    page.wait(f"{LAYER} !== null", "a mask can be drawn")
    page.browser.value(f"{button('Outline what is left out')}.click(), 0")
    page.mouse(LAYER, DRAGGED, "left")
    page.wait(SAID + ".startsWith('1 part is outlined')", "what is dragged around is outlined")
    # By the keyboard, from the middle of the picture: a triangle 144 px wide, of which a corner is set twice and taken back.
    page.tab_to("element.classList.contains('mask-layer')", "the photograph")
    page.press("Enter")
    page.press("ArrowRight", 10)
    page.press("Enter")
    page.press("ArrowDown", 5)
    page.press("Enter")
    page.press("ArrowUp", 3, shift=True)
    page.press("Enter")
    page.wait(SAID + ".includes('4 corners')", "the keyboard sets corners")
    page.press("Backspace")
    page.press("c")
    page.wait(SAID + ".startsWith('2 parts are outlined')", "the keyboard closes an outline")
    # A third part, by clicks, closed at its first corner; it is taken back whole, and a corner of a fourth.
    for place in ((500, 100), (560, 100), (560, 160), (500, 101)):
        page.mouse(LAYER, [place], "left")
    page.wait(SAID + ".startsWith('3 parts')", "clicks outline a part")
    page.browser.value(f"{button('Undo')}.click(), 0")
    page.wait(SAID + ".startsWith('2 parts')", "undone")
    page.mouse(LAYER, [(500, 100)], "left")
    page.wait(SAID + ".includes('1 corner of')", "a click sets a corner")
    page.browser.value(f"{button('Undo')}.click(), 0")
    page.wait(f"!{SAID}.includes('corner')", "a corner is taken back")
    command = page.browser.value(COMMAND)
    words = command.split(" --polygon ")
    page.expect(words[0] == "vegard mask source.jpg" and len(words) == 3 and words[2] == "360,240 504,240 504,312 -o source_mask.png", command)
    page.look("mask_drawn", screenshots)
    return command


def main(words):
    if chromium() is None:
        print("Chromium is not installed")
        return 77
    vegard, source = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve()
    screenshots = pathlib.Path(words[2]).resolve() if len(words) > 2 else None
    with tempfile.TemporaryDirectory(prefix="vegard-mask-test-") as name:
        folder = pathlib.Path(name).resolve()
        shutil.copy(source / "data/examples/h000/photo.jpg", folder / "source.jpg")
        shutil.copy(source / "data/examples/h000/scene.toml", folder / "camera.toml")
        studio = subprocess.Popen([vegard, "studio", "--no-browser"], cwd=folder, stdout=subprocess.PIPE, text=True)
        studio.stdout.readline()
        page = Page(Browser(), studio.stdout.readline().strip())
        try:
            page.browser.open(page.address + "#source.jpg", WIDTHS_PX[-1], SCHEMES[0])
            command = draw(page, screenshots)
            make(page)
            left_out = {place: page.browser.value(f"mask_at({place[0]}, {place[1]})") for place in (INSIDE, OUTSIDE, (470, 260), (380, 300), (530, 120))}
            page.expect(list(left_out.values()) == [0, 255, 0, 255, 255], f"black where it is outlined: {left_out}")
            # It is taken, shown, and made again with what vegard finds by itself.
            measures = "[...document.querySelectorAll('code.command')].map(code => code.textContent).find(words => words.startsWith('vegard measure'))"
            page.wait(measures + ".includes('--mask source_mask.png')", "the measurement takes the mask")
            page.wait("document.querySelector('.masked')?.naturalWidth === 720", "the mask is shown")
            page.look("mask_made", screenshots)
            page.browser.value("[...document.querySelectorAll('.mask label')].find(label => label.textContent === 'what is clipped').querySelector('input').click(), 0")
            page.expect(page.browser.value(COMMAND) == command.replace(" -o", " --saturated -o") + " --overwrite", page.browser.value(COMMAND))
            make(page)
            page.expect(page.browser.value(f"mask_at({INSIDE[0]}, {INSIDE[1]})") == 0, "the outlines stay")
            page.events()
        finally:
            page.browser.close()
            studio.send_signal(signal.SIGINT)
        page.expect(studio.wait(timeout=30) == 0, "Ctrl-C ends the studio well")
        # The commands that are to be copied take it: these give the same mask, and measure with it.
        copied = subprocess.run(f"exec '{vegard}' {command.removeprefix('vegard ')}".replace("source_mask", "copied"), shell=True, cwd=folder, capture_output=True, text=True, check=False)
        page.expect(copied.returncode == 0 and (folder / "copied.png").exists(), copied.stderr)
        measured = subprocess.run([vegard, "measure", "source.jpg", "--camera", "camera.toml", "--site", "64.8,-147", "--no-map", "--mask", "source_mask.png", "--out", "run"],
                                  cwd=folder, capture_output=True, text=True, check=False)
        page.expect(measured.returncode in (0, 5), measured.stderr)
        stages = json.loads((folder / "run/measure.json").read_text())["stages"] if (folder / "run/measure.json").exists() else []
        page.expect(any("--draw source_mask.png" in stage["command"] for stage in stages), "the measurement is of what the mask leaves")
    return 1 if page.broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
