// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What nodes send and show, as text for messages.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "model/remote_model.hpp"
#include "trace/candump.hpp"

namespace vericansim {

inline std::string text_of(const std::optional<Frame> &frame) {
  return frame ? candump_frame(*frame) : "nothing";
}

inline std::string text_of(const std::vector<RemotePulse> &pulses) {
  std::string text;
  for (const RemotePulse &pulse : pulses)
    text += pulse.apply ? "apply " : fmt::format("{:03X}+{} ", pulse.address, pulse.length);
  return text;
}

}  // namespace vericansim
