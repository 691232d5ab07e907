#!/usr/bin/env python3
"""Learns the kind of sky of pictures by themselves (fit/sky_kind/kind_model.h), and judges it by cameras that it never saw.

  scripts/learn_kinds.py real.csv made21.csv --validate
  scripts/learn_kinds.py real.csv made21.csv -o data/filter/kinds.json

The tables are those of tests/sky_table, of pictures marked by eye (tests/fit/sky_kind/marks.csv) and of made skies. Aurora or none
follows from a logistic regression, the kinds with aurora and those without from a multinomial one each, with a penalty on the squares
of the weights of standardised features. A picture with several words counts by the sum of their probabilities. Marked pictures have
0.7 of the weight, each camera the same share; made skies have the rest, each kind the same share. --validate judges each camera by a
model learnt without it, and made skies in five parts. Needs numpy. The same tables give the same bytes.
"""

import argparse
import csv
import hashlib
import json
import os
import sys

import numpy as np

KINDS = ["overhead", "rayed", "several_arcs", "one_arc", "diffuse", "twilight", "cloud", "moon", "lamps", "clear"]
AURORA, NONE = KINDS[:5], KINDS[5:]
# What is weighted. Aurora: green light, or in grey pictures strong and long lines. Its kinds: how many lines there are, how strong
# what crosses them is. Other kinds: stars, the colour of the sky and of its bright parts, a white disc, what the sky is like at large.
COLOUR, GREY = ["green spread"], ["ridge top", "wide lines"]
OF_AURORA = ["crossings", "thin lines", "structure", "green spread", "ray strength", "fine rays"]
OF_NONE = ["star tiles", "blue", "disc", "warm", "smooth", "elongated"]
REAL_SHARE, RIDGE, RIDGE_OF_NONE = 0.7, 0.01, 0.03
STEPS = 1500
SURE = 0.6


def word_of_made(row):
    yes = lambda question: row[question] == "1"
    if yes("arc"):
        return next((word for question, word in [("overhead", "overhead"), ("rayed", "rayed"), ("several", "several_arcs")] if yes(question)),
                    "one_arc")
    if yes("aurora"):
        return "diffuse"
    return next((word for question, word in [("twilight", "twilight"), ("cloud", "cloud"), ("moon", "moon"), ("lamp", "lamps")] if yes(question)),
                "clear")


class Skies:
    """Rows of tables: words that are right, the first the best; the camera, empty for made skies."""

    def __init__(self, tables):
        self.rows = []
        for table in tables:
            with open(table, newline="") as stream:
                self.rows += [row for row in csv.DictReader(stream) if row["black"] != "1"]
        self.words = [row["kinds"].split("|") if row["kinds"] else [word_of_made(row)] for row in self.rows]
        self.camera = np.array([row["camera"] for row in self.rows])
        self.is_grey = np.isnan(self.column("green spread"))
        self.is_aurora = np.array([words[0] in AURORA for words in self.words])
        made = iter(range(len(self.rows)))
        self.fold = np.array([camera or f"made {next(made) % 5}" for camera in self.camera])

    def column(self, name):
        return np.array([float(row[name]) if row[name] else np.nan for row in self.rows])

    def columns(self, names):
        return np.stack([self.column(name) for name in names], axis=1)

    def weights(self, used):
        weight = np.zeros(len(self.rows))
        made = used & (self.camera == "")
        cameras, words = sorted(set(self.camera[used & ~made])), np.array([w[0] for w in self.words])
        share = REAL_SHARE if made.any() and cameras else 1.0
        for camera in cameras:
            own = used & (self.camera == camera)
            weight[own] = share / len(cameras) / own.sum()
        for word in (kinds := sorted(set(words[made]))):
            own = made & (words == word)
            weight[own] = (1.0 - share if cameras else 1.0) / len(kinds) / own.sum()
        return weight[used]


def likely(odds):
    odds = np.exp(odds - odds.max(axis=1, keepdims=True))
    return odds / odds.sum(axis=1, keepdims=True)


class Multinomial:
    """Weights of features for some kinds, of which each picture has one or may have several."""

    def __init__(self, skies, used, features, may, ridge):
        self.features = features
        x, weight = skies.columns(features)[used], skies.weights(used)
        has = ~np.isnan(x)
        self.least, self.most = np.nanpercentile(x, 2, axis=0), np.nanpercentile(x, 98, axis=0)
        x = np.clip(x, self.least, self.most)
        shares = weight[:, None] * has
        self.mean = (np.where(has, x, 0.0) * shares).sum(0) / shares.sum(0)
        x = np.where(has, x, self.mean)
        self.scale = np.sqrt(weight @ (x - self.mean) ** 2) + 1e-6
        a = np.hstack([np.ones((len(x), 1)), (x - self.mean) / self.scale])
        may = may[used]
        penalty = np.full((a.shape[1], 1), ridge)
        penalty[0] = 0.1 * ridge
        # Accelerated gradient descent (Nesterov 1983); the curvature is at most half of the largest eigenvalue.
        step = 1.0 / (0.5 * np.linalg.eigvalsh((a * weight[:, None]).T @ a)[-1] + ridge)
        b = ahead = np.zeros((a.shape[1], may.shape[1]))
        for n in range(STEPS):
            p = likely(a @ ahead)
            right = p * may
            right /= right.sum(axis=1, keepdims=True)
            new = ahead - step * (a.T @ (weight[:, None] * (p - right)) + penalty * ahead)
            ahead = new + n / (n + 3.0) * (new - b)
            b = new
        self.b = b

    def probabilities(self, skies):
        x = np.clip(skies.columns(self.features), self.least, self.most)
        x = np.where(np.isnan(x), self.mean, x)
        return likely(self.b[0] + (x - self.mean) / self.scale @ self.b[1:])

    def json(self, b):
        six = lambda v: float(f"{v:.6g}")
        slopes = b[1:] / self.scale
        terms = [{"feature": name, "weight": six(s), "least": six(low), "most": six(high), "missing": six(s * m)}
                 for name, s, low, high, m in zip(self.features, slopes, self.least, self.most, self.mean)]
        return {"constant": six(b[0] - slopes @ self.mean), "terms": terms}


