#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Stage `timesync` of the campaign: section 12 of docs/time-spec.md (TM-126, TM-130).

The whole sweep in the model; on RTL the base case, buses with load and bit errors, and the
published experiment. The result goes to CAMPAIGN_OUT. CAMPAIGN_SEED is the first seed of each case;
how large an error gets with wander, in the model's sweep, is a matter of the seed. Ends with status
1 if a figure misses its bar.
"""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position

TOOL = ROOT / "build/release/verican"
GOALS = ("16 MHz", "50 MHz")  # the tables of the sweep that are section 12
FAST = ["--interval", "100ms", "--seeds", "1"]
# On RTL: name, options, intervals of a whole run.
ON_RTL = [("base", [], 260),
          ("100 % load below SYNC, bit errors 1e-4", [*FAST, "--load", "1", "--bit-errors", "1e-4"],
           200),
          ("50 % load below SYNC", [*FAST, "--load", "0.5"], 200),
          ("90 % load above SYNC", [*FAST, "--load-above", "0.9"], 200)]


def timesync(*options):
    """What `verican timesync` says in JSON; a missed goal is no failure of the tool."""
    seed = ["--first-seed", str(campaign_settings.seed())]
    done = subprocess.run([TOOL, "timesync", "--json", *seed, *options], capture_output=True,
                          text=True, check=False, cwd=ROOT)
    if done.returncode not in (0, 1):
        sys.exit(f"campaign timesync: verican timesync {' '.join(options)}: exit code "
                 f"{done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def row(name, way, outcome):
    """A line of the stage's table."""
    result, goal = outcome["result"], outcome["goal"] or {}

    def ns(value):
        return "" if value is None else f"{value / 1e3:.1f}"
    return [name, way, *(ns(result[key]) for key in ("sd_ps", "max_ps", "between_ps")),
            ns(goal.get("sd_ps")), ns(goal.get("max_ps")),
            "" if not goal else "yes" if outcome["ok"] else "no"]


def met(name, good, of):
    """A figure whose bar is all."""
    return {"name": name, "value": good, "text": f"{good} of {of}", "bar": "all", "ok": good == of}


def main():
    scale, out = campaign_settings.scale(), campaign_settings.result_file()

    def intervals(whole):
        return ["--intervals", str(max(20, round(whole * scale)))]
    sweep = timesync("--sweep", *intervals(260))
    rows = [(table["title"], outcome) for table in sweep["tables"] for outcome in table["rows"]]
    judged = [outcome for title, outcome in rows if title in GOALS]
    rtl = [(name, timesync("--how", "skip", *options, *intervals(whole)))
           for name, options, whole in ON_RTL]
    p4 = timesync("--p4", "--how", "skip", *intervals(260))
    figures = [
        met("cases of section 12 within their goals, model", sum(o["ok"] for o in judged),
            len(judged)),
        met("cases on RTL within their goals", sum(o["ok"] for _, o in rtl), len(rtl)),
        met("statements of the published experiment, RTL", sum(c["ok"] for c in p4["checks"]),
            len(p4["checks"])),
    ]
    table = {"title": "Errors of followers while locked, ns",
             "columns": ["case", "way", "sd", "max", "between", "goal sd", "goal max", "met"],
             "rows": [row(name, "skip", outcome) for name, outcome in rtl] +
                     [row(f"{title}: {o['name']}", "model", o) for title, o in rows]}
    experiment = {"title": "The published experiment, on RTL",
                  "columns": ["what", "expected", "seen"],
                  "rows": [[c["what"], c["expected"], c["seen"]] for c in p4["checks"]]}
    result = {"figures": figures, "tables": [table, experiment],
              "notes": ["Simulated: transceivers and cables come on top."]}
    for figure in figures:
        print(f"{figure['name']}: {figure['text']}")
    return campaign_settings.write_result(out, result)


if __name__ == "__main__":
    sys.exit(main())
