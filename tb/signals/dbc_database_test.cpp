// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DBC files: what is read, how frames find their message, what is refused. Expected values are what
// the file says, by the rules of the format.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "signals/dbc_fixture.hpp"

namespace vericansim {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const Signal &signal(const std::string &message_name, const std::string &name) {
  return *message(message_name).find(name);
}

TEST(DbcDatabase, HoldsTheSignalsOfTheFile) {
  EXPECT_EQ(features().messages().size(), 12U);
  const Signal &torque = signal("EngineData", "Torque");
  EXPECT_EQ(torque.start, 16U);
  EXPECT_EQ(torque.length, 12U);
  EXPECT_TRUE(torque.little_endian);
  EXPECT_TRUE(torque.is_signed);
  EXPECT_EQ(torque.factor, 0.5);
  EXPECT_EQ(torque.offset, -100);
  EXPECT_EQ(torque.minimum, -1000);
  EXPECT_EQ(torque.maximum, 923.5);
  EXPECT_EQ(torque.unit, "Nm");
  EXPECT_EQ(torque.start_value, 200);
  EXPECT_EQ(signal("Motorola", "Temperature").start, 0U);
  EXPECT_FALSE(signal("Motorola", "Temperature").little_endian);
  EXPECT_EQ(signal("EngineData", "Mode").choices.back().second, "Not \"available\"");
  EXPECT_TRUE(signal("Floats", "Single").is_float);
}

TEST(DbcDatabase, LongNamesTakeThePlaceOfShortOnes) {
  EXPECT_EQ(message("Double").signals[0].name, "ValueWithANameThatIsLongerThanThirtyTwoCharacters");
}

TEST(DbcDatabase, LimitsThatAreZeroAreNone) {
  EXPECT_EQ(signal("Wide", "Count").minimum, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(signal("EngineData", "Odometer").maximum, std::numeric_limits<double>::infinity());
}

TEST(DbcDatabase, FramesFindTheMessageOfTheirIdentifier) {
  EXPECT_EQ(features().find(256, false)->name, "EngineData");
  EXPECT_EQ(features().find(256, true), nullptr);
  EXPECT_EQ(features().find(0x18FEEF00, true)->name, "Floats");
  EXPECT_EQ(features().find(0x7FF, false), nullptr);
}

// J1939-21: the parameter group is bits 8 to 25; below PDU format 240 bits 8 to 15 are the
// destination. EEC1 is group 61444, Proprietary A 61184.
TEST(DbcDatabase, J1939MessagesStandForTheirParameterGroup) {
  EXPECT_EQ(parameter_group(0x0CF004FE), 61444U);
  EXPECT_EQ(parameter_group(0x18EAFF00), 0xEA00U);
  EXPECT_EQ(features().find(0x18F00431, true)->name, "EEC1");
  EXPECT_EQ(features().find(0x18EF0027, true)->name, "ProprietaryA");
  EXPECT_EQ(features().find(0x18F00531, true), nullptr);
  EXPECT_EQ(features().find(0x0DF00431, true), nullptr) << "another data page";
}

TEST(DbcDatabase, TheExactIdentifierGoesBeforeTheGroup) {
  EXPECT_EQ(features().find(0x0CF00400, true)->name, "EEC1FromEngine");
}

TEST(DbcDatabase, MessagesThatAreNotJ1939NeedTheirIdentifier) {
  EXPECT_EQ(features().find(0x110, true)->name, "PlainExtended");
  EXPECT_EQ(features().find(0x04000110, true), nullptr);
}

TEST(DbcDatabase, OfOneGroupTheSameSourceIsTaken) {
  Database database;
  database.add_text("two.dbc",
                    "BO_ 2364540158 Any: 8 X\nBO_ 2364539929 From25: 8 X\n"
                    "BA_DEF_ \"ProtocolType\" STRING ;\nBA_DEF_DEF_ \"ProtocolType\" \"\";\n"
                    "BA_ \"ProtocolType\" \"J1939\";\n");
  EXPECT_EQ(database.find(0x18F00419, true)->name, "From25");
  EXPECT_EQ(database.find(0x18F00420, true)->name, "Any");
}

TEST(DbcDatabase, UnitsAreReadInBothEncodings) {
  for (const char *degree : {"\xC2\xB0", "\xB0"}) {
    Database database;
    database.add_text("unit.dbc", "BO_ 1 A: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] \"" +
                                      std::string(degree) + "C\" X\n");
    EXPECT_EQ(database.messages()[0]->signals[0].unit,
              "\xC2\xB0"
              "C");
  }
}

TEST(DbcDatabase, StringsStandWithoutTheBackslashesThatHideTheirMarks) {
  Database database;
  database.add_text("unit.dbc",
                    R"(BO_ 1 A: 8 X
 SG_ S : 0|8@1+ (1,0) [0|0] "5\" \\ \d" X
VAL_ 1 S 0 "say \"hi\"" 1 "a\\b" 2 "\\" 3 "\d";
)");
  const Signal &signal = database.messages()[0]->signals[0];
  EXPECT_EQ(signal.unit, R"(5" \ \d)");
  using Choice = std::pair<std::int64_t, std::string>;
  EXPECT_THAT(signal.choices, testing::ElementsAre(Choice{0, R"(say "hi")"}, Choice{1, R"(a\b)"},
                                                   Choice{2, R"(\)"}, Choice{3, R"(\d)"}));
}

/// The message of the InputError that this text gives as file bad.dbc.
std::string refusal(const std::string &text) {
  return input_error_of([&] {
    Database database;
    database.add_text("bad.dbc", text);
  });
}

const std::string kMessage = "BO_ 1 A: 8 X\n";

TEST(DbcDatabase, WhatIsNoDatabaseIsRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("bad.dbc: no message in it"));
  EXPECT_THAT(refusal("{\"json\": 1}"), HasSubstr("bad.dbc:1: unknown statement: {"));
  EXPECT_THAT(refusal(kMessage + "\nSQ_ Speed : 0|8@1+\n"),
              HasSubstr("bad.dbc:3: unknown statement: SQ_ Speed"));
}

TEST(DbcDatabase, BadStatementsAreRefusedWithLineAndForm) {
  EXPECT_THAT(refusal("BO_ one A: 8 X\n"),
              AllOf(StartsWith("bad.dbc:1: not understood: BO_ one A: 8 X"),
                    HasSubstr("allowed: BO_ <id> <name>: <bytes> <sender>")));
  EXPECT_THAT(refusal(kMessage + "\n SG_ S : 0|8@1+ (1) [0|0] \"\" X\n"),
              StartsWith("bad.dbc:3: not understood: SG_ S"));
  EXPECT_THAT(refusal(" SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n" + kMessage),
              StartsWith("bad.dbc:1: "));
  EXPECT_THAT(refusal(kMessage + "CM_ \"open\nBO_ 2 B: 8 X\n"),
              HasSubstr("bad.dbc:2: a string that begins here has no end"));
  EXPECT_THAT(refusal(kMessage + " SG_ S : 0|8@1+ (1.2.3,0) [0|0] \"\" X\n"),
              StartsWith("bad.dbc:2: not understood"));
}

TEST(DbcDatabase, SignalsThatNoFrameCanHoldAreRefused) {
  const auto with = [](const std::string &line) {
    return refusal(kMessage + " SG_ " + line + "\n");
  };
  EXPECT_THAT(with("S : 57|8@1+ (1,0) [0|0] \"\" X"),
              HasSubstr("bad.dbc:2: signal S does not fit the 8 bytes of message A: it needs 9"));
  EXPECT_THAT(with("S : 56|9@0+ (1,0) [0|0] \"\" X"), HasSubstr("it needs 9"));
  EXPECT_THAT(with("S : 0|65@1+ (1,0) [0|0] \"\" X"), HasSubstr("has 65 bits; allowed: 1 to 64"));
  EXPECT_THAT(with("S : 0|0@1+ (1,0) [0|0] \"\" X"), HasSubstr("has 0 bits; allowed: 1 to 64"));
  EXPECT_THAT(with("S : 0|8@1+ (0,0) [0|0] \"\" X"), HasSubstr("has the factor 0"));
  EXPECT_THAT(with("S : 0|8@1+ (1e400,0) [0|0] \"\" X"), HasSubstr("has the factor 1E+400"));
  EXPECT_THAT(with("S : 0|8@1+ (1,-1e400) [0|0] \"\" X"), HasSubstr("has the offset -1E+400"));
  EXPECT_THAT(with("S m1 : 0|8@1+ (1,0) [0|0] \"\" X"), HasSubstr("is multiplexed, but"));
  EXPECT_THAT(with("S m1M : 0|8@1+ (1,0) [0|0] \"\" X"),
              HasSubstr("needs a statement SG_MUL_VAL_"));
  EXPECT_THAT(with("S m1M : 0|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 S S 1-1;"),
              HasSubstr("is multiplexed by itself"));
  EXPECT_THAT(with("S : 0|16@1- (1,0) [0|0] \"\" X\nSIG_VALTYPE_ 1 S : 1;"),
              HasSubstr("bad.dbc:3: signal S is a floating-point number of 16 bits; allowed with "
                        "value type 1: 32"));
}

std::string refusal_after_signal(const std::string &statement) {
  return refusal(kMessage + " SG_ S : 0|32@1- (1,0) [0|0] \"\" X\n" + statement + "\n");
}

TEST(DbcDatabase, ValueTypesAreThoseOfTheFormatAndFitTheSignal) {
  EXPECT_THAT(refusal_after_signal("SIG_VALTYPE_ 1 S : 3;"),
              HasSubstr("bad.dbc:3: signal S has the value type 3; allowed: 0 (integer), 1 (float "
                        "of 32 bits), 2 (float of 64 bits)"));
  EXPECT_THAT(refusal_after_signal("SIG_VALTYPE_ 1 S : -1;"), HasSubstr("has the value type -1"));
  EXPECT_THAT(refusal_after_signal("SIG_VALTYPE_ 1 S : 2;"),
              HasSubstr("floating-point number of 32 bits; allowed with value type 2: 64"));
  EXPECT_EQ(refusal_after_signal("SIG_VALTYPE_ 1 S : 1;"), "no error");
  EXPECT_EQ(refusal_after_signal("SIG_VALTYPE_ 1 S : 0;"), "no error");
}

TEST(DbcDatabase, BadValuesOfAttributesAreRefusedWithTheirLine) {
  const std::string format = "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\";\n";
  for (const char *bad : {"14", "\"x\"", "2"})
    EXPECT_THAT(refusal_after_signal(format + "BA_ \"VFrameFormat\" BO_ 1 " + bad + ";"),
                HasSubstr("bad.dbc:4: VFrameFormat " + std::string(bad) +
                          " is not allowed; allowed: the numbers 0 to 1"));
  EXPECT_EQ(refusal_after_signal(format + "BA_ \"VFrameFormat\" BO_ 1 1;"), "no error");
  const std::string start = "BA_DEF_ SG_ \"GenSigStartValue\" FLOAT 0 100;\n";
  for (const char *bad : {"\"abc\"", "\"\"", "1,5", "0x10"})
    EXPECT_THAT(refusal_after_signal(start + "BA_ \"GenSigStartValue\" SG_ 1 S " + bad + ";"),
                HasSubstr("bad.dbc:4: GenSigStartValue " + std::string(bad) + " is not allowed"));
  EXPECT_THAT(refusal_after_signal(start + "BA_DEF_DEF_ \"GenSigStartValue\" 1,5;"),
              HasSubstr("bad.dbc:4: GenSigStartValue 1,5 is not allowed"));
  for (const char *good : {"5", "-0.5", "1e2"})
    EXPECT_EQ(refusal_after_signal(start + "BA_ \"GenSigStartValue\" SG_ 1 S " + good + ";"),
              "no error");
  EXPECT_EQ(refusal_after_signal(start + "BA_DEF_DEF_ \"GenSigStartValue\" \"\";"), "no error");
}

TEST(DbcDatabase, NumbersThatAreTooLargeAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal_after_signal("VAL_ 1 S 99999999999999999999 \"x\" ;"),
              HasSubstr("bad.dbc:3: value 99999999999999999999 of signal S is none of 64 bits"));
  EXPECT_THAT(refusal_after_signal("BO_ 2 B: 99999999999 X"),
              HasSubstr("bad.dbc:3: message B has 99999999999 bytes; allowed: 0 to 117440505"));
  EXPECT_THAT(refusal_after_signal(" SG_ M M : 32|8@1+ (1,0) [0|0] \"\" X\n"
                                   " SG_ T m1 : 40|8@1+ (1,0) [0|0] \"\" X\n"
                                   "SG_MUL_VAL_ 1 T M 1-2, 5-3;"),
              HasSubstr("bad.dbc:5: signal T has the range 5-3; allowed: from the smaller to the "
                        "larger value"));
  EXPECT_THAT(refusal_after_signal(" SG_ T m99999999999999999999 : 40|8@1+ (1,0) [0|0] \"\" X"),
              HasSubstr("bad.dbc:3: signal T has the selection m99999999999999999999"));
}

