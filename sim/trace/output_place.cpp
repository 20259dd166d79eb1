// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputPlace: see output_place.hpp.
#include "trace/output_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "trace/file_aside.hpp"
#include "trace/output_file.hpp"
#include "trace/temporary_folder.hpp"
#include "trace/unfinished_files.hpp"

namespace vericansim {
namespace {

namespace fs = std::filesystem;

constexpr const char *kCannotOpen = "cannot be opened for writing";
constexpr const char *kCannotPlace = "cannot be put in its place";

int standard_output = STDOUT_FILENO;

std::optional<struct stat> status_of(const std::string &path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

}  // namespace

bool is_standard_output(const std::string &path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

void set_standard_output(int descriptor) { standard_output = descriptor; }

// A link is written through, not replaced.
std::string behind_links(const std::string &path) {
  constexpr int kMostLinks = 40;  // as the kernel's
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, error); ++i) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

OutputPlace::OutputPlace(const std::string &path) : path_{path}, target_{behind_links(path)} {
  const auto status = status_of(path);
  const bool own = path.starts_with("/proc/") || path.starts_with("/dev/fd/");  // open already
  if (is_standard_output(path) || own ||
      (status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode)))
    open_directly();
  else
    open_aside();
}

OutputPlace::~OutputPlace() {
  if (!aside_.empty()) {
    ::unlink(aside_.c_str());
    forget_unfinished(aside_);
  }
  for (const int descriptor : held_) ::close(descriptor);
}

FileAside OutputPlace::file_in(const fs::path &folder) const {
  FileAside file = make_file_aside(folder, fs::path{target_}.filename().string());
  if (file.descriptor < 0) throw OutputError(path_, kCannotOpen, errno);
  return file;
}

void OutputPlace::open_directly() {
  descriptor_ = is_standard_output(path_) ? ::fcntl(standard_output, F_DUPFD_CLOEXEC, 0)
                                          : ::open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor_ < 0) throw OutputError(path_, kCannotOpen, errno);
}

void OutputPlace::open_aside() {
  std::error_code error;
  if (fs::is_symlink(target_, error)) throw OutputError(path_, kCannotOpen, ELOOP);
  const auto before = status_of(target_);
  if (before && S_ISDIR(before->st_mode)) throw OutputError(path_, kCannotOpen, EISDIR);
  // A file that its owner has made read-only is not replaced.
  if (before && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0)
    throw OutputError(path_, kCannotOpen, errno);
  if (target_.empty() || target_.back() == '/') throw OutputError(path_, kCannotOpen, EISDIR);
  FileAside file = file_in(fs::path{target_}.parent_path());
  descriptor_ = file.descriptor;
  aside_ = std::move(file.name);
  if (const int lock = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0); lock >= 0) held_.push_back(lock);
  if (before) ::fchmod(descriptor_, before->st_mode & 07777);
}

void OutputPlace::replace(const std::string &scratch) {
  if (::rename(scratch.c_str(), aside_.c_str()) != 0) throw OutputError(path_, kCannotPlace, errno);
}

void OutputPlace::rename() {
  if (direct()) return;
  if (::rename(aside_.c_str(), target_.c_str()) != 0) throw OutputError(path_, kCannotPlace, errno);
  forget_unfinished(aside_);
  aside_.clear();
}

std::string OutputPlace::make_scratch() {
  const FileAside file =
      file_in(direct() ? fs::path{temporary_folder()} : fs::path{target_}.parent_path());
  held_.push_back(file.descriptor);
  return file.name;
}

}  // namespace vericansim
