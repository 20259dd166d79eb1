// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ErrorMessages: SocketCAN's error messages (linux/can/error.h) from what a node goes through.
#pragma once

#include <linux/can.h>
#include <linux/can/error.h>

#include <cstdint>
#include <optional>

#include "bus/trace.hpp"
#include "model/bus_decoder.hpp"

namespace vericansim {

/// Which error messages the programs get.
enum class ErrorChoice : std::uint8_t {
  kNone,
  kState,  ///< changes of state alone, as Linux drivers without berr-reporting
  kOwn,    ///< these, each error that the node detects, and each lost arbitration
};

/// Follows one node bit by bit. What one bit brings about comes as one message.
///
/// - lost arbitration: CAN_ERR_LOSTARB; data[0] is the number of the bit in the frame without stuff
///   bits, SOF being 0: ID28 is 1, RTR or SRR 12, IDE 13, the last RTR 32 (AR-12)
/// - an error: CAN_ERR_PROT and CAN_ERR_BUSERROR, kinds in data[2] (with CAN_ERR_PROT_TX in the
/// role
///   of a transmitter), place in data[3]; CAN_ERR_ACK too if nobody has acknowledged. A CRC error
///   has no kind; its place is the CRC sequence.
/// - warning (a counter above 95), error passive, error active again: CAN_ERR_CRTL, data[1]; by the
///   larger counter, both if they are at the same level, once for each change of the node's level
/// - CAN_ERR_BUSOFF; CAN_ERR_RESTARTED when the node takes part again
/// - CAN_ERR_CNT in all of them, with TEC and REC in data[6] and data[7], unless the node is
///   bus-off
class ErrorMessages {
 public:
  explicit ErrorMessages(ErrorChoice choice) : choice_{choice} {}

  /// The message that the bit has brought about, if any.
  [[nodiscard]] std::optional<can_frame> on_bit(const BitRecord &bit);

 private:
  enum class State : std::uint8_t { kActive, kWarning, kPassive, kBusOff };

  static State level(unsigned counter);
  static std::uint8_t controller_bits(State state, bool transmit);
  void add_error(can_frame &message, const BitRecord &bit) const;
  void add_state(can_frame &message, const Trace &after);

  ErrorChoice choice_;
  State state_ = State::kActive;
};

/// What one who only listens can say of an event on the bus: error frames (kind as far as it shows
/// on the wire, place) and overload frames. Empty for frames.
[[nodiscard]] std::optional<can_frame> bus_error_message(const BusEvent &event);

/// Number of the bit in a frame without stuff bits, SOF being 0, for a place in the arbitration
/// field.
[[nodiscard]] std::uint8_t arbitration_bit(Field field, unsigned left);
/// CAN_ERR_PROT_LOC_* of a place; CAN_ERR_PROT_LOC_UNSPEC for those that have no code.
[[nodiscard]] std::uint8_t error_location(Field field, unsigned left);

}  // namespace vericansim