// What canmatrix takes for something else.
TEST(DbcDatabase, OddNumbersAreRefused) {
  const std::string signal = " SG_ A : 0|8@1+ (1,0) [0|0] \"\" X\n";
  EXPECT_THAT(refusal(kMessage + " SG_ A : 0|16@2+ (1,0) [0|0] \"@1\" X\n"),
              HasSubstr("bad.dbc:2: signal A has the byte order 2; allowed: 0 (big-endian), 1 "
                        "(little-endian)"));
  EXPECT_THAT(refusal(kMessage + " SG_ A : 0|16@10+ (1,0) [0|0] \"\" X\n"),
              HasSubstr("bad.dbc:2: signal A has the byte order 10"));
  EXPECT_THAT(refusal(kMessage + signal + "VAL_ 1 A 128 \"x\" 7 \"y\" 128 \"z\" ;\n"),
              HasSubstr("bad.dbc:3: value 128 of signal A is there twice"));
  EXPECT_THAT(refusal("BO_ -1 M: 8 E\n" + signal),
              HasSubstr("bad.dbc:1: not understood: BO_ -1 M: 8 E; allowed: BO_ <id> <name>"));
  EXPECT_THAT(refusal("BO_ 0x10 M: 8 E\n" + signal),
              HasSubstr("bad.dbc:1: not understood: BO_ 0x10"));
}

