#!/usr/bin/env python3
"""Does compiling, or the run of the tests, take longer than tests/house/budget/budget.json allows?

usage: budget.py build [--write | --table N | --once] BUILD_FOLDER
       budget.py tests [--write | --table N | --once] BUILD_FOLDER JUNIT_FILE

build: units of ninja's log, by target. tests: entries of a file that `ctest --output-junit` has written, by program or by
what is before the first point in their names. All times are given in those of one reference (tests/house/budget/reference.cpp),
compiled or run several times among them, so that budgets hold on slow machines and on fast ones. Machines differ more in the
time that the start of a program takes than in the speed at which it computes, by a factor of three and more. So starts have a
reference of their own (tests/house/budget/start.cpp), and where a start takes more of the other reference than it did when the
budget was written, all but the groups of unit tests may take longer: half of their time is starts.

Too much is a target (or group) above its budget times `group_slack`, or a single unit (or entry) above its own figure times
`unit_slack`, and `grace` references. A unit that took less than a fifth of its figure came from the compiler's cache: its
figure stands for it, and it is said if that is most of them. If the references differ so much that the slowest
of them would acquit, the machine was too busy to judge. A machine is also busy for seconds only, between two references:
entries of tests that are too long are run once more, and units compiled once more without the cache, one at a time, and the
shorter of their two times counts; of a unit compiled once more it is the processor's time. That takes at most a tenth of the time
of all: if more of them are too long, that is not for seconds, and only those that are too long by themselves, then the longest
of the others, are run or compiled.

The exit code is 1 if something is above its budget, 77 if there was too little to judge by, 2 for a wrong call. --write
commits to what is measured, where all tests passed; CONTRIBUTING.md says when that is right.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True
from build_times import units_of  # noqa: E402

BUDGET = pathlib.Path(__file__).parent.parent / "tests/house/budget/budget.json"
SLACK = {"build": {"group_slack": 1.25, "unit_slack": 1.6, "grace": 0.5},
         "tests": {"group_slack": 1.5, "unit_slack": 2.0, "grace": 3.0}}
REFERENCE = "budget_reference"  # targets and tests of this name, with a number behind it
START = "budget_start"  # tests of this name, with a number behind it
STARTS = 0.5  # of the time of tests that run programs, unit tests left out
AGAIN = 0.1  # of the time of all tests, or units
CACHED = 0.2  # of its figure: no compiler is that much faster, a cache is
LISTED = 0.1  # references: what is below has no figure of its own
NOT_MEASURED = 77
UNIT_TESTS = set()  # groups of entries that are part of one program


class Unmeasured(Exception):
    pass


def target_of(output):
    """sim/CMakeFiles/vegard_sim.dir/base/error.cpp.o is ("vegard_sim", "base/error.cpp"); None for what is no unit."""
    found = re.search(r"(?:^|/)CMakeFiles/([^/]+)\.dir/(.+)\.(?:o|gch|pch)$", output)
    return (found[1], found[2]) if found and found[1] != START else None


def outputs_of(folder):
    """Seconds by output of what is built now: objects of batches that are no more may still lie in the folder."""
    told = subprocess.run(["ninja", "-C", folder, "-t", "targets", "all"], capture_output=True, text=True)
    built = {line.rsplit(":", 1)[0] for line in told.stdout.splitlines()} if told.returncode == 0 else None
    return {output: seconds for output, seconds in units_of(folder).items()
            if target_of(output) and (folder / output).exists() and (built is None or output in built)}


def of_build(folder):
    """Seconds of each unit by target."""
    groups = {}
    for output, seconds in outputs_of(folder).items():
        group, unit = target_of(output)
        groups.setdefault(group, {})[unit] = seconds
    return groups


def of_tests(folder, junit):
    """Seconds of each entry that ran, by group."""
    listing = subprocess.run(["ctest", "--test-dir", folder, "--show-only=json-v1"], check=True, capture_output=True)
    programs = {test["name"]: pathlib.Path(test["command"][0]).name
                for test in json.loads(listing.stdout)["tests"] if "command" in test}
    groups = {}
    for case in xml.etree.ElementTree.parse(junit).getroot().iter("testcase"):
        name = case.get("name")
        if case.get("status") == "run":
            program = programs.get(name, "")
            group = program[:-6] if program.endswith("_tests") else name.split(".")[0]
            groups.setdefault(group, {})[name] = float(case.get("time"))
            if program.endswith("_tests"):
                UNIT_TESTS.add(group)
    return groups


def failed_in(junit):
    """The names of the entries that failed: how long they would have taken is not known."""
    return sorted(case.get("name") for case in xml.etree.ElementTree.parse(junit).getroot().iter("testcase")
                  if case.get("status") == "fail")


def taken_out(groups, name):
    """The seconds of the units of this name, which are taken out of the groups."""
    found = []
    for group in list(groups):
        for unit in list(groups[group]):
            if group.startswith(name) or name in unit:
                found.append(groups[group].pop(unit))
        if not groups[group]:
            del groups[group]
    return found


class References:
    """How long the references took, which are taken out of the groups."""

    def __init__(self, groups):
        self.seconds = taken_out(groups, REFERENCE)
        starts = taken_out(groups, START)
        if not self.seconds:
            raise Unmeasured("no reference was compiled or run")
        self.start = statistics.median(starts) if starts else None

    def words(self):
        return (f"reference: {', '.join(f'{seconds:.2f}' for seconds in self.seconds)} s" +
                (f"; start: {self.start:.2f} s" if self.start else ""))

    def slow_starts(self, budget):
        """How much longer, in references, a test of programs takes than on the machine of the budget since starts take longer."""
        known = budget.get("start")
        if not known or not self.start:
            return 1.0
        return 1.0 + STARTS * max(0.0, self.start / statistics.median(self.seconds) / known - 1.0)

    def measured(self, groups, slow_starts, reference=None):
        """The times of the groups in references, of `reference` s each or of the median."""
        reference = reference or statistics.median(self.seconds)
        return {group: {unit: seconds / reference / (1.0 if group in UNIT_TESTS else slow_starts) for unit, seconds in units.items()}
                for group, units in groups.items()}


def is_batch(unit):
    """Of a unity build: what it holds changes with every file that is added before."""
    return unit.startswith("Unity/")


def files_of(folder, group, unit):
    """The names of the files in a batch, in brackets."""
    for batch in folder.glob(f"**/CMakeFiles/{group}.dir/{unit}") if is_batch(unit) else []:
        names = re.findall(r'#include ".*?([^/"]+)"', batch.read_text())
        return f" ({', '.join(names)})"
    return ""


class Judge:
    def __init__(self, budget, folder, cached):
        self.groups, self.slack, self.folder = budget["groups"], budget, folder
        self.cached = cached  # are there units that a cache serves?
        self.served = self.known = 0.0
        self.above = set()

    def figure(self, group, unit):
        return self.groups.get(group, {"units": {}})["units"].get(unit)

    def allowed(self, group, unit):
        """What a unit may take. A batch may take what the longest one of its target may."""
        figures = self.groups[group]["units"]
        figure = figures.get(unit)
        if is_batch(unit) or figure is None:
            figure = max([LISTED] + [value for name, value in figures.items() if is_batch(name) == is_batch(unit)])
        return figure * self.slack["unit_slack"] + self.slack["grace"]

    def is_long(self, group, unit, value):
        """Did this entry bring its group, or itself, above what is allowed?"""
        return value > 1.1 * (self.figure(group, unit) or 0.0) + LISTED and group in self.above

    def growth(self, group, units):
        """The three that have grown most, in words."""
        grown = sorted(((value - (self.figure(group, unit) or 0.0), unit) for unit, value in units.items()), reverse=True)
        return "; ".join(f"{unit} from {self.figure(group, unit) or 0.0:.2f} to {units[unit]:.2f}{files_of(self.folder, group, unit)}"
                         for difference, unit in grown[:3] if difference > 0.0)

    def complaints(self, measured):
        """What is above its budget, a line each."""
        found = []
        self.above = set()  # groups with a complaint
        self.served = self.known = 0.0
        for group, units in measured.items():
            total, really = 0.0, {}
            for unit, value in units.items():
                figure = self.figure(group, unit)
                self.known += figure or 0.0
                if self.cached and figure and value < CACHED * figure:
                    self.served += figure
                    total += figure
                else:
                    really[unit] = value
                    total += value
            if group not in self.groups:
                if total > self.slack["grace"]:
                    self.above.add(group)
                    found.append(f"{group} takes {total:.2f} references and has no budget; longest: {self.growth(group, really)}")
                continue
            budget = self.groups[group]["budget"]
            if total > budget * self.slack["group_slack"] + self.slack["grace"]:
                self.above.add(group)
                found.append(f"{group} takes {total:.2f} references, of {budget:.2f} in the budget; most grown: "
                             f"{self.growth(group, really)}")
            for unit, value in really.items():
                if value > self.allowed(group, unit):
                    self.above.add(group)
                    found.append(f"{unit} of {group} takes {value:.2f} references, at most {self.allowed(group, unit):.2f} are "
                                 f"allowed{files_of(self.folder, group, unit)}")
        return found


def longest_in(limit, seconds, first):
    """Names of entries, or units, that take no more than the limit together, at least one: those in `first`, then the longest."""
    chosen, total = [], 0.0
    for name in sorted(seconds, key=lambda name: (name not in first, -seconds[name])):
        if not chosen or total + seconds[name] <= limit:
            chosen.append(name)
            total += seconds[name]
    return sorted(chosen)


def run_again(folder, names, budget):
    """The entries of these names, run one at a time between new references: their references by group. Empty if one fails."""
    pattern = "|".join(re.sub(r"([^\w])", r"\\\1", name) for name in names)
    with tempfile.TemporaryDirectory() as scratch:
        junit = pathlib.Path(scratch) / "again.xml"
        done = subprocess.run(["ctest", "--test-dir", folder, "-j1", "-R", f"^({pattern}|house\\.({REFERENCE}|{START})_[0-9]+)$",
                               "--output-junit", junit], capture_output=True)
        groups = of_tests(folder, junit) if done.returncode == 0 else {}
    if not groups:
        return {}
    references = References(groups)
    return references.measured(groups, references.slow_starts(budget))


def compiled_s(folder, output):
    """The processor's time of compiling this once more, into nowhere and without the cache; None if that fails."""
    told = subprocess.run(["ninja", "-C", folder, "-t", "commands", "-s", output], capture_output=True, text=True)
    command = shlex.split(told.stdout.strip().split("\n")[-1])
    if told.returncode != 0 or "-o" not in command:
        return None
    with tempfile.TemporaryDirectory() as scratch:
        for option in ("-o", "-MF"):
            if option in command:
                command[command.index(option) + 1] = f"{scratch}/out{option}"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, cwd=folder, env={**os.environ, "CCACHE_DISABLE": "1"}, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime if done.returncode == 0 else None


