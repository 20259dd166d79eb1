# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""verican.Frame is a value as Python knows them: compared, hashed, copied."""
import copy
import pickle
import unittest

from verican import Frame


class FrameValues(unittest.TestCase):
    """Frames are values as Python knows them."""

    FRAMES = [Frame(0x123), Frame(0x123, b"\1\2"), Frame(0x123, extended=True),
              Frame(0x55, remote=True, dlc=3), Frame(0x55, bytes(8), dlc=12)]

    def test_equal_to_frames_alone(self):
        for other in (None, 0x123, "x", object()):
            self.assertFalse(Frame(0x123) == other)
            self.assertTrue(Frame(0x123) != other)
        self.assertIn(Frame(0x123), [None, Frame(0x123)])

    def test_hash_copy_and_pickle(self):
        self.assertEqual(len(set(self.FRAMES)), len(self.FRAMES))
        for frame in self.FRAMES:
            pickles = [pickle.dumps(frame, protocol)
                       for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
            for twin in (copy.copy(frame), copy.deepcopy(frame), *map(pickle.loads, pickles)):
                self.assertEqual((twin, hash(twin), repr(twin)),
                                 (frame, hash(frame), repr(frame)))

    def test_data_of_any_kind_of_bytes(self):
        for data in (bytearray(b"abcd"), memoryview(b"abcd"), memoryview(b"a.b.c.d.")[::2]):
            self.assertEqual(Frame(1, data), Frame(1, b"abcd"))
        for data in ("abcd", [1, 2], 3):
            with self.assertRaises(TypeError):
                Frame(1, data)


if __name__ == "__main__":
    unittest.main()