class Model:
    def __init__(self, skies, used):
        yes_no = np.stack([~skies.is_aurora, skies.is_aurora], axis=1).astype(float)
        may = lambda kinds: np.array([[1.0 if kind in words else 0.0 for kind in kinds] for words in skies.words])
        self.grey = Multinomial(skies, used & skies.is_grey, GREY, yes_no, RIDGE)
        self.colour = Multinomial(skies, used & ~skies.is_grey, COLOUR, yes_no, RIDGE)
        self.with_aurora = Multinomial(skies, used & skies.is_aurora, OF_AURORA, may(AURORA), RIDGE)
        self.without = Multinomial(skies, used & ~skies.is_aurora, OF_NONE, may(NONE), RIDGE_OF_NONE)

    def probabilities(self, skies):
        aurora = np.where(skies.is_grey, self.grey.probabilities(skies)[:, 1], self.colour.probabilities(skies)[:, 1])[:, None]
        return np.hstack([aurora * self.with_aurora.probabilities(skies), (1.0 - aurora) * self.without.probabilities(skies)])

    def json(self):
        aurora = {name: model.json(model.b[:, 1] - model.b[:, 0]) for name, model in (("grey", self.grey), ("colour", self.colour))}
        kinds = {kind: model.json(model.b[:, k]) for model, names in ((self.with_aurora, AURORA), (self.without, NONE))
                 for k, kind in enumerate(names)}
        return aurora, kinds


def told(words, said):
    """How often what was said with a probability is so."""
    for low in (0.0, 0.2, 0.4, 0.6, 0.8):
        some = [(p, good) for p, good in said if low <= p < low + 0.2 or (low == 0.8 and p == 1.0)]
        if some:
            print(f"{words} said {low:.1f} to {low + 0.2:.1f}: {len(some)}, mean {np.mean([p for p, _ in some]):.2f}, "
                  f"so {np.mean([good for _, good in some]):.2f}")


def validate(skies):
    p = np.zeros((len(skies.rows), len(KINDS)))
    for fold in sorted(set(skies.fold)):
        p[skies.fold == fold] = Model(skies, skies.fold != fold).probabilities(skies)[skies.fold == fold]
    for name, of in (("real", skies.camera != ""), ("made", skies.camera == "")):
        right, halves, aurora_right, sure, each, said, aurora_said, table = 0, 0.0, 0, [], {}, [], [], {}
        for i in np.flatnonzero(of):
            aurora, words = p[i, :5].sum(), skies.words[i]
            order = sorted(AURORA if aurora > 0.5 else NONE, key=lambda kind: -p[i, KINDS.index(kind)])
            good, probability = order[0] in words, p[i, KINDS.index(order[0])]
            is_sure = probability >= SURE * max(aurora, 1.0 - aurora)
            right += good
            halves += float(good) if is_sure else 0.5 * (order[0] in words or order[1] in words)
            aurora_right += (aurora > 0.5) == skies.is_aurora[i]
            each.setdefault(skies.camera[i], []).append(good)
            said.append((probability, good))
            aurora_said.append((aurora, skies.is_aurora[i]))
            if is_sure:
                sure.append(good)
            table[words[0], order[0]] = table.get((words[0], order[0]), 0) + 1
            if name == "real":
                print(f"{'  ' if good else 'X '}{skies.rows[i]['file']}: {'|'.join(words)}; aurora {aurora:.2f}, {order[0]} "
                      f"({probability:.2f}){'' if is_sure else ' or ' + order[1]}")
        if not said:
            continue
        print(f"{name}: kind right in {right} of {len(said)}, each of {len(each)} cameras once "
              f"{100.0 * np.mean([np.mean(v) for v in each.values()]):.0f} %; two kinds as half {halves:.1f}; sure and right {sum(sure)} of "
              f"{len(sure)}; aurora or none right in {aurora_right}")
        told(f"{name}, kind", said)
        told(f"{name}, aurora", aurora_said)
        for (marked, found), n in sorted(table.items()):
            print(f"  {marked} found as {found}: {n}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tables", nargs="+", help="tables of tests/sky_table")
    parser.add_argument("--note", default="", help="words to stand in the file")
    parser.add_argument("--validate", action="store_true", help="judge each camera by a model learnt without it")
    parser.add_argument("-o", "--output", help="file to write")
    options = parser.parse_args()
    if not options.output and not options.validate:
        sys.exit("learn_kinds.py: give -o FILE, --validate or both")
    skies = Skies(options.tables)
    if options.validate:
        validate(skies)
    if options.output:
        aurora, kinds = Model(skies, np.ones(len(skies.rows), bool)).json()
        sums = []
        for path in options.tables:
            with open(path, "rb") as stream:
                sums.append(hashlib.sha256(stream.read()).hexdigest())
        head = json.dumps({"kind": "vegard kinds of pictures", "note": options.note, "skies": len(skies.rows), "tables": sums})[:-1]
        lines = ",\n".join(f'"{kind}": {json.dumps(value)}' for kind, value in kinds.items())
        with open(options.output + ".partial", "w") as stream:
            stream.write(f'{head},\n"aurora": {json.dumps(aurora)},\n"kinds": {{\n{lines}\n}}}}\n')
        os.replace(options.output + ".partial", options.output)


if __name__ == "__main__":
    main()
