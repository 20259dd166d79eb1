// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: a node without a processor as its specification describes it (docs/remote.md):
// frames, time and the accesses of user logic in; memory, answers and what user logic sees out.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/frame.hpp"
#include "model/remote_maps.hpp"
#include "model/remote_memory.hpp"
#include "model/remote_outbox.hpp"
#include "model/remote_producers.hpp"
#include "model/remote_rate.hpp"
#include "model/remote_transfer.hpp"

namespace vericansim {

/// What became visible for user logic (RN-45, RN-46): one pulse of written_o or of apply_o.
struct RemotePulse {
  bool apply = false;    ///< apply_o; else written_o with what follows
  unsigned address = 0;  ///< written_addr_o
  unsigned length = 0;   ///< written_len_o, 1..8
  friend bool operator==(const RemotePulse &, const RemotePulse &) = default;
};

/// One node. It knows frames and their order, milliseconds and two instants of a received frame
/// (valid: SP of EOF6; then the SP of INT2), but neither bits nor clocks. What the engine needs
/// some clocks for happens here at once, unless user logic holds (RN-52).
///
/// A bench tells what happens in the order in which it happens, and compares what the model shows
/// in between. Times in ms are counted in ticks.
class RemoteModel {
 public:
  /// As after reset: INIT, memory 0, node_i = `node` (its low NameBits bits count). Throws
  /// std::invalid_argument as RemoteConfig::validate().
  explicit RemoteModel(const RemoteConfig &config, unsigned node = 0);
  RemoteModel(const RemoteModel &) = delete;
  RemoteModel &operator=(const RemoteModel &) = delete;

  // ---- Life

  /// start_i = 1: joins the bus, or, with `search` (rate_i = F) and AutoRate, looks for the rate.
  void start(bool search = false);
  /// A RESTART has been obeyed and waits for stop_ok_o.
  [[nodiscard]] bool restarting() const { return restarting_; }
  /// stop_ok_o = 1: the RESTART is carried out.
  void stopped();
  /// A millisecond has passed.
  void tick();
  /// The engine's error counters.
  void set_errors(unsigned tec, unsigned rec);
  /// The row of the clock (TM-108), for nodes that have one.
  void set_clock(const std::array<std::uint8_t, 16> &row) { status_.clock = row; }
  void went_bus_off();
  /// False during the back-off: the engine must not leave bus-off yet (RN-72).
  [[nodiscard]] bool may_recover() const { return !off_bus_ || back_off_left_ == 0; }
  void recovered();
  /// LISTEN only: an error on the bus.
  void rate_error();
  [[nodiscard]] unsigned rate_row() const { return rate_.row(); }

  // ---- Bus

  /// The header of a frame that somebody else sends is known: what falls due until its end waits if
  /// it is for this node. A bench that does not tell has the model put that first.
  void announce(const Frame &header);
  /// The frame has ended, or the bus is free: nothing waits for it any longer.
  void released();
  /// A frame that somebody else sends is valid (VA-01). Throws as Frame::validate().
  void receive(const Frame &frame);
  /// SP of INT2 behind it: what it wrote is shown to user logic now.
  void intermission();
  /// The frame that the node wants to send now; nothing: none.
  [[nodiscard]] std::optional<Frame> wants() const;
  /// It begins to send that frame. Then one of the three:
  void attempt();
  void sent();
  void lost_arbitration();
  void failed();

  // ---- User logic

  /// Word `index` (address / 4). The engine's own bytes read as 0 here.
  [[nodiscard]] std::uint32_t user_read(unsigned index) const;
  /// `lanes`: bit i: byte i is written.
  void user_write(unsigned index, std::uint32_t data, unsigned lanes = 0xF);
  /// usr_hold_i.
  void hold(bool on);
  /// The hold has lasted for 64 clocks since the frame: it counts no longer.
  void hold_expired();
  /// event_i[k]. Throws std::out_of_range if there is no such entry.
  void event(unsigned k);
  /// Pulses since the last call, oldest first.
  [[nodiscard]] std::vector<RemotePulse> take_pulses();

  // ---- Seen from outside

