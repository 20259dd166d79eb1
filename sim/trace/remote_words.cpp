// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See remote_words.hpp. Names of commands and their bytes: RN-20 to RN-26.
#include "trace/remote_words.hpp"

#include <fmt/format.h>

#include <array>

#include "model/remote_config.hpp"

namespace vericansim {
namespace {

/// A base frame taken apart (RN-02).
struct Parts {
  const Frame &frame;
  unsigned name, a, first_port;
  [[nodiscard]] unsigned byte(unsigned i) const { return frame.data[i]; }
  [[nodiscard]] unsigned word(unsigned i) const { return byte(i) | byte(i + 1) << 8; }
  [[nodiscard]] unsigned size() const { return frame.payload_size(); }
  [[nodiscard]] std::string bytes(unsigned from = 0) const {
    std::string text;
    for (unsigned i = from; i < size(); ++i)
      text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte(i));
    return text.empty() ? "nothing" : text;
  }
};

std::string counted_bytes(unsigned n) { return fmt::format("{} byte{}", n, n == 1 ? "" : "s"); }

/// Value and mask of SELECT, which come byte by byte in turn.
std::string select_words(const Parts &parts, const char *verb) {
  unsigned value = 0, mask = 0;
  for (unsigned i = 0; i < 4; ++i) {
    value |= parts.byte(2 * i) << (8 * i);
    mask |= parts.byte(2 * i + 1) << (8 * i);
  }
  return fmt::format("{} serial {:08X} under {:08X}", verb, value, mask);
}

std::string state_words(const Parts &parts) {
  const char *verb = parts.byte(0) == 0x01   ? "OPERATE"
                     : parts.byte(0) == 0x02 ? "SAFE"
                     : parts.byte(0) == 0x81 ? "RESTART"
                                             : "unknown STATE";
  return parts.size() < 2 || parts.byte(1) == 0 ? fmt::format("{} all", verb)
                                                : fmt::format("{} {}", verb, parts.byte(1));
}

/// Whether system function `a` has this DLC (section 3.3).
bool is_system_length(unsigned a, unsigned dlc) {
  switch (a) {
    case 0: return dlc == 1 || dlc == 2;
    case 1: return dlc <= 1;
    case 3: return dlc == 1;
    default: return dlc == 8;
  }
}

std::string system_words(const Parts &parts) {
  constexpr unsigned kFunctions = 5;
  const bool known = !parts.frame.remote && parts.a < kFunctions;
  if (known && !is_system_length(parts.a, parts.frame.dlc))
    return fmt::format("no command at system function {:02X}", parts.a);
  if (known) switch (parts.a) {
      case 0: return state_words(parts);
      case 1: return parts.size() == 0 ? "TRIGGER" : fmt::format("TRIGGER {}", parts.byte(0));
      case 2: return select_words(parts, "SELECT");
      case 3: return fmt::format("ASSIGN {}", parts.byte(0));
      case 4: return select_words(parts, "SELECT NEW");
      default: break;
    }
  return fmt::format("unknown system function {:02X}", parts.a);
}

std::string block_request(const Parts &parts) {
  const char *verb = parts.byte(0) == 1 ? "block read" : "block write";
  if (parts.byte(0) == 0) return fmt::format("abort block, tag {:02X}", parts.byte(1));
  return fmt::format("{} {:03X}, {}, tag {:02X}", verb, parts.word(2), counted_bytes(parts.word(4)),
                     parts.byte(1));
}

std::string setup_request(const Parts &parts) {
  constexpr std::array<const char *, 5> kVerbs{"unknown SETUP", "unlock", "lock",
                                               "lock until reset", "clear counters and flags"};
  return kVerbs[parts.byte(0) < kVerbs.size() ? parts.byte(0) : 0];
}

std::string port_request(const Parts &parts, RemotePort port) {
  const bool remote = parts.frame.remote;
  switch (port) {
    case RemotePort::kRead:
      if (remote || parts.size() != 3) break;
      return fmt::format("read {:03X}, {}", parts.word(0), counted_bytes(parts.byte(2)));
    case RemotePort::kWrite:
      if (remote || parts.size() < 3) break;
      return fmt::format("write {:03X} <- {}", parts.word(0), parts.bytes(2));
    case RemotePort::kBlock:
      if (remote || parts.frame.dlc < 6 || parts.frame.dlc > 7 || parts.byte(0) > 2) break;
      return block_request(parts);
    case RemotePort::kData:
      if (remote || parts.size() < 2) break;
      return fmt::format("block data {} <- {}", parts.byte(0), parts.bytes(1));
    case RemotePort::kSetup:
      if (remote || parts.frame.dlc != (parts.byte(0) == 1 ? 5 : 1)) break;
      return setup_request(parts);
    case RemotePort::kStatus:
      if (remote) return "read STATUS";
      break;
    case RemotePort::kIdent:
      if (remote) return "read IDENT";
      break;
    default: break;
  }
  return fmt::format("no command at port {:02X}", parts.a);
}

std::string request_words(const Parts &parts) {
  if (parts.name == 0) return system_words(parts);
  const std::string who = parts.name == 1 ? "all" : std::to_string(parts.name);
  if (parts.a >= parts.first_port)
    return who + ": " + port_request(parts, static_cast<RemotePort>(parts.a - parts.first_port));
  if (parts.frame.remote)
    return fmt::format("{}: read {:03X}, {}", who, parts.a, counted_bytes(parts.frame.dlc));
  return fmt::format("{}: write {:03X} <- {}", who, parts.a, parts.bytes());
}

std::string status_words(const Parts &parts) {
  std::string text = "STATUS " + remote_state_name(parts.byte(0));
  constexpr std::array<std::pair<unsigned, const char *>, 6> kFlags{{{2, "unlocked"},
                                                                     {3, "error passive"},
                                                                     {4, "number doubled"},
                                                                     {5, "stale"},
                                                                     {6, "watchdog"},
                                                                     {7, "was bus-off"}}};
  for (const auto &[bit, name] : kFlags)
    if ((parts.byte(0) >> bit & 1) != 0) text += std::string(", ") + name;
  if (parts.size() > 4 && parts.byte(3) != 0)
    text += fmt::format(", code {:02X} ({}) at {:02X}", parts.byte(3),
                        remote_code_name(parts.byte(3)), parts.byte(4));
  if (parts.size() == 8)
    text += fmt::format(", accepted {}, refused {}, TRIGGER {}", parts.byte(5), parts.byte(6),
                        parts.byte(7));
  return text;
}

std::string block_answer(const Parts &parts) {
  const char *verb = parts.byte(0) == 1 ? "block read" : "block write";
  const char *what = parts.byte(2) == 0 ? "done" : parts.byte(2) == 5 ? "open" : "closed";
  std::string text = fmt::format("{} {}, {}", verb, what, counted_bytes(parts.word(4)));
  if (parts.byte(2) != 0 && parts.byte(2) != 5)
    text += fmt::format(", code {:02X} ({})", parts.byte(2), remote_code_name(parts.byte(2)));
  return text;
}

std::string port_statement(const Parts &parts, RemotePort port) {
  const unsigned n = parts.size();
  if (port == RemotePort::kRead && n > 2)
    return fmt::format("{:03X} = {}", parts.word(0), parts.bytes(2));
  if (port == RemotePort::kBlock && n == 6) return block_answer(parts);
  if (port == RemotePort::kData && n > 1)
    return fmt::format("block data {} = {}", parts.byte(0), parts.bytes(1));
  if (port == RemotePort::kStatus && n > 0) return status_words(parts);
  if (port == RemotePort::kIdent && n == 8)
    return fmt::format("IDENT serial {:04X}{:04X}", parts.word(6), parts.word(4));
  return fmt::format("port {:02X} = {}", parts.a, parts.bytes());
}

std::string statement_words(const Parts &parts) {
  if (parts.name == 0 && parts.a == 2 && !parts.frame.remote) return "HERE";
  if (parts.frame.remote) return fmt::format("remote frame to what {} says", parts.name);
  const std::string who = fmt::format("{} says ", parts.name);
  if (parts.a >= parts.first_port)
    return who + port_statement(parts, static_cast<RemotePort>(parts.a - parts.first_port));
  return fmt::format("{}{:03X} = {}", who, parts.a, parts.bytes());
}

}  // namespace

