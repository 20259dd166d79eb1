# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a stage of the campaign does of itself when it is cut into shards (docs/cluster.md).

CAMPAIGN_SHARD says it: "K/N": the work of shard K of N, whose results go to a file in
CAMPAIGN_DIR/shards; "merge/N": the figures from these files; unset: all of it at once.
tb/harness/shard.hpp is the same for programs in C++.
"""
import json
import os
import re
import sys
from pathlib import Path


class Shard:
    """The part of this process."""

    def __init__(self, text=None):
        """text: as CAMPAIGN_SHARD, which is the default."""
        text = os.environ.get("CAMPAIGN_SHARD", "") if text is None else text
        match = re.fullmatch(r"(\d+|merge|prepare)/(\d+)", text)
        if text and (not match or int(match[2]) < 1
                     or (match[1].isdigit() and int(match[1]) >= int(match[2]))):
            sys.exit(f"CAMPAIGN_SHARD is '{text}'; allowed: K/N with K below N, prepare/N, merge/N")
        self.kind = "whole" if not text else "part" if match[1].isdigit() else match[1]
        self.count = int(match[2]) if text else 1
        self.number = int(match[1]) if self.kind == "part" else 0

    def mine(self, items):
        """Of a list that all shards have in the same order, what this one does."""
        return items[self.number::self.count] if self.kind == "part" else items

    def path(self, directory, number=None):
        """The file of a shard, this one by default."""
        number = self.number if number is None else number
        return Path(directory) / "shards" / f"{number}-of-{self.count}.json"

    def write(self, directory, data):
        """Leaves this shard's results, whole or not at all."""
        path = self.path(directory)
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_suffix(".new")
        temporary.write_text(json.dumps(data) + "\n", encoding="utf-8")
        temporary.replace(path)

    def read(self, directory):
        """The results of all shards, in their order; ends the program if one is missing."""
        paths = [self.path(directory, number) for number in range(self.count)]
        missing = [path.name for path in paths if not path.exists()]
        if missing:
            sys.exit(f"merge: {len(missing)} of {self.count} shards are missing in "
                     f"{paths[0].parent}, the first is {missing[0]}")
        return [json.loads(path.read_text(encoding="utf-8")) for path in paths]
