// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CoreNode: a Verilated can_core, the protocol engine alone, with C++ in place of the message
// buffers.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "bus/node.hpp"
#include "bus/trace.hpp"
#include "model/frame.hpp"
#include "node/bit_timing.hpp"
#include "node/engine_frame.hpp"

namespace vericansim {

/// The mode inputs of can_core.
struct CoreConfig {
  BitTiming timing;
  bool triple_sampling = false;
  bool listen_only = false;
  bool loop_back = false;
  bool fd_tolerant = false;
  bool boff_rec = false;  ///< true: no automatic recovery from bus-off (BO-03)
};

/// How many of each event there have been since the last clear_events().
struct CoreEvents {
  unsigned started = 0;
  unsigned sent = 0;        ///< tx_ok
  unsigned failed = 0;      ///< tx_fail: lost arbitration or error
  unsigned delivered = 0;   ///< rx_valid of foreign frames
  std::uint8_t errors = 0;  ///< all TraceError bits seen
};

/// The engine. Takes part in the bus once started: the constructor has done its reset, start() sets
/// run_i.
class CoreNode : public Node {
 public:
  explicit CoreNode(std::string name, const CoreConfig &config = {}, const ClockConfig &clock = {});
  ~CoreNode() override;

  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t quiet() const override;
  void pass(std::uint64_t edges) override;
  void clock_lightly(Level rx) override;
  [[nodiscard]] std::uint64_t trace() const override;

  /// Asynchronous reset; the node is stopped after it and has no request.
  void reset();
  void start();
  /// Clears run_i; the engine stops at the end of the bit, see running().
  void stop();
  [[nodiscard]] bool running() const;
  [[nodiscard]] bool idle() const;
  [[nodiscard]] bool integrated() const;
  [[nodiscard]] bool bus_off() const;
  [[nodiscard]] bool passive() const;

  /// New settings, in force at once; timing must not change while running (BT-11).
  void configure(const CoreConfig &config);
  [[nodiscard]] const CoreConfig &config() const { return config_; }
  /// Sets both counters while stopped; takes one clock of its own (TH-02). std::logic_error if
  /// running.
  void preset_counters(std::uint8_t tec, std::uint8_t rec);

  /// Queues a frame; it is retried until it succeeds (one_shot: tried once). Throws as
  /// Frame::validate().
  void request(const Frame &frame, bool one_shot = false);
  /// Withdraws all frames that wait; one on the wire goes on but is not retried (MO-10).
  void cancel();
  [[nodiscard]] bool pending() const { return !requests_.empty(); }
  /// Frames that wait, with the one that is on the wire.
  [[nodiscard]] std::size_t waiting() const { return requests_.size(); }

  /// Frames received (and, in loop-back, those sent), oldest first.
  [[nodiscard]] std::vector<Frame> &received() { return received_; }
  /// Frames sent successfully, oldest first.
  [[nodiscard]] std::vector<Frame> &sent() { return sent_; }
  [[nodiscard]] const CoreEvents &events() const { return events_; }
  void clear_events() { events_ = {}; }

 private:
  struct Request {
    Frame frame;
    bool one_shot = false;
    bool cancelled = false;
  };
  struct Impl;  // keeps the Verilated header out of this one

  void input_changes();
  void present();
  void collect();
  void finish_request(bool success);

  std::unique_ptr<Impl> impl_;
  CoreConfig config_;
  std::deque<Request> requests_;
  unsigned word_ = 0;  // word of the front request that is presented: 0 = ID, 1 = data 0-3, 2 = 4-7
  bool on_wire_ = false;  // the front request is being sent
  EngineFrame receiving_;
  std::vector<Frame> received_;
  std::vector<Frame> sent_;
  CoreEvents events_;
};

}  // namespace vericansim
