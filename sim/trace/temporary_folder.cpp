// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// temporary_folder(): see temporary_folder.hpp.
#include "trace/temporary_folder.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "trace/input_error.hpp"

namespace vericansim {

std::string temporary_folder() {
  const char *given = std::getenv("TMPDIR");
  const std::string path = given != nullptr ? given : "/tmp";
  std::error_code error;
  if (!std::filesystem::is_directory(path, error) || ::access(path.c_str(), W_OK | X_OK) != 0)
    throw InputError("TMPDIR", 0,
                     in_quotes(path) +
                         " is not allowed; allowed: a folder for temporary files, "
                         "in which files can be made");
  return path;
}

}  // namespace vericansim
