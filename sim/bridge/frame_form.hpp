// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames in the form of the bus and in the form of SocketCAN.
#pragma once

#include <linux/can.h>

#include <optional>

#include "model/frame.hpp"

namespace vericansim {

/// A data or remote frame as the programs of a host have it (linux/can.h): flags in can_id, and a
/// raw DLC of 9 to 15 in len8_dlc. Bytes beyond the payload are zero.
/// Throws as Frame::validate().
[[nodiscard]] can_frame to_can_frame(const Frame &frame);

/// What a program has sent, as a frame of the bus. Empty if it is none: an error message, more than
/// 8 bytes, or an identifier above 7FF without CAN_EFF_FLAG.
[[nodiscard]] std::optional<Frame> from_can_frame(const can_frame &message);

}  // namespace vericansim
