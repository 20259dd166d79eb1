// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncPage: what came out of a case as one self-contained HTML file (TM-125).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "trace/output_file.hpp"

namespace vericansim {

/// The page without its data, as it was when the library was built (sim/report/page/src/timesync);
/// empty with -DVERICAN_REPORT=OFF.
[[nodiscard]] std::string_view sync_page_template();

/// Opens the file at once, so that a path that cannot be written is refused before anything runs.
class SyncPage {
 public:
  /// Throws OutputError if `path` cannot be written, InputError if there is no page in this build.
  explicit SyncPage(std::string path);
  /// Writes the page. `result` is what `verican timesync --json` prints of a single case, `what`
  /// the case in words. Throws OutputError.
  void write(const nlohmann::ordered_json &result, const std::string &what);

 private:
  OutputFile file_;
};

}  // namespace vericansim
