// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FramePort::create(): one class template for the Verilated profiles of can_remote.
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "Vcan_remote_full_3.h"
#include "Vcan_remote_full_3___024root.h"
#include "Vcan_remote_full_5.h"
#include "Vcan_remote_full_5___024root.h"
#include "Vcan_remote_odd_3.h"
#include "Vcan_remote_odd_3___024root.h"
#include "Vcan_remote_odd_5.h"
#include "Vcan_remote_odd_5___024root.h"
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
#include "Vcan_remote_time_3.h"
#include "Vcan_remote_time_3___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/remote_serial.hpp"
#include "remote/frame_port.hpp"

namespace vericansim {
namespace {

template <typename Model>
class FramePortOf final : public FramePort {
 public:
  FramePortOf(std::uint32_t serial, unsigned number) {
    top_.eval();
    set_serial(root(), serial);
    top_.node_i = static_cast<std::uint8_t>(number);
    reset();
  }
  ~FramePortOf() override { top_.final(); }

  void start() override {
    top_.start_i = 1;
    clocks(16);
  }
  void set_counters(unsigned tec, unsigned rec, bool passive, bool bus_off) override {
    root().can_remote__DOT__u_core__DOT__tec_o_v = static_cast<std::uint8_t>(tec);
    root().can_remote__DOT__u_core__DOT__rec_o_v = static_cast<std::uint8_t>(rec);
    root().can_remote__DOT__u_core__DOT__passive_o_v = passive;
    root().can_remote__DOT__u_core__DOT__boff_o_v = bus_off;
  }
  void set_clock(const std::array<std::uint8_t, 16> &row) override {
    if constexpr (kHasClock) {
      const auto word = [&row](unsigned at) {
        std::uint32_t value = 0;
        for (unsigned i = 4; i-- > 0;) value = value << 8 | row[at + i];
        return value;
      };
      root().can_remote__DOT__u_core__DOT__time_sync_stat_o_v = word(0);
      root().can_remote__DOT__u_core__DOT__time_sync_ofs_o_v = word(4);
      root().can_remote__DOT__u_core__DOT__time_ext_o_v = std::uint64_t{word(12)} << 32 | word(8);
    } else {
      throw std::logic_error("this node has no clock");
    }
  }
  [[nodiscard]] unsigned take_time_commands() override { return std::exchange(commands_, 0); }
  void take_time() override { top_.time_take_i = 1; }
  [[nodiscard]] bool take_release() override {
    const bool seen = released_;
    released_ = false;
    return seen;
  }
  [[nodiscard]] bool running() const override {
    return root().can_remote__DOT__u_core__DOT__run_i_v != 0;
  }

  void show(const std::optional<UserAccess> &access) override {
    show_access(top_, access ? &*access : nullptr);
  }
  [[nodiscard]] bool ready() const override { return top_.usr_ready_o != 0; }
  [[nodiscard]] std::uint32_t read_data() const override { return top_.usr_rdata_o; }
  void hold(bool on) override { top_.usr_hold_i = on; }
  void event(unsigned events) override { top_.event_i = static_cast<std::uint8_t>(events); }

  [[nodiscard]] std::uint8_t peek(unsigned address) const override {
    const auto &memory = root().can_remote__DOT__u_port__DOT__u_ram__DOT__mem;
    if (address < kHiddenPart && address + kUpper >= 4 * words()) return 0;  // no memory
    return static_cast<std::uint8_t>(memory[word_of(address)] >> (8 * (address % 4)));
  }
  void poke(unsigned address, std::uint8_t byte) override {
    auto &word = root().can_remote__DOT__u_port__DOT__u_ram__DOT__mem[word_of(address)];
    const unsigned shift = 8 * (address % 4);
    word = (word & ~(0xFFU << shift)) | static_cast<unsigned>(byte) << shift;
  }
  [[nodiscard]] RemoteState state() const override {
    return static_cast<RemoteState>(top_.state_o);
  }
  [[nodiscard]] bool safe() const override { return top_.safe_o != 0; }
  [[nodiscard]] bool idle() const override {
    return root().can_remote__DOT__u_step__DOT__job_q == 0;
  }

