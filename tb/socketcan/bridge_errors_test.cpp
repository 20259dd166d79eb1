// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketCAN's error messages, for errors made on the simulated bus. What is expected comes from the
// rule book (which error, where) and from linux/can/error.h (its bits).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "socketcan/bridge_rig.hpp"

namespace vericansim::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr NodeId kNode = 0, kPort = 2;  // two plain nodes, so that one can acknowledge the other
constexpr Frame kBase{.id = 0x555, .dlc = 2, .data = {0x55, 0x55}};
constexpr Frame kExtended{.id = 0x15555555, .extended = true, .dlc = 1, .data = {0x55}};

/// A disturbed bit, once, as its victim sees it, in the first frame that it sends or receives.
struct Disturbance {
  std::string name;
  bool sends = true;  ///< the port's node is the transmitter
  Frame frame = kBase;
  Field field = Field::kData;
  unsigned index = 0;
  std::uint8_t kinds = 0;  ///< data[2]
  std::uint8_t place = 0;  ///< data[3]
  canid_t extra = 0;       ///< classes besides PROT, BUSERROR and CNT
};

std::ostream &operator<<(std::ostream &out, const Disturbance &d) { return out << d.name; }

FaultSpec fault_at(Field field, unsigned index) {
  FaultSpec fault;
  fault.kind = FaultSpec::Kind::kPlace;
  fault.watched = fault.node = kPort;
  fault.place = {.frame = 1, .field = field, .index = index, .stuff = false};
  return fault;
}

TrafficSpec one_frame(const Frame &frame) {
  TrafficSpec spec;
  spec.node = kNode;
  spec.name = "one";
  spec.frame = frame;
  spec.offset = kMillisecond;
  return spec;
}

class ErrorKinds : public ::testing::TestWithParam<Disturbance> {};

// ED-01 to ED-16: each kind of error at its place, as transmitter and as receiver.
TEST_P(ErrorKinds, IsTheMessageOfErrorH) {
  const Disturbance &d = GetParam();
  RigOptions options{.faults = {fault_at(d.field, d.index)}};
  if (!d.sends) options.traffic = {one_frame(d.frame)};
  BridgeRig rig{options};
  if (d.sends) rig.port(0).send(d.frame);
  ASSERT_TRUE(rig.run_until([&] { return !rig.port(0).errors().empty(); }, kSecond));
  const can_frame message = rig.port(0).errors().front();
  EXPECT_EQ(message.can_id, CAN_ERR_FLAG | CAN_ERR_PROT | CAN_ERR_BUSERROR | CAN_ERR_CNT | d.extra);
  EXPECT_EQ(message.len, CAN_ERR_DLC);
  EXPECT_EQ(message.data[0], 0);
  EXPECT_EQ(message.data[1], 0);
  EXPECT_EQ(message.data[2], d.kinds);
  EXPECT_EQ(message.data[3], d.place);
  EXPECT_EQ(message.data[6], d.sends ? 8 : 0);  // FC-05
  EXPECT_EQ(message.data[7], d.sends ? 0 : 1);  // FC-02
  // RO-03: the frame gets through after all.
  EXPECT_TRUE(rig.run_until(
      [&] { return d.sends ? rig.bridge().simulation().quiet() : !rig.port(0).frames().empty(); }));
}

constexpr std::uint8_t kTx = CAN_ERR_PROT_TX;
constexpr std::uint8_t kBit0 = CAN_ERR_PROT_BIT0, kBit1 = CAN_ERR_PROT_BIT1;
constexpr std::uint8_t kForm = CAN_ERR_PROT_FORM;

