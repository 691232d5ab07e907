#!/usr/bin/env python3
"""Does compiling, or the run of the tests, take longer than tests/house/budget/budget.json allows?

usage: budget.py build [--write | --table N] BUILD_FOLDER
       budget.py tests [--write | --table N] BUILD_FOLDER JUNIT_FILE

build: units of ninja's log, by target. tests: entries of a file that `ctest --output-junit` has written, by program or by
what is before the first point in their names. All times are given in those of one reference (tests/house/budget/reference.cpp),
compiled or run several times among them, so that budgets hold on slow machines and on fast ones.

Too much is a target (or group) above its budget times `group_slack`, or a single unit (or entry) above its own figure times
`unit_slack`, and `grace` references. A unit that took less than a fifth of its figure came from the compiler's cache: its
figure stands for it, and it is said if that is most of them. If the references differ so much that the slowest
of them would acquit, the machine was too busy to judge.

The exit code is 1 if something is above its budget, 77 if there was too little to judge by, 2 for a wrong call. --write
commits to what is measured; CONTRIBUTING.md says when that is right.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import xml.etree.ElementTree

sys.dont_write_bytecode = True
from build_times import units_of  # noqa: E402

BUDGET = pathlib.Path(__file__).parent.parent / "tests/house/budget/budget.json"
SLACK = {"build": {"group_slack": 1.25, "unit_slack": 1.6, "grace": 0.5},
         "tests": {"group_slack": 1.5, "unit_slack": 2.0, "grace": 3.0}}
REFERENCE = "budget_reference"  # targets and tests of this name, with a number behind it
CACHED = 0.2  # of its figure: no compiler is that much faster, a cache is
LISTED = 0.1  # references: what is below has no figure of its own
NOT_MEASURED = 77


class Unmeasured(Exception):
    pass


def of_build(folder):
    """Seconds of each unit by target. sim/CMakeFiles/vegard_sim.dir/base/error.cpp.o is base/error.cpp of vegard_sim."""
    groups = {}
    for output, seconds in units_of(folder).items():
        target = re.search(r"(?:^|/)CMakeFiles/([^/]+)\.dir/(.+)\.(?:o|gch|pch)$", output)
        if target and (folder / output).exists():
            groups.setdefault(target[1], {})[target[2]] = seconds
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
    return groups


def references_of(groups):
    """The seconds of the references, which are taken out of the groups."""
    found = []
    for group in list(groups):
        for unit in list(groups[group]):
            if group.startswith(REFERENCE) or REFERENCE in unit:
                found.append(groups[group].pop(unit))
        if not groups[group]:
            del groups[group]
    if not found:
        raise Unmeasured("no reference was compiled or run")
    return found


def in_references(groups, reference):
    return {group: {unit: seconds / reference for unit, seconds in units.items()} for group, units in groups.items()}


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

    def figure(self, group, unit):
        return self.groups.get(group, {"units": {}})["units"].get(unit)

    def allowed(self, group, unit):
        """What a unit may take. A batch may take what the longest one of its target may."""
        figures = self.groups[group]["units"]
        figure = figures.get(unit)
        if is_batch(unit) or figure is None:
            figure = max([LISTED] + [value for name, value in figures.items() if is_batch(name) == is_batch(unit)])
        return figure * self.slack["unit_slack"] + self.slack["grace"]

    def growth(self, group, units):
        """The three that have grown most, in words."""
        grown = sorted(((value - (self.figure(group, unit) or 0.0), unit) for unit, value in units.items()), reverse=True)
        return "; ".join(f"{unit} from {self.figure(group, unit) or 0.0:.2f} to {units[unit]:.2f}{files_of(self.folder, group, unit)}"
                         for difference, unit in grown[:3] if difference > 0.0)

    def complaints(self, measured):
        """What is above its budget, a line each."""
        found = []
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
                    found.append(f"{group} takes {total:.2f} references and has no budget; longest: {self.growth(group, really)}")
                continue
            budget = self.groups[group]["budget"]
            if total > budget * self.slack["group_slack"] + self.slack["grace"]:
                found.append(f"{group} takes {total:.2f} references, of {budget:.2f} in the budget; most grown: "
                             f"{self.growth(group, really)}")
            for unit, value in really.items():
                if value > self.allowed(group, unit):
                    found.append(f"{unit} of {group} takes {value:.2f} references, at most {self.allowed(group, unit):.2f} are "
                                 f"allowed{files_of(self.folder, group, unit)}")
        return found


def check(kind, groups, budget, folder):
    references = references_of(groups)
    if kind not in budget:
        raise Unmeasured(f"{BUDGET.name} has no figures for {kind}; budget.py {kind} --write makes them")
    judge = Judge(budget[kind], folder, kind == "build")
    acquitted = not judge.complaints(in_references(groups, max(references)))
    complaints = judge.complaints(in_references(groups, statistics.median(references)))
    of_references = f"reference: {', '.join(f'{seconds:.2f}' for seconds in references)} s"
    if complaints and acquitted:
        raise Unmeasured("the machine was too busy, the references differ; " + of_references + "\n" + "\n".join(complaints))
    for complaint in complaints:
        print(f"budget.py: {complaint}", file=sys.stderr)
    if complaints:
        print(f"budget.py: above the budget; {of_references}. CONTRIBUTING.md, \"A budget\", says what to do.", file=sys.stderr)
        return 1
    if judge.served > 0.5 * judge.known:
        raise Unmeasured(f"{100 * judge.served / judge.known:.0f} % came from the compiler's cache, or are five times as fast as "
                         "the budget; what was compiled is within it")
    total = sum(sum(units.values()) for units in in_references(groups, statistics.median(references)).values())
    print(f"within the budget: {total:.1f} references in all; {of_references}")
    return 0


def write(kind, groups, budget, folder):
    references = references_of(groups)
    measured = in_references(groups, statistics.median(references))
    if kind == "build":
        units = [value for group in measured.values() for value in group.values()]
        known = Judge(budget.get(kind, {"groups": {}}), folder, True)
        known.complaints(measured) if kind in budget else None
        if statistics.median(units) < 0.01 or known.served > 0.1 * known.known > 0.0:
            raise Unmeasured("much came from the compiler's cache: build with CCACHE_DISABLE=1 in an empty folder first")
    budget[kind] = {**SLACK[kind], **{key: value for key, value in budget.get(kind, {}).items() if key != "groups"},
                    "groups": {group: {"budget": round(sum(units.values()), 2),
                                       "units": {unit: round(value, 2) for unit, value in sorted(units.items()) if value >= LISTED}}
                               for group, units in sorted(measured.items())}}
    BUDGET.write_text(json.dumps(budget, indent=1) + "\n")
    print(f"{BUDGET}: {kind} of {sum(group['budget'] for group in budget[kind]['groups'].values()):.1f} references, "
          f"of {statistics.median(references):.2f} s each")
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
    arguments = parser.parse_args()
    if (arguments.kind == "tests") != (arguments.junit is not None):
        parser.error("a file of ctest's is for tests, and tests need it")
    BUDGET = arguments.budget
    budget = json.loads(BUDGET.read_text()) if BUDGET.exists() else {}
    groups = of_build(arguments.folder) if arguments.kind == "build" else of_tests(arguments.folder, arguments.junit)
    try:
        if arguments.table is not None:
            reference = statistics.median(references_of(groups))
            table(in_references(groups, reference), arguments.table)
            return 0
        return (write if arguments.write else check)(arguments.kind, groups, budget, arguments.folder)
    except Unmeasured as reason:
        print(f"budget.py: not measured: {reason}")
        return NOT_MEASURED


if __name__ == "__main__":
    sys.exit(main())