// canmatrix passes over them, or gives the signal to the message of the statement before.
TEST(DbcDatabase, StatementsOfNothingAreRefused) {
  const std::string signal = " SG_ A : 0|32@1- (1,0) [0|0] \"\" X\n", more = "BO_ 2 B: 8 X\n";
  EXPECT_THAT(refusal(kMessage + signal + "SIG_VALTYPE_ 1 : 1;\n"),
              HasSubstr("bad.dbc:3: not understood: SIG_VALTYPE_ 1 : 1;"));
  EXPECT_THAT(refusal(kMessage + signal + "SIG_VALTYPE_ 1 A : ;1;\n"),
              HasSubstr("bad.dbc:3: not understood: SIG_VALTYPE_ 1 A : ;1;"));
  EXPECT_THAT(refusal(kMessage + signal + "VAL_ 1A 0 \"a\" ;\n"),
              HasSubstr("bad.dbc:3: not understood: VAL_ 1A"));
  EXPECT_EQ(refusal(kMessage + signal + "VAL_ Environment 0 \"a\" ;\n"), "no error");
  EXPECT_EQ(refusal(kMessage + signal + more + "VAL_ 1 A 0 \"a\" ;\n" + signal),
            "bad.dbc:5: signal A stands behind VAL_; allowed: behind its message and the signals "
            "of that");
  EXPECT_EQ(refusal(kMessage + signal + "CM_ \"x\";\n SG_ B : 32|8@1+ (1,0) [0|0] \"\" X\n"),
            "no error");
}

