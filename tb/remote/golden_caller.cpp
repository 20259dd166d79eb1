// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GoldenCaller: see golden_caller.hpp.
#include "remote/golden_caller.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAreArray;

void ok(verican_remote_result_t result) { EXPECT_EQ(result, VERICAN_REMOTE_OK); }

}  // namespace

void GoldenCaller::carry_out(const golden::Call &call) {
  SCOPED_TRACE(call.what);
  const auto node = static_cast<std::uint8_t>(call.node);
  const auto address = static_cast<std::uint16_t>(call.address);
  if (call.what == "write") {
    ok(verican_remote_write(&client_, node, address, call.data.data(), call.data.size()));
  } else if (call.what == "read") {
    Bytes bytes(call.length);
    ok(verican_remote_read(&client_, node, address, bytes.data(), bytes.size()));
    EXPECT_EQ(bytes, call.gives_with(profile_));
  } else if (call.what == "block_read") {
    Bytes bytes(call.length);
    client_.tag = static_cast<std::uint8_t>(call.tag - 1);
    ok(verican_remote_block_read(&client_, node, address, bytes.data(), bytes.size()));
    EXPECT_EQ(bytes, call.gives_with(profile_));
  } else if (call.what == "block_write") {
    client_.tag = static_cast<std::uint8_t>(call.tag - 1);
    ok(verican_remote_block_write(&client_, node, address, call.data.data(), call.data.size()));
  } else {
    others(call);
  }
}

void GoldenCaller::others(const golden::Call &call) {
  const auto node = static_cast<std::uint8_t>(call.node);
  if (call.what == "trigger") {
    ok(verican_remote_trigger(&client_, static_cast<std::uint8_t>(call.count)));
  } else if (call.what == "state") {
    ok(verican_remote_state(
        &client_, node, call.command == "operate" ? VERICAN_REMOTE_OPERATE : VERICAN_REMOTE_SAFE));
  } else if (call.what == "status") {
    status(node, call.gives_with(profile_));
  } else if (call.what == "identity") {
    identity(node, call.gives_with(profile_));
  } else if (call.what == "poll") {
    poll(call);
  } else if (call.what == "select") {
    select(call);
  } else {
    FAIL() << "no such call";
  }
}

void GoldenCaller::select(const golden::Call &call) {
  const std::uint32_t usual = client_.select_us;
  if (call.here) client_.select_us = client_.timeout_us;  // HERE is late on a busy computer
  bool here = !call.here;
  ok(verican_remote_select(&client_, call.value, call.mask, false, &here));
  EXPECT_EQ(here, call.here);
  client_.select_us = usual;
}

void GoldenCaller::status(std::uint8_t node, const Bytes &row) {
  verican_remote_status_t s;
  ok(verican_remote_status(&client_, node, &s));
  const int flags = s.unlocked << 2 | s.error_passive << 3 | s.duplicate << 4 | s.stale << 5 |
                    s.watchdog << 6 | s.bus_off << 7;
  const std::array<int, 8> told{s.state | flags, s.tec,     s.rec,    s.code, s.a,
                                s.accepted,      s.refused, s.trigger};
  EXPECT_THAT(told, ElementsAreArray(row));
}

void GoldenCaller::identity(std::uint8_t node, const Bytes &row) {
  verican_remote_identity_t i;
  ok(verican_remote_identity(&client_, node, &i));
  EXPECT_EQ(i.number, node);
  EXPECT_EQ(i.version, row[0]);
  EXPECT_EQ(i.features, row[1]);
  EXPECT_EQ(i.name_bits, row[2] >> 4);
  EXPECT_EQ(i.memory, 1 << (row[2] & 15));
  EXPECT_EQ(i.stage, row[3]);
  EXPECT_EQ(i.serial, row[4] | row[5] << 8 | row[6] << 16 | std::uint32_t{row[7]} << 24);
}

void GoldenCaller::poll(const golden::Call &call) {
  std::uint32_t expected = 0;
  for (const auto &[number, bytes] : call.nodes) expected |= 1U << number;
  verican_remote_answers_t poll;
  ok(verican_remote_poll(&client_, static_cast<std::uint16_t>(call.address),
                         static_cast<std::uint8_t>(call.length), expected, &poll));
  EXPECT_EQ(poll.answered, expected);
  for (const auto &[number, bytes] : call.nodes)
    EXPECT_EQ(Bytes(poll.data[number], poll.data[number] + call.length), bytes);
}

std::vector<std::string> frames_of(const golden::Vector &vector) {
  std::vector<std::string> frames;
  for (const golden::Step &step : vector.steps) frames.push_back(candump_frame(step.send));
  return frames;
}

}  // namespace vericansim