// 0x555 is 10101010101, 0x55 is 01010101: the second bit is the opposite of the first.
const std::vector<Disturbance> kTransmitter{
    {"Sof", true, kBase, Field::kSof, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_SOF},
    {"Id27", true, kBase, Field::kId, 1, kBit0 | kTx, CAN_ERR_PROT_LOC_ID28_21},
    {"Id21", true, kBase, Field::kId, 7, kBit0 | kTx, CAN_ERR_PROT_LOC_ID28_21},
    {"Id19", true, kBase, Field::kId, 9, kBit0 | kTx, CAN_ERR_PROT_LOC_ID20_18},
    {"Rtr", true, kBase, Field::kRtr, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_SRTR},
    {"Ide", true, kBase, Field::kIde, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_IDE},
    {"R0", true, kBase, Field::kR0, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_RES0},
    {"Dlc", true, kBase, Field::kDlc, 1, kBit0 | kTx, CAN_ERR_PROT_LOC_DLC},
    {"Data0", true, kBase, Field::kData, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_DATA},
    {"Data1", true, kBase, Field::kData, 1, kBit1 | kTx, CAN_ERR_PROT_LOC_DATA},
    // ID17..ID0 of 0x15555555 are 01 0101 0101 0101 0101.
    {"Id17", true, kExtended, Field::kExId, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_ID17_13},
    {"Id13", true, kExtended, Field::kExId, 4, kBit0 | kTx, CAN_ERR_PROT_LOC_ID17_13},
    {"Id11", true, kExtended, Field::kExId, 6, kBit0 | kTx, CAN_ERR_PROT_LOC_ID12_05},
    {"Id5", true, kExtended, Field::kExId, 12, kBit0 | kTx, CAN_ERR_PROT_LOC_ID12_05},
    {"Id3", true, kExtended, Field::kExId, 14, kBit0 | kTx, CAN_ERR_PROT_LOC_ID04_00},
    {"LastRtr", true, kExtended, Field::kExRtr, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_RTR},
    {"R1", true, kExtended, Field::kR1, 0, kBit0 | kTx, CAN_ERR_PROT_LOC_RES1},
    // AK-03: the slot stays recessive for the transmitter.
    {"Ack", true, kBase, Field::kAck, 0, kTx, CAN_ERR_PROT_LOC_ACK, CAN_ERR_ACK},
};

const std::vector<Disturbance> kReceiver{
    // A bit of the data that only this node sees: the checksum differs, told at the delimiter.
    {"Crc", false, kBase, Field::kData, 5, 0, CAN_ERR_PROT_LOC_CRC_SEQ},
    // ED-07: its own acknowledge is recessive for it.
    {"OwnAck", false, kBase, Field::kAck, 0, kBit0, CAN_ERR_PROT_LOC_ACK},
    // ED-09.
    {"CrcDelimiter", false, kBase, Field::kCrcDel, 0, kForm, CAN_ERR_PROT_LOC_CRC_DEL},
    {"AckDelimiter", false, kBase, Field::kAckDel, 0, kForm, CAN_ERR_PROT_LOC_ACK_DEL},
    {"Eof", false, kBase, Field::kEof, 2, kForm, CAN_ERR_PROT_LOC_EOF},
};

std::string name_of(const ::testing::TestParamInfo<Disturbance> &info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Transmitter, ErrorKinds, ::testing::ValuesIn(kTransmitter), name_of);
INSTANTIATE_TEST_SUITE_P(Receiver, ErrorKinds, ::testing::ValuesIn(kReceiver), name_of);

// ST-06: a stuff bit that is missing for a receiver.
TEST(ErrorMessagesOnTheBus, StuffError) {
  FaultSpec fault = fault_at(Field::kData, 0);
  fault.place.index.reset();
  fault.place.stuff = true;
  BridgeRig rig{{.faults = {fault}, .traffic = {one_frame({.id = 0x555, .dlc = 8})}}};
  ASSERT_TRUE(rig.run_until([&] { return !rig.port(0).errors().empty(); }, kSecond));
  const can_frame message = rig.port(0).errors().front();
  EXPECT_EQ(message.data[2], CAN_ERR_PROT_STUFF);
  EXPECT_EQ(message.data[3], CAN_ERR_PROT_LOC_DATA);
}

// EF-06: a bit error in the own error flag has no place in error.h, but is an active announcement.
TEST(ErrorMessagesOnTheBus, BitErrorInTheErrorFlag) {
  FaultSpec in_flag = fault_at(Field::kErrFlag, 2);
  BridgeRig rig{{.faults = {fault_at(Field::kData, 1), in_flag}}};
  rig.port(0).send(kBase);
  ASSERT_TRUE(rig.run_until([&] { return rig.port(0).errors().size() >= 2; }, kSecond));
  const can_frame message = rig.port(0).errors()[1];
  EXPECT_EQ(message.data[2], kBit0 | CAN_ERR_PROT_ACTIVE | kTx);
  EXPECT_EQ(message.data[3], CAN_ERR_PROT_LOC_UNSPEC);
  EXPECT_EQ(message.data[6], 16);  // FC-06
}

// ---- Lost arbitration

/// The first bit in which two frames differ, and its number with SOF as 0 and without stuff bits.
struct Contest {
  std::string name;
  Frame loser, winner;
  std::uint8_t bit;
};

