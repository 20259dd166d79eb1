#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""build.py OUT [ID...]: compiles the servo drive of sw/canopennode for the Cortex-M3 with the
user's copy of CANopenNode 4, which the environment variable CANOPENNODE names, and writes
OUT/drive<ID>.elf for each node-ID (1 to 127; 255: LSS gives one). Serial numbers are 0x1000 + ID,
0x2000 for 255.

Exit code 77: CANOPENNODE is not set. Needs arm-none-eabi-gcc.
"""
import argparse
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SW = HERE.parent
STACK = ("CANopen.c", "301/CO_Emergency.c", "301/CO_HBconsumer.c", "301/CO_NMT_Heartbeat.c",
         "301/CO_ODinterface.c", "301/CO_PDO.c", "301/CO_SDOserver.c", "301/CO_SYNC.c",
         "301/crc16-ccitt.c", "303/CO_LEDs.c", "305/CO_LSSslave.c", "storage/CO_storage.c")
CPU = ("-mcpu=cortex-m3", "-mthumb", "-std=gnu99", "-O2", "-g", "-ffunction-sections",
       "-fdata-sections", "-DCO_USE_GLOBALS")
OWN = ("-Wall", "-Wextra", "-Werror")  # warnings are for our own files
SKIPPED = 77


def run(*command):
    """Runs a command; its messages are the user's."""
    subprocess.run([str(word) for word in command], check=True)


def own_sources():
    """Port, drive, board, driver."""
    return [*HERE.glob("*.c"), *(HERE / "drive").glob("*.c"), *(SW / "firmware/common").glob("*.c"),
            *(SW / "driver/src").glob("*.c")]


def compile_all(stack, out, gcc, clock):
    """Object files of everything that does not depend on the node-ID."""
    od = out / "od"
    run(sys.executable, HERE / "od_from_eds.py", HERE / "drive/drive.eds", od)
    includes = [flag for folder in (HERE, HERE / "drive", SW / "firmware/common",
                                    SW / "driver/include", od) for flag in ("-I", folder)]
    includes += ["-isystem", stack, f"-DBOARD_CLOCK_HZ={clock}u"]
    objects = []
    for source in [*(stack / name for name in STACK), *own_sources(), od / "OD.c"]:
        own = SW in source.parents
        objects.append(out / f"{'own' if own else 'stack'}-{source.stem}.o")
        run(gcc, *CPU, *(OWN if own else ()), *includes, "-c", source, "-o", objects[-1])
    return objects


def serial(node):
    """One bit for the drive that LSS finds bit by bit: each 1 costs a master a time-out."""
    return 0x2000 if node == 255 else 0x1000 + node


def link(objects, out, gcc, node, kbit):
    """The image of a drive."""
    symbols = {"drive_node_id": node, "drive_serial": serial(node), "drive_kbit": kbit}
    run(gcc, *CPU, "-nostartfiles", "-Wl,--gc-sections", "-Wl,--fatal-warnings",
        *(f"-Wl,--defsym={name}={value}" for name, value in symbols.items()),
        "-T", SW / "firmware/common/a2f500.ld", *objects, "-o", out / f"drive{node}.elf")


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("nodes", type=int, nargs="*", metavar="ID", default=[1])
    parser.add_argument("--kbit", type=int, default=1000, help="bit rate, kbit/s (1000)")
    parser.add_argument("--clock", type=int, default=16_000_000,
                        help="of CPU and core, Hz (16000000)")
    arguments = parser.parse_args()
    if not os.environ.get("CANOPENNODE"):
        print("build.py: CANOPENNODE names no copy of CANopenNode 4: nothing is built")
        return SKIPPED
    stack = pathlib.Path(os.environ["CANOPENNODE"]).resolve()
    if not (stack / "CANopen.c").is_file():
        print(f"build.py: CANOPENNODE={stack}: there is no CANopen.c", file=sys.stderr)
        return 2
    for node in arguments.nodes:
        if not (1 <= node <= 127 or node == 255):
            parser.error(f"node-ID {node}: 1 to 127, or 255")
    for name, value, least, most in (("kbit", arguments.kbit, 1, 1000),
                                     ("clock", arguments.clock, 1_000_000, 1_000_000_000)):
        if not least <= value <= most:
            parser.error(f"--{name} {value}: {least} to {most}")
    gcc = "arm-none-eabi-gcc"
    try:
        arguments.out.mkdir(parents=True, exist_ok=True)
        objects = compile_all(stack, arguments.out, gcc, arguments.clock)
        for node in arguments.nodes:
            link(objects, arguments.out, gcc, node, arguments.kbit)
    except subprocess.CalledProcessError as error:
        print(f"build.py: failed: {error.cmd[0]} ... {error.cmd[-1]}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"build.py: {error.filename or arguments.out}: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
