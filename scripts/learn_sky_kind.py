#!/usr/bin/env python3
"""Learns what a sky's features say of it (fit/sky_kind), and judges it by cameras and nights that it never saw.

For your own camera (docs/surveys.md, "The filter"): the results are the database of a survey with the work "filter", the truth is a
CSV with a column "file", as the survey names its frames, and columns of 0 and 1, or empty: arc, twilight, cloud, moon, lamp, aurora,
several, rayed, overhead, as many as you know. Questions without answers stay those of the built-in model.

  scripts/learn_sky_kind.py --results filter.sqlite --truth labels.csv -o gill.json

The built-in model (docs/surveys.md, "The filter"): made skies and marked pictures by tests/sky_table, made nights as above. Kinds of
pictures by themselves are learnt by scripts/learn_kinds.py.

  scripts/learn_sky_kind.py real.csv made21.csv made22.csv --results night1.sqlite --truth night1/truth.csv --validate
  scripts/learn_sky_kind.py real.csv made21.csv made22.csv --results night1.sqlite --truth night1/truth.csv -o data/filter/sky_kinds.json

A question's logarithm of the odds is a sum of a few weighted features (logistic regression with a penalty on the squares of the weights).
Of frames whose directions are known, those of surveys, small decision trees learn what it leaves (gradient boosting: Friedman 2001;
second derivatives as by Chen and Guestrin 2016, doi:10.1145/2939672.2939785). A line makes probabilities of the sums of frames whose camera or night was left out (Platt 1999). Marked
pictures have 0.7 of the weight, each camera the same share. --validate tells how often cameras and nights that were left out are
judged rightly, and how often what was said with a probability is so. Needs numpy. The same tables give the same bytes.
"""

import argparse
import csv
import hashlib
import json
import os
import sqlite3
import sys

import numpy as np

QUESTIONS = ["arc", "twilight", "cloud", "moon", "lamp", "aurora", "several", "rayed", "overhead"]
# Asked of skies with an arc.
OF_ARCS = {"several", "rayed", "overhead"}
# What is weighted; it holds for any camera.
TERMS = {
    "aurora": {"colour": ["green spread", "star cover"], "grey": ["structure", "elongated", "star cover", "texture", "crossed"]},
    "arc": {"colour": ["green spread", "green", "structure", "elongated", "green light"],
            "grey": ["structure", "elongated", "ridge length", "texture", "peak"]},
    "several": {"colour": ["crossings"], "grey": ["crossings"]},
    "rayed": {"colour": ["fine rays", "elongated"], "grey": ["fine rays", "elongated"]},
    "overhead": {"colour": ["central", "crossed", "elongated"], "grey": ["central", "crossed", "elongated"]},
    "twilight": {"colour": ["blue", "contrast", "star cover"], "grey": ["star cover", "structure", "contrast"]},
    "cloud": {"colour": ["star cover", "points", "blue", "green spread"], "grey": ["star cover", "points"]},
    "moon": {"colour": ["disc", "disc round", "peak"], "grey": ["disc", "disc round", "peak"]},
    "lamp": {"colour": ["disc", "warm", "smooth"], "grey": ["disc", "peak"]},
}
LIGHT = ["contrast", "structure", "elongated", "green", "blue", "points", "peak", "green spread", "green light", "warm", "star cover",
         "texture", "ridge length", "ridges", "ridge share", "green length", "green ridges", "green share", "crossed", "central", "smooth",
         "crossings", "fine rays", "halo", "star gaps", "grey light", "brightness", "level", "banded", "crosswise", "lamp peak", "moon peak"]
