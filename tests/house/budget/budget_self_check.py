#!/usr/bin/env python3
"""Does scripts/budget.py refuse what has grown, by its name, and nothing else? On made logs of ninja and of ctest.

usage: budget_self_check.py [-v]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

BUDGET = pathlib.Path(__file__).resolve().parents[3] / "scripts/budget.py"

UNITS = {"sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp": 20.0, "sim/CMakeFiles/vegard_sim.dir/Unity/unity_0_cxx.cxx": 10.0,
         "sim/CMakeFiles/vegard_sim.dir/Unity/unity_1_cxx.cxx": 12.0, "tests/CMakeFiles/sim_tests.dir/Unity/unity_0_cxx.cxx": 8.0}
REFERENCES = {f"tests/house/CMakeFiles/budget_reference_{i}.dir/budget/reference.cpp": 5.0 for i in range(3)}
ENTRIES = {"cli.render": 10.0, "cli.fit": 20.0, "Spline": 5.0, "house.budget_reference_1": 1.0, "house.budget_reference_2": 1.0}


class Budgets(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def run_budget(self, kind, *arguments):
        files = [self.folder] if kind == "build" else [self.folder, self.folder / "tests.xml"]
        done = subprocess.run([sys.executable, BUDGET, kind, "--budget", self.folder / "budget.json", *arguments, *files],
                              capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def build(self, units, *arguments):
        lines = ["# ninja log v5"]
        for name, seconds in units.items():
            output = self.folder / (name + ".o")
            output.parent.mkdir(parents=True, exist_ok=True)
            output.touch()
            if "Unity" in name:
                output.with_suffix("").write_text(f'#include "/source/first_of_{pathlib.Path(name).stem}.cpp"\n')
            lines.append(f"1000\t{1000 + int(1000 * seconds)}\t0\t{name}.o\tabc")
        (self.folder / ".ninja_log").write_text("\n".join(lines) + "\n")
        return self.run_budget("build", *arguments)

    def compilers(self, seconds):
        """From now on compiling takes that much of the processor's time, and says where it writes."""
        burn = "import sys, time\nwhile time.process_time() < float(sys.argv[1]): pass\nopen(sys.argv[3], 'w').write('compiled')\n"
        (self.folder / "burn.py").write_text(burn)
        (self.folder / "build.ninja").write_text(f"rule burn\n command = {sys.executable} burn.py $seconds -o $out\n" + "".join(
            f"build {name}.o: burn\n seconds = {value}\n" for name, value in seconds.items()))

    def run_of_tests(self, entries, *arguments):
        program = self.folder / "sim_tests"
        program.touch(0o755)
        (self.folder / "CTestTestfile.cmake").write_text(
            "".join(f"add_test([=[{name}]=] {'sh' if '.' in name else program})\n" for name in entries))
        (self.folder / "tests.xml").write_text("<testsuite>" + "".join(
            f'<testcase name="{name}" time="{seconds}" status="run"/>' for name, seconds in entries.items()) +
            '<testcase name="cli.skipped" time="900" status="notrun"/></testsuite>')
        return self.run_budget("tests", *arguments)

    def run_of_sleeping_tests(self, first, seconds, *arguments):
        """The first run took `first` of one entry; it takes `seconds` now, and the references a tenth of one."""
        entries = {"cli.fit": seconds, "cli.render": 0.1, "house.budget_reference_1": 0.1}
        (self.folder / "CTestTestfile.cmake").write_text("".join(f"add_test({name} sleep {value})\n" for name, value in entries.items()))
        (self.folder / "tests.xml").write_text("<testsuite>" + "".join(
            f'<testcase name="{name}" time="{first if name == "cli.fit" else value}" status="run"/>'
            for name, value in entries.items()) + "</testsuite>")
        return self.run_budget("tests", *arguments)

    def written_build(self):
        code, said = self.build({**UNITS, **REFERENCES}, "--write")
        self.assertEqual(code, 0, said)

    def test_writes_references_by_target(self):
        self.written_build()
        groups = json.loads((self.folder / "budget.json").read_text())["build"]["groups"]
        self.assertEqual(set(groups), {"vegard_sim", "sim_tests"})
        self.assertAlmostEqual(groups["vegard_sim"]["budget"], 42.0 / 5.0)
        self.assertAlmostEqual(groups["vegard_sim"]["units"]["render/kernel.cpp"], 4.0)

    def test_accepts_the_same_on_a_machine_half_as_fast(self):
        self.written_build()
        code, said = self.build({name: 2.0 * seconds for name, seconds in {**UNITS, **REFERENCES}.items()})
        self.assertEqual(code, 0, said)

    def test_names_the_unit_that_grew(self):
        self.written_build()
        name = "sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp"
        code, said = self.build({**UNITS, **REFERENCES, name: 40.0})
        self.assertEqual(code, 1, said)
        self.assertIn("render/kernel.cpp of vegard_sim takes 8.00 references", said)

    def test_compiles_again_what_took_long(self):
        self.written_build()
        name = "sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp"
        busy = {**UNITS, **REFERENCES, name: 40.0}
        self.compilers({**{unit: 0.1 for unit in busy}, name: 0.4})
        code, said = self.build(busy)
        self.assertEqual(code, 0, said)
        self.assertIn("1 of 1 that took long: render/kernel.cpp of vegard_sim\n", said)
        self.assertEqual((self.folder / (name + ".o")).read_bytes(), b"")
        self.compilers({**{unit: 0.1 for unit in busy}, name: 1.6})  # some 12 references where 1.6 · 4 + 0.5 are allowed
        code, said = self.build({**busy, name: 60.0})
        self.assertEqual(code, 1, said)
        self.assertIn("render/kernel.cpp of vegard_sim takes", said)
        self.compilers({unit: 0.1 for unit in {**UNITS, **REFERENCES}})
        code, said = self.build({**UNITS, **REFERENCES, "sim/CMakeFiles/vegard_sim.dir/Unity/unity_9_cxx.cxx": 90.0})
        self.assertEqual(code, 0, said)  # a batch that is no more
        self.assertNotIn("once more", said)
        self.compilers({unit: "no number" for unit in busy})
        code, said = self.build(busy)
        self.assertEqual(code, 1, said)

    def test_names_the_files_of_a_batch_that_grew(self):
        self.written_build()
        code, said = self.build({**UNITS, **REFERENCES, "sim/CMakeFiles/vegard_sim.dir/Unity/unity_1_cxx.cxx": 60.0})
        self.assertEqual(code, 1, said)
        self.assertIn("first_of_unity_1_cxx.cpp", said)

    def test_refuses_a_target_whose_units_all_grew_a_little(self):
        self.written_build()
        code, said = self.build({**{name: 1.45 * seconds for name, seconds in UNITS.items()}, **REFERENCES})
        self.assertEqual(code, 1, said)
        self.assertIn("vegard_sim takes 12.18 references, of 8.40 in the budget", said)

    def test_refuses_a_target_without_budget(self):
        self.written_build()
        code, said = self.build({**UNITS, **REFERENCES, "apps/CMakeFiles/new.dir/new.cpp": 5.0})
        self.assertEqual(code, 1, said)
        self.assertIn("new takes 1.00 references and has no budget", said)

    def test_judges_what_was_compiled_where_the_rest_is_from_the_cache(self):
        self.written_build()
        cached = {**{name: 0.1 for name in UNITS}, **REFERENCES}
        code, said = self.build(cached)
        self.assertEqual(code, 77, said)
        self.assertIn("100 % came from the compiler's cache", said)
        code, said = self.build({**cached, "sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp": 40.0})
        self.assertEqual(code, 1, said)
        self.assertIn("render/kernel.cpp", said)
        code, said = self.build({**cached, "sim/CMakeFiles/vegard_sim.dir/Unity/unity_1_cxx.cxx": 17.0,
                                 "sim/CMakeFiles/vegard_sim.dir/Unity/unity_0_cxx.cxx": 19.0})
        self.assertEqual(code, 1, said)
        self.assertIn("vegard_sim takes 11.20 references", said)

    def test_commits_to_nothing_from_the_cache(self):
        self.written_build()
        before = (self.folder / "budget.json").read_text()
        code, said = self.build({**{name: 0.1 for name in UNITS}, **REFERENCES}, "--write")
        self.assertEqual(code, 77, said)
        self.assertEqual((self.folder / "budget.json").read_text(), before)

    def test_does_not_judge_by_references_that_differ(self):
        self.written_build()
        busy = dict(zip(REFERENCES, [5.0, 5.0, 15.0]))
        code, said = self.build({**UNITS, **busy, "sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp": 40.0})
        self.assertEqual(code, 77, said)
        code, said = self.build({**UNITS, **busy, "sim/CMakeFiles/vegard_sim.dir/render/kernel.cpp": 400.0})
        self.assertEqual(code, 1, said)

    def test_does_not_judge_without_a_reference(self):
        self.written_build()
        code, said = self.build({name: 100.0 * seconds for name, seconds in UNITS.items()})
        self.assertEqual(code, 77, said)

    def test_forgets_units_that_are_gone(self):
        self.written_build()
        lines = (self.folder / ".ninja_log").read_text()
        (self.folder / ".ninja_log").write_text(lines + "0\t900000\t0\tsim/CMakeFiles/vegard_sim.dir/gone.cpp.o\tabc\n")
        code, said = self.run_budget("build")
        self.assertEqual(code, 0, said)

    def test_names_the_test_that_grew(self):
        code, said = self.run_of_tests(ENTRIES, "--write")
        self.assertEqual(code, 0, said)
        code, said = self.run_of_tests({name: 3.0 * seconds for name, seconds in ENTRIES.items()})
        self.assertEqual(code, 0, said)
        code, said = self.run_of_tests({**ENTRIES, "Spline": 30.0}, "--once")
        self.assertEqual(code, 1, said)
        self.assertIn("Spline of sim takes 30.00 references", said)
        code, said = self.run_of_tests({**ENTRIES, "cli.fit": 42.0}, "--once")
        self.assertEqual(code, 1, said)
        self.assertIn("cli takes 52.00 references, of 30.00 in the budget; most grown: cli.fit from 20.00 to 42.00", said)

    def test_commits_to_nothing_where_a_test_failed(self):
        self.run_of_tests(ENTRIES, "--write")
        before = (self.folder / "budget.json").read_text()
        failing = (self.folder / "tests.xml").read_text().replace('<testcase name="cli.fit" time="20.0" status="run"/>',
                                                                  '<testcase name="cli.fit" time="20.0" status="fail"/>')
        self.assertIn('status="fail"', failing)
        (self.folder / "tests.xml").write_text(failing)
        code, said = self.run_budget("tests", "--write")
        self.assertEqual(code, 77, said)
        self.assertIn("cli.fit", said)
        self.assertEqual((self.folder / "budget.json").read_text(), before)

    def test_judges_a_part_of_the_tests(self):
        self.run_of_tests(ENTRIES, "--write")
        part = {name: seconds for name, seconds in ENTRIES.items() if name != "cli.render"}
        code, said = self.run_of_tests(part)
        self.assertEqual(code, 0, said)
        code, said = self.run_of_tests({**part, "cli.fit": 60.0}, "--once")
        self.assertEqual(code, 1, said)

    def test_runs_again_what_took_long(self):
        self.run_of_sleeping_tests(0.1, 0.1, "--write")
        code, said = self.run_of_sleeping_tests(2.0, 0.1)
        self.assertEqual(code, 0, said)
        self.assertIn("1 of 1 that took long: cli.fit\n", said)
        code, said = self.run_of_sleeping_tests(2.0, 0.8)  # 8 references where 2 · 1 + 3 are allowed
        self.assertEqual(code, 1, said)
        self.assertIn("cli.fit of cli takes", said)

    def test_runs_again_for_a_tenth_of_the_time_of_all_at_most(self):
        entries = {f"cli.case_{i}": 10.0 for i in range(30)}
        self.run_of_tests({**entries, "house.budget_reference_1": 1.0}, "--write")
        code, said = self.run_of_tests({**{name: 30.0 for name in entries}, "house.budget_reference_1": 1.0})
        self.assertEqual(code, 1, said)
        self.assertIn("once more, one at a time, 3 of 30 that took long", said)

    def test_runs_first_again_what_is_too_long_by_itself(self):
        entries = {**{f"cli.case_{i}": 10.0 for i in range(30)}, "cli.short": 3.0, "house.budget_reference_1": 1.0}
        self.run_of_tests(entries, "--write")
        code, said = self.run_of_tests({**{name: 18.0 for name in entries}, "cli.short": 17.0, "house.budget_reference_1": 1.0})
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r"once more, one at a time, 3 of 31 that took long: .*cli\.short")

    def test_allows_for_starts_that_take_longer_than_what_they_compute(self):
        fast = {**ENTRIES, "house.budget_start_1": 0.2}
        self.run_of_tests(fast, "--write")
        slow = {**fast, "house.budget_start_1": 0.6, "cli.render": 20.0, "cli.fit": 40.0}  # as 1 + 0.5 * (3 - 1) = 2 allows
        code, said = self.run_of_tests(slow, "--once")
        self.assertEqual(code, 0, said)
        code, said = self.run_of_tests({**slow, "house.budget_start_1": 0.2}, "--once")
        self.assertEqual(code, 1, said)
        code, said = self.run_of_tests({**slow, "Spline": 30.0}, "--once")  # computes alone
        self.assertEqual(code, 1, said)
        self.assertIn("Spline of sim takes 30.00 references", said)


if __name__ == "__main__":
    unittest.main()