def compile_again(folder, names):
    """The units of these names, "unit of group", compiled one at a time between references: their references by group,
    without those that fail."""
    outputs = {"{1} of {0}".format(*target_of(output)): output for output in outputs_of(folder)}
    reference = min((name for name in outputs if REFERENCE in name), default=None)
    if reference is None:
        return {}
    before, *units, after = [compiled_s(folder, outputs[name]) for name in [reference, *names, reference]]
    groups = {}
    for name, seconds in zip(names, units):
        if None not in (before, seconds, after):
            group, unit = target_of(outputs[name])
            groups.setdefault(group, {})[unit] = 2.0 * seconds / (before + after)
    return groups


def shorter(measured, again):
    """The shorter of two times of each entry."""
    return {group: {unit: min(value, again.get(group, {}).get(unit, value)) for unit, value in units.items()}
            for group, units in measured.items()}


def check(kind, groups, budget, folder, repeat):
    references = References(groups)
    if kind not in budget:
        raise Unmeasured(f"{BUDGET.name} has no figures for {kind}; budget.py {kind} --write makes them")
    judge = Judge(budget[kind], folder, kind == "build")
    slow_starts = references.slow_starts(budget[kind])  # 1 for a build, whose budget has no start
    acquitted = not judge.complaints(references.measured(groups, slow_starts, max(references.seconds)))
    measured = references.measured(groups, slow_starts)
    complaints = judge.complaints(measured)
    if complaints and not acquitted and repeat:
        def name_of(group, unit):
            return unit if kind == "tests" else f"{unit} of {group}"  # batches of several targets share a name

        too_long = {name_of(group, unit): groups[group][unit] for group, units in measured.items() for unit, value in units.items()
                    if judge.is_long(group, unit, value)}
        alone = {name_of(group, unit) for group, units in measured.items() for unit, value in units.items()
                 if name_of(group, unit) in too_long and group in judge.groups and value > judge.allowed(group, unit)}
        all_s = sum(sum(units.values()) for units in groups.values())
        if kind == "build":  # what a cache has served would have taken its figure
            all_s = max(all_s, judge.known * statistics.median(references.seconds))
        names = longest_in(AGAIN * all_s, too_long, alone)
        print(f"budget.py: once more, one at a time, {len(names)} of {len(too_long)} that took long: {', '.join(names)}", flush=True)
        again = run_again(folder, names, budget[kind]) if kind == "tests" else compile_again(folder, names)
        measured = shorter(measured, again)
        complaints = judge.complaints(measured)
    if complaints and acquitted:
        raise Unmeasured("the machine was too busy, the references differ; " + references.words() + "\n" + "\n".join(complaints))
    for complaint in complaints:
        print(f"budget.py: {complaint}", file=sys.stderr)
    if complaints:
        print(f"budget.py: above the budget; {references.words()}. CONTRIBUTING.md, \"A budget\", says what to do.", file=sys.stderr)
        return 1
    if judge.served > 0.5 * judge.known:
        raise Unmeasured(f"{100 * judge.served / judge.known:.0f} % came from the compiler's cache, or are five times as fast as "
                         "the budget; what was compiled is within it")
    total = sum(sum(units.values()) for units in measured.values())
    print(f"within the budget: {total:.1f} references in all; {references.words()}")
    return 0


