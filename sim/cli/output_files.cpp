// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See output_files.hpp.
#include "cli/output_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>
#include <variant>

#include "cli/cli.hpp"
#include "trace/input_error.hpp"
#include "trace/input_file.hpp"
#include "trace/output_file.hpp"

namespace vericansim::cli {
namespace {

/// The same for all names of a file; empty for what is no file: several may write to it.
std::string identity(const std::string &path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0)
    return S_ISREG(status.st_mode) ? fmt::format("{}:{}", status.st_dev, status.st_ino) : "";
  std::error_code error;
  const auto canonical = std::filesystem::weakly_canonical(
      std::filesystem::absolute(behind_links(path), error), error);
  return error ? path : canonical.string();
}

/// What the commands print goes to `descriptor` from now on, which is closed.
void print_to(int descriptor) {
  static const int kept = [] {
    const int copy = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    set_standard_output(copy);
    return copy;
  }();
  if (kept < 0 || descriptor < 0) throw OutputError("-", "cannot be redirected", errno);
  std::fflush(stdout);
  ::dup2(descriptor, STDOUT_FILENO);
  ::close(descriptor);
}

bool quiet = false;

/// `path` of `option` does not end as files of the option `other` do.
void check_kind(const std::string &path, const char *option, const char *other,
                std::string_view ending) {
  if (without_gz(path).ends_with(ending))
    throw InputError(path, 0,
                     fmt::format("is named as the waveforms of {}; allowed for {}: other endings",
                                 other, option));
}

}  // namespace

std::vector<NamedFile> files_of(const Outputs &outputs, const std::vector<double> &bitrates) {
  std::vector<NamedFile> wanted;
  if (bitrates.size() > 1) {
    for (const double bitrate : bitrates)
      for (NamedFile &file : files_of(outputs_for(outputs, bitrate)))
        wanted.push_back(std::move(file));
    return wanted;
  }
  check_kind(outputs.vcd, "--vcd", "--fst", ".fst");
  check_kind(outputs.fst, "--fst", "--vcd", ".vcd");
  const NamedFile all[] = {{"--vcd", outputs.vcd},         {"--fst", outputs.fst},
                           {"--candump", outputs.candump}, {"--pcap", outputs.pcap},
                           {"--report", outputs.report},   {"--signals-csv", outputs.signals_csv},
                           {"--ids-csv", outputs.ids_csv}};
  for (const NamedFile &file : all)
    if (!file.path.empty()) wanted.push_back(file);
  return wanted;
}

void add_file(std::vector<NamedFile> &files, const std::string &role, const std::string &path) {
  if (!path.empty()) files.push_back({role, path});
}

void add_databases(std::vector<NamedFile> &files, const std::shared_ptr<const Database> &database) {
  if (!database) return;
  for (const DatabaseFile &file : database->files()) files.push_back({"the database", file.path});
}

std::vector<NamedFile> inputs_of(const Scenario &scenario) {
  std::vector<NamedFile> inputs{{"the scenario", scenario.file}};
  add_databases(inputs, scenario.outputs.database);
  for (const NodeSpec &node : scenario.nodes) {
    if (const auto *firmware = std::get_if<FirmwareRole>(&node.role))
      inputs.push_back({"the firmware of node '" + node.name + "'", firmware->file});
    if (const auto *replay = std::get_if<ReplayRole>(&node.role))
      inputs.push_back({"the recording of node '" + node.name + "'", replay->file});
  }
  return inputs;
}

void claim_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs) {
  std::map<std::string, std::string> roles;  // by identity
  for (const NamedFile &input : inputs)
    if (const std::string id = identity(input.path);
        !id.empty() && ::access(input.path.c_str(), F_OK) == 0)
      roles.emplace(id, input.role);
  bool standard = false;
  for (const NamedFile &output : outputs) {
    const bool own = is_standard_output(output.path);
    standard = standard || own;
    const std::string id = own ? "-" : identity(output.path);
    if (id.empty()) continue;
    const auto [known, fresh] = roles.emplace(id, output.role);
    if (!fresh)
      throw InputError(own ? "standard output" : output.path, 0,
                       fmt::format("is the file of {} and of {}; allowed: a file of its own",
                                   known->second, output.role));
  }
  if (standard && !quiet) print_to(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0));
}

void be_quiet() {
  quiet = true;
  print_to(::open("/dev/null", O_WRONLY | O_CLOEXEC));
}

bool is_quiet() { return quiet; }

int try_flush_standard_output() {
  static int first = 0;
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (failed && first == 0) first = errno != 0 ? errno : EIO;
  return first;
}

void flush_standard_output() {
  if (const int error = try_flush_standard_output(); error != 0)
    throw OutputError("-", "cannot be written to its end", error);
}

}  // namespace vericansim::cli
