// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See unfinished_files.hpp. A handler may take no lock and allocate nothing, so names stand in a
// table of a fixed length.
#include "trace/unfinished_files.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>

namespace vericansim {
namespace {

constexpr std::size_t kMost = 256;  // more would stay; a run writes seven files

using Name = std::atomic<char *>;
static_assert(Name::is_always_lock_free);
std::array<Name, kMost> names;

}  // namespace

void note_unfinished(const std::string &path) {
  char *const copy = ::strdup(path.c_str());
  for (Name &name : names) {
    char *none = nullptr;
    if (copy != nullptr && name.compare_exchange_strong(none, copy)) return;
  }
  std::free(copy);
}

void forget_unfinished(const std::string &path) {
  for (Name &name : names) {
    char *known = name.load();
    if (known == nullptr || path != known || !name.compare_exchange_strong(known, nullptr))
      continue;
    std::free(known);
    return;
  }
}

void remove_unfinished() {
  for (const Name &name : names)
    if (const char *path = name.load(); path != nullptr) ::unlink(path);
}

}  // namespace vericansim
