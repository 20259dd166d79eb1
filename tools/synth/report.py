#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""report.py: the harness and the page of tools/synth.sh.

  report.py wrap DIR                 writes DIR/wrap.v, the shift-register harness around area_core
  report.py page OUT PAGE BLOCK...   writes PAGE from the measurements in OUT/BLOCK
"""
import json
import math
import re
import statistics
import subprocess
import sys
from collections import Counter
from itertools import groupby
from pathlib import Path

TILES = 11520      # VersaTiles of an A2F500M3G
RAM_BLOCKS = 24    # its RAM blocks of 4,608 bits
RAM_SHAPES = ((512, 9), (256, 18), (1024, 4), (2048, 2), (4096, 1))  # depth x width of a block

# Measured by their authors' sources in the same flow (issue "The core on the bus, end to end").
ENGINES = (("OpenCores CAN", 942, 340, None), ("canola", 1110, 593, 83), ("noasic", 1066, 404, 73))
CORES = (("CTU CAN FD, two Tx buffers", 4596, 44), ("OpenCores CAN", 4539, 65))

# The other buses beside can_ahb with as many buffers: VersaTiles that they may add, and the part of
# its clock rate that they may cost (PK-11).
BUSES = {"can_apb": ("APB", 40), "can_axil": ("AXI4-Lite", 130), "can_wb": ("Wishbone classic", 40),
         "can_wb_pipelined": ("Wishbone pipelined", 90)}
SLOWER = 0.03

# Where synth.sh notes that abc9 stopped, and the figures that come from that netlist.
NETLISTS = (("ice40.plain", "LUT4, FF, carry, block RAM"), ("ice40_wrapped.plain", "Fmax"))
PLAIN = "abc9 stopped at the {}: {} with plain abc."

METHOD = """\
LUT4, flip-flops and RAM: Yosys `synth_ice40 -abc9 -device hx` of the bare block. Fmax: nextpnr on
an HX8K (ct256), the block between shift registers. VersaTiles: LUT3 and flip-flops after `abc
-lut 3`, an estimate, as Libero is not part of the flow. RAM blocks of 4,608 bits: 512x9, 256x18
and narrower, one per byte lane of a byte-enabled memory."""


def load(path):
    return json.loads(path.read_text())


def number(value):
    """A Yosys parameter as int: it writes numbers as strings of bits."""
    return int(value, 2) if isinstance(value, str) else value


def wrap(directory):
    """All inputs from one long shift register, all outputs into another: only inner paths count."""
    ports = load(directory / "ports.json")["modules"]["area_core"]["ports"]
    inputs, outputs, clocks = [], [], []
    for name, port in ports.items():
        width = len(port["bits"])
        if port["direction"] == "output":
            outputs.append((name, width))
        elif width == 1 and re.search("clk|clock", name, re.I) and "en" not in name.lower():
            clocks.append(name)
        else:
            inputs.append((name, width))
    ins, outs = (sum(width for _, width in group) for group in (inputs, outputs))
    pins = [f".\\{name} (clk)" for name in clocks]
    for vector, group in (("ir", inputs), ("ow", outputs)):
        low = 0
        for name, width in group:
            pins.append(f".\\{name} ({vector}[{low + width - 1}:{low}])")
            low += width
    # The names matter: placement follows them, and other cores were measured in the same harness.
    (directory / "wrap.v").write_text(f"""
