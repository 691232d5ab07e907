#!/usr/bin/env python3
"""The studio's page in headless Chromium: a photograph is dropped and measured, a scene's slider moved, undone and saved.

usage: studio.py VEGARD SOURCE_FOLDER [SCREENSHOTS]     exit code 77 where Chromium is not installed

Its console is without errors, nothing is loaded but from the studio, and its text is readable as open_pages.py asks of reports,
at 400 and 1600 px, light and dark.
"""

import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.parse

from chromium import Browser, chromium
from open_pages import LOOK, SCHEMES

WIDTHS_PX = (400, 1600)
PATIENCE_S = 120.0
DROP = """fetch('file/source.jpg').then(answer => answer.blob()).then(bytes => {
  const data = new DataTransfer();
  data.items.add(new File([bytes], 'dropped.jpg'));
  document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
}); 0"""


class Page:
    def __init__(self, browser, address):
        self.browser, self.address, self.broken = browser, address, 0

    def wait(self, expression, what):
        """The value of the expression, once it is true."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            value = self.browser.value(expression)
            if value:
                return value
            time.sleep(0.05)
        sys.exit(f"FAILED: {what}: never true: {expression}\n{self.browser.value('document.body.innerText')}")

    def expect(self, is_right, what):
        if not is_right:
            self.broken += 1
            print(f"FAILED: {what}", file=sys.stderr)

    def press(self, key, times=1, shift=False):
        """A key, as a keyboard does."""
        code = {"Tab": 9, "Enter": 13, "Backspace": 8, "Escape": 27, " ": 32, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}.get(key, 0)
        text = {"Enter": {"text": "\r"}, " ": {"text": " "}}.get(key, {"text": key} if len(key) == 1 else {})
        for _ in range(times):
            for kind, more in (("keyDown", text), ("keyUp", {})):
                self.browser.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, modifiers=8 if shift else 0, **more)

    def tab_to(self, expression, what):
        """By the keyboard alone, to where the expression is true of the element in focus."""
        for _ in range(200):
            if self.browser.value(f"(element => {expression})(document.activeElement)"):
                return
            self.press("Tab")
        sys.exit(f"FAILED: the keyboard does not reach {what}")

    def mouse(self, layer, places, button="none"):
        """Moves the mouse over places in the units of a layer (SVG); with a button from the first place to the last with it
        pressed, or clicks if there is one."""
        self.browser.value(f"{layer}.scrollIntoView({{ block: 'center' }}), 0")
        at = self.browser.value(f"""(() => {{ const layer = {layer}; return {json.dumps(places)}.map(([x, y]) => {{
          const point = new DOMPoint(x, y).matrixTransform(layer.getScreenCTM()); return [point.x, point.y]; }}); }})()""")
        for i, (x, y) in enumerate(at):
            self.browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y, button=button if i else "none", buttons=int(button != "none" and i > 0))
            if button != "none" and i == 0:
                self.browser.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button=button, buttons=1, clickCount=1)
        if button != "none":
            self.browser.call("Input.dispatchMouseEvent", type="mouseReleased", x=at[-1][0], y=at[-1][1], button=button, clickCount=1)

    def look(self, what, screenshots):
        """All widths and schemes of what is in view now."""
        for width_px in WIDTHS_PX:
            for scheme in SCHEMES:
                self.browser.call("Emulation.setDeviceMetricsOverride", width=width_px, height=900, deviceScaleFactor=1, mobile=False)
                self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
                for found in self.browser.value(LOOK):
                    self.expect(False, f"{what}, {width_px} px, {scheme}: {found}")
                if screenshots:
                    self.browser.screenshot(screenshots / f"studio_{what}_{width_px}_{scheme}.png")

    def events(self):
        """Errors of the console and of scripts, and what was loaded from elsewhere."""
        here = urllib.parse.urlsplit(self.address).netloc
        for event in self.browser.events:
            what, words = event["method"], event["params"]
            if what == "Runtime.exceptionThrown" or (what == "Runtime.consoleAPICalled" and words["type"] in ("error", "assert")) or (
                    what == "Log.entryAdded" and words["entry"]["level"] == "error"):
                self.expect(False, f"{what}: {str(words)[:400]}")
            elif what == "Network.requestWillBeSent":
                asked = urllib.parse.urlsplit(words["request"]["url"])
                self.expect(asked.scheme in ("data", "blob") or asked.netloc == here, f"it loads {words['request']['url'][:200]}")


def photograph(page, screenshots):
    page.wait("document.querySelector('#files a') !== null", "the files are listed")
    page.browser.value(DROP)
    page.wait("location.hash === '#dropped.jpg' && document.querySelector('.picture img')?.naturalWidth > 0", "what was dropped is shown")
    page.wait("document.querySelector('pre').textContent.includes('720')", "what the file says")
    page.browser.value("""(() => {
      const put = (name, value) => { const input = [...document.querySelectorAll('.fields label')]
        .find(label => label.textContent.startsWith(name)).querySelector('input,select'); input.value = value;
        input.dispatchEvent(new Event('input', { bubbles: true })); };
      put('Place', '64.8,-147');
      put('Camera', 'camera.toml');
      document.querySelector('.fields input[type=checkbox]').click();
      return 0;
    })()""")
    command = page.wait("document.querySelector('code.command').textContent", "the command")
    page.expect(command == "vegard measure dropped.jpg --site 64.8,-147 --camera camera.toml --out dropped_measured --no-map", command)
    page.browser.value("document.querySelector('button.first').click(), 0")
    end = page.wait("[...document.querySelectorAll('section p')].map(p => p.textContent).find(words => /^(Done|Ended|Refused|No|A file)/.test(words))",
                    "the measurement ends")
    page.expect(end.startswith("Done"), end)
    page.expect("km away" in page.browser.value("document.querySelector('section pre').textContent"), "the answer is said")
    page.wait("document.querySelector('iframe')?.getAttribute('src') === 'file/dropped_measured/report.html'", "the report opens in place")
    time.sleep(1.0)  # of the frame's own loading, whose errors are to be seen
    page.look("photograph", screenshots)


def scene(page, screenshots):
    page.browser.value("location.hash = 'small.toml', 0")
    page.wait("/^picture/.test(document.querySelector('.picture img')?.getAttribute('src')) && document.querySelector('.picture img').naturalWidth === 160",
              "the scene's picture in full")
    commands = "document.querySelector('code.command').textContent"
    page.expect(page.browser.value(commands) == "vegard render small.toml -o picture.png", page.browser.value(commands))
    page.browser.value("""(() => { const slider = document.querySelector('input[type=range][aria-label="sheet.main.energy_kev"]');
      slider.value = 0.9; slider.dispatchEvent(new Event('input')); return 0; })()""")
    page.wait(commands + ".includes('--set sheet.main.energy_kev=')", "the slider's value is in the command")
    before = page.browser.value("document.querySelector('.picture img').src")
    page.wait(f"document.querySelector('.picture img').src !== '{before}'", "the picture follows")
    page.browser.value("[...document.querySelectorAll('button')].find(button => button.textContent === 'Save').click(), 0")
    page.wait("document.body.innerText.includes('Saved as small_changed.toml')", "the changed scene is saved")
    page.browser.value("[...document.querySelectorAll('button')].find(button => button.textContent === 'Undo').click(), 0")
    page.wait(commands + " === 'vegard render small.toml -o picture.png'", "undone")
    page.browser.value("[...document.querySelectorAll('button')].find(button => button.textContent === 'Fly through it').click(), 0")
    page.wait("/^picture/.test(document.querySelector('iframe.live')?.getAttribute('src'))", "the live view is made")
    page.expect(page.browser.value("[...document.querySelectorAll('code.command')].some(code => code.textContent === 'vegard export small.toml --web small.html')"),
                "the command of the live view is shown")
    time.sleep(1.0)  # of the frame's own loading
    # A value that the scene does not allow is said by name.
    page.browser.value("""(() => { const box = document.getElementById('p-sheet.main.energy_kev');
      box.value = '-4'; box.dispatchEvent(new Event('change')); return 0; })()""")
    page.wait("document.querySelector('p.bad')?.textContent.includes('energy_kev')", "a bad value is refused")
    page.look("scene", screenshots)


def keyboard(page):
    """Tab and Enter alone open a file."""
    page.browser.value("location.hash = '', document.body.focus(), 0")
    page.wait("document.querySelector('#view h2')?.textContent.includes('Drop')", "the first page")
    page.tab_to("element.textContent === 'small.toml'", "a scene")
    page.press("Enter")
    page.wait("location.hash === '#small.toml'", "the keyboard opens a scene")


def main(words):
    if chromium() is None:
        print("Chromium is not installed")
        return 77
    vegard, source = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve()
    screenshots = pathlib.Path(words[2]).resolve() if len(words) > 2 else None
    with tempfile.TemporaryDirectory(prefix="vegard-studio-test-") as name:
        folder = pathlib.Path(name).resolve()
        shutil.copy(source / "data/examples/h000/photo.jpg", folder / "source.jpg")
        shutil.copy(source / "data/examples/h000/scene.toml", folder / "camera.toml")
        shutil.copy(source / "tests/cli/scenes/small.toml", folder)
        studio = subprocess.Popen([vegard, "studio", "--no-browser"], cwd=folder, stdout=subprocess.PIPE, text=True)
        studio.stdout.readline()
        page = Page(Browser(), studio.stdout.readline().strip())
        try:
            page.browser.open(page.address, WIDTHS_PX[-1], SCHEMES[0])
            photograph(page, screenshots)
            scene(page, screenshots)
            keyboard(page)
            page.events()
        finally:
            page.browser.close()
            studio.send_signal(signal.SIGINT)
        page.expect(studio.wait(timeout=30) == 0, "Ctrl-C ends the studio well")
        page.expect((folder / "dropped_measured/measure.json").exists() and (folder / "small_changed.toml").exists(), "what was made is in the folder")
    return 1 if page.broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
