// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON part of a report: names, settings, summary (docs/report-format.md).
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "report/report_writer.hpp"

namespace vericansim {

/// All of `meta` but `arrays`.
[[nodiscard]] nlohmann::ordered_json report_meta(const ReportRecorder &recorder,
                                                 const ReportExtras &extras);

/// JSON that may stand inside a script element: no "<" in it, and no invalid UTF-8.
[[nodiscard]] std::string script_json(const nlohmann::ordered_json &json);

}  // namespace vericansim
