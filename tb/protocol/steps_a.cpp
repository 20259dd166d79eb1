// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene and strings of bits: see steps_a.hpp.
#include "protocol/steps_a.hpp"

#include <algorithm>

namespace vericansim {

std::string wire(const Frame &frame, const EncodeOptions &options) {
  EncodeOptions as_sent = options;
  as_sent.ack_slot = Level::kRecessive;
  return to_string(levels_of(encode_frame(frame, as_sent).bits));
}

std::string acked_wire(const Frame &frame) {
  return to_string(levels_of(encode_frame(frame).bits));
}

std::string receiver_tx(std::string_view wire_bits) {
  std::string tx = r_bits(wire_bits.size());
  tx[tx.size() - 9] = '0';
  return tx;
}

std::string plain_bits(const Frame &frame, const EncodeOptions &options) {
  const EncodedFrame encoded = encode_frame(frame, options);
  std::string bits;
  for (std::size_t i = 0; i < encoded.stuffed_length; ++i) {
    if (!encoded.bits[i].is_stuff) bits += encoded.bits[i].level == Level::kDominant ? '0' : '1';
  }
  return bits;
}

std::string stuffed(std::string_view plain) {
  std::string bits;
  unsigned run = 0;
  for (const char c : plain) {
    run = !bits.empty() && bits.back() == c ? run + 1 : 1;
    bits += c;
    if (run < 5) continue;
    bits += c == '0' ? '1' : '0';
    run = 1;
  }
  return bits;
}

std::string destuffed(std::string_view bits) {
  std::string plain;
  unsigned run = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    const bool is_stuff = run == 5;
    run = i > 0 && bits[i - 1] == bits[i] ? run + 1 : 1;
    EXPECT_LT(run, 6u) << "sixth equal bit at " << i << " of " << bits;
    if (!is_stuff) plain += bits[i];
  }
  return plain;
}

std::string binary(std::uint32_t value, unsigned width) {
  std::string bits;
  for (unsigned i = width; i-- > 0;) bits += ((value >> i) & 1u) != 0 ? '1' : '0';
  return bits;
}

std::string wire_with_bad_crc(const Frame &frame, std::uint16_t mask) {
  std::string plain = plain_bits(frame);
  for (unsigned i = 0; i < 15; ++i) {
    char &bit = plain[plain.size() - 1 - i];
    if (((mask >> i) & 1u) != 0) bit = bit == '0' ? '1' : '0';
  }
  return stuffed(plain) + frame_end();
}

std::string flipped(std::string bits, std::size_t position) {
  bits[position] = bits[position] == '0' ? '1' : '0';
  return bits;
}

std::size_t offset_of(const Frame &frame, Field field, unsigned index, bool stuff) {
  const EncodedFrame encoded = encode_frame(frame);
  const auto &bits = encoded.bits;
  const auto found = std::find_if(bits.begin(), bits.end(), [&](const WireBit &bit) {
    return bit.field == field && bit.index == index && bit.is_stuff == stuff;
  });
  return found == bits.end() ? std::string::npos : static_cast<std::size_t>(found - bits.begin());
}

std::size_t ack_offset(const Frame &frame) { return encode_frame(frame).stuffed_length + 1; }

std::vector<std::size_t> stuff_offsets(const Frame &frame) {
  const EncodedFrame encoded = encode_frame(frame);
  std::vector<std::size_t> offsets;
  for (std::size_t i = 0; i < encoded.bits.size(); ++i) {
    if (encoded.bits[i].is_stuff) offsets.push_back(i);
  }
  return offsets;
}

Frame base_frame(std::uint32_t id, std::vector<std::uint8_t> data) {
  Frame frame{.id = id, .dlc = static_cast<std::uint8_t>(data.size())};
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

Frame extended_frame(std::uint32_t id, std::vector<std::uint8_t> data) {
  Frame frame = base_frame(id, std::move(data));
  frame.extended = true;
  return frame;
}

Frame remote_frame(std::uint32_t id, bool extended, std::uint8_t dlc) {
  return {.id = id, .extended = extended, .remote = true, .dlc = dlc};
}

std::vector<Frame> typical_frames() {
  return {base_frame(0x123, {0x55}),
          base_frame(0x555),
          base_frame(0x009),
          base_frame(0x017),
          base_frame(0x000, {0, 0, 0, 0, 0, 0, 0, 0}),
          base_frame(0x7FF, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}),
          base_frame(0x078, {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}),
          base_frame(0x7C1, {0x0F, 0x83, 0xE0, 0xF8}),
          remote_frame(0x123, false, 5),
          remote_frame(0x7FF, false, 8),
          extended_frame(0x00000000, {0, 0, 0, 0, 0, 0, 0, 0}),
          extended_frame(0x1FFFFFFF, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}),
          extended_frame(0x12345678, {0xDE, 0xAD, 0xBE}),
          extended_frame(0x0F83C1F0, {0x7C, 0x1F, 0x07, 0xC1, 0xF0}),
          remote_frame(0x00000000, true, 0),
          remote_frame(0x1ABCDEF0, true, 15)};
}

std::string state_name(const Counters &counters) {
  if (!counters.passive()) return "Active";
  return counters.tec >= 128 ? "PassiveTec" : "PassiveRec";
}

void Scene::send(const Frame &frame) {
  request(frame);
  run_to(Field::kSof);
}

void Scene::run_to(Field field, unsigned index, bool stuff) {
  ErrorRig::run_to({.field = field, .index = index, .stuff = stuff});
}

void Scene::expect_reception(const Frame &frame) {
  const std::string bits = wire(frame);
  const std::size_t before = delivered();
  EXPECT_EQ(play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
  EXPECT_EQ(delivered(), before + 1);
  EXPECT_EQ(last_received(), frame);
}

void Scene::expect_transmission(const Frame &frame) {
  const std::size_t before = sent();
  const std::string bits = wire(frame);
  const bool passive = last().passive;
  send(frame);
  EXPECT_EQ(play(flipped(r_bits(bits.size()), ack_offset(frame)) + r_bits(3)), bits + r_bits(3));
  if (passive) play(r_bits(8));
  EXPECT_EQ(sent(), before + 1);
  EXPECT_EQ(last_sent(), frame);
}

void Scene::expect_counters(unsigned expected_tec, unsigned expected_rec) {
  EXPECT_EQ(tec(), expected_tec);
  expect_rec(expected_rec, 0);
}

std::optional<Frame> Scene::last_received() {
  if (dut().received().empty()) return std::nullopt;
  return dut().received().back();
}

std::optional<Frame> Scene::last_sent() {
  if (dut().sent().empty()) return std::nullopt;
  return dut().sent().back();
}

}  // namespace vericansim
