// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican memory: the memory of nodes without a processor, over a CAN interface or socketcand.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "cli/cli.hpp"
#include "cli/memory_work.hpp"
#include "cli/number_check.hpp"
#include "cli/print_error.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::cli {
namespace {

using Work = int (*)(MemoryCalls &, const MemoryOptions &);

std::unique_ptr<MemoryLink> open_link(const MemoryOptions &options) {
  if (options.interface.empty() == options.socketcand.empty())
    throw InputError("verican memory", 0, "which bus? allowed: either --if or --socketcand");
  return options.interface.empty() ? open_socketcand(options.socketcand, options.bus)
                                   : open_interface(options.interface);
}

/// A check of CLI11: the name stands between blanks in a message of the protocol.
std::string is_bus_name(const std::string &name) {
  const bool good = name.find_first_of("<> \t\r\n") == std::string::npos;
  return good ? "" : in_quotes(name) + " is not allowed; allowed: a word without < and >";
}

/// A check of CLI11: a number, in the form of all refusals of `verican memory`. Of zeros in front
/// check_numbers() tells.
std::function<std::string(const std::string &)> is_within(unsigned least, unsigned most,
                                                          const std::string &allowed = {}) {
  return [=](const std::string &text) {
    const auto number = parse_integer(text);
    const bool good = number && *number >= least && *number <= most;
    if (good || has_leading_zeros(text)) return std::string{};
    return in_quotes(text) + " is not allowed; allowed: " +
           (allowed.empty() ? fmt::format("{} to {}", least, most) : allowed);
  };
}

/// The same for words.
std::function<std::string(const std::string &)> is_one_of(const std::vector<std::string> &words) {
  return [=](const std::string &text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string{};
    return fmt::format("{} is not allowed; allowed: {}", in_quotes(text), fmt::join(words, ", "));
  };
}

int carry_out(const MemoryOptions &options, const std::function<int(MemoryLink &)> &work) {
  const std::unique_ptr<MemoryLink> link = open_link(options);
  try {
    return work(*link);
  } catch (const MemoryFailure &failure) {
    print_error("verican: memory: {}{}\n", failure.what(), link->remarks());
    return kFailed;
  }
}

/// The subcommands, with what they share.
class Memory {
 public:
  Memory(CLI::App &command, int &exit_code) : command_{command}, exit_code_{exit_code} {
    CLI::Option *interface = command.add_option("--if", o_->interface, "CAN interface");
    CLI::Option *server =
        command
            .add_option("--socketcand", o_->socketcand,
                        "socketcand server at [HOST:]PORT, such as verican bridge")
            ->excludes(interface);
    command.add_option("--bus-name", o_->bus, "Bus of the server (can0)")
        ->needs(server)
        ->check(is_bus_name);
    command.add_option("--name-bits", o_->name_bits, "Bits of a node's number, 3 or 5 (3)")
        ->check(is_one_of({"3", "5"}));
    command.add_option("--timeout", o_->timeout_ms, "For an answer, ms (150)")
        ->check(is_within(1, 60'000));
    command.add_flag("--json", o_->json, "The result as JSON");
    command.require_subcommand(1);
  }

  void add() {
    add_one("scan", "All nodes: number, serial number, parts", memory_scan);
    CLI::App *assign = add_one("assign", "Give a node a number", memory_assign);
    assign->add_option("serial", o_->serial, "Serial number, hexadecimal")->required();
    assign->add_option("number", o_->number, "The number; 0: none")->required();
    CLI::App *read = add_one("read", "Read bytes of a node", memory_read);
    add_node(*read);
    add_address(*read)->required();
    add_length(*read);
    CLI::App *write = add_one("write", "Write bytes, confirmed by the node", memory_write);
    add_node(*write);
    add_address(*write)->required();
    write->add_option("bytes", o_->bytes, "Hexadecimal bytes")->required();
    CLI::App *poll = add_one("poll", "Read the same bytes of all nodes at one moment", memory_poll);
    add_address(*poll)->required();
    add_length(*poll);
    add_one("trigger", "Make staged bytes visible in all nodes", memory_trigger)
        ->add_option("count", o_->count, "Count of the TRIGGER")
        ->required()
        ->check(is_within(0, 255));
    add_more();
  }

 private:
  void add_more() {
    CLI::App *state = add_one("state", "OPERATE, SAFE or RESTART", memory_state);
    state->add_option("command", o_->command, "operate, safe, restart")
        ->required()
        ->check(is_one_of({"operate", "safe", "restart"}));
    add_node(*state, false);
    add_node(*add_one("status", "Status of a node, or of all", memory_status), false);
    add_one("map", "Producers and maps of all nodes, and what is wrong with them", memory_map);
    add_node(*add_one("clear", "Clear counters and flags of a node", memory_clear));
    CLI::App *dump = add_one("dump", "Read much, as a table or as a file", memory_dump);
    add_node(*dump);
    add_address(*dump);
    dump->add_option("length", o_->table, "Bytes (128)")->check(is_within(1, 0x1000));
    dump->add_option("-o,--output", o_->file, "File for the bytes; - is standard output");
    CLI::App *load = add_one("load", "Write the bytes of a file", memory_load);
    add_node(*load);
    add_address(*load)->required();
    load->add_option("file", o_->file, "The file")->required();
    CLI::App *watch = command_.add_subcommand("watch", "What is on the bus, in words");
    watch->add_option("--frames", o_->frames, "End after so many frames")->check(at_least_one);
    watch->fallthrough();
    watch->callback([o = o_, &exit_code = exit_code_] {
      exit_code = carry_out(*o, [&](MemoryLink &link) { return memory_watch(link, *o); });
    });
  }

  CLI::App *add_one(const char *name, const char *what, Work work) {
    CLI::App *one = command_.add_subcommand(name, what);
    one->fallthrough();
    one->callback([o = o_, work, &exit_code = exit_code_] {
      exit_code = carry_out(*o, [&](MemoryLink &link) {
        MemoryCalls calls{link, o->name_bits, o->timeout_ms};
        return work(calls, *o);
      });
    });
    return one;
  }

  void add_node(CLI::App &one, bool required = true) {
    CLI::Option *node = one.add_option("node", o_->node, "Number of the node");
    if (required)
      node->required();
    else
      o_->node = "all";
  }
  CLI::Option *add_address(CLI::App &one) {
    return one.add_option("address", o_->address, "Address, 0 to 0xFFF")
        ->check(is_within(0, 0xFFF, "0 to 0xFFF"));
  }
  CLI::Option *add_length(CLI::App &one) {
    return one.add_option("length", o_->length, "Bytes (1)")->check(is_within(1, 0x1000));
  }

  std::shared_ptr<MemoryOptions> o_ = std::make_shared<MemoryOptions>();
  CLI::App &command_;
  int &exit_code_;
};

}  // namespace

void add_memory(CLI::App &app, int &exit_code) {
  CLI::App *command = app.add_subcommand(
      "memory", "Memory of nodes without a processor: read, write, scan, watch ...");
  Memory{*command, exit_code}.add();
}

}  // namespace vericansim::cli
