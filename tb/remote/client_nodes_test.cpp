// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client on models of nodes: who is there, and block transfers (RN-26, RN-40 to RN-43,
// RN-90).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "remote/model_client.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

class ClientNodes : public ModelClientTest {
 protected:
  /// Serial numbers, or numbers, of a scan.
  std::vector<std::pair<unsigned, std::uint32_t>> scan(std::size_t places = 20) {
    std::vector<verican_remote_identity_t> nodes(places);
    EXPECT_EQ(verican_remote_scan(&client, nodes.data(), &places), VERICAN_REMOTE_OK);
    std::vector<std::pair<unsigned, std::uint32_t>> found;
    for (std::size_t i = 0; i < places; ++i) found.emplace_back(nodes[i].number, nodes[i].serial);
    return found;
  }
  void add_new(std::uint32_t serial, unsigned number = 0) {
    RemoteConfig config = RemoteConfig::profile("small");
    config.serial = serial;
    bus.add(config, number);
  }
  /// The serial numbers of which a scan says that their number is another node's, too.
  std::vector<std::uint32_t> doubled() {
    std::vector<verican_remote_identity_t> nodes(20);
    std::size_t count = nodes.size();
    EXPECT_EQ(verican_remote_scan(&client, nodes.data(), &count), VERICAN_REMOTE_OK);
    std::vector<std::uint32_t> serials;
    for (std::size_t i = 0; i < count; ++i)
      if (nodes[i].doubled) serials.push_back(nodes[i].serial);
    return serials;
  }
};

// RN-23, RN-26: nodes with and without a number; serial numbers that differ in one bit.
TEST_F(ClientNodes, ScanFindsEveryNode) {
  EXPECT_THAT(scan(), ElementsAre(std::pair(3U, 0xCAFE1233U), std::pair(4U, 0xCAFE1234U),
                                  std::pair(5U, 0xCAFE1235U)));
  for (const std::uint32_t serial :
       {0xFFFFFFFFU, 0x00000000U, 0x12345678U, 0x12345679U, 0x92345678U, 0xFFFFFFFEU, 0x00000001U})
    add_new(serial);
  const auto found = scan();
  ASSERT_EQ(found.size(), 10U);
  EXPECT_EQ(found[3], std::pair(0U, 0x00000000U));
  EXPECT_EQ(found[4], std::pair(0U, 0x00000001U));
  EXPECT_EQ(found[5], std::pair(0U, 0x12345678U));
  EXPECT_EQ(found[6], std::pair(0U, 0x12345679U));
  EXPECT_EQ(found[7], std::pair(0U, 0x92345678U));
  EXPECT_EQ(found[8], std::pair(0U, 0xFFFFFFFEU));
  EXPECT_EQ(found[9], std::pair(0U, 0xFFFFFFFFU));
  EXPECT_EQ(scan(5).size(), 5U);
  EXPECT_EQ(scan(2).size(), 2U);
}

// RN-11, RN-26: nodes that share a number are found by their serial numbers, whether their answers
// destroy each other or come one after the other.
TEST_F(ClientNodes, ScanFindsNodesThatShareANumber) {
  add_new(0x12345678, 5);
  add_new(0x00000001);
  for (const bool collides : {true, false}) {
    bus.collides = collides;
    EXPECT_THAT(scan(), ElementsAre(std::pair(3U, 0xCAFE1233U), std::pair(4U, 0xCAFE1234U),
                                    std::pair(5U, 0x12345678U), std::pair(5U, 0xCAFE1235U),
                                    std::pair(0U, 0x00000001U)));
    EXPECT_THAT(doubled(), ElementsAre(0x12345678U, 0xCAFE1235U));
  }
}

// RN-11: with several shared numbers nobody can say which node has which.
TEST_F(ClientNodes, ScanOfSeveralSharedNumbers) {
  bus.collides = true;
  add_new(0x12345678, 5);
  add_new(0x12345679, 4);
  constexpr unsigned kUnknown = VERICAN_REMOTE_UNKNOWN;
  EXPECT_THAT(scan(),
              ElementsAre(std::pair(3U, 0xCAFE1233U), std::pair(kUnknown, 0x12345678U),
                          std::pair(kUnknown, 0x12345679U), std::pair(kUnknown, 0xCAFE1234U),
                          std::pair(kUnknown, 0xCAFE1235U)));
  EXPECT_EQ(doubled().size(), 4U);
}

