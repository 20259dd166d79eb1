#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The cabinet of docs/remote.md: runs cabinet.yaml, or a variant of it, and prints what was
measured beside what CANopen and Modbus RTU come to.

    examples/remote/cabinet.py --verican build/release/verican [--variant plug] [--rounds 1000]
        [-- further options of verican run]

Exit code: that of `verican run`; 2 without the tool.
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
ACCESSES = 20  # reads, and writes, on the idle bus


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


def idle_bus():
    """The same nodes without cycles: one that is read and written, each millisecond."""
    cabinet = scenario(None, 1)
    del cabinet["user"], cabinet["expect"]
    each = {"node": "host", "period": "1 ms", "count": ACCESSES}
    cabinet["commands"] = [
        each | {"at": "5 ms", "do": ["read stage1 0x40 4"]},
        each | {"at": f"{10 + ACCESSES} ms", "do": ["write stage1 0x20 round round",
                                                   "status stage1"]}]
    cabinet["duration"] = f"{20 + 2 * ACCESSES} ms"
    return cabinet


def frame_bits(data, worst=True):
    """Bits of a base frame with its intermission: at worst, or without stuff bits."""
    return 47 + 8 * data + ((34 + 8 * data - 1) // 4 if worst else 0)


def modbus_ms(characters, pauses, pause_characters=None):
    """So many characters at 115,200 bit/s, 8E1, 11 bits each, and pauses of 1.75 ms (which the
    standard allows above 19,200 bit/s) or of so many characters."""
    character = 11 / 115.2
    pause = 1.75 if pause_characters is None else pause_characters * character
    return characters * character + pauses * pause


def modbus_range(characters, pauses):
    """From pauses of 3.5 characters to those of 1.75 ms."""
    return (f"{modbus_ms(characters, pauses, 3.5):.1f} to "
            f"{modbus_ms(characters, pauses):.1f} ms")


def ns(picoseconds):
    """For people."""
    return f"{picoseconds / 1000:,.0f} ns"


def us(*picoseconds):
    """A time for people, or from one to the other."""
    return " to ".join(f"{one / 1e6:,.0f}" for one in picoseconds) + " us"


def cycle_bits(trigger=1, worst=True):
    """Two writes, a TRIGGER of so many bytes, five statements of 4 bytes."""
    return (frame_bits(8, worst) + frame_bits(2, worst) + frame_bits(trigger, worst)
            + NODES * frame_bits(4, worst))


def message(run, name):
    """Response times of commands that begin with these words; shortest and longest."""
    found = next(m for m in run["messages"] if m["name"].startswith(name))
    return found["shortest_ps"], found["longest_ps"]


def bus_rows(run):
    """Frames and load; Modbus: FC23 to each node, 24 characters and two pauses."""
    remote = run["remote"]
    bits = [remote[f"traffic_{which}_ps"] * run["bitrate"] / 1e12
            for which in ("shortest", "longest")]
    modbus = [NODES * modbus_ms(24, 2, pause) for pause in (None, 3.5)]
    return [
        ("traffic", f"{bits[0]:.0f} to {bits[1]:.0f} bits",
         f"{cycle_bits()} bits at worst, {cycle_bits(worst=False)} unstuffed",
         f"{cycle_bits(0)} bits (shared RPDOs)", f"FC23 to {NODES} nodes"),
        ("load or cycle", f"{100 * remote['cycle_load']:.1f} %",
         f"{cycle_bits() / 10:.1f} % at worst, {cycle_bits(worst=False) / 10:.1f} % unstuffed",
         f"{cycle_bits(0) / 10:.1f} %",
         f"{modbus[0]:.1f} ms, {modbus[1]:.1f} ms with pauses of 3.5 characters"),
    ]


def action_rows(run):
    """When TRIGGER acts; Modbus: a broadcast FC16 of five set points, 19 characters, one pause."""
    remote = run["remote"]
    waits, own = frame_bits(8), frame_bits(1)
    jitter = remote["latency_longest_ps"] - remote["latency_shortest_ps"]
    return [
        ("set points act at once within", ns(remote["skew_longest_ps"]),
         f"bound {ns(remote['skew_bound_ps'])}", "that + interrupt and software",
         "one by one, milliseconds"),
        ("TRIGGER to action, worst", f"{us(remote['latency_longest_ps'])}, jitter {us(jitter)}",
         f"{own} + {waits} bits = {own + waits} us, jitter {waits} us", "the same frames",
         modbus_range(19, 1)),
        ("first write to end of TRIGGER", us(*message(run, "trigger")),
         f"{frame_bits(8) + frame_bits(2) + own} bits at worst, and the host", "the same frames",
         "not computed"),
        ("from action to action",
         us(remote["period_shortest_ps"], remote["period_longest_ps"]), "", "not computed",
         "not computed"),
        measurement_row(remote),
    ]


def measurement_row(remote):
    """From the action to the end of the measurement's frame; the bound is that of the analysis."""
    answers = [n for n in remote["nodes"] if n["statements"]]
    told = [us(min(n["shortest_ps"] for n in answers), max(n["longest_ps"] for n in answers)),
            f"bound {us(max(n['bound_ps'] or 0 for n in answers))}"] if answers else ["none", ""]
    return ("action to end of measurement", *told, "the same frames", "not computed")


def access_rows(idle):
    """Reading and writing on the idle bus of `idle`; SDO: two frames of 8 bytes; Modbus: FC03 and
    its answer, 17 characters, two pauses."""
    sdo = f"SDO {2 * frame_bits(8)} us"
    read = frame_bits(0), frame_bits(4)
    write = frame_bits(4), frame_bits(8)
    return [
        ("read 4 bytes", us(*message(idle, "read")),
         f"{read[0]} + {read[1]} bits = {sum(read)} us", sdo, modbus_range(17, 2)),
        ("write 4 bytes, confirmed", us(*message(idle, "status")),
         f"{sum(write) + frame_bits(0)} us by reading STATUS, {sum(write)} us with ACKW", sdo,
         "about the same"),
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


def print_table(run, idle):
    """The table of RN-98, of the cabinet's run and of one on the idle bus."""
    remote = run["remote"]
    head = ("each millisecond", "this node, measured", "this node, computed",
            "CANopen SYNC/PDO, computed", "Modbus RTU 115,200, computed")
    table = [head, *bus_rows(run), *action_rows(run), *access_rows(idle)]
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


def run(tool, cabinet, options):
    """Exit code of `verican run`, and the only run of the scenario if that is 0 or 1."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
        yaml.safe_dump(cabinet, file)
        file.flush()
        done = subprocess.run([tool, "run", file.name, "--json", *options],
                              stdout=subprocess.PIPE, check=False)
    return done.returncode, json.loads(done.stdout)["runs"][0] if done.returncode <= 1 else None


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
    try:
        code, seen = run(arguments.verican, scenario(arguments.variant, arguments.rounds),
                         arguments.options)
        if code > 1:
            return code
        idle_code, idle = run(arguments.verican, idle_bus(), [])
    except (FileNotFoundError, PermissionError) as error:
        print(f"cabinet.py: {arguments.verican}: {error.strerror}; --verican says where the tool "
              "is", file=sys.stderr)
        return 2
    print_table(seen, idle)
    return max(code, idle_code)


if __name__ == "__main__":
    sys.exit(main())
