// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_arguments.hpp.
#include "cli/memory_arguments.hpp"

#include <fmt/format.h>

#include "cli/number_check.hpp"
#include "model/remote_config.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

/// Bytes that `node` has from `address` on, of memory or of what lies behind the hidden part.
unsigned room_of(MemoryCalls &calls, unsigned node, unsigned address) {
  const unsigned end = calls.memory_size(node) - (remote_map::kSize - remote_map::kHidden);
  if (address < end) return end - address;
  return address < remote_map::kNode ? 0 : remote_map::kSize - address;
}

/// Appends the bytes of a word of two digits each.
void add_bytes(const std::string &word, Bytes &bytes) {
  std::size_t at = 0;
  for (; at + 1 < word.size(); at += 2) {
    const auto byte = text::parse_unsigned(std::string_view{word}.substr(at, 2), 16);
    if (!byte) break;
    bytes.push_back(static_cast<std::uint8_t>(*byte));
  }
  if (at != word.size()) refuse("bytes", word, "hexadecimal bytes of two digits, 5A 01 or 5A01");
}

}  // namespace

void refuse(const char *what, const std::string &value, const std::string &allowed) {
  throw InputError(what, 0,
                   fmt::format("{} is not allowed; allowed: {}", in_quotes(value), allowed));
}

unsigned node_of(const MemoryCalls &calls, const MemoryOptions &options, bool or_all) {
  if (or_all && options.node == "all") return VERICAN_REMOTE_ALL;
  const auto number = parse_integer(options.node);
  const bool zeros = has_leading_zeros(options.node);
  if (zeros || !number || *number < 2 || *number > calls.highest_number())
    refuse("node", options.node,
           fmt::format("2 to {}{}{}", calls.highest_number(),
                       zeros ? " without zeros in front" : "", or_all ? ", all" : ""));
  return static_cast<unsigned>(*number);
}

void check_range(unsigned address, std::size_t length) {
  if (length == 0 || address + length > remote_map::kSize)
    refuse("length", std::to_string(length),
           fmt::format("1 to {} from 0x{:03X} on", remote_map::kSize - address, address));
}

void require_room(MemoryCalls &calls, unsigned node, unsigned address, std::size_t length,
                  const std::string &what) {
  const unsigned room = room_of(calls, node, address);
  if (room == 0)
    throw InputError("address", 0, fmt::format("node {} has no memory at 0x{:03X}", node, address));
  if (length > room)
    throw InputError(what, 0,
                     fmt::format("{} bytes; allowed: 1 to {} from 0x{:03X} on, in node {}", length,
                                 room, address, node));
}

Bytes bytes_of(const std::vector<std::string> &words) {
  Bytes bytes;
  for (const std::string &word : words) add_bytes(word, bytes);
  return bytes;
}

void require_answers(const MemoryCalls &calls, bool any) {
  if (any) return;
  throw MemoryFailure(fmt::format("no node answers; numbers have {} bits here, --name-bits says so",
                                  calls.name_bits()));
}

}  // namespace vericansim::cli
