#!/usr/bin/env python3
"""Do the tests notice? Puts the small faults of scripts/mutations.txt into a copy of the sources, one at a time.

usage: mutate.py [--list | --check | --table] [--survivors] [--no-cli | --short] [--jobs N] [NAME OR PATTERN ...]

A fault is built into a copy of the tree (build/mutate/tree, preset release). First run the tests that belong to its
file (tests/<its folder>/<its stem>_test.cpp), then those of its folder, then all tests of sim and of fit, the short
ones before the long ones, and in the end the cases of tests/cli. The first failure ends it: the fault was noticed. A
crash, and a test that takes many times its usual time, count as noticed. The sources themselves are never touched.

Without names those faults are tried that have no result yet, so that a run can be stopped and gone on with. Results
stand in build/mutate/results.jsonl, one line each time; --table prints them. A name or a pattern (as of a shell, or
a part of a name) tries those again, --survivors those that nothing noticed. --check only asks whether each entry
still fits the sources.

The list: for each fault a name in brackets, "file:", lines of old text after "- " and of new text after "+ ". The
old text may be a part of a line and must occur exactly once. "harmless:" says why no test can or need notice it.
"""
import argparse
import collections
import fnmatch
import hashlib
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "scripts" / "mutations.txt"
WORK = ROOT / "build" / "mutate"
TREE = WORK / "tree"
BUILD = TREE / "build" / "release"
RESULTS = WORK / "results.jsonl"
PROGRAMS = {"sim": ["sim_tests", "fit_tests"], "fit": ["fit_tests"], "apps": ["apps_tests"]}
LONG_TEST_S = 2.0  # tests that take longer come last
MEMORY_LIMIT_BYTES = 12 << 30
# Of a case of tests/cli: those that look at no numbers need not be asked.
CLI_WITHOUT_NUMBERS = "bad_input|image_errors|interrupted|unwritable|existing_run|install|resumed"

Fault = collections.namedtuple("Fault", "name file old new harmless line")


class ListError(Exception):
    pass


# The list


def read_list(path):
    faults, fields = [], None

    def finish():
        if fields is None:
            return
        old, new = "\n".join(fields["old"]), "\n".join(fields["new"])
        if not fields["file"] or not fields["old"] or not fields["new"]:
            raise ListError(f"{path}:{fields['line']}: [{fields['name']}] needs a file, old and new text")
        faults.append(Fault(fields["name"], fields["file"], old, new, " ".join(fields["harmless"]), fields["line"]))

    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("[") and line.endswith("]"):
            finish()
            fields = {"name": line[1:-1], "line": number, "file": "", "old": [], "new": [], "harmless": []}
        elif fields is None:
            raise ListError(f"{path}:{number}: expected a name in brackets")
        elif line.startswith("file: "):
            fields["file"] = line[6:].strip()
        elif line.startswith("- "):
            fields["old"].append(line[2:])
        elif line.startswith("+ "):
            fields["new"].append(line[2:])
        elif line.startswith("harmless: "):
            fields["harmless"].append(line[10:].strip())
        elif line.startswith("  ") and fields["harmless"]:
            fields["harmless"].append(line.strip())
        else:
            raise ListError(f"{path}:{number}: expected 'file: ', '- ', '+ ' or 'harmless: '")
    finish()
    return faults


def stale_entries(faults):
    """What is wrong with the list beside the sources, one line each."""
    complaints = []
    for name, times in collections.Counter(f.name for f in faults).items():
        if times > 1:
            complaints.append(f"{LIST.name}: [{name}] is there {times} times")
    for fault in faults:
        where = f"{LIST.name}:{fault.line}: [{fault.name}]"
        source = ROOT / fault.file
        if not source.is_file():
            complaints.append(f"{where} is of {fault.file}, which is not there")
            continue
        times = source.read_text().count(fault.old)
        if times != 1:
            complaints.append(f"{where}: its old text occurs {times} times in {fault.file}; give it as it is there now")
        if fault.old == fault.new:
            complaints.append(f"{where} changes nothing")
    return complaints


def digest(fault):
    return hashlib.sha256("\0".join([fault.file, fault.old, fault.new]).encode()).hexdigest()[:16]


# Results


