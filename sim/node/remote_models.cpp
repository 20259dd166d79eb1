// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteNode::create(): one class template for the Verilated profiles of can_remote.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "Vcan_core_bytes.h"
#include "Vcan_core_bytes___024root.h"
#include "Vcan_remote_full_3.h"
#include "Vcan_remote_full_3___024root.h"
#include "Vcan_remote_full_5.h"
#include "Vcan_remote_full_5___024root.h"
#include "Vcan_remote_same_3.h"
#include "Vcan_remote_same_3___024root.h"
#include "Vcan_remote_small_3.h"
#include "Vcan_remote_small_3___024root.h"
#include "Vcan_remote_small_5.h"
#include "Vcan_remote_small_5___024root.h"
#include "Vcan_remote_standard16_3.h"
#include "Vcan_remote_standard16_3___024root.h"
#include "Vcan_remote_standard_3.h"
#include "Vcan_remote_standard_3___024root.h"
#include "Vcan_remote_standard_5.h"
#include "Vcan_remote_standard_5___024root.h"
#include "node/engine_frame.hpp"
#include "node/quiet_engine.hpp"
#include "node/remote_node.hpp"
#include "node/remote_serial.hpp"
#include "node/split_core.hpp"

namespace vericansim {
namespace {

template <typename Model>
class RemoteNodeOf final : public RemoteNode {
 public:
  RemoteNodeOf(std::string name, const RemoteConfig &config, unsigned number,
               const BitTiming &timing, const ClockConfig &clock)
      : RemoteNode{std::move(name), clock},
        clocks_per_ms_{static_cast<std::uint64_t>(std::llround(clock.frequency_hz / 1000))},
        to_ms_{clocks_per_ms_} {
    set(timing);
    core_.engine().can_rx_i = 1;
    top_.eval();
    set_serial(root(), config.serial);
    top_.node_i = static_cast<std::uint8_t>(number & config.highest_number());
    reset();
  }

  void start() override {
    disturbed();
    starts_ = true;
  }

  void search(std::vector<BitTiming> rates) override {
    if constexpr (requires { top_.rootp->can_remote__DOT__gen_rate__DOT__u_rate__DOT__row_q; }) {
      disturbed();
      rates_ = std::move(rates);
      core_.touch();
      top_.rate_i = 0xF;
      set(rates_.at(0));
      core_.engine().eval();
    } else {
      throw std::logic_error(name() + " has one bit rate");
    }
  }
  [[nodiscard]] unsigned rate_row() const override { return row_; }

  [[gnu::flatten]] void clock(Level rx) override {
    const auto &engine = core_.engine();
    if (engine_alone()) {
      if (engine_quiet_.crosses_boundary(engine))
        return count(rx, [&] { engine_quiet_.cross_boundary(core_.engine(), rx); });
      if (engine_quiet_.synchronises(engine))
        return count(rx, [&] { engine_quiet_.synchronise(core_.engine(), rx); });
    }
    begin_edge(rx);
    const bool taken = show_next();
    count_ms();
    core_.edge();
    engine_quiet_.clocked(engine);
    if (!rates_.empty()) follow_rate();
    forget_events();
    end_edge();
    if (taken) finish_access();
  }

  [[nodiscard]] std::uint64_t quiet() const override {
    if (!engine_alone() || !core_.resting()) return 0;
    const std::uint64_t edges =
        std::min({engine_quiet_.edges(core_.engine(), watched()), to_ms_ - 1, core_.rest()});
    return edges != 0 && core_.wakes() ? 0 : edges;
  }

  void pass(std::uint64_t edges) override {
    core_.pass(edges);
    engine_quiet_.pass(core_.engine(), edges);
    passed(edges);
  }

  [[gnu::flatten]] void clock_lightly(Level rx) override {
    if (!engine_alone() || !engine_quiet_.counts(core_.engine())) return clock(rx);
    count(rx, [&] { engine_quiet_.clock_lightly(core_.engine(), rx); });
  }

