// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The register accesses of Linux' unmodified flexcan driver, as recorded in several scenarios, on
// the RTL: the core answers as the driver found it, and the frames reach the other node.
#include <gtest/gtest.h>

#include <fstream>

#include "system/linux_access_log.hpp"

namespace vericansim {
namespace {

struct LinuxLog {
  const char *name;
  const char *file;
  unsigned num_mb;
  std::size_t accesses;
  unsigned sent;
  unsigned received;
};

/// GoogleTest shows it where a test is listed or skipped.
void PrintTo(const LinuxLog &log, std::ostream *out) { *out << log.name; }

class LinuxAccessLog : public ::testing::TestWithParam<LinuxLog> {};

// FX-4.q FX-4.r
TEST_P(LinuxAccessLog, TheCoreAnswersAsTheDriverFoundIt) {
  const LinuxLog &param = GetParam();
  const std::string path = std::string("../shared/data/linux-flexcan/") + param.file;
  if (!std::ifstream(path).good()) GTEST_SKIP() << path << " is not here";
  const std::vector<LoggedAccess> log = read_access_log(path);
  ASSERT_EQ(log.size(), param.accesses);
  AccessLogReplay replay{log, param.num_mb};
  replay.run();
  EXPECT_EQ(replay.sent, param.sent);
  EXPECT_EQ(replay.received, param.received);
}

// mcf5441x is the personality that makes do with 16 buffers.
INSTANTIATE_TEST_SUITE_P(
    All, LinuxAccessLog,
    ::testing::Values(
        LinuxLog{"ls1021ar2", "probe-up-tx-rx-down.ls1021ar2.txt", 64, 252, 2, 2},
        LinuxLog{"imx28", "probe-up-tx-rx-down.imx28.txt", 64, 239, 2, 2},
        LinuxLog{"imx25", "probe-up-tx-rx-down.imx25.txt", 64, 239, 2, 2},
        LinuxLog{"mcf5441x_16", "probe-up-tx-rx-down.mcf5441x.txt", 16, 167, 2, 2},
        LinuxLog{"mcf5441x_64", "probe-up-tx-rx-down.mcf5441x.txt", 64, 167, 2, 2},
        LinuxLog{"ls1021ar2_errors", "warning-passive-busoff-restart.ls1021ar2.txt", 64, 414, 1, 1},
        LinuxLog{"imx28_errors", "warning-passive-busoff-restart.imx28.txt", 64, 391, 1, 1},
        LinuxLog{"imx28_loopback", "loopback-mailboxmode-listenonly.imx28.txt", 64, 405, 0, 0}),
    [](const auto &test) { return std::string(test.param.name); });

}  // namespace
}  // namespace vericansim
