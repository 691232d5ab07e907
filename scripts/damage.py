#!/usr/bin/env python3
"""Runs vegard on damaged inputs of all kinds and counts how it ends.

Small sound files are made by vegard itself (pictures of every format, scenes, cameras, maps, lists, tables, voxels,
a journal, runs). Each input is one of them with bytes flipped, cut off, cut out, swapped, repeated, with other
numbers, empty, of another format, with what upsets terminals and text readers, or no file at all (a folder, a pipe,
a link to /dev/zero). The real command then reads it, within a time and an address space. Whatever it says, it is to
end by itself, with a documented exit code, in one message, and leave nothing where it refuses.

The same --seed makes the same inputs. What is found is kept, with the words to run it again. The exit code is 1 if
there is a finding.
"""

import argparse
import gzip
import itertools
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
DOCUMENTED = {0, 2, 3, 4, 5, 6}
REFUSALS = {1, 2, 3, 6}
REFUSED_MOST_MB = 300
MESSAGE_MOST_BYTES = 2000
CAMERA = ["--set", "camera.width=32", "--set", "camera.height=24"]
ONE = ["--threads", "1"]
MAP = ["--replicates", "1", "--sparsity", "4"]
SKY = ["--size", "64,48", "--site", "65,20", "--time", "2020-01-01T20:00:00Z"]
# The second photograph, scene and grid of a command are sound; {it} is damaged.
ON_PHOTO = [
    ["profile", "{it}", "-o", "{out}/p.csv"],
    ["mask", "{it}", "-o", "{out}/m.png", "--stars", "--saturated", "--hot"],
    ["describe", "{it}"],
    ["describe", "{it}", "-o", "{out}/d.toml"],
    ["keogram", "{it}", "photo.png", "-o", "{out}/k.csv"],
    ["fit", "fit.toml", "--photo", "{it}", "--out", "{out}/run", "--max-evaluations", "2"] + ONE,
    # Averaged over blocks while it is read, as large photographs are.
    ["fit", "fit.toml", "--photo", "{it}", "--out", "{out}/run", "--max-evaluations", "2", "--set", "fit.average_rows=8",
     "--set", "fit.bands=1"] + ONE,
    ["linearise", "{it}", "small.toml", "-o", "{out}/l.exr"],
    ["sdf", "{it}", "-o", "{out}/s.exr"],
    ["horizon", "{it}", "--points", "2,12", "30,13", "-o", "{out}/c.toml"],
    ["profile", "photo.png", "--mask", "{it}", "-o", "{out}/p.csv"],
    ["map", "map.toml", "--photo", "{it}", "--out", "{out}/map"] + MAP + ONE,
    ["map", "map.toml", "--line", "557.7={it}", "--out", "{out}/map", "--set", "sensor.response=filters"] + MAP + ONE,
]
ON_FRAMES = [
    ["describe", "{it}"],
    ["describe", "{it}#0", "-o", "{out}/d.toml"],
    ["profile", "{it}#0", "-o", "{out}/p.csv"],
    ["profile", "{it}", "--at", "2014-03-10T06:03:03Z", "-o", "{out}/p.csv"],
    ["keogram", "{it}", "second.png", "-o", "{out}/k.csv"],
    ["fit", "fit.toml", "--photo", "{it}#0", "--out", "{out}/run", "--max-evaluations", "2"] + ONE,
    ["sequence", "fit.toml", "--photos", "{it}", "-o", "{out}/s", "--max-evaluations", "2"] + ONE,
    ["profile", "photo.png", "--mask", "{it}#0", "-o", "{out}/p.csv"],
]
ON_ARRAYS = [
    ["describe", "{it}"],
    ["describe", "{it}#1"],
    ["profile", "{it}#0", "-o", "{out}/p.csv"],
    ["keogram", "{it}", "-o", "{out}/k.csv"],
    ["calibrate", "--skymap", "{it}", "-o", "{out}/c.toml"],
]
ON_ANGLES = [
    ["profile", "photo.png", "--azimuth-map", "{it}", "--azimuths", "0", "10", "-o", "{out}/p.csv"],
    ["keogram", "photo.png", "second.png", "--azimuth-map", "{it}", "-o", "{out}/k.csv"],
    ["calibrate", "--azimuth-map", "{it}", "-o", "{out}/c.toml"],
]
ON_LINES = [["invert", "--map", "427.8={it}", "--map", "630.0={it}", "--relative-error", "5", "-o", "{out}/i.nc"] + ONE]
ON_GRID = [
    ["grid", "{it}", "-o", "{out}/g.pbrt"],
    ["grid", "{it}", "-o", "{out}/g.vdb", "--blur", "1"] + ONE,
    ["slices", "{it}", "-o", "{out}/s.png"] + ONE,
]


