// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ProgramPort: see program_port.hpp.
#include "program_port.hpp"

namespace vericansim {

std::optional<PortMessage> ProgramPort::take() {
  if (to_bus_.empty()) return std::nullopt;
  const PortMessage message = to_bus_.front();
  to_bus_.pop_front();
  return message;
}

bool ProgramPort::put(const PortMessage &message) {
  from_bus_.push_back(message);
  return true;
}

void ProgramPort::send(const can_frame &frame) {
  PortMessage message;
  message.frame = frame;
  to_bus_.push_back(message);
}

std::vector<PortMessage> ProgramPort::receive() { return std::exchange(from_bus_, {}); }

}  // namespace vericansim