std::ostream &operator<<(std::ostream &out, const Contest &c) { return out << c.name; }

class LostArbitration : public ::testing::TestWithParam<Contest> {};

// AR-02, AR-06.
TEST_P(LostArbitration, TellsTheBit) {
  BridgeRig rig{{.ports = 2}};
  // Taken in the same round by nodes in step, so they start together.
  rig.port(0).send(GetParam().loser);
  rig.port(1).send(GetParam().winner);
  ASSERT_TRUE(rig.run_until([&] { return !rig.port(0).errors().empty(); }, kSecond));
  EXPECT_THAT(rig.port(0).errors(), SizeIs(1));
  const can_frame message = rig.port(0).errors().front();
  EXPECT_EQ(message.can_id, CAN_ERR_FLAG | CAN_ERR_LOSTARB | CAN_ERR_CNT);
  EXPECT_EQ(message.data[0], GetParam().bit);
  EXPECT_EQ(message.data[6] + message.data[7], 0);  // FC-15
  EXPECT_TRUE(rig.run_until([&] { return !rig.port(1).frames().empty(); }));
  EXPECT_THAT(rig.port(0).frames(), ElementsAre(GetParam().winner));
  EXPECT_THAT(rig.port(1).frames(), ElementsAre(GetParam().loser));
  EXPECT_THAT(rig.port(1).errors(), IsEmpty());
}

