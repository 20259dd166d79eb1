# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# external: what the programs of examples/external must print, whoever built them.
import shutil

import tree


def copy_project(installed, name):
    """A copy of the installed example."""
    work = installed.work(name)
    shutil.copytree(installed.prefix / "share" / "verican" / "examples" / "external",
                    work / "project")
    return work / "project"


def frames(text):
    """The frames of a candump log, in its order."""
    return [line.split()[2] for line in text.splitlines() if line.startswith("(")]


def check_programs(installed, where):
    """Runs the programs of directory `where`: what they send is in their sources, and what must
    arrive follows from the rules of CAN."""
    def run(name):
        return installed.run([where / name], where)

    # The sensor's base frame wins arbitration against the remote frame; then comes the answer.
    said = run("two_nodes")
    tree.check(frames(said) == ["123#CAFE", "18DAF110#R2", "18DAF110#0117"] and
               "display: 2 received, 1 sent; bus: 3 frames, 0 error frames" in said,
               f"two_nodes: unexpected output\n{said}")
    # 8 MHz: 16 clocks a bit; 87.5 % is exact with 16 quanta.
    said = run("bit_timing")
    tree.check("500000 bit/s: prescaler 1, 16 quanta, sample point 875 per mille" in said,
               f"bit_timing: unexpected output\n{said}")
    said = run("driver_node")
    answers = [line for line in said.splitlines() if line.startswith("answer")]
    tree.check(answers == ["answer 201#EC00", "answer 201#EC01", "answer 201#EC02"] and
               "driver: 3 answers; partner: 3 sent, 3 received" in said,
               f"driver_node: unexpected output\n{said}")
    if installed.has_systemc():
        # Eight frames each way, whole and in order: else it ends with 1.
        said = run("platform")
        tree.check(said.count("sent 8, received 8") == 2, f"platform: unexpected output\n{said}")