# What trees may ask: no more than bears on it, since over a few nights the Sun and the Moon are clocks, which tell when there was aurora
# in these nights.
ASKED = {
    "aurora": LIGHT, "arc": LIGHT, "several": LIGHT, "rayed": LIGHT, "overhead": LIGHT, "cloud": LIGHT,
    "twilight": ["blue", "brightness", "contrast", "level", "smooth", "star cover", "sun elevation", "sunward"],
    "moon": ["clipped", "disc", "disc round", "halo", "peak", "moon elevation", "moon light", "moon peak"],
    "lamp": ["clipped", "disc", "disc round", "halo", "lamp peak", "peak", "points", "warm"],
}
REAL_SHARE, RIDGE, PULL = 0.7, 0.003, 0.03
TREES, DEPTH, RATE, LEAST_SHARE, DAMPING, BINS = 60, 3, 0.15, 0.001, 0.001, 32


def number(text):
    return float(text) if text not in (None, "") else float("nan")


class Skies:
    """Features, answers and groups of all frames."""

    def __init__(self):
        self.rows, self.names = [], []

    def add(self, features, answers, camera, group):
        for name in features:
            if name not in self.names:
                self.names.append(name)
        self.rows.append((features, answers, camera, group))

    def arrays(self):
        self.x = np.array([[row[0].get(name, np.nan) for name in self.names] for row in self.rows])
        self.y = np.array([[row[1].get(q, np.nan) for q in QUESTIONS] for row in self.rows])
        self.camera = np.array([row[2] for row in self.rows])
        self.group = np.array([row[3] for row in self.rows])
        self.at = {name: i for i, name in enumerate(self.names)}


def read_table(skies, table):
    """A table of tests/sky_table. Made skies have no camera and are their table's group."""
    with open(table, newline="") as stream:
        rows = list(csv.DictReader(stream))
    known = ["file", "camera", "kinds", "black", "found", "probability", "probability of aurora"] + QUESTIONS
    for row in rows:
        if row["black"] == "1" and not row["kinds"]:
            continue
        features = {name: number(value) for name, value in row.items() if name not in known}
        skies.add(features, {q: number(row[q]) for q in QUESTIONS}, row["camera"], row["camera"] or os.path.basename(table))


def read_survey(skies, database, truth):
    """Frames of a survey's work "filter" whose answers are known."""
    connection = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    found = {}
    for file, name, value in connection.execute(
            "SELECT file, quantity.name, value FROM quantity JOIN frame USING (frame) "
            "WHERE work = 'filter' AND quantity.name NOT LIKE 'score of %' ORDER BY frame"):
        found.setdefault(file, {})[name] = float("nan") if value is None else value
    with open(truth, newline="") as stream:
        known = [row for row in sorted(csv.DictReader(stream), key=lambda row: row["file"]) if row["file"] in found]
    for n, row in enumerate(known):
        answers = {q: number(row.get(q)) for q in QUESTIONS}
        # Frames that follow each other are alike: fifths of the night are left out together.
        skies.add(found[row["file"]], answers, "", f"{os.path.basename(truth)} {5 * n // len(known)}")
    return len(known)


def weights_of(skies, used):
    """Each camera has the same share of what marked pictures weigh, all made ones together have the rest."""
    weight = np.zeros(len(skies.rows))
    cameras = sorted({c for c in skies.camera[used] if c})
    made = used & (skies.camera == "")
    real_share = 0.0 if not cameras else REAL_SHARE if made.any() else 1.0
    for camera in cameras:
        own = used & (skies.camera == camera)
        weight[own] = real_share / len(cameras) / own.sum()
    if made.any():
        weight[made] = (1.0 - real_share) / made.sum()
    return weight


def sigmoid(z):
    return 1.0 / (1.0 + np.exp(-np.clip(z, -30.0, 30.0)))


