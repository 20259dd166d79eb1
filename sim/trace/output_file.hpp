// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputFile: a file that is there whole or not at all, or the standard output.
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "trace/output_error.hpp"

namespace vericansim {

/// True if `path` means the standard output: "-" or one of its names below /dev.
[[nodiscard]] bool is_standard_output(const std::string &path);

/// The open file that "-" means from now on; 1 if this is never called.
void set_standard_output(int descriptor);

/// What `path` leads to behind symbolic links, which need not exist; a link if they lead in a
/// circle.
[[nodiscard]] std::string behind_links(const std::string &path);

/// An output that somebody has named. A file is written under another name in the same folder and
/// takes its place with commit(); without commit() nothing of it is left, and an older file of that
/// name stays as it was. The standard output ("-"), devices, pipes and sockets are written to
/// directly. What goes to a name that ends in ".gz" is compressed.
class OutputFile {
 public:
  /// Opens at once, so that a path that cannot be written is refused before work begins. Throws
  /// OutputError.
  explicit OutputFile(std::string path);
  /// Drops what was not committed.
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;

  /// Takes the bytes; throws OutputError as soon as some cannot be written. Whole lines to what is
  /// written directly go out at once.
  [[nodiscard]] std::ostream &stream();
  /// Writes what is left, checks that all was written, and puts the file in its place; nothing may
  /// follow. Throws OutputError.
  void commit();
  /// The same with the finished file `scratch`, which is gone then, as the whole content.
  void commit(const std::string &scratch);

  /// True for what is written to directly: somebody may be reading it now.
  [[nodiscard]] bool direct() const;
  /// As it was given.
  [[nodiscard]] const std::string &path() const;
  /// Makes an empty file beside the file, in its folder, for what a library writes by name; in the
  /// folder for temporary files if the file is written directly. Nobody else has its name, which is
  /// returned; the caller removes it. Throws InputError if it cannot be made.
  [[nodiscard]] std::string make_scratch() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vericansim
