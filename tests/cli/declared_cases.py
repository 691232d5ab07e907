"""Files that declare things about their light, their frame and their units, against what was put into them.

usage: declared_cases.py VEGARD SOURCE_FOLDER, in an empty folder

Each table has thirty files or more of random values (seed 45). Tolerances: 16 bits are right to 2e-5, the numbers of
an ICC profile and of PNG's chunks to 1.5e-5, which a matrix may double: 2e-4. A JPEG of 8 bits is right to a code and
a half in each colour. The small inputs of shared/cases (VEGARD_CASES) are looked at where they are.
"""

import csv
import json
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import zlib

from declared_files import (ADOBE, P3, REC2020, SRGB, apply, fits_image, fits_of, header, icc, inverse, png, srgb_decode,
                            srgb_encode, tiff, to_srgb)

VEGARD, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
CASES = pathlib.Path(os.environ.get("VEGARD_CASES", SOURCE.parent / "shared/cases"))
PHOTOS = pathlib.Path(os.environ.get("VEGARD_PHOTOS", SOURCE.parent / "shared/photos"))
rng = random.Random(45)
failures, counts = [], {}


def part(count):
    """Of so many made files all, or the first quarter where VEGARD_DECLARED is not "whole"."""
    return count if os.environ.get("VEGARD_DECLARED") == "whole" else max(3, count // 4)


def run(*words):
    done = subprocess.run([VEGARD, *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


def require(kind, about, ok, seen=""):
    counts[kind] = counts.get(kind, 0) + 1
    if not ok:
        failures.append(f"{kind}: {about}: {seen}")


def near(kind, about, found, right, tolerance):
    ok = found is not None and len(found) == len(right) and all(abs(f - r) <= tolerance for f, r in zip(found, right))
    require(kind, about, ok, f"found {found}, right is {right}")


def light(file, *options):
    """Mean red, green, blue of a picture's rows; a message in their place if it is refused."""
    code, _, words = run("profile", file, "-o", "light.csv", "--overwrite", *options)
    if code != 0:
        return None, f"exit {code}: {words}"
    table = [row for row in csv.reader(open("light.csv")) if row and not row[0].startswith("#")]
    rows = [dict(zip(table[0], row)) for row in table[1:]]
    values = [[float(row[c]) for c in "rgb"] for row in rows if row["r"] and row["g"] and row["b"]]
    if not values:
        return None, "no rows"
    return [sum(v[c] for v in values) / len(values) for c in range(3)], ""


def plain(colour, width=16, height=8):
    return [[list(colour) for _ in range(width)] for _ in range(height)]


def codes(values):
    return [min(65535, max(0, round(65535 * v))) for v in values]


# --- A: light -----------------------------------------------------------------------------------------------------------

def random_colour():
    """In the gamut of sRGB, and so in that of all wider primaries."""
    return [rng.uniform(0.05, 0.6) for _ in range(3)]


def curve_and_encoding():
    which = rng.choice(["linear", "srgb", "gamma"])
    if which == "linear":
        return 1, (lambda x: x)
    if which == "srgb":
        return "srgb", srgb_encode
    gamma = rng.randrange(1 * 256 + 100, 3 * 256) / 256
    return gamma, (lambda x: x ** (1 / gamma))


def png_with_gamma(name, colour):
    number = rng.randrange(30000, 110000)
    png(name, plain(codes([c ** (number * 1e-5) for c in colour])), chunks=[(b"gAMA", struct.pack(">I", number))])
    return 2e-4


def png_with_primaries(name, colour):
    primaries = rng.choice([P3, ADOBE, REC2020])
    own = apply(inverse(to_srgb(primaries)), colour)
    numbers = [round(v * 1e5) for xy in (primaries[3],) + primaries[:3] for v in xy]
    chunks = [(b"gAMA", struct.pack(">I", 100000)), (b"cHRM", struct.pack(">8I", *numbers))]
    png(name, plain(codes(own)), chunks=chunks)
    return 2e-4


def png_with_cicp(name, colour):
    number, primaries = rng.choice([(1, SRGB), (9, REC2020), (12, P3)])
    transfer, encode = rng.choice([(8, lambda x: x), (13, srgb_encode), (4, lambda x: x ** (1 / 2.2)), (5, lambda x: x ** (1 / 2.8))])
    own = apply(inverse(to_srgb(primaries)), colour)
    png(name, plain(codes([encode(max(c, 0)) for c in own])), chunks=[(b"cICP", bytes([number, transfer, 0, 1]))])
    return 2e-4


def with_profile(colour):
    curve, encode = curve_and_encoding()
    primaries = rng.choice([SRGB, P3, ADOBE, REC2020])
    own = apply(inverse(to_srgb(primaries)), colour)
    return icc(curve, primaries, "made"), [encode(max(c, 0)) for c in own]


def png_with_profile(name, colour):
    profile, encoded = with_profile(colour)
    png(name, plain(codes(encoded)), chunks=[(b"iCCP", b"made\0\0" + zlib.compress(profile))])
    return 2e-4


def tiff_with_profile(name, colour):
    profile, encoded = with_profile(colour)
    tiff(name, [plain(codes(encoded))], [(34675, 7, profile)])
    return 2e-4


def tiff_with_transfer(name, colour):
    gamma = rng.uniform(1.2, 2.8)
    table = [round(65535 * (i / 65535) ** gamma) for i in range(65536)]
    tiff(name, [plain(codes([c ** (1 / gamma) for c in colour]))], [(301, 3, table)])
    return 2e-4


def tiff_with_primaries(name, colour):
    primaries = rng.choice([P3, ADOBE, REC2020])
    own = apply(inverse(to_srgb(primaries)), colour)
    numbers = [v for xy in primaries[:3] for v in xy]
    tags = [(318, 5, list(primaries[3])), (319, 5, numbers), (301, 3, list(range(65536)))]
    tiff(name, [plain(codes(own))], tags)
    return 2e-4


def jpeg_with_profile(name, colour):
    profile, encoded = with_profile(colour)
    png("made.png", plain([round(255 * e) for e in encoded], 32, 32), bits=8)
    subprocess.run(["oiiotool", "made.png", "--compression", "jpeg:98", "--attrib", "jpeg:subsampling", "4:4:4", "-o", name], check=True)
    content = open(name, "rb").read()
    piece = b"ICC_PROFILE\0\1\1" + profile
    open(name, "wb").write(content[:2] + b"\xff\xe2" + struct.pack(">H", len(piece) + 2) + piece + content[2:])
    return 1.5 / 255 * 3 * 1.7  # a code and a half, the steepest curve, the largest row of a matrix


def exr_with_chromaticities(name, colour):
    primaries = rng.choice([P3, ADOBE, REC2020])
    own = apply(inverse(to_srgb(primaries)), colour)
    words = ",".join(f"{v:.6g}" for xy in primaries for v in xy)
    subprocess.run(["oiiotool", "--create", "16x8", "3", f"--fill:color={own[0]:.8g},{own[1]:.8g},{own[2]:.8g}", "16x8", "-d", "float",
                    "--attrib:type=float[8]", "chromaticities", words, "-o", name], check=True)
    return 2e-4


def fits_mosaic(name, colour):
    pattern = rng.choice(["RGGB", "BGGR", "GRBG", "GBRG"])
    height, across, down = rng.choice([8, 9]), rng.randrange(3), rng.randrange(3)
    order = rng.choice(["TOP-DOWN", "BOTTOM-UP", None])
    value = dict(zip("RGB", codes(colour)))

    def at(stored, x):
        # Siril: of the upper left of the upright picture; without ROWORDER of the first pixel.
        y = height - 1 - stored if order == "BOTTOM-UP" else stored
        return value[pattern[2 * ((y + down) % 2) + (x + across) % 2]]

    cards = [(rng.choice(["BAYERPAT", "COLORTYP"]), pattern), ("XBAYROFF", across), ("YBAYROFF", down)]
    cards += [("ROWORDER", order)] if order else []
    open(name, "wb").write(fits_image([[at(y, x) for x in range(16)] for y in range(height)], cards))
    return 2e-5


MADE_LIGHT = [
    (png_with_gamma, "png"), (png_with_primaries, "png"), (png_with_cicp, "png"), (png_with_profile, "png"), (tiff_with_profile, "tif"),
    (tiff_with_transfer, "tif"), (tiff_with_primaries, "tif"), (jpeg_with_profile, "jpg"), (exr_with_chromaticities, "exr"),
    (fits_mosaic, "fits"),
]


def declared_light():
    for i in range(part(40)):
        make, ending = MADE_LIGHT[i % len(MADE_LIGHT)]
        name, colour = f"light_{i}.{ending}", random_colour()
        tolerance = make(name, colour)
        found, words = light(name)
        near("A", f"{make.__name__} {i} {words}", found, colour, tolerance)
        code, said, _ = run("describe", name)
        require("A", f"describe {name}", code == 0 and "declares" in said, said)
    # An explicit decoding counts more than any declaration, and the refusal of a profile of inks says so.
    png("plain.png", plain(codes([0.3, 0.3, 0.3])), chunks=[(b"gAMA", struct.pack(">I", 45455))])
    near("A", "--decoding linear", light("plain.png", "--decoding", "linear")[0], [0.3] * 3, 2e-5)
    near("A", "--decoding srgb", light("plain.png", "--decoding", "srgb")[0], [srgb_decode(0.3)] * 3, 2e-5)
    tiff("inks.tif", [plain(codes([0.3, 0.3, 0.3]))], [(34675, 7, icc(1, SRGB, "inks").replace(b"RGB XYZ", b"CMYKLab"))])
    _, words = light("inks.tif")
    require("A", "a profile of inks", "exit 3" in words and "--decoding" in words, words)
    near("A", "a profile of inks, overridden", light("inks.tif", "--decoding", "linear")[0], [0.3] * 3, 2e-5)
    # Twelve bits, declared or not, low or high.
    for i in range(part(12)):
        bits, full = rng.choice([10, 12, 14]), rng.randrange(5, 60)
        top, shift = (1 << bits) - 1, rng.choice([0, 16 - bits])
        declared = rng.random() < 0.5
        rows = [[rng.randrange(100, top - 200) << shift for _ in range(24)] for _ in range(16)]
        for place in rng.sample(range(24 * 16), full):
            rows[place // 24][place % 24] = top << shift
        kind = rng.choice(["fits", "png", "tif"])
        if kind == "fits":
            open(f"bits_{i}.fits", "wb").write(fits_image(rows, [("BITDEPTH", bits)] if declared else []))
        elif kind == "png":
            chunks = [(b"sBIT", bytes([bits]))] if declared else []
            png(f"bits_{i}.png", [[[v] for v in row] for row in rows], chunks=chunks)
        else:
            tiff(f"bits_{i}.tif", [[[[v] for v in row] for row in rows]])
        code, said, words = run("mask", f"bits_{i}.{kind}", "-o", "mask.png", "--saturated", "--border", 0, "--overwrite", "--json")
        found = json.loads(said)["parts"][0]["left_out_px"] if code == 0 else None
        require("A", f"{bits} bits of {kind}, shift {shift}, declared {declared}", found == full, f"{found} of {full} {words}")


# --- D: units -----------------------------------------------------------------------------------------------------------

RAYLEIGHS = {
    "R": 1.0, "kR": 1e3, "Rayleigh": 1.0, "kilorayleigh": 1e3, "MR": 1e6, "rayleighs": 1.0, "10**10 ph m-2 s-1": 1.0,
    "photons cm-2 s-1": 1e-6, "ph/cm^2/s": 1e-6, "photon/(m2 s)": 1e-10, "photon s-1 m-2 sr-1": 4 * math.pi * 1e-10, "": 1.0,
}
NO_RAYLEIGHS = ["ADU", "erg s-1 cm-2", "count", "R/s", "electron", "W m-2 sr-1", "deg", "DN/s", "photon", "kR s", "counts/s", "K"]
TRUE_R = {"427.8": 2300.0, "557.7": 12400.0, "630.0": 330.0}


def inverted(units):
    words = ["invert", "--relative-error", "5", "-o", "map.fits", "--overwrite"]
    for (line, rayleighs), unit in zip(TRUE_R.items(), units):
        # astropy and others write a card without a value for no unit.
        cards = [("BUNIT", unit)] if unit else []
        rows = [[rayleighs / RAYLEIGHS.get(unit, 1.0)] * 3] * 2
        open(f"m{line}.fits", "wb").write(fits_image(rows, cards, bits=-32))
        words += ["--map", f"{line}=m{line}.fits"]
    code, _, said = run(*words)
    return code, said, [plane[0][0] for plane in fits_of("map.fits")[1]][:2] if code in (0, 5) else None


def declared_units():
    code, said, right = inverted(["", "", ""])
    require("D", "no units", code in (0, 5), said)
    names = list(RAYLEIGHS)
    for _ in range(part(10)):
        units = rng.sample(names, 3)
        _, said, found = inverted(units)
        # Floats of 32 bits.
        ok = found is not None and all(abs(f / r - 1) < 1e-5 for f, r in zip(found, right))
        for unit in units:
            require("D", f"BUNIT '{unit}'", ok, f"{found} for {right} {said}")
    for unit in NO_RAYLEIGHS:
        code, said, _ = inverted(["R", unit, "R"])
        require("D", f"BUNIT '{unit}'", code == 3 and "m557.7.fits" in said and "BUNIT" in said and "kR" in said, said)
    # EXR of another program.
    for unit, ok in (("kR", True), ("ADU", False)):
        for line, rayleighs in TRUE_R.items():
            value = rayleighs / 1e3
            subprocess.run(["oiiotool", "--create", "3x2", "1", f"--fill:color={value:.9g}", "3x2", "-d", "float", "--attrib", "units", unit,
                            "-o", f"m{line}.exr"], check=True)
        words = [w for line in TRUE_R for w in ("--map", f"{line}=m{line}.exr")]
        code, _, said = run("invert", *words, "--relative-error", "5", "-o", "map.fits", "--overwrite")
        found = [plane[0][0] for plane in fits_of("map.fits")[1]][:2] if code in (0, 5) else None
        if ok:
            require("D", f"EXR of {unit}", found and all(abs(f / r - 1) < 1e-5 for f, r in zip(found, right)), f"{found} {said}")
        else:
            require("D", f"EXR of {unit}", code == 3 and "units" in said, said)
    # Angles: a skymap of radians is that of degrees. It is that of an equidistant lens of 6 degrees to a pixel.
    size = 24
    offsets = [[(x + 0.5 - size / 2, y + 0.5 - size / 2) for x in range(size)] for y in range(size)]
    azimuth = [[math.degrees(math.atan2(-x, -y)) % 360 for x, y in row] for row in offsets]
    elevation = [[90 - 6 * math.hypot(x, y) for x, y in row] for row in offsets]
    seen = []
    for unit, factor in (("deg", 1.0), ("rad", math.pi / 180), ("furlong", 1.0)):
        for name, rows in (("az", azimuth), ("el", elevation)):
            scaled = [[v * factor for v in row] for row in rows]
            open(f"{name}.fits", "wb").write(fits_image(scaled, [("BUNIT", unit)], bits=-32))
        code, _, said = run("calibrate", "--azimuth-map", "az.fits", "--elevation-map", "el.fits", "--site", "69,20,100",
                            "-o", "camera.toml", "--overwrite")
        focal = re.search(r"focal_px = ([\d.]+)", pathlib.Path("camera.toml").read_text()) if code == 0 else None
        seen.append((code, said, float(focal[1]) if focal else None))
    require("D", "a skymap of furlongs", seen[2][0] == 3 and "furlong" in seen[2][1] and "BUNIT" in seen[2][1], seen[2])
    right = [found[2] is not None and abs(found[2] - math.degrees(1) / 6) < 1e-3 for found in seen[:2]]
    require("D", "a skymap of radians", all(right), seen[:2])


# --- E: unknown is not zero ---------------------------------------------------------------------------------------------

def precipitation(folder, flux, energy, flux_error, energy_error):
    os.makedirs(folder, exist_ok=True)
    cards = [("CTYPE1", "EAST"), ("CUNIT1", "km"), ("CRPIX1", 1.0), ("CRVAL1", -20.0), ("CDELT1", 2.0), ("CTYPE2", "NORTH"),
             ("CUNIT2", "km"), ("CRPIX2", 1.0), ("CRVAL2", -20.0), ("CDELT2", 2.0), ("HEIGHTKM", 110.0), ("SITELAT", 67.0),
             ("SITELONG", 20.0), ("FLUXCAL", "absolute"), ("ROWORDER", "BOTTOM-UP")]
    size = 20
    planes = [[[value] * size for _ in range(size)] for value in (flux, energy, flux_error, energy_error, 1.0)]
    open(f"{folder}/precipitation.fits", "wb").write(fits_image(planes, cards, bits=-32))


def unknown_is_not_zero():
    try:
        import h5py
        import numpy
    except ImportError:
        print("h5py is not installed: to-lompe and to-gemini are not looked at")
        return
    nan = float("nan")
    for i in range(part(30)):
        flux, energy = rng.uniform(0.5, 20), rng.uniform(1, 9)
        flux_error, energy_error = rng.choice([nan, rng.uniform(0.01, 0.3)]), rng.choice([nan, rng.uniform(0.01, 0.3)])
        if i % 5 == 4:
            flux, energy, flux_error, energy_error = rng.choice([(0.0, nan, nan, nan), (nan, nan, nan, nan), (flux, nan, nan, nan)])
        precipitation("map", flux, energy, flux_error, energy_error)
        known = not math.isnan(flux)
        code, _, said = run("to-lompe", "map", "-o", "lompe.nc", "--overwrite", "--time", "2014-03-10T06:05:33Z", "--step-deg", "0.1")
        if not known:
            require("E", f"a map without a flux {i}", code != 0, said)
            continue
        if code != 0:
            require("E", f"to-lompe {i}", False, said)
            continue
        with h5py.File("lompe.nc") as file:
            for name in ("energy_flux", "energy"):
                variable, sigma = file[name][0], file[name + "_sigma"][0]
                fill = file[name].attrs["_FillValue"][0]
                relative = flux_error if name == "energy_flux" else energy_error
                value = flux if name == "energy_flux" else energy
                inside = variable != fill
                unknown = math.isnan(value) or math.isnan(relative) or flux == 0
                if unknown:
                    require("E", f"{name}_sigma of {flux, energy, flux_error, energy_error}", bool(numpy.all(sigma == fill)), sigma)
                else:
                    right = numpy.abs(sigma[inside] / (relative * value) - 1).max()
                    require("E", f"{name}_sigma of {relative}", bool(inside.any()) and right < 1e-5, right)
            for name in ("SP_sigma", "SH_sigma"):
                sigma, fill = file[name][0], file[name].attrs["_FillValue"][0]
                is_known = not any(map(math.isnan, (flux, energy, flux_error, energy_error))) and flux > 0
                require("E", f"{name} {i}", bool((sigma != fill).any()) == is_known, sigma)
        code, _, said = run("to-gemini", "map", "--out", "prec", "--overwrite", "--time", "2014-03-10T06:05:33Z", "--step-deg", "0.1")
        with h5py.File("prec/20140310_21933.000000.h5") as file:
            require("E", f"to-gemini {i}", bool(((file["known"][:] == 1) | (file["Qp"][:] == 0)).all()) and bool((file["known"][:] == 0).any()))


# --- F: frames ----------------------------------------------------------------------------------------------------------

def declared_frames():
    # EXR: a bright pixel of the data window at its place in the frame.
    for i in range(part(12)):
        width, height = rng.randrange(20, 40), rng.randrange(20, 40)
        x, y, w, h = rng.randrange(-9, 15), rng.randrange(-9, 15), rng.randrange(8, 30), rng.randrange(8, 30)
        left, top = rng.randrange(-20, 20), rng.randrange(-20, 20)
        if max(x, 0) >= min(x + w, width) or max(y, 0) >= min(y + h, height):
            continue
        subprocess.run(["oiiotool", "--create", f"{w}x{h}", "3", "--fill:color=0.25,0.5,0.75", f"{w}x{h}", "-d", "half", "--origin",
                        f"{left + x:+d}{top + y:+d}", "--fullsize", f"{width}x{height}{left:+d}{top:+d}", "-o", "window.exr"], check=True)
        code, said, words = run("describe", "window.exr")
        require("F", f"size of {x, y, w, h} in {width, height}", f"{width} x {height} pixels" in said, said + words)
        code, _, words = run("profile", "window.exr", "-o", "light.csv", "--overwrite", "--bands", 1)
        table = [row for row in csv.reader(open("light.csv")) if row and not row[0].startswith("#")]
        rows = [dict(zip(table[0], row)) for row in table[1:]]
        known = {int(float(r["row_px"])) for r in rows if float(r["n_r"] or 0) > 0}
        right = set(range(max(y, 0), min(y + h, height)))
        pixels = {float(r["n_r"] or 0) for r in rows if float(r["n_r"] or 0) > 0}
        across = min(x + w, width) - max(x, 0)
        require("F", f"rows of {x, y, w, h} in {width, height}", code == 0 and known == right and pixels == {across},
                f"{sorted(known)} {pixels} {words}")
    # TIFF: pages of one size are frames, reduced ones and masks are none.
    for i in range(part(10)):
        pages, thumbs = rng.randrange(1, 5), rng.randrange(0, 3)
        values = [rng.uniform(0.1, 0.9) for _ in range(pages)]
        made = [plain(codes([v] * 3)) for v in values] + [plain(codes([0.05] * 3), 8, 4) for _ in range(thumbs)]
        flags = [0] * pages + [1] * thumbs
        order = list(range(len(made)))
        rng.shuffle(order)
        tiff("pages.tif", [made[k] for k in order], subfile=[flags[k] for k in order])
        wanted = [values[k] for k in order if k < pages]
        if pages == 1:
            near("F", f"one page beside {thumbs} small ones", light("pages.tif", "--decoding", "linear")[0], wanted * 3, 2e-5)
            continue
        code, said, _ = run("describe", "pages.tif")
        require("F", f"{pages} pages", code == 0 and f"{pages} frames" in said, said)
        _, words = light("pages.tif")
        require("F", f"{pages} pages, none chosen", "exit 2" in words and "#0" in words, words)
        k = rng.randrange(pages)
        near("F", f"page {k} of {pages}", light(f"pages.tif#{k}", "--decoding", "linear")[0], [wanted[k]] * 3, 2e-5)
    # FITS: times in extensions, several images.
    for i in range(part(10)):
        stamp = f"20{rng.randrange(10, 25)}-0{rng.randrange(1, 10)}-1{rng.randrange(10)}T0{rng.randrange(10)}:{rng.randrange(10, 60)}:{rng.randrange(10, 60)}"
        rows = [[rng.randrange(1000, 60000)] * 16 for _ in range(8)]
        primary = header([("SIMPLE", True), ("BITPIX", 8), ("NAXIS", 0), ("EXTEND", True)])
        image = fits_image(rows, [("DATE-OBS", stamp)], extension=True)
        open("mef.fits", "wb").write(primary + image)
        code, said, _ = run("describe", "mef.fits")
        require("F", f"time of {stamp}", f"{stamp}" in said, said)
    for i in range(4):
        values = [rng.randrange(1000, 60000) for _ in range(3)]
        parts = [fits_image([[v] * 16 for _ in range(8)], [("DATE-OBS", f"2020-01-01T00:00:0{k}")], extension=k > 0)
                 for k, v in enumerate(values)]
        beside = fits_image([[1] * 16 for _ in range(8)], [("EXTNAME", "WEIGHT")], extension=True)
        open("several.fits", "wb").write(b"".join(parts) + beside)
        code, said, _ = run("describe", "several.fits")
        require("F", "three images", "3 frames" in said and "2020-01-01T00:00:02" in said, said)
        k = rng.randrange(3)
        near("F", f"image {k}", light(f"several.fits#{k}")[0], [values[k] / 65535] * 3, 2e-5)


# --- I: imagers' formats ------------------------------------------------------------------------------------------------

def imagers():
    width, height = 12, 10
    values = [[rng.randrange(500, 60000) for _ in range(width)] for _ in range(height)]
    head = b"$Spextube IV image file generation -1".ljust(60, b"\0") + struct.pack("<3H", width, height, 2)
    name = "W8446B18_2020-12-11_20-09-36.img"
    open(name, "wb").write(head + b"".join(struct.pack("<H", v) for row in values for v in row) + bytes(21))
    code, said, words = run("describe", name)
    for word in (f"{width} x {height} pixels", "2020-12-11T20:09:36", "844.6 nm"):
        require("I", word, word in said, said + words)
    run("profile", name, "-o", "light.csv", "--overwrite", "--bands", 1)
    table = [row for row in csv.reader(open("light.csv")) if row and not row[0].startswith("#")]
    rows = [dict(zip(table[0], row)) for row in table[1:]]
    near("I", "rows of a KEO image", [float(r["g"]) for r in rows], [sum(row) / width / 65535 for row in values], 2e-5)
    open("cut.img", "wb").write(head + bytes(100))
    code, _, words = run("describe", "cut.img")
    require("I", "a KEO image that is cut", code == 3 and "cut.img" in words, words)
    # Several arrays of one size, of which one is named.
    several = PHOTOS / "formats/Data_4_triangulation.mat"
    if not several.is_file():
        print(f"skipped: no {several}")
        return
    code, _, words = run("describe", several)
    require("I", "arrays are listed", code == 3 and "'dN' (128 x 128)" in words and "FILE#NAME" in words, words)
    code, said, words = run("describe", f"{several}#dN")
    require("I", "an array by its name", code == 0 and "128 x 128 pixels" in said, said + words)
    code, _, words = run("describe", f"{several}#none")
    require("I", "an array that is not there", code == 2 and "'dS'" in words, words)


# --- the small inputs of shared/cases -----------------------------------------------------------------------------------

def shared_cases():
    if not CASES.is_dir():
        print(f"skipped: no small inputs in {CASES}")
        return
    colours = CASES / "colour_declarations"

    def ends(name):
        run("profile", colours / name, "-o", "light.csv", "--overwrite")
        table = [row for row in csv.reader(open("light.csv")) if row and not row[0].startswith("#")]
        rows = [dict(zip(table[0], row)) for row in table[1:]]
        return [float(rows[0]["g"]), float(rows[-1]["g"])]

    for name in ("icc_lin16.tif", "icc_lin2020_16.tif", "gama1_16.png", "icc_g18_16.tif"):
        near("cases", name, ends(name), [0.02, 0.6], 2e-4)
    for name in ("col_p3.jpg", "col_adobe.jpg", "col_srgb.jpg"):
        found, words = light(colours / name)
        near("cases", name + words, found and [found[0] / found[1], found[2] / found[1]], [0.2, 0.4], 0.01)
    near("cases", "r2020.exr", light(colours / "r2020.exr")[0], [0.0165, 0.539, 0.282], 1e-3)
    open("bayer.fits", "wb").write(fits_image(
        [[20000 if y % 2 == 0 and x % 2 == 0 else 4000 if y % 2 and x % 2 else 40000 for x in range(60)] for y in range(40)],
        [("BAYERPAT", "RGGB"), ("XBAYROFF", 0), ("YBAYROFF", 0), ("ROWORDER", "TOP-DOWN")]))
    found, words = light("bayer.fits")
    near("cases", "bayer.fits" + words, found and [found[0] / found[1], found[2] / found[1]], [0.5, 0.1], 1e-6)
    code, said, words = run("mask", CASES / "twelve_bit/twelve.fits", "-o", "mask.png", "--saturated", "--border", 0, "--overwrite")
    require("cases", "twelve.fits", "150" in said + words, said + words)
    code, said, _ = run("describe", CASES / "multipage_tiff/multipage.tif")
    require("cases", "multipage.tif", "2 frames" in said, said)
    code, said, _ = run("describe", CASES / "mef_time/mef.fits")
    require("cases", "mef.fits", "2014-02-21T19:30:40" in said, said)
    subprocess.run(["oiiotool", "--create", "900x900", "3", "--fill:color=0.1,0.1,0.1", "900x900", "-d", "half", "--origin", "+5+7",
                    "--fullsize", "900x900+0+0", "-o", "shift.exr"], check=True)
    code, said, _ = run("describe", "shift.exr")
    require("cases", "shift.exr", "900 x 900 pixels" in said and "data window 5 7" in said, said)


def main():
    for check in (declared_light, declared_units, unknown_is_not_zero, declared_frames, imagers, shared_cases):
        check()
    for words in failures:
        print(words)
    print(", ".join(f"{kind}: {count}" for kind, count in counts.items()), f"requirements, {len(failures)} not met")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
