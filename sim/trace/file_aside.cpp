// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See file_aside.hpp.
#include "trace/file_aside.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <random>
#include <string_view>
#include <system_error>

#include "trace/unfinished_files.hpp"

namespace vericansim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".part";

/// What the files aside of one output have in common. A name may be as long as a folder allows, so
/// it is not part of theirs.
std::string beginning(const std::string &leaf) {
  const auto *bytes = reinterpret_cast<const Bytef *>(leaf.data());
  return fmt::format(".verican-{:08x}-", ::crc32_z(0, bytes, leaf.size()));
}

/// Removes the file if its writer has ended: no lock of it is left.
void remove_if_left(const fs::path &path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  struct stat status {};
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
      ::flock(file, LOCK_EX | LOCK_NB) == 0)
    ::unlink(path.c_str());
  ::close(file);
}

void remove_left(const fs::path &folder, const std::string &begin) {
  std::error_code error;
  fs::directory_iterator entry{folder.empty() ? fs::path{"."} : folder, error};
  for (; !error && entry != fs::directory_iterator{}; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(begin) && name.ends_with(kEnding)) remove_if_left(entry->path());
  }
}

/// False if somebody who looks for files that are left took the new one for one of them. Where
/// there are no locks, nobody takes any.
bool keep(int file) {
  struct stat status {};
  return (::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
         ::fstat(file, &status) == 0 && status.st_nlink != 0;
}

}  // namespace

// The name is random: the number of a process is another process's too, in a container or on
// another computer that writes to the same folder.
FileAside make_file_aside(const fs::path &folder, const std::string &leaf) {
  constexpr mode_t kMode = 0666;
  constexpr int kTries = 100;
  const std::string begin = beginning(leaf);
  remove_left(folder, begin);
  std::random_device random;
  FileAside file;
  for (int i = 0; i < kTries; ++i) {
    const std::string name = fmt::format("{}{:08x}{:08x}{}", begin, random(), random(), kEnding);
    file.name = (folder / name).string();
    // Before it is there: a signal may come right behind open(). Such a name is nobody else's.
    note_unfinished(file.name);
    file.descriptor = ::open(file.name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
    if (file.descriptor >= 0 && keep(file.descriptor)) return file;
    const int error = file.descriptor >= 0 ? EEXIST : errno;
    forget_unfinished(file.name);
    if (file.descriptor >= 0) ::close(file.descriptor);
    file.descriptor = -1;
    errno = error;  // of a name that cannot be made; the caller tells it
    if (error != EEXIST) break;
  }
  return file;
}

}  // namespace vericansim
