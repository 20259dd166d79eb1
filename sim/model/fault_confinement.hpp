// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultConfinement: the two error counters of the node model, one member function per rule (rule
// book 11).
#pragma once

#include <cstdint>

namespace vericansim {

/// Error state of a node (FC-11, FC-13).
enum class ErrorState : std::uint8_t { kActive, kPassive, kBusOff };

/// Role of a node in the current frame and in what follows it (RO-01, RO-02).
enum class Role : std::uint8_t { kNone, kReceiver, kTransmitter };

/// TEC and REC. Freezing (listen-only, FC-22) makes every step a no-op.
class FaultConfinement {
 public:
  [[nodiscard]] int tec() const { return tec_; }
  [[nodiscard]] int rec() const { return rec_; }
  [[nodiscard]] bool passive() const { return tec_ >= 128 || rec_ >= 128; }
  [[nodiscard]] bool warning() const { return tec_ >= 96 || rec_ >= 96; }
  [[nodiscard]] bool off() const { return tec_ >= 256; }

  void freeze(bool frozen) { frozen_ = frozen; }
  void preset(int tec, int rec) {
    tec_ = tec;
    rec_ = rec;
  }

  /// FC-02, FC-05, FC-16: an error starts an error flag. `exempt`: one of the two exceptions of
  /// FC-05.
  void error(Role role, bool exempt) {
    if (role == Role::kTransmitter) {
      if (!exempt) add_tec();
    } else {
      add_rec(1);
    }
  }
  /// FC-05a: the step that a passive node's ACK error withheld, at the first d in its flag.
  void withheld_ack_error() { add_tec(); }
  /// FC-06, FC-07: r sampled in an own active or overload flag.
  void flag_bit_error(Role role) { add_eight(role); }
  /// FC-04: d as the first bit after the end of a receiver's error flag.
  void dominant_after_flag() { add_rec(8); }
  /// FC-08: the 8th, 16th, ... d after an own flag.
  void eight_dominant_after_flag(Role role) { add_eight(role); }
  /// FC-09: own frame sent.
  void sent() {
    if (!frozen_ && tec_ > 0) --tec_;
  }
  /// FC-10: own acknowledge seen on the bus. Above 127 the set-back gives 127.
  void received() {
    if (frozen_ || rec_ == 0) return;
    rec_ = rec_ > 127 ? 127 : rec_ - 1;
  }

 private:
  void add_eight(Role role) {
    if (role == Role::kTransmitter) {
      add_tec();
    } else {
      add_rec(8);
    }
  }
  void add_tec() {
    if (!frozen_) tec_ += 8;
  }
  /// FC-14: holds from 128 on; a step from below may reach 135.
  void add_rec(int step) {
    if (!frozen_ && rec_ < 128) rec_ += step;
  }

  int tec_ = 0;
  int rec_ = 0;
  bool frozen_ = false;
};

}  // namespace vericansim
