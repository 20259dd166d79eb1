# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""python-can's interface "verican": what programs of python-can do, on a bus of RTL nodes."""
import contextlib
import itertools
import math
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from unittest import mock

import can

from verican import python_can

WAIT = 20  # s; far more than anything here takes, so that no result depends on it
names = (f"channel{i}" for i in itertools.count())


def open_bus(channel, **settings):
    return can.Bus(interface="verican", channel=channel, **settings)


def message(identifier, data=b"", **kwargs):
    return can.Message(arbitration_id=identifier, data=data, is_extended_id=False, **kwargs)


def content(of):
    return (of.arbitration_id, of.is_extended_id, of.is_remote_frame, of.is_error_frame, of.dlc,
            bytes(of.data))


def until(condition):
    end = time.monotonic() + WAIT
    while not condition() and time.monotonic() < end:
        time.sleep(1e-3)
    return condition()


def two_wait_until(event, wait, *args):
    """Two threads wait, `event` is called; WAIT is the time in which both must have ended."""
    waiting = [threading.Thread(target=wait, args=args, daemon=True) for _ in range(2)]
    for thread in waiting:
        thread.start()
    time.sleep(0.05)
    event()
    for thread in waiting:
        thread.join(WAIT)


class PythonCan(unittest.TestCase):
    def setUp(self):
        self.channel = next(names)
        self.a, self.b = self.open(), self.open()

    def open(self, channel=None, **settings):
        bus = open_bus(channel or self.channel, **settings)
        self.addCleanup(bus.shutdown)
        return bus

    def test_frames_both_ways(self):
        kinds = [message(0x123, b"\x01\x02"), message(0x7FF, b"12345678"),
                 can.Message(arbitration_id=0x1ABCDEF0, data=b"x"),
                 can.Message(arbitration_id=0x55, is_extended_id=False, is_remote_frame=True,
                             dlc=3)]
        for sender, receiver in ((self.a, self.b), (self.b, self.a)):
            for sent in kinds:
                sender.send(sent)
                self.assertEqual(content(receiver.recv(WAIT)), content(sent))
        self.assertIsNone(self.a.recv(0))  # no echoes

    def test_own_messages_on_request(self):
        channel = next(names)
        own = self.open(channel, receive_own_messages=True)
        own.send(message(0x42, b"me"))
        echo = own.recv(WAIT)
        self.assertEqual((echo.arbitration_id, bytes(echo.data), echo.is_rx), (0x42, b"me", False))

    def test_filters(self):
        self.b.set_filters([{"can_id": 0x100, "can_mask": 0x700, "extended": False}])
        for identifier in (0x050, 0x123, 0x250, 0x1FF):
            self.a.send(message(identifier))
        self.assertEqual([self.b.recv(WAIT).arbitration_id for _ in range(2)], [0x123, 0x1FF])
        self.a.flush_tx_buffer()
        self.assertIsNone(self.b.recv(0.1))

    def test_an_inbox_that_nobody_reads(self):
        # The newest are lost and counted, as in a socket of the kernel.
        with mock.patch.object(python_can, "INBOX", 100):
            for i in range(300):
                self.a.send(message(i))
            self.a.flush_tx_buffer()
            self.assertTrue(until(lambda: self.b.dropped == 200))
            self.assertEqual([self.b.recv(0).arbitration_id for _ in range(100)],
                             list(range(100)))
            self.a.send(message(0x42))
            self.assertEqual(self.b.recv(WAIT).arbitration_id, 0x42)
        self.assertEqual((self.a.dropped, self.b.dropped), (0, 200))

    def test_shutdown_wakes_who_waits(self):
        ends = []

        def wait(bus):
            with self.assertRaisesRegex(can.CanOperationError, "shut down"):
                bus.recv()
            ends.append(bus)
        # The other one is still open, and then the channel closes, too.
        for bus in (self.b, self.a):
            two_wait_until(bus.shutdown, wait, bus)
        self.assertEqual(ends, 2 * [self.b] + 2 * [self.a])

    def test_raw_dlc(self):
        # python-can's messages have no DLC above 8; one that is made unchecked leaves as it is.
        own = self.open(next(names), receive_own_messages=True, nodes=2)
        own.send(message(0x42, bytes(8), dlc=12))
        self.assertEqual(own.recv(WAIT).dlc, 8)

    def test_notifier_gives_listeners_all_in_order(self):
        got = []
        notifier = can.Notifier(self.b, [got.append], timeout=0.05)
        for i in range(300):
            self.a.send(message(i))
        self.assertTrue(until(lambda: len(got) >= 300))
        notifier.stop()
        self.assertEqual([m.arbitration_id for m in got], list(range(300)))

    def test_cyclic_tasks(self):
        task = self.a.send_periodic(message(0x31, b"tick"), 0.01)
        first, second = self.b.recv(WAIT), self.b.recv(WAIT)
        task.stop()
        self.assertEqual((first.arbitration_id, bytes(second.data)), (0x31, b"tick"))
        self.assertGreater(second.timestamp, first.timestamp)

    def test_time_stamps_are_those_of_the_bus(self):
        # 8 bytes at 500 kbit/s: 111 bits and the stuff bits from one start to the next, FF-01.
        for i in range(50):
            self.a.send(message(0x100 + i, b"\xA5" * 8))
        stamps = [self.b.recv(WAIT).timestamp for _ in range(50)]
        gaps = [second - first for first, second in zip(stamps[1:], stamps[2:])]
        self.assertTrue(all(111 * 2e-6 - 1e-6 < gap < 135 * 2e-6 + 1e-6 for gap in gaps), gaps)

    def test_stamps_of_frames_that_come_one_by_one(self):
        # The bus idles between them, shorter than between two looks at the host's clock.
        since = time.time()
        for i in range(60):
            time.sleep(5e-3)
            self.a.send(message(i))
        passed = time.time() - since
        stamps = [self.b.recv(WAIT).timestamp for _ in range(60)]
        self.assertAlmostEqual(stamps[-1] - stamps[0], passed, delta=passed / 2)
        self.assertAlmostEqual(stamps[-1], since + passed, delta=passed / 2)

    def test_a_log_is_written_and_played_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "bus.log")
            logger, got = can.Logger(path), []

            def log(entry):
                logger(entry)
                got.append(entry)
            notifier = can.Notifier(self.b, [log], timeout=0.05)
            sent = [message(0x200 + i, bytes([i])) for i in range(20)]
            for entry in sent:
                self.a.send(entry)
            self.assertTrue(until(lambda: len(got) >= 20))
            notifier.stop()
            logger.stop()
            for entry in can.MessageSync(can.LogReader(path), timestamps=False, gap=0):
                self.b.send(entry)
        back = [self.a.recv(WAIT) for _ in sent]
        self.assertEqual([(m.arbitration_id, m.data) for m in back],
                         [(m.arbitration_id, m.data) for m in sent])

    def test_channels_are_separate(self):
        other_name = next(names)
        first, second = self.open(other_name), self.open(other_name)
        self.a.send(message(1))
        first.send(message(2))
        self.assertEqual((self.b.recv(WAIT).arbitration_id, second.recv(WAIT).arbitration_id),
                         (1, 2))
        first.flush_tx_buffer()
        self.assertIsNone(second.recv(0.05))
        self.assertIsNone(self.b.recv(0.05))


