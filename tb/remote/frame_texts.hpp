// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and how candump writes them, for tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "trace/candump.hpp"

namespace vericansim {

/// Frames as text.
using Texts = std::vector<std::string>;

/// "1A0#5A" as a frame; a failure of the test if it is none.
inline Frame frame_of(const std::string &text) {
  Frame frame;
  if (!parse_candump_frame(text, frame, {text, 0})) ADD_FAILURE() << text << " is no frame";
  return frame;
}

/// A base data frame with these bytes.
inline Frame frame_of(unsigned id, std::initializer_list<std::uint8_t> bytes) {
  Frame frame{.id = id, .dlc = static_cast<std::uint8_t>(bytes.size())};
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

/// Each frame as text.
inline Texts texts_of(const std::vector<Frame> &frames) {
  Texts texts;
  for (const Frame &frame : frames) texts.push_back(candump_frame(frame));
  return texts;
}

}  // namespace vericansim
