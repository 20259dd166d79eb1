// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncPage: see sync_page.hpp.
#include "timesync/sync_page.hpp"

#include <string>
#include <utility>

#include "report/page_template.hpp"
#include "report/report_meta.hpp"
#include "trace/input_error.hpp"
#include "version/version.hpp"

namespace vericansim {

SyncPage::SyncPage(std::string path) : file_{std::move(path)} {
  if (sync_page_template().empty())
    throw InputError(file_.path(), 0,
                     "this build has no page (it was configured with -DVERICAN_REPORT=OFF)");
}

void SyncPage::write(const nlohmann::ordered_json &result, const std::string &what) {
  const std::string_view page = sync_page_template();
  const std::size_t place = page.find(kMetaPlace);
  nlohmann::ordered_json data = {
      {"format", 1}, {"tool", "verican " + std::string{version()}}, {"what", what}};
  data.update(result);
  file_.stream() << page.substr(0, place)
                 << "<script type=\"application/json\" id=\"verican-meta\">" << script_json(data)
                 << "</script>" << page.substr(place + kMetaPlace.size());
  file_.commit();
}

}  // namespace vericansim
