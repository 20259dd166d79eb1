// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusMonitor: counts what happens on a bus: frames, errors, load, and what each node goes through.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "model/bus_decoder.hpp"

namespace vericansim {

/// What one node went through, from its trace.
struct NodeCounts {
  std::uint64_t attempts = 0;   ///< frames begun as transmitter
  std::uint64_t sent = 0;       ///< VA-02
  std::uint64_t delivered = 0;  ///< valid frames of others, VA-01
  std::uint64_t lost_arbitration = 0;
  std::uint64_t errors = 0;  ///< error events
  std::array<std::uint64_t, 6>
      by_kind{};              ///< bits of TraceError: stuff, form, CRC, ACK, bit0, bit1
  std::uint64_t bus_off = 0;  ///< times it went bus-off
  unsigned tec = 0, rec = 0;  ///< now; bus-off counts as 256
  unsigned max_tec = 0, max_rec = 0;
  bool passive = false, off = false;  ///< now
  bool sending = false;               ///< the last attempt is under way
  /// Attempts that failed. Who loses arbitration has lost nothing but time.
  [[nodiscard]] std::uint64_t retries() const {
    return attempts - sent - lost_arbitration - (sending ? 1 : 0);
  }
};

/// A frame seen on the wire, and who sent it. Two nodes may have sent it together (AR-10), and it
/// may have failed for its transmitter though receivers have it (VA-03).
struct BusFrame {
  static constexpr NodeId kNobody = std::numeric_limits<NodeId>::max();
  Frame frame;
  Time start = 0;                  ///< of SOF
  Time end = 0;                    ///< of EOF7
  NodeId sender = kNobody;         ///< first node whose transmission ended well with this frame
  std::uint64_t transmitters = 0;  ///< bit i: node i has put it on the bus
  std::uint64_t senders = 0;       ///< those of them whose transmission ended well

  [[nodiscard]] bool transmitted_by(NodeId node) const { return (transmitters >> node & 1) != 0; }
  [[nodiscard]] bool sent_by(NodeId node) const { return (senders >> node & 1) != 0; }
  /// It failed for its transmitters, which repeat it.
  [[nodiscard]] bool repeated() const { return transmitters != 0 && senders == 0; }
};

/// An observer that counts. Add it to a bus after its nodes.
class BusMonitor : public BusObserver {
 public:
  /// `bit_time` of the bus, ps; `sample_point` of its decoder, above 0 and below 1
  /// (std::invalid_argument otherwise).
  BusMonitor(const Bus &bus, Time bit_time, double sample_point);

  [[nodiscard]] unsigned interests() const override { return kLevels | kBits; }
  void on_level(Time time, Level level) override;
  void on_bit(NodeId node, const BitRecord &bit) override;
  /// Lets the decoder see the bus up to `time`. Frames that ended two bits before it are told.
  void advance(Time time);
  /// The same, without waiting for who may still turn out to have sent the last frame: where time
  /// is passed over behind it, or nothing more is seen.
  void settle_all(Time time);
  /// Nothing is seen behind `time`: what is on the bus then has held it up to here, and a flag
  /// without its end counts as an error or overload frame. To be called once.
  void close(Time time);

  /// Called for each acknowledged frame that is valid for receivers, once its sender is known (some
  /// bits after its end).
  std::function<void(const BusFrame &)> on_frame;
  /// Called for each event as the decoder sees it.
  std::function<void(const BusEvent &)> on_event;

  [[nodiscard]] const NodeCounts &node(NodeId id) const { return nodes_[id]; }
  /// Acknowledged frames that are valid for receivers.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// Complete frames that nobody acknowledged.
  [[nodiscard]] std::uint64_t unacknowledged() const { return unacknowledged_; }
  [[nodiscard]] std::uint64_t error_frames() const { return error_frames_; }
  [[nodiscard]] std::uint64_t overload_frames() const { return overload_frames_; }
  /// Time in which frames, error and overload frames held the bus, each with its intermission, ps.
  [[nodiscard]] Time busy() const { return busy_; }
  /// The decoder, which has seen the bus up to the last advance().
  [[nodiscard]] const BusDecoder &decoder() const { return decoder_; }

 private:
  /// When a node was last seen in what makes it the sender of a frame.
  struct Sending {
    Time dominant = kNever;  // at its pin, as transmitter
    Time crc = kNever;       // in the CRC sequence, as transmitter
    Time success = kNever;
  };
  static constexpr Time kNever = std::numeric_limits<Time>::min();

  void take_event(const BusEvent &event);
  void count_errors(NodeCounts &counts, std::uint8_t errors);
  void hold(Time from, Time to);
  void follow_transmitter(NodeId node, const BitRecord &bit);
  void hold_up_to_rest(Time now);
  void settle(Time now);
  void add_senders(BusFrame &frame) const;

  const Bus &bus_;
  Time bit_time_;
  std::vector<NodeCounts> nodes_;
  std::vector<Sending> sending_;
  std::vector<BusFrame> unsettled_;  // waiting for the last bits of their senders
  BusDecoder decoder_;
  std::uint64_t frames_ = 0, unacknowledged_ = 0, error_frames_ = 0, overload_frames_ = 0;
  Time busy_ = 0;
  std::optional<Time> lost_since_;  // the decoder waits for the bus to come to rest
  Time held_until_ = kNever;        // what lies before it is in busy_
};

}  // namespace vericansim
