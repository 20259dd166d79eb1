# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The robot of examples/robot: host, six joints, two sensors on nine RTL nodes."""
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from canopen_run import FIRMWARE, needs_stack

SECONDS = 1  # of the bus; the campaign has ten minutes
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ROBOT = ROOT / "examples/robot"
PAGE = ROOT / "docs/canopen.md"
sys.path.insert(0, str(ROBOT))
# Only without the package of this build is there nothing to run, and CI has it; whatever else the
# example cannot import is its mistake.
RUNS = importlib.util.find_spec("verican") or os.environ.get("CI") == "true"
if RUNS:
    import plan
    from measure import Measure
    from robot import Joint, Robot
needs_package = unittest.skipUnless(RUNS, "the Python package verican is not built")


def run(*options, **environment):
    """The example as its user runs it."""
    return subprocess.run([sys.executable, "-B", str(ROBOT / "robot.py"), *options], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                          env={**os.environ, **environment})


def largest_on_the_page():
    """The column of that name in the page's table, by names of messages."""
    rows = re.findall(r"^  [0-9A-F]{3} (\S.*?) +\d+(?: +[\d.]+){2} +([\d.]+) +[\d.]+$",
                      PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    return {name: float(largest) for name, largest in rows}


@needs_package
class CanopenRobot(unittest.TestCase):
    """All of it in simulated time."""

    def test_no_pdo_is_lost(self):
        done = run("--seconds", str(SECONDS), "--json")
        self.assertEqual(done.returncode, 0, done.stdout)
        figures = json.loads(done.stdout)
        self.assertEqual([figures[key] for key in ("syncs", "lost", "error_frames")],
                         [1000 * SECONDS, 0, 0])
        # SYNC, two frames of set points, eight TPDOs a cycle; the rest is SDO and heartbeats.
        self.assertGreaterEqual(figures["frames"], 11 * 1000 * SECONDS)
        self.assertGreater(figures["uploads"], 4 * SECONDS)
        self.assertTrue(all(check["ok"] for check in figures["checks"]), figures["checks"])
        self.assertEqual({name: round(us, 1) for name, us in figures["largest_us"].items()},
                         largest_on_the_page(),
                         "docs/canopen.md has not what robot.py --seconds 1 prints now")

    def test_a_joint_fails_and_comes_back(self):
        done = run("--seconds", "0.2", "--fail")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("FAIL", done.stdout)
        self.assertIn("EMCY 8140 of node 3", done.stdout)

    def test_the_same_again(self):
        first, again, other = (run("--seconds", "0.1", "--json", "--seed", seed).stdout
                               for seed in "112")
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_bad_input(self):
        done = run("--seconds", "0")
        self.assertEqual(done.returncode, 2)
        self.assertIn("allowed are 0.1 to 3600", done.stdout)
        done = run(PYTHONPATH="/nonexistent")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("docs/python.md", done.stdout)


    def test_outputs_that_cannot_be_written(self):
        for page, said in (("/nonexistent/x.html", "cannot be opened"), ("/dev/full", "No space")):
            done = run("--seconds", "0.1", "--report", page)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertNotIn("Traceback", done.stdout)
            self.assertRegex(done.stdout, rf"(?m)^robot.py: {page}: .*{said}")
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([sys.executable, "-B", str(ROBOT / "robot.py"), "--seconds",
                                   "0.1"], stdout=full, stderr=subprocess.PIPE, text=True,
                                  check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)


@needs_package
class CanopenRobotMeasure(unittest.TestCase):
    """What the measurement is there to notice, it notices."""

    @staticmethod
    def failed(robot):
        """Checks that do not hold, after a tenth of a second."""
        measure = Measure(robot)
        measure.run()
        return [what for what, right, _ in measure.checks() if not right]

    def test_all_is_well(self):
        self.assertEqual(self.failed(Robot(0.1)), [])

    def test_a_lost_pdo(self):
        robot = Robot(0.1)
        joint, sync = robot.joints[3], robot.joints[3].on_sync
        joint.on_sync = lambda event: event < 0.07 and sync(event)
        self.assertEqual(self.failed(robot), ["PDOs that a SYNC did not bring before the next"])

    def test_a_pdo_that_is_sent_twice(self):
        robot = Robot(0.1)
        joint, sync = robot.joints[3], robot.joints[3].on_sync
        joint.on_sync = lambda event: (sync(event), event > 0.115 and sync(event))
        self.assertIn("frames twice, or of nobody", self.failed(robot))

    def test_a_device_that_is_slower_than_it_said(self):
        robot = Robot(0.1)
        robot.joints[0].reaction = lambda: plan.REACTION[1] + 600e-6
        self.assertIn("responses above their bound", self.failed(robot))

    def test_an_upload_that_is_wrong(self):
        robot = Robot(0.1)
        robot.joints[0].objects[0x2001, 0] = b"something else"
        self.assertEqual(self.failed(robot), ["uploads by SDO, all right"])

    def test_an_error_on_the_bus(self):
        robot = Robot(0.1)
        robot.at(0.05, lambda: robot.bus.disturb("dominant", robot.bus.now, 10e-6))
        self.assertIn("error frames", self.failed(robot))

    def test_a_joint_follows_its_set_points(self):
        robot = Robot(0.1)
        Measure(robot).run()
        for joint in robot.joints:
            self.assertIsInstance(joint, Joint)
            # The last set points but one: those of the last cycle wait for a SYNC.
            cycle = robot.host.cycles - 2
            self.assertEqual(joint.target, (cycle * (3 + joint.number - 1)) % 2000 - 1000)


@needs_stack
class CanopenRobotFirmware(unittest.TestCase):
    """Eight drives of CANopenNode on a bus."""

    def robot(self, *options):
        """The example with firmware: what it prints."""
        done = subprocess.run(
            [sys.executable, "-B", str(ROBOT / "firmware.py"), f"{FIRMWARE}-32", "--verican",
             os.environ["VERICAN_BINARY"], "--seconds", "0.1", *options], text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("FAIL", done.stdout)

    def test_no_pdo_is_lost_or_late(self):
        self.robot()

    def test_a_joint_fails_and_comes_back(self):
        self.robot("--fail")


if __name__ == "__main__":
    unittest.main()