// 29 bits, and bit 31 for the extended format.
TEST(DbcDatabase, IdentifiersThatNoFrameHasAreRefused) {
  for (const char *bad :
       {"536870912", "2684354561", "4294967295", "4294967297", "99999999999999999999999"})
    EXPECT_EQ(refusal("BO_ " + std::string(bad) + " A: 8 X\n"),
              "bad.dbc:1: message A has the identifier " + std::string(bad) +
                  "; allowed: 0 to 536870911, with 2147483648 added for an extended one");
  for (const char *good : {"0", "2047", "536870911", "2147483648", "2684354559"})
    EXPECT_EQ(refusal("BO_ " + std::string(good) + " A: 8 X\n"), "no error");
  EXPECT_EQ(refusal(kMessage + "BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 X\n"), "no error");
}

// What follows in the line would be left out without a word.
TEST(DbcDatabase, OneStatementIsInALine) {
  const std::string s = "SG_ S : 0|32@1- (1,0) [0|0] \"\" X",
                    t = "SG_ T : 32|8@1+ (1,0) [0|0] \"\" X";
  EXPECT_EQ(refusal("BO_ 1 A: 8 X " + s + "\n"),
            "bad.dbc:1: SG_ follows BO_ in one line; allowed: one statement in a line");
  EXPECT_THAT(refusal(kMessage + " " + s + " " + t + "\n"),
              HasSubstr("bad.dbc:2: SG_ follows SG_"));
  EXPECT_THAT(refusal("VERSION \"\" " + kMessage), HasSubstr("bad.dbc:1: BO_ follows VERSION"));
  EXPECT_THAT(refusal("CM_ \"x\"; " + kMessage), HasSubstr("bad.dbc:1: BO_ follows CM_"));
  EXPECT_THAT(refusal_after_signal(t + "\nSIG_VALTYPE_ 1 T : 0; SIG_VALTYPE_ 1 S : 1;"),
              HasSubstr("bad.dbc:4: SIG_VALTYPE_ follows SIG_VALTYPE_"));
  EXPECT_EQ(refusal_after_signal("CM_ SG_ 1 S \"; BO_ 2\"; // BO_ 3"), "no error");
  EXPECT_EQ(refusal_after_signal("CM_ \"a\"; CM_ \"b\"; VAL_TABLE_ t 1 \"c\" ;"), "no error");
  EXPECT_THAT(refusal_after_signal("CM_ \"a\"; CM_ \"b\"; VAL_ 1 S 1 \"c\" ;"),
              HasSubstr("bad.dbc:3: VAL_ follows CM_"));
}

