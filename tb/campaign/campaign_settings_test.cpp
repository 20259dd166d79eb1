// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Settings of the campaign's programs: what a number may be, bars, the file of the result.
#include "harness/campaign_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/scratch_test.hpp"
#include "trace/input_file.hpp"

namespace {

using namespace vericansim;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Settings : ScratchTest {
  static void SetUpTestSuite() {
    for (const char *name : {"SEED", "SCALE", "JOBS", "DIR", "OUT"})
      ::unsetenv((std::string{"CAMPAIGN_"} + name).c_str());
  }
  void TearDown() override { SetUpTestSuite(); }
};

TEST(Allowed, TakesWholeTextsInItsRange) {
  EXPECT_EQ(kJobs.read("1"), 1U);
  EXPECT_EQ(kJobs.read("64"), 64U);
  EXPECT_EQ(kSeeds.read("9223372036854775807"), 9223372036854775807U);
  EXPECT_EQ(kScales.read("1"), 1.0);
  EXPECT_EQ(kScales.read("1e-6"), 1e-6);
}

TEST(Allowed, TakesNothingElse) {
  for (const char *text : {"", "0", "65", "-1", "1.5", "2 ", " 2", "0x2", "x", "1e1", "4294967297"})
    EXPECT_EQ(kJobs.read(text), std::nullopt) << text;
  for (const char *text : {"-1", "9223372036854775808", "18446744073709551617", "1.5"})
    EXPECT_EQ(kSeeds.read(text), std::nullopt) << text;
  for (const char *text : {"", "0", "-1", "1.0001", "nan", "inf", "x", "0.5x"})
    EXPECT_EQ(kScales.read(text), std::nullopt) << text;
}

TEST(Allowed, AnOptionIsDecimalWithZerosBefore) {
  std::string text = "010";
  EXPECT_EQ(kJobs.check()(text), "");
  EXPECT_EQ(text, "10");
}

TEST_F(Settings, HaveDefaultsWithoutTheEnvironment) {
  ::setenv("CAMPAIGN_JOBS", "", 1);
  const CampaignSettings settings;
  EXPECT_EQ(settings.seed, 1U);
  EXPECT_EQ(settings.scale, 1.0);
  EXPECT_EQ(settings.jobs, 2U);
  EXPECT_EQ(settings.json, "");
}

TEST_F(Settings, NameVariableValueAndWhatIsAllowed) {
  const auto refused = [](const char *name, const char *value, const std::string &allowed) {
    ::setenv(name, value, 1);
    const std::string message = fmt::format("{} is '{}'; allowed: {}", name, value, allowed);
    EXPECT_THAT([] { return CampaignSettings{}; },
                ThrowsMessage<std::runtime_error>(HasSubstr(message)));
    ::unsetenv(name);
  };
  refused("CAMPAIGN_SEED", "-1", "0 to 9223372036854775807");
  refused("CAMPAIGN_SCALE", "nan", "above 0, at most 1");
  refused("CAMPAIGN_JOBS", "65", "1 to 64");
}

TEST(Bars, HoldUnlessAFigureMissesIts) {
  const auto with = [](const nlohmann::ordered_json &ok) {
    return nlohmann::ordered_json{{"figures", {campaign_figure("a", 1), {{"ok", ok}}}}};
  };
  EXPECT_TRUE(bars_hold(with(true)));
  EXPECT_TRUE(bars_hold(with(nullptr)));
  EXPECT_FALSE(bars_hold(with(false)));
}

TEST_F(Settings, APathIsTriedWithoutATrace) {
  const std::string path = folder / "result";
  check_writable(path);
  EXPECT_EQ(folder.files(), 0U);
  write_result(path, "before");
  check_writable(path);
  EXPECT_EQ(read_text_file(path), "before");
  check_writable("");
  write_result("", "nowhere");
}

TEST_F(Settings, APathThatCannotBeWrittenIsNamed) {
  for (const std::string &path : {folder / "no/result", folder.path()})
    EXPECT_THAT([&] { check_writable(path); },
                ThrowsMessage<std::runtime_error>("cannot write '" + path + "'"));
  EXPECT_THAT([] { write_result("/dev/full", "a"); },
              ThrowsMessage<std::runtime_error>("cannot write '/dev/full'"));
}

}  // namespace
