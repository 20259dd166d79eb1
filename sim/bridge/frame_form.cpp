// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames in the form of the bus and in the form of SocketCAN.
#include "frame_form.hpp"

#include <algorithm>

#include "trace/id_filter.hpp"

namespace vericansim {

can_frame to_can_frame(const Frame &frame) {
  frame.validate();
  can_frame message{};
  message.can_id = can_id_of(frame);
  message.len = std::min<std::uint8_t>(frame.dlc, CAN_MAX_DLEN);
  message.len8_dlc = frame.dlc > CAN_MAX_DLEN ? frame.dlc : 0;
  std::copy_n(frame.data.begin(), frame.payload_size(), message.data);
  return message;
}

std::optional<Frame> from_can_frame(const can_frame &message) {
  Frame frame;
  frame.extended = (message.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (message.can_id & CAN_RTR_FLAG) != 0;
  frame.id = message.can_id & CAN_EFF_MASK;
  if ((message.can_id & CAN_ERR_FLAG) != 0 || message.len > CAN_MAX_DLEN ||
      (!frame.extended && frame.id > CAN_SFF_MASK))
    return {};
  frame.dlc = message.len;
  // As in the kernel: len8_dlc counts only with a full payload and in its range.
  if (message.len == CAN_MAX_DLEN && message.len8_dlc > CAN_MAX_DLEN &&
      message.len8_dlc <= CAN_MAX_RAW_DLC)
    frame.dlc = message.len8_dlc;
  std::copy_n(message.data, frame.payload_size(), frame.data.begin());
  return frame;
}

}  // namespace vericansim
