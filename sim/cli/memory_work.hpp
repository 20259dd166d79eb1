// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the subcommands of `verican memory` do; memory.cpp has their options.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/memory_calls.hpp"

namespace vericansim::cli {

/// Options of all subcommands, each with those it has.
struct MemoryOptions {
  std::string interface, socketcand, bus = "can0";
  unsigned name_bits = 3;
  unsigned timeout_ms = 150;
  bool json = false;

  std::string node;  ///< a number, or "all"
  unsigned address = 0, length = 1;
  unsigned table = 128;            ///< bytes of a dump
  std::vector<std::string> bytes;  ///< hexadecimal
  unsigned count = 0;
  std::string serial;
  unsigned number = 0;
  std::string command;
  std::string file;
  std::uint64_t frames = 0;  ///< watch: so many, 0: no limit
};

/// Each prints its result. Throws InputError for an argument that cannot be, MemoryFailure if the
/// bus does not do it.
int memory_scan(MemoryCalls &calls, const MemoryOptions &options);
int memory_assign(MemoryCalls &calls, const MemoryOptions &options);
int memory_read(MemoryCalls &calls, const MemoryOptions &options);
int memory_write(MemoryCalls &calls, const MemoryOptions &options);
int memory_poll(MemoryCalls &calls, const MemoryOptions &options);
int memory_trigger(MemoryCalls &calls, const MemoryOptions &options);
int memory_state(MemoryCalls &calls, const MemoryOptions &options);
int memory_status(MemoryCalls &calls, const MemoryOptions &options);
int memory_map(MemoryCalls &calls, const MemoryOptions &options);
int memory_clear(MemoryCalls &calls, const MemoryOptions &options);
int memory_dump(MemoryCalls &calls, const MemoryOptions &options);
int memory_load(MemoryCalls &calls, const MemoryOptions &options);
/// Prints what is on the bus until SIGINT, SIGTERM or the number of frames.
int memory_watch(MemoryLink &link, const MemoryOptions &options);

}  // namespace vericansim::cli
