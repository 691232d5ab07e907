#!/usr/bin/env python3
"""Made pairs through `vegard measure`: do the 68 % intervals of the border's height hold the truth?

made_pairs.py VEGARD DATA FOLDER [COUNT [FIRST]] draws COUNT geometries (bases of 20 to 500 km, fisheyes and
phones, arcs and bands), renders both pictures, and measures them with cameras that are turned and clocks that
are off as the options say, while the light drifts. It prints a line for each pair and fails if, of 20 and more heights
that are called good, not 55 to 80 % of the intervals hold the truth, or one is wrong by four errors.
The truth is the height of half of the peak of 557.7 nm by Maxwellian electrons of the same energy.
"""
import csv
import json
import math
import os
import random
import subprocess
import sys

RADIUS = 6371.0
FOOT = RADIUS + 110.0
POINTING_DEG, CLOCK_S, DRIFT_KM_S = 0.1, 2.0, 0.5
ARC_LATITUDE, LONGITUDE = 68.0, 20.0


def border_heights(data):
    """Half of the peak of each energy, (ln E, km)."""
    rows = {}
    with open(os.path.join(data, "emission", "ver_maxwellian.csv"), encoding="utf-8") as table:
        for row in csv.DictReader(table):
            if float(row["oxygen_factor"]) == 1.0:
                rows.setdefault(float(row["E0_keV"]), []).append((float(row["altitude_km"]), float(row["ver_5577"])))
    heights = []
    for energy, profile in sorted(rows.items()):
        top = max(range(len(profile)), key=lambda i: profile[i][1])
        half, i = 0.5 * profile[top][1], top
        while i > 0 and profile[i][1] > half:
            i -= 1
        (low_km, low), (high_km, high) = profile[i], profile[i + 1]
        heights.append((math.log(energy), low_km + (half - low) / (high - low) * (high_km - low_km)))
    return heights


def border_km(heights, energy_kev):
    x = math.log(energy_kev)
    for (a, low), (b, high) in zip(heights, heights[1:]):
        if a <= x <= b:
            return low + (x - a) / (b - a) * (high - low)
    raise ValueError("no such energy")


def axes(latitude_deg, longitude_deg):
    la, lo = math.radians(latitude_deg), math.radians(longitude_deg)
    return ((-math.sin(lo), math.cos(lo), 0.0),
            (-math.sin(la) * math.cos(lo), -math.sin(la) * math.sin(lo), math.cos(la)),
            (math.cos(la) * math.cos(lo), math.cos(la) * math.sin(lo), math.sin(la)))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def combined(vectors, factors):
    return tuple(dot([v[i] for v in vectors], factors) for i in range(3))


def in_plane(site, unit):
    """East and north of a direction from the Earth's centre in a site's tangent plane at 110 km."""
    east, north, up = (dot(axis, unit) for axis in axes(*site))
    return FOOT * east / up, FOOT * north / up


def moved(site, towards_deg, km):
    """The place this far along the ground."""
    east, north, up = axes(*site)
    c, s = math.cos(km / RADIUS), math.sin(km / RADIUS)
    t = math.radians(towards_deg)
    unit = combined((east, north, up), (s * math.sin(t), s * math.cos(t), c))
    return math.degrees(math.asin(unit[2])), math.degrees(math.atan2(unit[1], unit[0]))


def direction_to(site, place):
    """Azimuth of a place, and its distance along the ground."""
    unit = axes(*place)[2]
    east, north, up = (dot(axis, unit) for axis in axes(*site))
    return math.degrees(math.atan2(east, north)), RADIUS * math.atan2(math.hypot(east, north), up)


def camera_lines(kind, azimuth_deg, elevation_deg, roll_deg):
    if kind == "fisheye":
        size = 'model = "equidistant"\nwidth = 500\nheight = 500\nfocal_px = 155.0\n'
    else:
        size = "width = 800\nheight = 600\nhfov_deg = 67.0\n"
    return f"[camera]\n{size}azimuth_deg = {azimuth_deg}\nelevation_deg = {elevation_deg}\nroll_deg = {roll_deg}\n"


def white_mask(file, width, height):
    with open(file, "wb") as mask:
        mask.write(f"P5 {width} {height} 255\n".encode() + b"\xff" * (width * height))


