// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The user port: RN-50 to RN-53. Accesses at every clock around the end of a frame.
#include <gmock/gmock.h>

#include <functional>

#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr Time kClock = 125 * kNanosecond;
constexpr int kBefore = -12, kAfter = 60;  // clocks around the SP of EOF6: to behind INT3
constexpr unsigned kWord = 0x20 / 4;       // and the next one
constexpr std::uint32_t kOld = 0x11111111, kNew = 0x5A5A5A5A;
constexpr const char *kWrite = "1A0#5A5A5A5A5A5A5A5A";

/// A node, one frame, and what user logic does `offset` clocks after that frame is valid. Every run
/// is a run from reset, so that all are the same but for the offset.
class OneFrame {
 public:
  using Act = std::function<void(RtlBus &)>;
  OneFrame(std::string frame, Act before) : frame_{std::move(frame)}, before_{std::move(before)} {
    RtlBus bus{std::vector<unsigned>{3}};
    begin(bus);
    (void)bus.settle();
    valid_ = bus.places.valid;
  }
  /// What the node says.
  std::vector<std::string> run(int offset, const Act &act, unsigned *longest_wait = nullptr) {
    RtlBus bus{std::vector<unsigned>{3}};
    begin(bus);
    bus.bus.at(valid_ + offset * kClock, [&] { act(bus); });
    unsigned wait = 0;
    const Time end = valid_ + 200 * UnitBus::kBit;
    while (bus.bus.now() < end) {
      bus.bus.step();
      wait = bus.node().ready() ? 0 : wait + 1;
      if (longest_wait != nullptr) *longest_wait = std::max(*longest_wait, wait);
    }
    last_ = {bus.node().peek_words(kWord, 2)};
    return bus.settle();
  }
  /// The two words after the last run.
  [[nodiscard]] const Words &last() const { return last_; }

 private:
  void begin(RtlBus &bus) const {
    (void)bus.start();
    for (const unsigned word : {kWord, kWord + 1}) bus.node().user_write(word, kOld, 0xF);
    before_(bus);
    (void)bus.settle();
    bus.host.request(frame_of(frame_));
  }

  std::string frame_;
  Act before_;
  Time valid_ = 0;
  Words last_;
};

void nothing(RtlBus &) {}

void read_two(RemoteNode &node, Words &seen) {
  for (const unsigned word : {kWord, kWord + 1})
    node.access({false, 0, word, 0}, [&seen](std::uint32_t data) { seen.push_back(data); });
}

// RN-50: two reads one after the other never see the second half of a write without the first.
TEST(RtlUser, ReadsSeeNoWriteBackwards) {
  OneFrame frame{kWrite, nothing};
  unsigned old = 0, changed = 0;
  for (int offset = kBefore; offset < kAfter; ++offset) {
    Words seen;
    (void)frame.run(offset, [&](RtlBus &bus) { read_two(bus.node(), seen); });
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_THAT(seen, ::testing::AnyOf(Words{kOld, kOld}, Words{kOld, kNew}, Words{kNew, kNew}))
        << offset;
    old += seen[1] == kOld;
    changed += seen[0] == kNew;
  }
  EXPECT_GT(old, 0U);
  EXPECT_GT(changed, 0U);
}

// RN-51, RN-52: with hold they see all of it or nothing.
TEST(RtlUser, HeldReadsSeeAllOrNothing) {
  OneFrame frame{kWrite, nothing};
  for (int offset = kBefore; offset < kAfter; ++offset) {
    Words seen;
    (void)frame.run(offset, [&](RtlBus &bus) {
      bus.node().hold(true);
      read_two(bus.node(), seen);
      bus.bus.at(bus.bus.now() + 30 * kClock, [&bus] { bus.node().hold(false); });
    });
    EXPECT_THAT(seen, ::testing::AnyOf(Words{kOld, kOld}, Words{kNew, kNew})) << offset;
    EXPECT_EQ(frame.last(), (Words{kNew, kNew})) << offset;
  }
}

