# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""families_page: the text of docs/synthesis-families.md."""

HEAD = """\
# Area in FPGA families

Written by `make synth FAMILY=all` ([`tools/families.py`](../tools/families.py)) with Yosys 0.55,
the npm package
`@yowasp/yosys` of [`package-lock.json`](../tools/synth/families/package-lock.json): the same
numbers on every machine. Synthesis
alone: clock rates need place and route, and are those of iCE40 on [synthesis.md](synthesis.md).
Profiles:
[integration](integration.md#features).

Each cell: LUTs / flip-flops / RAM blocks, then "+ n" LUT RAM cells where the tool chose some. A
second line: with LUT RAM forbidden.
LUT counts of different families do not compare: their LUTs have 3 to 6 inputs, and carry cells
and wide multiplexers are
not counted.

| family | engine alone | small, 16 buffers | standard, 32 | full, 64 |
|---|---|---|---|---|
"""
NOTES = """
RAM blocks by family: iCE40 SB_RAM40_4K with byte masks, ECP5 DP16KD with byte enables,
CrossLink-NX PDPSC16K, Gowin SDPB,
Xilinx RAMB18E1, Cyclone V M10K, PolarFire RAM1K20, Efinix EFX_RAM_5K a byte lane, GateMate
CC_BRAM_20K.

- Yosys knows no block RAM with byte enables for Cyclone V and none at all for SmartFusion2: with
  LUT RAM forbidden
  Cyclone V takes flip-flops, and SmartFusion2's memories are counted as what they are in the RTL,
  beside the logic. The vendors' tools
  have both.
- \\*: with plain abc, which takes far more LUTs there; abc9 stops ([E-07](errata.md#e-07)).
- Asynchronous resets appear as an inverter a flip-flop for CrossLink-NX and Xilinx before packing.
- Not possible with this package: NanoXplore and MAX 10, whose files it lacks.
- Fusion and SmartFusion (VersaTiles): [synthesis.md](synthesis.md).

"""


def cell(found):
    """A build's figures."""
    if found is None:
        return "–"
    text = f"{found['lut']:,} / {found['ff']:,} / {found['ram']}"
    if found.get("lut_ram"):
        text += f" + {found['lut_ram']}"
    if found.get("plain_abc"):
        text += " \\*"
    without = found.get("without_lut_ram")
    return text + (f"<br>{cell(without)}" if without else "")


def render(known, results):
    """The page."""
    lines = [HEAD]
    for name, entry in known.items():
        builds = results.get(name, {}).get("builds", {})
        cells = " | ".join(cell(builds.get(build))
                           for build in ("core", "small", "standard", "full"))
        lines.append(f"| {entry['title']} | {cells} |\n")
    states = {results[name]["state"] for name in known if name in results}
    lines += [NOTES, "State of RTL, tool and settings (`tools/families.py --check` compares): ",
              ", ".join(f"{name} {results[name]['state']}" for name in known if name in results),
              ".\n" if states else "nothing measured.\n"]
    return "".join(lines)