def make_pair(seed, folder, heights):
    """Writes both scenes and what is believed of the cameras; returns the options and the truth."""
    dice = random.Random(seed)
    kind = dice.choice(["fisheye", "fisheye", "phone"])
    form = dice.choice(["homogeneous_arc", "rayed_arc", "rayed_band"])
    base_km = math.exp(dice.uniform(math.log(20.0), math.log(500.0)))
    base_deg = dice.uniform(0.0, 360.0)
    energy_kev = math.exp(dice.uniform(math.log(2.5), math.log(11.0)))
    bearing_deg = dice.uniform(70.0, 110.0)
    # The middle of the base is south of the arc.
    arc = (ARC_LATITUDE, LONGITUDE)
    middle = moved(arc, 180.0 + dice.uniform(-40.0, 40.0), dice.uniform(60.0, 220.0))
    sites = [moved(middle, base_deg + 180.0, 0.5 * base_km), moved(middle, base_deg, 0.5 * base_km)]
    velocity = [dice.gauss(0.0, DRIFT_KM_S), dice.gauss(0.0, DRIFT_KM_S)]
    apart_s = dice.choice([0.0, 0.0, 5.0, 20.0])
    late_s = [dice.gauss(0.0, CLOCK_S), apart_s + dice.gauss(0.0, CLOCK_S)]
    options = []
    for i, site in enumerate(sites):
        seen = moved(arc, math.degrees(math.atan2(velocity[0], velocity[1])), math.hypot(*velocity) * late_s[i])
        unit = axes(*seen)[2]
        center = in_plane(site, unit)
        bearing = math.radians(bearing_deg)
        # The course of the arc at its middle, carried into the site's plane.
        east, north, up = axes(*seen)
        ahead = combined((east, north, up), (0.01 * math.sin(bearing), 0.01 * math.cos(bearing), 1.0))
        ahead = in_plane(site, combined((ahead,), (1.0 / math.sqrt(dot(ahead, ahead)),)))
        course = math.degrees(math.atan2(ahead[0] - center[0], ahead[1] - center[1]))
        azimuth, distance = direction_to(site, seen)
        pose = [0.0, 90.0, 0.0]
        if kind == "phone":
            pose = [azimuth + dice.uniform(-8.0, 8.0), min(60.0, 8.0 + math.degrees(math.atan2(105.0, distance))), 0.0]
        believed = [angle + dice.gauss(0.0, POINTING_DEG) for angle in pose]
        if kind == "fisheye":  # two tilts and a turn
            tilt, side = math.hypot(dice.gauss(0.0, POINTING_DEG), dice.gauss(0.0, POINTING_DEG)), dice.uniform(0.0, 360.0)
            believed = [side, 90.0 - tilt, math.remainder(-side + dice.gauss(0.0, POINTING_DEG), 360.0)]
        where = f"[site]\nlatitude_deg = {site[0]}\nlongitude_deg = {site[1]}\n"
        with open(f"{folder}/{i}.scene.toml", "w", encoding="utf-8") as scene:
            scene.write(f'seed = {seed}\n{where}[field]\nmodel = "dipole"\n{camera_lines(kind, *pose)}'
                        f"[sensor]\ngain_per_kilorayleigh = {dice.uniform(0.03, 0.08)}\n"
                        '[sky]\nlevel = [0.004, 0.006, 0.008]\n'
                        f'[[sheet]]\nform = "{form}"\ncenter_km = [{center[0]}, {center[1]}]\nbearing_deg = {course}\n'
                        f'profile = "maxwellian"\nenergy_kev = {energy_kev}\nibc = 2.5\n')
        with open(f"{folder}/{i}.toml", "w", encoding="utf-8") as camera:
            camera.write(where + camera_lines(kind, *believed))
        white_mask(f"{folder}/sky.pgm", *((500, 500) if kind == "fisheye" else (800, 600)))
        at_s = 40.0 + (apart_s if i == 1 else 0.0)
        options += ["--camera", f"{folder}/{i}.toml", "--mask", f"{folder}/sky.pgm",
                    "--time", f"2014-02-21T19:30:{at_s - 20:06.3f}Z"]
    words = f"{kind}, {form}, base {base_km:.0f} km towards {base_deg:.0f}, {apart_s:.0f} s apart"
    return options, border_km(heights, energy_kev), words


def measured(vegard, folder, options):
    for i in (0, 1):
        subprocess.run([vegard, "render", f"{folder}/{i}.scene.toml", "-o", f"{folder}/{i}.png", "--overwrite"],
                       check=True, capture_output=True)
    code = subprocess.run([vegard, "measure", f"{folder}/0.png", f"{folder}/1.png", *options, "--earth", "sphere",
                           "--pointing-error", str(POINTING_DEG), "--no-map", "--out", f"{folder}/run", "--overwrite"],
                          capture_output=True, check=False).returncode
    if code not in (0, 5):
        raise RuntimeError(f"vegard measure: exit code {code}")
    with open(f"{folder}/run/together.json", encoding="utf-8") as file:
        return code, json.load(file)["pairs"][0]


def main():
    vegard, data, folder = sys.argv[1:4]
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 100
    first = int(sys.argv[5]) if len(sys.argv) > 5 else 1
    heights = border_heights(data)
    given = held = good = good_held = wrong = 0
    for seed in range(first, first + count):
        place = os.path.join(folder, str(seed))
        os.makedirs(place, exist_ok=True)
        options, truth_km, words = make_pair(seed, place, heights)
        code, pair = measured(vegard, place, options)
        height = pair.get("border")
        if height is None:
            print(f"{seed}: {words}: none", flush=True)
            continue
        off = (height["height_km"] - truth_km) / height["height_error_km"]
        print(f"{seed}: {words}: {height['height_km']:.1f} ± {height['height_error_km']:.1f} km, truth {truth_km:.1f}, "
              f"{off:+.1f} errors, by {height['by']}{', good' if code == 0 else ''}", flush=True)
        given += 1
        held += abs(off) <= 1.0
        if code == 0:
            good += 1
            good_held += abs(off) <= 1.0
            wrong += abs(off) > 4.0
    share = good_held / max(1, good)
    print(f"{given} heights of {count} pairs, {100 * held / max(1, given):.0f} % of the intervals hold the truth; "
          f"{good} are called good, of these {100 * share:.0f} %; {wrong} of these are off by four errors and more")
    return 0 if wrong == 0 and (good < 20 or 0.55 <= share <= 0.80) else 1


if __name__ == "__main__":
    sys.exit(main())