COUNTS = b"""name = "a"
dark_counts = 3.5
gain_e_per_count = 2
[[filter]]
name = "g"
line_nm = 557.7
width_nm = 2.0
width_error = 0.03
rayleigh_per_count_s = 24.2
rayleigh_per_count_s_error = 1
[[filter]]
name = "b"
line_nm = 427.8
channel = "blue"
"""


def quiet(words, **more):
    """Runs what must succeed."""
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more)
    if done.returncode not in (0, 4, 5):
        sys.exit(f"damage.py: {' '.join(map(str, words))} ended with {done.returncode}:\n{done.stdout.decode()}")


class Kind:
    """Sound files of one kind, under the name `place` in the folder where commands run, and what reads them."""

    def __init__(self, name, place, seeds, commands):
        self.name, self.place, self.seeds, self.commands = name, place, seeds, commands


def ppm(width, height):
    return b"P6\n# made\n%d %d\n255\n" % (width, height) + bytes((37 * i) % 256 for i in range(3 * width * height))


def frames(count):
    """A file of frames as the imagers of THEMIS write it."""
    return b"".join(
        b"P5\n" + (b'#"Site unique ID" gill\n#"Geodetic latitude" 56.35\n#"Geodetic Longitude" -94.65\n' if i == 0 else b"")
        + b'#"Exposure options" WIDTH=64 HEIGHT=24 XBIN=2 YBIN=1 MSEC=999\n#"Image request start" 2014-03-10 06:03:%02d.031 UTC\n' % (3 * i)
        + b"32 24\n65535\n" + b"".join((997 * (i + 1) * k % 60000).to_bytes(2, "big") for k in range(32 * 24)) for i in range(count))


