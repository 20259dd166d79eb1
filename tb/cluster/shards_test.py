#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""CAMPAIGN_SHARD as programs read it: tb/shards.py."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from shards import Shard  # pylint: disable=wrong-import-position


class Shards(unittest.TestCase):
    def test_all_shards_together_do_everything_once(self):
        for count in (1, 2, 7, 40):
            parts = [Shard(f"{n}/{count}").mine(list(range(23))) for n in range(count)]
            self.assertEqual(sorted(sum(parts, [])), list(range(23)), count)

    def test_without_shards_everything_is_done(self):
        self.assertEqual(Shard("").kind, "whole")
        self.assertEqual(Shard("").mine([1, 2, 3]), [1, 2, 3])

    def test_what_is_no_shard_is_refused(self):
        for text in ("3", "3/3", "0/0", "-1/4", "half/2", "merge", "1/2/3", "merge/0"):
            with self.subTest(text), self.assertRaises(SystemExit) as caught:
                Shard(text)
            self.assertIn(f"CAMPAIGN_SHARD is '{text}'", str(caught.exception))

    def test_results_go_to_the_merge_and_a_missing_one_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            for number in (0, 1, 3):
                Shard(f"{number}/4").write(folder, [number])
            merge = Shard("merge/4")
            with self.assertRaises(SystemExit) as caught:
                merge.read(folder)
            self.assertIn("1 of 4 shards are missing", str(caught.exception))
            self.assertIn("2-of-4.json", str(caught.exception))
            Shard("2/4").write(folder, [2])
            self.assertEqual(merge.read(folder), [[0], [1], [2], [3]])


if __name__ == "__main__":
    unittest.main()
