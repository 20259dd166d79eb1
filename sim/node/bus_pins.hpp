// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins of can_apb, can_axil and can_wb on a Verilated model, for BusNodeOf (bus_node_of.hpp).
#pragma once

#include <functional>

#include "node/apb_master.hpp"
#include "node/axil_master.hpp"
#include "node/wb_master.hpp"

namespace vericansim {

/// can_apb.
struct ApbPins {
  using Master = ApbMaster;
  static auto &clock(auto &model) { return model.pclk; }
  static void reset(auto &model, bool active) { model.presetn = !active; }
  static void show(auto &model, const ApbRequest &request) {
    model.psel = request.psel;
    model.penable = request.penable;
    model.paddr = request.paddr;
    model.pprot = request.pprot;
    model.pwrite = request.pwrite;
    model.pstrb = request.pstrb;
    model.pwdata = request.pwdata;
  }
  static ApbResponse seen(const auto &model) {
    return {model.pready != 0, model.prdata, model.pslverr != 0};
  }
};

/// can_axil.
struct AxilPins {
  using Master = AxilMaster;
  static auto &clock(auto &model) { return model.aclk; }
  static void reset(auto &model, bool active) { model.aresetn = !active; }
  static void show(auto &model, const AxilRequest &request) {
    model.awvalid = request.awvalid;
    model.awaddr = request.awaddr;
    model.awprot = request.awprot;
    model.wvalid = request.wvalid;
    model.wdata = request.wdata;
    model.wstrb = request.wstrb;
    model.bready = request.bready;
    model.arvalid = request.arvalid;
    model.araddr = request.araddr;
    model.arprot = request.arprot;
    model.rready = request.rready;
  }
  static AxilResponse seen(const auto &model) {
    return {model.awready != 0, model.wready != 0, model.bvalid != 0, model.bresp,
            model.arready != 0, model.rvalid != 0, model.rdata,       model.rresp};
  }
};

/// can_wb; `Pipelined`: the cycles of the master, not the parameter of the model.
template <bool Pipelined>
struct WbPins {
  struct Master : WbMaster {
    explicit Master(std::function<void()> announce) : WbMaster{Pipelined, std::move(announce)} {}
  };
  static auto &clock(auto &model) { return model.wb_clk_i; }
  static void reset(auto &model, bool active) { model.wb_rst_i = active; }
  static void show(auto &model, const WbRequest &request) {
    model.wb_cyc_i = request.cyc;
    model.wb_stb_i = request.stb;
    model.wb_we_i = request.we;
    model.wb_adr_i = request.adr;
    model.wb_sel_i = request.sel;
    model.wb_dat_i = request.dat;
  }
  static WbResponse seen(const auto &model) {
    return {model.wb_dat_o, model.wb_ack_o != 0, model.wb_err_o != 0, model.wb_stall_o != 0};
  }
};

}  // namespace vericansim
