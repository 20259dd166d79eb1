#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign's own words: what it says of figures that are there, or are not, and of options."""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
import campaign  # pylint: disable=wrong-import-position

STAGE = {"name": "formal", "title": "t", "summary": "{proven} proven, {bounded} to a bound"}


def result(scale, *figures, ok=True):
    return {"scale": scale, "status": 0,
            "figures": [{"name": name, "value": 7, "text": text, "bar": "all", "ok": ok}
                        for name, text in figures]}


def printed(function, *arguments):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        value = function(*arguments)
    return value, text.getvalue()


class Summary(unittest.TestCase):
    """The line of a stage at the head of the page."""

    def test_whole(self):
        found = result(1, ("proven", "3 of 3"), ("bounded", "1 of 1 (z3)"))
        self.assertEqual(campaign.summary(STAGE, found), "3 of 3 proven, 1 of 1 to a bound")

    def test_a_part_may_leave_a_figure_out(self):
        found = result(0.01, ("proven", "3 of 3"))
        self.assertEqual(campaign.summary(STAGE, found), "3 of 3 proven, none to a bound")

    def test_the_whole_may_not(self):
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            with self.assertRaises(SystemExit) as stop:
                campaign.summary(STAGE, result(1, ("proven", "3 of 3")))
        self.assertIn("stage formal has no figure 'bounded'; figures: proven", str(stop.exception))


class Page(unittest.TestCase):
    """docs/verification.md, where a campaign of hours writes what it found."""

    def test_each_stage_has_its_places(self):
        stages = campaign.yaml.safe_load(campaign.PLAN.read_text(encoding="utf-8"))["stages"]
        text = campaign.PAGE.read_text(encoding="utf-8")
        for stage in stages:
            self.assertEqual(text.count(f"<!-- summary {stage['name']} -->"), 1, stage["name"])

    def test_the_page_of_clusters_has_each_stage(self):
        """With the number of its shards, one for those that are not cut."""
        stages = campaign.yaml.safe_load(campaign.PLAN.read_text(encoding="utf-8"))["stages"]
        text = (TOOLS.parent / "docs/cluster.md").read_text(encoding="utf-8")
        table = re.search(r"\| shards at most \|\n.*\n((?:\|.*\n)+)", text)[1]
        said = {}
        for line in table.splitlines():
            names, _, shards = (cell.strip().split(", ") for cell in line.split("|")[1:-1])
            said.update(zip(names, shards * (len(names) if len(shards) == 1 else 1)))
        self.assertEqual(said, {stage["name"]: str(stage.get("shards", 1)) for stage in stages})


class Settings(unittest.TestCase):
    """The environment of `make campaign`."""

    def test_as_many_jobs_as_the_programs_take(self):
        with unittest.mock.patch.dict(os.environ, {"JOBS": "64"}):
            self.assertEqual(campaign.settings()["jobs"], 64)
        for jobs in ("0", "65", "x"):
            with unittest.mock.patch.dict(os.environ, {"JOBS": jobs}):
                with self.assertRaises(SystemExit) as stop:
                    campaign.settings()
            self.assertIn(f"JOBS is '{jobs}'; allowed: 1 to 64", str(stop.exception))


class Report(unittest.TestCase):
    """What is printed at the end."""

    FIGURES = (("proven", "3 of 3"), ("bounded", "1 of 1"))

    def test_met_and_missed(self):
        for ok, word in ((True, "met"), (False, "MISSED")):
            found = {"formal": result(1, *self.FIGURES, ok=ok)}
            good, text = printed(campaign.report, [STAGE], found)
            self.assertEqual(good, ok)
            self.assertIn(f"proven: 3 of 3  (bar: all: {word})", text)

    def test_a_bar_that_a_part_cannot_meet(self):
        found = {"formal": result(0.5, *self.FIGURES, ok=None)}
        good, text = printed(campaign.report, [STAGE], found)
        self.assertTrue(good)
        self.assertIn("(bar: all: not for a part of the campaign)", text)

    def test_a_stage_that_failed(self):
        good, text = printed(campaign.report, [STAGE], {"formal": None})
        self.assertFalse(good)
        self.assertIn("formal     FAILED", text)


class Pages(unittest.TestCase):
    """What is written of a stage: all figures on a page of its own, one line in the report."""

    ABOUT = {"stage": "formal", "seed": 5, "commit": "abc", "date": "2026-01-02", "seconds": 61,
             "cpus": 2, "versions": {"Yosys": "9"}}

    def written(self, scale):
        """The report and the stage's page, "" if there is none, after a run of that scale."""
        with tempfile.TemporaryDirectory() as name:
            place = Path(name)
            found = self.ABOUT | result(scale, ("proven", "3 of 3"), ("bounded", "1 of 1"))
            found["tables"] = [{"title": "T", "columns": ["a"], "rows": [["x|y"]]}]
            (place / "formal.json").write_text(json.dumps(found))
            report = place / "report.md"
            report.write_text("| <!-- summary formal -->old<!-- end --> |\n"
                              "<!-- tools --><!-- end tools -->\n")
            pages = {"OUT": place, "PAGE": report, "STAGE_PAGES": place / "pages"}
            with unittest.mock.patch.multiple(campaign, **pages):
                campaign.write_page([STAGE])
            page = place / "pages/formal.md"
            return report.read_text(), page.read_text() if page.exists() else ""

    def test_whole(self):
        report, page = self.written(1)
        origin = ("`make campaign STAGES=formal SEED=5`, commit abc, 2026-01-02, 1 min 1 s on "
                  "2 cores.")
        self.assertIn("3 of 3 proven, 1 of 1 to a bound; [abc, 2026-01-02](campaign/formal.md)",
                      report)
        self.assertIn("Yosys 9.", report)
        self.assertNotIn("old", report)
        self.assertIn(origin, page)
        self.assertIn("| proven | 3 of 3 | all | met |", page)
        self.assertIn("| x\\|y |", page)

    def test_a_part_changes_nothing(self):
        report, page = self.written(0.5)
        self.assertEqual(report.count("old"), 1)
        self.assertEqual(page, "")


class Options(unittest.TestCase):
    """Mistakes get one line that says what is allowed."""

    def check(self, said, *arguments, **environment):
        run = subprocess.run([TOOLS / "campaign.py", *arguments], capture_output=True, text=True,
                             env={**os.environ, **environment}, check=False)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn(said, run.stdout + run.stderr)

    def test_stage(self):
        self.check("there is no stage 'formula'; stages: matrix, lockstep", "--only", "formula")

    def test_scale(self):
        self.check("allowed: above 0 up to 1", "--only", "formal", SCALE="2")

    def test_seed(self):
        self.check("allowed: 0 to 2147483647", "--only", "formal", SEED="one")


if __name__ == "__main__":
    unittest.main()