// RN-46, RN-50: the same for the stage, which TRIGGER copies at once.
TEST(RtlUser, HeldReadsSeeTheWholeStageOrNothing) {
  OneFrame frame{"001#01", [](RtlBus &bus) {
                   (void)bus.send("000#01");
                   (void)bus.send("190#5A5A5A5A5A5A5A5A");
                 }};
  for (int offset = kBefore; offset < kAfter; ++offset) {
    Words seen;
    (void)frame.run(offset, [&](RtlBus &bus) {
      bus.node().hold(true);
      for (const unsigned word : {4U, 5U})
        bus.node().access({false, 0, word, 0}, [&](std::uint32_t data) { seen.push_back(data); });
      bus.bus.at(bus.bus.now() + 30 * kClock, [&bus] { bus.node().hold(false); });
    });
    EXPECT_THAT(seen, ::testing::AnyOf(Words{0, 0}, Words{kNew, kNew})) << offset;
  }
}

// RN-21, RN-51: an answer is one snapshot: two words written under a hold are in it both or not.
TEST(RtlUser, AnswersHoldBothWordsOrNone) {
  OneFrame frame{"1A0#R8", nothing};
  unsigned old = 0, changed = 0;
  for (int offset = kBefore; offset < kAfter; ++offset) {
    const auto said = frame.run(offset, [&](RtlBus &bus) {
      bus.node().hold(true);
      for (const unsigned word : {kWord, kWord + 1}) bus.node().user_write(word, kNew, 0xF);
      bus.bus.at(bus.bus.now() + 30 * kClock, [&bus] { bus.node().hold(false); });
    });
    ASSERT_EQ(said.size(), 1U);
    old += said[0] == "5A0#1111111111111111";
    changed += said[0] == "5A0#5A5A5A5A5A5A5A5A";
  }
  EXPECT_GT(old, 0U);
  EXPECT_GT(changed, 0U);
  EXPECT_EQ(old + changed, static_cast<unsigned>(kAfter - kBefore));
}

/// The answer of "1A0#R1" waits while user logic holds `request` up, which follows at once, from
/// before its end until `clocks` behind it. What the node says.
std::vector<std::string> held_before_an_answer(RtlBus &bus, const std::string &request,
                                               unsigned clocks) {
  (void)bus.start();
  for (const unsigned word : {kWord, kWord + 1}) bus.node().user_write(word, kOld, 0xF);
  const auto valid = [&bus] { return bus.places.valid != 0; };
  bus.places.valid = 0;
  bus.host.request(frame_of("1A0#R1"));
  bus.host.request(frame_of(request));
  EXPECT_TRUE(bus.bus.run_until(valid, kMillisecond));
  bus.run_bits(4);
  bus.node().hold(true);
  bus.places.valid = 0;
  EXPECT_TRUE(bus.bus.run_until(valid, kMillisecond));
  bus.bus.run_for(clocks * kClock);
  bus.node().hold(false);
  return bus.settle();
}

// RN-52: a request that is held up is carried out as it was, though an answer waits that the node
// would send behind the intermission.
TEST(RtlUser, HeldRequestIsDoneBeforeAnAnswerThatWaits) {
  constexpr unsigned kLongest = 72;  // clocks: a hold lasts 64
  for (const char *profile : {"small", "standard", "full"})
    for (unsigned clocks = 0; clocks <= kLongest; ++clocks) {
      SCOPED_TRACE(::testing::Message() << profile << ", " << clocks << " clocks");
      const RemoteConfig config = RemoteConfig::profile(profile);
      RtlBus writes{rtl_unit(3, config)}, reads{rtl_unit(3, config)};
      EXPECT_THAT(held_before_an_answer(writes, kWrite, clocks), ::testing::ElementsAre("5A0#11"));
      EXPECT_EQ(writes.node().peek_words(kWord, 2), (Words{kNew, kNew}));
      // A queue of one refuses the read.
      const char *second = config.tx_depth == 1 ? "5FE#0200000620000100" : "5A0#1111111111111111";
      EXPECT_THAT(held_before_an_answer(reads, "1A0#R8", clocks),
                  ::testing::ElementsAre("5A0#11", second));
      EXPECT_EQ(reads.node().peek_words(kWord, 2), (Words{kOld, kOld}));
    }
}

