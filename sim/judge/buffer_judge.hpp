// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferJudge: the model of the message buffers beside a whole core on a bus. It hears every access
// of the CPU from the pins of the AHB and every frame from the trace of the core.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "judge/node_bit.hpp"
#include "judge/register_shadow.hpp"
#include "model/buffer_model.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// Judges what the CPU reads and what the core sends. Construct it before the node's first access.
class BufferJudge {
 public:
  using Report = std::function<void(const std::string &)>;

  /// `report` is told the first difference; afterwards nothing is judged any more.
  BufferJudge(RtlNode &node, Report report);
  ~BufferJudge();
  BufferJudge(const BufferJudge &) = delete;
  BufferJudge &operator=(const BufferJudge &) = delete;

  /// What the CPU's accesses have done to the node since the last call.
  struct Interference {
    bool stopped = false;                                   ///< it has left the bus
    bool soft_reset = false;                                ///< counters 0
    std::optional<std::pair<unsigned, unsigned>> counters;  ///< TEC and REC written
  };

  /// A bit of the node is complete: tells the model what the CPU did before.
  Interference begin_bit(const NodeBit &bit);
  /// The node has left the bus right behind a sample point: TIMER has counted the bit.
  void cut_bit() { bits_ += interference_.soft_reset ? 0 : 1; }
  /// A SOF was seen or is about to be sent. `own`: by this node; `sof_to_come`: it stands in the
  /// next bit.
  void started(bool own, bool sof_to_come);
  /// Frames that the node may be sending; empty: none.
  [[nodiscard]] std::vector<Frame> flights() const { return model_.flights(); }
  /// A buffer has waited so long that the next opportunity must be taken: longer than a pass over
  /// all buffers, which a write of the CPU to any C/S word may have made necessary, and which
  /// begins when the node comes back to the bus.
  [[nodiscard]] bool must_send() const;
  /// The identifier is complete; `foreign`: unless the node sends the frame itself.
  void header(const std::optional<Frame> &foreign);
  /// What followed from the bit; `frame`: of the bits so far, complete if it was delivered or sent.
  void end_bit(const NodeBit &bit, const Frame &frame);
  /// Tells the model of all accesses so far.
  void finish();

  /// Called when the node has left the bus.
  std::function<void()> on_stop;

  [[nodiscard]] const RegisterShadow &registers() const { return registers_; }
  [[nodiscard]] bool ok() const { return model_.ok(); }
  /// Not ok only because the CPU left more open than can be followed.
  [[nodiscard]] bool too_open() const { return model_.too_open(); }
  [[nodiscard]] std::uint64_t accesses() const { return accesses_; }

 private:
  struct Access {
    std::uint64_t clock;
    std::uint32_t address, data, lanes;
    bool write, running;
  };

  void watch(const AhbRequest &request, const AhbResponse &response);
  void look_at_run(std::uint64_t clock);
  void tell(std::uint64_t until);
  void tell(const Access &access);
  void write(const Access &access);
  void soft_reset(std::uint64_t clock);
  void check();

  RtlNode &node_;
  Report report_;
  RegisterShadow registers_;
  BufferModel model_;
  std::optional<AhbRequest> phase_;  // of which the data phase is under way
  std::deque<Access> done_;          // not yet told
  Interference interference_;
  std::uint16_t bits_ = 0;    // bit times, modulo 2^16: the reference for stamps
  Stamp stamp_ = 0;           // at the start of the identifier
  unsigned since_stamp_ = 0;  // bits
  std::uint64_t last_cs_write_ = 0;
  bool was_running_ = false;
  std::uint64_t stopped_at_ = 0, back_at_ = 0;  // clocks; back on the bus
  bool reset_asked_ = false;                    // a soft reset waits for the node to stop
  bool reported_ = false;
  std::uint64_t accesses_ = 0;
};

}  // namespace vericansim
