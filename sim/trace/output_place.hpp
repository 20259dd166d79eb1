// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputPlace: where an output named by the user goes, and under which name it is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trace/file_aside.hpp"

namespace vericansim {

/// Opens the descriptor of an output.
class OutputPlace {
 public:
  /// Throws OutputError if `path` cannot be written.
  explicit OutputPlace(const std::string &path);
  /// Removes what was written aside and not put in its place.
  ~OutputPlace();
  OutputPlace(const OutputPlace &) = delete;
  OutputPlace &operator=(const OutputPlace &) = delete;

  /// The open file; who takes it closes it.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// True for standard output, devices, pipes: there is nothing to rename.
  [[nodiscard]] bool direct() const { return aside_.empty(); }
  /// Takes the file `scratch` instead of what was written; only if not direct().
  void replace(const std::string &scratch);
  /// Gives the file, closed by now, its name. Throws OutputError.
  void rename();
  /// An empty file for OutputFile::make_scratch().
  [[nodiscard]] std::string make_scratch();

 private:
  void open_directly();
  void open_aside();
  [[nodiscard]] FileAside file_in(const std::filesystem::path &folder) const;

  std::string path_;    // as given
  std::string target_;  // behind symbolic links
  std::string aside_;   // empty: written directly
  int descriptor_ = -1;
  std::vector<int> held_;  // locks of what is written aside, until it is in its place
};

}  // namespace vericansim