def write(kind, groups, budget, folder):
    references = References(groups)
    measured = references.measured(groups, 1.0)
    if kind == "build":
        units = [value for group in measured.values() for value in group.values()]
        known = Judge(budget.get(kind, {"groups": {}}), folder, True)
        known.complaints(measured) if kind in budget else None
        if statistics.median(units) < 0.01 or known.served > 0.1 * known.known > 0.0:
            raise Unmeasured("much came from the compiler's cache: build with CCACHE_DISABLE=1 in an empty folder first")
    reference = statistics.median(references.seconds)
    budget[kind] = {**SLACK[kind], **{key: value for key, value in budget.get(kind, {}).items() if key not in ("groups", "start")},
                    **({"start": round(references.start / reference, 2)} if references.start else {}),
                    "groups": {group: {"budget": round(sum(units.values()), 2),
                                       "units": {unit: round(value, 2) for unit, value in sorted(units.items()) if value >= LISTED}}
                               for group, units in sorted(measured.items())}}
    BUDGET.write_text(json.dumps(budget, indent=1) + "\n")
    print(f"{BUDGET}: {kind} of {sum(group['budget'] for group in budget[kind]['groups'].values()):.1f} references, "
          f"of {reference:.2f} s each")
    return 0


def table(measured, slowest):
    """Groups, then the slowest units, by their references."""
    for group, units in sorted(measured.items(), key=lambda item: -sum(item[1].values())):
        print(f"{sum(units.values()):8.2f}  {group}, {len(units)}")
    units = sorted(((value, unit, group) for group, units in measured.items() for unit, value in units.items()), reverse=True)
    for value, unit, group in units[:slowest]:
        print(f"{value:8.2f}  {unit} of {group}")


