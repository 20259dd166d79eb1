// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The user wants the end: SIGINT, SIGTERM and SIGHUP as a request that long work asks for.
#pragma once

namespace vericansim {

/// While one lives, the first SIGINT, SIGTERM or SIGHUP is a request and the second one ends the
/// process at once with 128 + its number. A SIGHUP that is ignored stays so (nohup). They may be
/// nested; the last one puts back what the signals did before.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals &) = delete;
  StopSignals &operator=(const StopSignals &) = delete;
};

/// True once the user wants the end: long work stops at the next good place, writes its outputs,
/// and says that it was interrupted. Costs one comparison.
[[nodiscard]] bool stop_requested();

/// The signal that asked for the end; 0: none has.
[[nodiscard]] int stop_signal();

/// A byte is written to this descriptor when a request comes, which wakes a poll(); -1: to none.
void wake_on_stop(int descriptor);

}  // namespace vericansim
