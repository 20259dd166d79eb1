# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""`verican memory` on nodes of the simulated bus, by `verican bridge --socketcand` (RN-95). Run by
ctest, one case each:
VERICAN_BINARY=build/release/verican python3 -m unittest memory_cases.Commands.test_scan
"""
import contextlib
import errno
import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tb/socketcan")]

from socketcand_bridge import Bridge, Client  # noqa: E402  pylint: disable=wrong-import-position

PATIENCE = 120
NODES = """bitrate: 500k
nodes:
  - {name: a, type: remote, number: 3, serial: 0xCAFE1234, memory: {0x40: 01 02, 0x200: 0A 0B 0C},
     config: {producers: [{send: 0x40, length: 2, period: 30 s, gap: 5 ms}],
              map: [{id: 0x640, to: 0x300, length: 2, time_out: 50 ms}, {id: 0x610, to: 0x301},
                    {id: 0x210, to: 0x20}]}}
  - {name: b, type: remote, number: 4, profile: small, serial: 0xBEEF0000, memory: {0x40: 03 04}}
  - {name: c, type: remote, serial: 0x00000005}
"""


NO_ADDRESS = "verican: memory: node 3 refuses at 0xE00: code 02, illegal address\n"
IN_USE = ("verican: memory: another node has that number; 'scan' lists them, and 'assign' with 0 "
          "takes a number away\n")


class OnBridge(unittest.TestCase):
    """The tool on a bus with these nodes."""

    nodes = NODES

    def setUp(self):
        self.bridge = Bridge("--fast", "--errors", "none", scenario=self.nodes)
        self.bridge.__enter__()  # pylint: disable=unnecessary-dunder-call
        self.addCleanup(self.bridge.__exit__, None, None, None)

    def memory(self, *words, code=0, error="", timeout=2000):
        """Standard output of `verican memory`."""
        done = subprocess.run(
            [os.environ["VERICAN_BINARY"], "memory", "--socketcand",
             f"127.0.0.1:{self.bridge.port}", "--timeout", str(timeout), *map(str, words)],
            capture_output=True, text=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stderr), (code, error), done.stdout)
        return done.stdout

    def json(self, *words, **keys):
        """The same with --json."""
        return json.loads(self.memory(*words, "--json", **keys))


class Commands(OnBridge):
    """RN-95: each subcommand, on a full node, a small one, and one without a number."""

    def test_read_and_write(self):
        """By number and address, long ones too, and to all."""
        self.assertEqual(self.memory("read", 3, "0x40", 2), "01 02\n")
        self.assertEqual(self.memory("read", 3, 0x200, 3), "0A 0B 0C\n")
        self.assertEqual(self.memory("write", 3, "0x70", *(f"{i:02x}" for i in range(20))), "")
        self.assertEqual(self.json("read", 3, "0x70", 20)["bytes"],
                         " ".join(f"{i:02X}" for i in range(20)))
        self.memory("write", "all", "0x40", "AABB")
        self.assertEqual(self.json("poll", "0x40", 2), {
            "address": 0x40,
            "answers": [{"number": 3, "bytes": "AA BB"}, {"number": 4, "bytes": "AA BB"}],
            "complaints": []})
        self.assertEqual(self.memory("poll", "0x40", 1), "   3  AA\n   4  AA\n")

    def test_scan_and_assign(self):
        """Nodes with a number, then those without."""
        nodes = self.json("scan")["nodes"]
        self.assertEqual([(n["number"], n["serial"]) for n in nodes],
                         [(3, 0xCAFE1234), (4, 0xBEEF0000), (0, 5)])
        self.assertEqual((nodes[0]["memory"], nodes[0]["stage"], nodes[0]["features"]),
                         (4096, 8, 0xFF))
        text = self.memory("scan")
        self.assertIn("   4  BEEF0000    4096      8  stage\n", text)
        self.assertIn("none  00000005\n", text)
        self.memory("assign", "5", 4, code=1, error=IN_USE)
        self.memory("assign", "5", 6)
        self.memory("assign", "5", 6)
        self.assertEqual([n["number"] for n in self.json("scan")["nodes"]], [3, 4, 6])

    def test_states_and_trigger(self):
        """Staged bytes become visible in OPERATE; STATUS tells state and count."""
        self.memory("state", "operate", 3)
        self.memory("write", 3, "0x10", "5A")
        self.assertEqual(self.memory("read", 3, "0x10"), "00\n")
        self.memory("trigger", 9)
        self.assertEqual(self.memory("read", 3, "0x10"), "5A\n")
        seen = self.json("status")["nodes"]
        self.assertEqual([(n["number"], n["state"], n["trigger"]) for n in seen],
                         [(3, "OPERATE", 9), (4, "SAFE", 9)])
        self.memory("state", "safe")
        self.assertIn("   3  SAFE ", self.memory("status", 3))
        self.memory("state", "operate", 7, code=1, timeout=50,
                    error="verican: memory: node 7 does not answer\n")
        self.memory("state", "restart", 3)
        self.memory("state", "operate")
        self.assertEqual([n["state"] for n in self.json("status")["nodes"]], 2 * ["OPERATE"])

    def test_map(self):
        """Tables in words; overlaps and identifiers that nobody sends are complained of."""
        text = self.memory("map", code=1)
        self.assertEqual(text.splitlines(), [
            "node 3",
            "  sends 5C0: 2 bytes of 40, every 30000 ms, 5 ms apart at least",
            "  takes 640 under 7FF to 300, late after 50 ms",
            "  takes 610 under 7FF to 301",
            "  takes 210 under 7FF to 020",
            "node 4",
            "wrong: node 3: entries for 640 and 610 overlap at 301",
            "wrong: node 3: waits for 640 under 7FF, which nobody sends",
            "wrong: node 3: waits for 610 under 7FF, which nobody sends"])
        self.assertEqual(len(self.json("map", code=1)["complaints"]), 3)

    def test_map_of_entries_that_never_work(self):
        """RN-65: an address that is none, a request to the node itself, SAFE without a time-out."""
        nodes = """nodes:
  - {name: a, type: remote, number: 3, serial: 3, memory: {0xF80: 23 81 FF 07 00 0E 00 00,
     0xF88: A0 81 FF 07 00 03 00 00, 0xF90: 24 81 FF 07 00 00 40 00,
     0xF98: 25 81 FF 07 00 04 00 00}}
  - {name: b, type: remote, number: 4, serial: 4, memory_bytes: 1024,
     memory: {0xF80: 23 81 FF 07 00 02 04 00}}