std::vector<Contest> contests() {
  const Frame base{.id = 0x2AA, .dlc = 1, .data = {1}};
  const Frame remote{.id = 0x2AA, .remote = true, .dlc = 1};
  const Frame extended{.id = 0x2AA << 18, .extended = true, .dlc = 1, .data = {2}};
  Frame extended_remote = extended;
  extended_remote.remote = true;
  extended_remote.data = {};
  std::vector<Contest> list{{"Srr", extended, base, 12},
                            {"Rtr", remote, base, 12},
                            {"Ide", extended, remote, 13},
                            {"LastRtr", extended_remote, extended, 32}};
  for (std::uint8_t bit = 1; bit <= 11; ++bit) {
    Frame loser{.id = 0x7FF, .dlc = 1, .data = {3}}, winner = loser;
    winner.id &= ~(1U << (11 - bit));
    winner.data[0] = 4;
    list.push_back({"Base" + std::to_string(bit), loser, winner, bit});
  }
  for (std::uint8_t bit = 14; bit <= 31; ++bit) {
    Frame loser{.id = 0x1FFFFFFF, .extended = true, .dlc = 1, .data = {3}}, winner = loser;
    winner.id &= ~(1U << (31 - bit));
    winner.data[0] = 4;
    list.push_back({"Extended" + std::to_string(bit), loser, winner, bit});
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(Bits, LostArbitration, ::testing::ValuesIn(contests()),
                         [](const auto &contest) { return contest.param.name; });

// ---- States

/// data[1], TEC and REC of the messages about the controller's state.
std::vector<std::vector<int>> states(const FakePort &port) {
  std::vector<std::vector<int>> result;
  for (const can_frame &message : port.errors(CAN_ERR_CRTL))
    result.push_back({message.data[1], message.data[6], message.data[7]});
  return result;
}

// FC-18: a node that nobody acknowledges reaches TEC 96 and 128 and stays there; when its cable is
// whole again, each frame sent lowers TEC by one (FC-09): below 128, and below 96.
TEST(ErrorMessagesOnTheBus, TransmitterStates) {
  FaultSpec cut;
  cut.kind = FaultSpec::Kind::kCut;
  cut.node = kPort;
  cut.window = {0, 20 * kMillisecond};
  BridgeRig rig{{.faults = {cut}}};
  for (unsigned i = 0; i < 40; ++i) rig.port(0).send(kBase);
  ASSERT_TRUE(rig.run_until([&] { return states(rig.port(0)).size() == 4; }));
  EXPECT_THAT(states(rig.port(0)), ElementsAre(ElementsAre(CAN_ERR_CRTL_TX_WARNING, 96, 0),
                                               ElementsAre(CAN_ERR_CRTL_TX_PASSIVE, 128, 0),
                                               ElementsAre(CAN_ERR_CRTL_TX_WARNING, 127, 0),
                                               ElementsAre(CAN_ERR_CRTL_ACTIVE | 0, 95, 0)));
}

// FC-02, FC-04: a receiver that alone misses each stuff bit signals first and sees a dominant bit
// after its flag: REC rises by 9 a frame, to 99 and, after 127, to 135 (FC-14: 128 and more).
TEST(ErrorMessagesOnTheBus, ReceiverStates) {
  FaultSpec fault = fault_at(Field::kData, 0);
  fault.place = {.field = Field::kData, .stuff = true};
  BridgeRig rig{{.faults = {fault}, .traffic = {one_frame({.id = 0x555, .dlc = 8})}}};
  ASSERT_TRUE(rig.run_until([&] { return states(rig.port(0)).size() == 2; }, kSecond));
  EXPECT_THAT(states(rig.port(0)),
              ElementsAre(ElementsAre(CAN_ERR_CRTL_RX_WARNING, 0, 99),
                          ElementsAre(CAN_ERR_CRTL_RX_PASSIVE, 0, ::testing::Ge(128))));
}

// ---- Bus-off

constexpr Time kBit = 2 * kMicrosecond;
// FC-20: 16 starts, each with a flag in which every bit is an error. Recovery takes longer.
constexpr Time kOffBy = 3 * kMillisecond / 2;

/// The port's node does not see its own dominant bits from `begin` until `end`: FC-20, bus-off.
FaultSpec deaf(Time begin, Time end) {
  FaultSpec fault;
  fault.kind = FaultSpec::Kind::kLevel;
  fault.effect = Effect::kRecessive;
  fault.node = kPort;
  fault.window = {begin, end};
  return fault;
}

FaultSpec deaf_until(Time end) { return deaf(0, end); }

/// When the messages that have all bits of `classes` came.
std::vector<Time> times_of(const FakePort &port, canid_t classes) {
  std::vector<Time> times;
  for (const PortMessage &message : port.got)
    if ((message.frame.can_id & CAN_ERR_FLAG) != 0 && (message.frame.can_id & classes) == classes)
      times.push_back(message.time);
  return times;
}

// FC-13, BO-02, BO-05: bus-off, then restart after the time asked and 128 times 11 recessive bits,
// of which those during the wait count; frames wait meanwhile and go out in order.
TEST(ErrorMessagesOnTheBus, BusOffAndRestart) {
  for (const Time restart : {kMillisecond, 50 * kMillisecond}) {
    BridgeRig rig{{.options = {.restart = restart}, .faults = {deaf_until(kOffBy)}}};
    for (unsigned i = 0; i < 30; ++i) rig.port(0).send(numbered_frame(i));
    rig.port(0).echo = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.port(0).echoes().size() == 30; }));
    for (unsigned i = 0; i < 30; ++i) EXPECT_EQ(rig.port(0).echoes()[i], numbered_frame(i));
    ASSERT_THAT(rig.port(0).errors(CAN_ERR_BUSOFF), SizeIs(1));
    ASSERT_THAT(rig.port(0).errors(CAN_ERR_RESTARTED), SizeIs(1));
    const can_frame off = rig.port(0).errors(CAN_ERR_BUSOFF).front();
    EXPECT_EQ(off.can_id & CAN_ERR_CNT, 0U);  // a counter of 256 has no place in a byte
    const can_frame back = rig.port(0).errors(CAN_ERR_RESTARTED).front();
    EXPECT_EQ(back.can_id, CAN_ERR_FLAG | CAN_ERR_RESTARTED | CAN_ERR_CNT);
    EXPECT_EQ(back.data[6] + back.data[7], 0);
    const Time took =
        times_of(rig.port(0), CAN_ERR_RESTARTED)[0] - times_of(rig.port(0), CAN_ERR_BUSOFF)[0];
    const Time recovery = 128 * 11 * kBit;
    EXPECT_GE(took, std::max(restart, recovery));
    EXPECT_LE(took, std::max(restart, recovery) + 30 * kBit);
    EXPECT_EQ(rig.bridge().finish().ports[0].counts.bus_off, 1U);
  }
}

