// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RecordNode: a whole core whose pins are written down clock by clock, to be played to another
// simulator (replay.sv).
#pragma once

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// One clock of can_ahb: its inputs and, settled with them, its outputs before the edge.
struct PinRow {
  bool hresetn = false;
  AhbRequest request;
  bool hready = true;
  bool stop_req = false;
  bool can_rx = true;
  std::uint32_t hrdata = 0;
  bool hreadyout = true, hresp = false;
  std::uint8_t irq = 0;  ///< irq_o, _mb, _boff, _err, _twrn, _rwrn, _wak, _time from bit 0 on
  bool can_tx = true;
  std::uint64_t trace = 0;
  bool read_ends = false;  ///< hrdata is the result of a read
  bool ext = false;        ///< ext_i and time_out_o, of a core with the time unit
  bool time_out = false;
};

/// The row as one hexadecimal word for $readmemh; replay.sv has the layout.
std::string hex(const PinRow &row);

/// Model: a Verilated can_ahb that is not split. Each clock edge adds a row to the file.
template <typename Model>
class RecordNode final : public RtlNode {
 public:
  RecordNode(const std::string &name, unsigned num_mb, std::FILE *file)
      : RtlNode{name, {}, num_mb}, file_{file} {
    // A model begins with 0 everywhere and sees no falling edge of the reset: an edge of the clock,
    // not recorded, makes the registers what the reset makes them.
    top_.hresetn = 0;
    top_.eval();
    rising_edge(top_, top_.hclk);
    reset();
  }
  ~RecordNode() override { top_.final(); }

  void reset() override {
    ahb().reset();
    reading_ = false;
    show(ahb().request(), true);
    top_.can_rx_i = 1;
    top_.hresetn = 0;
    for (int i = 0; i < 4; ++i) edge();
    top_.hresetn = 1;
    edge();
    drive(static_cast<Level>(top_.can_tx_o));
  }

  void clock(Level rx) override {
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    const bool active = ahb().active();
    show(ahb().request(), true);
    top_.eval();
    if (!top_.hreadyout) {
      show(ahb().request(), false);
      top_.eval();
    }
    const AhbResponse response{top_.hrdata, top_.hreadyout != 0, top_.hresp != 0};
    edge();
    if (active) ahb().clock(response);
    drive(static_cast<Level>(top_.can_tx_o));
    after_edge();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &) override {
    throw std::logic_error("a recorded node has no second copy to look into");
  }
  void request_stop(bool stop) override { top_.stop_req_i = stop; }
  void external(bool level) override { top_.ext_i = level; }
  [[nodiscard]] std::uint64_t trace() const override { return top_.trace_o; }
  [[nodiscard]] std::uint8_t irq_lines() const override { return model_irq_lines(top_); }

 private:
  void show(const AhbRequest &r, bool ready) {
    shown_ = r;
    show_request(top_, r);
    top_.hready = ready;
  }

  void edge() {
    top_.eval();
    PinRow row{top_.hresetn != 0, shown_, top_.hready != 0, top_.stop_req_i != 0,
               top_.can_rx_i != 0};
    row.hrdata = top_.hrdata;
    row.hreadyout = top_.hreadyout;
    row.hresp = top_.hresp;
    row.irq = static_cast<std::uint8_t>(irq_lines() | (top_.irq_time_o != 0 ? 0x80 : 0));
    row.ext = top_.ext_i != 0;
    row.time_out = top_.time_out_o != 0;
    row.can_tx = top_.can_tx_o;
    row.trace = top_.trace_o;
    row.read_ends = reading_ && row.hreadyout && !row.hresp;
    if (std::fprintf(file_, "%s\n", hex(row).c_str()) < 0)
      throw std::runtime_error("cannot write the recording");
    if (top_.hready) {
      const bool taken = top_.hsel && (top_.htrans & 2) != 0 && top_.hresetn;
      reading_ = taken && !top_.hwrite;
    }
    rising_edge(top_, top_.hclk);
  }

  SerialContext context_;
  Model top_{&context_, "recorded"};
  std::FILE *file_;
  AhbRequest shown_;
  bool reading_ = false;  // the data phase of a read
};

}  // namespace vericansim
