#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""programs_test.py PROGRAM...: what the campaign's stages in C++ refuse."""
import json
import sys
import unittest
from pathlib import Path

from refusals import JOBS, SCALES, SEEDS, RefusalCase

PROGRAMS = {Path(path).name: path for path in sys.argv[1:]}
# Those whose settings come from tools/campaign.py; the option for the result.
STAGES = {"random_campaign": "--json", "error_campaign": "--json", "bittime_campaign": "--json",
          "remote_campaign": "--json", "softerror": "--out", "softerror_clock": "--json",
          "softerror_remote": "--json", "softerror_follower": "--json"}
# Variables of the environment and what is said of them.
VARIABLES = (("CAMPAIGN_SEED", "x", SEEDS), ("CAMPAIGN_SEED", "1.5", SEEDS),
             ("CAMPAIGN_SCALE", "x", SCALES), ("CAMPAIGN_SCALE", "nan", SCALES),
             ("CAMPAIGN_SCALE", "-1", SCALES), ("CAMPAIGN_SCALE", "0", SCALES),
             ("CAMPAIGN_JOBS", "x", JOBS), ("CAMPAIGN_JOBS", "0", JOBS),
             ("CAMPAIGN_JOBS", "65", JOBS))
# Options of every stage.
OPTIONS = (("--seed", "-1", SEEDS), ("--scale", "0", SCALES), ("--scale", "nan", SCALES),
           ("--jobs", "0", JOBS), ("--jobs", "65", JOBS))
# Options of one program.
AMOUNTS = "allowed: 1 to 1000000000000"
OWN = (("random_campaign", ("--frames", "0"), AMOUNTS),
       ("random_campaign", ("--frames", "-1"), AMOUNTS),
       ("random_campaign", ("--runs", "-1"), "allowed: 0 to 1000000000000"),
       ("random_campaign", ("--seed", "18446744073709551615", "--runs", "1"), SEEDS),
       ("fuzz_registers", ("--cases", "0"), AMOUNTS),
       ("fuzz_registers", ("--cases", "-1"), AMOUNTS),
       ("fuzz_registers", ("--seed", "x"), SEEDS),
       ("fuzz_registers", ("--out", "/no/such/x"), "cannot write '/no/such/x'"),
       ("fuzz_registers", ("--keep", "/no/such"), "cannot write '/no/such/registers-1.txt'"),
       ("error_campaign", ("--csv", "/no/such/x"), "cannot write '/no/such/x'"),
       ("softerror", ("--stuck", "1"), "--stuck requires --flop"),
       ("softerror", ("--time", "5000"), "--time requires --flop"),
       ("softerror", ("--wave", "/no/such/x"), "--wave requires --flop"),
       ("softerror_remote", ("--stuck", "1"), "--stuck requires --flop"),
       ("softerror_follower", ("--stuck", "1"), "--stuck requires --flop"),
       ("softerror_clock", ("--stuck", "1"), "--stuck requires --flop"))


class Programs(RefusalCase):
    """Environment and options."""

    def test_a_wrong_environment_is_named(self):
        for program in STAGES:
            for name, value, allowed in VARIABLES:
                self.refused(f"{program}: {name} is '{value}'; ", PROGRAMS[program], code=2,
                             **{name: value})
                self.refused(allowed, PROGRAMS[program], **{name: value})

    def test_a_wrong_shard_is_named(self):
        for program in ("random_campaign", "error_campaign", "softerror"):
            self.refused("CAMPAIGN_SHARD is 'x'", PROGRAMS[program], code=2, CAMPAIGN_SHARD="x")
        self.refused("CAMPAIGN_RESUME is '7'; allowed: 0 to 1", PROGRAMS["random_campaign"], code=2,
                     CAMPAIGN_RESUME="7")

    def test_a_wrong_option_is_named(self):
        for program in STAGES:
            for name, value, allowed in OPTIONS:
                if (program, name) != ("random_campaign", "--scale"):
                    self.refused(allowed, PROGRAMS[program], name, value, code=2)

    def test_options_of_one_program(self):
        for program, options, text in OWN:
            self.refused(text, PROGRAMS[program], *options, code=2)

    def test_a_result_that_cannot_be_written_is_told_before_the_work(self):
        path = self.path / "no/result"
        for program, option in STAGES.items():
            self.refused(f"{program}: cannot write '{path}'", PROGRAMS[program], option, path,
                         code=2)
            self.refused(f"{program}: cannot write '{path}'", PROGRAMS[program], code=2,
                         CAMPAIGN_OUT=str(path))

    def test_what_is_allowed_is_done(self):
        for jobs in ("1", "64"):
            code, text, said = self.run_it(
                PROGRAMS["random_campaign"], "--runs", "1", "--frames-a-run", "10", "--jobs", jobs,
                "--directory", self.path / "work", "--json", self.path / "result")
            self.assertEqual(code, 0, text + said)
            self.assertTrue(json.loads((self.path / "result").read_text())["figures"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