// RN-51, RN-53: one word that user logic writes is whole in the end, or overwritten whole.
TEST(RtlUser, LaterWriteStays) {
  OneFrame frame{kWrite, nothing};
  for (int offset = kBefore; offset < kAfter; ++offset) {
    (void)frame.run(offset, [&](RtlBus &bus) { bus.node().user_write(kWord, 0x77777777, 0xF); });
    EXPECT_THAT(frame.last(), ::testing::AnyOf(Words{0x77777777, kNew}, Words{kNew, kNew}));
    if (offset > 32) {
      EXPECT_EQ(frame.last()[0], 0x77777777U) << offset;
    }
  }
}

// RN-50: user logic waits for 24 clocks in a row at most, whatever the frame.
TEST(RtlUser, WaitsFor24ClocksAtMost) {
  for (const char *text : {kWrite, "1A0#R8", "1F8#000206", "1F9#0002112233445566", "1FE#R8",
                           "1FC#0134120000", "002#34FF12FFFEFFCAFF", "001#01", "1A0#", "0A0#R8"}) {
    OneFrame frame{text, [](RtlBus &bus) { (void)bus.send("000#01"); }};
    unsigned wait = 0;
    (void)frame.run(0, nothing, &wait);
    EXPECT_LE(wait, 24U) << text;
    EXPECT_GT(wait, 0U) << text;
  }
}

/// A word of the node itself: the engine's own bytes, the rows of counters, STATUS and IDENT.
bool is_own(unsigned word) { return (word >= 0xE00 / 4 && word < 0xF00 / 4) || word >= 0xFE0 / 4; }

// RN-53: user logic reads all of the RAM; its writes to the engine's own bytes and to the rows of
// counters, STATUS and IDENT are ignored.
TEST(RtlUser, WritesWhereItHasNoRightAreIgnored) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  for (unsigned word = 0; word < 1024; ++word) {
    const bool own = is_own(word);
    const std::uint32_t before = bus.node().peek_words(word, 1)[0];
    bus.node().user_write(word, ~before, 0xF);
    bus.run_bits(1);
    EXPECT_EQ(bus.node().peek_words(word, 1)[0], own ? before : ~before) << 4 * word;
    if (!own) bus.node().user_write(word, before, 0xF);
    bus.run_bits(1);
  }
}

// RN-53: a read is none of them, whatever lanes and data are beside it (user_access.hpp).
TEST(RtlUser, ReadsWriteNothing) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  const std::vector<std::uint32_t> before = bus.node().peek_words(0, 1024);
  std::vector<std::uint32_t> seen;
  for (unsigned word = 0; word < 1024; ++word)
    bus.node().access({false, 0, word, 0}, [&seen](std::uint32_t data) { seen.push_back(data); });
  bus.run_bits(2000);
  EXPECT_EQ(seen, before);
  const std::vector<std::uint32_t> after = bus.node().peek_words(0, 1024);
  for (unsigned word = 0; word < 1024; ++word)
    if (!is_own(word)) EXPECT_EQ(after[word], before[word]) << 4 * word;
}

// RN-51: byte lanes.
TEST(RtlUser, OnlyTheLanesAreWritten) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  for (unsigned lanes = 0; lanes < 16; ++lanes) {
    bus.node().user_write(kWord, kOld, 0xF);
    bus.node().user_write(kWord, kNew, lanes);
    bus.run_bits(2);
    for (unsigned i = 0; i < 4; ++i)
      EXPECT_EQ(bus.node().peek(0x20 + i), (lanes >> i & 1) != 0 ? 0x5A : 0x11);
  }
}

}  // namespace
}  // namespace vericansim
