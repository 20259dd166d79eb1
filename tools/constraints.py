#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""constraints.py OUT [--instance PATH] [--mhz N] [--clock P] [--reset P] [--rx P] [--tx P]

Writes the constraints of the core, OUT/<family>/can.*, for FPGA tools: the clock; can_rx_i
asynchronous up to the first flip-flop of can_sync; the reset asynchronous; can_tx_o bounded; a
pull-up. Without options they are those of constraints/: can_ahb alone at 50 MHz.

  --instance  the core's place in the design, such as u_soc/u_can; none: it is the top
  --mhz       rate of its clock, 8 or more; 0: the design constrains the clock itself
  --clock, --reset, --rx, --tx
              ports of the design; --reset "": the reset comes from inside of the design. With
              --instance all of them are needed, but for the clock with --mhz 0

Nothing in them is a ball, but for GateMate, whose format wants some.
"""
import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path

sys.dont_write_bytecode = True

HEAD = """\
{mark} SPDX-FileCopyrightText: 2026 The VeriCAN authors
{mark} SPDX-License-Identifier: Apache-2.0
{mark}
{mark} {what}
{mark} Written by tools/constraints.py, which has options for an instance in a design, its ports and
{mark} its clock. Not run in the vendor's tool ({tool}): tb/integration/constraints.py checks the
{mark} commands, and that the ports and flip-flops that they name are there.
"""
# The two flip-flops at the pins, below a wrapper of the core.
SYNC = ("u_top", "u_core", "u_sync", "meta_q")
SENT = ("u_top", "u_core", "u_bsp", "u_tx_frame", "can_tx_o")
# Names that are the same in all formats: without what ends a word in one of them.
PORT = re.compile(r"[A-Za-z_][\w$.]*(\[\d+\])*", re.ASCII)
INSTANCE = re.compile(r"/*[A-Za-z_][\w$.\[\]]*(/+[A-Za-z_][\w$.\[\]]*)*/*", re.ASCII)
# Vivado's name of a register's cells; that of the LUT in front of it begins with the plain name.
VIVADO_REGISTER = "_reg"
LOOP_NS = 15.0  # of the node's delay that PROP_SEG covers (BT-07)


@dataclass
class Place:
    """Where the core is and what its pins are called."""
    instance: str = ""
    mhz: float = 50.0
    clock: str = "hclk"
    reset: str = "hresetn"
    rx: str = "can_rx_i"
    tx: str = "can_tx_o"

    def cell(self, parts, separator="/", suffix=""):
        """A pattern for a flip-flop: tools put something of theirs behind its name, of which it may
        begin with `suffix`."""
        above = [part for part in self.instance.split("/") if part]
        return separator.join([*above, *parts]) + suffix + "*"


def head(what, tool, mark="#"):
    """The first lines of a file."""
    return HEAD.format(what=what, tool=tool, mark=mark)


def clock(place):
    """The clock, which is all that nextpnr takes of the timing; it stops at what it does not
    know."""
    if not place.mhz:
        return ""
    return ("# The clock of the core; a bit takes at least 8 clocks.\n"
            f"create_clock -name can_clock -period {1000 / place.mhz:.3f} "
            f"[get_ports {{{place.clock}}}]\n")


def sdc(place, get="get_cells", separator="/", bound="", suffix=""):
    """The timing, as all tools with SDC have it; `get`: the tool's command for flip-flops."""
    cells = {name: f"[{get} {{{place.cell(parts, separator, suffix)}}}]"
             for name, parts in (("sync", SYNC), ("sent", SENT))}
    lines = [clock(place), "\n" if place.mhz else "",
             "# The CAN bus has no clock: can_sync takes can_rx_i through two flip-flops.\n",
             f"set_false_path -from [get_ports {{{place.rx}}}] -to {cells['sync']}\n"]
    if place.reset:
        lines += ["# Asynchronous; the design releases it in step with the clock.\n",
                  f"set_false_path -from [get_ports {{{place.reset}}}]\n"]
    lines += ["# Straight from a flip-flop. Its way to the pin counts in the loop delay (BT-07).\n",
              f"set_max_delay {bound}{LOOP_NS:.3f} -from {cells['sent']} "
              f"-to [get_ports {{{place.tx}}}]\n"]
    return "".join(lines)


