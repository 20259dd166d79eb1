// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LogFilter: the part of a recording that somebody wants.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trace/id_filter.hpp"
#include "trace/log.hpp"

namespace vericansim {

/// Interfaces, identifiers, times.
struct LogFilter {
  std::string interface;           ///< its name, "all", or empty: the log has one only
  std::vector<IdFilter> ids = {};  ///< one of them must match; empty: all
  std::optional<Time> from = {};   ///< times since the first classical frame of the recording
  std::optional<Time> to = {};     ///< the last moment that belongs to it
  bool several = false;            ///< without `interface`, several are no error
};

/// Entries of each interface; formats without names have one that is empty.
[[nodiscard]] std::map<std::string, std::size_t> interfaces_of(const CanLog &log);

/// "can0 (12 frames), can1 (3 frames)".
[[nodiscard]] std::string interfaces_text(const std::map<std::string, std::size_t> &interfaces);

/// The part of `log` that passes; times count from its first frame. Throws InputError that begins
/// with `path` if the log has several interfaces and none was chosen, if there is none of that
/// name, or if `from` is behind `to`.
[[nodiscard]] CanLog filtered(CanLog log, const LogFilter &filter, const std::string &path);

/// Moves all times so that the first classical frame, else the first entry, is at 0.
void count_from_first(CanLog &log);

}  // namespace vericansim
