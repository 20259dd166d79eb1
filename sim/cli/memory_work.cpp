// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_work.hpp.
#include "cli/memory_work.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/cli.hpp"
#include "cli/memory_arguments.hpp"
#include "cli/memory_map.hpp"
#include "cli/memory_nodes.hpp"
#include "cli/output_files.hpp"
#include "model/remote_config.hpp"
#include "trace/input_error.hpp"
#include "trace/input_file.hpp"
#include "trace/output_file.hpp"
#include "trace/remote_words.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

std::string hex(const Bytes &bytes) { return fmt::format("{:02X}", fmt::join(bytes, " ")); }

Json to_json(unsigned number, const verican_remote_status_t &s) {
  return {{"number", number},       {"state", remote_state_name(s.state)},
          {"unlocked", s.unlocked}, {"error_passive", s.error_passive},
          {"doubled", s.duplicate}, {"stale", s.stale},
          {"watchdog", s.watchdog}, {"was_bus_off", s.bus_off},
          {"tec", s.tec},           {"rec", s.rec},
          {"code", s.code},         {"a", s.a},
          {"accepted", s.accepted}, {"refused", s.refused},
          {"trigger", s.trigger}};
}

std::string to_text(unsigned number, const verican_remote_status_t &s) {
  std::string text =
      fmt::format("{:>4}  {:<8} {:>4} {:>4} {:>9} {:>8} {:>8}", number, remote_state_name(s.state),
                  s.tec, s.rec, s.accepted, s.refused, s.trigger);
  const std::pair<bool, const char *> flags[] = {
      {s.unlocked, "unlocked"}, {s.error_passive, "error passive"}, {s.duplicate, "number doubled"},
      {s.stale, "stale"},       {s.watchdog, "watchdog"},           {s.bus_off, "was bus-off"}};
  for (const auto &[set, name] : flags)
    if (set) text += std::string("  ") + name;
  if (s.code != 0)
    text += fmt::format("  code {:02X} ({}) at {:02X}", s.code, remote_code_name(s.code), s.a);
  return text + "\n";
}

std::string dump_text(unsigned first, const Bytes &bytes) {
  constexpr std::size_t kRow = 16;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += kRow) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + kRow, bytes.size()));
    text += fmt::format("{:03X}  {:02X}\n", first + at, fmt::join(begin, end, " "));
  }
  return text;
}

/// A command to nodes and the state that it leads to, as STATUS has it (RN-24).
struct StateCommand {
  const char *name;
  unsigned command, state;
};
constexpr unsigned kSafe = 2, kOperate = 3;
constexpr StateCommand kStateCommands[] = {{"operate", VERICAN_REMOTE_OPERATE, kOperate},
                                           {"safe", VERICAN_REMOTE_SAFE, kSafe},
                                           {"restart", VERICAN_REMOTE_RESTART, kSafe}};

const StateCommand &state_command(const std::string &name) {
  return *std::find_if(std::begin(kStateCommands), std::end(kStateCommands),
                       [&](const StateCommand &command) { return name == command.name; });
}

/// Node and state: of `node`, or of all (0) at one moment. Those that have just been restarted may
/// not answer yet.
std::vector<std::pair<unsigned, unsigned>> states(MemoryCalls &calls, unsigned node) {
  constexpr unsigned kTries = 3, kMask = 3;
  if (node != 0) return {{node, calls.status(node).state}};
  verican_remote_answers_t answers{};
  for (unsigned i = 0; i < kTries && answers.answered == 0; ++i)
    answers = calls.poll(remote_map::kStatus, 1);
  require_answers(calls, answers.answered != 0);
  std::vector<std::pair<unsigned, unsigned>> states;
  for (unsigned number = 0; number < VERICAN_REMOTE_NUMBERS; ++number)
    if ((answers.answered >> number & 1) != 0)
      states.emplace_back(number, answers.data[number][0] & kMask);
  return states;
}

/// STATE is not answered (RN-30): only its state tells whether a node has heard it. A node that
/// restarts may go on to OPERATE by itself.
void require_state(MemoryCalls &calls, unsigned node, unsigned state, const StateCommand &command) {
  if (state == command.state) return;
  const bool by_itself =
      command.command == VERICAN_REMOTE_RESTART && state == kOperate &&
      (calls.read(node, remote_map::kFlags, 1)[0] & remote_flags::kAutoOperate) != 0;
  if (by_itself) return;
  throw MemoryFailure(fmt::format("node {} is in {}, not in {}", node, remote_state_name(state),
                                  remote_state_name(command.state)));
}

/// Prints what is wrong, beside JSON that has it already; the exit code.
int tell(const std::vector<std::string> &wrong, const MemoryOptions &options) {
  if (!options.json)
    for (const std::string &line : wrong) fmt::print("wrong: {}\n", line);
  return wrong.empty() ? kOk : kFailed;
}