def main():
    global BUDGET
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["build", "tests"])
    parser.add_argument("folder", type=pathlib.Path, help="where ninja has built")
    parser.add_argument("junit", type=pathlib.Path, nargs="?", help="of tests: what ctest has written")
    parser.add_argument("--budget", type=pathlib.Path, default=BUDGET, help="another file of budgets")
    parser.add_argument("--write", action="store_true", help="the budget becomes what is measured")
    parser.add_argument("--table", type=int, metavar="N", help="lists groups and the N slowest instead")
    parser.add_argument("--once", action="store_true", help="none is run or compiled again")
    arguments = parser.parse_args()
    if (arguments.kind == "tests") != (arguments.junit is not None):
        parser.error("a file of ctest's is for tests, and tests need it")
    BUDGET = arguments.budget
    budget = json.loads(BUDGET.read_text()) if BUDGET.exists() else {}
    groups = of_build(arguments.folder) if arguments.kind == "build" else of_tests(arguments.folder, arguments.junit)
    try:
        if arguments.table is not None:
            table(References(groups).measured(groups, 1.0), arguments.table)
            return 0
        if arguments.write:
            failed = failed_in(arguments.junit) if arguments.junit else []
            if failed:
                raise Unmeasured("these failed, and a budget without them would refuse them later: " + ", ".join(failed))
            return write(arguments.kind, groups, budget, arguments.folder)
        return check(arguments.kind, groups, budget, arguments.folder, not arguments.once)
    except Unmeasured as reason:
        print(f"budget.py: not measured: {reason}")
        return NOT_MEASURED


if __name__ == "__main__":
    sys.exit(main())
