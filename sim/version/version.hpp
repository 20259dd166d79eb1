// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The version of library, tool and package. Its one source is project() in CMakeLists.txt.
#pragma once

#include <string_view>

namespace vericansim {

/// "MAJOR.MINOR.PATCH".
[[nodiscard]] std::string_view version();

}  // namespace vericansim
