# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of integrators' files share: the RTL's file list, a user's top, tools."""

import functools
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# A design that holds the core, as its user writes it: pins of the bus go through, the rest is
# the example of a page.
PORTS = """\
  input  logic        hclk, hresetn,
  input  logic        hsel_can, hwrite, hready,
  input  logic [31:0] haddr, hwdata,
  input  logic [1:0]  htrans,
  input  logic [2:0]  hsize, hburst,
  input  logic [3:0]  hprot,
  output logic [31:0] hrdata,
  output logic        hreadyout, hresp, irq,
  input  logic        can_rxd,
  output logic        can_txd"""
TOP = """\
module user_top (
{ports}
);
{declarations}
{instance}
  assign hrdata    = can_rdata;
  assign hreadyout = can_ready;
  assign hresp     = can_resp;
  assign irq       = can_irq;
endmodule
"""
DECLARATIONS = """\
  logic [31:0] can_rdata;
  logic        can_ready, can_resp, can_irq;
"""
INSTANCE = """\
  can_ahb #(.NumMb(16)) u_can (
    .hclk, .hresetn, .hsel(hsel_can), .haddr, .htrans, .hwrite, .hsize, .hburst, .hprot, .hready,
    .hwdata, .hrdata(can_rdata), .hreadyout(can_ready), .hresp(can_resp), .irq_o(can_irq),
    // verilator lint_off PINCONNECTEMPTY
    .irq_mb_o(), .irq_boff_o(), .irq_err_o(), .irq_twrn_o(), .irq_rwrn_o(), .irq_wak_o(),
    .time_out_o(), .irq_time_o(), .trace_o(),
    // verilator lint_on PINCONNECTEMPTY
    .ext_i(1'b0), .stop_req_i(1'b0), .can_rx_i(can_rxd), .can_tx_o(can_txd));
"""


def user_top(instance=INSTANCE, declarations=DECLARATIONS):
    """SystemVerilog of module user_top around an instance of can_ahb."""
    return TOP.format(ports=PORTS, instance=instance, declarations=declarations)


def rtl_files():
    """The files of rtl/can.f, relative to the project's root."""
    lines = (ROOT / "rtl/can.f").read_text(encoding="utf-8").splitlines()
    names = (line.split("#")[0].strip() for line in lines)
    return [f"rtl/{name}" for name in names if name]


def run(*command, cwd=ROOT, env=None):
    """Exit code and output of a command."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=env, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout


def read_once(files, scripts):
    """Yosys reads the files, and runs each of the scripts on what it has read."""
    whole = "; ".join(["design -save read", *(f"design -load read; {one}" for one in scripts)])
    code, text = run("yosys", "-q", "-f", "verilog -sv", *files, "-p", whole)
    if code != 0:
        raise AssertionError(text)


@functools.cache
def netlist(top, more=()):
    """What Yosys reads of `top`, flat, as JSON: ports, cells and nets with their attributes.
    `more`: files behind those of the core. Read once; nobody changes it."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "netlist.json"
        code, text = run("yosys", "-q", "-f", "verilog -sv", *rtl_files(), *more, "-p",
                         f"hierarchy -check -top {top}; proc; flatten; opt_clean; "
                         f"write_json {path}")
        if code != 0:
            raise AssertionError(text)
        return json.loads(path.read_text(encoding="utf-8"))["modules"][top]
