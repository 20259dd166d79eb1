#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""slurm_test.py TB: the campaign on a real Slurm cluster of one node against the same on this
machine alone. TB: directory tb of the build. Exit code 77: a program of the cluster is not
installed."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from private_slurm import Impossible, PrivateSlurm

ROOT = Path(__file__).resolve().parents[2]
PLAN = ROOT / "tb/cluster/plan.yaml"
SKIPPED = 77
PATIENCE = 300  # s for one campaign, which takes 5 to 30; below the time limit of ctest
# What depends on the time that a run took.
TIMES = {"frames a second", "formal: wall time"}
TIME_COLUMNS = {"solver s"}


def figures(out, stage):
    """Figures and tables of a stage's result, those of time left out."""
    result = json.loads((out / f"{stage}.json").read_text())
    tables = []
    for table in result.get("tables", []):
        kept = [n for n, name in enumerate(table["columns"]) if name not in TIME_COLUMNS]
        tables.append([table["title"], [[row[n] for n in kept] for row in table["rows"]]])
    notes = [re.sub(r"\d+ s\b", "", note) for note in result.get("notes", [])]
    return [f for f in result["figures"] if f["name"] not in TIMES], tables, notes


class Campaigns(unittest.TestCase):
    """Each test asks for its stages in a directory of its own."""

    cluster = None
    tb = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="verican-campaign-")
        self.addCleanup(folder.cleanup)
        self.dir = Path(folder.name)

    def campaign(self, out, stages, *words, **settings):
        """Runs tools/campaign.py; returns its exit code and output."""
        environment = {**self.cluster.environment, "PROGRAMS": str(self.tb), "SEED": "5",
                       "SHARDS": "100", "RETRIES": "1", "RESUME": "0", **settings}
        try:
            done = subprocess.run(
                [sys.executable, ROOT / "tools/campaign.py", "--plan", PLAN, "--out",
                 self.dir / out, "--only", stages, *words], env=environment, cwd=self.dir,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                text=True, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired as late:
            said = (late.stdout or b"").decode(errors="replace")
            self.fail(f"no end within {PATIENCE} s\n{said}\n{self.cluster.state()}")
        return done.returncode, done.stdout

    def markers(self, out, stage):
        """{shard: what its marker says}"""
        return {int(path.stem): json.loads(path.read_text())
                for path in (self.dir / out / "slurm" / stage).glob("*.done")}

    def test_figures_equal_those_of_a_run_on_one_machine(self):
        stages = "matrix,lockstep,softerror,formal"
        code, text = self.campaign("here", stages)
        self.assertEqual(code, 0, text)
        code, text = self.campaign("there", stages, "--slurm")
        self.assertEqual(code, 0, text)
        for stage, shards in (("matrix", 4), ("lockstep", 5), ("softerror", 3), ("formal", 4)):
            with self.subTest(stage):
                self.assertEqual(set(self.markers("there", stage)), set(range(shards)))
                self.assertEqual(figures(self.dir / "there", stage),
                                 figures(self.dir / "here", stage))
        # Another seed has other figures, so that what is compared says something.
        code, text = self.campaign("other", "lockstep", SEED="6")
        self.assertEqual(code, 0, text)
        self.assertNotEqual(figures(self.dir / "other", "lockstep"),
                            figures(self.dir / "here", "lockstep"))

    def test_failed_shards_are_queued_again(self):
        code, text = self.campaign("out", "flaky", "--slurm")
        self.assertEqual(code, 0, text)
        found, _, _ = figures(self.dir / "out", "flaky")
        self.assertEqual([f["value"] for f in found], [60 * 59 // 2, 6])
        logs = self.dir / "out/slurm/flaky"
        self.assertEqual(sorted(path.name for path in logs.glob("shard-*-1.log")),
                         ["shard-1-1.log", "shard-3-1.log"])

    def test_a_shard_that_fails_for_ever_ends_its_stage_alone(self):
        code, text = self.campaign("out", "broken,single", "--slurm")
        self.assertEqual(code, 1, text)
        self.assertIn("broken: shards 2 failed 2 times", text)
        self.assertIn("broken     FAILED", text)
        self.assertFalse((self.dir / "out/broken.json").exists())
        # A stage in one piece that missed its bar is no failed shard: it has a result.
        self.assertIn("single     sum: 1,770", text)

    def test_resume_runs_only_what_is_missing(self):
        code, text = self.campaign("out", "flaky", "--slurm")
        self.assertEqual(code, 0, text)
        logs = self.dir / "out/slurm/flaky"
        before = {path.name: path.stat().st_mtime_ns for path in logs.glob("*.done")}
        (logs / "4.done").unlink()
        code, text = self.campaign("out", "flaky", "--slurm", RESUME="1")
        self.assertEqual(code, 0, text)
        after = {path.name: path.stat().st_mtime_ns for path in logs.glob("*.done")}
        self.assertEqual(set(after), set(before))
        self.assertEqual([name for name in before if before[name] != after[name]], ["4.done"])
        # With another seed nothing that is there counts.
        code, text = self.campaign("out", "flaky", "--slurm", RESUME="1", SEED="9")
        self.assertEqual(code, 0, text)
        last = {path.name: path.stat().st_mtime_ns for path in logs.glob("*.done")}
        self.assertFalse(set(last.values()) & set(after.values()))


def main():
    """Sets the cluster up, runs the tests in it, takes it down."""
    Campaigns.tb = Path(sys.argv.pop(1)).resolve()
    try:
        # More than there are, so that a shard waits for no other: most of the time is Slurm's.
        with PrivateSlurm(cpus=8) as cluster:
            Campaigns.cluster = cluster
            passed = unittest.main(exit=False, verbosity=2, failfast=True).result.wasSuccessful()
    except Impossible as reason:
        print(f"skipped: {reason}")
        sys.exit(SKIPPED)
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