// Without a time the node stays bus-off, also against the programs' wishes, until the user restarts
// it or the interface comes up again.
TEST(ErrorMessagesOnTheBus, BusOffUntilTold) {
  for (const bool by_signal : {true, false}) {
    BridgeRig rig{{.options = {.restart = 0}, .faults = {deaf_until(kOffBy)}}};
    rig.port(0).send(kBase);
    ASSERT_TRUE(
        rig.run_until([&] { return !rig.port(0).errors(CAN_ERR_BUSOFF).empty(); }, kSecond));
    rig.port(0).send(kExtended);
    for (unsigned rounds = 0; rounds < 50; ++rounds) rig.bridge().round();
    EXPECT_THAT(rig.port(0).errors(CAN_ERR_RESTARTED), IsEmpty());
    EXPECT_GT(rig.wall.endless_waits, 0U);  // nothing is to do, so nothing spins
    rig.wall.restart = by_signal;
    rig.port(0).is_up = by_signal;
    rig.bridge().round();
    rig.port(0).is_up = true;
    rig.bridge().round();
    rig.port(0).echo = true;
    EXPECT_TRUE(rig.run_until([&] { return rig.port(0).echoes().size() == 2; }));
    EXPECT_THAT(rig.port(0).errors(CAN_ERR_RESTARTED), SizeIs(1));
    EXPECT_THAT(rig.port(0).echoes(), ElementsAre(kBase, kExtended));
  }
}

// BO-05: the time to the restart is counted from each bus-off anew, also when the user was faster
// than the time after the one before.
TEST(ErrorMessagesOnTheBus, EachBusOffWaitsForItsOwnTime) {
  constexpr Time kRestart = 200 * kMillisecond, kAgain = 20 * kMillisecond;
  constexpr Time kDeaf = 5 * kMillisecond;  // enough beside the beats
  BridgeRig rig{{.options = {.restart = kRestart},
                 .faults = {deaf_until(kDeaf), deaf(kAgain, kAgain + kDeaf)},
                 .traffic = {beat(kMillisecond)}}};
  const auto off = [&] { return times_of(rig.port(0), CAN_ERR_BUSOFF); };
  const auto restarted = [&] { return times_of(rig.port(0), CAN_ERR_RESTARTED); };
  rig.port(0).send(kBase);
  ASSERT_TRUE(rig.run_until([&] { return off().size() == 1; }));
  rig.wall.restart = true;
  ASSERT_TRUE(rig.run_until([&] { return restarted().size() == 1; }));
  EXPECT_LT(restarted()[0], kAgain);
  ASSERT_TRUE(rig.run_until([&] { return rig.bridge().elapsed() > kAgain; }));
  rig.port(0).send(kExtended);
  ASSERT_TRUE(rig.run_until([&] { return restarted().size() == 2; }));
  ASSERT_THAT(off(), SizeIs(2));
  EXPECT_GE(restarted()[1] - off()[1], kRestart);
  EXPECT_LE(restarted()[1] - off()[1], kRestart + kMillisecond);
}

// ---- Choice, monitor

TEST(ErrorMessagesOnTheBus, ChoiceOfMessages) {
  for (const ErrorChoice choice : {ErrorChoice::kNone, ErrorChoice::kState}) {
    BridgeRig rig{
        {.options = {.errors = choice, .restart = kMillisecond}, .faults = {deaf_until(kOffBy)}}};
    rig.port(0).echo = true;
    rig.port(0).send(kBase);
    ASSERT_TRUE(rig.run_until([&] { return !rig.port(0).echoes().empty(); }));
    if (choice == ErrorChoice::kNone) {
      EXPECT_THAT(rig.port(0).errors(), IsEmpty());
    } else {
      // Warning, passive, bus-off, restarted; no message for each of the 32 errors.
      EXPECT_THAT(rig.port(0).errors(), SizeIs(4));
      EXPECT_THAT(rig.port(0).errors(CAN_ERR_PROT), IsEmpty());
    }
  }
}

// A monitor hears of error frames: what a listener can say of them, and where.
TEST(ErrorMessagesOnTheBus, MonitorSeesErrorFrames) {
  BridgeRig rig{{.monitor = true, .faults = {fault_at(Field::kAckDel, 0)}}};
  rig.port(0).send(kBase);
  ASSERT_TRUE(rig.run_until([&] { return !rig.monitor().frames().empty(); }));
  ASSERT_THAT(rig.monitor().errors(), SizeIs(1));
  // Its own flag begins in the next bit, and is a dominant EOF1 to all others.
  const can_frame message = rig.monitor().errors().front();
  EXPECT_EQ(message.can_id, CAN_ERR_FLAG | CAN_ERR_PROT | CAN_ERR_BUSERROR);
  EXPECT_EQ(message.data[2], CAN_ERR_PROT_FORM);
  EXPECT_EQ(message.data[3], CAN_ERR_PROT_LOC_EOF);
  EXPECT_THAT(rig.monitor().frames(), ElementsAre(kBase));
}

}  // namespace
}  // namespace vericansim::test
