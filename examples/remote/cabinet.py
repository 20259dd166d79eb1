#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The cabinet of docs/remote.md: runs cabinet.yaml, or a variant of it, and prints what was
measured beside what CANopen and Modbus RTU come to.

    examples/remote/cabinet.py --verican build/release/verican [--variant plug] [--rounds 1000]
        [-- further options of verican run]

Exit code: that of `verican run`.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import yaml

HERE = pathlib.Path(__file__).resolve().parent
NODES = 5


def scenario(variant, rounds):
    """The scenario as a dictionary."""
    cabinet = yaml.safe_load((HERE / "cabinet.yaml").read_text(encoding="utf-8"))
    if variant:
        change = yaml.safe_load((HERE / "variants.yaml").read_text(encoding="utf-8"))[variant]
        rounds = rounds or change["rounds"]
        cabinet.update({key: change[key] for key in ("name", "duration", "faults", "expect")})
    elif rounds:
        last = (rounds - 1).to_bytes(2, "little").hex(" ").upper()
        cabinet["duration"] = f"{rounds + 10} ms"
        cabinet["expect"] |= {"triggers": rounds,
                              "memory": {"stage1": {0x10: last}, "dab": {0x18: last}}}
    if rounds:
        cabinet["commands"][1]["count"] = rounds
    return cabinet


def frame_bits(data, worst=True):
    """Bits of a base frame with its intermission: at worst, or without stuff bits."""
    return 47 + 8 * data + ((34 + 8 * data - 1) // 4 if worst else 0)


def modbus_ms(pause_characters=None):
    """FC23 to each node at 115,200 bit/s, 8E1, 11 bits a character: 24 characters and two pauses,
    of 1.75 ms (which the standard allows above 19,200 bit/s) or of so many characters."""
    character = 11 / 115.2
    pause = 1.75 if pause_characters is None else pause_characters * character
    return NODES * (24 * character + 2 * pause)


def ns(picoseconds):
    """For people."""
    return f"{picoseconds / 1000:,.0f} ns"


def us(picoseconds):
    """For people."""
    return f"{picoseconds / 1e6:,.0f} us"


def rows(run):
    """What is measured, what is computed."""
    remote = run["remote"]
    own = frame_bits(8) + frame_bits(2) + frame_bits(1) + NODES * frame_bits(4)
    plain = (frame_bits(8, False) + frame_bits(2, False) + frame_bits(1, False)
             + NODES * frame_bits(4, False))
    open_ = frame_bits(8) + frame_bits(2) + frame_bits(0) + NODES * frame_bits(4)
    trigger = next(m for m in run["messages"] if m["name"] == "trigger")
    answers = [n for n in remote["nodes"] if n["statements"]]
    told = [f"{us(min(n['shortest_ps'] for n in answers))} to "
            f"{us(max(n['longest_ps'] for n in answers))}" if answers else "none",
            f"bound {us(max(n['bound_ps'] or 0 for n in answers))}" if answers else ""]
    return [
        ("load of the bus at 1 ms", f"{100 * run['load']:.1f} % measured",
         f"{own / 10:.1f} % at worst, {plain / 10:.1f} % unstuffed", f"{open_ / 10:.1f} %",
         f"{modbus_ms():.1f} ms a cycle, {modbus_ms(3.5):.1f} ms with 3.5 characters"),
        ("set points act at once within", f"{ns(remote['skew_longest_ps'])} measured",
         f"bound {ns(remote['skew_bound_ps'])}", "that + interrupt and software",
         "one by one, milliseconds"),
        ("first write to end of TRIGGER", f"{us(trigger['shortest_ps'])} to "
         f"{us(trigger['longest_ps'])}", f"{frame_bits(8) + frame_bits(2) + frame_bits(1)} bits "
         "at worst, and the host", "the same frames", "2.1 to 3.6 ms"),
        ("from action to action", f"{us(remote['period_shortest_ps'])} to "
         f"{us(remote['period_longest_ps'])}", "", "not computed", "not computed"),
        ("action to end of measurement", *told, "the same frames", "not computed"),
    ]


def kinds(rtl):
    """Which of the nodes are the RTL, in words."""
    if rtl == NODES:
        return f"all {NODES} nodes are RTL"
    if rtl == 0:
        return f"all {NODES} nodes are the model of the rules on the RTL's protocol engine"
    others = NODES - rtl
    return (f"{rtl} of {NODES} nodes {'is' if rtl == 1 else 'are'} RTL; the other {others} "
            f"{'is' if others == 1 else 'are'} the model of the rules on the RTL's protocol engine")


def print_table(run):
    """The table of RN-98."""
    remote = run["remote"]
    head = ("each millisecond", "this node, measured", "this node, computed",
            "CANopen SYNC/PDO, computed", "Modbus RTU 115,200, computed")
    table = [head, *rows(run)]
    widths = [max(len(row[i]) for row in table) for i in range(len(head))]
    print(f"{run['name']}: {remote['triggers']} cycles; "
          + ", ".join(f"{key.replace('_', ' ')} {sum(n[key] for n in remote['nodes'])}"
                      for key in ("applied", "lost_set_points", "late_statements", "refused"))
          + f"; cycles above the skew's bound {remote['above_bound']}")
    print(f"  {kinds(sum(n['rtl'] for n in remote['nodes']))}")
    for row in table:
        print("  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    for node in remote["nodes"]:
        if node["went_safe"]:
            print(f"  {node['name']} left OPERATE at {node['last_safe_ps'] / 1e9:.1f} ms, "
                  f"is {node['state']} at the end")
    print("  The load is CANopen's. What is gained: no software in the nodes, and action within a "
          "bit.")
    for check in run["checks"]:
        print(f"  {'ok  ' if check['ok'] else 'FAIL'}  {check['what']}: {check['seen']} "
              f"(expected {check['expected']})")


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--verican", default="verican", help="the tool")
    parser.add_argument("--variant", choices=("plug", "noise", "stage"))
    parser.add_argument("--rounds", type=int, help="milliseconds with set points")
    parser.add_argument("options", nargs="*", help="of verican run")
    arguments = parser.parse_args()
    if arguments.rounds is not None and not 1 <= arguments.rounds <= 60000:
        parser.error("--rounds: allowed are 1 to 60000")
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
        yaml.safe_dump(scenario(arguments.variant, arguments.rounds), file)
        file.flush()
        done = subprocess.run([arguments.verican, "run", file.name, "--json", *arguments.options],
                              stdout=subprocess.PIPE, check=False)
    if done.returncode > 1:
        return done.returncode
    print_table(json.loads(done.stdout)["runs"][0])
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
