# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes over python-can, on nodes of the simulated bus by
`verican bridge --socketcand` (RN-92, RN-93). Run by ctest, one case each:
VERICAN_BINARY=build/release/verican python3 -m unittest python_client_cases.Golden.test_vectors
"""
import array
import os
import pathlib
import sys
import time
import unittest

import can
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "sw/remote"), str(ROOT / "tb/socketcan")]

import verican_remote as remote  # noqa: E402  pylint: disable=wrong-import-position
from socketcand_bridge import Bridge  # noqa: E402  pylint: disable=wrong-import-position

# Longer than the client's own: the simulation shares the computer with others.
TIMEOUT = 5.0


def scenario(*nodes):
    """A bus at 500 kbit/s with remote nodes, each given by its keys."""
    text = "bitrate: 500k\nnodes:\n"
    for i, keys in enumerate(nodes):
        text += f"  - {{name: unit{i}, type: remote, {keys}}}\n"
    return text


class Lossy:
    """A python-can bus that loses frames: those for which `loses(message, sent)` is true. What is
    received is as `heard(message)` says, twice with `doubled`."""

    def __init__(self, bus):
        self.bus, self.loses, self.sent = bus, lambda message, sent: False, []
        self.heard, self.doubled, self._again = lambda message: message, False, None

    def send(self, message, timeout=None):
        """As can.Bus."""
        self.sent.append(message)
        if not self.loses(message, True):
            self.bus.send(message, timeout)

    def recv(self, timeout=None):
        """As can.Bus."""
        if self._again:
            message, self._again = self._again, None
            return message
        until = time.monotonic() + timeout
        while True:
            message = self.bus.recv(max(0.0, until - time.monotonic()))
            if message is None:
                return None
            if not self.loses(message, False):
                message = self.heard(message)
                self._again = message if self.doubled else None
                return message


class OnBus(unittest.TestCase):
    """A client on a bus with remote nodes."""

    def open(self, *nodes, name_bits=3, **options):
        """Starts the bus; self.client and, between it and python-can, self.link."""
        self.bridge = self.enterContext(
            Bridge("--fast", "--errors", "none", scenario=scenario(*nodes), clients=1))
        bus = self.enterContext(can.Bus(interface="socketcand", channel="can0", host="127.0.0.1",
                                        port=self.bridge.port))
        self.connect(bus, name_bits, **({"rtr": "never"} | options))
        for _ in nodes:
            bus.recv(TIMEOUT)  # BOOT

    def connect(self, bus, name_bits, **options):
        """self.client on a bus of python-can and, between the two, self.link."""
        self.link = Lossy(bus)
        # As the client would find without the losses in between.
        Lossy.__module__ = type(bus).__module__
        options = {"timeout": TIMEOUT, "select_wait": 0.5} | options
        self.client = remote.Client(self.link, name_bits, **options)

    def enterContext(self, manager):  # pylint: disable=invalid-name
        """As unittest has it from Python 3.11 on."""
        value = manager.__enter__()
        self.addCleanup(manager.__exit__, None, None, None)
        return value


def frame_of(text):
    """A frame as cansend has it."""
    identifier, data = text.split("#")
    if data.startswith("R"):
        return can.Message(arbitration_id=int(identifier, 16), is_remote_frame=True,
                           dlc=int(data[1:] or 0), is_extended_id=False)
    return can.Message(arbitration_id=int(identifier, 16), data=bytes.fromhex(data),
                       is_extended_id=len(identifier) == 8)


def hexadecimal(text):
    """Bytes as the vectors have them."""
    return bytes.fromhex(text.replace(" ", ""))


class Vectors(OnBus):
    """sw/remote/vectors.yaml on any bus."""

    sends_remote_frames = False  # whether the bus takes them
    features = {"small": {"stage"}}  # of nodes of a profile; others have all

    def lives(self):
        """The lives of nodes that the vectors tell of."""
        text = (ROOT / "sw/remote/vectors.yaml").read_text(encoding="utf-8")
        return yaml.safe_load(text)["lives"]

    def run_life(self, life, profile):
        """The vectors that a node of the profile can run."""
        self.profile, self.number = profile, life["number"]
        for vector in life["vectors"]:
            needs = set(vector.get("needs", ()))
            if not needs <= self.features.get(profile, needs):
                continue
            with self.subTest(vector=vector["vector"], what=vector["what"]):
                self.carry_out(vector)

    def carry_out(self, vector):
        """One vector."""
        if "calls" not in vector:
            for step in vector["steps"]:
                self.frames(step)
        self.link.sent.clear()
        for call in vector.get("calls", ()):
            self.call(**call)
        wanted = [frame_of(step["send"]) for step in vector["steps"]]
        if "calls" in vector and not any(frame.is_remote_frame for frame in wanted):
            self.assertEqual(*([(frame.arbitration_id, bytes(frame.data)) for frame in frames]
                               for frames in (wanted, self.link.sent)))
        self.number = vector.get("number", self.number)
        for address, data in vector.get("memory", {}).items():
            wanted = hexadecimal(data)
            self.assertEqual(self.client.read(self.number, address, len(wanted)), wanted)
        row = self.client.read(self.number, 0xFF0, 8)
        for byte, wanted in zip(row, vector["status"].split()):
            self.assertIn(wanted, ("--", f"{byte:02X}"), f"STATUS {row.hex(' ')}")

    def frames(self, step):
        """The frame of a step, and its answers. A remote frame, which socketcand does not send, is
        a request for STATUS: READ gives the same."""
        frame = frame_of(step["send"])
        if frame.is_remote_frame and not self.sends_remote_frames:
            row = self.client.read(self.number, 0xFF0, 8)
            self.assertEqual(row, bytes(frame_of(step["answers"][0]).data))
            return
        self.link.send(frame)
        answers = step.get("answers", ())
        answers = answers[self.profile] if isinstance(answers, dict) else answers
        for wanted in map(frame_of, answers):
            message = self.link.recv(TIMEOUT)
            self.assertEqual((message.arbitration_id, bytes(message.data)),
                             (wanted.arbitration_id, bytes(wanted.data)))

    def call(self, do=None, frame=None, gives=None, **keys):
        """A call as the vectors name it."""
        client = self.client
        if isinstance(gives, dict) and self.profile in gives:
            gives = gives[self.profile]
        data = hexadecimal(keys["data"]) if "data" in keys else None
        if frame:
            self.link.send(frame_of(frame))
        elif do == "write":
            client.write(keys["node"], keys["address"], data)
        elif do == "read":
            self.assertEqual(client.read(keys["node"], keys["address"], keys["length"]),
                             hexadecimal(gives))
        elif do == "status":
            self.assertEqual(client.status(keys["node"]), remote.Status.of(hexadecimal(gives)))
        elif do == "identity":
            self.assertEqual(client.identity(keys["node"]),
                             remote.Identity.of(keys["node"], hexadecimal(gives)))
        elif do == "state":
            client.state({"operate": remote.OPERATE, "safe": remote.SAFE}[keys["command"]],
                         keys["node"])
        elif do == "trigger":
            client.trigger(keys["count"])
        elif do == "poll":
            self.assertEqual(client.poll(keys["address"], keys["length"], gives),
                             {number: hexadecimal(text) for number, text in gives.items()})
        elif do == "select":
            self.assertEqual(client.select(keys["value"], keys["mask"]), gives == "here")
        elif do == "block_read":
            client.tag = keys["tag"] - 1
            self.assertEqual(client.block_read(keys["node"], keys["address"], keys["length"]),
                             hexadecimal(gives))
        elif do == "block_write":
            client.tag = keys["tag"] - 1
            client.block_write(keys["node"], keys["address"], data)
        else:
            self.fail(f"no call {do}")


class Golden(Vectors):
    """The vectors through socketcand (RN-92, RN-93)."""

    def test_vectors(self):
        """Every vector: as a call where it is one, else its frames; what they give, and STATUS."""
        self.run_vectors("full")

    def test_vectors_on_the_rtl(self):
        """RN-93: the vectors of profile small on can_remote itself."""
        self.run_vectors("small", "made_of: rtl, ")

    def test_vectors_on_the_rtl_of_profile_full(self):
        """RN-93: those of blocks, too."""
        self.run_vectors("full", "made_of: rtl, ")

    def run_vectors(self, profile, keys=""):
        """The vectors of a profile, each life on a bus of its own."""
        for life in self.lives():
            self.open(f"{keys}profile: {profile}, number: {life['number']}, "
                      f"name_bits: {life['name_bits']}, serial: 0x{life['serial']:X}",
                      name_bits=life["name_bits"])
            self.run_life(life, profile)


class Calls(OnBus):
    """What the calls do beyond the vectors."""

    def setUp(self):
        self.open("number: 3, serial: 0xCAFE1233", "number: 4, serial: 0xCAFE1234, profile: small")
        for number in (3, 4):
            self.client.status(number)  # from now on refusals are known at once
        self.link.sent.clear()

    def sent(self):
        """Identifiers sent since the last look."""
        ids = [message.arbitration_id for message in self.link.sent]
        self.link.sent.clear()
        return ids

    def test_long_accesses_are_split(self):
        """At the window, at eight bytes there and six beyond."""
        data = bytes(range(1, 41))
        self.client.write(3, 0x60, data)
        self.assertEqual(self.sent(), [0x1E0, 0x1E8, 0x1F0, 0x1F9, 0x1F9, 0x1F9])
        self.assertEqual(self.client.read(3, 0x60, 40), data)
        self.assertEqual(self.sent(), 7 * [0x1F8])

    def test_confirmed_writes(self):
        """1,000 bytes, with a frame lost on the way."""
        lost = [1]
        self.link.loses = lambda message, sent: message.arbitration_id == 0x1F9 and lost.pop()
        data = bytes(i % 251 for i in range(1000))
        lost[:] = [False] * 1000
        lost[-30] = True
        self.client.write_confirmed(3, 0x100, data)
        self.link.loses = lambda message, sent: False
        self.assertEqual(self.client.read(3, 0x100, 1000), data)

    def test_refusals(self):
        """They have their code, and the client goes on."""
        for act, code in ((lambda: self.client.read(3, 0xE00, 1), 0x02),
                          (lambda: self.client.write_confirmed(3, 0xF02, b"\1"), 0x11),
                          (lambda: self.client.write_confirmed(3, 0xFF0, b"\1"), 0x10),
                          (lambda: self.client.block_read(4, 0x20, 1), 0x01),
                          (lambda: self.client.block_read(3, 0xE00, 1), 0x02),
                          (lambda: self.client.block_write(3, 0xF00, b"\1"), 0x11)):
            with self.assertRaises(remote.Refused) as refused:
                act()
            self.assertEqual(refused.exception.code, code)
        self.assertEqual(self.client.read(3, 0x20, 1), b"\0")

    def test_where_a_transfer_ends(self):
        """A refusal names node and address; what comes before it has been done."""
        for act, text in (
                (lambda: self.client.read(3, 0xDF2, 32),
                 "node 3 refuses at 0xDFE: code 02, illegal address"),
                (lambda: self.client.write_confirmed(3, 0xA00, bytes(1100)),
                 "node 3 refuses at 0xC58: code 02, illegal address"),
                (lambda: self.client.configure(3, 0xCAFE1233, {0xF18: b"pfc", 0xF30: b"\0"}),
                 "node 3 refuses at 0xF30: code 02, illegal address")):
            with self.assertRaises(remote.Refused) as refused:
                act()
            self.assertEqual(str(refused.exception), text)
            self.assertEqual(refused.exception.number, 3)
        self.assertEqual(refused.exception.address, 0xF30)
        self.assertEqual(self.client.read(3, 0xF18, 3), b"pfc")

    def test_tries(self):
        """A node that is not there is asked three times; an answer that is lost, once more."""
        self.client.timeout = 0.1
        with self.assertRaises(remote.Timeout):
            self.client.read(2, 0x20, 1)
        self.assertEqual(self.sent(), 3 * [0x178])
        self.client.timeout = 1
        lost = [True]
        self.link.loses = lambda message, sent: not sent and bool(lost) and lost.pop()
        self.assertEqual(self.client.read(3, 0x20, 1), b"\0")

    def test_a_busy_node_is_asked_again(self):
        """Its queue of one answer is full while requests follow each other."""
        for _ in range(20):
            self.link.send(frame_of("278#300001"))
        self.sent()
        self.assertEqual(self.client.read(4, 0x20, 1), b"\0")
        self.assertGreater(len(self.sent()), 1)

    def test_polls(self):
        """All nodes at one moment; a node that does not answer is missed."""
        self.client.write(3, 0x40, b"\3")
        self.client.write(4, 0x40, b"\4")
        self.assertEqual(self.client.poll(0x40, 1, (3, 4)), {3: b"\3", 4: b"\4"})
        self.client.timeout = 0.5
        self.assertEqual(self.client.poll(0x40, 1), {3: b"\3", 4: b"\4"})
        with self.assertRaises(remote.Timeout):
            self.client.poll(0x40, 1, (3, 5))
        with self.assertRaisesRegex(remote.Timeout, r"no answer of \[5\]"):
            self.client.poll(0x40, 1, iter((3, 5)))

    def test_configure(self):
        """Unlocks, writes, locks; locks again after a refusal."""
        self.client.configure(3, 0xCAFE1233, [(0xF18, b"pfc"), (0xF02, b"\x14\0")])
        self.assertEqual(self.client.read(3, 0xF18, 3), b"pfc")
        self.assertFalse(self.client.status(3).unlocked)
        with self.assertRaises(remote.Refused):
            self.client.configure(3, 0xCAFE1233, [(0xF30, b"\0")])
        self.assertFalse(self.client.status(3).unlocked)
        with self.assertRaises(remote.Refused) as refused:
            self.client.configure(3, 0xCAFE1234, [(0xF18, b"pfc")])
        self.assertEqual(refused.exception.code, 0x11)

    def test_blocks(self):
        """Both ways, with each frame lost once."""
        data = bytes(range(40))
        self.client.timeout = 0.5
        for loss in range(1, 7):
            for identifier, sent in ((0x1FB, True), (0x5FB, False)):
                count = [0]

                def loses(message, is_sent, count=count, key=(identifier, sent), loss=loss):
                    if (message.arbitration_id, is_sent) != key:
                        return False
                    count[0] += 1
                    return count[0] == loss

                self.link.loses = loses
                shown = bytes((byte + loss) % 256 for byte in data)
                self.client.block_write(3, 0x300, shown)
                self.assertEqual(self.client.block_read(3, 0x300, 40), shown)

    def test_blocks_doubled(self):
        """What nodes say comes twice (VA-03)."""
        self.link.doubled = True
        self.client.block_write(3, 0x300, bytes(range(40)))
        self.assertEqual(self.sent(), [0x1FA] + 6 * [0x1FB])
        self.assertEqual(self.client.block_read(3, 0x300, 40), bytes(range(40)))

    def test_blocks_that_promise_too_much(self):
        """Done, though nothing was opened; more bytes than were asked for."""
        self.client.timeout = 0.5

        def changed(message):
            if message.arbitration_id == 0x5FA and message.data[2] == 5:
                message.data[2:6] = bytes(4)
            if message.arbitration_id == 0x5FB:
                message.data, message.dlc = message.data + b"\xFF", message.dlc + 1
            return message

        self.link.heard = changed
        with self.assertRaises(remote.Sequence):
            self.client.block_write(3, 0x300, b"\1\2\3")
        with self.assertRaises(remote.Sequence):
            self.client.block_read(3, 0x300, 4)

    def test_blocks_given_up(self):
        """Lost in every try: Sequence; nobody there: Timeout."""
        self.client.timeout = 0.3
        self.link.loses = lambda message, sent: (
            message.arbitration_id in (0x1FB, 0x5FB) and message.data[0] == 1)
        with self.assertRaises(remote.Sequence):
            self.client.block_read(3, 0x300, 40)
        with self.assertRaises(remote.RemoteError):
            self.client.block_write(3, 0x300, bytes(40))
        with self.assertRaises(remote.Timeout):
            self.client.block_read(2, 0x300, 40)

    def test_arguments(self):
        """Nothing is sent for what cannot be. Data of words have more bytes than elements."""
        client = self.client
        words = array.array("H", [1, 2])
        for write in (client.write, client.write_confirmed, client.block_write):
            with self.subTest(write.__name__):
                self.assertRaisesRegex(ValueError, "^4 bytes from 0xFFE on: allowed are 1 to 2$",
                                       write, 3, 0xFFE, words)
                self.assertRaisesRegex(ValueError, "^data 5: allowed are bytes", write, 3, 0, 5)
        for act in (lambda: client.read(1, 0, 1), lambda: client.read(8, 0, 1),
                    lambda: client.read(3, 0, 0), lambda: client.read(3, 0xFFF, 2),
                    lambda: client.write(0, 0, b"\0"), lambda: client.write(3, 0, b""),
                    lambda: client.poll(0x40, 7), lambda: client.trigger(256),
                    lambda: client.state(3), lambda: client.state(remote.SAFE, 8),
                    lambda: client.assign(0, 1), lambda: client.assign(1 << 32, 3),
                    lambda: client.select(-1), lambda: client.select(0, 1 << 32),
                    lambda: client.configure(3, -5, []),
                    lambda: client.block_write(3, 0xFFF, b"\0\0"),
                    lambda: remote.Client(self.link, 4),
                    lambda: remote.Client(self.link, tries=0),
                    lambda: remote.Client(self.link, timeout=0),
                    lambda: remote.Client(self.link, select_wait=-1),
                    lambda: remote.Client(self.link, rtr="maybe")):
            self.assertRaises(ValueError, act)
        for act, text in (
                (lambda: client.read(3, 0, 0), "0 bytes from 0x000 on: allowed are 1 to 4096"),
                (lambda: client.read(3, 0x1000, 1), "address 4096: allowed are 0 to 0xFFF"),
                (lambda: client.assign(163, 9), "number 9: allowed are 0, 2 to 7"),
                (lambda: client.write(9, 0, b"\1"), "number 9: allowed are 1, 2 to 7"),
                (lambda: client.read(9, 0, 1), "number 9: allowed are 2 to 7")):
            self.assertRaisesRegex(ValueError, f"^{text}$", act)
        self.assertEqual(self.sent(), [])

    def test_remote_frames(self):
        """python-can's socketcand cannot send them, other interfaces can: `auto` knows."""
        self.assertFalse(remote.Client(self.link.bus).remote_frames)
        with can.Bus(interface="virtual") as virtual:
            self.assertTrue(remote.Client(virtual).remote_frames)
            self.assertFalse(remote.Client(virtual, rtr="never").remote_frames)


