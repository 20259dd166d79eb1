// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_main: the command line of the programs that write pins down.
#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace vericansim {

/// What may be recorded, and how.
struct RecordTask {
  std::string name;
  /// `size` is one of the sizes that record_main() was given.
  std::function<void(unsigned size, std::FILE *file)> run;
};

/// main() of `program --list` and `program RECORDING SIZE FILE`; what is wrong is told on stderr.
int record_main(int argc, char **argv, const std::vector<unsigned> &sizes,
                const std::vector<RecordTask> &tasks);

}  // namespace vericansim