def results_by_name(faults):
    """The results of each fault as it stands in the list, the oldest first."""
    digests = {digest(fault): fault.name for fault in faults}
    results = collections.defaultdict(list)
    if RESULTS.exists():
        for line in RESULTS.read_text().splitlines():
            result = json.loads(line)
            if result["digest"] in digests:
                results[digests[result["digest"]]].append(result)
    return results


def remember(fault, outcome, by, stage, seconds):
    result = {"name": fault.name, "digest": digest(fault), "outcome": outcome, "by": by, "stage": stage,
              "seconds": round(seconds, 1)}
    with RESULTS.open("a") as file:
        file.write(json.dumps(result) + "\n")
    return result


def words_of(result):
    if result["outcome"] == "noticed":
        return f"noticed by {result['by']} ({result['stage']}) after {result['seconds']:.0f} s"
    if result["outcome"] == "survived":
        return f"SURVIVED ({result['stage']}) after {result['seconds']:.0f} s"
    return f"{result['outcome'].upper()}: {result['by']}"


def print_table(faults):
    results = results_by_name(faults)
    count = collections.Counter()
    width = max(len(f.name) for f in faults)
    for fault in faults:
        of_fault = results.get(fault.name)
        if not of_fault:
            kind, words = "not run", "not run"
        else:
            first, last = of_fault[0], of_fault[-1]
            words = words_of(last)
            if last["outcome"] == "noticed":
                kind = "noticed at first"
                if any(r["outcome"] == "survived" for r in of_fault):
                    kind = "noticed by new tests"
                    words += "; survived before"
            elif last["outcome"] == "survived":
                kind = "harmless" if fault.harmless else "survived"
                if fault.harmless:
                    words += "; harmless: " + fault.harmless
            else:
                kind = "not built"
        count[kind] += 1
        print(f"{fault.name:{width}}  {words}")
    print(f"{len(faults)} faults: " + ", ".join(f"{number} {kind}" for kind, number in count.most_common()))
    tried = len(faults) - count["not run"] - count["not built"] - count["harmless"]
    noticed = count["noticed at first"] + count["noticed by new tests"]
    if tried:
        print(f"noticed: {noticed} of {tried} that are tried and not harmless, {100 * noticed / tried:.1f} %")


# The copy and its build


def update_copy():
    """Makes the copy what the tree is; only what differs is written, so that little is built."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, stdout=subprocess.PIPE).stdout.decode()
    wanted = {name for name in listed.split("\0") if name and (ROOT / name).is_file()}
    for name in wanted:
        target, content = TREE / name, (ROOT / name).read_bytes()
        if target.is_file() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        target.chmod((ROOT / name).stat().st_mode & 0o777)
    for path in TREE.rglob("*"):
        name = path.relative_to(TREE)
        if name.parts[0] not in ("build", ".git") and path.is_file() and str(name) not in wanted:
            path.unlink()


def limits(cpu_s):
    def apply():
        os.setsid()  # a group of its own, so that its children can be ended with it
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s + 5))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT_BYTES, MEMORY_LIMIT_BYTES))
    return apply


def run(command, log, cpu_s=None, wall_s=None):
    """The exit code of a command, or None if it took too long; its output is in `log`."""
    with log.open("wb") as output:
        process = subprocess.Popen(command, cwd=TREE, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, preexec_fn=limits(cpu_s) if cpu_s else os.setsid)
        try:
            return process.wait(wall_s)
        except subprocess.TimeoutExpired:
            return None
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


def configure():
    if (BUILD / "build.ninja").exists():
        return
    if run(["cmake", "--preset", "release", "-DVEGARD_INSTRUCTION_SETS=least", "-DVEGARD_WARNINGS_AS_ERRORS=ON"],
           WORK / "configure.log") != 0:
        sys.exit(f"mutate: cmake fails, see {WORK / 'configure.log'}")


def build(targets, jobs):
    return run(["ninja", "-C", str(BUILD), f"-j{jobs}", *targets], WORK / "build.log") == 0


def build_problem():
    for line in (WORK / "build.log").read_text(errors="replace").splitlines():
        if "error" in line or "FAILED" in line:
            return line.strip()
    return "see build/mutate/build.log"


# Tests


def tests_in(sources):
    """A filter of GoogleTest for the suites of some files of tests."""
    suites = set()
    for source in sources:
        for macro, suite in re.findall(r"^\s*(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\((\w+)", source.read_text(),
                                       re.MULTILINE):
            suites.add(suite)
    forms = ("{}.*", "*/{}.*", "{}/*", "*/{}/*")  # those with parameters and types have more to their names
    return [form.format(suite) for suite in sorted(suites) for form in forms]


def room_filters(file):
    """The tests of a file, then those of its folder, or of the next above that has any."""
    path = pathlib.PurePosixPath(file)
    stem = re.sub("-inl$", "", path.stem)
    folder = ROOT / "tests" / path.parent
    own = folder / f"{stem}_test.cpp"
    filters = [("its own tests", tests_in([own]))] if own.is_file() else []
    while folder != ROOT / "tests" and not list(folder.glob("*_test.cpp")):
        folder = folder.parent
    filters.append(("its room", tests_in(sorted(folder.glob("*_test.cpp")))))
    return [(stage, patterns) for stage, patterns in filters if patterns]


def file_digests(program):
    """Of the files of a program's tests."""
    folder = ROOT / "tests" / program.split("_")[0]
    return {str(path.relative_to(ROOT)): hashlib.sha256(path.read_bytes()).hexdigest()[:16]
            for path in sorted(folder.rglob("*_test.cpp"))}