def linear_part(x, y, weight):
    """Weights, limits and means of standardised features, by Newton's steps."""
    has = ~np.isnan(x)
    least, most = np.nanmin(np.where(has, x, np.inf), axis=0), np.nanmax(np.where(has, x, -np.inf), axis=0)
    w = weight[:, None] * has
    mean = np.nansum(np.where(has, x, 0.0) * w, axis=0) / np.maximum(w.sum(axis=0), 1e-12)
    filled = np.where(has, x, mean)
    scale = np.sqrt(weight @ (filled - mean) ** 2) + 1e-6
    a = np.hstack([np.ones((len(x), 1)), (filled - mean) / scale])
    b = np.zeros(a.shape[1])
    ridge = RIDGE * np.eye(len(b))
    ridge[0, 0] = 1e-4
    for _ in range(60):
        p = sigmoid(a @ b)
        step = np.linalg.solve((a * (weight * p * (1.0 - p))[:, None]).T @ a + ridge, a.T @ (weight * (y - p)) - ridge @ b)
        b += step
        if np.abs(step).max() < 1e-10:
            break
    slopes = b[1:] / scale
    return b[0] - slopes @ mean, slopes, least, most, slopes * mean


def linear_sum(model, x):
    constant, slopes, least, most, missing = model
    return constant + np.where(np.isnan(x), missing, slopes * np.clip(x, least, most)).sum(axis=1)


