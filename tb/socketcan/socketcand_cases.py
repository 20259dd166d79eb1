# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""python-can, and clients by hand, on the simulated bus through `verican bridge --socketcand`.

What is expected is what was sent, and the bridge's own log of the bus. Run by ctest, one case each:
VERICAN_BINARY=build/release/verican python3 -m unittest socketcand_cases.Traffic.test_both_ways
"""

import logging
import os
import pathlib
import random
import signal
import socket
import subprocess
import tempfile
import threading
import unittest

import can
from socketcand_bridge import PATIENCE, Bridge, Client

FRAMES = 10_000
# Of the nodes in Traffic.SCENARIO.
NODE_IDS = ("555", "00ABCDEF")

# can/error.h
CAN_ERR_LOSTARB, CAN_ERR_PROT, CAN_ERR_ACK = 0x02, 0x08, 0x20
CAN_ERR_BUSOFF, CAN_ERR_RESTARTED = 0x40, 0x100

# python-can 4.1 says so of each piece of TCP that ends inside a message; it keeps that message.
logging.getLogger("can.interfaces.socketcand").setLevel(logging.ERROR)


def python_can(bridge, bus="can0"):
    """A bus of python-can."""
    return can.Bus(interface="socketcand", channel=bus, host="127.0.0.1", port=bridge.port)


def receive(bus, count):
    """The next `count` messages of a python-can bus, as (identifier, data)."""
    messages = []
    while len(messages) < count:
        message = bus.recv(PATIENCE)
        if message is None:
            raise AssertionError(f"{len(messages)} of {count} frames came")
        messages.append((message.arbitration_id, bytes(message.data)))
    return messages


def numbers(frames):
    """Frames of a log as python-can gives them: its version 4.1 does not tell the formats apart."""
    return [(int(id_, 16), bytes.fromhex(data)) for id_, data in frames]


def random_message(source):
    """Both formats and all lengths; bit 0 of the identifier is 0, the nodes of the bus have 1.
    python-can 4.1 writes small 29-bit identifiers with fewer digits, those below 0x1000 as 11 bits.
    """
    extended = source.random() < 0.5
    id_ = source.randrange(0x1000, 1 << 29, 2) if extended else source.randrange(0, 0x800, 2)
    data = source.randbytes(source.randrange(9))
    return can.Message(arbitration_id=id_, is_extended_id=extended, data=data)


def as_logged(message):
    """A message of python-can as a log of candump has it."""
    id_ = f"{message.arbitration_id:0{8 if message.is_extended_id else 3}X}"
    return id_, bytes(message.data).hex().upper()


class Traffic(unittest.TestCase):
    """Frames in both directions: none lost, order kept, contents equal."""

    SCENARIO = """
name: both ways
bitrate: 1M
drain: 1 s
nodes:
  - {name: base, clock: 8 MHz}
  - {name: extended, clock: 8 MHz}
traffic:
  - {node: base, id: 0x555, data: counter, period: saturated, count: 5000}
  - {node: extended, id: 0xABCDEF, extended: true, data: random, period: saturated, count: 5000}
