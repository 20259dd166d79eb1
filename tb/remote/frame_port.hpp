// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FramePort: a Verilated can_remote whose engine is hollow; frames go in and out at the engine's
// ports, eight clocks a bit, without the bits that nobody looks at.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/frame.hpp"
#include "model/remote_model.hpp"
#include "node/user_access.hpp"

namespace vericansim {

/// can_remote at the engine's port. The clock at which something happens is counted from reset.
class FramePort {
 public:
  /// `profile` as RemoteConfig::profile(), or "time": standard with a clock, or "odd":
  /// parameters that no profile has (tb/CMakeLists.txt); NameBits 3 or 5;
  /// throws std::invalid_argument if there is no such model. After it the node has been reset and
  /// its RAM is clear.
  static std::unique_ptr<FramePort> create(const std::string &profile, unsigned name_bits,
                                           std::uint32_t serial, unsigned number);
  virtual ~FramePort() = default;

  /// Clocks of a bit; of the header and CRC only as many bits pass as the node can tell.
  static constexpr unsigned kBit = 8;

  // ---- Bus

  /// A reset in the midst of whatever is going on, of the engine too; after it the RAM is clear and
  /// start_i = 0.
  void reset();
  /// start_i = 1.
  virtual void start() = 0;
  /// A frame that somebody else sends, from its header to the sample point of INT3: `bits` bits for
  /// each data byte, 8 on a real bus.
  void receive(const Frame &frame, unsigned bits = 1);
  /// The same up to the pulse of rx_valid_o; the bits behind it are left to the caller.
  void receive_until_valid(const Frame &frame, unsigned bits = 1);
  /// The header and `bytes` bytes of a frame, which an error ends.
  void receive_broken(const Frame &frame, unsigned bytes);
  /// One bit: sample point, then seven clocks.
  void bit();
  /// What the node asks the engine to send, if it does.
  [[nodiscard]] bool asks() const;
  enum class End { kSent, kLost, kError };
  /// The engine sends what it is asked for (asks() must be true) and ends as `end` says. Gives the
  /// frame as far as it was taken.
  Frame send(End end = End::kSent);
  /// Sends everything that is asked for within the next bits.
  std::vector<Frame> drain();
  /// A pulse of the millisecond, and time to work: for all producers, too.
  void ms();
  /// A pulse of the millisecond in the next clock.
  void pulse_ms() { engine_.ms = true; }
  /// A pulse in that clock from now on: 1 is the next.
  void pulse_ms_in(unsigned clocks) {
    in(clocks, [this] { engine_.ms = true; });
  }
  /// Calls `what` before that clock from now on, whatever runs until then; 1 is the next.
  void in(unsigned clocks, std::function<void()> what) {
    later_.emplace_back(clocks_ + clocks, std::move(what));
  }
  virtual void set_counters(unsigned tec, unsigned rec, bool passive, bool bus_off) = 0;
  /// What the engine tells of the clock (TM-108): TSSTAT, TSOFS, captured time, the low byte of
  /// each first. std::logic_error for a node without.
  virtual void set_clock(const std::array<std::uint8_t, 16> &row) = 0;
  /// Commands to the time unit since the last call, can_pkg::Time*.
  [[nodiscard]] virtual unsigned take_time_commands() = 0;
  /// time_take_i in the next clock.
  virtual void take_time() = 0;
  /// boff_rec_i has been 0 since the last call.
  [[nodiscard]] virtual bool take_release() = 0;
  /// run_i.
  [[nodiscard]] virtual bool running() const = 0;

  // ---- User logic

  /// The access is shown until usr_ready_o; gives the data of a read.
  std::uint32_t user(const UserAccess &access);
  std::uint32_t user_read(unsigned word) { return user({false, 0, word, 0}); }
  void user_write(unsigned word, std::uint32_t data, unsigned lanes = 0xF) {
    (void)user({true, lanes, word, data});
  }
  /// Shows an access, or none, in the clocks to come, without waiting.
  virtual void show(const std::optional<UserAccess> &access) = 0;
  [[nodiscard]] virtual bool ready() const = 0;
  [[nodiscard]] virtual std::uint32_t read_data() const = 0;
  virtual void hold(bool on) = 0;
  /// event_i in the next clock.
  virtual void event(unsigned events) = 0;
  [[nodiscard]] std::vector<RemotePulse> take_pulses();
  /// Clock of the last pulse.
  [[nodiscard]] std::uint64_t pulse_clock() const { return pulse_clock_; }

  // ---- Inside

  [[nodiscard]] virtual std::uint8_t peek(unsigned address) const = 0;
  virtual void poke(unsigned address, std::uint8_t byte) = 0;
  [[nodiscard]] virtual RemoteState state() const = 0;
  [[nodiscard]] virtual bool safe() const = 0;
  /// The step machine has nothing to do.
  [[nodiscard]] virtual bool idle() const = 0;
  [[nodiscard]] std::uint64_t clocks() const { return clocks_; }
  /// One clock.
  void clock();
  void clocks(unsigned n) {
    for (; n != 0; --n) clock();
  }

 protected:
  /// rst_ni, and with it what else is not driven yet.
  virtual void hold_reset(bool on) = 0;
  /// What the engine tells in one clock.
  struct Engine {
    bool tick = false, hdr = false, byte_we = false, valid = false;
    bool next = false, ok = false, fail = false, ms = false;
    bool gap = true, transmitter = false;
    bool ide = false, rtr = false;
    unsigned id = 0, dlc = 0, byte = 0;
  };
  struct Asked {
    bool request = false;
    unsigned dlc = 0;
    std::uint32_t word = 0;
  };
  virtual void edge(const Engine &engine) = 0;
  [[nodiscard]] virtual Asked asked() const = 0;
  /// written_o, then apply_o, of the clock that has just passed.
  [[nodiscard]] virtual std::vector<RemotePulse> pulses() const = 0;

 private:
  void pulses_in(bool Engine::*event);
  void do_what_is_due();

  Engine engine_;
  std::vector<RemotePulse> pulses_;
  std::vector<std::pair<std::uint64_t, std::function<void()>>> later_;
  std::uint64_t clocks_ = 0;
  std::uint64_t pulse_clock_ = 0;
};

}  // namespace vericansim