def ecp5(place):
    """Preferences of Diamond and nextpnr-ecp5."""
    text = head("can.lpf: for ECP5, Lattice Diamond and nextpnr-ecp5, which heeds the clock and "
                "the\n# pins alone.", "Diamond")
    if place.mhz:
        text += f'FREQUENCY PORT "{place.clock}" {place.mhz:.3f} MHZ ;\n'
    text += f'BLOCK PATH FROM PORT "{place.rx}" TO CELL "{place.cell(SYNC)}" ;\n'
    if place.reset:
        text += f'BLOCK PATH FROM PORT "{place.reset}" ;\n'
    text += (f'MAXDELAY FROM CELL "{place.cell(SENT)}" TO PORT "{place.tx}" {LOOP_NS:.3f} ns ;\n'
             f'IOBUF PORT "{place.rx}" IO_TYPE=LVCMOS33 PULLMODE=UP HYSTERESIS=ON ;\n'
             f'IOBUF PORT "{place.tx}" IO_TYPE=LVCMOS33 PULLMODE=UP SLEWRATE=FAST DRIVE=8 ;\n')
    return {"can.lpf": text}


def nexus(place):
    """Post-synthesis constraints of Radiant, and those that nextpnr knows."""
    pins = (f"ldc_set_port -iobuf {{IO_TYPE=LVCMOS33 PULLMODE=UP}} [get_ports {{{place.rx}}}]\n"
            "ldc_set_port -iobuf {IO_TYPE=LVCMOS33 PULLMODE=UP SLEWRATE=FAST DRIVE=8} "
            f"[get_ports {{{place.tx}}}]\n")
    return {"can.pdc": head("can.pdc: for CrossLink-NX and Certus-NX, Radiant.", "Radiant")
            + sdc(place) + pins,
            "can_nextpnr.pdc": head("can_nextpnr.pdc: clock and pins for CrossLink-NX and "
                                    "Certus-NX, nextpnr-nexus.", "nextpnr") + clock(place) + pins}


def gowin(place):
    """SDC, and the pins in a format of its own."""
    pins = head("can.cst: the pins, for Gowin EDA. IO_LOC is the board's.", "Gowin EDA", "//")
    for port, more in ((place.rx, "HYSTERESIS=H2L"), (place.tx, "DRIVE=8")):
        pins += f'IO_PORT "{port}" IO_TYPE=LVCMOS33 PULL_MODE=UP {more};\n'
    return {"can.sdc": head("can.sdc: timing, for Gowin EDA.", "Gowin EDA")
            + sdc(place, "get_regs"), "can.cst": pins}


def xilinx(place):
    """XDC."""
    pins = "".join(f"set_property IOSTANDARD LVCMOS33 [get_ports {{{port}}}]\n"
                   f"set_property PULLTYPE PULLUP [get_ports {{{port}}}]\n"
                   for port in (place.rx, place.tx))
    sent = place.cell(SENT, suffix=VIVADO_REGISTER)
    return {"can.xdc": head("can.xdc: for Vivado.", "Vivado")
            + sdc(place, bound="-datapath_only ", suffix=VIVADO_REGISTER)
            + pins + f"set_property IOB TRUE [get_cells {{{sent}}}]\n"}


def intel(place):
    """SDC, and assignments in Tcl."""
    pins = "".join(f"set_instance_assignment -name {name} {value} -to {{{port}}}\n"
                   for port in (place.rx, place.tx)
                   for name, value in (("IO_STANDARD", "{3.3-V LVCMOS}"),
                                       ("WEAK_PULL_UP_RESISTOR", "ON")))
    return {"can.sdc": head("can.sdc: timing, for Quartus.", "Quartus")
            + sdc(place, "get_registers", "|"),
            "can.tcl": head("can.tcl: the pins, for Quartus; source it from the project's .qsf.",
                            "Quartus") + pins
            + f"set_instance_assignment -name FAST_OUTPUT_REGISTER ON -to {{{place.tx}}}\n"}


def microchip(place, device, name, standard):
    """Libero: SDC and PDC; `name` stands before a port, `standard` before an I/O standard."""
    return {"can.sdc": head(f"can.sdc: timing, for {device}.", "Libero") + sdc(place),
            "can.pdc": head(f"can.pdc: the two pins, for {device}.\n# The balls are the board's: "
                            "add -pinname or -pin_name, and -fixed.", "Libero")
            + "# Slow edges are not needed at 1 Mbit/s and would only add loop delay.\n"
            f"set_io {name}{{{place.tx}}} {standard} -OUT_DRIVE 8 -SLEW High -RES_PULL Up "
            "-DIRECTION OUTPUT\n"
            "# The pull-up makes an open pin a silent, recessive bus.\n"
            f"set_io {name}{{{place.rx}}} {standard} -SCHMITT_TRIGGER On -RES_PULL Up "
            "-DIRECTION INPUT\n"}


