// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// IdFilter: which frames of the bus a program wants, in SocketCAN's terms.
#pragma once

#include <linux/can.h>

#include <string>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// A frame matches if (can_id & mask) == (id & mask), or, inverted, if that is not so. The flags of
/// can_id are compared as its other bits, where the mask has them.
struct IdFilter {
  canid_t id = 0;
  canid_t mask = 0;
  bool inverted = false;

  [[nodiscard]] bool matches(canid_t can_id) const {
    return (((can_id ^ id) & mask) == 0) != inverted;
  }
  friend bool operator==(const IdFilter &, const IdFilter &) = default;
};

/// Reads candump's "id:mask" and "id~mask" (inverted), hexadecimal; an id of eight digits means 29
/// bits and has CAN_EFF_FLAG. Throws InputError that shows `text` and what is allowed.
[[nodiscard]] IdFilter parse_filter(const std::string &text);

/// The same as text.
[[nodiscard]] std::string to_text(const IdFilter &filter);

/// The identifier of `frame` with SocketCAN's flags, as filters see it.
[[nodiscard]] canid_t can_id_of(const Frame &frame);

/// True if one of the filters matches, or if there is none.
[[nodiscard]] bool passes(const std::vector<IdFilter> &filters, canid_t can_id);

}  // namespace vericansim