def make_kinds(vegard, home):
    """Writes the sound files into the folder `home` and gives what there is to damage."""

    def run(*words):
        quiet([vegard, *words], cwd=home)

    def text(name, words):
        (home / name).write_text(words)
        return words.encode()

    def bytes_of(name):
        return (home / name).read_bytes()

    for scene in ("small", "fit", "map", "map_light"):
        words = (SOURCE / f"tests/cli/scenes/{scene}.toml").read_text()
        for old, new in (("width = 160", "width = 32"), ("height = 120", "height = 24"), ("beams = 150", "beams = 30"),
                         ("width = 96", "width = 32"), ("height = 64", "height = 24"),
                         ("layers = 3", "layers = 1"), ("bands = 4", "bands = 2")):
            words = words.replace(old, new)
        text(f"{scene}.toml", words)
    pictures = ["photo.png", "photo.jpg", "photo.tif", "photo.exr"]
    for picture in pictures:
        run("render", "small.toml", "-o", picture, *ONE)
    run("render", "small.toml", "-o", "second.png", "--bits", "16", *ONE)
    run("render", "map_light.toml", "-o", "band.png", *ONE)
    run("directions", "small.toml", "-o", "maps.exr")
    run("directions", "small.toml", "-o", "maps.fits")
    run("directions", "small.toml", "-o", "field.acc")
    run("directions", "small.toml", "-o", "field.wcs", "--set", "site.time_utc=\"2014-02-21T19:30:40Z\"", "--set", "site.latitude_deg=65.1",
        "--set", "site.longitude_deg=20.5")
    run("profile", "photo.png", "-o", "measured.csv")
    run("volume", "small.toml", "-o", "a.vdb", "--voxel-km", "16", "--lines", "557.7", *ONE)
    run("grid", "a.vdb", "-o", "a.pbrt")
    run("fit", "fit.toml", "--photo", "photo.png", "--out", "run", "--max-evaluations", "2", *ONE)
    run("fit", "fit.toml", "--photo", "photo.png", "--out", "other", "--set", "fit.bands=3", "--max-evaluations", "2",
        *ONE)
    run("animate", "small.toml", "-o", "frames/#.png", "--frames", "0:1", *ONE)
    text("list.txt", "# when, and of what\nphoto.png 0\nsecond.png 2.5\n")
    run("sequence", "fit.toml", "--photos", "list.txt", "-o", "sequence", "--max-evaluations", "2", *ONE)
    shutil.copy(home / "photo.png", home / "third.png")
    run("keogram", "photo.png", "third.png", "-o", "keogram.csv")
    run("horizon", "--size", "32,24", "--points", "2,12", "30,13", "--hfov", "60", "-o", "camera.toml")
    (home / "photo.ppm").write_bytes(ppm(32, 24))
    stars = "name,azimuth_deg,zenith_deg,x_px,y_px\n" + "".join(
        f"star {i},{77 * i % 360},{8 + 6 * i},{33 + i},{23 + i}\n" for i in range(9))
    tables = {
        "profile.csv": "altitude_km,557.7,630.0,427.8\n90,0,0,0\n110,5.5,1,2\n250,0,3,1\n",
        "response.csv": "wavelength_nm,red,green,blue\n400,0,0.1,1\n500,0.1,1,0.5\n600,1,0.5,0\n700,0.5,0,0\n",
        "curve.csv": "linear,encoded\n0,0\n0.2,0.5\n1,1\n",
        "colours.csv": "grey,red,green,blue\n0,0,0,0\n0.5,1,0.5,0\n1,1,1,1\n",
        "times.csv": "file,time\nphoto.png,2015-10-07T08:23:51.743Z\nsecond.png,2015-10-07 08:24:00\n",
        "curtains.csv": "curtain,point,east_km,north_km,energy_flux_mw_m2,energy_kev,width_km,energy_kev_error\n"
                        "1,1,-60,230,4,3,2,nan\n1,2,0,210,6,4,2,0.1\n1,3,60,240,5,2,1,0.1\n",
        "mask.txt": "# 125 numbers\n" + "0.01 0.01, 0.01 1e-2 0\n" * 25,
    }
    for name, words in tables.items():
        text(name, words)
    (home / "frames.pgm").write_bytes(frames(1))
    small = (home / "small.toml").read_text()
    sheet = 'energy_kev = 3.0\n'
    text("with_profile.toml", small.replace(sheet, sheet + 'profile = "file"\nprofile_file = "profile.csv"\n'))
    text("with_curve.toml", small + '[sensor]\ntone = "file"\ntone_file = "curve.csv"\n')
    text("with_response.toml", small + '[sensor]\nresponse = "response.csv"\n')
    text("with_colours.toml", small + '[sensor]\ncolour_table = "colours.csv"\n')
    text("with_curtain.toml", small.replace(sheet, sheet + 'course = "curve"\ncurve_file = "curtains.csv"\n'))
    text("with_map.toml", small + '[[footprint]]\nsource = "precipitation"\nfile = "map.fits"\n')
    (home / "map.fits").write_bytes(small_map())
    for ending in ("vdb", "pbrt"):
        text(f"with_{ending}.toml", small + f'[[volume]]\nname = "cloud"\nfile = "a.{ending}"\n'
             + ("" if ending == "vdb" else "density_rayleigh = [1.0, 1.0, 1.0]\n"))
    text("survey.toml", '[survey]\nname = "night"\nwork = ["border", "fit"]\nscene = "fit.toml"\nblock_frames = 1\n[[camera]]\n'
         'name = "a"\nframes = ["frames.txt"]\nset = ["fit.bands=2"]\ndecoding = "srgb"\n[[camera.calibration]]\n'
         'from = "2019-03-01"\nfile = "camera.toml"\n[[skip]]\nuntil = "2019-03-01"\nreason = "fog"\n')
    text("frames.txt", "# when\nphoto.png 2019-03-01T22:10:00Z\nsecond.png 2019-03-01 22:10:03.5\n")
    run("survey", "plan", "survey.toml", "-o", "plan.json")
    run("survey", "run", "plan.json", "--out", "shards", *ONE)
    journal = make_journal(vegard, home, ["fit", "fit.toml", "--photo", "photo.png", "--max-evaluations", "2"])
    map_journal = make_journal(vegard, home, ["map", "map.toml", "--photo", "band.png", *MAP])
    render = ["render", "{it}", "-o", "{out}/r.png"] + CAMERA + ONE
    scenes = [bytes_of(n) for n in ("small.toml", "fit.toml", "with_colours.toml", "with_vdb.toml")] + [
        (SOURCE / "data/gallery" / n).read_bytes() for n in ("rays.toml", "cats_eye.toml", "horseshoe.toml")]
    kinds = [
        Kind("scene", "it.toml", scenes,
             [["params", "{it}"], ["brightness", "{it}"], ["directions", "{it}", "-o", "{out}/d.exr"] + CAMERA, render,
              ["animate", "{it}", "-o", "{out}/#.png", "--list"], ["describe", "photo.png", "-o", "{it}"],
              ["fit", "{it}", "--photo", "photo.png", "--out", "{out}/run", "--max-evaluations", "2"] + CAMERA + ONE]),
        Kind("camera", "it.toml", [bytes_of("camera.toml")],
             [["render", "small.toml", "--camera", "{it}", "-o", "{out}/r.png"] + ONE,
              ["calibrate", "stars.csv", "--camera", "{it}", "-o", "{out}/c.toml"] + SKY]),
        *[Kind(p.split(".")[1], "it." + p.split(".")[1], [bytes_of(p)] + ([bytes_of("second.png")] if "png" in p else []),
               ON_PHOTO) for p in pictures + ["photo.ppm"]],
        Kind("frames", "it.pgm", [frames(3)], ON_FRAMES),
        Kind("packed frames", "it.pgm.gz", [gzip.compress(frames(3), mtime=0), gzip.compress(frames(1), mtime=0)], ON_FRAMES),
        Kind("counts", "it.toml", [COUNTS],
             [["linearise", "frames.pgm", "--rayleigh", "{it}", "--filter", "g", "--exposure", "2", "-o", "{out}/r.fits"],
              ["photometry", "{it}", "frames.pgm", "--filter", "g", "--camera", "camera.toml", "--exposure", "2",
               "--time", "2019-03-01T22:10:00Z", "-o", "{out}/c.toml"]]),
        *[Kind(name, "it." + name, [(SOURCE / "tests/data/imagers" / file).read_bytes() for file in files], ON_ARRAYS)
          for name, files in (("h5", ["rgb.h5", "huge.h5"]), ("mat", ["stack.mat", "stack_v73.mat"]), ("cdf", ["asi.cdf", "asi_packed.cdf"]),
                              ("sav", ["skymap.sav", "skymap_packed.sav"]), ("png.tar", ["minute.png.tar"]),
                              ("mp4", ["film.mp4"]), ("avi", ["film.avi"]), ("mkv", ["film.mkv"]))],
        Kind("img", "it.img", [b"$Spextube IV image file".ljust(60, b"\0") + struct.pack("<3H", 64, 48, 2) + bytes(range(256)) * 24], ON_PHOTO),
        Kind("heic", "it.heic", [(SOURCE / "tests/data/turned.heic").read_bytes()], ON_PHOTO),
        Kind("fits", "it.fits", [bytes_of("maps_az.fits"), bytes_of("maps_el.fits")], ON_PHOTO[:7] + ON_ANGLES + ON_LINES),
        Kind("packed fits", "it.fits.gz", [gzip.compress(bytes_of("maps_az.fits"), mtime=0)], ON_PHOTO[:7]),
        Kind("maps", "it.exr", [bytes_of("maps.exr")], ON_ANGLES),
        Kind("list", "it.txt", [bytes_of("list.txt")],
             [["keogram", "{it}", "-o", "{out}/k.csv"],
              ["sequence", "fit.toml", "--photos", "{it}", "-o", "{out}/s", "--max-evaluations", "2"] + ONE]),
        Kind("times", "it.csv", [bytes_of("times.csv")],
             [["keogram", "photo.png", "second.png", "--times", "{it}", "-o", "{out}/k.csv"]]),
        Kind("stars", "it.csv", [text("stars.csv", stars), b"star,x_px,y_px\nVega,1,2\nalf Aql,3,4\nHIP 91262,5,6\n",
                                 solved_field(9)],
             [["calibrate", "{it}", "-o", "{out}/c.toml"] + SKY]),
        Kind("solution", "it.wcs", [bytes_of("field.wcs")],
             [["calibrate", "--wcs", "{it}", "-o", "{out}/c.toml", "--size", "16,12"] + SKY]),
        Kind("aida", "it.acc", [bytes_of("field.acc")],
             [["calibrate", "--acc", "{it}", "--acc-line", "1", "-o", "{out}/c.toml", "--size", "16,12"]]),
        Kind("netcdf", "it.csv", [bytes_of("measured.csv"), bytes_of("keogram.csv")], [["to-netcdf", "{it}", "-o", "{out}/t.nc"]]),
        Kind("profile", "profile.csv", [bytes_of("profile.csv")], [["render", "with_profile.toml", "-o", "{out}/r.png"] + ONE]),
        Kind("air", "it.csv", [b"altitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n110,240,2e12,3e11,2e11\n400,1000,4e6,1e5,1e8\n"],
             [["electrons", "--energy-kev", "0.5", "--atmosphere", "{it}", "-o", "{out}/e.csv"]]),
        Kind("reactions", "it.csv", [b"number,value,exponent,activation_K,of\n43,0.19,0,0,0\n40,3.1e-11,0,0,1\n31,1.9e-7,-0.7,0,2\n"],
             [["lines", "--sources", "--energy-kev", "0.1", "--reactions", "{it}", "-o", "{out}/l.csv"]]),
        Kind("electrons", "it.csv", [b"energy_keV,flux\n0.5,1\n1,2\n2,0\n"],
             [["electrons", "--spectrum", "table", "--spectrum-table", "{it}", "-o", "{out}/e.csv"]]),
        Kind("response", "response.csv", [bytes_of("response.csv")], [["render", "with_response.toml", "-o", "{out}/r.png"] + ONE]),
        Kind("curve", "curve.csv", [bytes_of("curve.csv")],
             [["render", "with_curve.toml", "-o", "{out}/r.png"] + ONE,
              ["profile", "photo.png", "--decoding", "curve:curve.csv", "-o", "{out}/p.csv"]]),
        Kind("curtains", "curtains.csv", [bytes_of("curtains.csv")], [["render", "with_curtain.toml", "-o", "{out}/r.png"] + ONE]),
        Kind("precipitation", "map.fits", [bytes_of("map.fits")], [["render", "with_map.toml", "-o", "{out}/r.png"] + ONE]),
        Kind("colours", "colours.csv", [bytes_of("colours.csv")], [["render", "with_colours.toml", "-o", "{out}/r.png"] + ONE]),
        *[Kind(e, "a." + e, [bytes_of("a." + e)], ON_GRID + [["render", f"with_{e}.toml", "-o", "{out}/r.png"] + ONE])
          for e in ("vdb", "pbrt")],
        Kind("weights", "it.txt", [bytes_of("mask.txt")], [["grid", "a.pbrt", "-o", "{out}/g.vdb", "--mask", "{it}"] + ONE]),
        Kind("journal", "cut.part", [journal],
             [["fit", "fit.toml", "--photo", "photo.png", "--out", "cut", "--resume", "--max-evaluations", "2"] + ONE,
              ["fit", "fit.toml", "--photo", "photo.png", "--out", "cut", "--max-evaluations", "2"] + ONE]),
        Kind("map's journal", "cut.part", [map_journal],
             [["map", "map.toml", "--photo", "band.png", "--out", "cut", "--resume"] + MAP + ONE]),
        Kind("result", "run/result.json", [bytes_of("run/result.json")],
             [["compare", "run", "other"], ["to-netcdf", "run", "-o", "{out}/r.nc"],
              ["fit", "fit.toml", "--photo", "photo.png", "--out", "run", "--resume", "--max-evaluations", "2"] + ONE,
              ["fit", "fit.toml", "--photo", "photo.png", "--out", "run", "--max-evaluations", "2"] + ONE]),
        Kind("manifest", "frames/animation.json", [bytes_of("frames/animation.json")],
             [["animate", "small.toml", "-o", "frames/#.png", "--frames", "0:1"] + ONE]),
        Kind("rows", "sequence/frames/photo.json", [bytes_of("sequence/frames/photo.json")],
             [["sequence", "fit.toml", "--photos", "list.txt", "-o", "sequence", "--max-evaluations", "2"] + ONE]),
        Kind("survey", "it.toml", [bytes_of("survey.toml")], [["survey", "plan", "it.toml", "-o", "{out}/p.json"]]),
        Kind("frames of a survey", "frames.txt", [bytes_of("frames.txt")], [["survey", "plan", "survey.toml", "-o", "{out}/p.json"]]),
        Kind("plan", "it.json", [bytes_of("plan.json")],
             [["survey", "run", "{it}", "--out", "{out}/s"] + ONE, ["survey", "run", "{it}", "--out", "{out}/s", "--shard", "1/2"] + ONE]),
        Kind("database", "shards/shard-0001-of-0001.sqlite", [bytes_of("shards/shard-0001-of-0001.sqlite")],
             [["survey", "merge", "shards", "-o", "{out}/m.sqlite"], ["survey", "export", "shards/{it}", "-o", "{out}/w.csv"],
              ["survey", "export", "shards/{it}", "-o", "{out}/q.csv", "--table", "quantities"],
              ["survey", "export", "shards/{it}", "-o", "{out}/w.nc"],
              ["survey", "report", "shards/{it}", "-o", "{out}/pages"],
              ["survey", "smooth", "shards/{it}", "-o", "{out}/v.sqlite"],
              ["survey", "run", "plan.json", "--out", "shards"] + ONE]),
        Kind("words", None, [b"sheet.main.energy_kev=3.5", b"camera.width=64", b"fit.free=[]", b"sky.level=[1.0, 2.0, 3.0]",
                             b"sheet.main.center_km=[10.0, 220.0]", b'sensor.response="grey"'],
             [["render", "small.toml", "-o", "{out}/r.png", "--set", "{it}"] + CAMERA + ONE, ["profile", "{it}", "-o", "{out}/p.csv"],
              ["{it}"], ["compare", "{it}"], ["keogram", "photo.png", "second.png", "-o", "{out}/k.csv", "--roi", "{it}"],
              ["profile", "photo.png", "-o", "{out}/p.csv", "--decoding", "{it}"],
              ["mask", "photo.png", "-o", "{out}/m.png", "--polygon", "{it}"]]),
    ]
    return kinds


