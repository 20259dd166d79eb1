// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Refused requests, on the model: RN-30 to RN-33; each code by each of its causes.
#include <algorithm>

#include "remote/model_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// How the node is when the frame comes.
enum class Before {
  kLocked,
  kUnlocked,
  kOperate,
  kProtected,
  kQueueFull,
  kBlockOpen,
  kLockedForGood
};

struct Refusal {
  const char *name;
  const char *frame;
  unsigned code;
  unsigned a;
  Before before = Before::kLocked;
};

void PrintTo(const Refusal &refusal, std::ostream *out) { *out << refusal.name; }

/// Node 3, serial 11223344, profile full.
RemoteConfig full() {
  RemoteConfig config = RemoteConfig::profile("full");
  config.serial = 0x11223344;
  return config;
}

void prepare(ModelNode &node, Before before) {
  switch (before) {
    case Before::kLocked: break;
    case Before::kUnlocked: node.unlock(); break;
    case Before::kOperate: node.hear("000#01"); break;
    case Before::kProtected:
      // Pages 3 (180..1FF) and, of page 0, rows 020..02F; reads the same.
      node.user_write(0xF08, {0x08, 0, 0, 0, 0x04});
      node.user_write(0xF10, {0x08, 0, 0, 0, 0x04});
      break;
    case Before::kQueueFull:
      for (int i = 0; i < 4; ++i) node.hear("1A0#R1");
      break;
    case Before::kBlockOpen: node.hear("1FA#027700031000"); break;
    case Before::kLockedForGood: node.hear("1FC#03"); break;
  }
}

// Section 4, the table of codes, row by row.
const Refusal kRefusals[] = {
    // 1, illegal function
    {"Port7D", "1FD#00", 1, 0x7D},
    {"Port7DByRemoteFrame", "1FD#R1", 1, 0x7D},
    {"RemoteFrameToRead", "1F8#R3", 1, 0x78},
    {"RemoteFrameToWrite", "1F9#R3", 1, 0x79},
    {"RemoteFrameToBlock", "1FA#R6", 1, 0x7A},
    {"RemoteFrameToData", "1FB#R2", 1, 0x7B},
    {"RemoteFrameToSetup", "1FC#R1", 1, 0x7C},
    {"DataFrameToStatus", "1FE#00", 1, 0x7E},
    {"DataFrameToIdent", "1FF#00", 1, 0x7F},
    {"FunctionBeforeValue", "1FD#", 1, 0x7D},
    // 3, illegal value
    {"WriteOfNothing", "1A0#", 3, 0x20},
    {"WriteDlc9", "1A0#0102030405060708_9", 3, 0x20},
    {"WriteDlc15", "1A0#0102030405060708_F", 3, 0x20},
    {"ReadOfNothing", "1A0#R", 3, 0x20},
    {"ReadDlc9", "1A0#R8_9", 3, 0x20},
    {"ReadPortTooShort", "1F8#2000", 3, 0x78},
    {"ReadPortTooLong", "1F8#20000100", 3, 0x78},
    {"ReadPortNothing", "1F8#200000", 3, 0x78},
    {"ReadPortSeven", "1F8#200007", 3, 0x78},
    {"WritePortWithoutBytes", "1F9#2000", 3, 0x79},
    {"WritePortDlc9", "1F9#2000030405060708_9", 3, 0x79},
    {"BlockTooShort", "1FA#0177000310", 3, 0x7A},
    {"BlockTooLong", "1FA#0177000310000000", 3, 0x7A},
    {"BlockUnknownOp", "1FA#037700031000", 3, 0x7A},
    {"BlockReadOfNothing", "1FA#017700030000", 3, 0x7A},
    {"BlockWriteOfNothing", "1FA#027700030000", 3, 0x7A},
    {"DataTooShort", "1FB#00", 3, 0x7B},
    {"SetupOfNothing", "1FC#", 3, 0x7C},
    {"SetupOp0", "1FC#00", 3, 0x7C},
    {"SetupOp5", "1FC#05", 3, 0x7C},
    {"UnlockTooShort", "1FC#01443322", 3, 0x7C},
    {"UnlockTooLong", "1FC#014433221100", 3, 0x7C},
    {"LockTooLong", "1FC#0200", 3, 0x7C},
    {"StatusOfNothing", "1FE#R", 3, 0x7E},
    {"StatusDlc9", "1FE#R8_F", 3, 0x7E},
    {"IdentOfNothing", "1FF#R", 3, 0x7F},
    {"ValueBeforeAddress", "1F9#00FF", 3, 0x79},
    // 2, illegal address
    {"WriteAcrossTheWindow", "1F7#0102", 2, 0x77},
    {"ReadAcrossTheWindow", "1F7#R2", 2, 0x77},
    {"ReadHidden", "1F8#000E01", 2, 0x78},
    {"ReadIntoHidden", "1F8#FF0D02", 2, 0x78},
    {"ReadLastHidden", "1F8#FF0E01", 2, 0x78},
    {"ReadOutOfHidden", "1F8#FF0E02", 2, 0x78},
    {"ReadReserved", "1F8#200F01", 2, 0x78},
    {"ReadIntoReserved", "1F8#1F0F02", 2, 0x78},
    {"ReadLastReserved", "1F8#E70F01", 2, 0x78},
    {"ReadWrap", "1F8#FF0F02", 2, 0x78},
    {"ReadBeyond4096", "1F8#001001", 2, 0x78},
    {"WriteHidden", "1F9#000E00", 2, 0x79},
    {"WriteIntoHidden", "1F9#FF0D0000", 2, 0x79},
    {"WriteReserved", "1F9#C00F00", 2, 0x79, Before::kUnlocked},
    {"WriteIntoReserved", "1F9#BF0F0000", 2, 0x79, Before::kUnlocked},
    {"WriteWrap", "1F9#FF0F0000", 2, 0x79},
    {"WriteBeyond4096", "1F9#001000", 2, 0x79},
    {"AddressBeforeLock", "1F9#1F0F0000", 2, 0x79},
    // 11, locked
    {"WriteConfig", "1F9#000F03", 0x11, 0x79},
    {"WriteLabel", "1F9#1F0F03", 0x11, 0x79},
    {"WriteProducers", "1F9#400F00", 0x11, 0x79},
    {"WriteMaps", "1F9#BF0F00", 0x11, 0x79},
    {"WriteConfigInOperate", "1F9#000F03", 0x11, 0x79, Before::kOperate},
    {"UnlockWithAWrongKey", "1FC#0144332212", 0x11, 0x7C},
    {"UnlockInOperate", "1FC#0144332211", 0x11, 0x7C, Before::kOperate},
    {"UnlockAfterLockUntilReset", "1FC#0144332211", 0x11, 0x7C, Before::kLockedForGood},
    // 10, protected
    {"WriteStatus", "1F9#F00F00", 0x10, 0x79},
    {"WriteIdent", "1F9#FF0F00", 0x10, 0x79, Before::kUnlocked},
    {"WriteCounters", "1F9#E80F00", 0x10, 0x79},
    {"WritePage", "1F9#800100", 0x10, 0x79, Before::kProtected},
    {"WriteIntoPage", "1F9#7F010000", 0x10, 0x79, Before::kProtected},
    {"WriteOutOfPage", "1F9#FF010000", 0x10, 0x79, Before::kProtected},
    {"WriteRow", "1A0#00", 0x10, 0x20, Before::kProtected},
    {"WriteIntoRow", "19F#0000", 0x10, 0x1F, Before::kProtected},
    {"WriteOutOfRow", "1AF#0000", 0x10, 0x2F, Before::kProtected},
    {"ReadRow", "1A0#R1", 0x10, 0x20, Before::kProtected},
    {"ReadOutOfRow", "1AF#R2", 0x10, 0x2F, Before::kProtected},
    {"ReadPage", "1F8#FF0101", 0x10, 0x78, Before::kProtected},
    {"ReadIntoPage", "1F8#7F0102", 0x10, 0x78, Before::kProtected},
    // 6, busy
    {"DirectReadQueueFull", "1A0#R1", 6, 0x20, Before::kQueueFull},
    {"ReadQueueFull", "1F8#200001", 6, 0x78, Before::kQueueFull},
    {"StatusQueueFull", "1FE#R1", 6, 0x7E, Before::kQueueFull},
    {"IdentQueueFull", "1FF#R1", 6, 0x7F, Before::kQueueFull},
    {"BlockQueueFull", "1FA#017700031000", 6, 0x7A, Before::kQueueFull},
    {"BlockWhileOneRuns", "1FA#017800031000", 6, 0x7A, Before::kBlockOpen},
    // 12
    {"DataWithoutABlockWrite", "1FB#0000", 0x12, 0x7B},
};

