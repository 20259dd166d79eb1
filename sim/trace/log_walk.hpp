// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// walk(): all entries of a recording in their order.
#pragma once

#include "trace/log.hpp"

namespace vericansim {

/// Calls classical(LogEntry) or foreign(ForeignEntry) for each entry, in the order of the
/// recording.
template <typename Log, typename Classical, typename Foreign>
void walk(Log &log, Classical classical, Foreign foreign) {
  std::size_t next = 0;
  for (std::size_t i = 0; i <= log.entries.size(); ++i) {
    for (; next < log.others.size() && log.others[next].before <= i; ++next)
      foreign(log.others[next]);
    if (i < log.entries.size()) classical(log.entries[i]);
  }
}

}  // namespace vericansim