def small_map():
    """A FITS map of precipitation, two cells by two."""
    cards = {"SIMPLE": "T", "BITPIX": "-32", "NAXIS": "3", "NAXIS1": "2", "NAXIS2": "2", "NAXIS3": "2"}
    for axis, name in (("1", "'EAST'"), ("2", "'NORTH'")):
        cards |= {"CTYPE" + axis: name, "CUNIT" + axis: "'km'", "CRPIX" + axis: "1.0", "CRVAL" + axis: "200.0", "CDELT" + axis: "20.0"}
    cards |= {"SITELAT": "65.0", "SITELONG": "0.0"}
    header = "".join(f"{key:<8}= {value if value[0] == chr(39) else value.rjust(20)}".ljust(80) for key, value in cards.items()) + "END"
    numbers = b"".join(struct.pack(">f", number) for number in (1.0, 2.0, 0.0, 3.5, 2.0, 3.0, 0.0, 4.5))
    return header.ljust(2880).encode() + numbers.ljust(2880, b"\0")


def solved_field(rows):
    """A table of stars as solve-field writes it: FITS, whole numbers."""
    def block(cards):
        return "".join(c.ljust(80) for c in cards + ["END"]).encode().ljust(2880)

    def card(key, value):
        return f"{key:8}= {value:>20}" if not value.startswith("'") else f"{key:8}= {value}"
    names = ["field_x", "field_y", "index_ra", "index_dec"]
    table = [card("XTENSION", "'BINTABLE'")] + [card(k, str(v)) for k, v in (
        ("BITPIX", 8), ("NAXIS", 2), ("NAXIS1", 16), ("NAXIS2", rows), ("PCOUNT", 0), ("GCOUNT", 1), ("TFIELDS", 4))]
    for i, name in enumerate(names, 1):
        table += [card(f"TTYPE{i}", f"'{name}'"), card(f"TFORM{i}", "'1J'")]
    head = ["SIMPLE  =                    T", card("BITPIX", "8"), card("NAXIS", "0")]
    numbers = b"".join(n.to_bytes(4, "big") for r in range(rows) for n in (3 + 7 * r, 5 + 4 * r, 200 + 9 * r, 30 + 3 * r))
    return block(head) + block(table) + numbers.ljust(2880, b"\0")


