// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CampaignJournal: an interrupted campaign goes on where it was, and only the same one.
#include "random/campaign_journal.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace vericansim {
namespace {

class Journal : public ::testing::Test {
 protected:
  Journal() { std::filesystem::remove(path_); }
  ~Journal() override { std::filesystem::remove(path_); }

  static JudgedRun run_of(std::uint64_t frames) {
    JudgedRun run;
    run.frames = frames;
    run.cut_short = frames % 2 != 0;
    run.counts.wire.decoded = frames + 1;
    return run;
  }

  void write_two() {
    CampaignJournal journal{path_, "key", false};
    journal.add(7, run_of(70), 1.5);
    journal.add(9, run_of(91), 2.5);
  }

  const std::string path_ = (std::filesystem::temp_directory_path() /
                             (std::string{"verican-journal-"} +
                              ::testing::UnitTest::GetInstance()->current_test_info()->name()))
                                .string();
};

TEST_F(Journal, GoesOnWhereItWas) {
  write_two();
  for (int again = 0; again < 2; ++again) {
    const CampaignJournal journal{path_, "key", true};
    ASSERT_EQ(journal.before().size(), 2u);
    EXPECT_EQ(journal.before().at(7).frames, 70u);
    EXPECT_FALSE(journal.before().at(7).cut_short);
    EXPECT_EQ(journal.before().at(9).counts.wire.decoded, 92u);
    EXPECT_TRUE(journal.before().at(9).cut_short);
    EXPECT_EQ(journal.seconds_before(), 2.5);
  }
}

TEST_F(Journal, OfAnotherProgramDoesNotCount) {
  write_two();
  EXPECT_TRUE((CampaignJournal{path_, "other", true}.before().empty()));
  EXPECT_TRUE((CampaignJournal{path_, "key", true}.before().empty())) << "begun anew";
}

TEST_F(Journal, BeginsAnewUnlessItIsToGoOn) {
  write_two();
  EXPECT_TRUE((CampaignJournal{path_, "key", false}.before().empty()));
  EXPECT_TRUE((CampaignJournal{path_, "key", true}.before().empty()));
}

TEST_F(Journal, LineThatWasCutOffIsDropped) {
  write_two();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 20);
  const CampaignJournal journal{path_, "key", true};
  ASSERT_EQ(journal.before().size(), 1u);
  EXPECT_EQ(journal.before().at(7).frames, 70u);
}

TEST_F(Journal, NoFileIsAnEmptyOne) {
  EXPECT_TRUE((CampaignJournal{path_, "key", true}.before().empty()));
}

TEST_F(Journal, PlaceThatCannotBeWrittenIsAnError) {
  EXPECT_THROW((CampaignJournal{"/proc/none/journal", "key", false}), std::runtime_error);
}

TEST_F(Journal, KeyIsThatOfTheProgram) {
  EXPECT_EQ(program_key(), program_key());
  EXPECT_EQ(program_key().size(), 16u);
}

}  // namespace
}  // namespace vericansim
