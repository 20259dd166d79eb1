# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A design that takes the core from LiteX: a SoC without CPU, a serial bridge and one controller.
import sys

from verican import VeriCAN


def add_can(soc):
    """One controller with 32 buffers."""
    return VeriCAN.add_to(soc, "controller0", soc.platform.request("can"), 0xF0040000,
                          profile="standard")


def main():
    """Writes the Verilog."""
    from litex.build.generic_platform import Pins, Subsignal
    from litex.build.lattice import LatticePlatform
    from litex.soc.integration.builder import Builder
    from litex.soc.integration.soc_core import SoCCore
    pins = [("clk12", 0, Pins("J3")), ("serial", 0, Subsignal("tx", Pins("B12")),
                                      Subsignal("rx", Pins("B10"))),
            ("can", 0, Subsignal("tx", Pins("A1")), Subsignal("rx", Pins("A2")))]
    platform = LatticePlatform("ice40-hx8k-ct256", pins, toolchain="icestorm")
    platform.default_clk_name, platform.default_clk_period = "clk12", 1e9 / 12e6
    soc = SoCCore(platform, 12_000_000, cpu_type=None, uart_name="uartbone", ident="",
                  integrated_sram_size=0, integrated_rom_size=0)
    from migen import ClockDomain
    soc.clock_domains.cd_sys = ClockDomain(reset_less=False)
    soc.comb += soc.cd_sys.clk.eq(platform.request("clk12"))
    add_can(soc)
    Builder(soc, output_dir="build", csr_json="build/csr.json", compile_software=False).build(
        run=False)


if __name__ == "__main__" and sys.argv[1:] == ["build"]:
    main()
