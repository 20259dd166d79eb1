// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferRig: one whole core, one node of the rule book's model as the rest of the bus, and the
// model of the buffers that follows every access and every frame.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "bus/trace.hpp"
#include "harness/core_build.hpp"
#include "harness/test_wave.hpp"
#include "mailbox/mailbox_rig.hpp"
#include "model/buffer_model.hpp"
#include "model/frame_codec.hpp"
#include "model/node_model.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// Registers that MailboxRig's tests do not need.
namespace reg {
inline constexpr std::uint32_t kEsr2 = 0x038;
inline constexpr std::uint32_t kCrcr = 0x044;
inline constexpr std::uint32_t kMcrLprioEn = 1u << 13;
inline constexpr std::uint32_t kMcrAen = 1u << 12;
inline constexpr std::uint32_t kXctrlOneShot = 1u << 1;
inline constexpr std::uint32_t kXctrlOsmb = 1u << 2;
inline constexpr std::uint32_t kCsOneShot = 1u << 28;
}  // namespace reg

/// What MCR, CTRL1, CTRL2 and XCTRL are for a configuration; MCR without FRZ and HALT.
[[nodiscard]] std::uint32_t mcr_of(const BufferConfig &config);
[[nodiscard]] std::uint32_t ctrl_of(const BufferConfig &config);
[[nodiscard]] std::uint32_t ctrl2_of(const BufferConfig &config);
[[nodiscard]] std::uint32_t xctrl_of(const BufferConfig &config);

/// Eight clocks a bit. The peer acknowledges, arbitrates, flags errors, all by the rule book. Each
/// access and each event goes to the model; a disagreement fails the test at once and shows what
/// the model would have allowed.
class BufferRig {
 public:
  static constexpr unsigned kBit = 8;  ///< clocks

  /// The core is in freeze mode after this, with `config` and all masks 1.
  explicit BufferRig(const BufferConfig &config = {}, const BufferWindows &windows = {})
      : BufferRig{config, {.num_mb = config.num_mb}, windows} {}
  /// A core of a build; `config` must be one that it can have.
  BufferRig(const BufferConfig &config, const CoreBuild &listed, const BufferWindows &windows = {});

  // ---- Software on the core; runs the bus until the access is done

  std::uint32_t read(std::uint32_t address);
  /// C/S word, read again while it shows BUSY.
  std::uint32_t read_cs(unsigned mb);
  void write(std::uint32_t address, std::uint32_t data);
  void write(std::uint32_t address, AhbSize size, std::uint32_t data);
  /// The access is driven in clock `clock` (see clocks()), or as soon as the bus of the core is
  /// free.
  void at(std::uint64_t clock, const AhbTransfer &transfer) { planned_.emplace(clock, transfer); }
  void put(unsigned mb, const MbWords &words);
  void put_tx(unsigned mb, const Frame &frame, unsigned code = kTxActive) {
    put(mb, mb_words(frame, code));
  }
  void put_rx(unsigned mb, const Frame &like, unsigned code = kRxEmpty);
  /// New configuration: through freeze mode and back to where it was. Masks stay.
  void configure(const BufferConfig &config);
  [[nodiscard]] const BufferConfig &config() const { return model.config(); }
  void go();
  bool freeze(unsigned clocks = 4000);
  void soft_reset();

  // ---- The bus

  /// The peer sends these frames, one after the other, as soon as it may.
  void peer_sends(const Frame &frame) { peer_queue_.push_back(frame); }
  /// Peer's frame to the end, and until the core has dealt with it.
  void receive(const Frame &frame);
  void run(unsigned clocks);
  void run_bits(unsigned bits) { run(bits * kBit); }
  bool run_until(const std::function<bool()> &done, unsigned clocks);
  /// Until the bus is idle, nothing waits to be sent, and all windows of the model are over.
  void quiet();
  /// In bit `bit` of the coming frames (SOF = 0, stuff bits count) the core sees the opposite of
  /// the wire, `times` times.
  void disturb(unsigned bit, unsigned times = 1);
  /// The peer takes back what it has not begun to send.
  void peer_forgets() { peer_queue_.clear(); }

  // ---- Judging

  /// Reads IFLAG, the ID and data words of all buffers, which has no side effects.
  void compare_quietly();
  /// Reads everything, C/S words in ascending order: locks and services as a driver would.
  void compare();

  [[nodiscard]] std::uint64_t clocks() const { return clock_; }
  [[nodiscard]] std::uint64_t frames_started() const { return starts_; }
  [[nodiscard]] const std::vector<Frame> &sent() const { return sent_; }
  [[nodiscard]] Field field() const { return trace_field(node_->trace()); }
  [[nodiscard]] unsigned bit_of_frame() const { return bit_; }
  [[nodiscard]] RtlNode &node() { return *node_; }
  [[nodiscard]] NodeModel &peer() { return peer_; }
  /// Clocks at which things happened last.
  [[nodiscard]] std::uint64_t start_clock() const { return start_clock_; }
  [[nodiscard]] std::uint64_t end_clock() const { return end_clock_; }

  BufferModel model;

 private:
  /// With a core of this build and no other.
  BufferRig(const BufferConfig &config, const BufferWindows &windows, const CoreBuild &build);

  struct Done {
    std::uint64_t clock;
    AhbTransfer transfer;
    AhbResult result;
  };

  void step();
  void drive_accesses();
  void collect_accesses();
  void tell_model(bool all);
  void bus_event(const Trace &trace);
  void end_bit(Field field);
  void sampled(const Trace &trace);
  void check_liveness();
  void check_model();
  AhbResult access(const AhbTransfer &transfer);
  [[nodiscard]] Level rx_level() const;

  std::unique_ptr<RtlNode> node_;
  std::optional<TestWave> wave_;
  NodeModel peer_;
  Level peer_level_ = Level::kRecessive, peer_next_level_ = Level::kRecessive;
  std::deque<Frame> peer_queue_;
  std::multimap<std::uint64_t, AhbTransfer> planned_;
  std::deque<std::pair<BusMaster::Ticket, AhbTransfer>> under_way_;
  std::deque<Done> done_;

  std::uint64_t clock_ = 0;
  std::uint16_t timer_ = 0;  // bit times since the start, modulo 2^16
  std::uint16_t stamp_ = 0;  // timer_ at the start of the identifier
  std::vector<Level> bits_;  // of the frame under way, SOF first
  Frame foreign_;            // what the peer is sending
  unsigned bit_ = 0;
  bool in_frame_ = false;
  bool header_told_ = false;
  std::uint64_t starts_ = 0, start_clock_ = 0, end_clock_ = 0, idle_since_ = 0;
  std::vector<Frame> sent_;
  std::optional<std::pair<unsigned, unsigned>> disturbance_;  // bit, times
  bool was_running_ = false;
  bool stopped_ = false;  // in the clock before
  bool failed_ = false;
};

}  // namespace vericansim
