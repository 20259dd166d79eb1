// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// IdFilter: see id_filter.hpp.
#include "trace/id_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

std::optional<canid_t> parse_hex(std::string_view text) {
  canid_t value = 0;
  if (text.empty() || text.size() > 8) return {};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

IdFilter parse_filter(const std::string &text) {
  const std::size_t sign = text.find_first_of(":~");
  if (sign != std::string::npos) {
    const std::string_view all{text};
    const auto id = parse_hex(all.substr(0, sign));
    const auto mask = parse_hex(all.substr(sign + 1));
    constexpr std::size_t kExtendedDigits = 8;
    const canid_t flag = sign == kExtendedDigits ? CAN_EFF_FLAG : 0;
    if (id && flag == 0 && *id > CAN_SFF_MASK)
      throw InputError("--filter", 0,
                       in_quotes(text) +
                           " is not allowed; allowed: identifiers up to 7FF, or of eight digits "
                           "for 29 bits");
    if (id && mask) return {*id | flag, *mask & ~CAN_ERR_FLAG, text[sign] == '~'};
  }
  throw InputError("--filter", 0,
                   in_quotes(text) +
                       " is not allowed; allowed: ID:MASK or ID~MASK (all but these), "
                       "hexadecimal, as in 100:7F0");
}

std::string to_text(const IdFilter &filter) {
  const bool extended = (filter.id & CAN_EFF_FLAG) != 0;
  return fmt::format("{:0{}X}{}{:X}", extended ? filter.id & ~CAN_EFF_FLAG : filter.id,
                     extended ? 8 : 1, filter.inverted ? '~' : ':', filter.mask);
}

canid_t can_id_of(const Frame &frame) {
  return frame.id | (frame.extended ? CAN_EFF_FLAG : 0) | (frame.remote ? CAN_RTR_FLAG : 0);
}

bool passes(const std::vector<IdFilter> &filters, canid_t can_id) {
  return filters.empty() || std::any_of(filters.begin(), filters.end(),
                                        [can_id](const auto &f) { return f.matches(can_id); });
}

}  // namespace vericansim