  // An idle bit is like the one before it, but for TIMER, up to the next millisecond.
  [[nodiscard]] std::uint64_t skip_period() const override { return clocks_of_bit(core_.engine()); }

  [[nodiscard]] std::uint64_t skip_most() const override {
    if (!engine_alone() || core_.wakes() || !core_.ignores_ticks()) return 0;
    return std::min(to_ms_ - 1, core_.rest());
  }

  void skipped(std::uint64_t edges) override {
    core_.engine().timer_o += static_cast<std::uint16_t>(edges / skip_period());
    core_.pass(edges);
    passed(edges);
    left_out(edges);
  }

  [[nodiscard]] std::uint64_t trace() const override {
    catch_up();
    return core_.engine().trace_o;
  }
  [[nodiscard]] RemoteState state() const override {
    return static_cast<RemoteState>(top_.state_o);
  }
  [[nodiscard]] bool ready() const override { return top_.usr_ready_o != 0; }
  [[nodiscard]] const Frame &frame() const override { return frame_.frame(); }

  void hold(bool on) override {
    disturbed();
    core_.touch();
    top_.usr_hold_i = on;
  }
  void event(unsigned k) override {
    disturbed();
    core_.touch();
    top_.event_i = static_cast<std::uint8_t>(top_.event_i | 1U << k);
  }

  [[nodiscard]] bool idle() const override {
    catch_up();
    if (state() == RemoteState::kInit) return top_.start_i == 0 && !starts_ && accesses_.empty();
    constexpr unsigned kBetweenJobs = 24, kHold = 64;  // clocks
    return accesses_.empty() && quiet_ > (top_.usr_hold_i ? kHold : 0) + kBetweenJobs;
  }

  [[nodiscard]] std::vector<std::uint32_t> peek_words(unsigned first, unsigned n) const override {
    catch_up();
    const auto before = core_.save();
    std::vector<std::uint32_t> words;
    for (unsigned word = first; word < first + n; ++word) {
      const UserAccess read{false, 0, word, 0};
      core_.touch();
      show_access(top_, &read);
      while (!ready()) core_.edge();
      core_.edge();
      words.push_back(top_.usr_rdata_o);
    }
    core_.restore(before);
    return words;
  }

  [[nodiscard]] std::uint8_t peek(unsigned address) const override {
    const bool hidden = address >= remote_map::kHidden && address < remote_map::kNode;
    const auto &engine = core_.engine();
    switch (address) {
      case remote_map::kStatus: return status();
      case remote_map::kStatus + 1: return engine.tec_o;
      case remote_map::kStatus + 2: return engine.rec_o;
      default: return hidden ? 0 : byte_of(address);
    }
  }

 private:
  auto &root() { return *top_.rootp; }

  // No input changes at the next edge but the pin, and none has at the last.
  [[nodiscard]] bool engine_alone() const {
    return to_ms_ > 1 && accesses_.empty() && !shown_ && !starts_ && top_.event_i == 0 &&
           top_.rootp->can_remote__DOT__u_tick__DOT__ms_v == 0;
  }

  void begin_edge(Level rx) {
    count_edges(1);
    core_.engine().can_rx_i = static_cast<std::uint8_t>(rx);
  }

  // An edge at which the engine does no more than `of_engine`, unless the other half asks for more.
  template <typename OfEngine>
  void count(Level rx, OfEngine &&of_engine) {
    begin_edge(rx);
    --to_ms_;
    if (!core_.edge(std::forward<OfEngine>(of_engine))) engine_quiet_.clocked(core_.engine());
    if (!rates_.empty()) follow_rate();
    end_edge();
  }

  void end_edge() {
    const auto &engine = core_.engine();
    if (core_.take_engine_disturbed()) engine_quiet_.disturbed();
    drive(static_cast<Level>(engine.can_tx_o));
    if (ByteWiseFrame::concerns(engine)) frame_.clocked(engine);
    count_quiet(1);
    if (top_.written_o | top_.apply_o) tell_pulse();
  }