"""

    def test_both_ways(self):
        """10,000 frames each way at once; contents and order as the bus had them."""
        source = random.Random(4)
        sent = [random_message(source) for _ in range(FRAMES)]
        with Bridge("--fast", scenario=self.SCENARIO, clients=2) as bridge:
            bus = python_can(bridge)
            # The second client that receives starts the bus.
            with Client(bridge.port, "open can0", "rawmode") as other:
                sender = threading.Thread(target=lambda: [bus.send(m) for m in sent])
                sender.start()
                received = receive(bus, FRAMES)
                everything = other.frames(2 * FRAMES)
                sender.join()
                other.settle()
            self.assertIsNone(bus.recv(0))
            bus.shutdown()
            report = bridge.stop()
            log = bridge.frames()
        from_nodes = [frame for frame in log if frame[0] in NODE_IDS]
        self.assertEqual([frame for frame in log if frame[0] not in NODE_IDS],
                         [as_logged(message) for message in sent])
        self.assertEqual(len(from_nodes), FRAMES)
        self.assertEqual(received, numbers(from_nodes))
        self.assertEqual(everything, log)
        counters = [bytes.fromhex(data) for id_, data in log if id_ == "555"]
        self.assertEqual(counters, [i.to_bytes(8, "little") for i in range(FRAMES // 2)])
        self.assertEqual(report["bus"]["error_frames"], 0)

    def test_real_time(self):
        """Held to real time: 200 frames take at least as long as on a real bus."""
        with Bridge("--bitrate", "20k") as bridge:
            bus, other = python_can(bridge), python_can(bridge)
            for i in range(200):
                bus.send(can.Message(arbitration_id=i, is_extended_id=False, data=bytes(8)))
            self.assertEqual(receive(other, 200), [(i, bytes(8)) for i in range(200)])
            bus.shutdown()
            other.shutdown()
            report = bridge.stop()
            log = bridge.frames()
        self.assertEqual(len(log), 200)
        # A base frame of 8 bytes without stuff bits and its intermission: 108 + 3 bits of 50 us.
        self.assertGreaterEqual(report["wall_seconds"], 200 * 111 * 50e-6)


class Clients(unittest.TestCase):
    """Several clients, several buses."""

    def test_echo_goes_to_the_others(self):
        """Two python-can buses on one bus see each other's frames, not their own."""
        with Bridge("--fast") as bridge:
            one, two = python_can(bridge), python_can(bridge)
            one.send(can.Message(arbitration_id=0x101, is_extended_id=False, data=[1]))
            self.assertEqual(receive(two, 1), [(0x101, b"\x01")])
            two.send(can.Message(arbitration_id=0x102, is_extended_id=False, data=[2]))
            self.assertEqual(receive(one, 1), [(0x102, b"\x02")])
            # One more, so that it is known what came before it.
            with Client(bridge.port, "open can0", "rawmode") as third:
                third.send("send 103 0")
                self.assertEqual(receive(one, 1), [(0x103, b"")])
                self.assertEqual(receive(two, 1), [(0x103, b"")])
                third.settle()
            one.shutdown()
            two.shutdown()
            bridge.stop()
            self.assertEqual(bridge.frames(), [("101", "01"), ("102", "02"), ("103", "")])

    def test_two_buses_arbitrate(self):
        """Two buses are two nodes: of frames that wait at once the lower identifier wins."""
        high_frames = [(f"7{i:02X}", f"{i:02X}") for i in range(50)]
        low_frames = [(f"1{i:02X}", "") for i in range(50)]
        with Bridge("--fast", buses=("low", "high"), clients=2) as bridge:
            low, high = Client(bridge.port, "open low"), Client(bridge.port, "open high")
            for (high_id, data), (low_id, _) in zip(high_frames, low_frames):
                high.send(f"send {high_id} 1 {data}")
                low.send(f"send {low_id} 0")
            # Now that frames wait at both nodes, the clients that start the bus.
            low_watch = Client(bridge.port, "open low", "rawmode")
            high_watch = Client(bridge.port, "open high", "rawmode")
            # Each sees the frames of both: those of its own bus come as echoes.
            seen = low_watch.frames(100)
            classes, others = 0, []
            while len(others) < 100:
                message = high_watch.next()
                if message[0] == "error":
                    classes |= int(message[1], 16)
                else:
                    others.append(message)
            for client in low, high, low_watch, high_watch:
                client.close()
            report = bridge.stop()
            log = bridge.frames()
        self.assertEqual(seen, log)
        self.assertEqual([f for f in log if f[0] < "700"], low_frames)
        self.assertEqual([f for f in log if f[0] >= "700"], high_frames)
        self.assertEqual(log[0], low_frames[0])
        nodes = {node["name"]: node for node in report["bus"]["nodes"]}
        self.assertEqual(nodes["low"]["lost_arbitration"], 0)
        self.assertGreater(nodes["high"]["lost_arbitration"], 0)
        self.assertEqual(nodes["high"]["errors"], 0)
        self.assertTrue(classes & CAN_ERR_LOSTARB)

    def test_remote_frames(self):
        """sendrtr and rtr; and what python-can sends for a remote frame."""
        with Bridge("--fast") as bridge:
            bus = python_can(bridge)
            with Client(bridge.port, "open can0", "rawmode") as client:
                bus.send(can.Message(arbitration_id=0x123, is_extended_id=False,
                                     is_remote_frame=True, dlc=4))
                self.assertEqual(client.frames(1), [("123", "R4")])
                client.send("sendrtr 12345678 8")
                # python-can does not know "rtr" and goes on with the next message.
                client.send("send 7FF 0")
                self.assertEqual(receive(bus, 1), [(0x7FF, b"")])
            bus.shutdown()
            bridge.stop()
            log = bridge.frames()
        self.assertEqual(log, [("123", "R4"), ("12345678", "R8"), ("7FF", "")])

    def test_jobs_in_simulated_time(self):
        """A periodic job keeps its interval on the bus, however fast the simulation is."""
        with Bridge("--fast") as bridge, Client(bridge.port, "open can0") as client:
            with Client(bridge.port, "open can0", "rawmode") as watch:
                client.send("add 0 10000 123 2 11 22")
                times = []
                while len(times) < 20:
                    message = watch.next()
                    self.assertEqual(as_words(message), ["frame", "123", "1122"])
                    times.append(float(message[2]))
                client.send("delete 123")
                watch.close()
            client.close()
            bridge.stop()
        # The bridge looks at the programs every 512 bits, about 1 ms.
        for i, time in enumerate(times):
            self.assertAlmostEqual(time - times[0], 0.010 * i, delta=0.003)

    def test_a_client_vanishes(self):
        """One client of three goes in the middle of the traffic; the others get everything."""
        scenario = """
name: traffic
bitrate: 1M
nodes: [{name: node, clock: 8 MHz}]
traffic: [{node: node, id: 0x123, data: counter, period: saturated, count: 3000}]
"""
        with Bridge("--fast", scenario=scenario, clients=3) as bridge:
            bus = python_can(bridge)
            one, two = (Client(bridge.port, "open can0", "rawmode") for _ in range(2))
            one.frames(100)
            one.socket.sendall(b"< send 77")
            one.close(reset=True)
            expected = [i.to_bytes(8, "little") for i in range(3000)]
            self.assertEqual([data for _, data in receive(bus, 3000)], expected)
            self.assertEqual([bytes.fromhex(d) for _, d in two.frames(3000)], expected)
            bus.shutdown()
            two.close()
            report = bridge.stop()
        self.assertEqual(report["socketcand"]["too_slow"], 0)


