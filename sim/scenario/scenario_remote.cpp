// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: nodes without a processor (docs/remote.md).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "node/remote_node.hpp"
#include "scenario/remote_tables.hpp"
#include "scenario/scenario_remote_parts.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim::detail {
namespace {

unsigned number(const YamlValue &value, unsigned most, unsigned least = 0) {
  return static_cast<unsigned>(value.integer(least, most));
}

/// A time as whole units of `unit`.
unsigned units(const YamlValue &value, Time unit, unsigned most) {
  const Time time = value.time(0, unit * most);
  if (time % unit != 0) value.refuse("a multiple of " + exact_time(unit));
  return static_cast<unsigned>(time / unit);
}

/// The configuration as bytes of the memory.
class Settings {
 public:
  explicit Settings(RemoteRole &role) : role_{role} {}

  void byte(unsigned address, unsigned value) {
    role_.memory[address] = {static_cast<std::uint8_t>(value)};
  }
  void word(unsigned address, unsigned value) {
    byte(address, value & 0xFF);
    byte(address + 1, value >> 8);
  }
  [[nodiscard]] const RemoteConfig &config() const { return role_.config; }
  [[nodiscard]] unsigned number() const { return role_.number; }

 private:
  RemoteRole &role_;
};

/// Bits of FLAGS, set or cleared by keys of their own.
void parse_flags(YamlMap &map, Settings &settings) {
  unsigned flags = remote_flags::kErrors | remote_flags::kBoot;
  bool given = false;
  const auto flag = [&](const char *key, unsigned bit) {
    map.with(key, [&](const YamlValue &v) {
      flags = v.boolean() ? flags | bit : flags & ~bit;
      given = true;
    });
  };
  flag("tell_refusals", remote_flags::kErrors);
  flag("tell_writes", remote_flags::kWrites);
  flag("tell_start", remote_flags::kBoot);
  flag("auto_operate", remote_flags::kAutoOperate);
  if (given) settings.byte(remote_map::kFlags, flags);
}

/// One area "0x180-0x1FF" of a protection table: whole pages of 128 bytes, or of 16 below 0x80, of
/// a memory that ends below `end`.
void protect(const YamlValue &value, unsigned end, std::array<unsigned, 5> &table) {
  const std::string area = value.text();
  const std::size_t dash = area.find('-');
  const auto first = parse_integer(std::string_view{area}.substr(0, dash));
  const auto last = dash == std::string::npos
                        ? std::nullopt
                        : parse_integer(std::string_view{area}.substr(dash + 1));
  const auto on_border = [](std::uint64_t at) { return at % (at < 0x80 ? 16 : 128) == 0; };
  if (!first || !last || *last < *first || *last >= end || !on_border(*first) ||
      !on_border(*last + 1))
    value.refuse(
        fmt::format("an area below 0x{:X} of whole pages, as in 0x180-0x1FF: 128 bytes each, 16 "
                    "below 0x80",
                    end));
  for (std::uint64_t at = *first; at <= *last; at += at < 0x80 ? 16 : 128) {
    if (at < 0x80)
      table[4] |= 1U << (at / 16);
    else
      table[at / 1024] |= 1U << (at / 128 % 8);
  }
}

void parse_protection(YamlMap &map, Settings &settings, const char *key, unsigned address) {
  map.with(key, [&](const YamlValue &v) {
    if (!settings.config().protect) v.fail("this node has no protection");
    std::array<unsigned, 5> table{};
    for (const YamlValue &item : v.items()) protect(item, memory_end(settings.config()), table);
    for (unsigned i = 0; i < table.size(); ++i) settings.byte(address + i, table[i]);
  });
}

/// What a producer sends: an address of the window, or "status", "identity".
unsigned parse_place(const YamlValue &value, const RemoteConfig &config) {
  const unsigned ports = config.first_port();
  if (value.text() == "status") return ports + static_cast<unsigned>(RemotePort::kStatus);
  if (value.text() == "identity") return ports + static_cast<unsigned>(RemotePort::kIdent);
  const auto address = parse_integer(value.text());
  if (!address || *address >= ports)
    value.refuse(fmt::format("status, identity, or an address of 0 to 0x{:X}", ports - 1));
  return static_cast<unsigned>(*address);
}

/// An entry of `producers` (RN-63).
void parse_producer(const YamlValue &value, unsigned k, Settings &settings) {
  YamlMap map{value};
  const unsigned at = remote_map::kProducers + 8 * k;
  const YamlValue place = map.need("send");
  const unsigned a = parse_place(place, settings.config());
  const unsigned length = number(map.need("length"), 8, 1);
  if (a < settings.config().first_port() && a + length > settings.config().first_port())
    place.fail(fmt::format("{} bytes from here end beyond the window", length));
  unsigned mode = 0x80 | length;
  unsigned period = 0;
  unsigned gap = 0;
  map.with("period", [&](const YamlValue &v) {
    period = units(v, kMillisecond, 0xFFFF);
    if (period == 0) v.refuse("1 ms or more, as a producer with a period of 0 is never due");
    mode |= 0x10;
  });
  map.with("triggers", [&](const YamlValue &v) {
    if ((mode & 0x10) != 0) v.fail("'period' is given too; allowed: one of them");
    period = number(v, 0xFFFF, 1);
    mode |= 0x50;
  });
  map.with("on_change", [&](const YamlValue &v) { mode |= v.boolean() ? 0x20 : 0; });
  map.with("gap", [&](const YamlValue &v) { gap = units(v, kMillisecond, 0xFF); });
  map.finish();
  settings.byte(at, a);
  settings.byte(at + 1, mode);
  settings.word(at + 2, period);
  settings.byte(at + 4, gap);
}

/// An entry of `map` (RN-65).
void parse_map_entry(const YamlValue &value, unsigned k, Settings &settings) {
  YamlMap map{value};
  const unsigned at = remote_map::kMaps + 8 * k;
  unsigned mask = 0x7FF;
  unsigned flags = 0;
  unsigned time_out = 0;
  const unsigned id = number(map.need("id"), 0x7FF);
  const unsigned to = number(map.need("to"), 0xFFF);
  map.with("mask", [&](const YamlValue &v) { mask = number(v, 0x7FF); });
  map.with("length", [&](const YamlValue &v) { flags |= number(v, 8, 1); });
  map.with("trigger", [&](const YamlValue &v) { flags |= v.boolean() ? 0x20 : 0; });
  map.with("safe_when_late", [&](const YamlValue &v) { flags |= v.boolean() ? 0x40 : 0; });
  map.with("time_out", [&](const YamlValue &v) { time_out = units(v, 10 * kMillisecond, 0xFF); });
  map.finish();
  const std::string never =
      why_never({id, mask, to, flags, time_out}, settings.config(), settings.number());
  if (!never.empty()) value.fail(never);
  settings.word(at, id | 0x8000);
  settings.word(at + 2, mask);
  settings.word(at + 4, to);
  settings.byte(at + 6, flags);
  settings.byte(at + 7, time_out);
}

template <typename Parse>
void parse_table(YamlMap &map, const char *key, unsigned places, Settings &settings, Parse parse) {
  map.with(key, [&](const YamlValue &v) {
    const std::vector<YamlValue> items = v.items();
    if (items.size() > places) v.fail(fmt::format("{} entries; allowed: {}", items.size(), places));
    for (unsigned k = 0; k < items.size(); ++k) parse(items[k], k, settings);
  });
}

void parse_config(const YamlValue &value, RemoteRole &role) {
  YamlMap map{value};
  Settings settings{role};
  parse_flags(map, settings);
  map.with("watchdog", [&](const YamlValue &v) {
    settings.word(remote_map::kWatchdog, units(v, kMillisecond, 0xFFFF));
  });
  map.with("back_off", [&](const YamlValue &v) {
    settings.byte(remote_map::kBackOff, units(v, kMillisecond, 0xFF));
  });
  map.with("life", [&](const YamlValue &v) {
    settings.byte(remote_map::kLife, units(v, 10 * kMillisecond, 0xFF));
  });
  map.with("block_time_out", [&](const YamlValue &v) {
    if (!role.config.block) v.fail("this node has no block transfers");
    settings.byte(remote_map::kBlockTimeout, units(v, 10 * kMillisecond, 0xFF));
  });
  map.with("retry",
           [&](const YamlValue &v) { settings.byte(remote_map::kRetry, number(v, 0xFF)); });
  map.with("label", [&](const YamlValue &v) {
    const std::string label = v.text();
    if (label.size() > 8)
      v.fail(fmt::format("{} bytes; allowed: 8 at most, where a letter beyond ASCII has several",
                         label.size()));
    for (unsigned i = 0; i < label.size(); ++i)
      settings.byte(remote_map::kLabel + i, static_cast<unsigned char>(label[i]));
  });
  parse_protection(map, settings, "write_protect", remote_map::kWriteProtect);
  parse_protection(map, settings, "read_protect", remote_map::kReadProtect);
  parse_table(map, "producers", role.config.num_prod, settings, parse_producer);
  parse_table(map, "map", role.config.num_map, settings, parse_map_entry);
  map.finish();
}

/// Its bytes beside those of `memory`, each of which is given once.
void add_config(const YamlValue &value, RemoteRole &role) {
  RemoteRole configured = role;
  configured.memory.clear();
  parse_config(value, configured);
  for (auto &[at, bytes] : configured.memory) add_bytes(value, at, std::move(bytes), role.memory);
}

/// `number` is that of the node; its place in the memory must not say another one.
void refuse_number_in_memory(const YamlValue &number, const RemoteRole &role) {
  for (const auto &[first, bytes] : role.memory)
    if (first <= remote_map::kNode && remote_map::kNode < first + bytes.size())
      number.fail(fmt::format("'memory' gives it, too, at 0x{:X}; allowed: one of them",
                              remote_map::kNode));
}

/// What user logic may set up before the start (RN-62): memory, configuration and tables.
void parse_memory(const YamlValue &value, RemoteRole &role) {
  YamlMap map{value};
  const std::vector<RemoteArea> areas = remote_areas(role.config);
  for (const std::string &key : map.keys()) {
    const YamlValue bytes = map.need(key);
    const std::uint64_t address = parse_integer(key).value_or(remote_map::kSize);
    const RemoteArea area = area_of(areas, address);
    if (area.end == 0)
      bytes.fail(fmt::format("{} is no address; allowed: {}", in_quotes(key), to_text(areas)));
    const auto at = static_cast<unsigned>(address);
    add_bytes(bytes, at, parse_bytes(bytes, area.end - at), role.memory);
  }
}

RemoteConfig parse_parameters(YamlMap &map) {
  RemoteConfig config = RemoteConfig::profile("full");
  map.with("profile", [&](const YamlValue &v) {
    try {
      config = RemoteConfig::profile(v.text());
    } catch (const std::invalid_argument &) {
      v.refuse("small, standard, full");
    }
  });
  const auto parameter = [&](const char *key, unsigned &target) {
    map.with(key, [&](const YamlValue &v) {
      target = number(v, 0xFFFF);
      try {
        config.validate();
      } catch (const std::invalid_argument &error) {
        v.fail(error.what());
      }
    });
  };
  parameter("name_bits", config.name_bits);
  parameter("memory_bytes", config.mem_bytes);
  parameter("stage_bytes", config.stage_bytes);
  map.with("serial", [&](const YamlValue &v) {
    config.serial = static_cast<std::uint32_t>(v.integer(0, 0xFFFFFFFF));
  });
  map.with("same_id", [&](const YamlValue &v) { config.same_id = v.boolean(); });
  return config;
}

void parse_body(const YamlValue &value, RemoteRole &role) {
  if (value.text() != "rtl" && value.text() != "model") value.refuse("rtl, model");
  const bool rtl = value.text() == "rtl";
  role.body = rtl ? RemoteRole::Body::kRtl : RemoteRole::Body::kModel;
  if (rtl && !RemoteNode::has(role.config))
    value.fail("no RTL is built with these parameters; allowed: " + RemoteNode::available() +
               "; or made_of: model");
}

}  // namespace

