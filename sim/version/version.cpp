// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
#include "version/version.hpp"

namespace vericansim {

std::string_view version() { return VERICAN_VERSION; }

}  // namespace vericansim
