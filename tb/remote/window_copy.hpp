// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RN-65, the example: a map entry keeps a copy of another node's window; for tests of the RTL and
// of its model.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// A node whose entry 680, 780, 200 copies the window of node 5 to 200..277 hears what that one and
/// others send: `receive(frame)`. `bytes(address, count)` says what it has then.
template <typename Receive, typename Bytes>
void expect_a_copy_of_a_window(Receive receive, Bytes bytes) {
  std::mt19937 dice{65};
  std::vector<std::uint8_t> window(0x78);
  for (int i = 0; i < 2000; ++i) {
    Frame frame;
    frame.id = 0x680 + dice() % 0x80;
    frame.dlc = static_cast<std::uint8_t>(1 + dice() % 8);
    for (unsigned b = 0; b < frame.dlc; ++b) frame.data[b] = static_cast<std::uint8_t>(dice());
    const unsigned a = frame.id & 0x7F;
    if (a < 0x78 && a + frame.dlc > 0x78) continue;  // RN-06: nobody says that
    if (a < 0x78) std::copy_n(frame.data.begin(), frame.dlc, window.begin() + a);
    receive(frame);
    ASSERT_THAT(bytes(0x200, 0x78), ::testing::ElementsAreArray(window));
  }
  EXPECT_THAT(bytes(0x278, 0x20), ::testing::Each(0));  // ports are not taken
}

}  // namespace vericansim
