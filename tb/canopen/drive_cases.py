# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""CANopenNode on the C driver, Cortex-M3 and a Verilated core; the master is npm's canopen."""
import tempfile
import unittest

from canopen_run import drive, live, needs_stack, program, program_node, scenario, simulate

SYNCS = 10_000


@needs_stack
class CanopenDrive(unittest.TestCase):
    """A drive and a master."""

    def checks(self, script, group, number=1):
        """All checks of a group must be ok."""
        with tempfile.TemporaryDirectory() as folder:
            file = scenario(folder, nodes=[drive(number), program_node()])
            with live(file) as port:
                code, text = program(script, port, number, group)
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"\d+ checks, 0 failed")

    def test_sdo_transfers(self):
        self.checks("sdo_checks.mjs", "transfers")

    def test_sdo_refusals(self):
        self.checks("sdo_checks.mjs", "refusals")

    def test_sdo_states(self):
        self.checks("sdo_checks.mjs", "states")

    def test_network_management(self):
        self.checks("node_checks.mjs", "network")

    def test_process_data(self):
        self.checks("node_checks.mjs", "pdo")

    def test_emergency(self):
        self.checks("node_checks.mjs", "emergency")

    def test_layer_setting(self):
        self.checks("node_checks.mjs", "lss", 255)

    def test_no_pdo_is_lost_in_ten_seconds(self):
        """SYNC and a set point each millisecond: a TPDO for each, and nothing else goes wrong."""
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(cycles(folder, SYNCS), (SYNCS, 0, True))


def cycles(folder, count):
    """SYNC and a set point `count` times, a millisecond apart: SYNCs, TPDOs that were not there
    before the next SYNC, and whether nothing else went wrong."""
    start = 20
    send = {"node": "master", "offset": f"{start + 5} ms", "period": "1 ms", "count": count}
    file = scenario(
        folder, duration=f"{start + 5 + count} ms",
        nodes=[drive(1), {"name": "master", "clock": "8 MHz"}],
        traffic=[{"node": "master", "name": "start", "id": 0, "data": "01 00",
                  "offset": f"{start} ms", "count": 1},
                 {**send, "name": "sync", "id": 0x80},
                 {**send, "name": "set point", "id": 0x201, "data": "0F 00 64 00 00 00"}],
        expect={"error_frames": 0, "pending": 0, "nodes": {"drive1": {"rec": 0, "tec": 0}}})
    code, _ = simulate(file, "--candump", f"{folder}/log")
    with open(f"{folder}/log", encoding="ascii") as log:
        ids = [line.split()[2].split("#")[0] for line in log]
    right = code == 0 and ids.count("201") == ids.count("181") == count and "081" not in ids
    return ids.count("080"), lost(ids), right


def lost(ids):
    """SYNCs that had no TPDO before the next."""
    between, missing = 1, 0
    for i in ids:
        if i == "080":
            missing += between != 1
            between = 0
        between += i == "181"
    return missing + (between != 1)


if __name__ == "__main__":
    unittest.main()
