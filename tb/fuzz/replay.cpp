// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// fuzz_replay TARGET PATH...: gives files, or all files of directories, to a target, without
// libFuzzer: the kept corpus as a test, or one finding in the debugger.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/target.hpp"

namespace {

using namespace vericansim::fuzz;

struct Entry {
  std::string_view name;
  void (*run)(Bytes);
};

constexpr Entry kTargets[] = {
    {"candump", fuzz_candump}, {"gvret", fuzz_gvret},   {"trc", fuzz_trc},
    {"pcap", fuzz_pcap},       {"pcapng", fuzz_pcapng}, {"log", fuzz_log},
    {"vcd", fuzz_vcd},         {"wave", fuzz_wave},     {"scenario", fuzz_scenario},
    {"options", fuzz_options}, {"elf", fuzz_elf},       {"splitter", fuzz_splitter},
    {"words", fuzz_words},     {"client", fuzz_client}, {"can_frame", fuzz_can_frame},
    {"board", fuzz_board},     {"guest", fuzz_guest},   {"screen", fuzz_screen},
    {"capture", fuzz_capture}, {"gzip", fuzz_gzip}};

std::vector<std::filesystem::path> files_of(const std::filesystem::path &path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A small file must not need much: what a sanitizer reserves for itself comes on top.
void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__)
  constexpr rlim_t kMost = rlim_t{512} << 20U;
  const rlimit limit{kMost, kMost};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
}

bool run(const Entry &target, const std::filesystem::path &path) {
  std::ifstream file{path, std::ios::binary};
  if (!file) {
    std::fprintf(stderr, "fuzz_replay: %s cannot be read\n", path.c_str());
    return false;
  }
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  try {
    target.run(bytes);
    return true;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "fuzz_replay: %s: exception: %s\n", path.c_str(), error.what());
    return false;
  }
}

}  // namespace

int main(int argc, char **argv) {
  const auto *const target =
      argc < 3 ? std::end(kTargets)
               : std::find_if(std::begin(kTargets), std::end(kTargets),
                              [&](const Entry &entry) { return entry.name == argv[1]; });
  if (target == std::end(kTargets)) {
    std::fprintf(stderr, "usage: fuzz_replay TARGET PATH...; targets:");
    for (const Entry &entry : kTargets) std::fprintf(stderr, " %s", entry.name.data());
    std::fprintf(stderr, "\n");
    return 2;
  }
  limit_memory();
  std::size_t count = 0, failed = 0;
  for (int i = 2; i < argc; ++i) {
    for (const auto &path : files_of(argv[i])) {
      std::fprintf(stderr, "%s\n", path.c_str());  // the last one, if the program dies
      ++count;
      failed += run(*target, path) ? 0 : 1;
    }
  }
  std::printf("fuzz_replay: %s: %zu inputs, %zu findings\n", argv[1], count, failed);
  return failed == 0 && count != 0 ? 0 : 1;
}
