// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RandomHost: random commands for remote nodes.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// Commands as a bad host would send them: mostly for nodes that are there, mostly nearly right.
/// They know serial number CAFE1234.
class RandomHost {
 public:
  /// `names`: drawn with equal chances; by default node 3 most often.
  explicit RandomHost(unsigned seed,
                      std::vector<unsigned> names = {0, 0, 1, 1, 3, 3, 3, 3, 3, 3, 4, 2, 7},
                      unsigned name_bits = 3)
      : random_{seed}, names_{std::move(names)}, name_bits_{name_bits} {}

  unsigned upto(unsigned n) { return std::uniform_int_distribution<unsigned>{0, n - 1}(random_); }
  bool once_in(unsigned n) { return upto(n) == 0; }

  Frame frame() {
    Frame frame;
    const unsigned name = names_[upto(static_cast<unsigned>(names_.size()))];
    const unsigned a = name == 0 && !once_in(8) ? upto(6) : once_in(3) ? 0x78 + upto(8) : upto(128);
    frame.id = (once_in(20) ? 0x400U : 0U) | name << 7 | a;
    frame.remote = once_in(4);
    frame.dlc = static_cast<std::uint8_t>(once_in(4) ? upto(16) : likely_dlc(name, a));
    for (auto &byte : frame.data) byte = static_cast<std::uint8_t>(byte_());
    if (name != 0 && (a == 0x78 || a == 0x79)) address(frame);
    if (name == 0) system(frame, a);
    if (a == 0x7C && !once_in(4)) setup(frame);
    if (name != 0 && a == 0x7A && !once_in(4)) block(frame);
    if (frame.remote) frame.data = {};
    for (unsigned i = frame.dlc; i < 8; ++i) frame.data[i] = 0;
    if (name_bits_ == 5)  // the last eight A are ports here, too
      frame.id = (frame.id & 0x400) | name << 5 | (a >= 0x78 ? 0x18 | (a & 7) : a & 0x1F);
    if (once_in(50)) {
      frame.extended = true;
      frame.id <<= 18;
    }
    return frame;
  }

 private:
  unsigned byte_() {
    static constexpr unsigned kBytes[] = {0, 1, 2, 3, 4, 5, 0x81, 0xFF};
    return once_in(2) ? upto(256) : kBytes[upto(std::size(kBytes))];
  }
  unsigned likely_dlc(unsigned name, unsigned a) {
    if (name == 0) return a == 2 || a == 4 ? 8 : 1 + upto(2);
    if (a == 0x78) return 3;
    if (a == 0x7C) return once_in(2) ? 5 : 1;
    return 1 + upto(8);
  }
  void address(Frame &frame) {
    static constexpr unsigned kEdges[] = {0x010, 0x018, 0x078, 0x200, 0xDF8, 0xE00,
                                          0xE80, 0xF00, 0xF18, 0xF20, 0xF40, 0xF80,
                                          0xFC0, 0xFD0, 0xFE8, 0xFF0, 0xFF8, 0x1000};
    unsigned address = upto(0x1000);
    if (!once_in(3)) address = kEdges[upto(std::size(kEdges))] + upto(16) - 8;
    frame.data[0] = static_cast<std::uint8_t>(address);
    frame.data[1] = static_cast<std::uint8_t>(address >> 8);
    if (once_in(20)) frame.data[1] = static_cast<std::uint8_t>(byte_());
    if ((frame.id & 0x7F) == 0x78 && !once_in(8))
      frame.data[2] = static_cast<std::uint8_t>(upto(8));
  }
  void system(Frame &frame, unsigned a) {
    static constexpr std::uint8_t kStates[] = {1, 2, 1, 2, 1, 2, 0x81, 3};
    if (a == 0) {
      frame.data[0] = kStates[upto(8)];
      frame.data[1] = static_cast<std::uint8_t>(upto(5));
    }
    if (a == 3) frame.data[0] = once_in(2) ? 3 : static_cast<std::uint8_t>(byte_());
    if ((a == 2 || a == 4) && !once_in(4)) {
      static constexpr unsigned kSerial = 0xCAFE1234;
      const unsigned wrong = once_in(2) ? 1U << upto(32) : 0;
      for (unsigned i = 0; i < 4; ++i) {
        frame.data[2 * i] = static_cast<std::uint8_t>((kSerial ^ wrong) >> (8 * i));
        if (once_in(2)) frame.data[2 * i + 1] = 0xFF;
      }
    }
  }
  // Short transfers mostly: of the window, and where areas end.
  void block(Frame &frame) {
    address(frame);
    frame.data = {static_cast<std::uint8_t>(once_in(8) ? upto(4) : 1 + upto(2)),
                  frame.data[7],
                  frame.data[0],
                  frame.data[1],
                  static_cast<std::uint8_t>(upto(30)),
                  static_cast<std::uint8_t>(once_in(20)),
                  static_cast<std::uint8_t>(upto(4))};
    frame.dlc = static_cast<std::uint8_t>(6 + upto(2));
  }
  void setup(Frame &frame) {
    static constexpr std::array<std::uint8_t, 5> kUnlock = {1, 0x34, 0x12, 0xFE, 0xCA};
    frame.data[0] = static_cast<std::uint8_t>(once_in(30) ? 3 : once_in(2) ? 1 : 1 + upto(4));
    if (frame.data[0] == 1) {
      std::copy(kUnlock.begin(), kUnlock.end(), frame.data.begin());
      frame.dlc = 5;
    }
    if (frame.data[0] == 3 && !once_in(10)) frame.data[0] = 2;
  }

  std::mt19937 random_;
  std::vector<unsigned> names_;
  unsigned name_bits_;
};

}  // namespace vericansim
