# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Figures that several pages give are the same in all, and those that take seconds are measured.

Run by ctest: python3 -m unittest figures_test, with VERICAN_BINARY and VERICAN_FIRMWARE (the folder
of the ELF files) in the environment.
"""
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILER = "12.2"  # of sizes and clocks on docs/driver.md and docs/timesync.md
FAMILY_RAMS, TILES = 24, 11520  # of an A2F500
CAMPAIGN_LINK = re.compile(r"\[([^\]]*)\]\((?:docs/)?campaign/(\w+\.md)\)")
RUN_TIME = re.compile(r", (\d+) min (\d+) s on (\d+) cores")
NUMBER = re.compile(r"(?<![\w.])\d[\d,]*(?:\.\d+)?(?![\w])")


def numbers(text):
    """The numbers of a text that are not part of a name."""
    return [float(number.rstrip(",").replace(",", "")) for number in NUMBER.findall(text)]


def rows(page, start):
    """The cells of the rows of a page whose first cell begins so."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines()
            if line.startswith(f"| {start}")]


def row(page, start):
    """The one row of a page whose first cell begins so, without that cell."""
    found = rows(page, start)
    if len(found) != 1:
        raise AssertionError(f"{page}: {len(found)} rows begin with '{start}'")
    return found[0][1:]


def block(title):
    """What docs/synthesis.md has of a block; its seeds are sorted, the median first."""
    page = "docs/synthesis.md"
    cells = [cells for cells in rows(page, "") if cells[0] == title and len(cells) == 9]
    if len(cells) != 1:
        raise AssertionError(f"{page}: {len(cells)} rows of {title}")
    lut4, ff, _, rams, clock, tiles, _, blocks = cells[0][1:]
    median, *seeds = numbers(clock)
    return {"lut4": int(lut4), "ff": int(ff), "rams": int(rams), "fmax": median, "seeds": seeds,
            "tiles": numbers(tiles)[0], "blocks": numbers(blocks)[0]}


def clocks(of):
    """Median, slowest and fastest seed in whole MHz."""
    return [round(of["fmax"]), round(min(of["seeds"])), round(max(of["seeds"]))]


ENGINE = "protocol engine `can_core`"
CORE, CORE_64 = "whole core `can_ahb`, NumMb=32", "whole core `can_ahb`, NumMb=64"
TIMED = "whole core `can_ahb`, NumMb=32, TimeUnit=1"
FOLLOWER = "follower without a processor `can_time_sync`"
CLOCK = "clock without a processor `can_time_node`"


def remote(profile):
    """Title of a node without a processor."""
    return f"node without a processor `can_remote`, profile {profile}"


