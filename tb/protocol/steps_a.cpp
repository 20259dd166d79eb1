// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scene and strings of bits: see steps_a.hpp.
#include "protocol/steps_a.hpp"

#include <algorithm>
#include <ostream>

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

void PrintTo(const Counters &counters, std::ostream *out) {
  *out << "TEC " << unsigned{counters.tec} << ", REC " << unsigned{counters.rec};
}

Scene::Scene(const Counters &counters, const CoreConfig &config)
    : bench_{1, config}, judge_{bench_} {
  judge_.preset_counters(0, counters.tec, counters.rec);
  judge_.start();
}

Scene::~Scene() { verdict(); }

void Scene::verdict() { EXPECT_TRUE(judge_.agrees()) << judge_.report(); }

std::string Scene::play(std::string_view bits) {
  const std::size_t before = bench_.tx_history().size();
  bench_.lt(bits);
  bench_.run_bits(static_cast<unsigned>(bits.size()));
  return bench_.tx_history().substr(before);
}

void Scene::send(const Frame &frame) {
  request(frame);
  run_to(Field::kSof);
}

void Scene::run_to(Field field, unsigned index, bool stuff) {
  const auto there = [&] {
    const PlaceTracker &at = bench_.place();
    return at.field() == field && at.index() == index && at.stuff() == stuff;
  };
  EXPECT_TRUE(bench_.run_until(there, 400))
      << "never at " << field_name(field) << "[" << index << "]";
}

void Scene::expect_reception(const Frame &frame) {
  const std::string bits = wire(frame);
  const std::size_t before = dut().received().size();
  EXPECT_EQ(play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
  ASSERT_EQ(dut().received().size(), before + 1);
  EXPECT_EQ(dut().received().back(), frame);
}

void Scene::expect_transmission(const Frame &frame) {
  const std::size_t before = dut().sent().size();
  const std::string bits = wire(frame);
  const bool passive = bench_.last().passive;
  send(frame);
  EXPECT_EQ(play(flipped(r_bits(bits.size()), ack_offset(frame)) + r_bits(3)), bits + r_bits(3));
  if (passive) play(r_bits(8));
  ASSERT_EQ(dut().sent().size(), before + 1);
  EXPECT_EQ(dut().sent().back(), frame);
}

void Scene::expect_counters(unsigned expected_tec, unsigned expected_rec) {
  EXPECT_EQ(tec(), expected_tec);
  if (expected_rec >= 128) {
    EXPECT_GE(rec(), 128u);
  } else {
    EXPECT_EQ(rec(), expected_rec);
  }
}

}  // namespace vericansim