def as_words(message):
    """A message without its time."""
    return message[:2] + message[3:]


class Errors(unittest.TestCase):
    """SocketCAN's error messages. Counters: FC-03, FC-05, FC-13 of the rule book."""

    def test_nobody_acknowledges(self):
        """Alone on the bus: TEC + 8 for each try until error passive, then no more (FC-05)."""
        with Bridge("--fast", nodes=0) as bridge:
            client = Client(bridge.port, "open can0", "rawmode")
            bus = python_can(bridge)
            for _ in range(30):
                client.send("send 123 1 55")
            counters = []
            while len(counters) < 24:
                kind, class_, _, data = client.next()
                self.assertEqual(kind, "error")
                if int(class_, 16) & CAN_ERR_ACK:
                    counters.append(bytes.fromhex(data)[6])
            self.assertEqual(counters, [min(8 * i, 128) for i in range(1, 25)])
            # Debian's python-can does not know error messages and passes them over.
            self.assertIsNone(bus.recv(0.1))
            bus.shutdown()
            report = bridge.stop()
            self.assertEqual(bridge.frames(), [])
            # Those that the node does not have yet are told of, and counted with the others.
            self.assertIn("frames of this client were not sent", client.last_words())
            client.close()
        self.assertEqual(report["ports"][0]["pending"], 30)

    def test_bus_off_and_restart(self):
        """Each of its data frames is falsified: 32 errors, bus-off, and a restart after 10 ms."""
        scenario = """
name: bus-off
bitrate: 500k
nodes: [{name: other, clock: 8 MHz}, {name: can0, clock: 8 MHz}]
faults: [{kind: flip, at: {node: can0, field: DATA, bit: 0}}]
"""
        with Bridge("--fast", "--restart-ms", "10", scenario=scenario) as bridge:
            client = Client(bridge.port, "open can0", "rawmode")
            client.send("send 123 1 55")
            errors = off = restarted = 0
            while not restarted:
                kind, class_, time, _ = client.next()
                self.assertEqual(kind, "error")
                bits = int(class_, 16)
                self.assertTrue(bits & 0x20000000)
                errors += off == 0 and bits & CAN_ERR_PROT != 0
                off = off or (float(time) if bits & CAN_ERR_BUSOFF else 0)
                restarted = float(time) if bits & CAN_ERR_RESTARTED else 0
            self.assertEqual(errors, 32)
            # 10 ms, then 128 times 11 bits of 2 us, of which some may have passed before (BO-02).
            self.assertGreaterEqual(restarted - off, 0.010)
            self.assertLessEqual(restarted - off, 0.010 + 130 * 11 * 2e-6)
            client.close()
            report = bridge.stop()
        self.assertGreaterEqual(report["ports"][0]["bus_off"], 1)


