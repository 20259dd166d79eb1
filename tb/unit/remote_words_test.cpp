// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames of remote nodes in words (RN-97): the golden vectors' frames, by hand from section 3 of
// the specification, and everything that has no meaning.
#include <gtest/gtest.h>

#include "trace/candump.hpp"
#include "trace/remote_words.hpp"

namespace vericansim {
namespace {

std::string words(const std::string &text, unsigned name_bits = 3) {
  Frame frame;
  EXPECT_TRUE(parse_candump_frame(text, frame, {text, 0}));
  return remote_words(frame, name_bits);
}

// RN-97; RN-20, RN-21.
TEST(RemoteWords, DirectAccesses) {
  EXPECT_EQ(words("1A0#5A"), "3: write 020 <- 5A");
  EXPECT_EQ(words("1A1#01020304"), "3: write 021 <- 01 02 03 04");
  EXPECT_EQ(words("1A0#R5"), "3: read 020, 5 bytes");
  EXPECT_EQ(words("0C0#R1"), "all: read 040, 1 byte");
  EXPECT_EQ(words("1A0#"), "3: write 020 <- nothing");
  EXPECT_EQ(words("5A0#5A01020304"), "3 says 020 = 5A 01 02 03 04");
  EXPECT_EQ(words("5A0#R1"), "remote frame to what 3 says");
}

TEST(RemoteWords, Ports) {
  EXPECT_EQ(words("1F8#000206"), "3: read 200, 6 bytes");
  EXPECT_EQ(words("5F8#0002AABBCC000000"), "3 says 200 = AA BB CC 00 00 00");
  EXPECT_EQ(words("1F9#0002AABBCC"), "3: write 200 <- AA BB CC");
  EXPECT_EQ(words("1FA#015AFE011000"), "3: block read 1FE, 16 bytes, tag 5A");
  EXPECT_EQ(words("1FA#025B00030A00"), "3: block write 300, 10 bytes, tag 5B");
  EXPECT_EQ(words("1FA#005B00000000"), "3: abort block, tag 5B");
  EXPECT_EQ(words("5FA#025B05000000"), "3 says block write open, 0 bytes");
  EXPECT_EQ(words("5FA#025B00000A00"), "3 says block write done, 10 bytes");
  EXPECT_EQ(words("5FA#025B12000700"), "3 says block write closed, 7 bytes, code 12 (sequence)");
  EXPECT_EQ(words("1FB#0101020304"), "3: block data 1 <- 01 02 03 04");
  EXPECT_EQ(words("5FB#00AA"), "3 says block data 0 = AA");
  EXPECT_EQ(words("1FC#013412FECA"), "3: unlock");
  EXPECT_EQ(words("1FC#02"), "3: lock");
  EXPECT_EQ(words("1FC#09"), "3: unknown SETUP");
  EXPECT_EQ(words("1FE#R8"), "3: read STATUS");
  EXPECT_EQ(words("1FF#R8"), "3: read IDENT");
  EXPECT_EQ(words("1FD#01"), "3: no command at port 7D");
  EXPECT_EQ(words("1F8#R3"), "3: no command at port 78");
  EXPECT_EQ(words("1FA#01"), "3: no command at port 7A");
}

TEST(RemoteWords, Rows) {
  EXPECT_EQ(words("5FE#0200000021020007"), "3 says STATUS SAFE, accepted 2, refused 0, TRIGGER 7");
  EXPECT_EQ(words("5FE#5700001179030300"),
            "3 says STATUS OPERATE, unlocked, number doubled, watchdog, code 11 (locked) at 79, "
            "accepted 3, refused 3, TRIGGER 0");
  EXPECT_EQ(words("5FE#02"), "3 says STATUS SAFE");
  EXPECT_EQ(words("5FF#01FF3C083412FECA"), "3 says IDENT serial CAFE1234");
}

TEST(RemoteWords, SystemFunctions) {
  EXPECT_EQ(words("000#01"), "OPERATE all");
  EXPECT_EQ(words("000#0200"), "SAFE all");
  EXPECT_EQ(words("000#8103"), "RESTART 3");
  EXPECT_EQ(words("001#07"), "TRIGGER 7");
  EXPECT_EQ(words("001#"), "TRIGGER");
  EXPECT_EQ(words("002#34FF12FFFEFFCAFF"), "SELECT serial CAFE1234 under FFFFFFFF");
  EXPECT_EQ(words("004#0000000000000000"), "SELECT NEW serial 00000000 under 00000000");
  EXPECT_EQ(words("003#05"), "ASSIGN 5");
  EXPECT_EQ(words("402#"), "HERE");
  EXPECT_EQ(words("005#00"), "unknown system function 05");
}

// RN-31, RN-32: lengths and operations that no node obeys are no commands: code 3 of every node.
TEST(RemoteWords, WrongLengthsAreNoCommands) {
  for (const std::string frame : {"000#", "000#010300"})
    EXPECT_EQ(words(frame), "no command at system function 00") << frame;
  EXPECT_EQ(words("001#0102"), "no command at system function 01");
  for (const std::string frame : {"002#", "002#34FF12FF"})
    EXPECT_EQ(words(frame), "no command at system function 02") << frame;
  for (const std::string frame : {"003#", "003#0500"})
    EXPECT_EQ(words(frame), "no command at system function 03") << frame;
  EXPECT_EQ(words("004#00"), "no command at system function 04");
  for (const std::string frame : {"1FA#035B00030A00", "1FA#025B00030A000000"})
    EXPECT_EQ(words(frame), "3: no command at port 7A") << frame;
  for (const std::string frame : {"1FC#01", "1FC#0200", "1FC#"})
    EXPECT_EQ(words(frame), "3: no command at port 7C") << frame;
}

TEST(RemoteWords, OtherNameBitsAndOtherFrames) {
  EXPECT_EQ(words("124#77", 5), "9: write 004 <- 77");
  EXPECT_EQ(words("524#77", 5), "9 says 004 = 77");
  EXPECT_EQ(words("13E#R8", 5), "9: read STATUS");
  EXPECT_EQ(words("06800000#FF"), "");
}

// Nothing that a bus can bring makes it fail or read beyond the frame.
TEST(RemoteWords, EveryBaseFrameHasWords) {
  for (const unsigned name_bits : {3U, 5U})
    for (unsigned id = 0; id < 0x800; ++id)
      for (unsigned dlc = 0; dlc <= 15; ++dlc)
        for (const bool remote : {false, true})
          EXPECT_NE(
              remote_words({id, false, remote, static_cast<std::uint8_t>(dlc), {}}, name_bits), "");
}

}  // namespace
}  // namespace vericansim