  [[nodiscard]] const RemoteConfig &config() const { return config_; }
  [[nodiscard]] RemoteState state() const { return status_.state; }
  /// safe_o.
  [[nodiscard]] bool safe() const { return status_.state != RemoteState::kOperate; }
  /// The number in use; 0 or 1: none.
  [[nodiscard]] unsigned number() const { return number_; }
  [[nodiscard]] bool selected() const { return selected_; }
  [[nodiscard]] const RemoteStatus &status() const { return status_; }
  [[nodiscard]] const RemoteMemory &memory() const { return memory_; }

 private:
  struct Request {
    const Frame &frame;
    unsigned a;
    bool broadcast;  // name 0 or 1: no STATUS follows
  };

  // remote_model.cpp
  void begin();
  void join();
  void operate_if_allowed();
  void leave_operate(bool for_good);
  void check_watchdog();
  void check_maps();
  void tick_back_off();
  void fed() { idle_ms_ = 0; }
  [[nodiscard]] bool has_number() const { return number_ >= 2; }
  [[nodiscard]] bool operating() const { return status_.state == RemoteState::kOperate; }
  [[nodiscard]] bool on_bus() const { return status_.state == RemoteState::kSafe || operating(); }
  [[nodiscard]] bool flag(unsigned bit) const { return (flags_ & bit) != 0; }

  // remote_traffic.cpp
  enum class Name { kSystem, kAll, kOwn, kOther };
  [[nodiscard]] Name name_of(const Frame &frame) const;
  [[nodiscard]] bool says_my_name(const Frame &frame) const;
  [[nodiscard]] bool concerns(const Frame &frame) const;
  void work(const Frame &frame);
  void statement(const Frame &frame);
  void show();
  void fill_queue();

  // remote_requests.cpp
  void memory_request(const Request &request);
  void direct_read(const Request &request);
  void direct_write(const Request &request);
  void port_request(const Request &request, RemotePort port);
  void read(const Request &request);
  void write(const Request &request);
  void row(const Request &request, unsigned address);
  void answer(const Request &request, unsigned head, unsigned address, unsigned n);
  void write_checked(const Request &request, unsigned address, unsigned first);
  void accept(const Request &request, bool write = false);
  void refuse(const Request &request, RemoteCode why);

  // remote_system.cpp
  void system_request(const Request &request);
  void change_state(const Request &request);
  void trigger(std::optional<unsigned> count);
  void select(const Request &request);
  void assign(const Request &request);
  void setup(const Request &request);
  void unlock(const Request &request);

  // remote_blocks.cpp
  void block(const Request &request);
  void block_data(const Request &request);
  [[nodiscard]] RemoteCode check_block_data(const Frame &frame) const;
  void close_block(RemoteCode code);
  [[nodiscard]] std::optional<Frame> next_block_frame();
  void tick_block();

  RemoteConfig config_;
  RemoteStatus status_;
  RemoteMemory memory_;
  RemoteOutbox outbox_;
  RemoteProducers producers_;
  RemoteMaps maps_;
  RemoteTransfer transfer_;
  RemoteRate rate_;
  unsigned number_ = 0;
  unsigned flags_ = 0;  // FLAGS as at the start
  bool restarting_ = false;
  bool selected_ = false;
  bool locked_for_good_ = false;
  bool may_operate_ = true;  // AUTO_OP counts: no watchdog, no STATE 02 since
  bool off_bus_ = false;
  bool search_ = false;
  unsigned idle_ms_ = 0;
  unsigned ms_ = 0;              // since a step of LIFE; the first ms after a reset is one
  unsigned back_off_left_ = 0;   // ms
  unsigned back_off_power_ = 0;  // k
  unsigned recovered_ms_ = 0;
  std::optional<Frame> under_way_;  // the frame of an attempt
  bool announced_ = false;          // a frame for this node is under way
  bool held_ = false;
  bool hold_ignored_ = false;
  std::optional<Frame> waiting_;  // valid, but user logic holds
  bool after_int2_ = true;        // of the last frame received
  std::vector<RemotePulse> done_;
  std::vector<RemotePulse> pulses_;
};

}  // namespace vericansim