def baseline(program, jobs):
    """Seconds of each test of a program without any fault. Those that fail then are told, and not asked later."""
    file = WORK / f"baseline_{program}.json"
    known = json.loads(file.read_text()) if file.exists() else {"seconds": {}, "failing": [], "files": {}}
    digests = file_digests(program)
    changed = [ROOT / name for name, digest_now in digests.items() if known["files"].get(name) != digest_now]
    if not changed:
        return known
    update_copy()
    configure()
    if not build([program], jobs):
        sys.exit(f"mutate: {program} cannot be built, see {WORK / 'build.log'}")
    log = WORK / f"baseline_{program}.log"
    run([str(BUILD / "tests" / program), "--gtest_filter=" + ":".join(tests_in(changed))], log)
    text = log.read_text(errors="replace")
    failing = set(re.findall(r"^\[  FAILED  \] (\S+?\.[^\s,]+)", text, re.MULTILINE))
    for name, milliseconds in re.findall(r"^\[       OK \] ([^\s,]+).*? \((\d+) ms\)", text, re.MULTILINE):
        known["seconds"][name] = int(milliseconds) / 1000
    known["failing"] = sorted((set(known["failing"]) | failing) - (set(known["seconds"]) - failing))
    known["files"] = digests
    file.write_text(json.dumps(known, indent=0))
    if failing:
        print(f"without a fault already, these fail and are not asked: {', '.join(sorted(failing))}", flush=True)
    return known


def first_failure(log, code):
    text = log.read_text(errors="replace")
    failed = re.search(r"^\[  FAILED  \] (\S+?\.\S+?)[, ]", text, re.MULTILINE)
    if failed:
        return failed.group(1)
    running = re.findall(r"^\[ RUN      \] (\S+)", text, re.MULTILINE)
    what = "a hang" if code in (None, -signal.SIGXCPU, -signal.SIGKILL) else f"a crash (exit {code})"
    return f"{what} in {running[-1] if running else 'the beginning'}"


def notice(program, positive, negative, usual_s):
    """The test of a program that fails, or None. `usual_s`: what these tests take without a fault."""
    text = ":".join(positive or ["*"]) + ("-" + ":".join(negative) if negative else "")
    log = WORK / "test.log"
    code = run([str(BUILD / "tests" / program), "--gtest_fail_fast", f"--gtest_filter={text}"], log,
               cpu_s=int(120 + 10 * usual_s), wall_s=1800 + 20 * usual_s)
    return None if code == 0 else first_failure(log, code)


def matching(seconds, patterns):
    return [name for name in seconds if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]


