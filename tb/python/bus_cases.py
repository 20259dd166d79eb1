# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The package verican: buses of RTL nodes as Python objects. Expected values: can-rules.md."""
import os
import tempfile
import unittest
from pathlib import Path

import verican
from verican import Bus, Frame, InputError, response_times


def heard(bus, node):
    """The frames of others that the node has received."""
    return [(m.id, m.data) for m in bus.receive(node) if not m.error and not m.echo]


def in_a_child(work):
    """The status with which a process ends that is forked and calls work(): 0 if nothing fails."""
    child = os.fork()
    if child == 0:
        status = 1
        try:
            work()
            status = 0
        finally:
            os._exit(status)  # pylint: disable=protected-access
    return os.waitpid(child, 0)[1]


def frame_length(identifier, data):
    """Bits from SOF to EOF7 of a data frame with 11 bits: FF-01 to FF-12, CR-01, ST-01."""
    bits = f"0{identifier:011b}000{len(data):04b}" + "".join(f"{byte:08b}" for byte in data)
    crc = 0
    for bit in bits:
        crc = (crc << 1) ^ (0x4599 if int(bit) ^ (crc >> 14) else 0) & 0x7FFF
        crc &= 0x7FFF
    run, last, stuffed = 0, "", 0
    for bit in bits + f"{crc:015b}":
        run, last = (run + 1, last) if bit == last else (1, bit)
        if run == 5:
            stuffed += 1
            run, last = 1, "1" if bit == "0" else "0"
    return len(bits) + 15 + stuffed + 10