"""
        with Bridge("--fast", "--errors", "none", scenario=nodes) as self.bridge:
            lines = self.memory("map", code=1).splitlines()
        self.assertEqual([line for line in lines if line.startswith("wrong: ")], [
            "wrong: node 3: entry for 123: no memory for 1 byte at E00; allowed: 0x0 to 0xDFF, "
            "0xF00 to 0xF1F, 0xF40 to 0xFBF",
            "wrong: node 3: entry for 1A0: 1A0 is a request, which no entry takes",
            "wrong: node 3: entry for 124: late leads to SAFE, but without a time-out it is never "
            "late",
            "wrong: node 4: entry for 123: no memory for 4 bytes at 200; allowed: 0x0 to 0x1FF, "
            "0xF00 to 0xF1F, 0xF40 to 0xFBF"])

    def test_map_of_producers_that_never_send(self):
        """RN-63: no bytes, too many, beyond the window, at a port that is no row: these are off,
        and nobody sends what others wait for. A row is sent from any window."""
        nodes = """nodes:
  - {name: a, type: remote, number: 3, serial: 3, memory: {0xF40: 20 90 0A 00 00 00 00 00,
     0xF48: 22 99 0A 00 00 00 00 00, 0xF50: 76 93 0A 00 00 00 00 00,
     0xF58: 78 92 0A 00 00 00 00 00, 0xF60: 76 92 0A 00 00 00 00 00,
     0xF68: 7E 98 0A 00 00 00 00 00, 0xF70: 7F 98 0A 00 00 00 00 00}}
  - {name: b, type: remote, number: 4, serial: 4, config: {map: [{id: 0x5A0, to: 0x300}]}}