class PythonCanUsers(unittest.TestCase):
    """A node that goes from one can.Bus to the next, and a channel that fails."""

    def setUp(self):
        self.channel = next(names)
        self.a, self.b = self.open(), self.open()

    def open(self, **settings):
        bus = open_bus(self.channel, **settings)
        self.addCleanup(bus.shutdown)
        return bus

    def test_frames_of_a_user_that_has_left(self):
        # They leave all the same, and are not the next user's: neither as echoes nor in its queue.
        for i in range(200):
            self.a.send(message(0x100 + i, bytes([i] * 8)))
        self.a.shutdown()
        c = self.open(receive_own_messages=True)
        self.assertEqual(c.node, self.a.node)
        c.send(message(0x42))
        got = [self.b.recv(WAIT).arbitration_id for _ in range(201)]
        self.assertEqual(got, [*range(0x100, 0x1C8), 0x42])
        self.assertEqual(c.recv(WAIT).arbitration_id, 0x42)
        c.flush_tx_buffer()
        self.assertIsNone(c.recv(0.05))
        self.assertTrue(c._channel._thread.is_alive())  # pylint: disable=protected-access

    def break_channel(self):
        """Work of the channel's thread raises."""
        told, hook = threading.Event(), threading.excepthook
        self.addCleanup(setattr, threading, "excepthook", hook)
        threading.excepthook = lambda of: told.set()
        channel = self.a._channel  # pylint: disable=protected-access
        channel._do(lambda bus: {}["broken"])  # pylint: disable=protected-access
        self.assertTrue(told.wait(WAIT))

    def failed(self):
        return self.assertRaisesRegex(can.CanOperationError, "failed.*KeyError.*broken")

    def test_a_channel_that_has_failed(self):
        self.break_channel()
        for act in (lambda: self.a.send(message(1)), lambda: self.a.state, self.b.flush_tx_buffer,
                    lambda: self.b.disturb("flip", bits=1), lambda: self.b.recv(0),
                    lambda: self.b.recv(WAIT), self.b.recv):
            with self.failed():
                act()
        self.b.shutdown()
        with self.assertRaisesRegex(can.CanInitializationError, "failed.*broken"):
            self.open()
        self.a.shutdown()
        again = [self.open() for _ in range(2)]  # a bus of its own, under the same name
        again[0].send(message(1))
        self.assertEqual(again[1].recv(WAIT).arbitration_id, 1)

    def test_who_waits_while_the_channel_fails(self):
        ends = []

        def wait():
            with self.failed():
                self.b.recv()
            ends.append(True)
        two_wait_until(self.break_channel, wait)
        self.assertEqual(ends, [True, True])


