// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RegisterBench: a core whose registers are fuzzed, two engines that talk to each other on the same
// bus, and the judges.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "fuzz/fuzzed_core.hpp"
#include "fuzz/register_case.hpp"
#include "fuzz/wire_judge.hpp"
#include "model/frame.hpp"
#include "node/core_node.hpp"

namespace vericansim::fuzz {

/// Modes in which cases begin; and what the core is in while a case runs (transfers by mode).
enum class CoreMode : std::uint8_t {
  kRun,
  kFreeze,
  kDisable,
  kStop,
  kListenOnly,
  kLoopBack,
  kBusOff,
  kWrongTiming,  ///< on the bus with a bit timing that a case has written
};
inline constexpr unsigned kStartModes = 7;  ///< the modes that a bench can be brought into
inline constexpr unsigned kModes = 8;
[[nodiscard]] std::string to_string(CoreMode mode);

/// Ways back to a working node.
enum class Recovery : std::uint8_t { kHardReset, kSoftReset, kFreezeMode };

/// All nodes have 8 clocks a bit and one clock.
class RegisterBench {
 public:
  RegisterBench(FuzzedCore::Kind kind, std::uint64_t seed);

  /// Brings the core into `mode`, with its Rx FIFO or without.
  void enter(CoreMode mode, bool fifo);
  /// Runs a case while the others talk.
  void run(const RegisterCase &sequence);
  /// Makes the core work again, whatever it was made of, and lets it send and receive a frame.
  void recover(Recovery way);
  /// After the last case: what the peers have told each other has arrived.
  void check_peers();

  /// The mode that the core is in now.
  [[nodiscard]] CoreMode mode();
  [[nodiscard]] const WireJudge &judge() const { return judge_; }
  /// What was broken first; empty if nothing was.
  [[nodiscard]] std::string fault() const;
  [[nodiscard]] std::uint64_t clocks() const { return clocks_; }
  [[nodiscard]] std::uint64_t longest_acknowledge() const { return longest_acknowledge_; }
  [[nodiscard]] unsigned max_waits() const { return core_->ahb().report().max_waits; }
  /// Frames of the core that the others have received, by recover() and by cases.
  [[nodiscard]] std::uint64_t frames_of_core() const { return frames_of_core_; }

 private:
  void clock();
  void talk();
  void watch(std::uint64_t before);
  void break_rule(const std::string &what);
  std::uint32_t access(const AhbTransfer &transfer);
  std::uint32_t read(std::uint32_t address) { return access({.address = address}); }
  void write(std::uint32_t address, std::uint32_t data) {
    access({.address = address, .write = true, .data = data});
  }
  /// Reads `address` until `mask` is set, or clear; a fault if that takes longer than it may.
  void await(std::uint32_t address, std::uint32_t mask, bool set, const char *what);
  void wait(unsigned clocks);
  [[nodiscard]] unsigned clocks_per_bit();

  void configure(std::uint32_t ctrl, bool fifo);
  void go();
  void into_bus_off();
  void restart_peers();
  void send_one();
  void receive_one();
  [[nodiscard]] Frame draw_frame(std::uint32_t base);
  [[nodiscard]] std::uint32_t max_mb() const { return core_->num_mb() - 1; }

  Random random_;
  std::unique_ptr<FuzzedCore> core_;
  std::array<std::unique_ptr<CoreNode>, 2> peers_;
  WireJudge judge_;
  std::string fault_;
  std::uint64_t clocks_ = 0;
  bool mcr_write_ = false;         // the data phase is that of a write of MCR
  std::uint64_t reset_asked_ = 0;  // clock of the last soft reset that was asked for; 0: none
  std::uint64_t longest_acknowledge_ = 0;
  std::uint64_t frames_of_core_ = 0;
  std::array<unsigned, 2> pauses_{};
  bool talking_ = true;
  bool deaf_ = false;  // the core hears nothing
  CoreSetup setup_;
};

}  // namespace vericansim::fuzz
