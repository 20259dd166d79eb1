#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the campaign's stages in Python refuse, how the stage `fuzz` ends, and what the stages
`features` and `buffers` count."""
import contextlib
import importlib.util
import io
import os
import sys
import unittest
import unittest.mock
from pathlib import Path

import yaml

from refusals import JOBS, SCALES, SEEDS, RefusalCase

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ("tb/formal/run.py", "tb/netlist/run.py", "tb/fuzz/campaign.py", "tb/canopen/campaign.py",
           "tb/timesync/campaign.py", "tb/mutation/run.py", "tools/coverage.py",
           "tb/features/run.py", "tb/mailbox/campaign.py", "tb/formal/in_core.py")


def module_of(name, path):
    """A script of the project as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Scripts(RefusalCase):
    """Environment and options."""

    def test_a_wrong_environment_is_named(self):
        for script in SCRIPTS:
            for name, value in (("CAMPAIGN_SCALE", "x"), ("CAMPAIGN_SCALE", "nan"),
                                ("CAMPAIGN_SCALE", "0")):
                self.refused(f"{name} is '{value}'; allowed: {SCALES}", sys.executable, "-B",
                             ROOT / script, code=2, **{name: value})
        for script in ("tb/netlist/run.py", "tb/fuzz/campaign.py", "tb/mutation/run.py",
                       "tb/mailbox/campaign.py"):
            for value in ("x", "0", "65", "1_0"):
                self.refused(f"CAMPAIGN_JOBS is '{value}'; allowed: {JOBS}", sys.executable, "-B",
                             ROOT / script, code=2, CAMPAIGN_JOBS=value)
        for script in ("tb/fuzz/campaign.py", "tb/timesync/campaign.py", "tb/mutation/run.py",
                       "tb/mailbox/campaign.py"):
            self.refused("CAMPAIGN_SEED is '1.5'; " + SEEDS, sys.executable, "-B", ROOT / script,
                         code=2, CAMPAIGN_SEED="1.5")

    def test_a_result_that_cannot_be_written_is_told_before_the_work(self):
        for script in SCRIPTS + ("tb/mutation/driver.py",):
            self.refused("cannot write '/no/such/x'", sys.executable, "-B", ROOT / script, code=2,
                         CAMPAIGN_OUT="/no/such/x")

    def test_coverage_takes_away_nothing_but_its_own(self):
        """In the folder for its counts."""
        with unittest.mock.patch.object(sys, "path", [str(ROOT / "tools"), *sys.path]):
            coverage = module_of("coverage", "tools/coverage.py")
        for name in ("letter.txt", "program.dat", "program.dat.gz", "program.log"):
            (self.path / name).touch()
        with self.assertRaisesRegex(coverage.points.CoverageError, "letter.txt is not of a run"):
            coverage.clear(str(self.path))
        self.assertEqual(len(list(self.path.iterdir())), 4)
        (self.path / "letter.txt").unlink()
        coverage.clear(str(self.path))
        self.assertEqual(list(self.path.iterdir()), [])

    def test_a_parser_that_there_is_not_is_told_before_the_build(self):
        self.refused("no parser 'nosuch'; there are board, can_frame,", sys.executable, "-B",
                     ROOT / "tb/fuzz/campaign.py", "--only", "pcap", "nosuch", code=2)


class Fuzz(RefusalCase):
    """The exit code of the stage `fuzz`."""

    def status(self, cases=1_000_000, findings=0, failed=0):
        """That of a stage of one parser and the registers, with these results."""
        fuzz = module_of("fuzz", "tb/fuzz/campaign.py")
        parser = {"name": "log", "cases": cases, "seconds": 1, "edges": 1, "features": 1,
                  "corpus": 1, "findings": findings}
        registers = {"cases": 1_000_000, "episodes": 1, "failed": failed, "clocks": 1,
                     "bus_frames": 1, "excused_errors": 0, "max_waits": 1,
                     "longest_acknowledge": 1, "modes": {}}
        results = [["log", parser], [0, registers]]
        with unittest.mock.patch.multiple(fuzz, build=lambda _: None,
                                          run_all=lambda *_: results), \
                unittest.mock.patch.object(sys, "argv", ["campaign.py"]), \
                unittest.mock.patch.dict(os.environ, {"CAMPAIGN_DIR": str(self.path)}), \
                contextlib.redirect_stdout(io.StringIO()):
            return fuzz.main()

    def test_it_tells_findings_and_missed_bars(self):
        self.assertEqual(self.status(), 0)
        self.assertEqual(self.status(cases=999_999), 1)
        self.assertEqual(self.status(findings=1), 1)
        self.assertEqual(self.status(failed=1), 1)