module area_wrap(input clk_pin, input si, input cap, output reg so);
reg [{ins - 1}:0] ir; reg [{outs - 1}:0] orr; wire [{outs - 1}:0] ow; reg si_q, cap_q;
wire clk;
assign clk = clk_pin;
always @(posedge clk) begin
si_q<=si; cap_q<=cap; ir<={{ir,si_q}};
orr<= cap_q ? ow : {{orr[0],orr[{outs - 1}:1]}}; so<=orr[0];
end
area_core u (
{", ".join(pins)});
endmodule
""")


def ram_blocks(memory):
    """Blocks of an A2F500 for one memory: one per byte lane with its own write enable, times the
    read ports beyond what a block offers (one beside a write port, two if both ports write)."""
    depth, reads, writes = (number(memory["parameters"][key]) for key in ("SIZE", "RP", "WP"))
    width = number(memory["parameters"]["WIDTH"])
    enables = memory["connections"]["wen"][:width]
    lanes = [len(list(group)) for _, group in groupby(enables)] if writes else [width]
    shapes = RAM_SHAPES if writes < 2 else [shape for shape in RAM_SHAPES if shape[1] <= 9]
    blocks = sum(min(math.ceil(lane / w) * math.ceil(depth / d) for d, w in shapes)
                 for lane in lanes)
    return blocks * max(1, reads if writes < 2 else math.ceil(reads / 2))


def cell_counts(path, module="area_core"):
    cells = load(path)["modules"][module]["cells"].values()
    return Counter(cell["type"] for cell in cells)


def prefixed(counts, prefix):
    return sum(count for kind, count in counts.items() if kind.startswith(prefix))


def tiles(counts):
    """VersaTiles of the cells of a netlist."""
    return counts["$lut"] + prefixed(counts, "$_DFF") + prefixed(counts, "$_DLATCH")


def measurement(directory):
    """All figures of one block."""
    ice40 = cell_counts(directory / "ice40.json")
    versa = load(directory / "versatile.json")["modules"]["area_core"]["cells"].values()
    kinds = Counter(cell["type"] for cell in versa)
    memories = [cell for cell in versa if "MEMORY_BOX" in cell["type"]]
    fmax = []
    for report in sorted(directory.glob("pnr_*.json")):
        fmax.append(min(clock["achieved"] for clock in load(report)["fmax"].values()))
    alone = directory / "alone.json"
    return {
        "alone": tiles(cell_counts(alone)) if alone.exists() else None,
        "lut4": ice40["SB_LUT4"], "ff": prefixed(ice40, "SB_DFF"), "carry": ice40["SB_CARRY"],
        "bram": prefixed(ice40, "SB_RAM"),
        "fmax": statistics.median(fmax), "fmax_all": fmax,
        "lut3": kinds["$lut"], "tile_ff": prefixed(kinds, "$_DFF"),
        "tiles": tiles(kinds),
        "blocks": sum(ram_blocks(memory) for memory in memories),
        "plain": [figure for file, figure in NETLISTS if (directory / file).exists()],
    }


def by_module(path):
    """(module, instances, LUT4, flip-flops) of each module alone, without what it instantiates."""
    modules = load(path)["modules"]
    used = Counter(cell["type"] for module in modules.values() for cell in module["cells"].values())
    rows = []
    for name, module in modules.items():
        counts = Counter(cell["type"] for cell in module["cells"].values())
        luts, ffs = counts["$lut"], prefixed(counts, "$_DFF") + prefixed(counts, "$_SDFF")
        plain = re.sub(r"^\$paramod(\$[0-9a-f]+)?\\([^\\]+).*$", r"\2", name)
        if luts + ffs:
            rows.append((plain, max(1, used[name]), luts, ffs))
    return sorted(rows, key=lambda row: -row[2])


def version(command):
    text = subprocess.run(command, capture_output=True, text=True, check=False)
    lines = (text.stdout + text.stderr).splitlines()
    return next((line.strip().strip('"') for line in lines if re.search(r"\d+\.\d+", line)), "?")


def build(block):
    """The build of can_ahb_<profile>, can_ahb_<number of buffers> or can_ahb_time_<the same>."""
    name = block.rpartition("_")[2]
    time = ", TimeUnit=1" if block.startswith(("can_ahb_time_", "can_ahb_sync_")) else ""
    if block.startswith("can_ahb_sync_"):
        time += ", TimeSync=1"
    return f"NumMb={name}{time}" if name.isdigit() else f"profile {name}"


def title(block):
    if block.startswith("can_ahb_"):
        return f"whole core `can_ahb`, {build(block)}"
    if block.rpartition("_")[0] in BUSES:
        top, _, size = block.rpartition("_")
        return f"whole core `{top}`, NumMb={size}".replace("_pipelined`", "`, Pipelined=1")
    if block.startswith("remote_"):
        profile = block.partition("_")[2].replace("_time", ", TimeSync=1")
        return f"node without a processor `can_remote`, profile {profile}"
    if block == "can_time_sync":
        return "follower without a processor `can_time_sync`"
    if block == "can_time_node":
        return "clock without a processor `can_time_node`"
    if block == "can_time":
        return "of the time unit, what moves with every clock, `can_time`"
    return f"protocol engine `{block}`"


def buses(rows):
    """Table of the other buses beside can_ahb."""
    text = []
    for block, row in rows.items():
        top, _, size = block.rpartition("_")
        ahb = rows.get(f"can_ahb_{size}")
        if top not in BUSES or not ahb:
            continue
        name, limit = BUSES[top]
        over, alone = row["tiles"] - ahb["tiles"], row["alone"] - ahb["alone"]
        slower = 1 - row["fmax"] / ahb["fmax"]
        text.append(f"| {name} | {size} | {alone:+} | "
                    f"{over:+} ({limit}{'' if over <= limit else ', missed'}) "
                    f"| {-100 * slower:+.1f} % ({-100 * SLOWER:.0f} %"
                    f"{'' if slower <= SLOWER else ', missed'}) |")
    head = ["", "## Other buses, beside `can_ahb`", "",
            "VersaTiles of the wrappers alone, the core a black box, and of the whole cores, where",
            "the mapper's noise is 40.", "",
            "| bus | buffers | wrapper | whole core (limit of PK-11) | Fmax, medians (limit) |",
            "|---|---|---|---|---|"]
    return head + text if text else []


def page(out, blocks):
    """docs/synthesis.md as text."""
    rows = {block: measurement(out / block) for block in blocks}
    text = ["# Area and clock rate", "",
            "Written by `make synth` ([`tools/synth.sh`](../tools/synth.sh)); tools:",
            f"{version(['yosys', '-V'])}; {version(['nextpnr-ice40', '--version'])}.", "",
            "| block | LUT4 | FF | carry | block RAM | Fmax, median (all seeds) | VersaTiles "
            "(LUT3 + FF) | of an A2F500 | RAM blocks |", "|---|---|---|---|---|---|---|---|---|"]
    for block, row in rows.items():
        seeds = ", ".join(f"{value:.1f}" for value in row["fmax_all"])
        text.append(
            f"| {title(block)} | {row['lut4']} | {row['ff']} | {row['carry']} | {row['bram']} | "
            f"{row['fmax']:.1f} MHz ({seeds}) | "
            f"{row['tiles']} ({row['lut3']} + {row['tile_ff']}) | "
            f"{100 * row['tiles'] / TILES:.1f} % | {row['blocks']} of {RAM_BLOCKS} |")
    text += ["", METHOD]
    for block, row in rows.items():
        if row["plain"]:
            text += ["", PLAIN.format(title(block), " and ".join(row["plain"]))]
    text += buses(rows)
    text += ["", "## Other cores, by the same steps", "",
             "| engine | LUT4 | FF | Fmax |", "|---|---|---|---|"]
    if "can_core" in rows:
        own = rows["can_core"]
        text.append(f"| **VeriCAN** | {own['lut4']} | {own['ff']} | {own['fmax']:.0f} MHz |")
    for name, lut4, ff, fmax in ENGINES:
        text.append(f"| {name} | {lut4} | {ff} | {f'{fmax} MHz' if fmax else '–'} |")
    text += ["", "| whole core | VersaTiles | Fmax |", "|---|---|---|"]
    for block, row in rows.items():
        if block.startswith("can_ahb"):
            text.append(f"| **VeriCAN**, {build(block)} | {row['tiles']} | "
                        f"{row['fmax']:.0f} MHz |")
    text += [f"| {name} | {tiles} | {fmax} MHz |" for name, tiles, fmax in CORES]
    text += ["", f"## Where the area goes: {title(blocks[-1])}", "",
             "Each module synthesised on its own (`abc -lut 4`, no optimisation across borders, so",
             "the sum is above the flat figure); memories apart; carries counted as LUTs.", "",
             "| module | instances | LUT4 | FF |", "|---|---|---|---|"]
    text += [f"| `{name}` | {count} | {luts} | {ffs} |"
             for name, count, luts, ffs in by_module(out / blocks[-1] / "modules.json")]
    return "\n".join(text) + "\n"


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "wrap":
        wrap(Path(arguments[1]))
    elif len(arguments) > 3 and arguments[0] == "page":
        Path(arguments[2]).write_text(page(Path(arguments[1]), arguments[3:]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
