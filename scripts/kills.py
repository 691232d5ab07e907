#!/usr/bin/env python3
"""Kills vegard at random moments, lets it go on or run again, and compares with a run that nobody disturbed.

Seven commands of some seconds each: a fit and a map (go on with --resume), a sequence, a survey by two processes and
an animation (go on by themselves), a picture and a grid (made again with --overwrite, in the place of an older file).
Of a survey the merged database counts, since its shards tell how often they were written to. Of the kills most are
SIGKILL, some SIGTERM and SIGINT. A killed command may leave what it goes on with, or a temporary beside its output.
What it must not do: leave half a file under the output's name. After the second run every byte is that of the
undisturbed one, and nothing stands beside the outputs that does not stand there then.

The same --seed draws the same moments, as shares of the time that the undisturbed run took. The exit code is 1 if there
is a finding.
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
SCENES = SOURCE / "tests/cli/scenes"
OLD = b"an older file, to be replaced whole or not at all"
ONE = ["--threads", "1"]
SAY_COMMAND = (".json", ".html", ".toml")
DOUBTED = 5  # of a map or a fit that is done, and to be taken with care
SIGNALS = [signal.SIGKILL] * 6 + [signal.SIGTERM] * 2 + [signal.SIGINT] * 2
# What an interruption ends with: by the program, and by the system before the program listens.
ENDS = {signal.SIGKILL: {-signal.SIGKILL}, signal.SIGTERM: {143, -signal.SIGTERM}, signal.SIGINT: {130, -signal.SIGINT}}


class Job:
    """A command that writes into the folder "out", and what to call when it was killed."""

    def __init__(self, name, words, again=(), old=None, done=(0,), then=()):
        """`then`: words of a command that makes what is in "out" of what the first has left in "shards"."""
        self.name, self.words, self.old, self.done, self.then = name, list(words), old, done, list(then)
        self.again = self.words + [w for w in again if w not in self.words]

    def prepare(self, folder):
        for name in ("out", "shards"):
            shutil.rmtree(folder / name, ignore_errors=True)
        (folder / "out").mkdir()
        if self.old:
            (folder / "out" / self.old).write_bytes(OLD)


def jobs():
    small, fit = str(SCENES / "small.toml"), str(SCENES / "fit.toml")
    return [
        Job("fit", ["fit", fit, "--photo", "photo.png", "--out", "out/run", "--set", "sheet.main.beams=1000",
                    "--set", "fit.scan_points=6", *ONE], ["--resume"]),
        Job("map", ["map", str(SCENES / "map.toml"), "--photo", "band.png", "--out", "out/map", "--replicates", "2",
                    "--sparsity", "4", *ONE], ["--resume"], done=(0, DOUBTED)),
        Job("sequence", ["sequence", fit, "--photos", "list.txt", "-o", "out/all", *ONE]),
        Job("survey", ["survey", "run", "plan.json", "--out", "shards", "--local", "2", *ONE],
            then=["survey", "merge", "shards", "-o", "out/all.sqlite"]),
        Job("animate", ["animate", "moving.toml", "-o", "out/frames/##.png", "--frames", "0:11", "--camera-json",
                        "--set", "sheet.main.beams=6000", *ONE]),
        Job("render", ["render", small, "-o", "out/it.exr", "--set", "sheet.main.beams=12000", "--overwrite", *ONE],
            old="it.exr"),
        Job("volume", ["volume", small, "-o", "out/it.vdb", "--voxel-km", "1", "--overwrite", *ONE], old="it.vdb"),
    ]


def start(vegard, words, folder):
    # A shell's background job has SIGINT ignored, and its children would inherit that.
    def listen():
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return subprocess.Popen([vegard, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, preexec_fn=listen)


def finish(job, seconds):
    """Exit code and messages; a code of None if it had to be ended."""
    try:
        _, said = job.communicate(timeout=seconds)
        return job.returncode, said
    except subprocess.TimeoutExpired:
        job.kill()
        return None, job.communicate()[1]


def without_command(data):
    """A result says how it was called, which is not the same with --resume."""
    return b"\n".join(line for line in data.split(b"\n") if b"--threads" not in line)


def tree(folder):
    """Files by their paths, with their bytes."""
    files = {}
    for place, _, names in os.walk(folder):
        if not names and place != str(folder):
            files[os.path.relpath(place, folder) + "/"] = b""
        for name in names:
            path = pathlib.Path(place, name)
            data = path.read_bytes()
            files[str(path.relative_to(folder))] = without_command(data) if path.suffix in SAY_COMMAND else data
    return files


def compare(whole, found):
    """What is wrong: (kind, words) for each."""
    wrong = []
    for name in sorted(set(whole) | set(found)):
        if name not in found:
            wrong.append(("missing", name))
        elif name not in whole:
            parts = pathlib.Path(name).parts
            hidden = next((i for i, part in enumerate(parts) if part.startswith(".")), len(parts) - 1)
            left = ("left behind", "/".join(parts[: hidden + 1]))  # a folder is left as one
            if left not in wrong:
                wrong.append(left)
        elif whole[name] != found[name]:
            wrong.append(("other bytes", name))
    return wrong


def conclude(vegard, job, folder):
    """Where a command is needed to see what was done: what it cannot do is missing then."""
    if job.then:
        finish(start(vegard, job.then, folder), 60)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--binary", default=str(SOURCE / "build/release/vegard"))
    words.add_argument("--kills", type=int, default=50, help="of each command (default 50)")
    words.add_argument("--seed", default="1")
    words.add_argument("--only", action="append", help="only this command; may be repeated")
    options = words.parse_args()
    vegard = os.path.abspath(options.binary)
    if not os.access(vegard, os.X_OK):
        words.error(f"--binary: there is no program {vegard}")
    columns = ["killed", "ended before", "half a file", "refused", "missing", "other bytes", "left behind"]
    rows, findings = [], 0
    with tempfile.TemporaryDirectory(prefix="vegard-kills-") as name:
        folder = pathlib.Path(name)
        text = (SCENES / "small.toml").read_text().replace("beams = 150", "beams = 1500")
        (folder / "moving.toml").write_text(text.replace("energy_kev = 3.0", "energy_kev = 3.0\ndrift_km_s = [2.0, 0.0]"))
        (folder / "list.txt").write_text("photo.png 0\nsecond.png 2.5\nthird.png 5\n")
        for picture, energy in (("photo", 3.0), ("second", 3.2), ("third", 3.4)):
            subprocess.run([vegard, "render", str(SCENES / "small.toml"), "-o", f"{picture}.png", "--set",
                            f"sheet.main.energy_kev={energy}"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([vegard, "render", str(SCENES / "map_light.toml"), "-o", "band.png"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        (folder / "survey.toml").write_text(
            '[survey]\nname = "night"\nwork = ["border", "fit"]\nscene = "fit.toml"\nblock_frames = 5\n'
            '[[camera]]\nname = "a"\nframes = ["frames.txt"]\nset = ["sheet.main.beams=1000"]\n')
        shutil.copy(SCENES / "fit.toml", folder / "fit.toml")
        (folder / "frames.txt").write_text("".join(
            f"{('photo', 'second', 'third')[i % 3]}.png 2019-03-01T22:{i // 6:02}:{10 * (i % 6):02}Z\n" for i in range(20)))
        subprocess.run([vegard, "survey", "plan", "survey.toml", "-o", "plan.json"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        for job in jobs():
            if options.only and job.name not in options.only:
                continue
            job.prepare(folder)
            begin = time.monotonic()
            code, said = finish(start(vegard, job.words, folder), 600)
            seconds = time.monotonic() - begin
            if code not in job.done:
                sys.exit(f"kills.py: vegard {' '.join(job.words)} ended with {code}:\n{said.decode(errors='replace')}")
            conclude(vegard, job, folder)
            whole = tree(folder / "out")
            count = dict.fromkeys(columns, 0)
            for kill in range(options.kills):
                dice = random.Random(f"{options.seed}/{job.name}/{kill}")
                number, share = dice.choice(SIGNALS), dice.random()
                job.prepare(folder)
                process = start(vegard, job.words, folder)
                time.sleep(share * seconds)
                process.send_signal(number)
                code, said = finish(process, 60)
                wrong = []
                if code in job.done:
                    count["ended before"] += 1
                elif code in ENDS[number]:
                    count["killed"] += 1
                else:
                    wrong.append(("refused", f"exit code {code} after {number.name}: {said.decode(errors='replace')}"))
                if job.old:
                    there = (folder / "out" / job.old)
                    if not there.exists() or there.read_bytes() not in (OLD, whole[job.old]):
                        wrong.append(("half a file", job.old))
                # A fit that was done in time is not to be gone on with.
                if code not in job.done or job.old:
                    code, said = finish(start(vegard, job.again, folder), 600)
                    if code not in job.done:
                        wrong.append(("refused", f"exit code {code} the second time: {said.decode(errors='replace')}"))
                conclude(vegard, job, folder)
                wrong += compare(whole, tree(folder / "out"))
                findings += len(wrong)
                for kind, what in wrong:
                    count[kind] += 1
                    print(f"{job.name}, kill {kill} ({number.name} at {share:.0%} of {seconds:.2f} s): {kind}: {what.strip()}",
                          flush=True)
            rows.append([job.name, options.kills, *count.values()])
            print(f"{job.name}: {options.kills} kills, {findings} findings so far", file=sys.stderr, flush=True)
    rows.append(["all", *[sum(row[i] for row in rows) for i in range(1, len(columns) + 2)]])
    heads = ["command", "kills", *columns]
    print()
    widths = [max(len(str(row[i])) for row in [*rows, heads]) for i in range(len(heads))]
    for row in [heads, *rows]:
        print("  ".join(str(c).ljust(w) if i == 0 else str(c).rjust(w) for i, (c, w) in enumerate(zip(row, widths))))
    print(f"{rows[-1][1]} kills of seed {options.seed}: {findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