def cuts_of(values):
    ordered = np.unique(values[~np.isnan(values)])
    midways = 0.5 * (ordered[1:] + ordered[:-1])
    if len(midways) <= BINS - 1:
        return midways
    return midways[(np.arange(BINS - 1) * len(midways)) // (BINS - 1)]


def grown(bins, cuts, gradient, curvature, frames):
    """Nodes of one tree, the root first, branches behind it. Bin BINS is of features that there are not."""
    nodes, features, size = [], bins.shape[1], BINS + 1
    offsets = np.arange(features) * size

    def worth(g, h):
        return g * g / (h + DAMPING)

    def grow(frames, left):
        at = len(nodes)
        g, h = gradient[frames].sum(), curvature[frames].sum()
        nodes.append({"score": g / (h + DAMPING)})
        if left == 0 or len(frames) < 2:
            return at
        flat = (bins[frames] + offsets).ravel()
        of_g = np.bincount(flat, np.repeat(gradient[frames], features), features * size).reshape(features, size)
        of_h = np.bincount(flat, np.repeat(curvature[frames], features), features * size).reshape(features, size)
        best = None
        for is_missing_below in (True, False):
            below_g, below_h = np.cumsum(of_g[:, :BINS], axis=1)[:, :-1], np.cumsum(of_h[:, :BINS], axis=1)[:, :-1]
            if is_missing_below:
                below_g, below_h = below_g + of_g[:, BINS:], below_h + of_h[:, BINS:]
            gain = worth(below_g, below_h) + worth(g - below_g, h - below_h) - worth(g, h)
            gain[(below_h < LEAST_SHARE) | (h - below_h < LEAST_SHARE)] = -1.0
            for f in range(features):
                gain[f, len(cuts[f]):] = -1.0
            f, k = np.unravel_index(np.argmax(gain), gain.shape)
            if gain[f, k] > 1e-6 and (best is None or gain[f, k] > best[0] + 1e-12):
                best = (gain[f, k], f, k, is_missing_below)
        if best is None:
            return at
        _, f, k, is_missing_below = best
        value = bins[frames, f]
        is_below = np.where(value == BINS, is_missing_below, value <= k)
        below = grow(frames[is_below], left - 1)
        above = grow(frames[~is_below], left - 1)
        nodes[at] = {"feature": f, "bin": k, "missing": is_missing_below, "below": below, "above": above}
        return at

    grow(frames, DEPTH)
    return nodes


def tree_sum(nodes, bins):
    total = np.zeros(len(bins))

    def walk(at, frames):
        node = nodes[at]
        if "score" in node:
            total[frames] = node["score"]
            return
        value = bins[frames, node["feature"]]
        is_below = np.where(value == BINS, node["missing"], value <= node["bin"])
        walk(node["below"], frames[is_below])
        walk(node["above"], frames[~is_below])

    walk(0, np.arange(len(bins)))
    return total


def bins_of(x, cuts):
    return np.stack([np.where(np.isnan(x[:, f]), BINS, np.searchsorted(cuts[f], x[:, f], side="right")) for f in range(x.shape[1])],
                    axis=1).astype(np.int64)


def is_grey(skies):
    return np.isnan(skies.x[:, skies.at["green spread"]])


def knows_directions(skies):
    return ~np.isnan(skies.x[:, skies.at["banded"]])


class Model:
    def __init__(self, skies, question, used, trees=None):
        self.terms = {light: [n for n in names if n in skies.at] for light, names in TERMS[question].items()}
        self.asked = [n for n in ASKED[question] if n in skies.at]
        self.linear = {}
        for light in ("colour", "grey"):
            own = used & (is_grey(skies) == (light == "grey"))
            if len(set(skies.y[own, QUESTIONS.index(question)])) < 2:
                own = used
            of_light = weights_of(skies, own)[own]
            self.linear[light] = linear_part(self.columns(skies, light)[own], skies.y[own, QUESTIONS.index(question)], of_light / of_light.sum())
        # Trees are of frames of which the directions are known.
        self.trees = []
        used = used & knows_directions(skies)
        y, weight = skies.y[used, QUESTIONS.index(question)], np.full(used.sum(), 1.0 / max(1, used.sum()))
        asked = skies.x[used][:, [skies.at[n] for n in self.asked]]
        self.cuts = [cuts_of(asked[:, f]) for f in range(asked.shape[1])]
        bins, odds = bins_of(asked, self.cuts), self.linear_sums(skies)[used]
        for _ in range((TREES if trees is None else trees) if len(set(y)) == 2 else 0):
            p = sigmoid(odds)
            nodes = grown(bins, self.cuts, weight * (y - p), weight * p * (1.0 - p), np.arange(len(y)))
            for node in nodes:
                if "score" in node:
                    node["score"] = round(RATE * node["score"], 6)
            if len(nodes) == 1:
                break
            odds = odds + tree_sum(nodes, bins)
            self.trees.append(nodes)

    def columns(self, skies, light):
        return skies.x[:, [skies.at[n] for n in self.terms[light]]]

    def linear_sums(self, skies):
        grey, colour = (linear_sum(self.linear[light], self.columns(skies, light)) for light in ("grey", "colour"))
        return np.where(is_grey(skies), grey, colour)

    def sums(self, skies, frames):
        total, known = self.linear_sums(skies)[frames], knows_directions(skies)[frames]
        if self.trees and known.any():
            bins = bins_of(skies.x[frames][known][:, [skies.at[n] for n in self.asked]], self.cuts)
            for nodes in self.trees:
                total[known] += tree_sum(nodes, bins)
        return total


def used_of(skies, question):
    used = ~np.isnan(skies.y[:, QUESTIONS.index(question)])
    if question in OF_ARCS:
        used &= skies.y[:, QUESTIONS.index("arc")] == 1
    return used


def folds_of(skies):
    """Cameras and nights to be left out together: each camera by itself, made ones in five parts."""
    made = sorted({g for g, c in zip(skies.group, skies.camera) if c == ""})
    place = {g: i % 5 for i, g in enumerate(made)}
    return np.array([c if c else f"made {place[g]}" for g, c in zip(skies.group, skies.camera)])


def unseen_sums(skies, question):
    """Of every frame, by a model that has seen neither its camera nor its night."""
    used, folds = used_of(skies, question), folds_of(skies)
    sums = np.full(len(skies.rows), np.nan)
    for fold in sorted(set(folds)):
        others, own = used & (folds != fold), folds == fold
        if len(set(skies.y[others, QUESTIONS.index(question)])) < 2:
            continue
        # No tree is asked of a camera whose directions are not known.
        trees = TREES if knows_directions(skies)[own].any() else 0
        sums[own] = Model(skies, question, others, trees).sums(skies, own)
    return sums


def line_of(sums, y, weight):
    """Slope and offset of the line from sums to the logarithm of the odds, drawn towards 1 and 0."""
    b = np.array([1.0, 0.0])
    a = np.stack([sums, np.ones(len(sums))], axis=1)
    drawn, pull = np.array([1.0, 0.0]), np.diag([PULL, PULL])
    def cost(b):
        z = np.clip(a @ b, -500.0, 500.0)
        return weight @ (np.logaddexp(0.0, z) - y * z) + 0.5 * (b - drawn) @ pull @ (b - drawn)

    for _ in range(100):
        p = sigmoid(a @ b)
        step = np.linalg.solve((a * (weight * p * (1.0 - p))[:, None]).T @ a + pull, a.T @ (weight * (y - p)) - pull @ (b - drawn))
        share = 1.0
        while share > 1e-6 and cost(b + share * step) > cost(b):
            share *= 0.5
        b = b + share * step
        if np.abs(share * step).max() < 1e-9:
            break
    return max(b[0], 0.05), b[1]


def calibration(skies, question, sums, has_directions, without=None):
    """The line of frames whose directions are known, or of the others."""
    used = used_of(skies, question) & ~np.isnan(sums) & (knows_directions(skies) == has_directions)
    if without is not None:
        used &= ~without
    if not used.any():
        return 1.0, 0.0
    weight = weights_of(skies, used)[used]
    return line_of(sums[used], skies.y[used, QUESTIONS.index(question)], weight / weight.sum())


def json_of(model, line, line_with_trees):
    six = lambda v: float(f"{v:.6g}")
    linear = {}
    for light, (constant, slopes, least, most, missing) in model.linear.items():
        terms = [{"feature": n, "weight": six(s), "least": six(low), "most": six(high), "missing": six(m)}
                 for n, s, low, high, m in zip(model.terms[light], slopes, least, most, missing) if np.isfinite(low)]
        linear[light] = {"constant": six(constant), "terms": terms}
    trees = [[node if "score" in node else
              {"feature": model.asked[node["feature"]], "threshold": float(f"{model.cuts[node['feature']][node['bin']]:.9g}"),
               "missing": "below" if node["missing"] else "above", "below": node["below"], "above": node["above"]} for node in nodes]
             for nodes in model.trees]
    return {**linear, "line": {"slope": six(line[0]), "offset": six(line[1])}, "trees": trees,
            "line_with_trees": {"slope": six(line_with_trees[0]), "offset": six(line_with_trees[1])}}


def always(skies, question):
    """Of a question that has one answer only."""
    y = skies.y[used_of(skies, question), QUESTIONS.index(question)]
    odds = np.log((y.sum() + 1.0) / (len(y) - y.sum() + 1.0))
    constant = {"constant": float(f"{odds:.6g}"), "terms": []}
    line = {"slope": 1.0, "offset": 0.0}
    return {"colour": constant, "grey": constant, "line": line, "trees": [], "line_with_trees": line}


def told(words, said):
    """How often what was said with a probability is so."""
    print(words)
    for low, high in [(0.0, 0.2), (0.2, 0.4), (0.4, 0.6), (0.6, 0.8), (0.8, 1.01)]:
        some = [(p, good) for p, good in said if low <= p < high]
        if some:
            print(f"  said {low:.1f} to {min(high, 1.0):.1f}: {len(some)}, mean {np.mean([p for p, _ in some]):.2f}, "
                  f"so {np.mean([g for _, g in some]):.2f}")


def validate(skies, sums):
    folds = folds_of(skies)
    p = np.zeros((len(skies.rows), len(QUESTIONS)))
    for k, q in enumerate(QUESTIONS):
        for fold in sorted(set(folds)):
            for has_directions in (False, True):
                own = (folds == fold) & (knows_directions(skies) == has_directions)
                slope, offset = calibration(skies, q, sums[q], has_directions, folds == fold)
                p[own, k] = sigmoid(slope * sums[q][own] + offset)
    for k, q in enumerate(QUESTIONS):
        for words, of in [("real", skies.camera != ""), ("made", skies.camera == "")]:
            used = used_of(skies, q) & of & ~np.isnan(sums[q])
            if used.any():
                good = (p[used, k] > 0.5) == (skies.y[used, k] == 1)
                so = skies.y[used, k] == 1
                print(f"{q}, {words}: right in {good.sum()} of {used.sum()} ({100.0 * good.mean():.1f} %); "
                      f"missed {(~good & so).sum()} of {so.sum()}")
    made = [i for i, row in enumerate(skies.rows) if skies.camera[i] == "" and not np.isnan(sums["arc"][i])]
    for k, q in enumerate(QUESTIONS[:6]):
        if made:
            told(f"{q} in made frames", [(p[i, k], skies.y[i, k] == 1) for i in made])
    if made:
        def name(values):
            return next((q for q, v in zip(QUESTIONS[:6], values) if v > 0.5), "dark")
        for group in sorted({skies.group[i].split(" ")[0] for i in made}):
            own = [i for i in made if skies.group[i].split(" ")[0] == group]
            print(f"{group}: class right in {100.0 * np.mean([name(p[i]) == name(skies.y[i]) for i in own]):.1f} % of {len(own)}")


def sha256_of(path):
    with open(path, "rb") as stream:
        return hashlib.sha256(stream.read()).hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="*", help="tables of tests/sky_table")
    parser.add_argument("--results", action="append", default=[], help="database of a survey with the work filter")
    parser.add_argument("--truth", action="append", default=[], help="CSV of its frames' answers")
    parser.add_argument("--note", default="", help="words to stand in the file")
    parser.add_argument("--validate", action="store_true", help="judge what is left out")
    parser.add_argument("-o", "--output", help="file to write")
    options = parser.parse_args()
    if len(options.results) != len(options.truth):
        sys.exit("learn_sky_kind.py: as many --results as --truth")
    if not options.output and not options.validate:
        sys.exit("learn_sky_kind.py: give -o FILE, --validate or both")
    skies = Skies()
    for table in options.tables:
        read_table(skies, table)
    for database, truth in zip(options.results, options.truth):
        if read_survey(skies, database, truth) == 0:
            sys.exit(f"learn_sky_kind.py: no frame of {database} has its truth in {truth}")
    if not skies.rows:
        sys.exit("learn_sky_kind.py: no skies")
    skies.arrays()
    values = {q: set(skies.y[used_of(skies, q), QUESTIONS.index(q)]) for q in QUESTIONS}
    asked = [q for q in QUESTIONS if len(values[q]) == 2]
    sums = {q: unseen_sums(skies, q) if q in asked else np.full(len(skies.rows), np.nan) for q in QUESTIONS}
    if options.validate:
        validate(skies, sums)
    if options.output:
        questions = {q: json_of(Model(skies, q, used_of(skies, q)), *(calibration(skies, q, sums[q], known) for known in (False, True)))
                     for q in asked}
        for q in QUESTIONS:
            if len(values[q]) == 1:
                questions[q] = always(skies, q)
        text = json.dumps({"kind": "vegard sky kinds", "format": 2, "note": options.note, "skies": len(skies.rows),
                           "tables": [sha256_of(path) for path in options.tables + options.truth]})[:-1]
        text += ',\n"questions": {\n' + ",\n".join(f'"{q}": {json.dumps(value)}' for q, value in questions.items()) + "\n}}\n"
        with open(options.output + ".partial", "w") as stream:
            stream.write(text)
        os.replace(options.output + ".partial", options.output)
        for q in QUESTIONS:
            used = used_of(skies, q)
            print(f"{q}: {int(np.nansum(skies.y[used, QUESTIONS.index(q)]))} of {used.sum()} skies"
                  + ("" if q in questions else ", not learnt: the built-in model's"))


if __name__ == "__main__":
    main()
