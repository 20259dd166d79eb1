// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: commands of a host to remote nodes, in words.
#include <fmt/format.h>

#include <algorithm>

#include "scenario/scenario_remote_parts.hpp"
#include "trace/candump.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim::detail {
namespace {

constexpr std::string_view kAllowedCommands =
    "operate|safe|restart [NODE], trigger [COUNT], write NODE|all ADDRESS BYTE..., "
    "read NODE ADDRESS LENGTH [= BYTE...], read all ADDRESS LENGTH, status NODE [= BYTE...], "
    "identity NODE [= BYTE...], unlock NODE, lock NODE, clear NODE, frame FRAME";

using Words = std::vector<std::string_view>;

/// Reads one command; each word that is taken is gone.
class StepReader {
 public:
  StepReader(const YamlValue &value, const Scenario &scenario)
      : value_{value},
        scenario_{scenario},
        config_{common_config(value, scenario)},
        text_{value.text()},
        words_{text::split_blanks(text_)} {
    step_.text = text_;
  }

  RemoteStep read() {
    if (words_.empty()) value_.refuse(std::string{kAllowedCommands});
    const std::string verb{take()};
    if (verb == "operate")
      state(0x01);
    else if (verb == "safe")
      state(0x02);
    else if (verb == "restart")
      state(0x81);
    else if (verb == "trigger")
      trigger();
    else if (verb == "write")
      write();
    else if (verb == "read")
      read_memory();
    else if (verb == "status")
      row(RemotePort::kStatus);
    else if (verb == "identity")
      row(RemotePort::kIdent);
    else if (verb == "unlock")
      unlock();
    else if (verb == "lock")
      setup(2);
    else if (verb == "clear")
      setup(4);
    else if (verb == "frame")
      frame();
    else
      value_.refuse(std::string{kAllowedCommands});
    if (!words_.empty()) refuse_word(words_.front(), "the end of the command");
    return step_;
  }

 private:
  [[noreturn]] void refuse_word(std::string_view word, const std::string &allowed) const {
    value_.fail(fmt::format("{}: {} is not allowed; allowed: {}", in_quotes(text_),
                            in_quotes(std::string{word}), allowed));
  }

  std::string_view take() {
    if (words_.empty()) refuse_word("", "one more word: " + std::string{kAllowedCommands});
    const std::string_view word = words_.front();
    words_.erase(words_.begin());
    return word;
  }

  unsigned number(unsigned least, unsigned most, const char *what) {
    const std::string_view word = take();
    const auto value = parse_integer(word);
    if (!value || *value < least || *value > most)
      refuse_word(word, fmt::format("{}, 0x{:X} to 0x{:X}", what, least, most));
    return static_cast<unsigned>(*value);
  }

  // A number, or the name of a remote node that has one; serial_ is that of the node.
  unsigned node(bool or_all = false) {
    serial_.reset();
    const std::string_view word = take();
    if (or_all && word == "all") return 1;
    for (const NodeSpec &one : scenario_.nodes) {
      const auto *role = std::get_if<RemoteRole>(&one.role);
      if (role != nullptr && one.name == word && role->number >= 2) {
        serial_ = role->config.serial;
        return role->number;
      }
    }
    const auto value = parse_integer(word);
    if (!value || *value < 2 || *value > config_.highest_number())
      refuse_word(word, fmt::format("the name of a remote node with a number, 2 to {}{}",
                                    config_.highest_number(), or_all ? ", all" : ""));
    for (const NodeSpec &one : scenario_.nodes)
      if (const auto *role = std::get_if<RemoteRole>(&one.role))
        if (role->number == *value) serial_ = role->config.serial;
    return static_cast<unsigned>(*value);
  }

  void add(unsigned byte) { step_.frame.data[step_.frame.dlc++] = static_cast<std::uint8_t>(byte); }

  [[nodiscard]] unsigned port_id(unsigned name, RemotePort port) const {
    return config_.id(0, name, config_.first_port() + static_cast<unsigned>(port));
  }

  void state(unsigned command) {
    step_.frame.id = config_.id(0, 0, 0);
    add(command);
    if (!words_.empty()) add(node());
  }

  void trigger() {
    step_.frame.id = config_.id(0, 0, 1);
    step_.counts = words_.empty();
    add(words_.empty() ? 0 : number(0, 0xFF, "a count"));
  }

  void write() {
    const unsigned name = node(true);
    const unsigned address = number(0, remote_map::kSize - 1, "an address");
    const bool direct = address < config_.first_port();
    step_.frame.id = direct ? config_.id(0, name, address) : port_id(name, RemotePort::kWrite);
    if (!direct) {
      add(address & 0xFF);
      add(address >> 8);
    }
    if (words_.empty()) refuse_word("", "bytes");
    const unsigned first = step_.frame.dlc;
    while (!words_.empty()) write_word(direct);
    if (direct && address + step_.frame.dlc - first > config_.first_port())
      refuse_word("", fmt::format("bytes up to 0x{:X}", config_.first_port() - 1));
  }

  void write_word(bool direct) {
    const std::string_view word = take();
    const unsigned length = word == "round" ? 2 : 1;
    if (step_.frame.dlc + length > 8)
      refuse_word(word, direct ? "8 bytes at most" : "6 bytes at most beyond the window");
    if (word == "round") {
      step_.rounds.push_back(step_.frame.dlc);
      step_.frame.dlc = static_cast<std::uint8_t>(step_.frame.dlc + 2);
      return;
    }
    add(byte(word, "hexadecimal bytes, round"));
  }