/// The nodes that can be asked by their number: those that have one for themselves. `wrong`: what
/// is wrong with the others.
MemoryNodes nodes_to_ask(MemoryCalls &calls, std::vector<std::string> &wrong) {
  MemoryNodes nodes = calls.scan();
  wrong = complaints(nodes);
  std::erase_if(nodes, [](const auto &node) { return node.number == 0 || node.doubled; });
  require_answers(calls, !nodes.empty() || !wrong.empty());
  return nodes;
}

/// Behind "-" what is printed goes to stderr.
void write_bytes(const std::string &path, const Bytes &bytes) {
  claim_files({}, {{"--output", path}});
  OutputFile file{path};
  file.stream().write(reinterpret_cast<const char *>(bytes.data()),
                      static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

/// The parameters of a node that decide what its map can write.
RemoteConfig config_of(const verican_remote_identity_t &node) {
  constexpr unsigned kEntries = 8;  // nobody tells whether there are 4
  const auto has = [&](unsigned bit) { return (node.features >> bit & 1) != 0; };
  RemoteConfig config;
  config.name_bits = node.name_bits;
  config.mem_bytes = node.memory;
  config.num_prod = has(1) ? kEntries : 0;
  config.num_map = has(2) ? kEntries : 0;
  return config;
}

}  // namespace

int memory_scan(MemoryCalls &calls, const MemoryOptions &options) {
  const auto nodes = calls.scan();
  require_answers(calls, !nodes.empty());
  const auto wrong = complaints(nodes);
  if (options.json)
    print_json({{"nodes", to_json(nodes)}, {"complaints", wrong}});
  else
    fmt::print("{}", to_text(nodes));
  return tell(wrong, options);
}

int memory_assign(MemoryCalls &calls, const MemoryOptions &options) {
  const auto serial = text::parse_unsigned(options.serial, 16);
  if (!serial || *serial > 0xFFFFFFFF)
    refuse("serial", options.serial, "up to 8 hexadecimal digits");
  if (options.number == 1 || options.number > calls.highest_number())
    refuse("number", std::to_string(options.number),
           fmt::format("0 (none), 2 to {}", calls.highest_number()));
  calls.assign(static_cast<std::uint32_t>(*serial), options.number);
  if (options.json) print_json({{"serial", *serial}, {"number", options.number}});
  return kOk;
}

int memory_read(MemoryCalls &calls, const MemoryOptions &options) {
  const unsigned node = node_of(calls, options);
  check_range(options.address, options.length);
  const Bytes bytes = calls.read(node, options.address, options.length);
  if (options.json)
    print_json({{"number", node}, {"address", options.address}, {"bytes", hex(bytes)}});
  else
    fmt::print("{}\n", hex(bytes));
  return kOk;
}

int memory_write(MemoryCalls &calls, const MemoryOptions &options) {
  const unsigned node = node_of(calls, options, true);
  const Bytes bytes = bytes_of(options.bytes);
  check_range(options.address, bytes.size());
  calls.write(node, options.address, bytes);
  if (options.json)
    print_json({{"number", node},
                {"address", options.address},
                {"bytes", hex(bytes)},
                {"confirmed", node != VERICAN_REMOTE_ALL}});
  return kOk;
}

/// Why a poll had no answer: nobody is there, or those that are refuse it.
[[noreturn]] void nobody_has(MemoryCalls &calls, const MemoryOptions &options) {
  std::string there;
  for (const auto &[number, state] : states(calls, 0))
    there += fmt::format("{}{}", there.empty() ? "" : ", ", number);
  throw MemoryFailure(fmt::format("no node answers at 0x{:03X} with {} bytes; nodes {} are there",
                                  options.address, options.length, there));
}

int memory_poll(MemoryCalls &calls, const MemoryOptions &options) {
  constexpr unsigned kMost = 6;
  check_range(options.address, options.length);
  if (options.length > kMost) refuse("length", std::to_string(options.length), "1 to 6");
  const verican_remote_answers_t answers = calls.poll(options.address, options.length);
  if (answers.answered == 0) nobody_has(calls, options);
  Json list = Json::array();
  for (unsigned node = 0; node < VERICAN_REMOTE_NUMBERS; ++node) {
    if ((answers.answered >> node & 1) == 0) continue;
    const Bytes bytes(answers.data[node], answers.data[node] + options.length);
    if (options.json)
      list.push_back({{"number", node}, {"bytes", hex(bytes)}});
    else
      fmt::print("{:>4}  {}\n", node, hex(bytes));
  }
  const auto wrong = complaints(answers);
  if (options.json)
    print_json({{"address", options.address}, {"answers", list}, {"complaints", wrong}});
  return tell(wrong, options);
}

int memory_trigger(MemoryCalls &calls, const MemoryOptions &options) {
  calls.trigger(options.count);
  if (options.json) print_json({{"count", options.count}});
  return kOk;
}

int memory_state(MemoryCalls &calls, const MemoryOptions &options) {
  const StateCommand &command = state_command(options.command);
  const unsigned node = options.node == "all" ? 0 : node_of(calls, options, true);
  calls.state(node, command.command);
  for (const auto &[number, state] : states(calls, node))
    require_state(calls, number, state, command);
  if (options.json) print_json({{"number", node}, {"command", options.command}});
  return kOk;
}

int memory_status(MemoryCalls &calls, const MemoryOptions &options) {
  std::vector<unsigned> numbers;
  std::vector<std::string> wrong;
  if (options.node == "all")
    for (const auto &node : nodes_to_ask(calls, wrong)) numbers.push_back(node.number);
  else
    numbers.push_back(node_of(calls, options));
  Json list = Json::array();
  if (!options.json) fmt::print("node  state     TEC  REC  accepted  refused  TRIGGER\n");
  for (const unsigned number : numbers) {
    const verican_remote_status_t status = calls.status(number);
    if (options.json)
      list.push_back(to_json(number, status));
    else
      fmt::print("{}", to_text(number, status));
  }
  if (options.json) print_json({{"nodes", list}, {"complaints", wrong}});
  return tell(wrong, options);
}

int memory_map(MemoryCalls &calls, const MemoryOptions &options) {
  std::vector<NodeTables> nodes;
  std::vector<std::string> wrong;
  for (const verican_remote_identity_t &node : nodes_to_ask(calls, wrong)) {
    // Entries that a node does not have are reserved, and an access to them is refused.
    NodeTables tables;
    tables.number = node.number;
    tables.config = config_of(node);
    const auto half = [&](unsigned bit, unsigned at) {
      if ((node.features >> bit & 1) == 0) return;
      const Bytes bytes = calls.read(node.number, at, remote_map::kMaps - remote_map::kProducers);
      Bytes whole(remote_map::kTablesEnd - remote_map::kProducers);
      std::copy(bytes.begin(), bytes.end(),
                whole.begin() + static_cast<std::ptrdiff_t>(at - remote_map::kProducers));
      const NodeTables part = read_tables(node.number, whole);
      tables.producers.insert(tables.producers.end(), part.producers.begin(), part.producers.end());
      tables.maps.insert(tables.maps.end(), part.maps.begin(), part.maps.end());
    };
    half(1, remote_map::kProducers);
    half(2, remote_map::kMaps);
    tables.heard_own = calls.status(node.number).duplicate;
    nodes.push_back(std::move(tables));
  }
  const auto more = complaints(nodes, calls.name_bits());
  wrong.insert(wrong.end(), more.begin(), more.end());
  if (options.json)
    print_json({{"nodes", to_json(nodes)}, {"complaints", wrong}});
  else
    fmt::print("{}", to_text(nodes, calls.name_bits()));
  return tell(wrong, options);
}

int memory_clear(MemoryCalls &calls, const MemoryOptions &options) {
  const unsigned node = node_of(calls, options);
  calls.clear(node);
  if (options.json) print_json({{"number", node}});
  return kOk;
}

int memory_dump(MemoryCalls &calls, const MemoryOptions &options) {
  const unsigned node = node_of(calls, options);
  check_range(options.address, options.table);
  require_room(calls, node, options.address, options.table, "length");
  const Bytes bytes = calls.read(node, options.address, options.table);
  const bool to_file = !options.file.empty();
  if (to_file) write_bytes(options.file, bytes);
  Json dump{{"number", node}, {"address", options.address}, {"length", bytes.size()}};
  dump[to_file ? "file" : "bytes"] = to_file ? options.file : hex(bytes);
  if (options.json)
    print_json(dump);
  else if (!to_file)
    fmt::print("{}", dump_text(options.address, bytes));
  return kOk;
}

int memory_load(MemoryCalls &calls, const MemoryOptions &options) {
  const unsigned node = node_of(calls, options);
  const std::string content = read_bytes(options.file, kMostWritten);
  if (content.empty() || options.address + content.size() > remote_map::kSize)
    throw InputError(options.file, 0,
                     fmt::format("{} bytes; allowed: 1 to {} from 0x{:03X} on", content.size(),
                                 remote_map::kSize - options.address, options.address));
  require_room(calls, node, options.address, content.size(), options.file);
  calls.write(node, options.address, {content.begin(), content.end()});
  if (options.json)
    print_json({{"number", node},
                {"address", options.address},
                {"length", content.size()},
                {"file", options.file}});
  return kOk;
}

}  // namespace vericansim::cli