class PythonCanEnd(unittest.TestCase):
    """Programs that end without shutdown(), while frames wait and the channel's thread works."""

    PROGRAM = """
buses = [can.Bus(interface="verican", channel="z", nodes=2) for _ in range(2)]
for i in range(2000):
    buses[0].send(can.Message(arbitration_id=i, is_extended_id=False, data=bytes(8)))
print("end")
"""

    def end(self, *parts):
        """Exit code and what the program says."""
        done = subprocess.run([sys.executable, "-B", "-c", "\n".join(parts)], capture_output=True,
                              text=True, timeout=5 * WAIT, check=False)
        return done.returncode, done.stdout, done.stderr

    def ends(self, *parts):
        """The program runs to its end and says nothing else."""
        self.assertEqual(self.end(*parts), (0, "end\n", ""))

    def test_without_shutdown(self):
        self.ends("import can", self.PROGRAM)

    def test_a_channel_that_cannot_be_closed(self):
        # The folder of its waveform has gone; the thread of the other one ends all the same.
        with tempfile.TemporaryDirectory() as folder:
            gone = folder + "/gone"
            parts = [f"""
import can, os, shutil
os.mkdir({gone!r})
bad = can.Bus(interface="verican", channel="bad", vcd={gone + "/a.vcd"!r})
shutil.rmtree({gone!r})""", self.PROGRAM]
            for program in parts, parts[::-1]:
                code, _, text = self.end("import can", *program)
                self.assertEqual(code, 0, text)
                self.assertIn("a.vcd: cannot be put in its place", text)

    def test_a_process_that_is_forked(self):
        # It has no copy of the thread that runs the bus; whatever it does, the bus is the parent's.
        with tempfile.TemporaryDirectory() as folder:
            wave = Path(folder) / "a.vcd"
            self.ends(f"""
import can, os, sys
a, b = (can.Bus(interface="verican", channel="f", vcd={str(wave)!r}) for _ in range(2))
one = can.Message(arbitration_id=1)
child = os.fork()
if child == 0:
    for act in (lambda: a.send(one), b.recv, lambda: b.recv(1), a.flush_tx_buffer, lambda: a.state):
        try:
            act()
        except can.CanOperationError as error:
            assert "forked" in str(error), error
        else:
            sys.exit(1)
    with can.Bus(interface="verican", channel="f") as own, \\
         can.Bus(interface="verican", channel="f") as other:
        own.send(one)
        assert other.recv({WAIT})
    a.shutdown()
    sys.exit(0)
assert os.waitpid(child, 0)[1] == 0
a.send(one)
assert b.recv({WAIT})
a.shutdown()
b.shutdown()
print("end")""")
            self.assertIn("$enddefinitions", wave.read_text())

    def test_a_shutdown_that_is_interrupted(self):
        # By Ctrl-C, once more: the end of the program completes it.
        with tempfile.TemporaryDirectory() as folder:
            wave = Path(folder) / "a.vcd"
            self.ends(f"""
import can
bus = can.Bus(interface="verican", channel="i", vcd={str(wave)!r})
thread = bus._channel._thread
join = thread.join
def interrupted():
    thread.join = join
    raise KeyboardInterrupt
thread.join = interrupted
try:
    bus.shutdown()
except KeyboardInterrupt:
    print("end")""")
            self.assertIn("$enddefinitions", wave.read_text())

    def test_shutdown_when_the_channels_are_closed(self):
        # Handlers go from the last to the first: this one is older than the package's.
        self.ends("import atexit, can",
                  "atexit.register(lambda: [bus.shutdown() for bus in buses])", self.PROGRAM)


