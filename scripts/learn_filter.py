#!/usr/bin/env python3
"""Learns the trees of a survey's filter from frames of which the answer is known (docs/surveys.md, "The filter").

  scripts/learn_filter.py --results filter.sqlite --truth truth.csv -o sky_trees.json

The results are the database of a survey with the work "filter" (merged, or of one shard): each frame's features. The truth is
a CSV with a column "file", as the survey names its frames, and columns arc, twilight, cloud, moon, lamp, aurora of 0 and 1.
Both options may be given several times. For each question trees are grown one upon the other, each of what those before have
left (Friedman 2001, "Greedy function approximation: a gradient boosting machine", with the second derivatives of Chen and
Guestrin 2016, doi:10.1145/2939672.2939785). The same frames give the same bytes.
"""

import argparse
import bisect
import csv
import hashlib
import json
import math
import os
import sqlite3
import sys

LIGHT = ["banded", "blue", "brightness", "contrast", "crosswise", "elongated", "green", "lamp peak", "moon peak", "points",
         "structure"]
# What may count for each: no more than bears on it, since over a few nights the Sun and the Moon are clocks, which tell when
# there was aurora in these nights.
QUESTIONS = {
    "arc": LIGHT,
    "twilight": ["blue", "brightness", "sun elevation", "sunward"],
    "cloud": LIGHT,
    "moon": ["clipped", "moon elevation", "moon light", "moon peak"],
    "lamp": ["clipped", "lamp peak", "points"],
    "aurora": LIGHT,
}


def features_of(database):
    """Features by file; what the filter found of it is none."""
    connection = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    rows = connection.execute(
        "SELECT file, quantity.name, value FROM quantity JOIN frame USING (frame) "
        "WHERE work = 'filter' AND quantity.name NOT LIKE 'score of %' ORDER BY frame")
    found = {}
    for file, name, value in rows:
        found.setdefault(file, {})[name] = value
    return found


def known_frames(results, truths):
    """Features and answers, in the order of files' names."""
    if len(results) != len(truths):
        sys.exit("learn_filter.py: as many --results as --truth")
    rows = []
    for database, table in zip(results, truths):
        features = features_of(database)
        with open(table, newline="") as stream:
            for row in sorted(csv.DictReader(stream), key=lambda row: row["file"]):
                if row["file"] in features:
                    rows.append((features[row["file"]], {q: int(row[q]) for q in QUESTIONS}))
    if not rows:
        sys.exit("learn_filter.py: no frame of the results has its truth")
    return rows


def cuts_of(values, most):
    """Thresholds midway between values that follow each other, at most so many, each with about as many values below."""
    ordered = sorted(set(values))
    midways = [0.5 * (low + high) for low, high in zip(ordered, ordered[1:])]
    if len(midways) <= most:
        return midways
    return sorted({midways[(i * len(midways)) // most] for i in range(most)})


def grown(bins, cuts, names, gradient, curvature, frames, depth, least, damping):
    """Nodes of one tree, the root first, branches behind it."""
    nodes = []

    def worth(g, h):
        return g * g / (h + damping)

    def grow(frames, left):
        at = len(nodes)
        g, h = sum(gradient[i] for i in frames), sum(curvature[i] for i in frames)
        nodes.append({"score": g / (h + damping)})
        best = None
        for name in names if left > 0 else []:
            size = len(cuts[name]) + 1
            of_g, of_h, of_n = [0.0] * size, [0.0] * size, [0] * size
            bin_of = bins[name]
            for i in frames:
                k = bin_of[i]
                of_g[k] += gradient[i]
                of_h[k] += curvature[i]
                of_n[k] += 1
            g_below = h_below = n_below = 0
            for k in range(size - 1):
                g_below += of_g[k]
                h_below += of_h[k]
                n_below += of_n[k]
                if n_below < least or len(frames) - n_below < least:
                    continue
                gain = worth(g_below, h_below) + worth(g - g_below, h - h_below) - worth(g, h)
                if gain > 0.1 and (best is None or gain > best[0] + 1e-12):
                    best = (gain, name, k)
        if best is None:
            return at
        _, name, k = best
        below = grow([i for i in frames if bins[name][i] <= k], left - 1)
        above = grow([i for i in frames if bins[name][i] > k], left - 1)
        nodes[at] = {"feature": name, "threshold": float(f"{cuts[name][k]:.9g}"), "below": below, "above": above}
        return at

    grow(frames, depth)
    return nodes


def boosted(rows, question, names, trees, depth, least, rate, damping=1.0, most_cuts=48):
    """Trees whose scores add up to the logarithm of the odds."""
    answers = [answers[question] for _, answers in rows]
    cuts = {name: cuts_of([features[name] for features, _ in rows], most_cuts) for name in names}
    bins = {name: [bisect.bisect_right(cuts[name], features[name]) for features, _ in rows] for name in names}
    true = sum(answers)
    begin = math.log((true + 1.0) / (len(answers) - true + 1.0))
    odds = [begin] * len(rows)
    made = [[{"score": round(begin, 6)}]]
    for _ in range(trees):
        likely = [1.0 / (1.0 + math.exp(-o)) for o in odds]
        nodes = grown(bins, cuts, names, [y - p for y, p in zip(answers, likely)], [p * (1.0 - p) for p in likely],
                      range(len(rows)), depth, least, damping)
        for node in nodes:
            if "score" in node:
                node["score"] = round(rate * node["score"], 6)
        for i in range(len(rows)):
            node = nodes[0]
            while "score" not in node:
                node = nodes[node["above" if rows[i][0][node["feature"]] >= node["threshold"] else "below"]]
            odds[i] += node["score"]
        made.append(nodes)
    return made


def sha256_of(path):
    with open(path, "rb") as stream:
        return hashlib.sha256(stream.read()).hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", action="append", required=True)
    parser.add_argument("--truth", action="append", required=True)
    parser.add_argument("--trees", type=int, default=60, help="of each question (default: 60)")
    parser.add_argument("--depth", type=int, default=3, help="of a tree, at most (default: 3)")
    parser.add_argument("--least", type=int, default=8, help="frames of a leaf, at least (default: 8)")
    parser.add_argument("--rate", type=float, default=0.15, help="share of a tree that counts (default: 0.15)")
    parser.add_argument("--note", default="", help="words to stand in the file")
    parser.add_argument("-o", "--output", required=True)
    options = parser.parse_args()

    rows = known_frames(options.results, options.truth)
    trees = {q: boosted(rows, q, names, options.trees, options.depth, options.least, options.rate)
             for q, names in QUESTIONS.items()}
    text = "{\n" + ",\n".join(
        f'"{key}": {json.dumps(value)}' for key, value in [
            ("kind", "vegard sky trees"), ("format", 1), ("note", options.note),
            ("frames", len(rows)), ("depth", options.depth), ("least", options.least), ("rate", options.rate),
            ("truth", [sha256_of(path) for path in options.truth])])
    text += ',\n"trees": {\n' + ",\n".join(
        f'"{q}": [\n' + ",\n".join(json.dumps(tree) for tree in trees[q]) + "\n]" for q in QUESTIONS) + "\n}\n}\n"
    partial = options.output + ".partial"
    with open(partial, "w") as stream:
        stream.write(text)
    os.replace(partial, options.output)
    for q in QUESTIONS:
        print(f"{q}: {sum(answers[q] for _, answers in rows)} of {len(rows)} frames, {sum(map(len, trees[q]))} nodes")


if __name__ == "__main__":
    main()
