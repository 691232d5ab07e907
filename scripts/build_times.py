#!/usr/bin/env python3
"""Where the time of a build went, by ninja's log: units, seconds and the slowest unit of every folder.

usage: build_times.py [--depth N] [--slowest N] BUILD_FOLDER [BUILD_FOLDER_BEFORE]

Seconds are those that each unit took on the clock. Their sum is the processor's time if no more units ran at once than
there are cores, and nothing else did. With two folders the first is set beside the second.
"""
import argparse
import collections
import pathlib


def units_of(folder):
    """Seconds of every object file and precompiled header, by its name; of several builds the last."""
    log = pathlib.Path(folder) / ".ninja_log"
    seconds = {}
    for line in log.read_text().splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        if output.endswith((".o", ".gch", ".pch")):
            seconds[output] = (int(end) - int(start)) / 1000
    return seconds


def folder_of(unit, depth):
    """sim/CMakeFiles/vegard_sim.dir/base/error.cpp.o is of sim/base."""
    parts = [part for part in unit.split("/")[:-1] if part != "CMakeFiles" and not part.endswith(".dir")]
    return "/".join(parts[:depth])


def by_folder(units, depth):
    folders = collections.defaultdict(list)
    for unit, seconds in units.items():
        folders[folder_of(unit, depth)].append((seconds, unit))
    return folders


def words_of(folder):
    if not folder:
        return f"{'':>6} {'':>8}"
    return f"{len(folder):6} {sum(seconds for seconds, _ in folder):8.1f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="a folder that ninja has built in")
    parser.add_argument("before", nargs="?", help="another, to set beside it")
    parser.add_argument("--depth", type=int, default=1, help="how many names of a folder count (default 1)")
    parser.add_argument("--slowest", type=int, default=10, help="how many of the slowest units to list (default 10)")
    arguments = parser.parse_args()

    units = units_of(arguments.build)
    before = units_of(arguments.before) if arguments.before else {}
    folders, old = by_folder(units, arguments.depth), by_folder(before, arguments.depth)
    width = max([len("folder")] + [len(name) for name in folders | old])
    if before:
        print(f"{'':{width}} {'before':>15}  {'now':>15}")
        print(f"{'folder':{width}} {'units':>6} {'seconds':>8}  {'units':>6} {'seconds':>8}")
    else:
        print(f"{'folder':{width}} {'units':>6} {'seconds':>8}  slowest")
    for name in sorted(folders | old):
        if before:
            print(f"{name:{width}} {words_of(old.get(name))}  {words_of(folders.get(name))}")
        else:
            seconds, unit = max(folders[name])
            print(f"{name:{width}} {words_of(folders[name])}  {seconds:.1f} {unit.split('/')[-1]}")
    total = [(seconds, unit) for unit, seconds in units.items()]
    old_total = [(seconds, unit) for unit, seconds in before.items()]
    print(f"{'all':{width}} " + (words_of(old_total) + "  " if before else "") + words_of(total))
    for seconds, unit in sorted(total, reverse=True)[: arguments.slowest]:
        print(f"{seconds:8.1f}  {unit}")


if __name__ == "__main__":
    main()