"""
        allowed = "allowed: 1 to 8 bytes of 00 to 77, of 7E or 7F"
        with Bridge("--fast", "--errors", "none", scenario=nodes) as self.bridge:
            self.assertEqual(self.json("map", code=1)["complaints"], [
                f"node 3: producer of 20: 0 bytes are never sent; {allowed}",
                f"node 3: producer of 22: 9 bytes are never sent; {allowed}",
                f"node 3: producer of 76: 3 bytes are never sent; {allowed}",
                f"node 3: producer of 78: 2 bytes are never sent; {allowed}",
                "node 4: waits for 5A0 under 7FF, which nobody sends"])

    def test_dump_and_load(self):
        """A table of bytes; a file and back."""
        self.assertEqual(self.memory("dump", 3, "0x1F8", 24),
                         "1F8  00 00 00 00 00 00 00 00 0A 0B 0C 00 00 00 00 00\n"
                         "208  00 00 00 00 00 00 00 00\n")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "memory.bin"
            path.write_bytes(bytes(range(100)))
            self.memory("load", 4, "0x180", path)
            other = pathlib.Path(folder) / "other.bin"
            self.memory("dump", 4, "0x180", 100, "-o", other)
            self.assertEqual(other.read_bytes(), bytes(range(100)))
            self.assertEqual(self.json("load", 4, "0x180", path), {
                "number": 4, "address": 0x180, "length": 100, "file": str(path)})
            self.assertEqual(self.json("dump", 4, "0x181", 2), {
                "number": 4, "address": 0x181, "length": 2, "bytes": "01 02"})
            self.assertEqual(self.json("dump", 4, "0x181", 2, "-o", other), {
                "number": 4, "address": 0x181, "length": 2, "file": str(other)})
            said = json.dumps({"number": 4, "address": 0x181, "length": 2, "file": "-"}, indent=2)
            self.assertEqual(self.memory("dump", 4, "0x181", 2, "-o", "-", "--json",
                                         error=said + "\n"), "\1\2")
            self.memory("load", 4, "0xFC0", path, code=2, error=f"verican: {path}: 100 bytes; "
                        "allowed: 1 to 64 from 0xFC0 on\n")
            self.memory("load", 4, "0xDF8", path, code=2, error=f"verican: {path}: 100 bytes; "
                        "allowed: 1 to 8 from 0xDF8 on, in node 4\n")
            self.assertEqual(self.memory("read", 4, "0xDF8", 8), " ".join(8 * ["00"]) + "\n")
            self.memory("dump", 4, "0xDF0", 32, code=2, error="verican: length: 32 bytes; "
                        "allowed: 1 to 16 from 0xDF0 on, in node 4\n")
            self.memory("dump", 4, "0xE00", code=2,
                        error="verican: address: node 4 has no memory at 0xE00\n")

    def test_watch(self):
        """RN-97: each frame with its command in words; after so many the end."""
        lines = []
        watch = threading.Thread(
            target=lambda: lines.extend(self.memory("watch", "--frames", 2).splitlines()))
        watch.start()
        while watch.is_alive():
            self.memory("read", 3, "0x40", 2)
        watch.join()
        words = {tuple(line.split(maxsplit=2)[1:]) for line in lines}
        self.assertEqual(words, {("1F8#400002", "3: read 040, 2 bytes"),
                                 ("5F8#40000102", "3 says 040 = 01 02")})

    def test_watch_as_json(self):
        """A line for each frame."""
        lines = []
        watch = threading.Thread(
            target=lambda: lines.extend(self.memory("--json", "watch", "--frames", 2).splitlines()))
        watch.start()
        while watch.is_alive():
            self.memory("read", 3, "0x40", 2)
        watch.join()
        self.assertEqual({json.loads(line)["words"] for line in lines},
                         {"3: read 040, 2 bytes", "3 says 040 = 01 02"})

    def test_watch_shows_reads_by_remote_frame(self):
        """RN-21: those of another host, with their length."""
        lines = []
        watch = threading.Thread(
            target=lambda: lines.extend(self.memory("watch", "--frames", 2).splitlines()))
        watch.start()
        with Client(self.bridge.port, "open can0", "rawmode") as other:
            while watch.is_alive():
                other.send("sendrtr 1C0 2")
                other.frames(1)
        watch.join()
        words = {tuple(line.split(maxsplit=2)[1:]) for line in lines}
        self.assertEqual(words, {("1C0#R2", "3: read 040, 2 bytes"),
                                 ("5C0#0102", "3 says 040 = 01 02")})

    def test_watch_tells_of_a_doubled_number(self):
        """RN-13: a node that hears its own number says so."""
        with Client(self.bridge.port, "open can0", "rawmode") as other:
            other.send("send 5A0 1 77")  # as node 3 would
            while "number doubled" not in self.memory("status"):
                pass
        lines = []
        watch = threading.Thread(
            target=lambda: lines.extend(self.memory("watch", "--frames", 4).splitlines()))
        watch.start()
        while watch.is_alive():
            self.memory("read", 3, "0xE00", code=1,
                        error=NO_ADDRESS)
        watch.join()
        self.assertIn("3 says STATUS SAFE, number doubled", "\n".join(lines))
        heard = "node 3: has heard its number from another node since CLEAR; 'clear 3' forgets that"
        self.assertIn(heard, self.json("map", code=1)["complaints"])
        self.assertEqual(self.json("clear", 3), {"number": 3})
        self.assertNotIn(heard, self.json("map", code=1)["complaints"])
        self.assertNotIn("number doubled", self.memory("status"))

    def test_refusals(self):
        """One line on stderr, exit code 1; the node's code in words."""
        self.memory("read", 3, "0xE00", code=1,
                    error=NO_ADDRESS)
        self.memory("write", 3, "0xF02", "01", code=1,
                    error="verican: memory: node 3 refuses at 0xF02: code 11, locked\n")
        self.memory("read", 3, "0xDF8", 20, code=1,
                    error="verican: memory: node 3 refuses at 0xDFE: code 02, illegal address\n")
        self.memory("read", 7, "0x20", code=1, timeout=50,
                    error="verican: memory: node 7 does not answer\n")
        self.memory("assign", "77", 7, code=1, timeout=50,
                    error="verican: memory: the node with serial number 00000077 does not answer\n")

    def test_poll_that_all_refuse(self):
        """Nodes 3 and 4 are there, with no memory at this address."""
        self.memory("poll", "0xDFE", "6", code=1, error=(
            "verican: memory: no node answers at 0xDFE with 6 bytes; nodes 3, 4 are there\n"))

    def test_a_number_that_is_not_taken(self):
        """A node in OPERATE is there, but takes none."""
        self.memory("state", "operate", 3)
        for number in 6, 0:
            self.memory("assign", "CAFE1234", number, code=1, timeout=1000, error=(
                "verican: memory: the node with serial number CAFE1234 is there, but does not take "
                "the number; in OPERATE it takes none, so: state safe first\n"))
        self.memory("state", "safe", 3)
        self.memory("assign", "CAFE1234", 0)

    def test_nobody_answers(self):
        """Asked in numbers of another width; on a bus without such nodes."""
        error = "verican: memory: no node answers; numbers have {} bits here, --name-bits says so\n"
        for words in (("status",), ("poll", "0x40"), ("map",), ("state", "safe")):
            self.memory("--name-bits", 5, *words, code=1, timeout=50, error=error.format(5))
        plain = "nodes:\n  - {name: a}\n"
        with Bridge("--fast", "--errors", "none", scenario=plain) as self.bridge:
            self.memory("scan", code=1, timeout=50, error=error.format(3))

    def test_watch_ends_with_its_reader(self):
        """A pipe that is closed, a device that is full."""
        command = [os.environ["VERICAN_BINARY"], "memory", "--socketcand",
                   f"127.0.0.1:{self.bridge.port}", "watch"]
        for device, code in ((None, 141), ("/dev/full", 2)):
            reader, writer = os.pipe()
            os.close(reader)
            with open(device or writer, "wb") as out:
                watch = subprocess.Popen(command, stdout=out, stderr=subprocess.PIPE)
            if device:
                os.close(writer)
            while watch.poll() is None:
                self.memory("read", 3, "0x40", 2)
            self.assertEqual(watch.returncode, code)
            said = watch.stderr.read().decode()
            if device:
                self.assertIn("No space left", said)
            else:
                self.assertEqual(said, "")
            watch.stderr.close()

    def test_arguments(self):
        """Exit code 2, and what is allowed."""
        for words, error in (
                (("read", 8, 0), "node: '8' is not allowed; allowed: 2 to 7"),
                (("read", "03", 0), "node: '03' is not allowed; allowed: 2 to 7 without zeros in "
                                    "front"),
                (("write", "010", 0, "1"), "node: '010' is not allowed; allowed: 2 to 7 without "
                                           "zeros in front, all"),
                (("write", "no", 0, "1"), "node: 'no' is not allowed; allowed: 2 to 7, all"),
                (("write", 3, 0, "5AG1"), "bytes: '5AG1' is not allowed; allowed: hexadecimal "
                                          "bytes of two digits, 5A 01 or 5A01"),
                (("write", 3, 0, "01", "2", "3"), "bytes: '2' is not allowed; allowed: hexadecimal "
                                                  "bytes of two digits, 5A 01 or 5A01"),
                (("read", 3, "0xFFF", 2), "length: '2' is not allowed; allowed: 1 to 1 from 0xFFF "
                                          "on"),
                (("poll", 0, 7), "length: '7' is not allowed; allowed: 1 to 6"),
                (("assign", "xyz", 3), "serial: 'xyz' is not allowed; allowed: up to 8 "
                                       "hexadecimal digits"),
                (("assign", "5", 1), "number: '1' is not allowed; allowed: 0 (none), 2 to 7")):
            self.memory(*words, code=2, error=f"verican: {error}\n")