// RN-26: an answer of a node that has its number for itself is lost: SELECT finds it, and it is not
// taken for one of two.
TEST_F(ClientNodes, ScanWithALostAnswer) {
  int lost = 0;
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    const bool its = to == nullptr && frame.id == 0x678 && frame.data[0] == 0xFC;
    return !its || lost++ != 0;
  };
  EXPECT_THAT(scan(), ElementsAre(std::pair(3U, 0xCAFE1233U), std::pair(4U, 0xCAFE1234U),
                                  std::pair(5U, 0xCAFE1235U)));
  EXPECT_EQ(lost, 1);
  lost = 0;
  EXPECT_THAT(doubled(), ElementsAre());
}

// RN-26: HERE comes before what nodes answer to a request behind SELECT; so a scan waits for nodes
// alone, however long they take, and not for select_us.
TEST_F(ClientNodes, ScanOnASlowBus) {
  add_new(0x12345678);
  bus.latency_us = 40'000;
  client.select_us = 1000;
  EXPECT_THAT(scan(), ElementsAre(std::pair(3U, 0xCAFE1233U), std::pair(4U, 0xCAFE1234U),
                                  std::pair(5U, 0xCAFE1235U), std::pair(0U, 0x12345678U)));
}

// RN-11: two answers to one poll under one number.
TEST_F(ClientNodes, APollTellsOfASharedNumber) {
  add_new(0x12345678, 5);
  verican_remote_answers_t answers;
  EXPECT_EQ(verican_remote_poll(&client, 0x20, 1, 0, &answers), VERICAN_REMOTE_OK);
  EXPECT_EQ(answers.differing, 0U);  // the same bytes are one frame
  EXPECT_EQ(verican_remote_poll(&client, 0xFFC, 4, 0, &answers), VERICAN_REMOTE_OK);
  EXPECT_EQ(answers.answered, 0x38U);
  EXPECT_EQ(answers.differing, 0x20U);
}

// RN-25, RN-26: an empty bus is soon known to be one.
TEST_F(ClientNodes, ScanOfAnEmptyBus) {
  bus.filter = [](const RemoteModel *, const Frame &) { return false; };
  const std::uint32_t start = bus.now();
  EXPECT_EQ(scan().size(), 0U);
  EXPECT_LT(bus.now() - start, 1'000'000U);
}

// RN-26: SELECT, then ASSIGN; confirmed by the node's STATUS, or by HERE of a node that is new.
TEST_F(ClientNodes, Assign) {
  add_new(0x12345678);
  EXPECT_EQ(verican_remote_assign(&client, 0x12345678, 6), VERICAN_REMOTE_OK);
  EXPECT_EQ(bus.node(3).number(), 6U);
  EXPECT_EQ(write(6, 0x20, {9}), VERICAN_REMOTE_OK);
  EXPECT_THAT(read(6, 0x20, 1), ElementsAre(9));
  EXPECT_EQ(verican_remote_assign(&client, 0x12345679, 7), VERICAN_REMOTE_TIMEOUT);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, 7), VERICAN_REMOTE_OK);
  EXPECT_EQ(bus.node(0).number(), 7U);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, 0), VERICAN_REMOTE_OK);
  EXPECT_EQ(bus.node(0).number(), 0U);
}

// RN-11: a number that another node has is not given once more; its own may be.
TEST_F(ClientNodes, ANumberInUse) {
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, 4), VERICAN_REMOTE_IN_USE);
  EXPECT_EQ(bus.node(0).number(), 3U);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, 3), VERICAN_REMOTE_OK);
  bus.collides = true;
  add_new(0x12345678, 5);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1235, 5), VERICAN_REMOTE_IN_USE);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1235, 6), VERICAN_REMOTE_OK);
  EXPECT_EQ(bus.node(2).number(), 6U);
  EXPECT_EQ(bus.node(3).number(), 5U);
}

// RN-24, RN-35: CLEAR forgets that a number was doubled, once it is no more.
TEST_F(ClientNodes, Clear) {
  bus.send({.id = 0x5A0, .dlc = 1, .data = {7}});  // as another node 3 would
  verican_remote_status_t status;
  ASSERT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  EXPECT_TRUE(status.duplicate);
  int lost = 0;
  bus.filter = [&](const RemoteModel *, const Frame &frame) {
    return frame.id != 0x1FC || lost++ >= 3;  // the first CLEAR, to each node
  };
  EXPECT_EQ(verican_remote_clear(&client, 3), VERICAN_REMOTE_OK);
  EXPECT_GT(lost, 3);
  ASSERT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  EXPECT_FALSE(status.duplicate);
  EXPECT_EQ(verican_remote_clear(&client, 2), VERICAN_REMOTE_TIMEOUT);
}

// RN-26, RN-91: a node in OPERATE is there, but takes no number; that is not as if it were not.
TEST_F(ClientNodes, ANumberThatIsNotTaken) {
  (void)verican_remote_state(&client, 0, VERICAN_REMOTE_OPERATE);
  for (const std::uint8_t number : {6, 0}) {
    EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, number), VERICAN_REMOTE_NOT_TAKEN);
    EXPECT_EQ(bus.node(0).number(), 3U);
  }
}

