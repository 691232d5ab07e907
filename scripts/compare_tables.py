#!/usr/bin/env python3
"""Compares two folders of emission tables (docs/file_formats.md): Maxwellian columns and peaks by energy.

    scripts/compare_tables.py data/glow data/emission [--lines 4278,5577,6300] [--energies 0.1,0.5,1,2,5,10,20]

Rates are read between the energies by straight lines in logarithms. Columns are summed from 80 km to the top, with
what is between altitudes falling off exponentially, so that both folders are summed alike.
"""
import argparse
import csv
import math
import sys


def rates(folder):
    """{line: {E0: [(altitude, rate)]}} at an oxygen factor of 1."""
    table = {}
    with open(folder + "/ver_maxwellian.csv", newline="") as file:
        for row in csv.DictReader(file):
            if float(row.get("oxygen_factor", 1.0)) != 1.0:
                continue
            energy, altitude = float(row["E0_keV"]), float(row["altitude_km"])
            for name, value in row.items():
                if name.startswith("ver_"):
                    table.setdefault(name[4:], {}).setdefault(energy, []).append((altitude, float(value)))
    return table


def column(profile):
    total = 0.0
    for (z0, a), (z1, b) in zip(profile, profile[1:]):
        mean = (a - b) / math.log(a / b) if a > 0 and b > 0 and abs(a / b - 1) > 1e-4 else (a + b) / 2
        total += 0.1 * (z1 - z0) * mean
    return total


def peak(profile):
    """The vertex of the parabola through the highest three, which need not be evenly spaced."""
    i = max(range(1, len(profile) - 1), key=lambda k: profile[k][1])
    (x0, y0), (x1, y1), (x2, y2) = profile[i - 1 : i + 2]
    a, b = (y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1)
    bend = (b - a) / (x2 - x0)
    return x1 if bend >= 0 else (x0 + x1) / 2 - a / (2 * bend)


def at(of_energy, energy):
    """The profile at an energy between two of the table."""
    energies = sorted(of_energy)
    energy = min(max(energy, energies[0]), energies[-1])
    high = next(k for k, e in enumerate(energies) if e >= energy)
    if energies[high] == energy:
        return of_energy[energy]
    low = high - 1
    way = math.log(energy / energies[low]) / math.log(energies[high] / energies[low])
    result = []
    for (z, a), (_, b) in zip(of_energy[energies[low]], of_energy[energies[high]]):
        result.append((z, math.exp((1 - way) * math.log(max(a, 1e-30)) + way * math.log(max(b, 1e-30)))))
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("--lines", default="3371,4278,5200,5577,6300,7774,8446")
    parser.add_argument("--energies", default="0.1,0.2,0.5,1,2,5,10,19.9")
    options = parser.parse_args()
    first, second = rates(options.first), rates(options.second)
    print(f"{'line':>6} {'E0 keV':>7} {'first R':>10} {'second R':>10} {'ratio':>7} {'first km':>9} {'second km':>9} {'km':>6}")
    for line in options.lines.split(","):
        if line not in first or line not in second:
            sys.exit(f"compare_tables.py: one of the folders has no column ver_{line}")
        for energy in map(float, options.energies.split(",")):
            a, b = at(first[line], energy), at(second[line], energy)
            print(
                f"{line:>6} {energy:7g} {column(a):10.1f} {column(b):10.1f} {column(b) / column(a):7.3f}"
                f" {peak(a):9.1f} {peak(b):9.1f} {peak(b) - peak(a):6.1f}"
            )


if __name__ == "__main__":
    main()
