// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncSetting: what can be said of a case, by an option of `verican timesync` or a key of its file.
#pragma once

#include <map>
#include <span>
#include <string>

#include "timesync/sync_case.hpp"

namespace vericansim {

/// One setting. An option is "--own-pin", a key "own_pin".
struct SyncSetting {
  const char *name;     ///< "own-pin"
  const char *help;     ///< one line, with the default
  const char *allowed;  ///< "1 to 32"
  bool is_flag;         ///< an option without a value
  /// Takes a value as people write it; false: not allowed, and nothing has changed.
  bool (*set)(SyncCase &setting, const std::string &value);

  [[nodiscard]] std::string key() const;
};

/// All settings, in the order of the help.
[[nodiscard]] std::span<const SyncSetting> sync_settings();

/// What is said of a case: values as people write them, by the names of their settings.
using SyncValues = std::map<std::string, std::string>;

/// A case file (docs/timesync.md): keys of settings, and `name`. What it does not say stays.
/// Returns the name; `values` gets what it says. Throws InputError.
std::string read_case(const std::string &path, SyncCase &setting, SyncValues &values);

}  // namespace vericansim
