# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""VeriCAN for LiteX: the core on Wishbone as a module.

    from verican import VeriCAN
    VeriCAN.add_to(soc, "controller0", platform.request("can"), origin=0xF0040000)

The pads have `tx` and `rx`. verican/dts.py makes the device-tree node.
"""
from pathlib import Path

from migen import ClockSignal, Instance, Module, ResetSignal, Signal
from litex.soc.integration.soc import SoCRegion
from litex.soc.interconnect import wishbone

from verican.dts import constant
from verican.profiles import FEATURES, load_profiles

WINDOW = 0x2000  # bytes
SIZES = (16, 32, 64)


def rtl_folder(rtl=None):
    """The folder with can.f: what is given, or rtl/ of the tree in which this package lies."""
    if rtl is not None:
        folders = [Path(rtl)]
    else:
        folders = [parent / "rtl" for parent in Path(__file__).resolve().parents]
    for folder in folders:
        if (folder / "can.f").is_file():
            return folder
    raise FileNotFoundError(f"verican: no can.f in {', '.join(map(str, folders))}")


def rtl_files(folder):
    """The files of can.f as paths, in order."""
    lines = (folder / "can.f").read_text(encoding="utf-8").splitlines()
    names = (line.split("#")[0].strip() for line in lines)
    return [folder / name for name in names if name]


def add_sources(platform, folder):
    """Gives the platform the RTL. Gowin's tool reads even files that end with .sv as Verilog of
    2001, so a design that has not chosen a standard gets SystemVerilog."""
    for path in rtl_files(folder):
        platform.add_source(str(path))
    toolchain = getattr(platform, "toolchain", None)
    if type(toolchain).__name__ == "GowinToolchain":
        toolchain.options.setdefault("verilog_std", "sysv2017")


class Interrupt(Module):
    """What LiteX expects as `ev`: the level of irq_o. FlexCAN drivers clear it in the core."""

    def __init__(self):
        self.irq = Signal()


class VeriCAN(Module):
    """The core: `bus` is Wishbone with words of 32 bits, `ev.irq` its interrupt.

    platform: gets the sources; pads: tx, rx; num_mb: 16, 32 or 64 message buffers, None: the
    profile's; profile: small, standard or full (sw/profiles.yaml); rtl: the folder with can.f.
    """

    def __init__(self, platform, pads, num_mb=None, profile="full", rtl=None):
        folder = rtl_folder(rtl)
        profiles = load_profiles(folder)
        if profile not in profiles:
            raise ValueError(f"verican: no profile {profile!r}; there are {', '.join(profiles)}")
        if num_mb not in (None, *SIZES):
            raise ValueError(f"verican: num_mb is {num_mb!r}; it may be 16, 32 or 64")
        parameters = dict(profiles[profile])
        if num_mb is not None:
            parameters["NumMb"] = num_mb
        self.has = {"NumMb": parameters["NumMb"],
                    **{name: parameters.get(name, 1) for name in FEATURES}}
        self.bus = wishbone.Interface(data_width=32, adr_width=30)
        self.submodules.ev = Interrupt()

        self.specials += Instance(
            "can_wb", **{f"p_{name}": value for name, value in parameters.items()},
            p_RegionBits=WINDOW.bit_length() - 1,
            i_wb_clk_i=ClockSignal(), i_wb_rst_i=ResetSignal(),
            i_wb_cyc_i=self.bus.cyc, i_wb_stb_i=self.bus.stb, i_wb_we_i=self.bus.we,
            i_wb_adr_i=self.bus.adr, i_wb_sel_i=self.bus.sel, i_wb_dat_i=self.bus.dat_w,
            o_wb_dat_o=self.bus.dat_r, o_wb_ack_o=self.bus.ack, o_wb_err_o=self.bus.err,
            o_irq_o=self.ev.irq, i_ext_i=0, i_stop_req_i=0,
            i_can_rx_i=pads.rx, o_can_tx_o=pads.tx)
        add_sources(platform, folder)

    @classmethod
    def add_to(cls, soc, name, pads, origin, **options):
        """Adds a core named `name` at address `origin` to a SoC, with its region and interrupt, and
        constants that tell software and verican/dts.py what it has.

        LiteX' device-tree tool takes every region with "can" in its name for another controller, so
        such names are refused.
        """
        if "can" in name.lower():
            raise ValueError(f"verican: {name!r}: LiteX' device-tree tool makes a ctu,ctucanfd "
                             "node of every region with \"can\" in its name; take another name")
        if origin % WINDOW:
            raise ValueError(f"verican: origin {origin:#x} is no multiple of {WINDOW:#x}")
        core = cls(soc.platform, pads, **options)
        setattr(soc.submodules, name, core)
        soc.bus.add_slave(name, core.bus, SoCRegion(origin=origin, size=WINDOW, cached=False))
        if getattr(soc, "irq", None) is not None and soc.irq.enabled:
            soc.irq.add(name, use_loc_if_exists=True)
        soc.add_constant(f"{name}_verican", 1)
        for parameter, value in core.has.items():
            soc.add_constant(constant(name, parameter), value)
        return core
