// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See coverage_writer.hpp.
#include "coverage_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace vericansim {
namespace {
const CoverageModel *models = nullptr;

[[noreturn]] void give_up(const std::string &path) {
  std::fprintf(stderr, "coverage: cannot write %s: %s\n", path.c_str(), std::strerror(errno));
  std::_Exit(1);
}
}  // namespace

void write_coverage() {
  const char *directory = std::getenv("VERICAN_COVERAGE_DIR");
  if (directory == nullptr) return;
  std::string path = std::string{directory} + "/" + program_invocation_short_name + "-" +
                     std::to_string(getpid()) + ".dat";
  std::FILE *file = std::fopen(path.c_str(), "wx");
  // The number of a process may come back.
  for (int i = 1; file == nullptr && errno == EEXIST; ++i)
    file = std::fopen((path = path + "." + std::to_string(i)).c_str(), "wx");
  if (file == nullptr) give_up(path);
  bool good = std::fprintf(file, "# SystemC::Coverage-3\n") > 0;
  for (const CoverageModel *model = models; model != nullptr; model = model->next_) {
    for (std::size_t i = 0; i < model->size_; ++i) {
      const CoveragePoint &point = model->points_[i];
      good =
          std::fprintf(file, "C '%s' %u\n", point.text, model->counts_[point.counter]) > 0 && good;
    }
  }
  if (std::fclose(file) != 0 || !good) give_up(path);
}

CoverageModel::CoverageModel(const CoveragePoint *points, std::size_t size,
                             const std::uint32_t *counts)
    : points_{points}, size_{size}, counts_{counts}, next_{models} {
  if (models == nullptr) std::atexit(write_coverage);
  models = this;
}

}  // namespace vericansim
