"""What each subcommand does with --json and --quiet, when it colours, and what its help says of exit codes.

usage: terminal_habits.py VEGARD SOURCE_FOLDER, in an empty folder

A new subcommand fails here until it has a row in CALLS.
"""

import json
import math
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import time

VEGARD, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCENES = SOURCE / "tests" / "cli" / "scenes"
PHOTO = str(SOURCE / "data" / "examples" / "h000" / "photo.jpg")
FEW = ["--set", "sheet.main.beams=20"]
SMALL = ["--set", "camera.width=48", "--set", "camera.height=32"]
MAP = ["map", "map.toml", "--photo", "little.png", "--replicates", "2", "--sparsity", "16", *SMALL]
STARS = ["--size", "64,48", "--site", "65,20,100", "--time", "2020-01-01T20:00:00Z"]


# Exponents of units, moments, and formulas.
NO_NUMBERS = r"\^-?\d+|\d{4}-\d\d-\d\dT[\d:.]+Z|\d\d:\d\d|exp\(-1/2.*"


class Call:
    """words; the exit code; whether all that it says is the result that was asked for (else a summary of its files).

    free: numbers of the text that the object has in other words: of the clock, of names and sentences."""

    def __init__(self, words, code=0, result=False, free=r"(?!)"):
        self.words, self.code, self.result, self.free = words.split() if isinstance(words, str) else words, code, result, free


