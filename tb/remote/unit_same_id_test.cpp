// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Why answers have identifiers of their own: model and RTL with SameId and without (RN-10, RN-16).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "node/remote_model_node.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

using Counts = std::vector<unsigned>;
using Maker = std::unique_ptr<RemoteUnit> (*)(const RemoteConfig &);

std::unique_ptr<RemoteUnit> model(const RemoteConfig &config) {
  return std::make_unique<RemoteModelNode>("unit", config, 3, UnitBus::timing(), UnitBus::clock());
}
std::unique_ptr<RemoteUnit> rtl(const RemoteConfig &config) { return rtl_unit(3, config); }

/// TEC of one node, each of its values once, as it goes up.
class Rises : public BusObserver {
 public:
  explicit Rises(NodeId node) : node_{node} {}
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != node_) return;
    if (bit.after.tec > last_) values.push_back(bit.after.tec);
    last_ = bit.after.tec;
  }
  Counts values;

 private:
  NodeId node_;
  unsigned last_ = 0;
};

class SameId : public ::testing::TestWithParam<Maker> {
 protected:
  explicit SameId(bool same_id = true) : bus_{GetParam()(config(same_id))} {
    bus_.unit->user_write(0xF04 / 4, 0, 8);  // RETRY 0: no limit
    (void)bus_.start();
    bus_.bus.add(host_);
    bus_.bus.add(node_);
  }
  ~SameId() override {
    bus_.bus.remove(host_);
    bus_.bus.remove(node_);
  }
  /// A read and a write of one byte, one behind the other; what the node says.
  std::vector<std::string> read_and_write() {
    bus_.host.request(frame_of("1A0#R1"));
    bus_.host.request(frame_of("1A0#5A"));
    bus_.run_bits(100);
    return bus_.settle();
  }
  static RemoteConfig config(bool same_id) {
    RemoteConfig config = RemoteConfig::profile("small");
    config.same_id = same_id;
    return config;
  }

  UnitBus bus_;
  Rises host_{0};
  Rises node_{2};
};
class OwnId : public SameId {
 protected:
  OwnId() : SameId{false} {}
};

// RN-10, RN-16: a host's write and an answer of the same identifier start together and differ in
// their data: 16 attempts are destroyed, both are error passive; then the answer gets through, for
// it has the dominant bits, and the host, whose passive flag nobody sees, hears nothing of it.
TEST_P(SameId, WriteAndAnswerDestroyEachOther) {
  EXPECT_THAT(read_and_write(), ElementsAre());
  Counts expected(16);
  std::iota(expected.begin(), expected.end(), 1);
  for (unsigned &value : expected) value *= 8;
  for (const Counts &seen : {host_.values, node_.values}) {
    ASSERT_GE(seen.size(), expected.size());
    EXPECT_THAT(Counts(seen.begin(), seen.begin() + 16), ElementsAreArray(expected));
  }
  std::vector<std::string> heard;
  for (const Frame &frame : bus_.other.received()) heard.push_back(candump_frame(frame));
  EXPECT_THAT(heard, ElementsAre("5FE#0200000000000000", "1A0#R1", "1A0#00", "1A0#5A"));
  EXPECT_EQ(bus_.unit->peek(0x20), 0x5A);
}

// RN-16: of all nodes together, too; READ and STATUS keep their identifiers.
TEST_P(SameId, IsForDirectReadsAlone) {
  EXPECT_THAT(bus_.send(frame_of("0A0#R2")), ElementsAre("0A0#0000"));
  EXPECT_THAT(bus_.send(frame_of("1A1#R2")), ElementsAre("1A1#0000"));
  EXPECT_THAT(bus_.send(frame_of("1F8#200001")), ElementsAre("5F8#200000"));
  EXPECT_THAT(bus_.send(frame_of("1FE#R1")), ElementsAre("5FE#02"));
  EXPECT_THAT(bus_.send(frame_of("1A1#R1")), ElementsAre("1A1#00"));
}

// RN-10: without SameId.
TEST_P(OwnId, NothingIsDestroyed) {
  EXPECT_THAT(read_and_write(), ElementsAre("5A0#00"));
  EXPECT_THAT(host_.values, ElementsAre());
  EXPECT_THAT(node_.values, ElementsAre());
  EXPECT_EQ(bus_.unit->peek(0x20), 0x5A);
}

std::string name_of(const ::testing::TestParamInfo<Maker> &info) {
  return info.param == rtl ? "rtl" : "model";
}
INSTANTIATE_TEST_SUITE_P(Nodes, SameId, ::testing::Values(model, rtl), name_of);
INSTANTIATE_TEST_SUITE_P(Nodes, OwnId, ::testing::Values(model, rtl), name_of);

}  // namespace
}  // namespace vericansim