class PythonBus(unittest.TestCase):
    def test_two_nodes_exchange_frames(self):
        bus = Bus(["a", "b"], bitrate=500e3)
        bus.send("a", Frame(0x123, b"\x01\x02"))
        bus.send("b", Frame(0x1ABCDEF0, b"12345678", extended=True))
        self.assertTrue(bus.run_until_quiet())
        self.assertEqual(heard(bus, "b"), [(0x123, b"\x01\x02")])
        self.assertEqual(heard(bus, "a"), [(0x1ABCDEF0, b"12345678")])
        self.assertEqual(bus.pending("a"), 0)
        self.assertEqual([(sender, frame.id) for _, _, sender, frame in bus.frames()],
                         [("a", 0x123), ("b", 0x1ABCDEF0)])

    def test_own_frames_come_back_as_echoes(self):
        bus = Bus(["a", "b"])
        bus.send("a", Frame(0x55, remote=True, dlc=3))
        bus.run_until_quiet()
        message, = bus.receive("a")
        self.assertTrue(message.echo and message.remote)
        self.assertEqual((message.id, message.dlc, message.data), (0x55, 3, b""))

    def test_the_lowest_identifier_goes_first(self):
        # AR-01: nodes that begin together; dominant (0) wins.
        bus = Bus(["a", "b", "c", "listener"])
        for node, identifier in (("a", 0x300), ("b", 0x100), ("c", 0x200)):
            bus.send(node, Frame(identifier))
        self.assertTrue(bus.run_until_quiet())
        self.assertEqual([id for id, _ in heard(bus, "listener")], [0x100, 0x200, 0x300])

    def test_alone_nobody_acknowledges(self):
        # FC-05: TEC + 8 for each try; an error passive transmitter that only misses its
        # acknowledge stays at 128 (exception 1) and never goes bus-off.
        bus = Bus(["a"])
        bus.send("a", Frame(0x1))
        self.assertFalse(bus.run_until_quiet(0.05))
        self.assertEqual(bus.pending("a"), 1)
        self.assertEqual((bus.state("a").tec, bus.state("a").state), (128, "passive"))
        acknowledge = 0x20  # CAN_ERR_ACK
        self.assertTrue(any(m.error and m.id & acknowledge for m in bus.receive("a")))

    def test_length_of_a_frame_in_bits(self):
        bus = Bus(["a", "b"], bitrate=250e3)
        for identifier, data in ((0x555, b""), (0x000, b"\0\0\0\0"), (0x7A5, b"\xFF" * 8)):
            bus.send("a", Frame(identifier, data))
            bus.run_until_quiet()
            (start, end, _, _), = bus.frames()
            # Less than a quantum is where edges lie between two quanta.
            self.assertAlmostEqual((end - start) / bus.bit_time, frame_length(identifier, data),
                                   delta=0.13)

    def test_a_step_is_as_long_as_told(self):
        bus = Bus(["a", "b"], bitrate=500e3)
        start = bus.now
        bus.step(bits=100)
        self.assertAlmostEqual(bus.now - start, 200e-6, delta=0.2e-6)
        bus.step(seconds=1e-3)
        self.assertAlmostEqual(bus.now - start, 1.2e-3, delta=0.2e-6)

    def test_time_that_passes_on_an_idle_bus(self):
        bus = Bus(["a", "b"])
        start = bus.now
        bus.pass_time(10.0)
        self.assertAlmostEqual(bus.now - start, 10, delta=1e-6)
        bus.send("a", Frame(0x11))
        bus.pass_time(1e-3)
        self.assertEqual(heard(bus, "b"), [(0x11, b"")])

    def test_disturbed_receivers_raise_errors_and_the_frame_is_repeated(self):
        bus = Bus(["a", "b"])
        bus.send("a", Frame(0x0F0, b"\xAA"))
        # Six dominant bits somewhere in the frame break the stuff rule (ST-04).
        bus.disturb("dominant", bus.now + 30 * bus.bit_time, 6 * bus.bit_time)
        self.assertTrue(bus.run_until_quiet())
        self.assertEqual(heard(bus, "b"), [(0x0F0, b"\xAA")])
        self.assertEqual(bus.state("a").tec, 7)  # + 8 for the error, - 1 for the frame

    def test_stuck_bus_leads_to_bus_off_and_restart_ends_it(self):
        bus = Bus(["a", "b"])
        bus.send("a", Frame(0x7))
        bus.disturb("recessive", bus.now, 0.02, node="a")  # it never sees its own bits
        bus.step(seconds=0.02)
        self.assertEqual(bus.state("a").state, "bus-off")
        bus.restart("a")
        self.assertTrue(bus.run_until_quiet())
        self.assertEqual((bus.state("a").state, bus.state("a").tec), ("active", 0))

    def test_a_scenario_file_gives_nodes_and_traffic(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bus.yaml"
            path.write_text("bitrate: 250000\nduration: 10 ms\nnodes: [{name: engine}]\ntraffic:\n"
                            "  - {node: engine, id: 0x42, data: [1, 2], period: 1 ms}\n")
            bus = Bus(["probe"], scenario=str(path))
            bus.step(seconds=4.5e-3)
            self.assertEqual(heard(bus, "probe"), 5 * [(0x42, b"\x01\x02")])

    def test_raw_dlc_of_messages(self):
        # FF-08: 9 to 15 mean eight bytes, and travel as they are.
        bus = Bus(["a", "b"])
        for code in range(16):
            bus.send("a", Frame(0x100, bytes(min(code, 8)), dlc=code))
        bus.run_until_quiet()
        for node in bus.nodes:
            self.assertEqual([m.dlc for m in bus.receive(node)], list(range(16)))

    def test_a_waveform_on_demand(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bus.vcd"
            bus = Bus(["a", "b"], vcd=str(path))
            bus.send("a", Frame(0x1))
            bus.run_until_quiet()
            bus.finish()
            self.assertIn("$enddefinitions", path.read_text())


    def test_the_waveform_is_of_the_process_that_opened_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bus.vcd"
            bus = Bus(["a", "b"], vcd=str(path))
            bus.step(bits=100)  # the file has not got all of it yet

            def use():
                nonlocal bus
                with self.assertRaisesRegex(RuntimeError, "process"):
                    bus.step(bits=1)
                with self.assertRaisesRegex(RuntimeError, "process"):
                    bus.finish()
                del bus
            self.assertEqual(in_a_child(use), 0)
            bus.step(bits=100)
            bus.finish()
            self.assertEqual(path.read_text().count("$enddefinitions"), 1)

    def test_a_bus_without_files_goes_on_in_a_process_that_is_forked(self):
        bus = Bus(["a", "b"])

        def use():
            bus.send("a", Frame(0x1))
            bus.run_until_quiet()
            self.assertEqual(heard(bus, "b"), [(0x1, b"")])
        self.assertEqual(in_a_child(use), 0)
        self.assertEqual(heard(bus, "b"), [])


class PythonRefusal(unittest.TestCase):
    """Bad input is refused with what is allowed."""

    def refused(self, text, call):
        with self.assertRaisesRegex(ValueError, text):
            call()

    def test_frames_that_cannot_be(self):
        self.refused("7FF|2047", lambda: Frame(0x800))
        self.refused("0 to 8 bytes", lambda: Frame(1, b"123456789"))
        self.refused("DLC of 2", lambda: Frame(1, b"1", dlc=2))
        for number in (-1, 1 << 29, 1 << 32, 1 << 80):
            self.refused(f"{number}: 0 to 536870911", lambda n=number: Frame(n, extended=True))
            self.refused(f"{number}: 0 to 15", lambda n=number: Frame(1, dlc=n))

    def test_nodes_rates_and_times_that_cannot_be(self):
        bus = Bus(["a"])
        self.refused("no node 'x'.*a", lambda: bus.send("x", Frame(1)))
        for rate in (0, 2e6):
            self.refused("1000 to 1000000", lambda rate=rate: Bus(["a"], bitrate=rate))
        self.refused("flip, dominant or recessive",
                     lambda: bus.disturb("loud", 0, 1))
        self.refused("0 to 1000000 s", lambda: bus.step(seconds=-1))

    def test_nodes_that_are_none_or_the_same(self):
        self.refused("no node is given; allowed: 1 to 64", lambda: Bus([]))
        for name in ("", "all"):  # would stand for all of them
            self.refused(f"node name '{name}': other names", lambda name=name: Bus([name, "b"]))
        self.refused("control character", lambda: Bus(["a\nb", "b"]))
        self.refused("node name 'a' is used twice", lambda: Bus(["a", "b", "a"]))
        self.assertEqual(Bus([], scenario={"nodes": [{"name": "x"}]}).nodes, ["x"])

    def test_nothing_happens_after_the_end(self):
        bus = Bus(["a", "b"])
        bus.send("a", Frame(0x1))
        bus.run_until_quiet()
        bus.finish()
        self.assertEqual(bus.state("a").state, "active")
        for call in (lambda: bus.send("a", Frame(0x2)), lambda: bus.step(1e-3),
                     lambda: bus.pass_time(1e-3), bus.run_until_quiet,
                     lambda: bus.run_until_message(1e-3), lambda: bus.restart("a"),
                     lambda: bus.disturb("flip", bus.now, 1e-3)):
            with self.assertRaisesRegex(RuntimeError, "finish"):
                call()
        self.assertEqual(heard(bus, "b"), [(0x1, b"")])  # what was there can still be read
        self.assertEqual(len(bus.frames()), 1)

    def test_time_has_an_end(self):
        # 2^63 ps are 9.2e6 s.
        bus = Bus(["a", "b"], restart=1e6)
        for _ in range(7):
            bus.pass_time(1e6)
        bus.pass_time(999_999)
        for call in (lambda: bus.step(seconds=2), lambda: bus.step(bits=1_000_000_000),
                     lambda: bus.pass_time(1e6), lambda: bus.run_until_quiet(2),
                     lambda: bus.run_until_message(2), lambda: bus.disturb("flip", bus.now, 2)):
            self.refused("behind 8000000 s", call)
        self.assertAlmostEqual(bus.now, 7_999_999, 3)
        bus.disturb("recessive", bus.now, 0.02, node="a")
        bus.send("a", Frame(0x7))
        bus.step(seconds=0.02)
        self.assertEqual(bus.state("a").state, "bus-off")
        bus.restart("a")
        bus.step(seconds=0.02)
        self.assertEqual(heard(bus, "b"), [(0x7, b"")])

    def test_now_is_not_in_the_past(self):
        # Late seconds are not exact to the picosecond.
        bus = Bus(["a"])
        bus.pass_time(9e5)
        for _ in range(16):
            bus.pass_time(123.456789e-6)
            bus.disturb("flip", bus.now, 1e-9)

    def test_messages_do_not_name_a_file_that_is_not(self):
        self.refused("^nodes: node 'a': no setting", lambda: Bus(["a"], bitrate=900_000))

    def test_keys_that_a_node_of_the_program_does_not_obey(self):
        for key in ({"listen_only": True}, {"loop_back": True}, {"self_reception": True},
                    {"triple_sampling": True}, {"fd_tolerant": True}, {"tx_buffers": 2},
                    {"lowest_buffer_first": True}, {"bus_off_recovery": "never"},
                    {"filters": [{"id": 0x100}]}, {"software": "none"}):
            name, = key
            scenario = {"nodes": [{"name": "a", **key}, {"name": "b"}]}
            self.refused(f"node 'a', which the program works, has '{name}.*allowed: no keys",
                         lambda scenario=scenario: Bus(["a"], scenario=scenario))
        nodes = [{"name": "a", "clock": "16 MHz", "sjw": 1, "ppm": 20, "cable": "2 m"}]
        self.assertEqual(Bus(["a"], scenario={"nodes": nodes}).nodes, ["a"])

    def test_accesses_to_buffers_of_a_node_of_the_program(self):
        nodes = [{"name": "a"}, {"name": "b"}]
        for step in ("write IMASK1 0", "clear IFLAG2 0x80000000", "write MB7.CS 0x0C000000"):
            accesses = [{"node": "a", "do": step}]
            self.refused("'accesses' write buffers of node 'a', which the program works; allowed",
                         lambda accesses=accesses: Bus(["a"], scenario={"nodes": nodes,
                                                                        "accesses": accesses}))
        accesses = [{"node": "a", "do": "read ECR"}, {"node": "b", "do": "write IMASK1 0"}]
        Bus(["a"], scenario={"nodes": nodes, "accesses": accesses}).step(1e-3)

    def test_a_missing_scenario(self):
        with self.assertRaisesRegex(verican.InputError, "missing.yaml"):
            Bus(["a"], scenario="missing.yaml")


class ScenarioValues(unittest.TestCase):
    """Scenarios, events and reports as Python values."""

    SCENARIO = {
        "bitrate": "250k", "duration": "20 ms",
        "nodes": [{"name": "talker", "clock": "8 MHz"}],
        "traffic": [{"node": "talker", "name": "beat", "id": 0x155, "data": [1, 2],
                     "period": "2 ms", "count": 5}],
        "faults": [{"kind": "dominant", "from": "4.1 ms", "for": "30 us", "hits": {"min": 0}}],
    }

    def test_scenario_as_a_dictionary(self):
        bus = Bus(["a"], scenario=self.SCENARIO)
        self.assertEqual(bus.nodes, ["talker", "a"])
        bus.step(0.02)
        self.assertEqual([message.id for message in bus.receive("a") if not message.error],
                         [0x155] * 5)
        with self.assertRaisesRegex(InputError, "nodes"):
            Bus(["a"], scenario={"bitrate": "250k", "nodes": [{"nam": "x"}]})

    def test_names_of_any_characters(self):
        name = "T\u00fcr \U0001F600"
        bus = Bus(["a"], scenario={"nodes": [{"name": name}]})
        self.assertEqual(bus.nodes, [name, "a"])

    def test_what_json_cannot_hold(self):
        for value in ({1}, float("nan"), float("inf"), b"x", "\ud83d", object()):
            with self.assertRaisesRegex(ValueError, "scenario: .*allowed: what JSON can hold"):
                Bus(["a"], scenario={"bitrate": value})

    def test_events(self):
        bus = Bus(["a"], scenario=self.SCENARIO)
        bus.step(0.02)
        events = bus.events()
        self.assertEqual([event["kind"] for event in events],
                         ["frame"] * 2 + ["error frame"] + ["frame"] * 3)
        self.assertEqual(events[0]["frame"], Frame(0x155, b"\1\2"))
        self.assertTrue(events[0]["acked"])
        wrong = events[2]
        # ST-06: the sixth dominant bit. 24 bits behind SOF is DATA, which begins after 20.
        self.assertEqual((wrong["problem"], wrong["field"]), ("stuff", "DATA"))
        self.assertTrue(4.1e-3 < wrong["start"] < wrong["end"] < 4.3e-3, wrong)
        self.assertEqual(bus.events(), [])

    def test_the_last_frame_beside_a_node_that_never_gets_idle(self):
        # In freeze mode it has no field of a frame.
        bus = Bus(["a", "b"], scenario={
            "nodes": [{"name": "frozen"}],
            "accesses": [{"node": "frozen", "do": "write MCR 0x5980003F"}]})
        bus.step(1e-3)
        bus.send("a", Frame(0x5))
        bus.step(1e-3)
        self.assertFalse(bus.quiet)
        self.assertEqual([frame for _, _, _, frame in bus.frames()], [Frame(0x5)])
        self.assertEqual([event["kind"] for event in bus.events()], ["frame"])

    def test_report_as_a_dictionary(self):
        bus = Bus(["a"], scenario=self.SCENARIO)
        bus.step(0.02)
        report = bus.finish()
        beat = next(message for message in report["messages"] if message["name"] == "beat")
        self.assertEqual((beat["queued"], beat["sent"]), (5, 5))

    def test_report_of_a_bus_on_which_no_time_has_passed(self):
        report = Bus(["a", "b"]).finish()
        self.assertEqual((report["duration_ps"], report["load"]), (0, 0))

    def test_until_a_message(self):
        bus = Bus(["a", "b"], bitrate=1e6)
        self.assertFalse(bus.run_until_message(1e-3))
        self.assertAlmostEqual(bus.now, 1e-3, 9)
        bus.send("a", Frame(0x123, b"12345678"))
        self.assertTrue(bus.run_until_message(1e-2))
        # 111 bits without stuff bits up to the end of EOF, 24 stuff bits at most; set-up before it.
        self.assertTrue(108e-6 < bus.now - 1e-3 < 160e-6, bus.now)

    def test_order_by_identifier(self):
        for order, wanted in (("program", [0x300, 0x200, 0x100]),
                              ("identifier", [0x100, 0x200, 0x300])):
            bus = Bus(["a", "b"], bitrate=1e6, order=order)
            bus.send("b", Frame(0x000))  # the bus is taken while a's frames get into their buffers
            bus.step(bits=15)
            for identifier in (0x300, 0x200, 0x100):
                bus.send("a", Frame(identifier, b"\x11"))
            bus.run_until_quiet()
            self.assertEqual([f[3].id for f in bus.frames()][1:], wanted)
            echoes = [m for m in bus.receive("a") if m.echo]
            self.assertEqual([m.id for m in echoes], wanted)
            self.assertEqual(sorted(m.time_ps for m in echoes), [m.time_ps for m in echoes])
        with self.assertRaisesRegex(ValueError, "program or identifier"):
            Bus(["a"], order="age")

    def test_order_within_an_identifier(self):
        # More frames than the core has buffers, in which the lowest buffer wins among equals; 29
        # bits and 11 bits with the same number are two identifiers.
        bus = Bus(["a", "b"], bitrate=1e6, order="identifier")
        for i in range(24):
            bus.send("a", Frame(0x123, bytes([i]), extended=i % 4 == 3, remote=False))
            bus.send("a", Frame(0x7FF, remote=i % 2 == 1))
        self.assertTrue(bus.run_until_quiet())
        got = [message for message in bus.receive("b") if not message.error]
        for extended in (False, True):
            self.assertEqual([m.data[0] for m in got if m.id == 0x123 and m.extended == extended],
                             [i for i in range(24) if (i % 4 == 3) == extended])
        self.assertEqual([m.remote for m in got if m.id == 0x7FF], 12 * [False, True])
        echoes = [message for message in bus.receive("a") if message.echo]
        self.assertEqual([(m.id, m.data) for m in echoes], [(m.id, m.data) for m in got])

    def test_response_times(self):
        # Davis, Burns, Bril and Lukkien 2007, table 1: three messages that take 1 ms each, here of
        # 135 bits at 135 kbit/s.
        messages = [(8, False, 2.5e-3, 0), (8, False, 3.5e-3, 0), (8, False, 3.5e-3, 0)]
        bounds = response_times(messages, 135e3)
        self.assertEqual([round(bound * 1e3, 2) for bound in bounds], [2.0, 3.0, 3.5])
        self.assertEqual(response_times([(8, False, 1e-4, 0)], 1e6), [None])
        with self.assertRaises(ValueError):
            response_times([(9, False, 1e-3, 0)], 1e6)
        # The busy period of the first would be half a minute long, with instances by the thousand.
        for jitter in (3e-4, 10.0):
            with self.assertRaisesRegex(ValueError, "jitter must be below the period"):
                response_times([(8, False, 3e-4, jitter), (8, False, 1.0, 0)], 1e6)


if __name__ == "__main__":
    unittest.main()