class Area(unittest.TestCase):
    """Cells and clock rates are those of docs/synthesis.md, which make synth writes."""

    def of_row(self, page, start, expected):
        self.assertEqual(numbers(" ".join(row(page, start))), expected, f"{page}: {start}")

    def test_readme(self):
        engine, core, large = block(ENGINE), block(CORE), block(CORE_64)
        small, timed = block(remote("small")), block(TIMED)
        follower, clock = block(FOLLOWER), block(CLOCK)
        self.of_row("README.md", "protocol engine on iCE40",
                    [engine["lut4"], engine["ff"], *clocks(engine)])
        self.of_row("README.md", "whole core, 32 buffers, all features |",
                    [core["lut4"], core["ff"], core["rams"], *clocks(core)])
        self.of_row("README.md", "a node without a processor, profile *small*",
                    [small["tiles"], 1536, small["lut4"], *clocks(small)])
        self.of_row("README.md", "the time unit |",
                    [timed["lut4"] - core["lut4"], timed["ff"] - core["ff"],
                     timed["rams"] - core["rams"], *clocks(timed),
                     round(100 * timed["fmax"] / core["fmax"])])
        self.of_row("README.md", "follower of a master's clock",
                    [follower["lut4"], follower["ff"], clock["lut4"], clock["ff"], *clocks(clock)])
        self.of_row("README.md", "whole core, 32 buffers, all features, on",
                    [core["tiles"], round(100 * core["tiles"] / TILES), core["blocks"],
                     FAMILY_RAMS, 64, large["tiles"], *clocks(large)])
        profiles = [block(f"whole core `can_ahb`, profile {name}") for name in
                    ("small", "standard")]
        self.of_row("README.md", "profiles *small*",
                    [value for of in profiles
                     for value in (of["tiles"], of["blocks"], round(of["fmax"]))])

    def test_wrappers(self):
        """In the table of docs/synthesis.md: wrapper, whole core and limit, clock and limit."""
        page = "docs/synthesis.md"
        cells = {start: numbers(row(page, f"{start} | 32 |")[1])[0] for start in
                 ("APB", "AXI4-Lite", "Wishbone classic", "Wishbone pipelined")}
        clock = [numbers(row(page, f"{start} | 32 |")[3])[0] for start in cells]
        self.of_row("README.md", "wrappers over AHB-Lite, 32 buffers",
                    [cells["APB"], cells["Wishbone classic"], cells["Wishbone pipelined"],
                     cells["AXI4-Lite"], clock[2], clock[1]])

    def test_other_pages(self):
        core, timed = block(CORE), block(TIMED)
        for start, of in (("whole core, 32 buffers, without", core),
                          ("whole core, 32 buffers, with |", timed),
                          ("`can_time_sync`, the follower", block(FOLLOWER)),
                          ("`can_time_node`, engine", block(CLOCK))):
            self.of_row("docs/time.md", start,
                        [of["lut4"], of["ff"], of["rams"], of["fmax"], *of["seeds"]])
        for name in "small", "standard", "full":
            of = block(remote(name))
            cells = [numbers(cell)[0] for cell in rows("docs/remote.md", f"*{name}* | ")[0][1:]]
            self.assertEqual(cells, [of["tiles"], of["lut4"], round(of["fmax"])], name)
        large = f"the {block(CORE_64)['tiles']:,.0f} of *full*"
        self.assertIn(large, (ROOT / "docs/integration.md").read_text(encoding="utf-8"))

    def test_board(self):
        """A bitstream takes minutes: the two places say the same."""
        page = (ROOT / "docs/hx8k.md").read_text(encoding="utf-8")
        cells, rams, mhz = re.search(
            r"([\d,]+) of 7,680\s+cells, (\d+) of 32 RAM blocks, (\d+) MHz", page).groups()
        self.of_row("README.md", "a CAN node from UART to CAN",
                    [numbers(cells)[0], float(rams), float(mhz)])


class Counts(unittest.TestCase):
    """What README.md counts: rules, rows of the registers, properties that are proven."""

    WRAPPERS = "apb", "axil", "wb", "wb_pipelined"

    def test_rules(self):
        """Those of the pages that `make rules` and `make rows` write; optional rows are rows."""
        def found(page):
            text = (ROOT / page).read_text(encoding="utf-8")
            return numbers(re.search(r"^\d+ of \d+ r.*?;.*?;", text, re.MULTILINE)[0])
        tested, rules, _, _, other = found("docs/rules.md")
        self.assertEqual(numbers(row("README.md", "rules of the protocol")[0]),
                         [tested, rules, other])
        tested, rows_there, more_tested, more, _ = found("docs/flexcan-rows.md")
        self.assertEqual(numbers(row("README.md", "rows of the register")[0]),
                         [tested + more_tested, rows_there + more])

    def test_proofs(self):
        said = subprocess.run([ROOT / "tb/formal/run.py", "--list"], capture_output=True, text=True,
                              check=True).stdout
        count = {"core": 0, "bounded": 0, "wrappers": 0, "remote": 0, "time": 0}
        for proof in re.findall(r"^\w+\.\w+: .*\n(?:  .*\n)*", said, re.MULTILINE):
            part, name = re.match(r"(\w+)\.(\w+)", proof).groups()
            if part in ("engine", "host"):
                bounded = "(bounded" in proof.split("\n", maxsplit=1)[0]
                part = ("wrappers" if name in self.WRAPPERS else "bounded" if bounded else "core")
            count[part] += proof.count("\n  p_")
        self.assertEqual(numbers(row("README.md", "formal proofs")[0]), list(count.values()))


