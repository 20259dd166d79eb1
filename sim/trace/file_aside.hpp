// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// make_file_aside(): a new file beside an output, under a name that nobody else has, which a writer
// that is killed does not leave for good.
#pragma once

#include <filesystem>
#include <string>

namespace vericansim {

struct FileAside {
  std::string name;
  int descriptor = -1;  ///< open and locked; -1: errno tells why there is none
};

/// Makes one in `folder` for the output whose name is `leaf`; it is noted as unfinished. Other ones
/// for that name, whose writers have ended, are removed: a writer holds a lock (flock) of its file
/// as long as a duplicate of the descriptor is open.
[[nodiscard]] FileAside make_file_aside(const std::filesystem::path &folder,
                                        const std::string &leaf);

}  // namespace vericansim