// RN-27: ASSIGN is repeated if its answer is lost.
TEST_F(ClientNodes, AssignIsRepeated) {
  int lost = 1;
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    return to != nullptr || frame.id != 0x77E || lost-- <= 0;
  };
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233, 6), VERICAN_REMOTE_OK);
  EXPECT_EQ(bus.node(0).number(), 6U);
}

class ClientBlocks : public ModelClientTest {
 protected:
  static Bytes pattern(std::size_t n, unsigned first = 0) {
    Bytes bytes(n);
    for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::uint8_t>((i + first) % 251);
    return bytes;
  }
  verican_remote_result_t block_write(std::uint16_t address, const Bytes &bytes) {
    return verican_remote_block_write(&client, 3, address, bytes.data(), bytes.size());
  }
  std::pair<verican_remote_result_t, Bytes> block_read(std::uint16_t address, std::size_t n) {
    Bytes bytes(n);
    const auto result = verican_remote_block_read(&client, 3, address, bytes.data(), n);
    return {result, bytes};
  }
  Bytes memory(unsigned address, std::size_t n) {
    Bytes bytes(n);
    for (std::size_t i = 0; i < n; ++i)
      bytes[i] = bus.node(0).memory()[address + static_cast<unsigned>(i)];
    return bytes;
  }
  /// Filter: the `which`-th DATA frame (from 1), or answer of BLOCK, to or from the node.
  void lose(unsigned id, unsigned which, unsigned times = 1) {
    bus.filter = [id, count = 0U, which, times](const RemoteModel *to, const Frame &frame) mutable {
      const bool its = frame.id == id && ((id & 0x400) != 0) == (to == nullptr);
      if (!its) return true;
      ++count;
      return count < which || count >= which + times;
    };
  }
};

// RN-40, RN-41: every length, and all of the memory but the identity, which nobody writes.
TEST_F(ClientBlocks, EveryLength) {
  std::vector<std::size_t> lengths(20);
  std::iota(lengths.begin(), lengths.end(), 1U);
  lengths.push_back(3584);
  for (const std::size_t n : lengths) {
    const Bytes bytes = pattern(n, static_cast<unsigned>(n));
    const std::uint16_t address = n == 3584 ? 0 : 0x300;
    ASSERT_EQ(block_write(address, bytes), VERICAN_REMOTE_OK) << n;
    const auto [result, back] = block_read(address, n);
    ASSERT_EQ(result, VERICAN_REMOTE_OK) << n;
    const std::size_t fixed = address == 0 ? 0x18 : 0;
    const Bytes written(bytes.begin() + fixed, bytes.end());
    ASSERT_EQ(Bytes(back.begin() + fixed, back.end()), written) << n;
    ASSERT_EQ(memory(address + fixed, n - fixed), written) << n;
  }
}

class ClientBlockLosses : public ClientBlocks, public ::testing::WithParamInterface<unsigned> {};

// RN-41: each frame of a write lost once: it goes on behind what has arrived.
TEST_P(ClientBlockLosses, OfAWrite) {
  const Bytes bytes = pattern(40);
  lose(0x1FB, GetParam());
  EXPECT_EQ(block_write(0x300, bytes), VERICAN_REMOTE_OK);
  EXPECT_EQ(memory(0x300, 40), bytes);
}

// RN-40: each frame of a read lost once: it is read again from there.
TEST_P(ClientBlockLosses, OfARead) {
  ASSERT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_OK);
  lose(0x5FB, GetParam());
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40)));
}

INSTANTIATE_TEST_SUITE_P(EveryFrame, ClientBlockLosses, ::testing::Range(1U, 7U));

// RN-42: BLOCK itself, and its answers, lost once.
TEST_F(ClientBlocks, LostBlockFrames) {
  for (const unsigned which : {1U, 2U}) {
    lose(0x5FA, which);
    EXPECT_EQ(block_write(0x300, pattern(40, which)), VERICAN_REMOTE_OK) << which;
    EXPECT_EQ(memory(0x300, 40), pattern(40, which));
  }
  lose(0x5FA, 1);
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40, 2)));
  lose(0x1FA, 1, 3);  // to each of the three nodes
  EXPECT_EQ(block_write(0x300, pattern(40, 9)), VERICAN_REMOTE_OK);
  lose(0x1FA, 1, 3);
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40, 9)));
}

// RN-27: every frame of the host comes twice.
TEST_F(ClientBlocks, DoubledFrames) {
  bus.repeat = 2;
  EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_OK);
  EXPECT_EQ(memory(0x300, 40), pattern(40));
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40)));
}