class EveryRefusal : public ::testing::TestWithParam<Refusal> {};

// RN-30, RN-31, RN-32: the code stands in STATUS, one STATUS frame follows, nothing is written.
TEST_P(EveryRefusal, HasItsCodeAndChangesNothing) {
  const Refusal &refusal = GetParam();
  ModelNode node{full()};
  node.started();
  prepare(node, refusal.before);
  const auto memory = node.bytes(0, 0xFE0);
  const auto status = node.model.status();
  node.hear(refusal.frame);
  EXPECT_EQ(node.last(), std::pair(refusal.code, refusal.a));
  EXPECT_EQ(node.model.status().refused, status.refused + 1);
  EXPECT_EQ(node.model.status().accepted, status.accepted);
  EXPECT_EQ(node.bytes(0, 0xFE0), memory);
  const Texts said = node.drain();
  EXPECT_EQ(std::count_if(said.begin(), said.end(),
                          [](const std::string &text) { return text.starts_with("5FE#"); }),
            1)
      << ::testing::PrintToString(said);
}

// RN-30: the same to all nodes is counted, and no STATUS follows.
TEST_P(EveryRefusal, ToAllIsNotAnswered) {
  Frame frame = frame_of(GetParam().frame);
  ModelNode node{full()};
  node.started();
  prepare(node, GetParam().before);
  (void)node.drain();
  if (GetParam().before == Before::kQueueFull) prepare(node, Before::kQueueFull);
  const auto refused = node.model.status().refused;
  frame.id = (frame.id & ~0x180U) | 0x080U;
  node.model.receive(frame);
  EXPECT_EQ(node.model.status().refused, refused + 1);
  for (const std::string &text : node.drain()) EXPECT_FALSE(text.starts_with("5FE#")) << text;
}

INSTANTIATE_TEST_SUITE_P(Codes, EveryRefusal, ::testing::ValuesIn(kRefusals),
                         [](const auto &test) { return std::string{test.param.name}; });

}  // namespace
}  // namespace vericansim
