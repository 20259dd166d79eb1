// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FuzzedCore: a Verilated can_ahb of any parameters with every pin within reach, for sequences of
// accesses that no driver would make.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "bus/types.hpp"
#include "node/ahb_master.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"
#include "verilated.h"

namespace vericansim::fuzz {

/// The whole core, clock by clock. While its master rests, the pins of the AHB show what belongs to
/// other slaves, or anything at all with IDLE.
class FuzzedCore {
 public:
  virtual ~FuzzedCore() = default;
  /// Hard reset for two clocks; the master forgets what it was doing.
  virtual void reset() = 0;
  /// One rising edge with `rx` at the pin.
  virtual void clock(Level rx) = 0;
  [[nodiscard]] virtual Level tx() const = 0;
  [[nodiscard]] virtual std::uint64_t trace() const = 0;
  virtual void request_stop(bool stop) = 0;
  /// A word as privileged software would read it now; done on a copy, nothing happens to the core.
  [[nodiscard]] virtual std::uint32_t peek(std::uint32_t address) = 0;
  [[nodiscard]] AhbMaster &ahb() { return ahb_; }
  [[nodiscard]] unsigned num_mb() const { return num_mb_; }
  /// The core denies accesses of users where MCR.SUPV says so.
  [[nodiscard]] bool checks_privilege() const { return checks_privilege_; }
  /// What the pins show while the master rests.
  void seed_idle_pins(std::uint64_t seed) { idle_.seed(static_cast<std::uint32_t>(seed)); }

  /// The kinds of core that are fuzzed.
  enum class Kind : std::uint8_t { kFull, kUser };  ///< 64 buffers; 16 buffers and CheckHprot
  static std::unique_ptr<FuzzedCore> create(Kind kind);

 protected:
  FuzzedCore(unsigned num_mb, bool checks_privilege)
      : num_mb_{num_mb}, checks_privilege_{checks_privilege} {}
  std::minstd_rand idle_;
  AhbMaster ahb_;

 private:
  unsigned num_mb_;
  bool checks_privilege_;
};

template <typename Model>
class FuzzedCoreOf final : public FuzzedCore {
 public:
  using Root = std::remove_reference_t<decltype(*std::declval<Model &>().rootp)>;

  FuzzedCoreOf(unsigned num_mb, bool checks_privilege) : FuzzedCore{num_mb, checks_privilege} {
    top_.can_rx_i = 1;
    reset();
  }
  ~FuzzedCoreOf() override { Verilated::threadContextp(&context_); }
  FuzzedCoreOf(const FuzzedCoreOf &) = delete;
  FuzzedCoreOf &operator=(const FuzzedCoreOf &) = delete;

  void reset() override {
    ahb_.reset();
    show_request(top_, ahb_.request());
    top_.hready = 1;
    top_.hresetn = 0;
    for (int i = 0; i < 2; ++i) edge();
    top_.hresetn = 1;
  }

  void clock(Level rx) override {
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    if (ahb_.active()) {
      ahb_.clock(cycle(ahb_.request()));
      if (!ahb_.active()) show_others();
    } else {
      if ((idle_() & 0xF000U) == 0) show_others();
      edge();
    }
  }

  [[nodiscard]] Level tx() const override { return static_cast<Level>(top_.can_tx_o); }
  [[nodiscard]] std::uint64_t trace() const override { return top_.trace_o; }
  void request_stop(bool stop) override { top_.stop_req_i = stop; }

  [[nodiscard]] std::uint32_t peek(std::uint32_t address) override {
    // A root holds plain bits, a pointer to its symbols and a name that never change.
    std::memcpy(before_.get(), static_cast<const void *>(top_.rootp), sizeof(Root));
    AhbMaster probe;
    const AhbMaster::Ticket ticket = probe.submit({.address = address});
    while (!probe.done(ticket)) {
      AhbRequest request = probe.request();
      request.hwdata = ahb_.request().hwdata;  // of the transfer under way
      probe.clock(cycle(request));
    }
    std::memcpy(static_cast<void *>(top_.rootp), before_.get(), sizeof(Root));
    return probe.result(ticket).data;
  }

 private:
  // IDLE for us, or a transfer for another slave, which may let it wait.
  void show_others() {
    const std::uint32_t any = idle_();
    const bool other = (any & 0x100U) != 0;
    top_.hsel = other ? 0 : (any >> 9U) & 1U;
    top_.htrans = other ? (any >> 10U) & 3U : 0;
    top_.hready = other ? (any >> 12U) & 1U : 1;
    top_.haddr = idle_();
    top_.hwrite = (any >> 13U) & 1U;
    top_.hsize = (any >> 14U) & 3U;
    top_.hburst = (any >> 16U) & 7U;
    top_.hwdata = idle_();
  }

  // HREADYOUT, HRESP and HRDATA as they have settled with this cycle's request.
  AhbResponse cycle(const AhbRequest &request) {
    show_request(top_, request);
    top_.hready = top_.hreadyout;
    top_.eval();
    if (top_.hready != top_.hreadyout) {
      top_.hready = top_.hreadyout;
      top_.eval();
    }
    const AhbResponse response{top_.hrdata, top_.hreadyout != 0, top_.hresp != 0};
    edge();
    return response;
  }

  void edge() { rising_edge(top_, top_.hclk); }

  SerialContext context_;
  Model top_{&context_, "core"};
  std::unique_ptr<unsigned char[]> before_ = std::make_unique<unsigned char[]>(sizeof(Root));
};

}  // namespace vericansim::fuzz
