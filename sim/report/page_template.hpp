// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of a report without its data, as it was when the library was built (sim/report/page).
#pragma once

#include <string_view>

namespace vericansim {

/// HTML with one line for each of the two elements that hold the data; empty if the library was
/// built without the page (-DVERICAN_REPORT=OFF).
[[nodiscard]] std::string_view page_template();

inline constexpr std::string_view kMetaPlace = "<!--VERICAN-META-->";
inline constexpr std::string_view kDataPlace = "<!--VERICAN-DATA-->";

}  // namespace vericansim
