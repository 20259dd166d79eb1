// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RN-104: a remote node that receives and answers obeys the rule book like any other: one bit
// flipped at every place of request and answer, error active and passive.
#include <gmock/gmock.h>

#include "bus/faults.hpp"
#include "judge/node_bit.hpp"
#include "judge/rule_tolerance.hpp"
#include "model/node_model.hpp"
#include "remote/remote_shadow.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

constexpr NodeId kDevice = 2;

/// The model of the rules of the protocol beside the device; what it has to send is known from the
/// model of remote nodes.
class RuleJudge : public BusObserver {
 public:
  explicit RuleJudge(RemoteShadow &shadow) : shadow_{shadow} {}
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &record) override {
    if (node != kDevice) return;
    const NodeBit bit = node_bit(record, record.at.tx);
    offer();
    const int last_rec = model_.rec();
    if (bit.sent_level != model_.internal_level()) differ("level sent", bit);
    if (model_.state().field != bit.field || model_.state().is_stuff != bit.stuff)
      differ("place", bit);
    model_.sample(bit.rx);
    if (bit.sent != model_.events().sent_ok || bit.failed != model_.events().tx_fail)
      differ("end of an attempt", bit);
    if ((bit.errors != 0) != (model_.events().error != NodeError::kNone)) differ("error", bit);
    const bool off = model_.error_state() == ErrorState::kBusOff;
    if (bit.bus_off != off) differ("bus-off", bit);
    if (off) return;
    if (static_cast<int>(bit.tec) != model_.tec() && !settle_tec(model_, bit)) differ("TEC", bit);
    const bool equal = static_cast<int>(bit.rec) == model_.rec();
    if (!equal && !settle_rec(model_, last_rec, crc_step_, bit)) differ("REC", bit);
    if (equal) crc_step_ = false;
    ++bits;
  }
  std::string difference;
  unsigned bits = 0;

 private:
  void offer() {
    const Field field = model_.state().field;
    const bool in_frame = field >= Field::kSof && field <= Field::kEof;
    if (in_frame && model_.role() == Role::kTransmitter) return;
    const std::optional<Frame> wanted = shadow_.model().wants();
    if (wanted)
      model_.request(*wanted);
    else if (model_.pending())
      model_.cancel();
  }
  void differ(const std::string &what, const NodeBit &bit) {
    if (difference.empty())
      difference = what + " at " + std::string{field_name(bit.field)} + " " +
                   std::to_string(bit.left) + ", TEC " + std::to_string(bit.tec) + " and " +
                   std::to_string(model_.tec()) + ", REC " + std::to_string(bit.rec) + " and " +
                   std::to_string(model_.rec());
  }

  RemoteShadow &shadow_;
  NodeModel model_;
  bool crc_step_ = false;
};

/// A run from reset: perhaps until the device is error passive, then a request with one flipped
/// bit.
class OneFlip {
 public:
  OneFlip() {
    bus_.bus.add(judge_);  // first: it asks for what there was to send before this bit
    bus_.bus.add(shadow_);
    bus_.bus.add(flips_);
    shadow_.start();
    bus_.run_bits(30);
    (void)bus_.settle();
  }
  ~OneFlip() {
    bus_.bus.remove(judge_);
    bus_.bus.remove(shadow_);
  }
  /// What differs; "" if nothing does.
  std::string run(const char *request, unsigned place, bool passive) {
    if (passive) exhaust();
    if (passive != decode_trace(bus_.node().trace()).passive) return "not in the error state";
    const Time begin = bus_.bus.now();
    bus_.host.request(frame_of(request));
    flips_.add(kDevice, Effect::kFlip,
               {begin + place * UnitBus::kBit, begin + (place + 1) * UnitBus::kBit});
    bus_.run_bits(place + 2);
    (void)bus_.settle();
    (void)bus_.send("1A0#R2");  // and it still works
    if (judge_.bits < 200) return "hardly any bit was compared";
    const std::string rules = judge_.difference;
    return rules.empty() ? shadow_.compare(false) : rules;
  }

 private:
  // A bit of every answer is disturbed: after two reads of eight attempts TEC is 128.
  void exhaust() {
    for (unsigned reads = 0; reads < 2; ++reads) {
      bus_.host.request(frame_of("1A0#R8"));
      bus_.run_bits(2);
      while (!bus_.node().idle() || bus_.host.pending()) {
        bus_.run_bits(1);
        const Trace trace = decode_trace(bus_.node().trace());
        if (trace.transmitter && trace.field == Field::kData && trace.left == 8)
          flips_.add(kDevice, Effect::kFlip,
                     {bus_.bus.now() + UnitBus::kBit, bus_.bus.now() + 2 * UnitBus::kBit});
      }
    }
  }

  RtlBus bus_{std::vector<unsigned>{3}};
  RemoteConfig config_ = [] {
    RemoteConfig config = RemoteConfig::profile("small");
    config.serial = 0xCAFE1234;
    return config;
  }();
  RemoteShadow shadow_{bus_.node(), kDevice, config_, 3};
  RuleJudge judge_{shadow_};
  ScheduledFaults flips_;
};

class RtlErrors : public ::testing::TestWithParam<bool> {};

// RN-104: all places from the SOF of the request to behind the answer.
TEST_P(RtlErrors, AFlipAnywhereIsHandledAsTheRulesSay) {
  for (const char *request : {"1A0#R8", "1A3#0011223344556677", "1A0#"}) {
    for (unsigned place = 0; place < 230; ++place) {
      OneFlip one;
      ASSERT_EQ(one.run(request, place, GetParam()), "") << request << ", bit " << place;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(States, RtlErrors, ::testing::Bool(), [](const auto &test) {
  return std::string{test.param ? "Passive" : "Active"};
});

}  // namespace
}  // namespace vericansim