 protected:
  void hold_reset(bool on) override {
    top_.rst_ni = !on;
    if (!on) return;
    top_.start_i = 0;
    show(std::nullopt);
    hold(false);
    set_counters(0, 0, false, false);
  }
  void edge(const Engine &engine) override {
    auto &r = root();
    r.can_remote__DOT__u_core__DOT__tick_o_v = engine.tick;
    r.can_remote__DOT__u_core__DOT__rx_hdr_o_v = engine.hdr;
    r.can_remote__DOT__u_core__DOT__rx_byte_we_o_v = engine.byte_we;
    r.can_remote__DOT__u_core__DOT__rx_valid_o_v = engine.valid;
    r.can_remote__DOT__u_core__DOT__tx_next_o_v = engine.next;
    r.can_remote__DOT__u_core__DOT__tx_ok_o_v = engine.ok;
    r.can_remote__DOT__u_core__DOT__tx_fail_o_v = engine.fail;
    r.can_remote__DOT__u_core__DOT__gap_o_v = engine.gap;
    r.can_remote__DOT__u_core__DOT__transmitter_o_v = engine.transmitter;
    r.can_remote__DOT__u_core__DOT__rx_ide_o_v = engine.ide;
    r.can_remote__DOT__u_core__DOT__rx_rtr_o_v = engine.rtr;
    r.can_remote__DOT__u_core__DOT__rx_id_o_v = engine.id << 18;
    r.can_remote__DOT__u_core__DOT__rx_dlc_o_v = static_cast<std::uint8_t>(engine.dlc);
    r.can_remote__DOT__u_core__DOT__rx_byte_o_v = static_cast<std::uint8_t>(engine.byte);
    r.can_remote__DOT__u_tick__DOT__ms_v = engine.ms;
    rising_edge(top_, top_.clk_i);
    top_.event_i = 0;
    top_.time_take_i = 0;
    if constexpr (kHasClock) commands_ |= r.can_remote__DOT__u_core__DOT__time_cmd_i_v;
    if (r.can_remote__DOT__u_core__DOT__boff_rec_i_v == 0) released_ = true;
  }
  [[nodiscard]] Asked asked() const override {
    return {root().can_remote__DOT__u_core__DOT__tx_req_i_v != 0,
            root().can_remote__DOT__u_core__DOT__tx_dlc_i_v,
            root().can_remote__DOT__u_core__DOT__tx_word_i_v};
  }
  [[nodiscard]] std::vector<RemotePulse> pulses() const override {
    std::vector<RemotePulse> seen;
    if (top_.written_o) seen.push_back({false, top_.written_addr_o, top_.written_len_o});
    if (top_.apply_o) seen.push_back({true, 0, 0});
    return seen;
  }

 private:
  static constexpr bool kHasClock = std::is_same_v<Model, Vcan_remote_time_3>;
  auto &root() { return *top_.rootp; }
  // A smaller RAM has the upper 512 bytes at its end.
  static constexpr unsigned kUpper = 512, kHiddenPart = remote_map::kHidden;
  [[nodiscard]] unsigned words() const {
    const auto &memory = root().can_remote__DOT__u_port__DOT__u_ram__DOT__mem;
    return static_cast<unsigned>(sizeof(memory) / sizeof(memory[0]));
  }
  [[nodiscard]] unsigned word_of(unsigned address) const { return address / 4 % words(); }
  [[nodiscard]] const auto &root() const { return *top_.rootp; }

  SerialContext context_;
  Model top_{&context_, "can_remote"};
  ModelContext model_context_{context_};
  bool released_ = false;
  unsigned commands_ = 0;
};

}  // namespace

std::unique_ptr<FramePort> FramePort::create(const std::string &profile, unsigned name_bits,
                                             std::uint32_t serial, unsigned number) {
  if (profile == "small" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_small_3>>(serial, number);
  if (profile == "small" && name_bits == 5)
    return std::make_unique<FramePortOf<Vcan_remote_small_5>>(serial, number);
  if (profile == "standard16" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_standard16_3>>(serial, number);
  if (profile == "standard" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_standard_3>>(serial, number);
  if (profile == "standard" && name_bits == 5)
    return std::make_unique<FramePortOf<Vcan_remote_standard_5>>(serial, number);
  if (profile == "time" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_time_3>>(serial, number);
  if (profile == "full" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_full_3>>(serial, number);
  if (profile == "full" && name_bits == 5)
    return std::make_unique<FramePortOf<Vcan_remote_full_5>>(serial, number);
  if (profile == "odd" && name_bits == 3)
    return std::make_unique<FramePortOf<Vcan_remote_odd_3>>(serial, number);
  if (profile == "odd" && name_bits == 5)
    return std::make_unique<FramePortOf<Vcan_remote_odd_5>>(serial, number);
  throw std::invalid_argument("no model of profile " + profile + " with NameBits " +
                              std::to_string(name_bits));
}

}  // namespace vericansim