CALLS = {
    "render": Call(["render", "small.toml", "-o", "out.png", *FEW]),
    "animate": Call(["animate", "small.toml", "-o", "out/####.png", "--frames", "0:1", *FEW], free=r"out/\d+\.png"),
    "preview": Call(["preview", "small.toml", "-o", "out", "--frames", "2", "--size", "40x30"], free=r"median .*"),
    "studio": Call("studio --no-browser --idle 0.1", free=r".*"),
    "photometry": Call(
        "photometry counts.toml stars.pgm --filter green --camera camera.toml --exposure 200"
        " --time 2000-01-01T12:00:00Z --stars-out out.csv",
        free=r"\d+ of \d+ stars used|extinction: .*|left out: .*|note: .*",
    ),
    "points": Call(["points", "small.toml", "-o", "out.ply", *FEW]),
    "volume": Call(["volume", "small.toml", "-o", "out.vdb", "--voxel-km", "4", *FEW], free=r"8 x 8 x 8"),
    "export": Call(["export", "small.toml", "--web", "out.html", *FEW], free=r"left out: .*"),
    "describe": Call(["describe", PHOTO], result=True),
    "horizon": Call("horizon --size 600,400 --points 100,200 300,203 500,200 --hfov 53.13 -o out.toml"),
    "profile": Call(["profile", PHOTO, "-o", "out.csv", "--bands", "4"], free=r"decoding: .*"),
    "keogram": Call("keogram sky_20140221_193000.png sky_20140221_193010.png -o out.png"),
    "directions": Call("directions small.toml -o out.exr"),
    "map": Call([*MAP, "--out", "out"], code=5, free=r"\(.*\)|out/report\.html|peak \w+"),
    "border": Call(
        "border map.toml --set camera.width=360 --set camera.height=240 --photo wide.png --out out", free=r"Trace .*"
    ),
    "mask": Call(["mask", PHOTO, "-o", "out.png", "--polygon", "0,0", "360,0", "360,480", "0,480"], free=r"\d+\.\d+ %|decoding: .*"),
    "measure": Call("measure band.png --out out --no-map", code=5, free=r".*"),
    "brightness": Call(["brightness", "small.toml", *FEW], result=True, free=r"\(.*\)|[a-z ]*: .*|up to .* meet"),
    "calibrate": Call(["calibrate", "stars.csv", "-o", "out.toml", *STARS], free=r"note: .*|and \d+ more|BIC  .*|\(.*\) × 10.*|known to .*"),
    "fit": Call(
        ["fit", "fit.toml", "--photo", "a.png", "--out", "out", "--max-evaluations", "3", *FEW],
        code=4,
        free=r"\(.*\)|decoding: .*|^Not believable.*|^Failed.*|± .*|of \d+\.\d nm|^.*center_km.*",
    ),
    "compare": Call("compare run run", code=4, result=True, free=r".*divided by.*|AIC.*|  -?[\d.]+e.*| against .*|decoding: .*"),
    "sequence": Call(["sequence", "fit.toml", "--photos", "a.png", "-o", "out", "--max-evaluations", "3", *FEW], code=4, free=r".*"),
    "survey plan": Call("survey plan night/survey.toml -o out.json", free=r"about .* on one core"),
    "survey run": Call("survey run plan.json --out out"),
    "survey submit": Call("survey submit plan.json --out none --dry-run", result=True, free=r".*"),
    "survey status": Call("survey status shards", result=True),
    "survey merge": Call("survey merge shards -o out.sqlite"),
    "survey export": Call("survey export winter.sqlite -o out.csv"),
    "survey smooth": Call("survey smooth winter.sqlite -o out.sqlite"),
    "survey report": Call("survey report winter.sqlite -o out --no-keograms"),
    "track": Call("track maps --along track.csv --time 2014-03-10T06:05:33Z -o out.csv", result=True, free=r".*"),
    "to-netcdf": Call("to-netcdf run -o out.nc"),
    "to-gemini": Call("to-gemini maps --out out --time 2014-03-10T06:05:33Z --step-deg 0.1", free=r"out/.*"),
    "to-lompe": Call("to-lompe maps -o out.nc --time 2014-03-10T06:05:33Z --step-deg 0.1"),
    "grid": Call("grid a.pbrt -o out.vdb --blur 1", free=r"8 x 8 x 8"),
    "slices": Call("slices a.pbrt -o out.png"),
    "sdf": Call(["sdf", PHOTO, "-o", "out.exr", "--threshold", "0.3"], free=r"[\d.]+ % of them"),
    "linearise": Call("linearise p.pgm --rayleigh counts.toml --filter blue --exposure 2 -o out.fits"),
    "electrons": Call("electrons --energy-kev 1 -o out.csv", result=True, free=r"below 0.3 eV|Fang et al. 2010"),
    "atmosphere": Call("atmosphere --conditions winter_active -o out.csv", result=True, free=r"overtakes .*|O to N2.*"),
    "ionosphere": Call("ionosphere --energy-kev 3 --flux-mw-m2 8 -o out.nc", result=True, free=r".*"),
    "invert": Call(
        "invert --line 427.8=2300±50 --line 557.7=12400±300 --line 630.0=330±15 -o out.json", result=True, free=r".*"
    ),
    "triangulate": Call(
        "triangulate sights.csv --camera a.toml --camera b.toml --pointing-error 0.1 -o out.csv", result=True, free=r".*"
    ),
    "params": Call("params small.toml", result=True, free=r".*"),
    "bodies": Call("bodies", result=True, free=r"from: .*|400 km high"),
    "lines": Call("lines", result=True, free=r"lives .*|light: .*|doi:.*"),
    "manual": Call("manual render", result=True, free=r".*"),
}
# Only their help is looked at: one needs a cluster, the other half a minute of both cores.
WITHOUT_A_CALL = {"survey cancel", "tables"}


def fail(words):
    sys.exit(f"FAILED: {words}")