class SharedNumbers(OnBridge):
    """RN-11, RN-26, RN-95: two nodes of different profiles with one number, beside another node."""

    nodes = """bitrate: 250k
nodes:
  - {name: a, type: remote, number: 7, serial: 1, profile: small}
  - {name: b, type: remote, number: 7, serial: 0x82345678, profile: standard}
  - {name: c, type: remote, number: 6, serial: 6, memory: {0x40: 06}}
"""

    def test_scan(self):
        """Finds each of them, again and again: the two become error passive on the way."""
        self.assertEqual([line.split(": ", 3)[3] for line in self.bridge.warnings], [
            "number 7 is that of 'a', 'b': their answers destroy each other\n"])
        shared = "number 7: the nodes with serial numbers 00000001, 82345678 have it"
        for _ in range(3):
            seen = self.json("scan", code=1, timeout=500)
            self.assertEqual([(n["number"], n["serial"], n["doubled"]) for n in seen["nodes"]],
                             [(6, 6, False), (7, 1, True), (7, 0x82345678, True)])
            self.assertEqual(seen["complaints"], [shared])
        for words in ("scan",), ("status",), ("map",):
            self.assertIn(f"\nwrong: {shared}\n", self.memory(*words, code=1, timeout=500))
        self.assertIn("   7  00000001\n", self.memory("scan", code=1, timeout=500))

    def test_repair(self):
        """One of them gets another number; then the others forget what they have heard."""
        self.memory("assign", "1", 7, code=1, timeout=500, error=IN_USE)
        self.memory("assign", "1", 5)
        seen = self.json("scan", timeout=500)
        self.assertEqual([(n["number"], n["serial"]) for n in seen["nodes"]],
                         [(5, 1), (6, 6), (7, 0x82345678)])
        for number in 5, 6, 7:
            self.memory("clear", number)
        self.assertEqual(self.json("map", timeout=500)["complaints"], [])

    def test_same_serial_number(self):
        """Two nodes with one serial number: `assign` means both."""
        nodes = self.nodes.replace("number: 7, serial: 1,", "number: 5, serial: 1,")
        nodes = nodes.replace("0x82345678", "1")
        with Bridge("--fast", "--errors", "none", scenario=nodes) as self.bridge:
            self.assertEqual([line.split(": ", 3)[3] for line in self.bridge.warnings], [
                "serial number 0x00000001 is that of 'a', 'b': ASSIGN means all of them\n"])
            self.assertEqual(self.json("scan", code=1, timeout=500)["complaints"],
                             ["serial number 00000001: the nodes with numbers 5, 7 have it"])


