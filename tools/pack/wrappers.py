# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""wrappers: the bus wrappers of the core, read from their SystemVerilog: the one list that all
packagers take them from. A wrapper counts if rtl/can.f names it.
"""
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUSES = {"ahb": "AHB-Lite", "apb": "APB4", "axil": "AXI4-Lite", "wb": "Wishbone B4"}

MODULE = re.compile(r"^module (\w+) #\((.*?)^\) \((.*?)^\);", re.DOTALL | re.MULTILINE)
PARAMETER = re.compile(r"parameter\s+(int|logic\s*\[(\d+):0\])\s+(\w+)\s*=\s*([^,\s/]+)")
PORT = re.compile(r"^\s*(input|output)\s+logic\s*(\[[^\]]+\])?\s*(\w+)", re.MULTILINE)
COMMENT = re.compile(r"^\s*///\s?(.*)$")
# Where a port list leaves the bus: the first port that all wrappers share.
FIRST_COMMON = "irq_o"


# Defaults of packages that give the core no more addresses than its window has, so that it may lie
# at any multiple of it: the RTL's region is larger, and has errors in it.
PACKAGED = {"RegionBits": 13}


@dataclass
class Parameter:
    """A parameter with its default as it is written; `width` is 0 of an int."""
    name: str
    width: int
    default: str
    doc: str

    @property
    def number(self):
        """The default as a number."""
        based = re.fullmatch(r"\d+'([hd])([0-9A-Fa-f_]+)", self.default)
        if not based:
            return int(self.default)
        return int(based[2].replace("_", ""), 16 if based[1] == "h" else 10)

    @property
    def packaged(self):
        """The default in a package that has an address map."""
        return PACKAGED.get(self.name, self.number)


@dataclass
class Port:
    """A port; bits high:low of a vector."""
    name: str
    direction: str
    high: int
    low: int

    @property
    def width(self):
        """Number of bits."""
        return self.high - self.low + 1

    @property
    def is_vector(self):
        """Whether it has a range."""
        return self.high > 0 or self.low > 0


@dataclass
class Wrapper:
    """A module that is the core on a bus."""
    bus: str
    module: str
    file: str
    parameters: list
    ports: list

    @property
    def bus_ports(self):
        """The ports of its bus, clock and reset among them."""
        names = [port.name for port in self.ports]
        return self.ports[:names.index(FIRST_COMMON)]

    @property
    def common_ports(self):
        """The ports that all wrappers have."""
        return self.ports[len(self.bus_ports):]

    @property
    def clock(self):
        """The name of the clock."""
        return self.ports[0].name

    @property
    def reset(self):
        """The name of the reset; active low but in Wishbone."""
        return self.ports[1].name

    @property
    def reset_low(self):
        """Whether the reset is active low."""
        return self.reset.endswith("n")


def rtl_files(root=ROOT):
    """The files of rtl/can.f, relative to the project's root, in order."""
    lines = (root / "rtl/can.f").read_text(encoding="utf-8").splitlines()
    names = (line.split("#")[0].strip() for line in lines)
    return [f"rtl/{name}" for name in names if name]


def version(root=ROOT):
    """The project's version."""
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(verican VERSION ([\d.]+)", text, re.MULTILINE)[1]


def bits(text, constants):
    """The two ends of a range such as [31:0] or [can_pkg::TraceWidth-1:0]."""
    if not text:
        return 0, 0
    high, low = text.strip("[]").split(":") if "::" not in text else (
        text.strip("[]").rsplit(":", 1))
    named = re.fullmatch(r"can_pkg::(\w+)-1", high)
    return (constants[named[1]] - 1 if named else int(high)), int(low)


def read(path, bus, constants):
    """The wrapper in a file."""
    module, parameters, ports = MODULE.search((ROOT / path).read_text(encoding="utf-8")).groups()
    found, doc = [], []
    for line in parameters.splitlines():
        comment, entry = COMMENT.match(line), PARAMETER.search(line)
        if comment:
            doc.append(comment[1])
        elif entry:
            found.append(Parameter(entry[3], int(entry[2]) + 1 if entry[2] else 0, entry[4],
                                   " ".join(doc)))
            doc = []
    return Wrapper(bus, module, path, found,
                   [Port(name, direction, *bits(width, constants))
                    for direction, width, name in PORT.findall(ports)])


def wrappers():
    """All of them, in the order of BUSES."""
    text = (ROOT / "rtl/can_pkg.sv").read_text(encoding="utf-8")
    constants = {name: int(value) for name, value in
                 re.findall(r"localparam int (\w+)\s*=\s*(\d+);", text)}
    listed = rtl_files()
    return [read(f"rtl/host/can_{bus}.sv", bus, constants) for bus in BUSES
            if f"rtl/host/can_{bus}.sv" in listed]