  [[nodiscard]] unsigned byte(std::string_view word, const char *allowed) const {
    const auto value = text::parse_unsigned(word, 16);
    if (!value || word.size() > 2) refuse_word(word, allowed);
    return static_cast<unsigned>(*value);
  }

  void read_memory() {
    const unsigned name = node(true);
    const unsigned address = number(0, remote_map::kSize - 1, "an address");
    const bool direct = address < config_.first_port();
    const unsigned most = direct ? std::min(8U, config_.first_port() - address) : 6;
    const unsigned length = number(1, most, "bytes of one frame");
    Frame answer;
    answer.id = config_.id(1, name, direct ? address : config_.first_port());
    answer.dlc = static_cast<std::uint8_t>(length);
    if (direct) {
      step_.frame = {config_.id(0, name, address), false, true, answer.dlc, {}};
    } else {
      step_.frame.id = port_id(name, RemotePort::kRead);
      for (const unsigned one : {address & 0xFF, address >> 8, length}) add(one);
      std::copy_n(step_.frame.data.begin(), 2, answer.data.begin());
      answer.dlc = static_cast<std::uint8_t>(length + 2);
      step_.head = 2;
    }
    if (name != 1) expect_answer(answer, length);
  }

  void row(RemotePort port) {
    const unsigned name = node();
    step_.frame = {port_id(name, port), false, true, 8, {}};
    Frame answer;
    answer.id = config_.id(name, port);
    answer.dlc = 8;
    expect_answer(answer, 8);
  }

  void expect_answer(const Frame &answer, unsigned length) {
    step_.answer = answer;
    if (words_.empty()) return;
    if (const std::string_view equal = take(); equal != "=") refuse_word(equal, "=");
    std::vector<std::uint8_t> bytes;
    std::string_view last = "=";
    while (!words_.empty()) {
      last = take();
      bytes.push_back(static_cast<std::uint8_t>(byte(last, "hexadecimal bytes")));
    }
    if (bytes.size() != length) refuse_word(last, fmt::format("{} bytes behind =", length));
    step_.wanted = bytes;
  }

  void unlock() {
    const std::string word{words_.empty() ? "" : words_.front()};
    const unsigned name = node();
    if (!serial_) refuse_word(word, "a node of this scenario: unlock needs its serial number");
    step_.frame.id = port_id(name, RemotePort::kSetup);
    add(1);
    for (unsigned i = 0; i < 4; ++i) add(*serial_ >> (8 * i) & 0xFF);
  }

  void setup(unsigned operation) {
    step_.frame.id = port_id(node(), RemotePort::kSetup);
    add(operation);
  }

  void frame() {
    const std::string word{take()};
    bool classical = false;
    try {
      classical = parse_candump_frame(word, step_.frame, {value_.file(), value_.line()});
    } catch (const InputError &) {
      // The place in the scenario says more than what is wrong within the word.
    }
    if (!classical)
      refuse_word(word,
                  "a classical frame as cansend has it, 1A0#5A, 1A0#R5: identifiers of 3 digits up "
                  "to 7FF, or of 8 up to 1FFFFFFF");
  }

  const YamlValue &value_;
  const Scenario &scenario_;
  RemoteConfig config_;
  std::string text_;
  Words words_;
  RemoteStep step_;
  std::optional<std::uint32_t> serial_;  // of the node last named, if the scenario has it
};

}  // namespace

RemoteConfig common_config(const YamlValue &value, const Scenario &scenario) {
  std::optional<RemoteConfig> config;
  for (const NodeSpec &node : scenario.nodes) {
    const auto *role = std::get_if<RemoteRole>(&node.role);
    if (role == nullptr) continue;
    if (config && config->name_bits != role->config.name_bits)
      value.fail("remote nodes of different 'name_bits'; allowed: the same for all");
    config = role->config;
  }
  if (!config) value.fail("no remote node is there; allowed: with nodes of 'type: remote'");
  return *config;
}

RemoteCommandSpec parse_commands(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  RemoteCommandSpec spec;
  const YamlValue node = map.need("node");
  spec.node = parse_node_name(node, scenario);
  const NodeSpec &host = scenario.nodes[spec.node];
  if (!host.hosted() || host.host.listen_only)
    node.fail(in_quotes(host.name) + " sends nothing that a scenario says; allowed: plain nodes");
  if (host.host.tx_buffers > 1)
    node.fail(in_quotes(host.name) +
              " has several 'tx_buffers', and commands must leave in their "
              "order; allowed: 1");
  map.with("at", [&](const YamlValue &v) { spec.at = v.time(0, kLongestTime); });
  map.with("period", [&](const YamlValue &v) { spec.period = v.time(kMicrosecond, kLongestTime); });
  map.with("count", [&](const YamlValue &v) { spec.count = parse_count(v, spec.period != 0); });
  const YamlValue steps = map.need("do");
  for (const YamlValue &item : steps.items())
    spec.steps.push_back(StepReader{item, scenario}.read());
  if (spec.steps.empty()) steps.refuse(std::string{kAllowedCommands});
  map.finish();
  return spec;
}

}  // namespace vericansim::detail
