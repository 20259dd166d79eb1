// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client on models of nodes: settings behind the lock (RN-61, RN-90, RN-91).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/model_client.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

class ClientConfigure : public ModelClientTest {
 protected:
  /// From the frame on that `begins` tells, which node 3 still gets, the host hears nothing.
  void lose_answers_from(std::function<bool(const Frame &)> begins) {
    bus.filter = [this, begins, lost = false](const RemoteModel *to, const Frame &frame) mutable {
      lost = lost || (to == &bus.node(0) && begins(frame));
      return to != nullptr || !lost;
    };
  }
};

// RN-61: configure unlocks, writes and locks again, also after a refusal.
TEST_F(ClientConfigure, UnlocksWritesAndLocks) {
  const verican_remote_setting_t good[] = {{0xF02, 2, {0x14, 0}}, {0xF18, 4, {'p', 'f', 'c', 0}}};
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1233, good, 2), VERICAN_REMOTE_OK);
  EXPECT_THAT(read(3, 0xF02, 2), ElementsAre(0x14, 0));
  EXPECT_THAT(read(3, 0xF18, 3), ElementsAre('p', 'f', 'c'));
  EXPECT_FALSE(bus.node(0).status().unlocked);
  const verican_remote_setting_t bad[] = {{0xF30, 1, {0}}, {0xF02, 1, {0x15}}};
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1233, bad, 2), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
  EXPECT_FALSE(bus.node(0).status().unlocked);
  EXPECT_THAT(read(3, 0xF02, 1), ElementsAre(0x14));
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1234, good, 2), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_LOCKED);
}

// RN-61: UNLOCK was carried out, and nobody hears of it.
TEST_F(ClientConfigure, LocksThoughUnlockIsNotConfirmed) {
  const verican_remote_setting_t setting = {0xF02, 1, {0x14}};
  bool unlocked = false;
  lose_answers_from([&](const Frame &frame) {
    const bool now = frame.id == 0x1FC && frame.data[0] == 1;
    unlocked = unlocked || now;
    return now;
  });
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1233, &setting, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_TRUE(unlocked);
  EXPECT_EQ(bus.take_sent().back(), "1FC#02");
  EXPECT_FALSE(bus.node(0).status().unlocked);
}

// RN-91: the refusal of a setting is told, not what comes of the lock behind it.
TEST_F(ClientConfigure, TheFirstErrorIsTold) {
  const verican_remote_setting_t bad = {0xFF0, 1, {1}};
  int requests = -100;  // for the counts; behind the write one confirms it, the next is the lock's
  lose_answers_from([&](const Frame &frame) {
    if (frame.id == 0x1F9) requests = 0;
    return frame.id == 0x1F8 && ++requests == 2;
  });
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1233, &bad, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_PROTECTED);
  EXPECT_EQ(bus.take_sent().back(), "1FC#02");
  EXPECT_FALSE(bus.node(0).status().unlocked);
}

// A node that is not there is not sent UNLOCK, nor LOCK.
TEST_F(ClientConfigure, NothingIsSentToANodeThatIsNotThere) {
  EXPECT_EQ(verican_remote_configure(&client, 2, 0xCAFE1233, nullptr, 0), VERICAN_REMOTE_TIMEOUT);
  EXPECT_THAT(bus.take_sent(), ElementsAre("178#F20F06", "178#F20F06", "178#F20F06"));
}

}  // namespace
}  // namespace vericansim