class Nodes(OnBus):
    """Who is there."""

    def test_scan_and_assign(self):
        """Nodes with a number and without; one gets a number that is free."""
        self.open("number: 3, serial: 0xCAFE1233", "number: 4, serial: 0x00000001", timeout=1.5)
        self.assertEqual(self.scan(), [(3, 0xCAFE1233), (4, 1)])
        with self.assertRaises(remote.InUse):
            self.client.assign(0xCAFE1233, 4)
        self.client.assign(0xCAFE1233, 5)
        self.client.assign(0xCAFE1233, 5)
        self.assertEqual(self.client.identity(5).serial, 0xCAFE1233)
        self.client.assign(0xCAFE1233, 0)
        self.assertEqual(self.scan(), [(4, 1), (0, 0xCAFE1233)])
        with self.assertRaises(remote.Timeout):
            self.client.assign(0xCAFE1234, 5)

    def scan(self):
        """Numbers and serial numbers."""
        return [(node.number, node.serial) for node in self.client.scan()]

    def test_scan_of_shared_numbers(self):
        """RN-11, RN-26: found in each scan, though the two become error passive; one is given
        another number, and the other forgets what it has heard."""
        self.open("number: 7, serial: 1, profile: small", "number: 6, serial: 6",
                  "number: 7, serial: 0x82345678, profile: standard", timeout=1)
        for _ in range(3):
            self.assertEqual([(node.number, node.serial, node.doubled)
                              for node in self.client.scan()],
                             [(6, 6, False), (7, 1, True), (7, 0x82345678, True)])
        with self.assertRaises(remote.InUse):
            self.client.assign(1, 7)
        self.client.assign(1, 5)
        self.assertEqual(self.scan(), [(5, 1), (6, 6), (7, 0x82345678)])
        for number in 5, 7:
            self.client.clear(number)
            self.assertFalse(self.client.status(number).duplicate)

    def test_scan_of_several_shared_numbers(self):
        """Nobody can tell which of the nodes has which."""
        self.open("number: 7, serial: 1", "number: 7, serial: 2", "number: 3, serial: 3",
                  "number: 3, serial: 4", "number: 6, serial: 6", timeout=1)
        self.assertEqual(self.scan(), [(6, 6), (None, 1), (None, 2), (None, 3), (None, 4)])
        self.assertEqual([node.doubled for node in self.client.scan()], [False] + 4 * [True])

    def test_scan_with_a_lost_answer(self):
        """SELECT finds the node, and it is not taken for one of two."""
        self.open("number: 3, serial: 0xCAFE1233", "number: 4, serial: 0x00000001", timeout=1)
        lost = [True]
        self.link.loses = lambda message, sent: (
            not sent and message.arbitration_id == 0x678 and message.data[0] == 0xFC
            and bool(lost) and lost.pop())
        nodes = self.client.scan()
        self.assertEqual(lost, [])
        self.assertEqual([(node.number, node.serial, node.memory, node.doubled) for node in nodes],
                         [(3, 0xCAFE1233, 4096, False), (4, 1, 4096, False)])

    def test_clear(self):
        """RN-24, RN-35: another node has been heard under the number; CLEAR is lost once."""
        self.open("number: 3")
        self.link.send(frame_of("5A0#77"))
        self.assertTrue(self.client.status(3).duplicate)
        lost = [True]
        self.link.loses = lambda message, sent: (
            sent and message.arbitration_id == 0x1FC and bool(lost) and lost.pop())
        self.client.clear(3)
        self.assertEqual(lost, [])
        self.assertFalse(self.client.status(3).duplicate)

    def test_a_number_that_is_not_taken(self):
        """In OPERATE a node is there, but takes none."""
        self.open("number: 3, serial: 0xCAFE1233", timeout=0.5)
        self.client.state(remote.OPERATE)
        for number in 5, 0:
            with self.assertRaises(remote.NotTaken):
                self.client.assign(0xCAFE1233, number)

    def test_statements_are_passed_on(self):
        """What nobody waits for goes to the caller."""
        heard = []
        self.open("number: 3, config: {producers: [{send: status, length: 1, period: 20 ms}]}",
                  on_statement=lambda message: heard.append(message.arbitration_id))
        for _ in range(200):
            self.client.read(3, 0x20, 1)
            if heard:
                break
        self.assertEqual(set(heard), {0x5FE})


    def test_a_heartbeat_refuses_nothing(self):
        """It repeats the code of the last refusal for ever."""
        heard = []
        self.open("number: 3, config: {producers: [{send: status, length: 8, period: 1 ms}]}",
                  on_statement=lambda message: heard.append(message.data[3]))
        with self.assertRaises(remote.Refused):
            self.client.read(3, 0xE00, 1)
        for _ in range(100):
            self.assertEqual(self.client.read(3, 0x20, 1), b"\0")
        self.assertIn(2, heard)
        # Nor does it if there is no answer.
        self.link.loses = lambda message, sent: not sent and message.arbitration_id == 0x5F8
        self.client.timeout, self.client.tries = 0.2, 1
        for _ in range(20):
            self.assertRaises(remote.Timeout, lambda: self.client.read(3, 0x20, 1))


