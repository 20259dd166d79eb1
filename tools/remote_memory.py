#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""First contents of the RAM of can_remote, for its parameter InitFile: what clearing would leave
there, and bytes of one's own. Words as $readmemh takes them."""

import argparse
from pathlib import Path

PROFILES = {"small": 0x01, "standard": 0x1F, "full": 0xFF}  # features (RN-25)


def number(text):
    """Decimal, or hexadecimal with 0x."""
    return int(text, 0)


def arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--serial", type=number, required=True, help="parameter Serial")
    parser.add_argument("--number", type=number, default=0, help="of the node (0: none)")
    parser.add_argument("--profile", choices=PROFILES, default="small")
    parser.add_argument("--name-bits", type=int, choices=(3, 5), default=3)
    parser.add_argument("--mem-bytes", type=int, choices=(1024, 2048, 4096), default=4096)
    parser.add_argument("--stage-bytes", type=int, choices=(0, 8, 16), default=8)
    parser.add_argument("--set", action="append", default=[], metavar="ADDRESS=HEX",
                        help="bytes from this address of the memory map; may be repeated")
    parser.add_argument("file", type=Path)
    return parser.parse_args()


def contents(args):
    """The bytes of the memory map that are not 0."""
    features = PROFILES[args.profile] & (0xFF if args.stage_bytes else 0xFE)
    size = args.mem_bytes.bit_length() - 1
    areas = {0xE04: [40],                                             # 10 s, x 256 ms
             0xF00: [args.number, 0x05, 0, 0, 0x0A, 0x0A, 0x32, 0x08],  # NODE to RETRY (section 8)
             0xFF8: [0x01, features, args.name_bits << 4 | size, args.stage_bytes,
                     *args.serial.to_bytes(4, "little")]}
    for text in args.set:
        address, _, data = text.partition("=")
        areas[number(address)] = bytes.fromhex(data)
    return {first + i: byte for first, data in areas.items() for i, byte in enumerate(data)}


def main():
    """The upper 512 bytes keep their addresses in the map, whatever the size of the RAM."""
    args = arguments()
    ram = bytearray(args.mem_bytes)
    for address, byte in contents(args).items():
        if args.mem_bytes - 512 <= address < 0xE00 or not 0 <= address < 0x1000:
            raise SystemExit(f"remote_memory: {address:#05x} is not in the memory")
        ram[address & (args.mem_bytes - 1)] = byte
    words = (ram[i:i + 4] for i in range(0, len(ram), 4))
    args.file.write_text("".join(f"{int.from_bytes(word, 'little'):08X}\n" for word in words),
                         encoding="utf-8")


if __name__ == "__main__":
    main()