def run(words, **more):
    return subprocess.run(
        [VEGARD, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **more
    )


def made(words, code=0):
    """A call that makes what others need."""
    end = run(words)
    if end.returncode != code:
        fail(f"{words}: exit code {end.returncode} instead of {code}\n{end.stdout}{end.stderr}")


def make_inputs():
    for name in ("small.toml", "fit.toml", "map.toml"):
        shutil.copy(SCENES / name, name)
    made(["render", "small.toml", "-o", "a.png", *FEW])
    made(["render", str(SCENES / "map_light.toml"), "-o", "band.png"])
    made(["render", str(SCENES / "map_light.toml"), "-o", "little.png", *SMALL])
    made(["render", str(SCENES / "map_light.toml"), "-o", "wide.png", "--set", "camera.width=360", "--set", "camera.height=240"])
    for second in (0, 10):
        shutil.copy("a.png", f"sky_20140221_1930{second:02}.png")
    made(["fit", "fit.toml", "--photo", "a.png", "--out", "run", "--max-evaluations", "3", *FEW], 4)
    made([*MAP, "--out", "maps", "--set", "sensor.calibration_error=0.1"], 5)
    pathlib.Path("track.csv").write_text("time,lat,lon,alt\n2014-03-10T06:05:33Z,68.0,-0.5,460\n")
    pathlib.Path("counts.toml").write_text(
        'name = "made"\ndark_counts = 100.0\ngain_e_per_count = 1.0\n'
        '[[filter]]\nname = "green"\nline_nm = 557.7\nwidth_nm = 2.0\nwidth_error = 0.03\n'
        '[[filter]]\nname = "blue"\nline_nm = 427.8\nrayleigh_per_count_s = 69.8\nrayleigh_per_count_s_error = 3.49\n'
    )
    counts = b"".join((100 + 10 * i).to_bytes(2, "big") for i in range(16))
    pathlib.Path("p.pgm").write_bytes(b"P5 8 2 65535\n" + counts)
    subprocess.run(
        [sys.executable, SOURCE / "tests" / "cli" / "made_stars.py", SOURCE / "data" / "stars" / "bright_stars.csv"],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    # Twelve stars as an equidistant lens of 15 px to a radian sees them, axis to the zenith.
    rows = ["name,azimuth_deg,zenith_deg,x_px,y_px"]
    for i in range(12):
        azimuth, zenith = 77 * i % 360, 8 + 6 * i
        r, a = 15 * math.radians(zenith), math.radians(azimuth)
        rows.append(f"star {i},{azimuth},{zenith},{33 + r * math.sin(a):.6f},{23 + r * math.cos(a):.6f}")
    pathlib.Path("stars.csv").write_text("\n".join(rows) + "\n")
    # What a knot 118 km high over 68.8 N 20 E is in two all-sky pictures.
    for name, place in {"a.toml": (69.35, 20.36), "b.toml": (68.03, 21.69)}.items():
        pathlib.Path(name).write_text(
            f"[site]\nlatitude_deg = {place[0]}\nlongitude_deg = {place[1]}\n"
            '[camera]\nmodel = "equidistant"\nwidth = 1000\nheight = 1000\nfocal_px = 300.0\nelevation_deg = 90.0\n'
        )
    pathlib.Path("sights.csv").write_text("name,camera,x_px,y_px\nknot,1,465.5,354.3\nknot,2,358.2,680.5\n")
    pathlib.Path("a.pbrt").write_text(
        'Volume "volumegrid" "integer nx" [3] "integer ny" 3 "integer nz" [2]\n'
        '  "point p0" [10 20 700] "point p1" [16 26 704]\n'
        '  "float density" [ 0 0 0  0 1.5 0  0 0 0  0 0 0  0 0 0  0 0 0.25 ]\n'
    )
    os.mkdir("night")
    shutil.copy("map.toml", "night/scene.toml")
    for second in (0, 1):
        shutil.copy("band.png", f"night/20190301_22100{second}.png")
    pathlib.Path("night/survey.toml").write_text(
        '[survey]\nname = "night"\nwork = ["border"]\nscene = "scene.toml"\n[[camera]]\nname = "a"\nframes = ["."]\n'
    )
    made(["survey", "plan", "night/survey.toml", "-o", "plan.json"])
    made(["survey", "run", "plan.json", "--out", "shards"])
    made(["survey", "merge", "shards", "-o", "winter.sqlite"])


def outputs():
    """Everything that a call has left, by its bytes; a folder by its names."""
    found = {}
    for path in sorted(pathlib.Path(".").glob("out*")):
        found[path.name] = sorted(str(p) for p in path.rglob("*")) if path.is_dir() else None
    return found


def forget_outputs():
    for path in pathlib.Path(".").glob("out*"):
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def numbers_in(value):
    """All numbers of an object, also those in its words."""
    if isinstance(value, bool) or value is None:
        return
    if isinstance(value, (int, float)):
        yield float(value)
    elif isinstance(value, str):
        for word in re.findall(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?", value):
            yield float(word)
    else:
        for key in value if isinstance(value, dict) else ():
            yield from numbers_in(key)
        for one in value.values() if isinstance(value, dict) else value:
            yield from numbers_in(one)


def check_numbers(name, text, answer, free):
    """Each number of the text is in the object, rounded as the text has it; of per cent, kR, MW and the like the number without is enough."""
    known = list(numbers_in(answer))
    for line in text.splitlines():
        for word, unit in re.findall(r"(?<![\w.])([-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)(?![\w.]*\w)( %| [kM][RW]\b| mcd\b| [mµ]lx\b)?", re.sub(free, "", re.sub(NO_NUMBERS, "", line))):
            value = float(word)
            mantissa, _, exponent = word.partition("e")
            half = 0.5000001 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
            scales = (1.0, 100.0 if unit == " %" else {"k": 1e-3, "M": 1e-6, "m": 1e3, "µ": 1e6}.get(unit[1:2], 1.0))
            if not any(abs(scale * k - value) <= half for k in known for scale in scales):
                fail(f"{name} --json has no {word} of: {line}")


def check_call(name, call):
    forget_outputs()
    plain = run(call.words)
    if plain.returncode != call.code:
        fail(f"{name}: exit code {plain.returncode} instead of {call.code}\n{plain.stdout}{plain.stderr}")
    left = outputs()

    forget_outputs()
    asked = run([*call.words, "--json"])
    if asked.returncode != call.code:
        fail(f"{name} --json: exit code {asked.returncode} instead of {call.code}\n{asked.stderr}")
    try:
        answer = json.loads(asked.stdout)
    except ValueError as error:
        fail(f"{name} --json is no JSON: {error}\n{asked.stdout[:2000]}")
    if not isinstance(answer, dict) or not answer:
        fail(f"{name} --json is no object with something in it: {asked.stdout[:200]}")
    if outputs() != left:
        fail(f"{name} --json leaves {outputs()} instead of {left}")
    check_numbers(name, plain.stdout, answer, call.free)

    forget_outputs()
    quiet = run([*call.words, "--quiet"])
    if quiet.returncode != call.code:
        fail(f"{name} --quiet: exit code {quiet.returncode} instead of {call.code}\n{quiet.stderr}")
    if quiet.stdout != (plain.stdout if call.result else ""):
        fail(f"{name} --quiet says on the standard output: {quiet.stdout[:2000]}")
    if quiet.stderr:
        fail(f"{name} --quiet says on standard error: {quiet.stderr[:2000]}")
    if outputs() != left:
        fail(f"{name} --quiet leaves {outputs()} instead of {left}")
    forget_outputs()


def check_wrong_words(name, call):
    """One parser says so for all subcommands."""
    wrong = run([*call.words, "--quiet", "--nonsense"])
    if wrong.returncode != 2 or wrong.stdout or len(wrong.stderr.splitlines()) != 1:
        fail(f"{name} --quiet --nonsense: {wrong.returncode}, {wrong.stdout}{wrong.stderr}")


def leaves(command):
    for sub in command["subcommands"]:
        yield from leaves(sub) if sub["subcommands"] else [sub]


def check_exit_codes(manual, command):
    """In the help and on the page, all of them with their meanings."""
    words = command["name"].split() if command["name"] != "vegard" else []
    help_text = run([*words, "--help"]).stdout
    page = pathlib.Path("pages/man/man1", "-".join(["vegard", *words]) + ".1").read_text()
    for exit_code in manual["exit_codes"]:
        if not re.search(rf"^  {exit_code['code']} +{re.escape(exit_code['meaning'])}$", help_text, re.MULTILINE):
            fail(f"vegard {command['name']} --help has no exit code {exit_code['code']}")
        if f".B {exit_code['code']}\n" not in page:
            fail(f"the page of {command['name']} has no exit code {exit_code['code']}")
    for sub in command["subcommands"]:
        check_exit_codes(manual, sub)


def on_terminal(words, **environment):
    """What comes out of a terminal on which both streams are."""
    variables = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
    variables.update({"TERM": "xterm", **environment})
    process, terminal = pty.fork()
    if process == 0:
        os.execve(VEGARD, [VEGARD, *words], variables)
    text = b""
    while True:
        try:
            block = os.read(terminal, 4096)
        except OSError:
            break
        if not block:
            break
        text += block
    os.waitpid(process, 0)
    os.close(terminal)
    return text.decode(errors="replace")


def check_colours():
    wrong = ["render", "none.toml", "-o", "out.png"]
    border = ["border", "map.toml", "--set", "camera.width=360", "--set", "camera.height=240", "--photo", "dark.png", "--overwrite", "--out", "out"]
    made(["render", "map.toml", "-o", "dark.png", "--set", "camera.width=360", "--set", "camera.height=240"])
    red, yellow, plain = "\033[31mvegard:\033[0m ", "\033[33mno lower border was measured", "\033["
    if not on_terminal(wrong).startswith(red):
        fail(f"an error is not red on a terminal: {on_terminal(wrong)!r}")
    if yellow not in on_terminal(border):
        fail(f"a doubtful answer is not yellow on a terminal: {on_terminal(border)!r}")
    for variables in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
        for words in (wrong, border):
            if plain in on_terminal(words, **variables):
                fail(f"{words[0]} has colours with {variables}")
    if "\033[31m" not in on_terminal(wrong, NO_COLOR=""):
        fail("an empty NO_COLOR counts")
    for words in (wrong, border):
        end = run(words, env={**os.environ, "TERM": "xterm"})
        if plain in end.stdout + end.stderr:
            fail(f"{words[0]} has colours in a pipe")
    forget_outputs()


def main():
    manual = json.loads(run(["manual", "--json"]).stdout)
    if {e["code"] for e in manual["exit_codes"]} != {0, 1, 2, 3, 4, 5, 6, 129, 130, 143}:
        fail("other exit codes than the documentation has")
    names = {command["name"] for command in leaves(manual)}
    if names != set(CALLS) | WITHOUT_A_CALL:
        fail(f"subcommands without a row here, or rows without one: {names ^ (set(CALLS) | WITHOUT_A_CALL)}")
    for command in leaves(manual):
        options = {name for option in command["options"] for name in option["names"]}
        if not {"--json", "--quiet", "-q"} <= options:
            fail(f"{command['name']} has no --json, --quiet or -q")
    made(["manual", "-o", "pages"])
    check_exit_codes(manual, manual)
    make_inputs()
    broken = []
    wanted = os.environ.get("VEGARD_HABITS_OF")  # one by its name, for who works on it
    for name, call in CALLS.items():
        if wanted is not None and name not in wanted.split(","):
            continue
        try:
            begin = time.monotonic()
            check_call(name, call)
            print(f"{name}: {time.monotonic() - begin:.1f} s", file=sys.stderr)
        except SystemExit as end:
            broken.append(str(end))
    for name in ("render", "survey plan"):
        check_wrong_words(name, CALLS[name])
    check_colours()
    if broken:
        sys.exit("\n".join(broken))


main()