std::vector<std::uint8_t> parse_bytes(const YamlValue &value, std::size_t most) {
  std::vector<std::uint8_t> bytes;
  const std::string words = value.text();
  for (const std::string_view word : text::split_blanks(words)) {
    const auto byte = text::parse_unsigned(word, 16);
    if (!byte || word.size() > 2) value.refuse("hexadecimal bytes, as in 01 A5");
    bytes.push_back(static_cast<std::uint8_t>(*byte));
  }
  if (bytes.empty() || bytes.size() > most) value.refuse(fmt::format("1 to {} bytes", most));
  return bytes;
}

void add_bytes(const YamlValue &value, unsigned at, std::vector<std::uint8_t> bytes,
               std::map<unsigned, std::vector<std::uint8_t>> &memory) {
  for (const auto &[first, there] : memory)
    if (at < first + there.size() && first < at + bytes.size())
      value.fail(fmt::format("byte 0x{:X} is given already; allowed: each byte once",
                             std::max(at, first)));
  memory[at] = std::move(bytes);
}

unsigned parse_address(const std::string &key, const YamlValue &value, unsigned end) {
  const auto address = parse_integer(key);
  if (!address || *address >= end)
    value.fail(fmt::format("{} is no address; allowed: 0 to 0x{:X}", in_quotes(key), end - 1));
  return static_cast<unsigned>(*address);
}

RemoteRole parse_remote(const YamlValue &value, YamlMap &map) {
  if (value.text() != "remote") value.refuse("remote");
  RemoteRole role;
  role.config = parse_parameters(map);
  map.with("number",
           [&](const YamlValue &v) { role.number = number(v, role.config.highest_number()); });
  map.with("made_of", [&](const YamlValue &v) { parse_body(v, role); });
  map.with("memory", [&](const YamlValue &v) { parse_memory(v, role); });
  if (const auto own = map.find("number")) refuse_number_in_memory(*own, role);
  map.with("config", [&](const YamlValue &v) { add_config(v, role); });
  return role;
}

void parse_judge(const YamlValue &value, Scenario &scenario) {
  if (value.text() != "lockstep" && value.text() != "none") value.refuse("lockstep, none");
  scenario.lockstep = value.text() == "lockstep";
  for (const NodeSpec &node : scenario.nodes)
    if (scenario.lockstep && std::holds_alternative<RemoteRole>(node.role))
      value.fail("the judges know no remote nodes, and " + in_quotes(node.name) +
                 " is one; allowed: none");
}

}  // namespace vericansim::detail