class Features(RefusalCase):
    """The stage `features`."""

    def setUp(self):
        super().setUp()
        self.features = module_of("features", "tb/features/run.py")

    def test_it_knows_every_build_and_has_its_programs_built(self):
        self.assertEqual(list(self.features.NEEDS), self.features.single_builds())
        programs = {program for build in (*self.features.NEEDS, *self.features.PROFILES)
                    for program in self.features.filters(build)}
        stages = yaml.safe_load((ROOT / "tb/campaign.yaml").read_text(encoding="utf-8"))["stages"]
        stage = next(stage for stage in stages if stage["name"] == "features")
        self.assertEqual(set(stage["targets"]), programs)

    def counts(self, build, lines, code=0, scale=1.0):
        """What a program counts that says these lines and ends with this code."""
        program = self.path / "program"
        program.write_text(f"#!/bin/sh\nprintf '{lines}'\nexit {code}\n")
        program.chmod(0o755)
        with unittest.mock.patch.object(self.features, "BINARIES", self.path), \
                contextlib.redirect_stdout(io.StringIO()):
            return self.features.run(build, 0, "program", "*", scale, self.path)

    def test_tests_on_another_core_or_none_are_failures(self):
        passed = "[  PASSED  ] 3 tests.\\n"
        self.assertEqual(self.counts("no_fifo", "on no_fifo\\n" + passed), (3, 0))
        self.assertEqual(self.counts("no_fifo", passed), (3, 1))
        self.assertEqual(self.counts("no_fifo", "on no_abort\\n" + passed), (3, 1))
        self.assertEqual(self.counts("no_fifo", "on no_fifo\\n[  PASSED  ] 0 tests.\\n"), (0, 1))
        self.assertEqual(self.counts("no_fifo", "[  PASSED  ] 0 tests.\\n", scale=0.01), (0, 0))
        self.assertEqual(self.counts("no_fifo", "on no_fifo\\n" + passed + " 2 FAILED TESTS\\n", 1),
                         (3, 2))
        self.assertEqual(self.counts("small", passed), (3, 0))
        self.assertEqual(self.counts("small", passed, 139), (3, 1))


class Buffers(RefusalCase):
    """The stage `buffers`."""

    def setUp(self):
        super().setUp()
        self.buffers = module_of("buffers", "tb/mailbox/campaign.py")

    def run_block(self, lines, code=0, block=("Random", 100_000, 3)):
        """What comes of a block whose program does these lines and ends with this code."""
        program = self.path / "program"
        program.write_text(f"#!/bin/sh\n{lines}\nexit {code}\n")
        program.chmod(0o755)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            result = self.buffers.run(block, program, self.path)
        return (result["passed"], result["failed"]), said.getvalue()

    def test_a_block_is_asked_for_by_its_seeds(self):
        self.assertEqual(self.run_block(
            "test $VERICAN_RANDOM_SEEDS = 100000+3 || exit 1\n"
            "test $1 = '--gtest_filter=Seeds/Random.Lockstep/*' || exit 1\n"
            "echo '[  PASSED  ] 3 tests.'"), ((3, []), ""))
        self.assertEqual([path.name for path in self.path.iterdir()], ["program"])

    def test_what_fails_is_named_with_the_line_that_repeats_it(self):
        result, said = self.run_block(
            "echo '[  PASSED  ] 2 tests.'\n"
            "echo '[  FAILED  ] Seeds/Random.Lockstep/1, where GetParam() = 100001'\n"
            "echo ' 1 FAILED TEST'", 1)
        self.assertEqual(result, (2, ["100001"]))
        self.assertIn("VERICAN_RANDOM_SEEDS=100001+1", said)

    def test_fewer_seeds_a_crash_and_a_hang_are_failures(self):
        whole = ["100000 to 100002"]
        self.assertEqual(self.run_block("echo '[  PASSED  ] 2 tests.'")[0], (2, whole))
        self.assertEqual(self.run_block("echo '[  PASSED  ] 3 tests.'", 139)[0], (3, whole))
        with unittest.mock.patch.object(self.buffers, "TIMEOUT", 0.2):
            self.assertEqual(self.run_block("exec sleep 20")[0], (0, whole))

    def test_blocks_have_every_seed_once_and_none_of_make_test(self):
        wanted = sum(seeds for seeds, _ in self.buffers.SUITES.values())
        for seed in (0, 1, 3_999):
            seeds = [(suite, first + i) for suite, first, count in self.buffers.blocks(seed, 1)
                     for i in range(count)]
            self.assertEqual(len(set(seeds)), wanted)
            self.assertGreaterEqual(min(number for _, number in seeds), 100_000)
            self.assertLess(max(number for _, number in seeds), 2**32)

    def test_one_failure_misses_the_bar(self):
        good = [{"suite": "Random", "passed": 3, "failed": []}]
        bad = good + [{"suite": "Random", "passed": 2, "failed": ["100001"]}]
        self.assertEqual([figure["ok"] for figure in self.buffers.summary(good, 3)["figures"]],
                         [True, True])
        self.assertEqual([figure["ok"] for figure in self.buffers.summary(bad, 6)["figures"]],
                         [False, False])


if __name__ == "__main__":
    unittest.main()
