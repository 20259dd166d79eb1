#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A stage that adds up the numbers below 60 in shards, some of which fail when asked to."""
import argparse
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from shards import Shard  # pylint: disable=wrong-import-position


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fails-once", type=int, action="append", default=[])
    parser.add_argument("--fails", type=int, action="append", default=[])
    parser.add_argument("--bar", type=int, default=0)
    options = parser.parse_args()
    directory, shard = Path(os.environ["CAMPAIGN_DIR"]), Shard()
    prepared = directory / "prepared"
    if shard.kind == "prepare":
        prepared.write_text("")
        return 0
    if shard.kind == "part":
        again = directory / f"again-{shard.number}"
        if shard.number in options.fails or (shard.number in options.fails_once
                                             and not again.exists()):
            again.write_text("")
            return 3
        shard.write(directory, [sum(shard.mine(list(range(60)))), prepared.exists()])
        return 0
    parts = shard.read(directory) if shard.kind == "merge" else [[sum(range(60)), True]]
    total = sum(part for part, _ in parts)
    figures = [{"name": "sum", "value": total, "bar": str(options.bar), "ok": total >= options.bar},
               {"name": "shards that were prepared", "value": sum(found for _, found in parts),
                "bar": None, "ok": None}]
    Path(os.environ["CAMPAIGN_OUT"]).write_text(json.dumps({"figures": figures}))
    return 0 if total >= options.bar else 1


if __name__ == "__main__":
    sys.exit(main())
