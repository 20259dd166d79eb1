// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values from bytes and back. Expected values are published examples where one is named, else
// worked out by hand from the layout.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "signals/dbc_fixture.hpp"

namespace vericansim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::StrEq;

// The example of cantools' README (motohawk.dbc): 80 4A 0F.
TEST(SignalDecode, BigEndianSignalsAcrossBytes) {
  EXPECT_THAT(texts_in("Motorola", frame_of({0x80, 0x4A, 0x0F, 0, 0, 0, 0, 0})),
              ElementsAre(Pair("AverageRadius", "0 m"), Pair("Enable", "Enabled"),
                          Pair("Temperature", "255.92 degK")));
}

TEST(SignalDecode, LittleEndianSignalsWithFactorOffsetAndChoices) {
  // 9600 * 0.25 = 2400; bits 16 to 27 = 0xFFF = -1: -0.5 - 100; Mode 2; bit 31; 0x01020304 km.
  EXPECT_THAT(
      texts_in("EngineData", frame_of({0x80, 0x25, 0xFF, 0xAF, 1, 2, 3, 4})),
      ElementsAre(Pair("EngineSpeed", "2400 rpm"), Pair("Level", "100 %"), Pair("Mode", "Sport"),
                  Pair("Odometer", "16909060 km"), Pair("Torque", "-100.5 Nm")));
}

TEST(SignalDecode, AValueWithoutChoiceIsANumber) {
  EXPECT_THAT(texts_in("EngineData", frame_of({0, 0, 0, 0x50, 0, 0, 0, 0})),
              Contains(Pair("Mode", "5")));
  EXPECT_THAT(texts_in("EngineData", frame_of({0, 0, 0, 0x08, 0, 0, 0, 0})),
              Contains(Pair("Torque", "None")));
}