  void passed(std::uint64_t edges) {
    count_edges(edges);
    to_ms_ -= edges;
    count_quiet(edges);
  }

  void count_quiet(std::uint64_t edges) {
    const auto &engine = core_.engine();
    quiet_ = ready() && engine.idle_o && !engine.tx_req_i ? quiet_ + edges : 0;
  }

  void reset() {
    core_.reset(true);
    for (int i = 0; i < 4; ++i) core_.edge();
    core_.reset(false);
    core_.settle();
    constexpr unsigned kClearing = 4200;  // RN-60
    for (unsigned waited = 0; !ready(); ++waited) {
      if (waited == kClearing) throw std::logic_error(name() + ": the RAM is not cleared");
      core_.edge();
    }
    drive(static_cast<Level>(core_.engine().can_tx_o));
  }

  void set(const BitTiming &timing) {
    auto &engine = core_.engine();
    engine.presdiv_i = timing.prescaler - 1;
    engine.propseg_i = timing.prop - 1;
    engine.pseg1_i = timing.ps1 - 1;
    engine.pseg2_i = timing.ps2 - 1;
    engine.rjw_i = timing.sjw - 1;
    engine_quiet_.disturbed();
  }

  // The rows of the RTL's own table are for one clock; here the clock may be any.
  void follow_rate() {
    if constexpr (requires { top_.rootp->can_remote__DOT__gen_rate__DOT__u_rate__DOT__row_q; }) {
      const unsigned row = root().can_remote__DOT__gen_rate__DOT__u_rate__DOT__row_q;
      if (row == row_) return;
      row_ = row;
      set(rates_.at(row));
      core_.engine().eval();
    }
  }

  // Shows the next access; true if it is carried out at the coming edge.
  bool show_next() {
    const UserAccess *next = accesses_.empty() ? nullptr : &accesses_.front().access;
    if (next == nullptr && starts_) join();
    if (next == nullptr && !shown_) return false;
    core_.touch();
    show_access(top_, next);
    shown_ = next != nullptr;
    return shown_ && ready();
  }

  void forget_events() {
    if (top_.event_i == 0) return;
    core_.touch();
    top_.event_i = 0;
  }

  // Behind what user logic has written before.
  void join() {
    starts_ = false;
    core_.touch();
    top_.start_i = 1;
  }

  void finish_access() {
    const Waiting done = std::move(accesses_.front());
    accesses_.pop_front();
    if (on_access) on_access(done.access);
    if (done.done) done.done(top_.usr_rdata_o);
  }

  void count_ms() {
    const bool ends = --to_ms_ == 0;
    if (ends) to_ms_ = clocks_per_ms_;
    if (ends == (root().can_remote__DOT__u_tick__DOT__ms_v != 0)) return;
    core_.touch();
    root().can_remote__DOT__u_tick__DOT__ms_v = ends;
    if (ends && on_ms) on_ms();
  }

  void tell_pulse() {
    if (!on_pulse) return;
    if (top_.written_o) on_pulse({false, top_.written_addr_o, top_.written_len_o});
    if (top_.apply_o) on_pulse({true, 0, 0});
  }

  [[nodiscard]] std::uint8_t byte_of(unsigned address) const {
    return static_cast<std::uint8_t>(peek_words(address / 4, 1)[0] >> 8 * (address % 4));
  }