class PythonCanErrors(unittest.TestCase):
    def setUp(self):
        self.channel = next(names)
        self.a, self.b = open_bus(self.channel), open_bus(self.channel)
        self.addCleanup(self.a.shutdown)
        self.addCleanup(self.b.shutdown)
        self.free = next(names)

    def disturbed(self):
        """Sends a frame under a disturbance; what the receiver has then."""
        self.b.disturb("dominant", bits=6, after=30)
        self.a.send(message(0x0F0, b"\xAA"))
        return list(iter(lambda: self.b.recv(0.05), None))

    def test_disturbed_frames_are_repeated_and_tell_errors(self):
        # The bus goes on between the two calls, so that the frame may come after the disturbance.
        for _ in range(100):
            got = self.disturbed()
            self.assertEqual([m.arbitration_id for m in got if not m.is_error_frame], [0x0F0])
            if got[0].is_error_frame:
                break
        self.assertTrue(got[0].is_error_frame and got[0].arbitration_id & 0x8)  # CAN_ERR_PROT
        self.assertEqual((self.a.state, self.b.state), 2 * (can.BusState.ACTIVE,))

    def test_a_node_alone_turns_passive_and_not_off(self):
        # FC-05, exception 1: a missing acknowledge does not count once the node is passive.
        alone = open_bus(next(names), nodes=1)
        self.addCleanup(alone.shutdown)
        self.assertEqual(alone.state, can.BusState.ACTIVE)
        alone.send(message(1))
        self.assertTrue(until(lambda: alone.state == can.BusState.PASSIVE))
        for _ in range(50):
            self.assertTrue(alone.recv(WAIT).is_error_frame)
        self.assertEqual((alone.node_state.tec, alone.state), (128, can.BusState.PASSIVE))

    def test_flush_of_a_node_alone(self):
        alone = open_bus(next(names), nodes=1)
        self.addCleanup(alone.shutdown)
        alone.flush_tx_buffer()
        alone.send(message(1))
        alone.send(message(2))
        with self.assertRaisesRegex(can.CanTimeoutError, "none of 2 that wait has left for 20000"):
            alone.flush_tx_buffer()
        alone.shutdown()
        with self.assertRaisesRegex(can.CanOperationError, "shut down"):
            alone.flush_tx_buffer()

    def test_bus_off_and_recovery(self):
        # A transmitter that never sees its own dominant bits: TEC + 8 for each try, FC-05, FC-13.
        self.a.disturb("recessive", bits=5000)
        self.a.send(message(0x7))
        self.assertTrue(until(lambda: self.a.state == can.BusState.ERROR))
        got = []

        def received():  # once the disturbance is over; before, the node goes off again
            if self.a.state == can.BusState.ERROR:
                self.a.state = can.BusState.ACTIVE
            got.extend(m for m in iter(lambda: self.b.recv(0.01), None) if not m.is_error_frame)
            return got
        self.assertTrue(until(received))
        self.assertEqual([m.arbitration_id for m in got], [0x7])
        self.a.flush_tx_buffer()
        self.assertEqual(self.a.state, can.BusState.ACTIVE)

    def test_who_calls_does_not_wait_until_the_bus_has_caught_up(self):
        # After a disturbance the clocks never rest; 20 s behind take long to make up for.
        self.a.disturb("recessive", bits=1)
        channel = self.a._channel  # pylint: disable=protected-access
        channel._epoch -= 20  # pylint: disable=protected-access
        time.sleep(0.1)  # it has begun to follow
        self.assertLess(channel.call(lambda bus: bus.now), 10)

    def test_recovery_by_itself_after_restart_ms(self):
        channel = next(names)
        a, b = open_bus(channel, restart_ms=5), open_bus(channel)
        self.addCleanup(a.shutdown)
        self.addCleanup(b.shutdown)
        a.disturb("recessive", bits=25000)
        a.send(message(0x7))
        got = [m for m in iter(lambda: a.recv(1), None)]
        self.assertTrue(any(m.arbitration_id & 0x40 for m in got))   # CAN_ERR_BUSOFF
        self.assertTrue(any(m.arbitration_id & 0x100 for m in got))  # CAN_ERR_RESTARTED

    def test_settings_of_configuration_files(self):
        """Texts, of which "false" means off."""
        self.a.shutdown()
        with open_bus(self.channel, receive_own_messages="true", restart_ms="0") as own:
            own.send(message(0x12))
            self.assertEqual(own.recv(WAIT).arbitration_id, 0x12)
        with open_bus(self.free, nodes="1", error_frames="False") as alone:
            alone.send(message(0x12))  # nobody acknowledges: there are errors without end
            self.assertIsNone(alone.recv(0.1))

    def test_what_cannot_be_is_refused(self):
        with self.assertRaisesRegex(can.CanInitializationError, "2 nodes.*taken.*nodes="):
            open_bus(self.channel)
        with self.assertRaisesRegex(can.CanInitializationError, "bitrate=500000, not 250000"):
            open_bus(self.channel, bitrate=250000)
        with self.assertRaisesRegex(can.CanInitializationError, "1000 to 1000000"):
            open_bus(next(names), bitrate=8000000)
        with self.assertRaisesRegex(can.CanInitializationError, "bitrate 0: 1000 to 1000000"):
            open_bus(next(names), bitrate=0)
        with self.assertRaisesRegex(can.CanOperationError, "classical CAN"):
            self.a.send(can.Message(arbitration_id=1, is_fd=True, data=bytes(64)))
        for identifier in (-1, 0x800, 1 << 32, "x"):
            with self.assertRaises(can.CanOperationError):
                self.a.send(message(identifier, check=False))
        with self.assertRaisesRegex(NotImplementedError, "ACTIVE alone"):
            self.a.state = can.BusState.PASSIVE
        self.a.shutdown()
        with self.assertRaisesRegex(can.CanOperationError, "shut down"):
            self.a.send(message(1))

    def test_a_channel_that_cannot_be_is_not_open(self):
        for nodes in (0, -1, 65):
            with self.assertRaisesRegex(can.CanInitializationError, f"nodes {nodes}: 1 to 64"):
                open_bus(self.free, nodes=nodes)
        for settings, text in (({"bitrate": 8000000}, "1000 to 1000000"),
                               ({"bitrate": math.nan}, "bitrate nan: a whole number"),
                               ({"bitrate": math.inf}, "bitrate inf: a whole number"),
                               ({"bitrate": 900_000}, "^nodes: node 'node0': no setting"),
                               ({"restart_ms": -1}, "restart_ms -1: 0 to 1000000000"),
                               ({"restart_ms": 10**400}, "restart_ms 10+: 0 to 1000000000"),
                               ({"nodes": "two"}, "nodes 'two': a whole number"),
                               ({"nodes": 2.7}, "nodes 2.7: a whole number"),
                               ({"restart_ms": 0.5}, "restart_ms 0.5: a whole number"),
                               ({"error_frames": "maybe"}, "error_frames 'maybe': true or false"),
                               ({"receive_own_messages": 2}, "receive_own_messages 2: true or"),
                               ({"nodes": [2]}, r"nodes \[2\]: a whole number")):
            # Without can.Bus, which looks at the bit rate before the interface does.
            with self.assertRaisesRegex(can.CanInitializationError, text):
                python_can.VericanBus(self.free, **settings)
        with self.assertRaises(can.CanInitializationError):
            open_bus([self.free])
        self.assertNotIn(self.free, [config["channel"] for config in
                                     can.detect_available_configs("verican")])
        self.assertNotIn(f"verican {self.free}", [thread.name for thread in threading.enumerate()])
        open_bus(self.free, nodes=1, fd=False, single_handle=True).shutdown()

    def test_settings_that_do_not_exist(self):
        for settings in ({"bitrat": 250000}, {"foo": 3}, {"data_bitrate": 2000000}):
            name, = settings
            with self.assertRaisesRegex(can.CanInitializationError, f"{name}.*allowed: .*bitrate"):
                open_bus(self.free, **settings)
        with self.assertRaisesRegex(can.CanInitializationError, "fd.*CAN 2.0"):
            open_bus(self.free, fd=True)

    def test_settings_of_a_second_user_that_differ(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
            path = str(Path(folder) / "a.vcd")
            stack.enter_context(open_bus(self.free, vcd=path, restart_ms=5, nodes=3))
            for settings, text in (({"vcd": "b.vcd"}, "a.vcd', not 'b.vcd'"),
                                   ({"vcd": ""}, "a.vcd', not ''"),
                                   ({"restart_ms": 6}, "restart_ms=5, not 6"),
                                   ({"nodes": 2}, "nodes=3, not 2")):
                with self.assertRaisesRegex(can.CanInitializationError, text):
                    open_bus(self.free, **settings)
            for settings in ({}, {"vcd": path, "restart_ms": "5", "nodes": 3, "bitrate": 500000}):
                stack.enter_context(open_bus(self.free, **settings))


if __name__ == "__main__":
    unittest.main()