class Ends(unittest.TestCase):
    """Signals, and options that cannot be used."""

    SCENARIO = """
name: endless
bitrate: 1M
nodes: [{name: node, clock: 8 MHz}]
traffic: [{node: node, id: 0x123, data: counter, period: saturated}]
"""

    def end_by(self, sign):
        """In the middle of traffic: exit code 0, and what was on the bus has reached the client."""
        with Bridge("--fast", scenario=self.SCENARIO, clients=1) as bridge:
            client = Client(bridge.port, "open can0", "rawmode")
            frames = client.frames(500)
            bridge.process.send_signal(sign)
            frames += client.frames_to_end()
            client.close()
            bridge.end()
            log = bridge.frames()
        self.assertGreaterEqual(len(log), 500)
        self.assertEqual(frames, log)

    def test_sigterm(self):
        """The usual end."""
        self.end_by(signal.SIGTERM)

    def test_sigint(self):
        """Control-C."""
        self.end_by(signal.SIGINT)

    def test_end_before_the_clients_have_come(self):
        """SIGTERM while it waits for clients."""
        with Bridge("--fast", clients=2) as bridge, Client(bridge.port, "open can0", "rawmode"):
            bridge.stop()

    def test_bad_options(self):
        """One clear line and exit code 2."""
        taken = socket.create_server(("127.0.0.1", 0))
        in_use = f"127.0.0.1:{taken.getsockname()[1]}"
        cases = [
            (["--socketcand", in_use],
             f"--socketcand: cannot listen on {in_use}: Address already in use"),
            (["--socketcand", "192.0.2.1:29536"],  # RFC 5737: no machine has it
             "--socketcand: cannot listen on 192.0.2.1:29536: Cannot assign requested address"),
            (["--socketcand", "127.0.0.1:99999"], "--socketcand: '127.0.0.1:99999' is not allowed"),
            (["--socketcand", "here"], "--socketcand: 'here' is not allowed"),
            (["--socketcand", "0", "--bus-name", "a b"], "--bus-name: 'a b' is not allowed"),
            (["--socketcand", "0", "--bus-name", "a", "--bus-name", "a"],
             "--bus-name: 'a' is named twice"),
            (["--socketcand", "0", "--if", "can0"], "--bus-name: 'can0' is named twice"),
            (["--bus-name", "a"], "--bus-name requires --socketcand"),
            (["--socketcand", "0", "--wait-for-clients", "-1"], "--wait-for-clients"),
            ([], "--if: nothing to bridge"),
        ]
        for options, text in cases:
            with self.subTest(options=options):
                self.refused([os.environ["VERICAN_BINARY"]], options, text)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bus.yaml"
            path.write_text(f"nodes:\n  - {{name: a, socketcand: '{in_use}'}}\n", encoding="ascii")
            done = subprocess.run([os.environ["VERICAN_BINARY"], "run", path], text=True,
                                  capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stderr), (
            2, f"verican: {path}:2: socketcand: cannot listen on {in_use}: Address already in "
               f"use\n"))
        taken.close()

    def test_port_that_is_not_permitted(self):
        """Port 1 belongs to root; root gives that up here."""
        with open("/proc/sys/net/ipv4/ip_unprivileged_port_start", encoding="ascii") as file:
            if int(file.read()) <= 1:
                self.skipTest("this machine gives every port to everybody")
        command = [os.environ["VERICAN_BINARY"]]
        if os.geteuid() == 0:
            command = ["setpriv", "--bounding-set=-net_bind_service"] + command
        self.refused(command, ["--socketcand", "127.0.0.1:1"],
                     "--socketcand: cannot listen on 127.0.0.1:1: Permission denied")

    def test_name_with_addresses_of_both_versions(self):
        """Clients that know IPv4 alone find the server at a name that has ::1, too."""
        with tempfile.TemporaryDirectory() as folder:
            hosts = pathlib.Path(folder) / "hosts"
            hosts.write_text("::1 localhost\n127.0.0.1 localhost\n", encoding="ascii")
            own = ["unshare", "--map-root-user", "--mount", "sh", "-c",
                   'mount --bind "$0" /etc/hosts && exec "$@"', str(hosts)]
            if subprocess.run(own + ["true"], capture_output=True, check=False).returncode != 0:
                self.skipTest("this machine gives no mounts of one's own")
            with subprocess.Popen(
                    own + [os.environ["VERICAN_BINARY"], "bridge", "--nodes", "1",
                           "--socketcand", "localhost:0"],
                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as bridge:
                try:
                    Client(int(bridge.stderr.readline().rsplit(":", 1)[1])).socket.close()
                finally:
                    bridge.terminate()

    def refused(self, command, options, text):
        """The command ends at once with code 2 and one line that has `text`."""
        result = subprocess.run(command + ["bridge", *options], capture_output=True, text=True,
                                timeout=PATIENCE, check=False)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(text, result.stderr)


if __name__ == "__main__":
    unittest.main()
