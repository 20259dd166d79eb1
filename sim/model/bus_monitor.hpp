// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusMonitor: counts what happens on a bus: frames, errors, load, and what each node goes through.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
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
  /// Attempts that failed. Who loses arbitration has lost nothing but time.
  [[nodiscard]] std::uint64_t retries() const { return attempts - sent - lost_arbitration; }
};

/// A frame seen on the wire, and who sent it.
struct BusFrame {
  static constexpr NodeId kNobody = std::numeric_limits<NodeId>::max();
  Frame frame;
  Time start = 0;           ///< of SOF
  Time end = 0;             ///< of EOF7
  NodeId sender = kNobody;  ///< node whose transmission ended well with this frame
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
  /// Lets the decoder see the bus up to `time`.
  void advance(Time time);

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
  /// Time in which frames (with their intermission) and error and overload frames held the bus, ps.
  [[nodiscard]] Time busy() const { return busy_; }
  /// The decoder, which has seen the bus up to the last advance().
  [[nodiscard]] const BusDecoder &decoder() const { return decoder_; }

 private:
  void take_event(const BusEvent &event);
  void count_errors(NodeCounts &counts, std::uint8_t errors);
  void settle();

  Time bit_time_;
  std::vector<NodeCounts> nodes_;
  std::vector<BusFrame> unsettled_;               // waiting for the sender's tx_ok
  std::vector<std::pair<NodeId, Time>> senders_;  // tx_ok events not yet matched
  BusDecoder decoder_;
  std::uint64_t frames_ = 0, unacknowledged_ = 0, error_frames_ = 0, overload_frames_ = 0;
  Time busy_ = 0;
};

}  // namespace vericansim
