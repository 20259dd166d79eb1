// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RecordRemoteNode: a whole can_remote whose pins are written down clock by clock, to be played to
// another simulator (replay_remote.sv).
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <deque>
#include <stdexcept>
#include <string>

#include "bus/node.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/user_access.hpp"

namespace vericansim {

/// Model: a Verilated can_remote that is not split. Number 3; joins the bus when its RAM is clear.
/// Each clock edge adds a row to the file.
template <typename Model>
class RecordRemoteNode final : public Node {
 public:
  RecordRemoteNode(const ClockConfig &clock, std::FILE *file)
      : Node{"recorded", clock}, file_{file} {
    top_.can_rx_i = 1;
    top_.node_i = 3;
    // As in RecordNode: the registers are what the reset makes them before the first row.
    top_.eval();
    rising_edge(top_, top_.clk_i);
    for (int i = 0; i < 4; ++i) edge();
    top_.rst_ni = 1;
  }
  ~RecordRemoteNode() override { top_.final(); }

  void clock(Level rx) override {
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    if (top_.usr_ready_o) top_.start_i = 1;
    show_access(top_, waiting_.empty() ? nullptr : &waiting_.front());
    top_.eval();
    if (!waiting_.empty() && top_.usr_ready_o) waiting_.pop_front();
    edge();
    top_.event_i = 0;
    drive(static_cast<Level>(top_.can_tx_o));
  }
  [[nodiscard]] std::uint64_t trace() const override { return top_.trace_o; }

  void access(const UserAccess &access) { waiting_.push_back(access); }
  void hold(bool on) { top_.usr_hold_i = on; }
  void event(unsigned events) { top_.event_i = static_cast<std::uint8_t>(events); }
  [[nodiscard]] bool operates() const { return top_.safe_o == 0; }

 private:
  // The row as one hexadecimal word for $readmemh, each field with digits of its own; the layout is
  // that of replay_remote.sv.
  void edge() {
    top_.eval();
    const bool read_ends = reading_;
    const std::string row = fmt::format(
        "{:x}{:x}{:x}{:x}{:x}{:x}{:03x}{:08x}{:x}{:02x}{:x}_"
        "{:x}{:x}{:08x}{:x}{:03x}{:x}{:x}{:x}{:x}{:x}{:013x}",
        int{top_.rst_ni}, int{top_.start_i}, int{top_.node_i}, int{top_.usr_req_i},
        int{top_.usr_we_i}, int{top_.usr_be_i}, unsigned{top_.usr_addr_i}, top_.usr_wdata_i,
        int{top_.usr_hold_i}, unsigned{top_.event_i}, int{top_.can_rx_i}, int{read_ends},
        int{top_.usr_ready_o}, top_.usr_rdata_o, int{top_.written_o}, unsigned{top_.written_addr_o},
        int{top_.written_len_o}, int{top_.apply_o}, int{top_.safe_o}, int{top_.state_o},
        int{top_.can_tx_o}, std::uint64_t{top_.trace_o});
    if (std::fprintf(file_, "%s\n", row.c_str()) < 0)
      throw std::runtime_error("cannot write the recording");
    reading_ = top_.rst_ni && top_.usr_req_i && top_.usr_ready_o && !top_.usr_we_i;
    rising_edge(top_, top_.clk_i);
  }

  SerialContext context_;
  Model top_{&context_, "recorded"};
  ModelContext model_context_{context_};
  std::FILE *file_;
  std::deque<UserAccess> waiting_;
  bool reading_ = false;  // the data of a read come in this clock
};

}  // namespace vericansim
