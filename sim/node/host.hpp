// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Host: small software on an RtlNode: sets the core up, sends from a queue, receives by interrupt.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "model/frame.hpp"
#include "node/bit_timing.hpp"
#include "node/rtl_node.hpp"
#include "node/task.hpp"

namespace vericansim {

/// What a range of receive buffers accepts: frames whose identifier equals `id` in all bits of
/// `mask`.
struct RxFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0;  ///< 1 = compare; 11 bits, or 29 if `extended`
  bool extended = false;
  /// Compare base/extended too. Without it a received frame that replaces the identifier in its
  /// buffer may change what an extended filter takes from then on (flexcan.md 3.5).
  bool match_format = false;
  bool match_remote = false;  ///< compare data/remote too
  bool remote = false;        ///< with match_remote

  /// Throws std::invalid_argument if `id` or `mask` do not fit the format.
  void validate() const;
};

/// How a Host sets its core up.
struct HostConfig {
  BitTiming timing = {};
  bool triple_sampling = false;
  bool listen_only = false;
  bool loop_back = false;
  bool self_reception = false;
  bool boff_rec = false;  ///< true: no automatic recovery from bus-off
  bool fd_tolerant = false;
  bool lowest_buffer_first = true;  ///< CTRL.LBUF; false: lowest identifier first
  /// Transmit buffers, the highest ones. 1: frames leave in the order of send().
  unsigned tx_buffers = 1;
  /// One per receive buffer from MB0 on; empty: every buffer below the transmit ones takes any
  /// frame.
  std::vector<RxFilter> filters = {};
};

/// A frame received or sent, as the software found it.
struct HostFrame {
  Frame frame;
  std::uint16_t stamp = 0;  ///< TIMER at the first identifier bit
  unsigned mb = 0;
  bool overrun = false;  ///< received: an older frame was lost in this buffer
  Time time = 0;         ///< of the bus when the software got to it, ps
};

/// Counts of a Host.
struct HostStats {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t overruns = 0;
  std::uint64_t error_interrupts = 0;
  std::uint64_t bus_off = 0;
  std::uint32_t esr = 0;  ///< OR of all values read
};

/// The software. start() returns at once; everything else happens as the node is clocked, so that
/// many hosts run at the same time. It must not outlive its node.
class Host {
 public:
  /// Throws std::invalid_argument if timing, buffers or filters are out of range.
  Host(RtlNode &node, HostConfig config);
  ~Host();
  Host(const Host &) = delete;
  Host &operator=(const Host &) = delete;

  /// Begins the set-up; afterwards the node serves its interrupts for ever. Again, as behind a
  /// reset of the node: the software begins anew, with the frames that have not left.
  void start();
  /// start() and run the bus until the node has left freeze mode.
  void start_and_wait();
  /// True once the core takes part (it still integrates then).
  [[nodiscard]] bool ready() const { return ready_; }

  /// Queues a frame for transmission. Throws as Frame::validate().
  void send(const Frame &frame);
  /// send() and run the bus until the frame is out; false if `limit` (ps) passed first.
  /// std::logic_error without start().
  bool send_and_wait(const Frame &frame, Time limit = kSecond);
  /// With boff_rec: lets the node recover from the bus-off it is in (flexcan.md 2.8); the next one
  /// holds it again.
  void recover();
  /// Frames that have not left yet.
  [[nodiscard]] std::size_t pending() const { return queue_.size() + loaded_; }

  /// Called for each received or sent frame instead of keeping it in the lists below.
  std::function<void(const HostFrame &)> on_received;
  std::function<void(const HostFrame &)> on_sent;
  [[nodiscard]] std::vector<HostFrame> &received() { return received_; }
  [[nodiscard]] std::vector<HostFrame> &sent() { return sent_; }
  [[nodiscard]] const HostStats &stats() const { return stats_; }

  [[nodiscard]] RtlNode &node() { return node_; }
  /// Rethrows what went wrong in the software, if anything (bus error, no acknowledge of a mode
  /// change).
  void check();

 private:
  struct TxSlot {
    bool busy = false;
    Frame frame;
  };

  void stop();
  [[nodiscard]] std::uint32_t ctrl() const;
  Task<> run();
  Task<> set_up();
  Task<> poll(std::uint32_t address, std::uint32_t mask, std::uint32_t value);
  Task<> set_up_buffers();
  Task<> serve();
  Task<> serve_buffers();
  Task<> serve_errors();
  Task<HostFrame> read_buffer(unsigned mb);
  Task<> load_frames();
  Task<> finish_transmission(unsigned mb);
  void write(std::uint32_t address, std::uint32_t data);
  void deliver(std::vector<HostFrame> &batch);

  RtlNode &node_;
  HostConfig config_;
  unsigned first_tx_;
  std::vector<TxSlot> tx_;
  std::deque<Frame> queue_;
  std::size_t loaded_ = 0;
  std::vector<HostFrame> received_;
  std::vector<HostFrame> sent_;
  HostStats stats_;
  bool ready_ = false;
  Task<> main_;
};

}  // namespace vericansim
