// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene: an ErrorRig that knows whole frames, and frames as strings of bits.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/frame_codec.hpp"
#include "protocol/error_rig.hpp"

namespace vericansim {

// ---- Strings of bits: '0' dominant, '1' recessive

/// `n` recessive or dominant bits.
inline std::string r_bits(std::size_t n) { return std::string(n, '1'); }
inline std::string d_bits(std::size_t n) { return std::string(n, '0'); }
/// SOF..EOF7 as a transmitter sends them: ACK slot recessive.
std::string wire(const Frame &frame, const EncodeOptions &options = {});
/// The same, the ACK slot dominant.
std::string acked_wire(const Frame &frame);
/// What a receiver of wire(frame) sends: recessive but for the ACK slot.
std::string receiver_tx(std::string_view wire_bits);
/// SOF..CRC0 without stuff bits.
std::string plain_bits(const Frame &frame, const EncodeOptions &options = {});
/// `plain` with stuff bits, the last one included (ST-01, ST-03); a plain restatement of the rule.
std::string stuffed(std::string_view plain);
/// The inverse; fails the current test if a sixth equal bit turns up.
std::string destuffed(std::string_view bits);
/// Bits of `value`, the most significant first.
std::string binary(std::uint32_t value, unsigned width);
/// CRC delimiter, recessive ACK slot, ACK delimiter and EOF.
inline std::string frame_end() { return r_bits(10); }
/// wire() with the CRC XORed with `mask`, stuffed accordingly.
std::string wire_with_bad_crc(const Frame &frame, std::uint16_t mask);
std::string flipped(std::string bits, std::size_t position);

/// Offset in wire(frame) of a bit; npos if the frame has no such bit.
std::size_t offset_of(const Frame &frame, Field field, unsigned index, bool stuff = false);
/// Offset of the ACK slot in wire(frame).
std::size_t ack_offset(const Frame &frame);
/// Offsets in wire(frame) of all stuff bits.
std::vector<std::size_t> stuff_offsets(const Frame &frame);

// ---- Frames

/// Frames with long and short runs of both levels, all formats and lengths: each has stuff bits
/// elsewhere.
std::vector<Frame> typical_frames();
Frame base_frame(std::uint32_t id, std::vector<std::uint8_t> data = {});
Frame extended_frame(std::uint32_t id, std::vector<std::uint8_t> data = {});
Frame remote_frame(std::uint32_t id, bool extended, std::uint8_t dlc = 0);

// ---- Error states at the start of a test

/// Passive with room for a few steps of the counters in both directions.
inline constexpr Counters kPassiveTec{.tec = 136};
inline constexpr Counters kPassiveRec{.rec = 130};
inline constexpr Counters kStates[] = {kActive, kPassiveTec, kPassiveRec};
/// Name of one of kStates, for generated tests.
std::string state_name(const Counters &counters);

// ---- The scene

/// One engine, idle, with counters as given; judged bit by bit as ErrorRig does. play() takes the
/// strings of above.
class Scene : public ErrorRig {
 public:
  using ErrorRig::ErrorRig;
  using ErrorRig::run_to;

  /// The engine's next bit is SOF of `frame`, as soon as the rules allow.
  void send(const Frame &frame);
  /// Withdraws what waits (MO-10).
  void cancel() { judge.cancel(0); }
  /// LT stays recessive until the engine's next bit stands at the place.
  void run_to(Field field, unsigned index = 0, bool stuff = false);
  /// LT sends `frame`, which the engine must acknowledge and deliver; then INT1..INT3.
  void expect_reception(const Frame &frame);
  /// The engine sends `frame`, LT acknowledges; then INT1..INT3 and, if it is passive, suspend.
  void expect_transmission(const Frame &frame);
  /// Compares TEC and REC; any REC from 128 on stands for all of them (FC-14).
  void expect_counters(unsigned expected_tec, unsigned expected_rec);

  /// Frame delivered last; none if there is none.
  [[nodiscard]] std::optional<Frame> last_received();
  [[nodiscard]] std::optional<Frame> last_sent();
  [[nodiscard]] const CoreEvents &events() { return dut().events(); }
};

}  // namespace vericansim