def efinix(place):
    """SDC; pins are set in the Interface Designer, by its Python interface."""
    pins = head("can_pins.py: the pins, for Efinity's Interface Designer: run it with its object "
                "`design`.", "Efinity") + (
        f'design.create_input_gpio("{place.rx}")\n'
        f'design.set_property("{place.rx}", "PULL_OPTION", "WEAK_PULLUP")\n'
        f'design.set_property("{place.rx}", "SCHMITT_TRIGGER", "1")\n'
        f'design.create_output_gpio("{place.tx}")\n')
    return {"can.sdc": head("can.sdc: timing, for Efinity.", "Efinity") + sdc(place),
            "can_pins.py": pins}


def gatemate(place):
    """The clock for nextpnr, and the pins."""
    pins = head("can.ccf: the pins, for GateMate's p_r and nextpnr. The locations are of the "
                "evaluation board;\n# put in those of yours.", "p_r")
    if place.mhz:
        pins += f'NET "{place.clock}" Loc = "IO_SB_A8" | SCHMITT_TRIGGER=true;\n'
    pins += (f'NET "{place.rx}" Loc = "IO_NA_A0" | SCHMITT_TRIGGER=true | PULLUP=true;\n'
             f'NET "{place.tx}" Loc = "IO_NA_B0" | SLEW=fast;\n')
    return {"can.sdc": head("can.sdc: the clock, for GateMate, nextpnr (--sdc).", "nextpnr")
            + clock(place), "can.ccf": pins}


FAMILIES = {
    "ecp5": ecp5, "nexus": nexus, "gowin": gowin, "xilinx": xilinx, "intel": intel,
    "smartfusion": lambda place: microchip(place, "SmartFusion", "", "-iostd LVTTL"),
    "polarfire": lambda place: microchip(place, "PolarFire and SmartFusion2", "-port_name ",
                                         "-io_std LVCMOS33"),
    "efinix": efinix, "gatemate": gatemate}


def render(place):
    """family/file -> text."""
    return {f"{family}/{name}": text for family, make in FAMILIES.items()
            for name, text in make(place).items()}


def check_given(options):
    """Ends the program if the ports of can_ahb would be taken for those of a design."""
    needed = ["rx", "tx", "reset"] + (["clock"] if options["mhz"] != 0 else [])
    missing = [f"--{name}" for name in needed if options[name] is None]
    if options["instance"] and missing:
        sys.exit(f"constraints.py: --instance needs {', '.join(missing)}, too: ports of the design")


def check_distinct(place):
    """Ends the program if a port is named twice."""
    seen = {}
    for name in ("clock", "reset", "rx", "tx"):
        port = getattr(place, name)
        if name == "clock" and not place.mhz:
            continue
        if port and port in seen:
            sys.exit(f"constraints.py: --{seen[port]} and --{name} are both '{port}'")
        seen[port] = name


def check(place):
    """Ends the program if files cannot be written of such a place."""
    if place.mhz != 0 and not 8 <= place.mhz <= 1000:
        sys.exit(f"constraints.py: --mhz {place.mhz:g}: 8 to 1000 are allowed, a bit takes at "
                 "least 8 clocks; 0: none")
    for name in ("clock", "reset", "rx", "tx"):
        port = getattr(place, name)
        absent = not port and (name == "reset" or (name == "clock" and not place.mhz))
        if not absent and not PORT.fullmatch(port):
            sys.exit(f"constraints.py: --{name} '{port}' is not the name of a port, such as "
                     "can_rx or pads[3]")
    if place.instance and not INSTANCE.fullmatch(place.instance):
        sys.exit(f"constraints.py: --instance '{place.instance}' is not the place of an instance, "
                 "such as u_soc/u_can")


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    for name in ("instance", "mhz", "clock", "reset", "rx", "tx"):
        parser.add_argument(f"--{name}", type=type(getattr(Place, name)))
    options = vars(parser.parse_args())
    out = options.pop("out")
    place = Place(**{name: value for name, value in options.items() if value is not None})
    check(place)
    check_given(options)
    check_distinct(place)
    try:
        for name, text in render(place).items():
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            (out / name).write_text(text, encoding="utf-8")
    except OSError as error:
        sys.exit(f"constraints.py: {error.filename}: {error.strerror}")


if __name__ == "__main__":
    main()
