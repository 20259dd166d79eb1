// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SmallDisk: see small_disk.hpp.
#include "harness/small_disk.hpp"

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace vericansim::test {
namespace {

/// A name space of its own for mounts; who is not root first gets one in which it is.
bool own_mounts() {
  if (::unshare(CLONE_NEWNS) == 0) return true;
  const uid_t user = ::getuid();
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  std::ofstream("/proc/self/uid_map") << "0 " << user << " 1\n";
  return true;
}

}  // namespace

SmallDisk::SmallDisk(const std::string &folder, unsigned kilobytes) : folder_{folder} {
  std::filesystem::create_directories(folder);
  const std::string size = "size=" + std::to_string(kilobytes) + "k";
  if (!own_mounts() || ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("tmpfs", folder.c_str(), "tmpfs", 0, size.c_str()) != 0)
    why_ = std::string{"no file system can be mounted here: "} + std::strerror(errno);
}

SmallDisk::~SmallDisk() {
  if (mounted()) ::umount2(folder_.c_str(), MNT_DETACH);
  ::rmdir(folder_.c_str());
}

std::size_t SmallDisk::files() const {
  const std::filesystem::directory_iterator all{folder_};
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

}  // namespace vericansim::test
