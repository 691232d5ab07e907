#!/usr/bin/env python3
"""Counts false claims and misses of `vegard border` on real skies marked by eye.

usage: borders.py VEGARD [--table]

The pictures are those of $VEGARD_PHOTOS, or of shared/photos beside the repository; without them the exit code is 77. --table
prints a row for each frame. A claimed trace is false if fewer than half of its points lie within 3 degrees of a mark (the
cameras are rough), and a marked border missed if fewer than half of it lies as near to a claimed trace.
"""
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PHOTOS = pathlib.Path(os.environ.get("VEGARD_PHOTOS", HERE.parents[2] / "shared/photos"))
NEAR_DEG = 3.0
# One claim in 25 frames without aurora. Where there is aurora the aim is one in ten, false and missed; today's counts are 2 of
# 24 and 3 of 19 (docs/border.md): one more false or missed fails this test.
MOST_FALSE_WITHOUT, MOST_FALSE_SHARE, MOST_MISSED_SHARE = 1, 0.12, 0.2


def rows_of(name):
    with open(HERE / name, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Frame:
    def __init__(self, row):
        self.file, self.sky, self.circle = row["file"], row["sky"], row["circle"]
        self.size = int(row["width"]), int(row["height"])
        self.focal, self.x, self.y, self.elevation = (float(row[key]) for key in ("focal_px", "x_px", "y_px", "elevation_deg"))
        self.azimuth = 180.0 if self.elevation == 90.0 else 0.0
        self.marks = []

    def scene(self):
        return (f"[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nmodel = \"equidistant\"\nwidth = {self.size[0]}\n"
                f"height = {self.size[1]}\nfocal_px = {self.focal}\nprincipal_x_px = {self.x - self.size[0] / 2}\n"
                f"principal_y_px = {self.y - self.size[1] / 2}\nazimuth_deg = {self.azimuth}\nelevation_deg = {self.elevation}\n")

    def pixel(self, azimuth_deg, elevation_deg):
        a, e, camera_a, camera_e = (math.radians(v) for v in (azimuth_deg, elevation_deg, self.azimuth, self.elevation))
        east, north, up = math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e)
        forward = (math.sin(camera_a) * math.cos(camera_e), math.cos(camera_a) * math.cos(camera_e), math.sin(camera_e))
        right = (math.cos(camera_a), -math.sin(camera_a), 0.0)
        over = (-math.sin(camera_a) * math.sin(camera_e), -math.cos(camera_a) * math.sin(camera_e), math.cos(camera_e))
        z, x, y = (sum(p * q for p, q in zip((east, north, up), axis)) for axis in (forward, right, over))
        radius, off = math.hypot(x, y), self.focal * math.atan2(math.hypot(x, y), z)
        return (self.x + off * x / radius, self.y - off * y / radius) if radius else (self.x, self.y)

    def near_px(self):
        return self.focal * math.radians(NEAR_DEG)


def samples_of(line, step):
    """Points along a line of points, `step` apart."""
    out = []
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        count = max(1, round(math.hypot(bx - ax, by - ay) / step))
        out += [(ax + (bx - ax) * i / count, ay + (by - ay) * i / count) for i in range(count + 1)]
    return out


def share_near(points, others, near):
    hits = sum(any(math.hypot(x - u, y - v) <= near for u, v in others) for x, y in points)
    return hits / len(points) if points else 0.0


def claims_of(program, frame, folder):
    """The pixels of each claimed trace."""
    photo = str(PHOTOS / frame.file)
    scene = folder / "scene.toml"
    scene.write_text(frame.scene(), encoding="utf-8")
    mask = [program, "mask", photo, "-o", str(folder / "mask.png"), "--text"]
    if frame.circle:
        mask += ["--circle", frame.circle]
    command = [program, "border", str(scene), "--photo", photo, "--out", str(folder / "run"), "--no-metadata"]
    if subprocess.run(mask, capture_output=True, check=False).returncode == 0:
        command += ["--mask", str(folder / "mask.png")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 5):
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    traces = {}
    with open(folder / "run/border.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["elevation_deg"] and not row["doubt"]:
                pixel = frame.pixel(float(row["azimuth_deg"]), float(row["elevation_deg"]))
                traces.setdefault(row["trace"], []).append(pixel)
    return list(traces.values())


def main():
    program, shown = os.path.abspath(sys.argv[1]), "--table" in sys.argv[2:]
    frames = {row["file"]: Frame(row) for row in rows_of("border_frames.csv")}
    if not all((PHOTOS / name.split("#")[0]).exists() for name in frames):
        print(f"the pictures are not in {PHOTOS}: nothing is tried")
        return 77
    for row in rows_of("border_marks.csv"):
        numbers = [float(v) for v in row["line_px"].split()]
        frames[row["file"]].marks.append((row["mark"], list(zip(numbers[::2], numbers[1::2]))))
    false_without = false_with = claimed_with = marked = missed = 0
    for frame in frames.values():
        with tempfile.TemporaryDirectory() as folder:
            claims = claims_of(program, frame, pathlib.Path(folder))
        near = frame.near_px()
        seen = [p for _, line in frame.marks for p in samples_of(line, near / 3)]
        false = sum(share_near(claim, seen, near) < 0.5 for claim in claims)
        lost = []
        for mark, line in frame.marks:
            if mark == "border":
                share = share_near(samples_of(line, near / 3), [p for claim in claims for p in claim], near)
                lost.append(share < 0.5)
        if frame.sky == "none":
            false_without += false
        else:
            false_with, claimed_with = false_with + false, claimed_with + len(claims)
            marked, missed = marked + len(lost), missed + sum(lost)
        if shown or (frame.sky == "none" and false):
            print(f"{frame.file}: {frame.sky}; {len(claims)} claimed, {false} false; {len(lost)} marked, {sum(lost)} missed")
    without = sum(frame.sky == "none" for frame in frames.values())
    print(f"without aurora: {false_without} claimed in {without} frames; with aurora: {false_with} of {claimed_with} claimed are "
          f"false, {missed} of {marked} marked are missed")
    good = (false_without <= MOST_FALSE_WITHOUT and false_with <= MOST_FALSE_SHARE * claimed_with
            and missed <= MOST_MISSED_SHARE * marked)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
