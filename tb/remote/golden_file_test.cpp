// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The file of golden vectors: whole, and read as it is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "harness/input_error_of.hpp"
#include "remote/golden_vectors.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string text_of(const Frame &frame) { return candump_frame(frame); }

TEST(GoldenFile, HoldsAllVectorsInTheirOrder) {
  const std::vector<golden::Life> lives = golden::load();
  ASSERT_EQ(lives.size(), 2U);
  unsigned next = 1;
  for (const golden::Life &life : lives) {
    for (const golden::Vector &vector : life.vectors) EXPECT_EQ(vector.number, next++);
  }
  EXPECT_EQ(next, 24U);
}

TEST(GoldenFile, AVectorIsReadAsItIsWritten) {
  const golden::Life life = golden::load().front();
  const golden::Vector &read = life.vectors.at(6);
  EXPECT_EQ(text_of(read.steps.at(0).send), "1F8#000206");
  ASSERT_EQ(read.steps.at(0).answers_of("small").size(), 1U);
  EXPECT_EQ(text_of(read.steps.at(0).answers_of("small").front()), "5F8#0002AABBCC000000");
  EXPECT_EQ(text_of(life.vectors.at(4).steps.at(0).answers_of("small").front()),
            "5FF#01013C083412FECA");
  EXPECT_THAT(life.vectors.at(1).memory.at(0x20), ElementsAre(0x5A, 1, 2, 3, 4, 0));
  EXPECT_FALSE(life.vectors.at(20).status->at(3).has_value());
  EXPECT_EQ(life.vectors.at(10).status->at(0), 0x06);
  EXPECT_TRUE(life.vectors.at(21).steps.at(0).from_node);
  const golden::Call &call = life.vectors.at(2).calls.at(0);
  EXPECT_EQ(call.what, "read");
  EXPECT_EQ(call.address, 0x20U);
  EXPECT_THAT(call.gives_with("small"), ElementsAre(0x5A, 1, 2, 3, 4));
  EXPECT_EQ(text_of(life.vectors.at(15).calls.at(0).frame), "000#02");
  EXPECT_TRUE(life.vectors.at(15).calls.at(1).here);
  EXPECT_EQ(life.vectors.at(4).calls.at(0).gives_with("standard").at(1), 0x1F);
  EXPECT_EQ(text_of(life.vectors.at(14).steps.at(0).others.at(7)), "7C0#00000000");
}

TEST(GoldenFile, ASmallerNodeLeavesOutWhatItDoesNotHave) {
  const golden::Life life = golden::load().front();
  EXPECT_EQ(life.for_features(golden::features_of("full")).size(), 22U);
  EXPECT_EQ(life.for_features(golden::features_of("small")).size(), 19U);
  EXPECT_EQ(life.for_features({}).size(), 17U);
  EXPECT_EQ(life.for_features({"stage", "block"}).size(), 22U);
}

TEST(GoldenFile, AMistakeIsToldWithItsLine) {
  const std::string path = ::testing::TempDir() + "vectors.yaml";
  const auto message = [&](const std::string &step) {
    std::ofstream{path} << "lives:\n  - name_bits: 3\n    number: 3\n    serial: 1\n"
                           "    boot: \"5FE#\"\n    vectors:\n      - vector: 1\n"
                           "        what: x\n        steps:\n          - "
                        << step << "\n";
    return input_error_of([&] { return golden::load(path); });
  };
  EXPECT_THAT(message("{send: \"1A0#5\"}"), HasSubstr("vectors.yaml:10:"));
  EXPECT_THAT(message("{send: \"1A0#\", answer: []}"), HasSubstr("unknown key 'answer'"));
  EXPECT_THAT(message("{send: \"1A0#\", others: {99: \"402#\"}}"), HasSubstr("0 to 31"));
  EXPECT_EQ(message("{send: \"1A0#\", others: {7: \"402#\"}}"), "no error");
}

}  // namespace
}  // namespace vericansim
