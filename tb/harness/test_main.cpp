// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every GoogleTest program's main: temporary files lie in a folder of the process and go with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "harness/scratch_folder.hpp"

int main(int argc, char **argv) {
  try {
    const vericansim::ScratchFolder folder;
    // Where GoogleTest's TempDir(), the standard library and the programs that a test starts look.
    ::setenv("TMPDIR", (folder / "").c_str(), 1);
    ::unsetenv("TEST_TMPDIR");
    ::testing::InitGoogleMock(&argc, argv);
    return RUN_ALL_TESTS();
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
