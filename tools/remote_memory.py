#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""First contents of the RAM of can_remote, for its parameter InitFile: what clearing would leave
there, and bytes of one's own. Words as $readmemh takes them."""

import argparse
from pathlib import Path

PROFILES = {"small": 0x01, "standard": 0x1F, "full": 0xFF}  # features (RN-25)
PRODUCERS, MAP = 0x02, 0x04
NODE = 0xF00  # address of the number


def number(text):
    """Decimal, or hexadecimal with 0x."""
    try:
        return int(text, 0)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}'; allowed: a number") from None


def bytes_from(text):
    """ADDRESS=HEX as the address and the bytes from there on."""
    address, _, data = text.partition("=")
    try:
        first, values = int(address, 0), bytes.fromhex(data)
    except ValueError:
        values = b""
    if not values:
        raise argparse.ArgumentTypeError(f"'{text}'; allowed: ADDRESS=HEX, two digits a byte")
    return first, values


def arguments():
    """The command line, and what refuses it: parser.error(text)."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--serial", type=number, required=True, help="parameter Serial")
    parser.add_argument("--number", type=number, help="of the node (0: none, which it is without)")
    parser.add_argument("--profile", choices=PROFILES, default="small")
    parser.add_argument("--name-bits", type=int, choices=(3, 5), default=3)
    parser.add_argument("--mem-bytes", type=int, choices=(1024, 2048, 4096), default=4096)
    parser.add_argument("--stage-bytes", type=int, choices=(0, 8, 16), default=8)
    parser.add_argument("--set", type=bytes_from, action="append", default=[],
                        metavar="ADDRESS=HEX",
                        help="bytes from this address of the memory map; may be repeated")
    parser.add_argument("file", type=Path, help="to write; - is standard output")
    args = parser.parse_args()
    last = (1 << args.name_bits) - 1
    if args.number not in (None, 0) and not 2 <= args.number <= last:
        parser.error(f"argument --number: {args.number}; allowed: 2 to {last}, or 0 for none")
    if not 0 <= args.serial <= 0xFFFFFFFF:
        parser.error(f"argument --serial: {args.serial:#x}; allowed: 0 to 0xFFFFFFFF")
    return args, parser.error


def spread(areas):
    """(address, byte) of each byte of areas (address, bytes)."""
    return [(first + i, byte) for first, data in areas for i, byte in enumerate(data)]


def areas(args):
    """What user logic may set up before the start: memory, configuration, the tables that the
    profile has (section 8). All else is the engine's own, or read by nobody."""
    yield range(args.mem_bytes - 512)
    yield range(0xF00, 0xF20)
    if PROFILES[args.profile] & PRODUCERS:
        yield range(0xF40, 0xF80)
    if PROFILES[args.profile] & MAP:
        yield range(0xF80, 0xFC0)


def own_bytes(args, refuse):
    """The bytes of --set by their addresses."""
    own = {}
    for address, byte in spread(args.set):
        if not any(address in area for area in areas(args)):
            refuse(f"argument --set: {address:#05x} is not in the memory; allowed: " + ", ".join(
                f"{area[0]:#05x} to {area[-1]:#05x}" for area in areas(args)))
        if address == NODE and args.number is not None:
            refuse(f"argument --set: {address:#05x} is the number of the node, which --number "
                   "gives; allowed: one of them")
        if address in own:
            refuse(f"argument --set: {address:#05x} is given twice; allowed: once")
        own[address] = byte
    return own


def contents(args, own):
    """The bytes of the memory map that are not 0."""
    features = PROFILES[args.profile] & (0xFF if args.stage_bytes else 0xFE)
    size = args.mem_bytes.bit_length() - 1
    fixed = {0xE04: [40],                                             # 10 s, x 256 ms
             # NODE to RETRY (section 8)
             NODE: [args.number or 0, 0x05, 0, 0, 0x0A, 0x0A, 0x32, 0x08],
             0xFF8: [0x01, features, args.name_bits << 4 | size, args.stage_bytes,
                     *args.serial.to_bytes(4, "little")]}
    return dict(spread(fixed.items())) | own


def main():
    """The upper 512 bytes keep their addresses in the map, whatever the size of the RAM."""
    args, refuse = arguments()
    ram = bytearray(args.mem_bytes)
    for address, byte in contents(args, own_bytes(args, refuse)).items():
        ram[address & (args.mem_bytes - 1)] = byte
    words = (ram[i:i + 4] for i in range(0, len(ram), 4))
    text = "".join(f"{int.from_bytes(word, 'little'):08X}\n" for word in words)
    try:
        if str(args.file) == "-":
            print(text, end="", flush=True)
        else:
            args.file.write_text(text, encoding="utf-8")
    except OSError as error:
        refuse(f"{args.file}: {error.strerror}")


if __name__ == "__main__":
    main()