// VA-03: every frame of the nodes comes twice.
TEST_F(ClientBlocks, DoubledAnswers) {
  bus.doubled = 2;
  EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_OK);
  EXPECT_EQ(memory(0x300, 40), pattern(40));
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40)));
  EXPECT_THAT(bus.take_sent(), ::testing::SizeIs(8));  // BLOCK and six of DATA, BLOCK: no retry
}

// RN-91: OK says that all bytes have been moved, whatever a node answers.
TEST_F(ClientBlocks, AnswersThatPromiseTooMuch) {
  for (const unsigned code : {VERICAN_REMOTE_CODE_OPEN + 0U, 0U}) {
    bus.heard = [code](Frame frame) {
      const bool its = frame.id == 0x5FA && frame.data[2] == code;
      if (its) frame.data[2] = 0;
      if (its) frame.data[4] = 3;  // bytes
      return frame;
    };
    EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_SEQUENCE) << code;
  }
}

// RN-91: frames that are lost in every try are SEQUENCE; a node that is not there TIMEOUT.
TEST_F(ClientBlocks, GivenUp) {
  bus.filter = [](const RemoteModel *to, const Frame &frame) {
    return to != nullptr || frame.id != 0x5FB || frame.data[0] != 1;
  };
  EXPECT_EQ(block_read(0x300, 40).first, VERICAN_REMOTE_SEQUENCE);
  EXPECT_EQ(bus.take_sent().size(), 3U);
  bus.filter = [](const RemoteModel *, const Frame &frame) {
    return frame.id != 0x1FB || frame.data[0] != 0;
  };
  EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_SEQUENCE);
  EXPECT_EQ(bus.take_sent().size(), 9U);  // BLOCK, DATA 0 that is lost, DATA 1 that ends it
  bus.filter = [](const RemoteModel *, const Frame &) { return true; };
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_block_read(&client, 2, 0, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_EQ(verican_remote_block_write(&client, 2, 0, &byte, 1), VERICAN_REMOTE_TIMEOUT);
}

// RN-43: refusals have their code, at the first byte or later.
TEST_F(ClientBlocks, Refused) {
  EXPECT_EQ(block_write(0xDF0, pattern(40)), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
  EXPECT_EQ(block_read(0xDF0, 40).first, VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
  EXPECT_EQ(block_write(0xF00, pattern(4)), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_LOCKED);
  (void)bus.take_sent();
  EXPECT_EQ(block_write(0xF00, pattern(4)), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(bus.take_sent().size(), 2U);  // one try
  RemoteConfig small;
  bus.add(small, 6);
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_block_read(&client, 6, 0, &byte, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_FUNCTION);
}

// RN-42: a transfer that a host has left open is ended first.
TEST_F(ClientBlocks, ATransferLeftOpen) {
  bus.send({.id = 0x1FA, .dlc = 6, .data = {2, 0x77, 0, 3, 10, 0}});
  EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_OK);
  EXPECT_EQ(memory(0x300, 40), pattern(40));
  bus.send({.id = 0x1FA, .dlc = 6, .data = {2, 0x78, 0, 3, 10, 0}});
  EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, pattern(40)));
}

// RN-42: the answer to that abort has the tag of what was left open, which a client that has been
// started anew may be about to give: it is not an answer to its own BLOCK.
TEST_F(ClientBlocks, ATransferLeftOpenUnderTheNextTag) {
  bus.latency_us = 20;
  for (const std::uint8_t op : {1, 2}) {
    bus.send({.id = 0x1FA,
              .dlc = 6,
              .data = {2, static_cast<std::uint8_t>(client.tag + 2), 0, 3, 10, 0}});
    if (op == 1) {
      EXPECT_EQ(block_read(0x300, 40), std::pair(VERICAN_REMOTE_OK, Bytes(40)));
    } else {
      EXPECT_EQ(block_write(0x300, pattern(40)), VERICAN_REMOTE_OK) << client.code;
      EXPECT_EQ(memory(0x300, 40), pattern(40));
    }
  }
}

// RN-40: a gap that the host wants.
TEST_F(ClientBlocks, Gap) {
  client.gap_ms = 5;
  const std::uint32_t start = bus.now();
  EXPECT_EQ(block_read(0x300, 40).first, VERICAN_REMOTE_OK);
  EXPECT_GE(bus.now() - start, 24'000U);
  client.gap_ms = 250;  // longer than the time-out for an answer
  EXPECT_EQ(block_read(0x300, 14), std::pair(VERICAN_REMOTE_OK, Bytes(14)));
}

}  // namespace
}  // namespace vericansim
