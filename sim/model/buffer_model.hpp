// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferModel: the message buffers as the register specification describes them (flexcan.md 3, 4);
// the judge of the RTL's buffers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/distinct_states.hpp"

namespace vericansim {

/// How late something may show, in clocks. The specification gives no numbers; these are what a
/// driver can stand: buffers settled before the next frame could end, a decision within the scan
/// of all buffers.
struct BufferWindows {
  unsigned move_in = 100;     ///< from EOF6 until a frame is in its buffer, accesses of the CPU
                              ///< included
  unsigned completion = 100;  ///< from EOF7, or the failure, until code and flag show
  unsigned decision = 300;  ///< an activation or deactivation this short before a start may miss it
};

/// The model. It follows the CPU's accesses and the events of the bus in the order in which they
/// happen, and keeps every state that the specification allows: an access that falls into a window
/// is taken before and after what happens in it. What the CPU reads removes the states that would
/// have shown something else; when none is left the core is wrong and failure() says why.
class BufferModel {
 public:
  /// Throws as BufferConfig::validate(), and so does configure().
  explicit BufferModel(const BufferConfig &config, const BufferWindows &windows = {});

  /// In freeze mode: new configuration. A change of FEN empties the FIFO; one of FEN or RFFN ends
  /// the lock, and drops the frame that waits for it.
  void configure(const BufferConfig &config, std::uint64_t now = 0);
  [[nodiscard]] const BufferConfig &config() const { return config_; }

  // ---- The CPU (`now`: clock of the data phase)

  /// Write to a buffer, a mask (caller: only in freeze mode) or IFLAG; others are ignored.
  /// `lanes`: bits that are written.
  void cpu_write(std::uint32_t address, std::uint32_t data, std::uint64_t now,
                 std::uint32_t lanes = ~0u);
  /// Read of a buffer, a mask, IFLAG, RXFIR or TIMER (whose value is not judged).
  void cpu_read(std::uint32_t address, std::uint32_t value, std::uint64_t now);
  void soft_reset(std::uint64_t now);

  // ---- The bus (frames: throws as Frame::validate())

  /// Whether the node could start a frame, or waits for that: no frame is on the bus.
  void bus_free(bool now) { bus_free_ = now; }
  /// A SOF was seen or is about to be sent; `transmitter`: this node sends.
  void frame_started(bool transmitter, std::uint64_t now);
  /// The header is over. `foreign`: the frame under way if another node sends it;
  /// `stamp`: reference count of bit times at the start of the identifier.
  void header(const std::optional<Frame> &foreign, Stamp stamp, std::uint64_t now);
  /// EOF6 without an error.
  void received(std::uint64_t now);
  /// As header() and received() where the rest of the frame was not known at the header.
  void received(const Frame &foreign, std::uint64_t now);
  /// The frame under way is destroyed.
  void receive_failed(std::uint64_t now);
  /// EOF7 of an own frame without an error; `wire`: the frame as it was on the wire.
  void sent(const Frame &wire, std::uint64_t now);
  /// An own frame lost arbitration or was destroyed.
  void send_failed(std::uint64_t now);
  /// The node stopped before the SOF of an own frame: the attempt never was.
  void send_not_begun(std::uint64_t now);

  // ---- Verdict

  [[nodiscard]] bool ok() const { return failure_.empty(); }
  [[nodiscard]] const std::string &failure() const { return failure_; }
  /// It failed because the CPU left more open than can be followed: no fault of the core.
  [[nodiscard]] bool too_open() const { return too_open_; }
  /// States still possible; 1 when nothing is open.
  [[nodiscard]] std::size_t possibilities() const { return states_.size(); }
  /// One of the states.
  [[nodiscard]] const BufferState &state() const { return states_.front(); }
  /// Some state is so.
  [[nodiscard]] bool may_be(const std::function<bool(const BufferState &)> &so) const;
  /// In some state a frame is being sent.
  [[nodiscard]] bool sending() const;
  /// In every state some buffer has waited to be sent since `clock` or earlier, and no abort of it
  /// was asked for.
  [[nodiscard]] bool must_send_since(std::uint64_t clock) const;
  /// The frames that may be the one being sent, each once.
  [[nodiscard]] std::vector<Frame> flights() const;
  /// From here on stamps need not stand in the same relation to the reference count as before: the
  /// CPU has written TIMER.
  void timer_written() { stamps_moved_ = true; }
  [[nodiscard]] const BufferWindows &windows() const { return windows_; }

 private:
  using States = std::vector<BufferState>;
  static constexpr std::size_t kMostStates = 4096;

  void settle(std::uint64_t now);
  void merge(std::uint64_t now);
  void limit();
  void open_up(std::uint64_t now);
  [[nodiscard]] bool moved_out_too_long(const BufferState &state, std::uint64_t now) const;
  void steps_of(const BufferState &state, std::uint64_t now, States &out) const;
  void replace(const std::function<void(const BufferState &, DistinctStates &)> &each,
               const std::function<std::string()> &otherwise);
  void keep(const std::function<bool(const BufferState &)> &possible,
            const std::function<std::string()> &otherwise);

  void write_buffer(unsigned n, unsigned word, std::uint32_t data, std::uint32_t lanes,
                    std::uint64_t now);
  void write_cs(const BufferState &state, unsigned n, std::uint32_t data, std::uint32_t lanes,
                std::uint64_t now, DistinctStates &out) const;
  void write_cs_aen(const BufferState &given, unsigned n, std::uint32_t data, std::uint32_t lanes,
                    std::uint64_t now, DistinctStates &out) const;
  void take_write(BufferState state, unsigned n, std::uint32_t data, std::uint32_t lanes,
                  std::uint64_t now, DistinctStates &out) const;
  void write_mask(std::uint32_t address, std::uint32_t data, std::uint32_t lanes);
  void read_cs(unsigned n, std::uint32_t value, std::uint64_t now);
  void learn_stamp(unsigned n, std::uint32_t value);
  void read_word(unsigned n, unsigned word, std::uint32_t value);
  void read_flags(unsigned half, std::uint32_t value);
  [[nodiscard]] static bool may_start(const BufferState &state, unsigned n,
                                      const SendRequest &request);
  void start_own(const BufferState &state, std::uint64_t now, DistinctStates &out) const;

  [[nodiscard]] KnownWords words_of(const BufferState &state, unsigned n) const;
  [[nodiscard]] bool fits(const KnownWords &words, unsigned word, std::uint32_t value) const;
  [[nodiscard]] std::string allowed(unsigned n, unsigned word) const;

  BufferConfig config_;
  BufferWindows windows_;
  BufferMasks masks_;
  States states_;
  Stamp stamp_ = 0;
  std::uint64_t received_at_ = 0;
  std::uint64_t ended_at_ = 0;
  std::optional<int> stamp_offset_;  ///< stamp as read less reference; one value for all frames
  bool stamps_moved_ = false;
  bool bus_free_ = false;
  std::string failure_;
  bool too_open_ = false;
};

}  // namespace vericansim