  // Byte 0 of STATUS; a netlist shows only what it has at its pins, the rest as the bus last saw
  // it.
  [[nodiscard]] std::uint8_t status() const {
    const auto &r = *top_.rootp;
    unsigned pins = top_.state_o | core_.engine().passive_o << 3U;
    if constexpr (requires { r.can_remote__DOT__gen_map__DOT__u_map__DOT__stale_q; })
      pins |= r.can_remote__DOT__gen_map__DOT__u_map__DOT__stale_q << 5U;
    if constexpr (requires { r.can_remote__DOT__u_state__DOT__unlocked_q; }) {
      return static_cast<std::uint8_t>(pins | r.can_remote__DOT__u_state__DOT__unlocked_q << 2U |
                                       r.can_remote__DOT__u_state__DOT__dup_q << 4U |
                                       r.can_remote__DOT__u_state__DOT__watchdog_q << 6U |
                                       r.can_remote__DOT__u_state__DOT__boff_seen_q << 7U);
    } else {
      return static_cast<std::uint8_t>(pins | (byte_of(remote_map::kStatus) & 0xF4));
    }
  }

  mutable SplitCore<Model, RemotePorts, Vcan_core_bytes> core_;  // peek_word() puts it back
  Model &top_ = core_.host();
  QuietEngine engine_quiet_;
  ByteWiseFrame frame_;
  std::uint64_t clocks_per_ms_;
  std::uint64_t to_ms_;
  std::uint64_t quiet_ = 0;       // clocks without work, on an idle bus
  std::vector<BitTiming> rates_;  // of a search
  unsigned row_ = 0;
  bool shown_ = false;
  bool starts_ = false;  // start_i waits for the accesses before it
};

RemoteConfig plain(RemoteConfig config) {
  const RemoteConfig defaults;
  config.name_bits = defaults.name_bits;
  config.serial = defaults.serial;
  config.rate_rows = defaults.rate_rows;
  return config;
}

bool is(const RemoteConfig &config, const char *profile, unsigned name_bits) {
  return config.name_bits == name_bits && plain(config) == plain(RemoteConfig::profile(profile));
}

// Standard with the most staged bytes: five set points of the cabinet (section 13).
bool is_standard16(const RemoteConfig &config) {
  RemoteConfig standard16 = RemoteConfig::profile("standard");
  standard16.stage_bytes = 16;
  return config.name_bits == 3 && plain(config) == plain(standard16);
}

// Small, for the demonstration of RN-16.
bool is_same(const RemoteConfig &config) {
  RemoteConfig same = RemoteConfig::profile("small");
  same.same_id = true;
  return config.name_bits == 3 && plain(config) == plain(same);
}

}  // namespace

bool RemoteNode::has(const RemoteConfig &config) {
  return is(config, "small", 3) || is(config, "small", 5) || is(config, "standard", 3) ||
         is(config, "standard", 5) || is_standard16(config) || is(config, "full", 3) ||
         is(config, "full", 5) || is_same(config);
}

std::string RemoteNode::available() {
  return "profile small, standard or full with its parameters, standard also with 16 staged bytes, "
         "small also with same_id";
}

std::unique_ptr<RemoteNode> RemoteNode::create(std::string name, const RemoteConfig &config,
                                               unsigned number, const BitTiming &timing,
                                               const ClockConfig &clock) {
  config.validate();
  timing.validate();
  const auto make = [&]<typename Model>(std::type_identity<Model>) {
    return std::make_unique<RemoteNodeOf<Model>>(std::move(name), config, number, timing, clock);
  };
  if (is(config, "small", 3)) return make(std::type_identity<Vcan_remote_small_3>{});
  if (is(config, "small", 5)) return make(std::type_identity<Vcan_remote_small_5>{});
  if (is(config, "standard", 3)) return make(std::type_identity<Vcan_remote_standard_3>{});
  if (is(config, "standard", 5)) return make(std::type_identity<Vcan_remote_standard_5>{});
  if (is(config, "full", 3)) return make(std::type_identity<Vcan_remote_full_3>{});
  if (is(config, "full", 5)) return make(std::type_identity<Vcan_remote_full_5>{});
  if (is_same(config)) return make(std::type_identity<Vcan_remote_same_3>{});
  if (is_standard16(config)) return make(std::type_identity<Vcan_remote_standard16_3>{});
  throw std::invalid_argument("no RTL is built with these parameters; allowed: " + available());
}

}  // namespace vericansim
