// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a command reads and writes, before it begins; and its standard output.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace vericansim::cli {

/// A file that a command reads or writes.
struct NamedFile {
  std::string role;  ///< as a message names it: "--vcd", "the scenario"
  std::string path;
};

/// All files of an Outputs that are wanted, by their options; with several bit rates those of each
/// (outputs_for()).
[[nodiscard]] std::vector<NamedFile> files_of(const Outputs &outputs,
                                              const std::vector<double> &bitrates = {});

/// Adds `path` to `files`, unless it is empty.
void add_file(std::vector<NamedFile> &files, const std::string &role, const std::string &path);

/// Adds the files of `database`, if there is one.
void add_databases(std::vector<NamedFile> &files, const std::shared_ptr<const Database> &database);

/// The scenario's file and those that it names.
[[nodiscard]] std::vector<NamedFile> inputs_of(const Scenario &scenario);

/// Call it before anything is opened. Throws InputError if two outputs are the same file, or an
/// output is one of the inputs, however they are spelled or linked; devices and pipes do not count.
/// If an output is the standard output ("-"), everything else that the command prints goes to
/// stderr from now on.
void claim_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs);

/// From now on what the command prints goes nowhere; outputs named "-" are not affected.
void be_quiet();
/// True after be_quiet(): what is said on stderr is what has failed, or where the bus is.
[[nodiscard]] bool is_quiet();

/// Sees to it that all that was printed has been written; the errno of the first failure so far, 0
/// if there is none.
[[nodiscard]] int try_flush_standard_output();
/// The same; throws OutputError.
void flush_standard_output();

}  // namespace vericansim::cli