TEST(DbcDatabase, StatementsThatContradictEachOtherAreRefused) {
  EXPECT_THAT(refusal_after_signal("VAL_ 1 S 1 \"a\" ;\nVAL_ 1 S 2 \"b\" 1 \"c\" ;"),
              HasSubstr("bad.dbc:4: value 1 of signal S has another text already"));
  EXPECT_EQ(refusal_after_signal("VAL_ 1 S 1 \"a\" ;\nVAL_ 1 S 2 \"b\" 1 \"a\" ;"), "no error");
  EXPECT_THAT(refusal_after_signal(" SG_ M M : 32|8@1+ (1,0) [0|0] \"\" X\n"
                                   " SG_ N m1M : 40|8@1+ (1,0) [0|0] \"\" X\n"
                                   " SG_ T m1 : 48|8@1+ (1,0) [0|0] \"\" X\n"
                                   "SG_MUL_VAL_ 1 N M 1-1;\nSG_MUL_VAL_ 1 T M 1-1;\n"
                                   "SG_MUL_VAL_ 1 T N 2-2;"),
              HasSubstr("bad.dbc:8: signal T is multiplexed by M already; allowed: one multiplexer "
                        "for a signal"));
}

TEST(DbcDatabase, OneIdentifierHasOneMessage) {
  EXPECT_THAT(refusal(kMessage + kMessage),
              HasSubstr("bad.dbc:2: message 1 is there twice; first in "
                        "line 1"));
  const std::string signal = " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n";
  EXPECT_THAT(refusal(kMessage + signal + signal), HasSubstr("bad.dbc:3: signal S is there twice"));
  Database database;
  database.add_text("a.dbc", kMessage);
  EXPECT_EQ(input_error_of([&] { database.add_text("b.dbc", "BO_ 1 B: 8 X\n"); }),
            "b.dbc: message B has the identifier 001 of A in a.dbc; allowed: one message for an "
            "identifier");
}

// CANdb++ and others write files that are not quite what the format says; each of these has one
// meaning only.
TEST(DbcDatabase, HarmlessMistakesAreUnderstood) {
  Database database;
  database.add_text("odd.dbc",
                    "BO_ 1 A: 8 X\n SG_ S : 0|8@1+\n (1,0) [0|0] \"\"\n"
                    "VAL_ 1 S 0 \"Off\" 1\n\"On\"\n"
                    "VAL_ 1 Gone 0 \"Off\" ;\nVAL_ 99 Gone 0 \"Off\" ;\n"
                    "BA_ \"GenSigStartValue\" SG_ 99 Gone 5;\n"
                    "BO_ 217056256 FlagForgotten: 2 X\n// end\n");
  const Signal &read = database.messages()[0]->signals.at(0);
  ASSERT_EQ(read.choices.size(), 2U);
  EXPECT_EQ(read.choices[1].second, "On");
  EXPECT_EQ(database.find(0x0CF00400, true)->name, "FlagForgotten") << "above 7FF: extended";
}

}  // namespace
}  // namespace vericansim