def make_journal(vegard, home, words):
    """Finished steps, as a kill leaves them; of the same work as of the commands that read them."""
    words = [vegard, *words, "--out", "cut", *ONE]
    # The journal goes when the work is done: it is watched while it grows.
    longest = b""
    job = subprocess.Popen(words, cwd=home, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while job.poll() is None:
        try:
            longest = max(longest, (home / "cut.part").read_bytes(), key=len)
        except OSError:
            pass
        time.sleep(0.0005)
    shutil.rmtree(home / "cut", ignore_errors=True)
    if not longest:
        sys.exit(f"damage.py: {words[1]} left no journal to damage")
    return longest


# --- damage

EDGES = [0, 1, 2, 0x7F, 0x80, 0xFF, 0x100, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 40000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF,
         2**63 - 1, 2**64 - 1]
NUMBERS = [b"0", b"-1", b"1e308", b"1e-308", b"4294967296", b"9223372036854775807", b"nan", b"inf", b"-inf", b"0.5", b"-0.0",
           b"40000", b"1" * 400]
TRICKS = [b"\0", b"\x1b[2J\x1b[31m", b"\x1b]0;title\x07", b"\xff\xfe", b"\xef\xbb\xbf", b"\r", b"\r\n" * 40, b"\xc3\x28", b"\xe2\x80\xae",
          b"[" * 5000, b"{" * 5000, b'"' * 99, b"a." * 4000 + b"b = 1\n", b"\n" * 5000, b"x" * 70000, b"%s%n%1000000d", b"../" * 40,
          b"'''", b'"""', b"#" * 300, b",,,,,,,,", b"\x9b31m", b"$(touch it)", b"-", b"--help", b"\t" * 500]


def piece(dice, data):
    at = dice.randrange(len(data))
    return at, min(len(data), at + 1 + dice.randrange(1 << dice.randrange(1, 12)))


def place(dice, data):
    """In the first bytes rather often: lies of size stand there."""
    return dice.randrange(min(len(data), 256)) if dice.random() < 0.5 else dice.randrange(len(data))


def flips(dice, data):
    for _ in range(1 + dice.randrange(8)):
        data[place(dice, data)] ^= 1 << dice.randrange(8)
    return data


def truncation(dice, data):
    return data[:dice.randrange(len(data))]


def hole(dice, data):
    at, end = piece(dice, data)
    return data[:at] + data[end:]


def swap(dice, data):
    a, b = sorted((piece(dice, data), piece(dice, data)))
    return data[:a[0]] + data[b[0]:b[1]] + data[a[1]:b[0]] + data[a[0]:a[1]] + data[b[1]:]


def repeat(dice, data):
    at, end = piece(dice, data)
    return data[:end] + data[at:end] * (1 + dice.randrange(50)) + data[end:]


def size(dice, data):
    edge = dice.choice(EDGES).to_bytes(8, "little")[:1 << dice.randrange(4)]
    at = place(dice, data)
    data[at:at + len(edge)] = edge if dice.random() < 0.5 else edge[::-1]
    return data


def number(dice, data):
    digits = [i for i, c in enumerate(data[:20000]) if chr(c).isdigit()]
    if not digits:
        return size(dice, data)
    at = dice.choice(digits)
    end = at
    while end < len(data) and (chr(data[end]).isdigit() or data[end] == 46):
        end += 1
    return data[:at] + dice.choice(NUMBERS) + data[end:]


def trick(dice, data):
    at = place(dice, data)
    return data[:at] + dice.choice(TRICKS) + data[at:]


def growth(dice, data):
    return data + dice.choice([bytes(1 << 20), bytes(dice.randrange(256) for _ in range(5000)), bytes(data[-64:]) * 20000])


def empty(dice, data):
    return bytearray()


DAMAGES = [flips, flips, truncation, truncation, hole, swap, repeat, size, size, number, number, trick, trick, growth, empty]
NO_FILES = ["missing", "folder", "pipe", "zeros", "loop"]


class Input:
    """Number `index` of the run: a kind, what was done to it, and a command. A pure function of seed and index."""

    def __init__(self, kinds, seed, index):
        dice = random.Random(f"{seed}/{index}")
        self.kind = kinds[index % len(kinds)]
        self.command = dice.choice(self.kind.commands)
        self.special, self.data = None, None
        chance = dice.random()
        if self.kind.place and chance < 0.04:
            self.special = self.damage = dice.choice(NO_FILES)
        elif self.kind.place and chance < 0.10:
            other = dice.choice([k for k in kinds if k.place and k is not self.kind])
            self.damage, self.data = "a " + other.name, bytes(dice.choice(other.seeds))
        else:
            data = bytearray(dice.choice(self.kind.seeds))
            done = []
            for _ in range(dice.choice([1, 1, 2, 3])):
                if data:
                    how = dice.choice(DAMAGES)
                    data = bytearray(how(dice, data))
                    done.append(how.__name__)
            self.damage, self.data = "+".join(done), bytes(data)

    def words(self, work, out):
        it = str(pathlib.Path(self.kind.place or "").name) if self.kind.place else ""
        if not self.kind.place:  # a word of the command line has no zero, and an end
            it = os.fsdecode(self.data.replace(b"\0", b"")[:100000])
        return [w.replace("{out}", out).replace("{it}", it) for w in self.command]

    def put(self, work):
        if not self.kind.place:
            return
        place = work / self.kind.place
        if place.exists() or place.is_symlink():
            place.unlink()
        if self.special is None:
            place.write_bytes(self.data)
        elif self.special == "folder":
            place.mkdir()
        elif self.special == "pipe":
            os.mkfifo(place)
        elif self.special == "zeros":
            place.symlink_to("/dev/zero")
        elif self.special == "loop":
            place.symlink_to(place.name)


class End:
    """How a run ended."""

    def __init__(self, code, killed, seconds, megabytes, message, left, output):
        self.code, self.killed, self.seconds, self.megabytes = code, killed, seconds, megabytes
        self.message, self.left, self.output = message, left, output

    def finding(self):
        """What is wrong with it; None if nothing is."""
        if self.killed:
            return "hang"
        if self.code < 0:
            return "crash (" + signal.Signals(-self.code).name + ")"
        if self.code == 1:
            return "internal error"
        if self.code not in DOCUMENTED:
            return f"exit code {self.code}"
        if self.code not in REFUSALS:
            return None
        if self.megabytes > REFUSED_MOST_MB:
            return "memory"
        if self.left:
            return "left behind"
        lines = [line for line in self.message.split(b"\n") if line.strip()]
        if len(lines) != 1:
            return "no message" if not lines else "several messages"
        if len(self.message) > MESSAGE_MOST_BYTES:
            return "long message"
        if any(c < 32 and c not in (9, 10) or c == 127 for c in self.message):
            return "control characters"
        return None


FINDINGS = ["hang", "crash", "internal error", "exit code", "memory", "left behind", "no message", "several messages",
            "long message", "control characters"]


def spent(process):
    """Seconds that it has worked, and that it has waited for a processor, which is the machine's affair."""
    try:
        worked, waited = pathlib.Path(f"/proc/{process}/schedstat").read_text().split()[:2]
        return int(worked) / 1e9, int(waited) / 1e9
    except (OSError, ValueError):
        return 0.0, 0.0


def run(words, work, out, seconds, gigabytes):
    """A hang is one that works for longer than `seconds`, or sleeps for so long."""
    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 1))
        resource.setrlimit(resource.RLIMIT_AS, (gigabytes << 30, gigabytes << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
    begin = time.monotonic()
    with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as told:
        job = subprocess.Popen(words, cwd=work, stdin=subprocess.DEVNULL, stdout=told, stderr=said, preexec_fn=limits)
        hung, pause, ended = False, 0.001, 0
        while not ended:
            ended, status, usage = os.wait4(job.pid, os.WNOHANG)
            if ended:
                break
            if time.monotonic() - begin > seconds and not hung:
                worked, waited = spent(job.pid)
                if worked > seconds or time.monotonic() - begin - worked - waited > seconds:
                    hung = True
                    job.kill()
            time.sleep(pause)
            pause = min(0.05, 1.2 * pause)
        job.returncode = code = -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
        said.seek(0)
        told.seek(0)
        message, output = said.read(1 << 20), told.read(1 << 12)
    hung = hung or usage.ru_utime + usage.ru_stime > seconds
    left = sorted(os.listdir(out)) if code in REFUSALS or code < 0 else []
    return End(code, hung, time.monotonic() - begin, usage.ru_maxrss / 1024, message, left, output)


def keep(folder, index, one, words, end, finding):
    """The finding's folder: the input, the words, what was said."""
    place = folder / f"{index:05d}-{one.kind.name}"
    place.mkdir(parents=True, exist_ok=True)
    if one.data is not None:
        (place / pathlib.Path(one.kind.place or "word").name).write_bytes(one.data)
    (place / "about.json").write_text(json.dumps({
        "finding": finding, "damage": one.damage, "words": words, "code": end.code, "seconds": round(end.seconds, 2),
        "megabytes": round(end.megabytes), "message": end.message[:4000].decode(errors="backslashreplace"),
        "output": end.output[:1000].decode(errors="backslashreplace"), "left": end.left}, indent=1) + "\n")


def table(rows, heads):
    widths = [max(len(str(row[i])) for row in rows + [heads]) for i in range(len(heads))]
    for row in [heads] + rows:
        print("  ".join(str(c).ljust(w) if i == 0 else str(c).rjust(w) for i, (c, w) in enumerate(zip(row, widths))))


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--binary", default=str(SOURCE / "build/release/vegard"))
    words.add_argument("--inputs", type=int, default=2000)
    words.add_argument("--seed", default="1")
    words.add_argument("--first", type=int, default=0, help="number of the first input: to see one of them again")
    words.add_argument("--seconds", type=float, default=10.0, help="that a run may work, or sleep (default 10)")
    words.add_argument("--memory-gb", type=int, default=8, help="address space of each run (default 8)")
    words.add_argument("--only", action="append", help="only this kind of input; may be repeated")
    words.add_argument("--allow", action="append", default=[], choices=FINDINGS, help="count it, but let it pass; may be repeated")
    words.add_argument("--findings", default="damage-findings", help="folder for what is found (default damage-findings)")
    options = words.parse_args()
    vegard = os.path.abspath(options.binary)
    if not os.access(vegard, os.X_OK):
        words.error(f"--binary: there is no program {vegard}")

    counts, worst, found = {}, {}, []
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="vegard-damage-") as folder:
        home, work = pathlib.Path(folder) / "sound", pathlib.Path(folder) / "work"
        home.mkdir()
        kinds = make_kinds(vegard, home)
        if options.only:
            unknown = set(options.only) - {k.name for k in kinds}
            if unknown:
                words.error(f"--only: no such kind: {', '.join(sorted(unknown))}")
        wanted = (i for i in itertools.count(options.first)
                  if not options.only or kinds[i % len(kinds)].name in options.only)
        for done, index in enumerate(itertools.islice(wanted, options.inputs), 1):
            one = Input(kinds, options.seed, index)
            shutil.rmtree(work, ignore_errors=True)
            shutil.copytree(home, work)
            out = work / "out"
            out.mkdir()
            one.put(work)
            before = set(os.listdir(work))
            told = one.words(work, "out")
            end = run([vegard, *told], work, out, options.seconds, options.memory_gb)
            if end.code in REFUSALS:  # beside the inputs neither
                end.left += sorted(set(os.listdir(work)) - before)
            finding = end.finding()
            tally = counts.setdefault(one.kind.name, {})
            for column in ["runs", "exit %d" % end.code if end.code >= 0 and not end.killed else None,
                           next((f for f in FINDINGS if finding and finding.startswith(f)), None)]:
                if column:
                    tally[column] = tally.get(column, 0) + 1
            if end.code in REFUSALS:
                worst[one.kind.name] = max(worst.get(one.kind.name, 0), end.megabytes)
            if finding:
                found.append((index, one, finding))
                keep(pathlib.Path(options.findings), index, one, told, end, finding)
                print(f"{index}: {one.kind.name}, {one.damage}: {finding}: vegard "
                      + " ".join(w if len(w) < 60 else w[:60] + "..." for w in told).encode(errors="backslashreplace")
                      .decode().replace("\x1b", "\\x1b"), flush=True)
            if done % 100 == 0 and done < options.inputs:
                print(f"{done} of {options.inputs} inputs, {len(found)} findings, {time.monotonic() - begin:.0f} s",
                      file=sys.stderr, flush=True)

    codes = sorted({c for tally in counts.values() for c in tally if c.startswith("exit ") and c != "exit code"})
    heads = ["input", "runs", *codes, *[f for f in FINDINGS if any(f in t for t in counts.values())], "refused, most MB"]
    rows = [[name, *[tally.get(h, 0) for h in heads[1:-1]], round(worst.get(name, 0))] for name, tally in counts.items()]
    rows.append(["all", *[sum(row[i] for row in rows) for i in range(1, len(heads) - 1)], round(max([*worst.values(), 0]))])
    print()
    table(rows, heads)
    bad = [f for _, _, f in found if not any(f.startswith(a) for a in options.allow)]
    print(f"{sum(t['runs'] for t in counts.values())} damaged inputs of seed {options.seed}: {len(found)} findings"
          + (f", kept in {options.findings}" if found else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
