#!/usr/bin/env python3
"""Every kind of page that vegard writes, in headless Chromium: narrow and wide, light and dark.

usage: open_pages.py VEGARD SOURCE_FOLDER [SCREENSHOTS]     exit code 77 where Chromium is not installed

Asked of each page: no error on its console, nothing loaded that is not beside it, no wider than the window, nothing that sticks out
of its box, all text readable on its ground (a contrast of 4.5, of large text 3: WCAG 2.1, 1.4.3).
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

from chromium import Browser, chromium

WIDTHS_PX = (400, 1100, 1600)
SCHEMES = ("light", "dark")

LOOK = r"""
(() => {
  for (const details of document.querySelectorAll('details')) details.open = true;
  const found = [];
  const told = (element) => {
    const words = (element.textContent || '').trim().replace(/\s+/g, ' ').slice(0, 60);
    return `<${element.tagName.toLowerCase()} class="${element.getAttribute('class') || ''}"> ${words}`;
  };
  const root = document.documentElement;
  if (root.scrollWidth > window.innerWidth) found.push(`is ${root.scrollWidth} px wide in ${window.innerWidth}`);
  const parse = (text) => {
    const numbers = (text.match(/[\d.]+/g) || []).map(Number);
    return numbers.length < 3 ? null : [numbers[0], numbers[1], numbers[2], numbers.length > 3 ? numbers[3] : 1];
  };
  const over = (top, ground) => [0, 1, 2].map((i) => top[3] * top[i] + (1 - top[3]) * ground[i]).concat(1);
  const luminance = (colour) => {
    const [r, g, b] = colour.map((c) => { const s = c / 255; return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4; });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  // What lies behind an element: all backgrounds from the page's up.
  const ground = (element) => {
    const layers = [];
    let opacity = 1;
    for (let one = element; one; one = one.parentElement) {
      const style = getComputedStyle(one);
      const colour = parse(style.backgroundColor);
      if (colour && colour[3] > 0) layers.push(colour);
      opacity *= Number(style.opacity);
    }
    const scheme = getComputedStyle(root).colorScheme;
    const dark = scheme.includes('dark') && matchMedia('(prefers-color-scheme: dark)').matches;
    return [layers.reverse().reduce((below, layer) => over(layer, below), dark ? [18, 18, 18, 1] : [255, 255, 255, 1]), opacity];
  };
  for (const element of document.body.querySelectorAll('*')) {
    const style = getComputedStyle(element);
    if (style.display === 'none' || style.visibility === 'hidden' || element.tagName === 'title') continue;
    const inSvg = element.namespaceURI.endsWith('svg');
    if (!inSvg && style.display !== 'inline' && style.overflowX === 'visible' && element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0)
      found.push(`${element.scrollWidth} px in a box of ${element.clientWidth}: ${told(element)}`);
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!own) continue;
    const [behind, opacity] = ground(inSvg ? element.closest('svg') : element);
    let ink = parse(inSvg ? style.fill : style.color);
    if (!ink) continue;
    ink = over([ink[0], ink[1], ink[2], ink[3] * opacity], behind);
    const [a, b] = [luminance(ink), luminance(behind)].sort((x, y) => y - x);
    const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < (large ? 3 : 4.5)) found.push(`a contrast of ${contrast.toFixed(2)}: ${told(element)}`);
  }
  return found;
})()
"""


def complaints(browser, page, width_px, scheme, screenshot=None):
    browser.open(page.as_uri(), width_px, scheme)
    found = browser.value(LOOK)
    if screenshot:
        browser.screenshot(screenshot)
    for event in browser.events:
        what, words = event["method"], event["params"]
        if what == "Runtime.consoleAPICalled" and words["type"] in ("error", "assert"):
            found.append(f"its console has: {words['args']}")
        elif what == "Runtime.exceptionThrown":
            found.append(f"its script fails: {words['exceptionDetails']['text']}")
        elif what == "Log.entryAdded" and words["entry"]["level"] == "error":
            found.append(f"its log has: {words['entry']['text']} {words['entry'].get('url', '')}")
        elif what == "Network.requestWillBeSent":
            address = urllib.parse.urlsplit(words["request"]["url"])
            beside = address.scheme == "file" and page.parent in pathlib.Path(urllib.parse.unquote(address.path)).parents
            if address.scheme != "data" and not beside:
                found.append(f"it loads {words['request']['url'][:200]}")
    return found


BAD_PAGES = {
    "loads a picture": '<img src="https://none.example/x.png">',
    "loads what is not beside it": '<link rel="stylesheet" href="file:///none.css">',
    "has no picture": '<img src="none.png">',
    "fails": "<script>none();</script>",
    "tells an error": "<script>console.error('no');</script>",
    "is too wide": '<div style="width:2000px">x</div>',
    "has a word that sticks out": '<div style="width:90px">105.942&nbsp;±&nbsp;0.044&nbsp;km</div>',
    "is pale": '<p style="color:#999">pale</p>',
    "is pale over a colour": '<div style="background:#00000080"><p style="color:#333">pale</p></div>',
    "has a pale plot": '<svg width="90" height="30" style="background:#fff"><text y="20" fill="#ddd">pale</text></svg>',
}


def self_check(browser, folder):
    """Whether each fault is noticed, and none where there is none."""
    page = folder / "page.html"
    head = '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>x</title></head><body style="background:#fff;color:#222">'
    for name, body in {"": "<p>Sound.</p>", **BAD_PAGES}.items():
        page.write_text(head + body + "</body></html>")
        found = complaints(browser, page, 1600, "light")
        if bool(found) != bool(name):
            sys.exit(f"FAILED: of a page that {name or 'is sound'} is said: {found}")


def made(vegard, folder, words, codes):
    end = subprocess.run([vegard, *map(str, words)], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if end.returncode not in codes:
        sys.exit(f"FAILED: {words}: exit code {end.returncode}\n{end.stdout}{end.stderr}")


def make_pages(vegard, source, folder):
    """A page of each kind, and the name that says which."""
    scenes = source / "tests" / "cli" / "scenes"
    example = source / "data" / "examples" / "h000"
    wide = ["--set", "camera.width=216", "--set", "camera.height=144"]
    made(vegard, folder, ["render", scenes / "small.toml", "-o", "a.png"], {0})
    made(vegard, folder, ["render", scenes / "map_light.toml", "-o", "band.png"], {0})
    made(vegard, folder, ["render", scenes / "map_light.toml", *wide, "-o", "wide.png"], {0})
    made(vegard, folder, ["render", scenes / "map.toml", *wide, "-o", "dark.png"], {0})
    made(vegard, folder, ["fit", example / "scene.toml", "--photo", example / "photo.jpg", "--out", "good", "--intervals"], {0})
    validation = ["--bootstrap", "100", "--mcmc", "40", "--stability"]
    made(vegard, folder, ["fit", scenes / "fit.toml", "--photo", "a.png", "--out", "validated", *validation], {0, 5})
    made(vegard, folder, ["fit", scenes / "fit.toml", "--photo", "a.png", "--out", "failed", "--max-evaluations", "3"], {4})
    two = (scenes / "fit.toml").read_text() + '\n[[fit.photo]]\nname = "one"\nfile = "a.png"\n[[fit.photo]]\nname = "two"\nfile = "a.png"\n'
    (folder / "two.toml").write_text(two)
    made(vegard, folder, ["fit", "two.toml", "--out", "two"], {0, 5})
    made(vegard, folder, ["sequence", scenes / "fit.toml", "--photos", "a.png", "-o", "sequence", "--max-evaluations", "3"], {4, 5})
    made(vegard, folder, ["map", scenes / "map.toml", "--photo", "band.png", "--out", "map", "--replicates", "2", "--sparsity", "16"], {5})
    made(vegard, folder, ["border", scenes / "map.toml", *wide, "--photo", "wide.png", "--out", "border"], {0, 5})
    made(vegard, folder, ["border", scenes / "map.toml", *wide, "--photo", "dark.png", "--out", "dark"], {5})
    (folder / "camera.toml").write_text(
        "[camera]\n" + (scenes / "map.toml").read_text().split("[camera]")[1].split("\n[")[0]
        .replace("width = 96", "width = 216").replace("height = 64", "height = 144") + "\n")
    known = ["--camera", "camera.toml", "--site", "67,20"]
    made(vegard, folder, ["measure", "wide.png", *known, "--replicates", "2", "--out", "measured"], {0, 5})
    made(vegard, folder, ["measure", "dark.png", "--out", "bare"], {5})
    night = folder / "night"
    night.mkdir()
    shutil.copy(scenes / "fit.toml", night / "scene.toml")
    for second in range(3):
        shutil.copy(folder / "a.png", night / f"20190301_22100{second}.png")
    (night / "survey.toml").write_text(
        '[survey]\nname = "night"\nwork = ["border", "fit"]\nscene = "scene.toml"\n[[camera]]\nname = "a"\nframes = ["."]\n')
    made(vegard, folder, ["survey", "plan", "night/survey.toml", "-o", "plan.json"], {0})
    made(vegard, folder, ["survey", "run", "plan.json", "--out", "shards"], {0})
    made(vegard, folder, ["survey", "merge", "shards", "-o", "all.sqlite"], {0})
    made(vegard, folder, ["survey", "smooth", "all.sqlite", "-o", "moving.sqlite"], {0})
    made(vegard, folder, ["survey", "report", "moving.sqlite", "--plan", "plan.json", "-o", "survey"], {0})
    kept = {"good", "validated", "failed", "two", "sequence", "map", "border", "dark", "measured", "bare", "survey"}
    pages = sorted(folder.glob("**/*.html"))
    lacking = kept - {page.relative_to(folder).parts[0] for page in pages}
    if lacking:
        sys.exit(f"FAILED: there is no page of {sorted(lacking)}")
    return pages


def main(words):
    if chromium() is None:
        print("Chromium is not installed")
        return 77
    vegard, source = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1]).resolve()
    screenshots = pathlib.Path(words[2]).resolve() if len(words) > 2 else None
    broken = 0
    with tempfile.TemporaryDirectory(prefix="vegard-pages-") as name:
        folder = pathlib.Path(name).resolve()
        pages = make_pages(vegard, source, folder)
        browser = Browser()
        try:
            (folder / "check").mkdir()
            self_check(browser, folder / "check")
            for page in pages:
                called = "_".join(page.relative_to(folder).with_suffix("").parts)
                for width_px in WIDTHS_PX:
                    for scheme in SCHEMES:
                        shot = screenshots / f"{called}_{width_px}_{scheme}.png" if screenshots else None
                        found = complaints(browser, page, width_px, scheme, shot)
                        for words_ in found:
                            print(f"FAILED: {page.relative_to(folder)}, {width_px} px, {scheme}: {words_}", file=sys.stderr)
                        broken += len(found)
        finally:
            browser.close()
    print(f"{len(pages)} pages, {len(WIDTHS_PX) * len(SCHEMES)} times each: {broken} complaints")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
