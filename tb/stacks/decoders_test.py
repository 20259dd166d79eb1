#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The readers of ISO-TP and J1939 in sw/linux: transfers written by hand after the standards, and
the same with each mistake that a stack could make."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "sw/linux"))
import isotp  # noqa: E402  pylint: disable=wrong-import-position
import j1939  # noqa: E402  pylint: disable=wrong-import-position
from frames import parse  # noqa: E402  pylint: disable=wrong-import-position


def log(text):
    """[(time in us, Frame)] of lines "ms frame"."""
    entries = []
    for line in text.split("\n"):
        if line.strip():
            time, frame = line.split()
            entries.append((round(1000 * float(time)), parse(f"(0.000000) bus {frame}").frame))
    return entries


class IsoTp(unittest.TestCase):
    """20 bytes in blocks of one frame, 1 ms apart; ISO 15765-2, 9.4 to 9.6."""

    STREAM = isotp.Stream(0x7A0, 0x7A8)
    GOOD = """
        0.0 7A0#1014000102030405
        0.2 7A8#300201
        0.4 7A0#21060708090A0B0C
        1.4 7A0#220D0E0F10111213
    """

    def found(self, text, stream=STREAM):
        return [bytes(t.data) for t in isotp.transfers(log(text), stream)]

    def broken(self, old, new, words):
        """The good transfer with one change is refused, with these words."""
        self.assertIn(old, self.GOOD)
        with self.assertRaises(isotp.Broken) as caught:
            self.found(self.GOOD.replace(old, new))
        self.assertIn(words, str(caught.exception))

    def test_what_keeps_to_the_protocol_is_put_together(self):
        self.assertEqual(self.found(self.GOOD), [bytes(range(20))])
        self.assertEqual(self.found("0 7A0#03AABBCC\n1 7A0#01DD"), [b"\xAA\xBB\xCC", b"\xDD"])
        # Wait, then a block of one and another; reserved bytes of padding count for nothing.
        text = """
            0.0 7A0#1014000102030405
            0.2 7A8#310000
            9.0 7A8#300100
            9.1 7A0#21060708090A0B0C
            9.2 7A8#30F0F9
            9.3 7A0#220D0E0F10111213
        """
        self.assertEqual(self.found(text), [bytes(range(20))])

    def test_extended_addresses(self):
        stream = isotp.Stream(0x18DB33F1, 0x18DBF133, True, 0x11, 0x22)
        text = """
            0.0 18DB33F1#1110080001020304
            0.2 18DBF133#22300000
            0.4 18DB33F1#1121050607
        """
        self.assertEqual(self.found(text, stream), [bytes(range(8))])
        with self.assertRaises(isotp.Broken):
            self.found(text.replace("#1121", "#1221"), stream)

    def test_each_mistake_is_noticed(self):
        self.broken("7A0#2106", "7A0#2206", "consecutive frame 2, not 1")
        self.broken("7A0#220D", "7A0#210D", "consecutive frame 1, not 2")
        self.broken("0.2 7A8#300201", "", "0 allowed")
        self.broken("#300201", "#300101", "0 allowed")
        self.broken("1.4 7A0", "1.3 7A0", "STmin is 1000 us")
        self.broken("1.4 7A0#220D0E0F10111213", "", "13 of 20 bytes")
        self.broken("0.4 7A0#2106", "0.3 7A8#300000\n0.4 7A0#2106", "nobody waits for")
        self.broken("#1014", "#1006", "first frame of 6 bytes")
        self.broken("0.2 7A8", "0.1 7A0#0100\n0.2 7A8", "single frame of 1 bytes")
        self.broken("#300201", "#320201", "nobody waits for")
        self.broken("7A8#30", "7A8#40", "kind 4 on 7A8")

    def test_stmin(self):
        self.assertEqual([isotp.shortest_gap(code) for code in (0, 0x7F, 0xF1, 0xF9, 0x80, 0xFA)],
                         [0, 127_000, 100, 900, 127_000, 127_000])


