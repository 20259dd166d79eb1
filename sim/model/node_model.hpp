// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeModel: a CAN node as the rule book describes it, one call a bit; the judge of the RTL
// (rule 19.5).
#pragma once

#include <cstdint>
#include <optional>

#include "bus/field.hpp"
#include "bus/types.hpp"
#include "model/fault_confinement.hpp"
#include "model/frame.hpp"
#include "model/node_receive.hpp"

namespace vericansim {

/// Options of a node. May be changed between bits; listen_only, loop_back and self_reception only
/// while no frame is under way.
struct NodeConfig {
  bool listen_only = false;  ///< MO-01: never dominant, counters frozen
  bool loop_back = false;    ///< MO-04: hears only itself, pin recessive, ACK not needed
  bool fd_tolerant = false;  ///< FF-06: recessive FDF bit starts integration
  bool one_shot = false;     ///< MO-09: one start for each request
  bool boff_rec = false;  ///< true: bus-off lasts until this is cleared; latched at entry (BO-03)
  bool self_reception = false;  ///< MO-06: own frames are delivered too (loop_back implies it)
};

/// Kind of a detected error; at most one a bit (ED-17).
enum class NodeError : std::uint8_t {
  kNone,
  kBit0,  ///< sent dominant, saw recessive
  kBit1,  ///< sent recessive, saw dominant
  kAck,
  kCrc,
  kForm,
  kStuff,
};

/// What the last sample point brought about.
struct NodeEvents {
  BitPlace at;                      ///< place of the bit that was sampled
  Level level = Level::kRecessive;  ///< as sampled
  bool started = false;             ///< SOF seen, the next bit is ID28; role() says whose frame
  bool delivered = false;           ///< EOF6: received() is valid (VA-01)
  bool sent_ok = false;             ///< EOF7 of an own frame (VA-02)
  bool tx_fail = false;             ///< an own frame ended by an error or by lost arbitration
  bool lost_arbitration = false;    ///< AR-02
  std::uint8_t lost_position = 0;  ///< 0 = ID28 .. 31 = extended RTR, with lost_arbitration (AR-12)
  bool overload = false;           ///< an overload flag begins in the next bit
  bool fd_exception = false;       ///< FF-06
  bool bus_off_entered = false;    ///< BO-01
  bool recovered = false;          ///< BO-05
  NodeError error = NodeError::kNone;
};

/// One node. Per bit: level = drive(); then sample(AND of all levels). Starts integrating with
/// TEC=REC=0.
///
/// A frame pending at the sample point of INT3, idle, suspend 8, or of the bit that ends
/// integration or bus-off starts with SOF in the next bit; one pending at a foreign SOF in INT3,
/// idle joins (IF-06, IF-14).
class NodeModel {
 public:
  explicit NodeModel(const NodeConfig &config = {}) : config_(config) {}

  /// Level on the TX pin in the coming bit.
  [[nodiscard]] Level drive() const { return config_.loop_back ? Level::kRecessive : sent_; }
  /// The same before loop-back gates it; equal to drive() in the other modes.
  [[nodiscard]] Level internal_level() const { return sent_; }
  /// Takes the level sampled in that bit.
  void sample(Level bus);

  /// Sends `frame` until it succeeds, replacing a pending one; a frame on the wire goes on (FF-12).
  /// Throws std::invalid_argument if the identifier does not fit its format or dlc > 15.
  void request(const Frame &frame);
  /// Takes the pending frame back; one on the wire goes on but is not retried (MO-10).
  void cancel();
  [[nodiscard]] bool pending() const { return pending_.has_value(); }
  /// The own frame that is, or was last, on the wire.
  [[nodiscard]] const Frame &own_frame() const { return active_; }

  [[nodiscard]] int tec() const { return confinement_.tec(); }  ///< 0..263; 256 and more: bus-off
  [[nodiscard]] int rec() const { return confinement_.rec(); }  ///< 0..135, holds from 128 on
  /// Sets both counters, each 0..255; throws std::invalid_argument otherwise.
  void preset_counters(int tec, int rec);
  [[nodiscard]] ErrorState error_state() const;
  [[nodiscard]] bool warning() const { return confinement_.warning(); }

  /// Place of the coming bit.
  [[nodiscard]] BitPlace state() const { return place_; }
  /// Bits of the field that follow the coming one (0 in kInteg, kBusOff, kIdle, kWait).
  [[nodiscard]] unsigned left() const;
  [[nodiscard]] Role role() const { return role_; }
  [[nodiscard]] const NodeEvents &events() const { return events_; }
  /// The frame of the last `delivered` event; valid until the next SOF.
  [[nodiscard]] const Frame &received() const { return parser_.frame(); }
  /// Recovery sequences seen in bus-off, 0..128 (BO-02).
  [[nodiscard]] int recovery_sequences() const { return sequences_; }

  NodeConfig &config() { return config_; }
  [[nodiscard]] const NodeConfig &config() const { return config_; }
  /// Leaves the bus at once and integrates; counters and the pending frame stay (IF-16, FC-21).
  void restart();
  /// Puts the node into bus idle, as if integration were done.
  void preset_idle();

 private:
  // node_model.cpp: between frames
  void sample_integration(Level level);
  void sample_bus_off(Level level);
  void sample_intermission(Level level);
  void sample_suspend(Level level);
  void may_start();
  void foreign_sof(bool may_join);
  void integrate();
  void enter_bus_off();
  [[nodiscard]] bool may_send() const { return pending_.has_value() && !config_.listen_only; }
  void begin_transmission();
  void go(Field field, std::uint8_t index = 0) { place_ = {field, index, false}; }
  [[nodiscard]] Level next_level() const;
  void dispatch(Level level);

  // node_frame.cpp: SOF..EOF7
  void sample_sof(Level level);
  void sample_stuffed(Level level);
  [[nodiscard]] bool transmitter_mismatch(Level level);
  void lose_arbitration();
  void sample_ack(Level level);
  void sample_ack_delimiter(Level level);
  void sample_eof(Level level);
  void end_attempt(bool success);
  [[nodiscard]] Level frame_level() const;

  // node_errors.cpp: flags and delimiters
  void error(NodeError kind, bool exempt = false);
  void overload();
  void rejoin();
  void start_flag(Field field, bool silent);
  void sample_flag(Level level);
  void sample_silent_flag(Level level);
  void sample_wait(Level level);
  void sample_delimiter(Level level);

  NodeConfig config_;
  FaultConfinement confinement_;
  FrameParser parser_;
  NodeEvents events_;
  BitPlace place_;
  Role role_ = Role::kNone;
  Level sent_ = Level::kRecessive;

  std::optional<Frame> pending_;
  Frame active_;                    ///< own frame on the wire (FF-12)
  bool sending_ = false;            ///< active_ neither succeeded nor failed yet
  bool active_is_pending_ = false;  ///< active_ is a copy of pending_, not of an older request

  int recessive_bits_ = 0;  ///< r in a row up to the last sample, in any place, 0..11
  int recessive_run_ = 0;   ///< integration and bus-off: r in a row, 0..10
  int sequences_ = 0;
  bool hold_bus_off_ = false;

  bool silent_flag_ = false;        ///< passive flag
  Level flag_level_{};              ///< last level in a silent flag
  bool withheld_ack_step_ = false;  ///< FC-05a
  bool after_error_flag_ = false;   ///< flag before kWait was an error flag (FC-04)
  int dominant_after_flag_ = 0;     ///< FC-08
};

}  // namespace vericansim
