#!/usr/bin/env python3
"""What a survey has found of a made night, beside what is true of it (docs/validation.md, "A made night").

  scripts/score_night.py --truth night/truth.csv --filter filter.sqlite
  scripts/score_night.py --truth night/truth.csv --fits fits.sqlite
"""

import argparse
import csv
import sqlite3

CLASSES = ["arc", "twilight", "cloud", "moon", "lamp", "aurora", "dark"]
QUESTIONS = CLASSES[:-1]
ENERGY, DISTANCE = "sheet.main.energy_kev", "distance"


def rows_of(database, words):
    return sqlite3.connect(f"file:{database}?mode=ro", uri=True).execute(words).fetchall()


def share(part, whole):
    return f"{part} of {whole} ({100.0 * part / whole:.1f} %)" if whole else "none"


def score_filter(truth, database):
    status = dict(rows_of(database, "SELECT file, status FROM frame"))
    broken = [f for f in status if truth[f]["damage"]]
    right = sum(status[f] == ("missing" if truth[f]["damage"] == "missing" else "unreadable") for f in broken)
    print(f"broken and missing frames told as such: {share(right, len(broken))}")
    print("sound frames told as broken:",
          sum(status[f] in ("missing", "unreadable") for f in status if not truth[f]["damage"]))
    found = dict(rows_of(database, "SELECT file, verdict FROM result JOIN frame USING (frame) WHERE work = 'filter'"))
    files = sorted(f for f in found if not truth[f]["damage"])
    print(f"an arc or none: {share(sum((truth[f]['sky'] == 'arc') == (found[f] == 'arc') for f in files), len(files))}")
    print(f"the class: {share(sum(truth[f]['sky'] == found[f] for f in files), len(files))}")
    print("\n| truth \\ found | " + " | ".join(CLASSES) + " | right |\n|---|" + "---|" * (len(CLASSES) + 1))
    for true in CLASSES:
        row = [sum(truth[f]["sky"] == true and found[f] == other for f in files) for other in CLASSES]
        if sum(row):
            print(f"| {true} | " + " | ".join(map(str, row)) + f" | {100.0 * row[CLASSES.index(true)] / sum(row):.1f} % |")
    print("\neach question by itself (right; of those that are so, found; of those found, so):")
    for q in QUESTIONS:
        score = dict(rows_of(database, "SELECT file, value FROM quantity JOIN frame USING (frame) WHERE work = 'filter' "
                                       f"AND quantity.name = 'score of {q}'"))
        said = {f: score[f] > 0.5 for f in files}
        so = {f: truth[f][q] == "1" for f in files}
        both = sum(said[f] and so[f] for f in files)
        print(f"  {q}: {share(sum(said[f] == so[f] for f in files), len(files))}; {share(both, sum(so.values()))}; "
              f"{share(both, sum(said.values()))}")


def score_fits(truth, database):
    verdicts = dict(rows_of(database, "SELECT file, verdict FROM result JOIN frame USING (frame) WHERE work = 'fit'"))
    values = {}
    for file, name, value in rows_of(
            database, "SELECT file, quantity.name, value FROM quantity JOIN frame USING (frame) WHERE work = 'fit'"):
        values.setdefault(file, {})[name] = value
    listed = [f for (f,) in rows_of(database, "SELECT file FROM frame")]
    arcs = [f for f in listed if truth[f]["sky"] == "arc" and not truth[f]["damage"]]
    fitted = [f for f in arcs if f in values]
    print(f"{len(listed)} frames, {len(arcs)} sound ones with an arc; fitted of these: {share(len(fitted), len(arcs))}; "
          f"fits where there is no arc: {sum(f in values for f in listed) - len(fitted)}")

    def off(f, name, column):
        value = values[f].get(name)
        return float("inf") if value is None else value / float(truth[f][column]) - 1.0

    for words, files in [("all that were fitted", fitted),
                         ("of these good", [f for f in fitted if verdicts[f] == "good"]),
                         ("doubtful", [f for f in fitted if verdicts[f] == "doubtful"]),
                         ("failed", [f for f in fitted if verdicts[f] not in ("good", "doubtful")]),
                         ("clouds over less than 5 %", [f for f in fitted if float(truth[f]["cover"]) < 0.05]),
                         ("clouds over more", [f for f in fitted if float(truth[f]["cover"]) >= 0.05]),
                         ("camera a", [f for f in fitted if truth[f]["camera"] == "a"]),
                         ("camera b", [f for f in fitted if truth[f]["camera"] == "b"])]:
        if not files:
            continue
        energy = [abs(off(f, ENERGY, "energy_kev")) for f in files]
        distance = [abs(off(f, DISTANCE, "distance_km")) for f in files]
        both = sum(e <= 0.10 and d <= 0.03 for e, d in zip(energy, distance))
        middle = lambda all: sorted(all)[len(all) // 2]
        print(f"{words}: {len(files)}; energy within 10 %: {share(sum(e <= 0.10 for e in energy), len(files))}, "
              f"distance within 3 %: {share(sum(d <= 0.03 for d in distance), len(files))}, both: {share(both, len(files))}; "
              f"median off by {100 * middle(energy):.1f} % and {100 * middle(distance):.2f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--truth", required=True)
    parser.add_argument("--filter", help="database of a survey with the work \"filter\"")
    parser.add_argument("--fits", help="database of a survey with the work \"fit\"")
    options = parser.parse_args()
    with open(options.truth, newline="") as stream:
        truth = {row["file"]: row for row in csv.DictReader(stream)}
    if options.filter:
        score_filter(truth, options.filter)
    if options.fits:
        score_fits(truth, options.fits)


if __name__ == "__main__":
    main()