def kernel_has_can():
    """True if CAN sockets can be opened."""
    try:
        socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
    except OSError as error:
        return error.errno not in (errno.EAFNOSUPPORT, errno.EPROTONOSUPPORT)
    return True


class WithoutABus(unittest.TestCase):
    """What is wrong with the way to the bus."""

    def fails(self, *options):
        """The message."""
        done = subprocess.run([os.environ["VERICAN_BINARY"], "memory", *options],
                              capture_output=True, text=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.stderr

    def test_ways_that_are_none(self):
        """Neither, both, nobody there, no such interface, another server."""
        self.assertIn("either --if or --socketcand", self.fails("scan"))
        self.assertIn("excludes", self.fails("--if", "a", "--socketcand", "1", "scan"))
        self.assertIn("--if: 'nocan0': No such device" if kernel_has_can() else
                      "--if: this kernel has no CAN sockets; load the modules can and can-raw, or "
                      "use --socketcand", self.fails("--if", "nocan0", "scan"))
        self.assertIn("'127.0.0.1:no'", self.fails("--socketcand", "127.0.0.1:no", "scan"))
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]

            def answer():
                with server.accept()[0] as client:
                    client.sendall(b"< bye >")
                    client.recv(100)

            thread = threading.Thread(target=answer)
            thread.start()
            self.assertIn("says 'bye'; allowed: socketcand",
                          self.fails("--socketcand", f"127.0.0.1:{port}", "scan"))
            thread.join()
            thread = threading.Thread(target=lambda: server.accept()[0].close())
            thread.start()
            self.assertIn("says nothing; allowed: socketcand",
                          self.fails("--socketcand", f"127.0.0.1:{port}", "scan"))
            thread.join()
        self.assertIn("nobody answers", self.fails("--socketcand", f"127.0.0.1:{port}", "scan"))

    def test_the_complaint_of_a_server(self):
        """It is told behind what did not work."""
        complaint = b"< error this client reads too slowly >"
        self.assertEqual(self.read_from(complaint, self.wait_for_the_end), (
            1, "verican: memory: node 6 does not answer; the server says: this client reads too "
               "slowly\n"))

    def test_error_frames(self):
        """They are counted, and no complaint of the server."""
        frames = b"< error 20000288 12.000345 0000040A00000008 >< error 20000204 13 0 >"
        for said, told in ((frames, "; 2 error frames on the bus"),
                           (frames[:50], "; 1 error frame on the bus"),
                           (b"< error 20000288 nodes >" + frames[:50],
                            "; the server says: 20000288 nodes; 1 error frame on the bus")):
            self.assertEqual(self.read_from(said, self.wait_for_the_end), (
                1, f"verican: memory: node 6 does not answer{told}\n"))

    def test_a_server_that_talks_without_end(self):
        """Extended frames are passed over, but not longer than the time-out."""
        def talk(client):
            end = time.monotonic() + 10
            while time.monotonic() < end:
                client.sendall(1000 * b"< frame 12345678 1.000000 00 >")

        self.assertEqual(self.read_from(b"", talk),
                         (1, "verican: memory: node 6 does not answer\n"))

    def test_a_server_whose_messages_have_no_end(self):
        """What is no message does not make a time-out longer, be it much or little at a time."""
        for part, pause in ((1000 * b"< ", 0), (b"x", 0.02)):
            def talk(client, part=part, pause=pause):
                while True:  # until the tool leaves
                    client.sendall(part)
                    time.sleep(pause)

            self.assertEqual(self.read_from(b"", talk),
                             (1, "verican: memory: node 6 does not answer\n"))

    def test_a_scan_that_everybody_answers(self):
        """HERE behind each SELECT (functions 2 and 4): so many nodes are not on a bus."""
        def serve(client):
            while request := client.recv(4096):
                count = len(re.findall(rb"< send 0*[24] 8 ", request))
                client.sendall(count * b"< frame 402 1.0  >")

        self.assertEqual(self.read_from(b"", serve, "scan"),
                         (1, "verican: memory: more than 256 nodes answer\n"))

    def test_states(self):
        """Told as carried out is what STATUS says behind the command; a node that restarts may be
        in OPERATE if it goes there by itself (RN-70)."""
        for command, state, flags, error in (
                ("operate", 3, 5, ""), ("safe", 2, 5, ""), ("restart", 2, 5, ""),
                ("restart", 3, 0x0D, ""),
                ("operate", 2, 0x0D, "node 6 is in SAFE, not in OPERATE"),
                ("safe", 3, 0x0D, "node 6 is in OPERATE, not in SAFE"),
                ("restart", 3, 5, "node 6 is in OPERATE, not in SAFE")):
            for node in "6", "all":
                self.assertEqual(
                    self.read_from(b"", lambda client, memory={0xF01: flags, 0xFF0: state}:
                                   self.answer_reads(client, memory), "state", command, node),
                    (1 if error else 0, f"verican: memory: {error}\n" if error else ""))

    @staticmethod
    def wait_for_the_end(client):
        """Takes what the client says, and answers nothing."""
        while client.recv(100):
            pass

    @staticmethod
    def answer_reads(client, memory):
        """As node 6 with these bytes, the others 0, for READ to it and to all."""
        while request := client.recv(4096):
            for low, high, n in re.findall(rb"< send (?:378|0F8) 3 (\w\w) (\w\w) (\w\w) >",
                                           request):
                first = int(high + low, 16)
                data = bytes(memory.get(first + i, 0) for i in range(int(n, 16)))
                client.sendall(b"< frame 778 1.0 %s%s%s >" % (low, high, data.hex().encode()))

    def read_from(self, greeting, serve, *words):
        """Exit code and message of a read, or other words, by way of a server that says `greeting`
        behind the first ones, and then does what `serve(client)` does."""
        with socket.create_server(("127.0.0.1", 0)) as server:
            def answer():
                with contextlib.suppress(OSError), server.accept()[0] as client:
                    client.sendall(b"< hi >< ok >< ok >" + greeting)
                    serve(client)

            thread = threading.Thread(target=answer)
            thread.start()
            done = subprocess.run(
                [os.environ["VERICAN_BINARY"], "memory", "--timeout", "50", "--socketcand",
                 f"127.0.0.1:{server.getsockname()[1]}", *(words or ("read", "6", "0"))],
                capture_output=True, text=True, timeout=PATIENCE, check=False)
            thread.join()
        return done.returncode, done.stderr

    def test_options(self):
        """CLI11's own checks, and those of numbers and names."""
        self.assertIn("--bus-name requires --socketcand",
                      self.fails("--if", "can0", "--bus-name", "can0", "scan"))
        self.assertIn("'a > < b' is not allowed", self.fails(
            "--socketcand", "1", "--bus-name", "a > < b", "scan"))
        self.assertIn("'010' is not allowed; allowed: decimal without zeros in front",
                      self.fails("--socketcand", "1", "read", "6", "010"))
        for count in ("0", "0x0", "-3"):
            self.assertIn(f"'{count}' is not allowed; allowed: ",
                          self.fails("--socketcand", "1", "watch", "--frames", count))
        self.assertIn("--name-bits", self.fails("--name-bits", "4", "scan"))
        self.assertIn("subcommand", self.fails())
        for words, error in (
                (("trigger", "256"), "count: '256' is not allowed; allowed: 0 to 255"),
                (("read", "3", "0x1000"), "address: '0x1000' is not allowed; allowed: 0 to 0xFFF"),
                (("read", "3", "0", "0"), "length: '0' is not allowed; allowed: 1 to 4096"),
                (("state", "on"), "command: 'on' is not allowed; allowed: operate, safe, restart"),
                (("--name-bits", "4", "scan"), "--name-bits: '4' is not allowed; allowed: 3, 5")):
            self.assertIn(f"verican: {error}", self.fails("--if", "x", *words))


if __name__ == "__main__":
    assert os.environ["VERICAN_BINARY"]
    unittest.main()