class Campaign(unittest.TestCase):
    """Figures that pages take over from those that `make campaign` writes."""

    def test_links_say_what_stands_there(self):
        """The numbers in the text of a link to such a page; dates and commits, too."""
        found = 0
        for page in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
            for text, target in CAMPAIGN_LINK.findall(page.read_text(encoding="utf-8")):
                there = numbers((ROOT / "docs/campaign" / target).read_text(encoding="utf-8"))
                for number in numbers(text):
                    self.assertIn(number, there, f"{page.name}: [{text}], of {target}")
                    found += 1
        self.assertGreater(found, 0)

    def test_coverage(self):
        """README.md: lines, branches, toggles, and points that are left out."""
        page = "docs/campaign/coverage.md"
        lines, branches, toggles = (numbers(row(page, f"RTL {kind} coverage")[0])[1:]
                                    for kind in ("line", "branch", "toggle"))
        left_out = sum(numbers(cells[1])[0] for cells in rows(page, "RTL points excluded"))
        self.assertEqual(lines[0] + branches[0], lines[1] + branches[1], "README.md says: all")
        self.assertEqual(numbers(row("README.md", "RTL coverage")[0]),
                         [lines[0], branches[0], *toggles, left_out])

    def test_costs_on_a_cluster(self):
        """docs/cluster.md: a stage has the core-seconds of its page; what a unit costs."""
        costs = [cells for cells in rows("docs/cluster.md", "") if len(cells) == 5]
        for stage, total, units, cost, _ in costs[1:]:  # behind the head of the table
            page = (ROOT / f"docs/campaign/{stage.split()[0]}.md").read_text(encoding="utf-8")
            minutes, seconds, cores = map(int, RUN_TIME.search(page).groups())
            self.assertEqual(numbers(total)[0], cores * (60 * minutes + seconds), stage)
            if cost:
                figure, unit = cost.split()
                number = numbers(units)[0] * (1e6 if "million" in units else 1)
                seen = numbers(total)[0] / number * {"s": 1, "ms": 1000}[unit]
                places = len(figure.partition(".")[2])
                self.assertEqual(f"{seen:.{places}f}", figure, stage)
        self.assertEqual(len(costs), 9)

    def test_synchronised_clocks_on_rtl(self):
        """docs/timesync.md and README.md: standard deviation, largest error, between followers."""
        source, page = "docs/campaign/timesync.md", "docs/timesync.md"
        base, *loads = (row(source, f"{name} | skip") for name in (
            "base", "100 % load below SYNC, bit errors 1e-4", "50 % load below SYNC",
            "90 % load above SYNC"))
        shown = rows(page, "100 % load below") + rows(page, "50 % load") + rows(page, "90 % load")
        self.assertEqual([numbers(" ".join(cells[1:])) for cells in shown],
                         [numbers(" ".join(cells[1:4])) for cells in loads])
        text = (ROOT / page).read_text(encoding="utf-8")
        said = re.search(r"the base case has ([\d.]+) and ([\d.]+) ns", text)
        self.assertEqual(said.groups(), tuple(base[1:3]))
        seen = [numbers(cells[-1])[0] for cells in rows(source, "offset alone") +
                rows(source, "hardware stamps and servo")]
        said = re.search(r"it is ([\d.]+) and ([\d.]+) us as published.*?, (\d+) and (\d+) ns",
                         text, re.DOTALL)
        self.assertEqual([float(number) for number in said.groups()],
                         [*seen[:2], *map(round, seen[2:])])
        self.assertEqual(numbers(row("README.md", "IEEE 1588 over CAN")[0]),
                         [seen[0], round(seen[2])])
        deviation, largest, busy = (round(float(text)) for text in (*base[1:3], loads[0][2]))
        said = numbers(row("README.md", "clocks synchronised over CAN")[0].split(";")[0])
        self.assertEqual(said, [largest, 16, deviation, busy])


class Speed(unittest.TestCase):
    """The simulator's speed is that of docs/performance.md, which make bench writes."""

    RATES = 8, 16, 50, 80

    def saturated(self, rate):
        """Million node-cycles and seconds a second of two nodes: one clock, clocks of their own."""
        return [numbers(cell)[0] for cell in row("docs/performance.md", f"2 | {rate} MHz |")[1:]]

    def test_readme(self):
        speed = {rate: self.saturated(rate) for rate in self.RATES}
        two = [[round(speed[rate][at], 2) for rate in self.RATES] for at in (1, 3)]
        self.assertEqual(numbers(row("README.md", "simulator, two whole cores")[0]),
                         [round(speed[8][0], 1), 8, round(speed[80][0]), 80, *two[0],
                          *self.RATES, *two[1]])

    def test_time_unit(self):
        """TM-126: smallest and largest part of the speed that is left, for both kinds of clocks."""
        parts = []
        for drift in 0, 1:
            part = [100 * numbers(row("docs/performance.md", f"bus with time, nodes 2, MHz {rate}, "
                                      f"drift {drift} |")[0])[0] / self.saturated(rate)[2 * drift]
                    for rate in self.RATES]
            parts += [round(min(part)), round(max(part))]
        said = re.search(r"with the unit run at (\d+) to (\d+) %.*?\((\d+) to (\d+) %",
                         (ROOT / "docs/time.md").read_text(encoding="utf-8"), re.DOTALL)
        self.assertEqual([int(number) for number in said.groups()], parts)