std::string remote_words(const Frame &frame, unsigned name_bits) {
  if (frame.extended) return {};
  RemoteConfig config;
  config.name_bits = name_bits;
  const unsigned bits = config.address_bits();
  const Parts parts{frame, frame.id >> bits & config.highest_number(),
                    frame.id & ((1U << bits) - 1), config.first_port()};
  return (frame.id >> 10 & 1) != 0 ? statement_words(parts) : request_words(parts);
}

std::string remote_code_name(unsigned code) {
  switch (static_cast<RemoteCode>(code)) {
    case RemoteCode::kAccepted: return "accepted";
    case RemoteCode::kFunction: return "illegal function";
    case RemoteCode::kAddress: return "illegal address";
    case RemoteCode::kValue: return "illegal value";
    case RemoteCode::kOpen: return "open";
    case RemoteCode::kBusy: return "busy";
    case RemoteCode::kProtected: return "protected";
    case RemoteCode::kLocked: return "locked";
    case RemoteCode::kSequence: return "sequence";
    case RemoteCode::kTimeout: return "time-out";
    case RemoteCode::kAborted: return "aborted";
  }
  return "unknown";
}

std::string remote_state_name(unsigned state) {
  constexpr std::array<const char *, 4> kNames{"INIT", "LISTEN", "SAFE", "OPERATE"};
  return kNames[state & 3];
}

}  // namespace vericansim