def try_fault(fault, baselines, jobs, with_cli, with_long):
    """Builds and tests one fault, which is in the copy already: outcome, by which test, in which stage."""
    programs = PROGRAMS[fault.file.split("/")[0]]
    for program in programs:
        if not build([program], jobs):
            return "does not build", build_problem(), "build"
        known = baselines[program]
        seconds = known["seconds"]
        done = []
        if program == programs[0]:
            for stage, patterns in room_filters(fault.file):
                names = [name for name in matching(seconds, patterns)
                         if name not in done and seconds[name] <= 10 * LONG_TEST_S]
                if not names:
                    continue
                by = notice(program, names, [], sum(seconds[name] for name in names))
                if by:
                    return "noticed", by, stage
                done += names
        long_tests = [name for name, s in seconds.items() if s > LONG_TEST_S]
        usual_s = sum(seconds.values())
        by = notice(program, [], long_tests + done + known["failing"], usual_s)
        if by:
            return "noticed", by, f"short tests of {program}"
        rest = sorted((name for name in long_tests if name not in done), key=seconds.get)
        by = notice(program, rest, [], usual_s) if rest and with_long else None
        if by:
            return "noticed", by, f"long tests of {program}"
    if not with_cli or not with_long:
        return "survived", "", ("all" if with_long else "short") + " tests of " + " and ".join(programs)
    if not build(["vegard"], jobs):
        return "does not build", build_problem(), "build"
    cases = sorted(path.stem[: -len("_case")] for path in (ROOT / "tests" / "cli").glob("*_case.sh"))
    log = WORK / "test.log"
    for case in cases:
        if re.search(CLI_WITHOUT_NUMBERS, case):
            continue
        if run(["ctest", "--preset", "release", "-R", f"^cli\\.{case}$", "--timeout", "1200"], log) != 0:
            return "noticed", f"cli.{case}", "cases of tests/cli"
    return "survived", "", "all tests of " + " and ".join(programs) + " and the cases of tests/cli"


def try_all(faults, jobs, with_cli, with_long):
    for number, fault in enumerate(faults, 1):
        update_copy()
        configure()
        baselines = {program: baseline(program, jobs) for program in PROGRAMS[fault.file.split("/")[0]]}
        source = TREE / fault.file
        whole = source.read_text()
        begin = time.monotonic()
        try:
            source.write_text(whole.replace(fault.old, fault.new))
            outcome, by, stage = try_fault(fault, baselines, jobs, with_cli, with_long)
        finally:
            source.write_text(whole)
        result = remember(fault, outcome, by, stage, time.monotonic() - begin)
        print(f"{number}/{len(faults)} {fault.name}: {words_of(result)}", flush=True)


def chosen(faults, names):
    def fits(fault, name):
        return fnmatch.fnmatchcase(fault.name, name) or name in fault.name or name in fault.file
    for name in names:
        if not any(fits(fault, name) for fault in faults):
            sys.exit(f"mutate: no fault is called '{name}'; --list says them")
    return [fault for fault in faults if any(fits(fault, name) for name in names)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="faults to try, by name, part of it, pattern or file")
    parser.add_argument("--list", action="store_true", help="print names and files of all faults")
    parser.add_argument("--check", action="store_true", help="only ask whether all entries fit the sources")
    parser.add_argument("--table", action="store_true", help="print what has come out so far")
    parser.add_argument("--survivors", action="store_true", help="try again those that nothing noticed")
    parser.add_argument("--no-cli", action="store_true", help="leave out the cases of tests/cli")
    parser.add_argument("--short", action="store_true", help="leave out the long tests and the cases of tests/cli")
    parser.add_argument("--jobs", type=int, default=1, help="units to compile at once (1)")
    options = parser.parse_args()
    try:
        faults = read_list(LIST)
    except ListError as error:
        sys.exit(f"mutate: {error}")
    complaints = stale_entries(faults)
    if complaints:
        print("\n".join(complaints), file=sys.stderr)
        return 1
    if options.check:
        print(f"{len(faults)} faults, all of which fit the sources")
        return 0
    if options.list:
        for fault in faults:
            print(f"{fault.file}: {fault.name}")
        return 0
    if not options.table:
        TREE.mkdir(parents=True, exist_ok=True)
        results = results_by_name(faults)
        if options.names:
            to_try = chosen(faults, options.names)
        elif options.survivors:
            to_try = [f for f in faults if results.get(f.name) and results[f.name][-1]["outcome"] == "survived"]
        else:
            to_try = [f for f in faults if not results.get(f.name)]
        try_all(to_try, options.jobs, not options.no_cli, not options.short)
    print_table(faults)
    return 0


if __name__ == "__main__":
    sys.exit(main())
