// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The folder for files that nobody has named.
#pragma once

#include <string>

namespace vericansim {

/// $TMPDIR, else /tmp. Throws InputError "TMPDIR: ..." if that is no folder in which files can be
/// made.
[[nodiscard]] std::string temporary_folder();

}  // namespace vericansim