TEST(SignalDecode, AllDigitsOf64Bits) {
  const Frame ones = frame_of({0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  EXPECT_THAT(texts_in("Wide", ones), ElementsAre(Pair("Count", "18446744073709551614")));
  EXPECT_THAT(texts_in("WideSigned", frame_of({0x80, 0, 0, 0, 0, 0, 0, 1})),
              ElementsAre(Pair("Count", "-9223372036854775807")));
}

// cantools' tests of floating_point.dbc: 129.5, 1234500.5 and -129.448.
TEST(SignalDecode, FloatsOfBothSizes) {
  EXPECT_THAT(texts_in("Floats", frame_of({0x00, 0x80, 0x01, 0x43, 0x49, 0x96, 0xB2, 0x24})),
              ElementsAre(Pair("Single", "129.5 V"), Pair("SingleMotorola", "1234500.5")));
  EXPECT_THAT(texts_in("Double", frame_of({0x75, 0x93, 0x18, 0x04, 0x56, 0x2E, 0x60, 0xC0})),
              ElementsAre(Pair(testing::_, "-129.448")));
}

// IEEE 754: exponent all ones, fraction not 0; the sign bit of what is no number has no meaning.
TEST(SignalDecode, WhatIsNoNumberHasNoSign) {
  EXPECT_THAT(texts_in("Floats", frame_of({0x00, 0x00, 0xC0, 0xFF, 0x7F, 0xC0, 0, 0})),
              ElementsAre(Pair("Single", "nan V"), Pair("SingleMotorola", "nan")));
  EXPECT_THAT(texts_in("Double", frame_of({0, 0, 0, 0, 0, 0, 0xF8, 0xFF})),
              ElementsAre(Pair(testing::_, "nan")));
  EXPECT_THAT(texts_in("Double", frame_of({0, 0, 0, 0, 0, 0, 0xF0, 0xFF})),
              ElementsAre(Pair(testing::_, "-inf")));
}

// The example of CSS Electronics' introduction to J1939: SPN 190 of EEC1, 68 13 is 621 rpm.
TEST(SignalDecode, EngineSpeedOfEec1) {
  EXPECT_THAT(texts_in("EEC1", frame_of({0xFF, 0xFF, 0xFF, 0x68, 0x13, 0xFF, 0xFF, 0xFF})),
              ElementsAre(Pair("EngineSpeed", "621 rpm")));
}

TEST(SignalDecode, MultiplexedSignalsAreThereWhenSelected) {
  EXPECT_THAT(texts_in("Simple", frame_of({0xA1, 0xFE, 0xFF, 0, 0, 0, 0, 0})),
              ElementsAre(Pair("Always", "10"), Pair("B", "-2"), Pair("Kind", "1")));
  EXPECT_THAT(texts_in("Simple", frame_of({0x03, 1, 0, 0, 0, 0, 0, 0})),
              ElementsAre(Pair("Always", "0"), Pair("Kind", "3")));
}

TEST(SignalDecode, NestedMultiplexersAndRanges) {
  const auto names = [](unsigned first) {
    std::vector<std::string> list;
    for (const auto &[name, text] : texts_in("Nested", frame_of({first, 7, 9, 0, 0, 0, 0, 0})))
      list.push_back(name);
    return list;
  };
  EXPECT_THAT(names(0x21), ElementsAre("Deep", "Inner", "Outer"));
  EXPECT_THAT(names(0x51), ElementsAre("Deeper", "Inner", "Outer"));
  EXPECT_THAT(names(0x81), ElementsAre("Deeper", "Inner", "Outer"));
  EXPECT_THAT(names(0x71), ElementsAre("Inner", "Outer"));
  EXPECT_THAT(names(0x22), ElementsAre("Outer")) << "Inner is not there, so Deep is not either";
  EXPECT_THAT(names(0x03), ElementsAre("Flat", "Outer"));
  EXPECT_THAT(names(0x09), ElementsAre("Flat", "Outer"));
  EXPECT_THAT(names(0x04), ElementsAre("Outer"));
}

// The bits select, so that 255 is meant where a signed multiplexer of 8 bits reads -1.
TEST(SignalDecode, ASignedMultiplexerSelectsByItsBits) {
  Database database;
  database.add_text("signed.dbc",
                    "BO_ 1 A: 8 X\n SG_ K M : 0|8@1- (1,0) [0|0] \"\" X\n"
                    " SG_ T m255 : 8|8@1+ (1,0) [0|0] \"\" X\n");
  const SignalMessage &message = *database.messages()[0];
  EXPECT_EQ(to_text(message, decode(message, frame_of({0xFF, 7}))), "A(K: -1, T: 7)");
  EXPECT_EQ(to_text(message, decode(message, frame_of({0x7F, 7}))), "A(K: 127)");
  EXPECT_THAT(encode(message, {{"K", "-1"}, {"T", "7"}}), ElementsAre(0xFF, 7, 0, 0, 0, 0, 0, 0));
}

TEST(SignalDecode, ShortFramesHoldTheirSignals) {
  EXPECT_THAT(texts_in("EngineData", frame_of({0x80, 0x25})),
              ElementsAre(Pair("EngineSpeed", "2400 rpm")));
  Frame remote;
  remote.remote = true;
  remote.dlc = 8;
  EXPECT_TRUE(decode(message("EngineData"), remote).empty());
}

// The multiplexer is not in the frame, so that nothing is selected, whatever lies behind its end.
TEST(SignalDecode, AMultiplexerBehindTheEndOfAFrameSelectsNothing) {
  Database database;
  database.add_text("short.dbc",
                    "BO_ 1 A: 8 X\n SG_ K M : 16|8@1+ (1,0) [0|0] \"\" X\n"
                    " SG_ T m0 : 0|8@1+ (1,0) [0|0] \"\" X\n");
  const SignalMessage &message = *database.messages()[0];
  EXPECT_EQ(to_text(message, decode(message, frame_of({7, 0}))), "A()");
  EXPECT_EQ(to_text(message, decode(message, frame_of({7, 0, 0}))), "A(K: 0, T: 7)");
}

TEST(SignalEncode, WhatIsGivenAndStartValuesOfTheRest) {
  // Torque's start value is 200 (raw), 0x0C8; Mode Sport is 2 at bit 28.
  EXPECT_THAT(encode(message("EngineData"), {{"EngineSpeed", "2400"}, {"Mode", "Sport"}}),
              ElementsAre(0x80, 0x25, 0xC8, 0x20, 0, 0, 0, 0));
  EXPECT_THAT(encode(message("Motorola"),
                     {{"Temperature", "255.92"}, {"AverageRadius", "0"}, {"Enable", "1"}}),
              ElementsAre(0x80, 0x4A, 0, 0, 0, 0, 0, 0));  // the example's 0F is in no signal
  EXPECT_THAT(encode(message("Floats"), {{"Single", "129.5"}, {"SingleMotorola", "1234500.5"}}),
              ElementsAre(0x00, 0x80, 0x01, 0x43, 0x49, 0x96, 0xB2, 0x24));
  EXPECT_THAT(encode(message("Wide"), {{"Count", "18446744073709551614"}}),
              ElementsAre(0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF));
}

TEST(SignalEncode, MultiplexersAreSetBeforeWhatTheySelect) {
  EXPECT_THAT(encode(message("Nested"), {{"Outer", "1"}, {"Inner", "4"}, {"Deeper", "9"}}),
              ElementsAre(0x41, 0, 9, 0, 0, 0, 0, 0));
  EXPECT_THAT(encode(message("Simple"), {{"Kind", "2"}, {"C", "8"}}),
              ElementsAre(2, 4, 0, 0, 0, 0, 0, 0));
}

TEST(SignalEncode, TheOrderOfTheFileDoesNotMatter) {
  Database database;
  database.add_text("order.dbc",
                    "BO_ 1 A: 8 X\n SG_ Chosen m3 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                    " SG_ Kind M : 0|8@1+ (1,0) [0|0] \"\" X\n");
  EXPECT_THAT(encode(*database.messages()[0], {{"Kind", "3"}, {"Chosen", "7"}}),
              ElementsAre(3, 7, 0, 0, 0, 0, 0, 0));
}

TEST(SignalEncode, StartValuesLeaveBitsThatAreGiven) {
  Database database;
  database.add_text(
      "start.dbc",
      "BO_ 1 A: 8 X\n SG_ S : 0|4@1+ (1,0) [0|0] \"\" X\n"
      " SG_ T : 2|8@1+ (1,0) [0|0] \"\" X\nBA_DEF_ SG_ \"GenSigStartValue\" INT 0 9;\n"
      "BA_ \"GenSigStartValue\" SG_ 1 T 255;\n");
  EXPECT_THAT(encode(*database.messages()[0], {{"S", "1"}}), ElementsAre(1, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(encode(*database.messages()[0], {}), ElementsAre(0xFC, 3, 0, 0, 0, 0, 0, 0));
}

TEST(SignalEncode, ValuesBetweenStepsAreRounded) {
  EXPECT_THAT(encode(message("EngineData"), {{"EngineSpeed", "0.2"}})[0], 1);
  EXPECT_THAT(encode(message("EngineData"), {{"EngineSpeed", "0.1"}})[0], 0);
}

/// The refusal of values of a message.
std::string refusal(const std::string &name, const SignalTexts &texts) {
  try {
    (void)encode(message(name), texts);
    return "encoded";
  } catch (const SignalError &error) {
    return error.signal() + ": " + error.what();
  }
}

TEST(SignalEncode, WhatASignalCannotHaveIsRefused) {
  EXPECT_THAT(refusal("EngineData", {{"EngineSpeed", "8001"}}),
              StrEq("EngineSpeed: '8001' is not allowed; allowed: 0 to 8000 rpm in steps of 0.25"));
  EXPECT_THAT(refusal("EngineData", {{"EngineSpeed", "-1"}}), HasSubstr("allowed: 0 to 8000 rpm"));
  EXPECT_THAT(
      refusal("Motorola", {{"Enable", "2"}}),
      StrEq("Enable: '2' is not allowed; allowed: 0 to 1 - in steps of 1, Disabled, Enabled"));
  EXPECT_THAT(refusal("EngineData", {{"Mode", "sport"}}), HasSubstr("Off, Eco, Sport"));
  EXPECT_THAT(refusal("EngineData", {{"Mode", "Reserved"}}), HasSubstr("more than one value"));
  EXPECT_THAT(refusal("EngineData", {{"Torque", "nan"}}), HasSubstr("not allowed"));
  EXPECT_THAT(refusal("Wide", {{"Count", "18446744073709551616"}}), HasSubstr("not allowed"));
  EXPECT_THAT(refusal("WideSigned", {{"Count", "9223372036854775808"}}), HasSubstr("not allowed"));
  EXPECT_THAT(refusal("Floats", {{"Single", "1e39"}}), HasSubstr("not allowed"));
  EXPECT_THAT(refusal("EngineData", {{"Speed", "1"}}),
              HasSubstr("message EngineData has no such signal; allowed: EngineSpeed, Torque"));
}

TEST(SignalEncode, SignalsThatExcludeEachOtherAreRefused) {
  EXPECT_THAT(refusal("Simple", {{"Kind", "1"}, {"C", "8"}}),
              StrEq("C: is there only while Kind has the raw value 2"));
  EXPECT_THAT(refusal("Nested", {{"Outer", "1"}, {"Flat", "8"}}),
              StrEq("Flat: is there only while Outer has the raw value 3, 5 to 9"));
  Database database;
  database.add_text("overlap.dbc",
                    "BO_ 1 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n"
                    " SG_ T : 4|8@1+ (1,0) [0|0] \"\" X\n");
  const SignalMessage &overlap = *database.messages()[0];
  EXPECT_THAT(encode(overlap, {{"T", "255"}}), ElementsAre(0xF0, 0x0F, 0, 0, 0, 0, 0, 0));
  EXPECT_THROW((void)encode(overlap, {{"S", "1"}, {"T", "1"}}), SignalError);
}

/// The values of a frame that may be given again: numbers within the limits of the file.
SignalTexts writable(const SignalMessage &message, const Frame &frame) {
  SignalTexts texts;
  for (const SignalValue &value : decode(message, frame)) {
    const Signal &signal = *value.signal;
    if (std::isfinite(value.value) && value.value >= signal.minimum &&
        value.value <= signal.maximum)
      texts[signal.name] = number_text(value);
  }
  return texts;
}

// Whatever is decoded can be written again: every message, random data.
TEST(SignalEncode, EncodesWhatWasDecoded) {
  std::mt19937_64 random{1};
  std::size_t compared = 0;
  for (const auto &message : features().messages()) {
    for (int round = 0; round < 500; ++round) {
      Frame frame;
      frame.dlc = 8;
      for (auto &byte : frame.data) byte = static_cast<std::uint8_t>(random());
      const SignalTexts texts = writable(*message, frame);
      frame.data = encode(*message, texts);
      for (const SignalValue &value : decode(*message, frame)) {
        const auto text = texts.find(value.signal->name);
        if (text == texts.end()) continue;
        EXPECT_EQ(number_text(value), text->second) << message->name << '.' << text->first;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 9'000U);
}

}  // namespace
}  // namespace vericansim