class RemoteFrames(OnBus):
    """What the client sends where remote frames go."""

    def test_on_a_virtual_bus(self):
        """Read, STATUS and poll are remote frames; the answers are found."""
        with can.Bus(interface="virtual", channel="vr") as bus, \
                can.Bus(interface="virtual", channel="vr") as node:
            client = remote.Client(bus, timeout=1)
            answers = {0x1A0: (0x5A0, b"\7"), 0x1FE: (0x5FE, bytes([2, 0, 0, 0, 0, 1, 0, 9]))}

            def answer(message):
                self.assertTrue(message.is_remote_frame)
                identifier, data = answers[message.arbitration_id]
                self.assertEqual(message.dlc, len(data))
                node.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))

            notifier = can.Notifier(node, [answer])
            self.assertEqual(client.read(3, 0x20, 1), b"\7")
            self.assertEqual(client.status(3).trigger, 9)
            notifier.stop()

    def test_numbers_of_no_node(self):
        """RN-03, RN-07: what looks like the answer of node 0 or 1 is somebody's statement."""
        with can.Bus(interface="virtual", channel="vn") as bus, \
                can.Bus(interface="virtual", channel="vn") as node:
            heard = []
            client = remote.Client(bus, timeout=0.2, select_wait=0.01, on_statement=heard.append)

            def answer(message):
                if message.arbitration_id == client.port(1, 0):
                    for number in 0, 1:
                        node.send(can.Message(arbitration_id=client.port(number, 0) | 0x400,
                                              data=message.data[:2] + bytes(message.data[2]),
                                              is_extended_id=False))

            notifier = can.Notifier(node, [answer])
            self.assertEqual(client.poll(0xFF8, 1), {})
            self.assertEqual(client.scan(), [])
            notifier.stop()
            self.assertEqual([message.arbitration_id for message in heard],
                             [0x478, 0x4F8, 0x478, 0x4F8])


if __name__ == "__main__":
    assert os.environ["VERICAN_BINARY"]
    unittest.main()
