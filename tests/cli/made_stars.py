#!/usr/bin/env python3
"""Writes stars.pgm, empty.pgm and camera.toml into the folder that it is called in: an all-sky picture of the stars of a
catalogue, data/stars/bright_stars.csv, as they stand over 65 N at 2000-01-01T12:00Z, when their places are those of the
catalogue. A count per second is 25 R of 557.7 nm through a filter of 2 nm, an exposure lasts 200 s, the air takes 0.3
magnitudes an airmass, the sky has 10 counts per second in each pixel and the camera 100 counts of dark level. A count is an electron: its noise is
that of photons (normal; seed 1).

    made_stars.py data/stars/bright_stars.csv
"""
import csv
import math
import random
import sys

CAMERA = """[site]
latitude_deg = 65.0
longitude_deg = 150.0
altitude_m = 0.0
[camera]
model = "equidistant"
width = 384
height = 384
focal_px = 120.0
azimuth_deg = 0.0
elevation_deg = 90.0
roll_deg = 0.0
"""

f, side, exposure, factor = 120.0, 384, 200.0, 25.0
pixels = [10.0 * exposure] * (side * side)
latitude = math.radians(65.0)
sidereal = math.radians((280.46062 + 150.0) % 360)
share = lambda a, c: 0.5 * (math.erf((a + 1 - c) / 1.1314) - math.erf((a - c) / 1.1314))
for star in csv.DictReader(open(sys.argv[1])):
    ra, dec = math.radians(float(star["ra_deg"])), math.radians(float(star["dec_deg"]))
    hour = sidereal - ra
    up = math.sin(latitude) * math.sin(dec) + math.cos(latitude) * math.cos(dec) * math.cos(hour)
    east = -math.cos(dec) * math.sin(hour)
    north = math.cos(latitude) * math.sin(dec) - math.sin(latitude) * math.cos(dec) * math.cos(hour)
    elevation = math.degrees(math.asin(up))
    if elevation < 8:
        continue
    zenith, azimuth = math.acos(up), math.atan2(east, north)
    x, y = side / 2 + f * zenith * math.sin(azimuth), side / 2 + f * zenith * math.cos(azimuth)
    if not (10 < x < side - 10 and 10 < y < side - 10):
        continue
    v, bv = float(star["magnitude"]), float(star["colour_index"] or 0.6)
    # Vega's light at 555.6 nm, the library's 0.991 to 1.005 of it at 557.7 nm.
    watts = 3.44e-11 * 10 ** (-0.4 * (v - 0.03) + 0.028 * bv) * 0.991 * (1.005 / 0.991) ** bv
    photons = 2.0 * watts * 557.7e-9 / 1.98644586e-25 * 1e-4
    omega = math.sin(zenith) / zenith / (f * f) if zenith > 0 else 1 / (f * f)
    airmass = 1 / (up + 0.50572 * (elevation + 6.07995) ** -1.6364)
    counts = exposure / factor * photons * 4 * math.pi / (1e6 * omega) * 10 ** (-0.4 * 0.3 * airmass)
    for j in range(int(y) - 8, int(y) + 9):
        for i in range(int(x) - 8, int(x) + 9):
            pixels[j * side + i] += counts * share(i, x) * share(j, y)
random.seed(1)
pixels = [100.0 + random.gauss(p, math.sqrt(p)) for p in pixels]
with open("stars.pgm", "wb") as out:
    out.write(b"P5 %d %d 65535\n" % (side, side) + b"".join(max(0, min(65535, round(p))).to_bytes(2, "big") for p in pixels))
with open("empty.pgm", "wb") as out:
    out.write(b"P5 %d %d 65535\n" % (side, side) + (300).to_bytes(2, "big") * (side * side))
with open("camera.toml", "w") as out:
    out.write(CAMERA)
