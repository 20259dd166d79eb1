# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The Python client of remote nodes where a frame always waits: on a full bus with a slow host,
beside a node that sends without end (RN-91, RN-92).
"""
import pathlib
import sys
import types
import unittest
import unittest.mock

import can

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sw/remote"))

# pylint: disable=wrong-import-position
import verican_remote as remote  # noqa: E402
import verican_remote_link  # noqa: E402

TIMEOUT = 0.02
FRAME = 0.0001   # seconds on the bus
FOR_EVER = 5000  # frames that one call takes: then the interface is gone


def frame(identifier, *data, **keys):
    """A base frame."""
    return can.Message(arbitration_id=identifier, data=data, **{"is_extended_id": False} | keys)


class Full:
    """A python-can bus on which a frame always waits: what `following()` gives. Time is that of
    the bus: it goes by while frames and time-outs do."""

    def __init__(self):
        self.following = lambda: frame(0x5A0, 1)
        self.sent = []
        self.now = 0.0
        self.taken = 0  # frames, since the call began

    def send(self, message, timeout=None):
        """As can.Bus."""
        del timeout
        self.sent.append(message)

    def recv(self, timeout=None):
        """As can.Bus."""
        self.taken += 1
        if self.taken > FOR_EVER:
            raise can.CanOperationError("it goes on for ever")
        message = self.following()
        self.now += FRAME if message else timeout or 0.0
        return message


class Flood(unittest.TestCase):
    """Calls on that bus."""

    def setUp(self):
        self.bus = Full()
        clock = types.SimpleNamespace(monotonic=lambda: self.bus.now)
        patch = unittest.mock.patch.object(verican_remote_link, "time", clock)
        patch.start()
        self.addCleanup(patch.stop)
        self.client = remote.Client(self.bus, rtr="always", timeout=TIMEOUT, select_wait=TIMEOUT)

    def ended(self, call):
        """What a call returns that does not go on for ever."""
        self.bus.taken = 0
        return call()

    def times_out(self, call, *others):
        """It says so, or one of the others."""
        with self.assertRaises((remote.Timeout, *others)):
            self.ended(call)

    def test_every_call_ends(self):
        """With a time-out, or with what comes of an empty bus."""
        client = self.client
        for call in (lambda: client.read(4, 0x20, 4), lambda: client.status(4),
                     lambda: client.write_confirmed(4, 0x20, b"\1"),
                     lambda: client.poll(0x20, 1, (4,)), lambda: client.assign(1, 4),
                     lambda: client.block_read(4, 0x20, 40),
                     lambda: client.block_write(4, 0x20, bytes(40))):
            self.times_out(call)
        self.assertEqual(self.ended(lambda: client.poll(0x30, 1)), {})
        self.assertFalse(self.ended(lambda: client.select(1)))
        self.assertEqual(self.ended(client.scan), [])

    def test_a_scan_that_everybody_answers(self):
        """Each SELECT is answered by HERE: so many nodes are not on a bus."""
        answered = [0]

        def following():
            if len(self.bus.sent) == answered[0]:
                return None
            answered[0] = len(self.bus.sent)
            return frame(0x402)

        self.bus.following = following
        with unittest.mock.patch(f"{__name__}.FOR_EVER", 20 * FOR_EVER):
            for most, call in ((3, lambda: self.client.scan(most=3)), (256, self.client.scan)):
                with self.assertRaisesRegex(remote.TooMany, f"more than {most} nodes answer"):
                    self.ended(call)
        for most in 0, -1, 1.5, True, "3":
            with self.assertRaisesRegex(ValueError, f"most {most}: allowed are 1 and more"):
                self.client.scan(most=most)

    def test_other_frames(self):
        """Errors and extended frames are passed over, but not for ever."""
        for keys in {"is_error_frame": True}, {"is_extended_id": True}:
            self.bus.following = lambda keys=keys: frame(1, **keys)
            self.times_out(lambda: self.client.read(4, 0x20, 4))

    def test_what_waits_behind_other_frames(self):
        """It is flushed: no answer to a later request."""
        waiting = 5 * [frame(1, is_extended_id=True)] + [frame(0x5A0, 7)]
        self.bus.following = lambda: waiting.pop(0) if waiting else None
        self.times_out(lambda: self.client.read(3, 0x20, 1))

    def test_a_suspected_refusal_is_told(self):
        """At the end, because it might have been an older one."""
        told = []

        def following():
            if not self.bus.sent or told:
                return frame(0x5A0)
            told.append(True)
            return frame(0x67E, 2, 0, 0, 2, 0x78, 0, 1, 0)

        self.bus.following = following
        with self.assertRaises(remote.Refused) as refused:
            self.ended(lambda: self.client.read(4, 0xE00, 1))
        self.assertEqual(refused.exception.code, 2)

    def test_blocks_without_end(self):
        """DATA always the same, or counting (RN-40); a write that is said to be open (RN-42)."""
        for step in 0, 1:
            count = [0]

            def following(count=count, step=step):
                count[0] = (count[0] + step) % 256
                return frame(0x67B, count[0], *range(7))

            self.bus.following = following
            self.times_out(lambda: self.client.block_read(4, 0x20, 40), remote.Sequence)
        self.bus.following = lambda: frame(0x67A, 2, self.client.tag, 5, 0, 0, 0)
        self.times_out(lambda: self.client.block_write(4, 0x20, bytes(40)))


if __name__ == "__main__":
    unittest.main()