class J1939(unittest.TestCase):
    """16 bytes from 90 to 80 by TP; J1939-21, 5.10."""

    GOOD = """
        0.0 1CEC8090#101000030300FE00
        0.2 1CEC9080#110301FFFF00FE00
        0.4 1CEB8090#0100010203040506
        0.6 1CEB8090#020708090A0B0C0D
        0.8 1CEB8090#030E0FFFFFFFFFFF
        1.0 1CEC9080#13100003FF00FE00
    """

    def found(self, text):
        return [(m.by, m.to, m.pgn, bytes(m.data), m.aborted) for m in j1939.messages(log(text))]

    def broken(self, old, new, words):
        self.assertIn(old, self.GOOD)
        with self.assertRaises(j1939.Broken) as caught:
            self.found(self.GOOD.replace(old, new))
        self.assertIn(words, str(caught.exception))

    def test_what_keeps_to_the_protocol_is_put_together(self):
        self.assertEqual(self.found(self.GOOD), [(0x90, 0x80, 0xFE00, bytes(range(16)), None)])
        bam = """
            0 1CECFF90#20090002FFF1FE00
            50 1CEBFF90#0100010203040506
            100 1CEBFF90#020708FFFFFFFFFF
        """
        self.assertEqual(self.found(bam), [(0x90, 0xFF, 0xFEF1, bytes(range(9)), None)])
        # The receiver has enough after one packet: reason 2 (no resources).
        text = self.GOOD.split("0.6")[0] + "0.6 1CEC9080#FF02FFFFFF00FE00"
        self.assertEqual(self.found(text), [(0x90, 0x80, 0xFE00, bytes(range(7)), 2)])

    def test_extended_transport_protocol(self):
        size, data = 1792, bytes(n % 251 for n in range(1792))
        lines = ["0 1CC88090#14" + size.to_bytes(4, "little").hex() + "00FE00"]
        packets = [data[n:n + 7] for n in range(0, size, 7)]
        for first in range(0, len(packets), 255):
            part = packets[first:first + 255]
            asked = (first + 1).to_bytes(3, "little").hex()
            lines.append(f"1 1CC89080#15{len(part):02X}{asked}00FE00")
            lines.append(f"1 1CC88090#16{len(part):02X}{first.to_bytes(3, 'little').hex()}00FE00")
            lines += [f"2 1CC78090#{n:02X}{packet.hex()}" for n, packet in enumerate(part, 1)]
        lines.append("3 1CC89080#17" + size.to_bytes(4, "little").hex() + "00FE00")
        text = "\n".join(lines).replace("#", "# ").upper().replace("# ", "#")
        self.assertEqual(self.found(text), [(0x90, 0x80, 0xFE00, data, None)])
        with self.assertRaises(j1939.Broken) as caught:
            self.found(text.replace("#1601FF0000", "#1601FE0000"))
        self.assertIn("offset 254, packet 256 is due", str(caught.exception))

    def test_each_mistake_is_noticed(self):
        self.broken("#0207", "#0307", "packet 3 that nobody waits for")
        self.broken("#110301", "#110201", "packet 3 that nobody waits for")
        self.broken("#110301", "#110302", "packet 2 asked for, 1 is due")
        self.broken("#10100003", "#10100002", "2 packets for 16 bytes")
        self.broken("#10100003", "#10080003", "8 bytes announced")
        self.broken("0.8 1CEB8090#030E0FFFFFFFFFFF", "", "end after 14 of 16 bytes")
        self.broken("#131000", "#131100", "end after 16 of 16 bytes")
        self.broken("1.0 1CEC9080#13100003FF00FE00", "", "without an end")
        self.broken("0.2 1CEC9080#110301FFFF00FE00", "", "nobody waits for")
        self.broken("FFFF00FE00", "FFFF00FD00", "belongs to no message")

    def test_claims(self):
        self.assertEqual(j1939.claims(log("1 18EEFF80#010A000000000080\n2 18EAFFFE#00EE00")),
                         [(1000, 0x80, 0x8000000000000A01)])

    def test_identifiers(self):
        self.assertEqual(j1939.header(0x18FEF190), j1939.Header(6, 0xFEF1, 0xFF, 0x90))
        self.assertEqual(j1939.header(0x0D238090), j1939.Header(3, 0x12300, 0x80, 0x90))


if __name__ == "__main__":
    unittest.main()