def compiler_is_ours():
    """True with the compiler that the pages name: another one makes other code."""
    return subprocess.run(["arm-none-eabi-gcc", "-dumpversion"], capture_output=True, text=True,
                          check=True).stdout.startswith(COMPILER)


class Driver(unittest.TestCase):
    """Size and speed of the C driver on a Cortex-M3."""

    def setUp(self):
        if not compiler_is_ours():
            self.skipTest(f"sizes are those of gcc {COMPILER}")

    def test_size(self):
        """The groups of objects are those of make size; structures; frames of the stack."""
        said = subprocess.run([ROOT / "tools/driver-size.sh"], capture_output=True, text=True,
                              check=True).stdout
        size = {name: int(text) for text, name in
                re.findall(r"^(\d+)\t.*\t(\w+)\.o$", said, re.MULTILINE)}
        timed = {"clock", "stamp"}
        domain = {name for name in size if re.match("servo|tsyn|masters$|delay$", name)}
        rest = set(size) - timed - domain - {"p4"}
        groups = [sum(size[name] for name in names) for names in (rest, timed, domain, {"p4"})]
        page = "docs/driver.md"
        self.assertEqual([numbers(row(page, start)[0])[0] for start in (
            "driver without time", "clock and stamps", "servo, CanTSyn", "messages of P4")],
            groups, f"{page}: the groups of make size")
        self.assertEqual(numbers(row("README.md", "C driver |")[0]),
                         [round(sum(groups) / 1000, 1), round(sum(groups[1:]) / 1000, 1)])
        self.assertEqual([int(row(page, start)[0]) for start in (
            "`verican_t` |", "`verican_tsyn_t`", "one frame of the ring")],
            [int(text) for text in re.findall(r"caller: (\d+) bytes", said)],
            f"{page}: structures, by make size")
        stack = dict(reversed(pair) for pair in re.findall(r"stack +(\d+)  (\w+)$", said, re.M))
        named = [int(stack.pop(f"verican_{name}")) for name in
                 ("self_test", "tsyn_on_frame", "servo_pair")]
        text = (ROOT / page).read_text(encoding="utf-8")
        self.assertEqual(numbers(re.search(r"^Stack: (.*?);", text, re.M)[1]),
                         [*named, max(int(frame) for frame in stack.values())],
                         f"{page}: frames of the stack, by make size")

    def test_cost_of_a_pair(self):
        """The table of docs/timesync.md is what the firmware tells."""
        cost = {clocks: self.cost(clocks) for clocks in (2, 1)}
        self.assertEqual(list(cost[2]), ["1", "2", "4", "8", "16", "0"])
        for name in cost[2]:
            start = {"0": "automatic", "1": "N = 1"}.get(name, name)
            found = [cells for cells in rows("docs/timesync.md", f"{start} |")
                     if cells[2] != "yes"]  # the other table tells how well
            self.assertEqual([[numbers(cells[at])[0] for at in (1, 2, 4)] for cells in found],
                             [[*cost[2][name], cost[1][name][1]]],
                             f"docs/timesync.md, what it costs: {start}")

    def cost(self, clocks_per_instruction):
        """Filter -> clocks of a pair, mean and at most."""
        said = subprocess.run(
            [os.environ["VERICAN_BINARY"], "firmware",
             pathlib.Path(os.environ["VERICAN_FIRMWARE"]) / "servo_cost.elf", "--bus",
             ROOT / "sw/firmware/servo_cost/servo_cost.yaml", "--clocks-per-instruction",
             str(clocks_per_instruction)], capture_output=True, text=True, check=True).stdout
        return {name: [float(mean), float(most)] for name, mean, most in
                re.findall(r"^filter (\d+): (\d+) clocks a pair, at most (\d+);", said, re.M)}


if __name__ == "__main__":
    unittest.main()
