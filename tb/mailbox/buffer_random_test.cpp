// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Long random runs of the core and the model of the buffers side by side: traffic, errors, and
// software that reads, writes, sends and aborts at any clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "harness/random_seeds.hpp"
#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kVps = 1u << 14, kImb = 1u << 13;  // of ESR2

/// The seeds of Found are below: they keep the accesses that they had.
constexpr unsigned kCampaignSeeds = 100'000;

BufferConfig random_config(std::mt19937 &rng) {
  const auto one_in = [&](unsigned n) { return rng() % n == 0; };
  BufferConfig config;
  config.num_mb = 16u << (rng() % 3);
  config.maxmb = config.num_mb - 1 - (one_in(3) ? 2 : 0);
  config.bcc = !one_in(3);
  config.aen = one_in(2);
  config.lprio_en = one_in(3);
  config.lbuf = one_in(3);
  config.eacen = one_in(2);
  config.rrs = one_in(2);
  config.fen = one_in(3);
  config.mrp = one_in(2);
  config.idam = static_cast<unsigned>(rng() % 3);
  config.one_shot = one_in(6);
  config.osmb = one_in(3);
  return config;
}

/// What a core of the build can have of it.
BufferConfig random_config(std::mt19937 &rng, const CoreBuild &build) {
  BufferConfig config = random_config(rng);
  config.num_mb = build.num_mb;
  config.maxmb = build.num_mb - 1;
  config.bcc = config.bcc && build.features.own_masks;
  config.aen = config.aen && build.features.abort;
  config.fen = config.fen && build.features.fifo;
  if (build.features.extras) return config;
  config.lprio_en = config.lbuf = config.one_shot = config.osmb = false;
  config.rrs = true;
  return config;
}

class Random : public ::testing::TestWithParam<unsigned> {
 protected:
  /// On a core of the build; nullptr: with all features, of a size by chance.
  explicit Random(const CoreBuild *build = build_under_test())
      : rng_{GetParam()},
        own_masks_{build == nullptr || build->features.own_masks},
        rig_{build == nullptr ? BufferRig{random_config(rng_)}
                              : BufferRig{random_config(rng_, *build), *build}} {}

  Frame frame() {
    const bool extended = rng_() % 3 == 0;
    const std::uint32_t base = 0x100 + rng_() % identifiers_;
    const bool remote = rng_() % 4 == 0;
    Frame frame{.id = extended ? base << 18 : base,
                .extended = extended,
                .remote = remote,
                .dlc = static_cast<std::uint8_t>(rng_() % 4)};
    for (unsigned i = 0; i < frame.payload_size(); ++i)
      frame.data[i] = static_cast<std::uint8_t>(rng_());
    return frame;
  }
  // The core's frames and the peer's never have the same identifier (AR-10 would make errors of
  // it).
  Frame own_frame() {
    Frame own = frame();
    own.id |= (own.remote ? 0xC0u : 0x80u) << (own.extended ? 18 : 0);
    return own;
  }
  // What software sees at once; with AEN=1 it also looks whether its write was taken, so that what
  // the specification leaves open does not stay open.
  void look(unsigned mb) {
    rig_.read(reg::kIflag1);
    if (rig_.config().num_mb > 32) rig_.read(reg::kIflag2);
    if (rig_.config().aen) rig_.read_cs(mb);
    if (status_) look_at_status();
  }
  // ESR2 (1.7): a buffer that is said to be inactive is: software may fill it. CRCR (1.8) has the
  // CRC of the last frame sent.
  void look_at_status() {
    if (HasFailure()) return;
    const std::size_t sent = rig_.sent().size();
    const std::uint32_t esr2 = rig_.read(reg::kEsr2);
    const std::uint32_t crc = rig_.read(reg::kCrcr) & 0x7FFF;
    if (sent > sent_ && sent == rig_.sent().size())
      EXPECT_EQ(crc, encode_frame(rig_.sent().back()).crc) << "CRCR, clock " << rig_.clocks();
    rig_.run(4);  // until the model has heard of all accesses
    const unsigned lowest = (esr2 >> 16) & 0x7F;
    if ((esr2 & kVps) == 0 || (esr2 & kImb) == 0 || HasFailure()) return;
    EXPECT_TRUE(rig_.model.may_be([&](const BufferState &state) {
      const unsigned code = state.mb[lowest].code();
      return code == 0 || code == kTxInactive || state.ended;
    })) << "ESR2 says that buffer "
        << lowest << " is inactive, clock " << rig_.clocks();
  }
  // Nothing happens and nothing is written any more.
  void final_status() {
    if (!status_ || HasFailure()) return;
    rig_.run(600);
    const std::uint32_t esr2 = rig_.read(reg::kEsr2);
    EXPECT_NE(esr2 & kVps, 0u);
    const auto inactive = [&](unsigned mb) {
      const unsigned code = rig_.model.state().mb[mb].code();
      return code == 0 || code == kTxInactive;
    };
    if ((esr2 & kImb) != 0) {
      EXPECT_TRUE(inactive((esr2 >> 16) & 0x7F)) << "clock " << rig_.clocks();
      return;
    }
    for (unsigned mb = rig_.config().first_mailbox(); mb <= rig_.config().maxmb; ++mb)
      EXPECT_FALSE(inactive(mb)) << mb << ", clock " << rig_.clocks();
  }
  // With AEN=1 a buffer that is being sent does not let itself be deactivated: then hands off.
  bool inactive(unsigned mb) {
    look(mb);
    const unsigned code = (rig_.read_cs(mb) >> 24) & 0xF;
    return code == 0 || code == kTxInactive;
  }
  unsigned mailbox() {
    const unsigned first = rig_.config().first_mailbox();
    return first + static_cast<unsigned>(rng_() % std::min(rig_.config().num_mb - first, buffers_));
  }

  // One thing that software does, as drivers do it.
  void software() {
    const unsigned mb = mailbox();
    const std::uint32_t flag = mb < 32 ? reg::kIflag1 : reg::kIflag2;
    switch (rng_() % 10) {
      case 0: {  // a receive buffer
        rig_.write(reg::mb(mb), 0);
        if (!inactive(mb)) break;
        rig_.put_rx(mb, frame());
        break;
      }
      case 1:
      case 2: {  // a frame to send
        rig_.write(reg::mb(mb), kTxInactive << 24);
        if (!inactive(mb)) break;
        MbWords words = mb_words(own_frame(), rng_() % 6 == 0 ? kTxAnswerWaits : kTxActive);
        words.id |= static_cast<std::uint32_t>(rng_() % 8) << 29;
        if (rng_() % 3 == 0) words.cs |= reg::kCsOneShot;
        rig_.put(mb, words);
        break;
      }
      case 3: rig_.write(reg::mb(mb), kTxInactive << 24); break;
      case 4: rig_.write(reg::mb(mb), kTxAbort << 24); break;
      case 5:
      case 6: rig_.read_cs(mb); break;
      case 7: rig_.read(rxfir_ && mb % 4 == 0 ? reg::kRxfir : reg::kTimer); break;
      case 8: rig_.write(flag, 1u << (mb % 32)); break;
      default:
        rig_.read(reg::kIflag1);
        if (rig_.config().fen) rig_.write(reg::kIflag1, 0x20);
        break;
    }
    look(mb);
  }

  std::uint32_t random_mask() { return rng_() % 2 != 0 ? 0xDFFFFFFF : 0x1FF80000; }
  void masks_and_filters() {
    if (!own_masks_)
      for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask})
        rig_.write(mask, random_mask());
    for (unsigned mb = 0; mb < rig_.config().num_mb; ++mb)
      rig_.write(reg::rximr(mb), random_mask());
    if (!rig_.config().fen) return;
    for (unsigned i = 0; i < rig_.config().filter_elements(); ++i)
      rig_.write(0x0E0 + 4 * i, (0x100u + static_cast<std::uint32_t>(rng_() % 8)) << 19);
  }

  void lockstep() {
    SCOPED_TRACE(testing::Message() << "seed " << GetParam());
    masks_and_filters();
    rig_.go();
    for (unsigned step = 0; step < 300 && !HasFailure(); ++step) {
      if (rng_() % 3 == 0) rig_.peer_sends(frame());
      if (rng_() % 40 == 0) rig_.disturb(1 + static_cast<unsigned>(rng_() % 60));
      for (unsigned i = static_cast<unsigned>(rng_() % 4); i > 0; --i) software();
      rig_.run(static_cast<unsigned>(rng_() % 300));
      if (step % 25 != 24) continue;
      rig_.disturb(0, 0);
      rig_.quiet();
      rig_.compare();
    }
  }

  std::mt19937 rng_;
  bool own_masks_;
  BufferRig rig_;
  unsigned identifiers_ = 6;  // different ones, of each kind
  unsigned buffers_ = 64;     // that software works with
  bool status_ = false;       // ESR2 and CRCR are looked at
  std::size_t sent_ = 0;      // frames before the last soft reset
  // Reads RXFIR too, with or without the FIFO.
  bool rxfir_ = GetParam() < 100 || GetParam() >= kCampaignSeeds;
};

// TH-06: each request ends exactly once. RO-05: nothing of a destroyed
// frame is left.
TEST_P(Random, Lockstep) { lockstep(); }

INSTANTIATE_TEST_SUITE_P(Seeds, Random, random_seeds(60));

// Few buffers and identifiers, and software that waits for the moments at which the core works on
// them: clocks that it meets by chance once in a million frames.
class RandomAtEvents : public Random {
 protected:
  explicit RandomAtEvents(const CoreBuild *build = build_under_test()) : Random{build} {
    identifiers_ = 2;
    buffers_ = 3;
  }
  // Data frames for what the core has asked for, requests for what it answers; what both send at
  // once differs.
  Frame peer_frame() {
    Frame peer = frame();
    const std::uint32_t both = (peer.remote ? 0x80u : 0xC0u) << (peer.extended ? 18 : 0);
    if (rng_() % 2 == 0) peer.id |= both;
    return peer;
  }
  void wait_for_a_moment() {
    constexpr Field kMoments[] = {Field::kSof, Field::kRtr,    Field::kDlc, Field::kCrc,
                                  Field::kEof, Field::kAckDel, Field::kInt, Field::kErrFlag};
    const Field field = kMoments[rng_() % std::size(kMoments)];
    rig_.run_until([&] { return rig_.field() == field; }, 900);
    rig_.run(static_cast<unsigned>(rng_() % 64));
  }

  // Another frame of the peer's or an error, perhaps, and then a moment of these.
  void next_moment() {
    if (rng_() % 2 == 0) rig_.peer_sends(peer_frame());
    if (rng_() % 40 == 0) rig_.disturb(1 + static_cast<unsigned>(rng_() % 60));
    wait_for_a_moment();
  }

  void lockstep() {
    SCOPED_TRACE(testing::Message() << "seed " << GetParam());
    masks_and_filters();
    rig_.go();
    for (unsigned step = 0; step < 300 && !HasFailure(); ++step) {
      next_moment();
      for (unsigned i = 1 + static_cast<unsigned>(rng_() % 3); i > 0; --i) software();
      if (step % 25 != 24) continue;
      rig_.disturb(0, 0);
      rig_.quiet();
      rig_.compare();
    }
  }
};

TEST_P(RandomAtEvents, Lockstep) { lockstep(); }  // FX-3.4.b, FX-3.5.o, FX-3.3.j

INSTANTIATE_TEST_SUITE_P(Seeds, RandomAtEvents, random_seeds(60));
// Seeds that have shown a defect of the core or of the model.
INSTANTIATE_TEST_SUITE_P(Found, RandomAtEvents,
                         ::testing::Values(582u, 759u, 1350u, 1462u, 1797u, 2171u, 2297u, 4309u,
                                           4824u, 6087u, 14147u, 17127u, 17728u));

// Software that also takes the core off the bus at those moments, and comes back with other
// settings: what it left behind must neither stay nor go.
class RandomLives : public RandomAtEvents {
 protected:
  explicit RandomLives(const CoreBuild *build = build_under_test()) : RandomAtEvents{build} {}

  /// Other settings for the same core; with the Rx FIFO and as many filters as before.
  BufferConfig other_config() {
    const BufferConfig before = rig_.config();
    const auto one_in = [&](unsigned n) { return rng_() % n == 0; };
    BufferConfig config = before;
    if (own_masks_) config.bcc = !one_in(3);
    if (extras_) {
      config.maxmb = before.num_mb - 1 - (one_in(3) ? 2 : 0);
      config.lprio_en = one_in(3);
      config.lbuf = one_in(3);
      config.rrs = one_in(2);
      config.one_shot = one_in(6);
      config.osmb = one_in(3);
    }
    config.eacen = one_in(2);
    config.srx_dis = one_in(2);
    config.mrp = one_in(2);
    return config;
  }
  // A C/S word written as no driver does: whatever the buffer is, whole or in part, twice in a row
  // or with a read behind it.
  void raw() {
    constexpr unsigned kCodes[] = {kRxEmpty, kRxEmpty, kRxFull, 0, kTxInactive, kTxAbort};
    const unsigned mb = mailbox();
    std::uint64_t clock = rig_.clocks();
    for (unsigned i = 1 + static_cast<unsigned>(rng_() % 3); i > 0; --i) {
      const std::uint32_t code = kCodes[rng_() % std::size(kCodes)];
      const std::uint32_t kind = (rng_() % 2 != 0 ? reg::kCsIde : 0) >> 16;
      switch (rng_() % 6) {
        case 0: rig_.at(clock, {.address = reg::mb(mb)}); break;
        case 1: rig_.at(clock, {.address = reg::kTimer}); break;
        case 2:
          rig_.at(
              clock,
              {.address = reg::mb(mb) + 3, .write = true, .size = AhbSize::kByte, .data = code});
          break;
        case 3:
          rig_.at(clock, {.address = reg::mb(mb) + 2,
                          .write = true,
                          .size = AhbSize::kHalf,
                          .data = code << 8 | kind});
          break;
        case 4:
          rig_.at(clock, {.address = reg::mb(mb),
                          .write = true,
                          .size = AhbSize::kByte,
                          .data = static_cast<std::uint32_t>(rng_() % 256)});
          break;
        default:
          rig_.at(clock, {.address = reg::mb(mb), .write = true, .data = code << 24 | kind << 16});
          break;
      }
      clock += rng_() % 5;
    }
    rig_.run(12);
    look(mb);
    receive_again(mb);
  }
  // A move that a C/S word has cut short leaves an identifier that nobody promises.
  void receive_again(unsigned mb) {
    rig_.write(reg::mb(mb), 0);
    if (inactive(mb)) rig_.put_rx(mb, frame());
  }
  void reads() {
    for (unsigned i = static_cast<unsigned>(rng_() % 4); i > 0; --i)
      rig_.read(rng_() % 2 == 0 ? reg::kTimer : reg::mb(mailbox()));
  }
  /// The same, and other buffers that are mailboxes.
  BufferConfig other_area() {
    BufferConfig config = other_config();
    if (!fifo_) return config;
    config.fen = rng_() % 2 == 0;
    if (extras_) config.rffn = static_cast<unsigned>(rng_() % (config.num_mb == 16 ? 3 : 6));
    return config;
  }
  // As drivers do: what the FIFO and its filters leave is no C/S word, flags of transmissions may
  // protect it (3.4), and whether a soft reset forgets which frames were read is open (2.3).
  void prepare_all() {
    rig_.write(reg::kIflag1, ~0u);
    rig_.write(reg::kIflag2, ~0u);
    for (unsigned mb = rig_.config().first_mailbox(); mb < rig_.config().num_mb; ++mb)
      rig_.put_rx(mb, frame(), rng_() % 2 == 0 ? kRxEmpty : 0);
  }
  void freeze() {
    ASSERT_TRUE(rig_.freeze(8000));
    reads();
    if (rng_() % 4 == 0) {
      rig_.run(100);  // until a frame that waited is in its buffer
      rig_.configure(other_area());
      masks_and_filters();
      prepare_all();
    } else if (rng_() % 2 == 0) {
      rig_.configure(other_config());
    }
    if (rng_() % 2 == 0) masks_and_filters();
    for (unsigned i = static_cast<unsigned>(rng_() % 3); i > 0; --i) software();
    rig_.go();
  }
  void sleep() {
    rig_.write(reg::kMcr, mcr_of(rig_.config()) | reg::kMcrMdis);
    ASSERT_TRUE(
        rig_.run_until([&] { return (rig_.read(reg::kMcr) & reg::kMcrLpmAck) != 0; }, 8000));
    reads();
    for (unsigned i = static_cast<unsigned>(rng_() % 3); i > 0; --i) software();
    rig_.go();
  }
  void reset() {
    rig_.soft_reset();
    sent_ = rig_.sent().size();
    reads();
    const BufferConfig before = rig_.config();
    rig_.configure(other_area());
    const bool moved = rig_.config().first_mailbox() != before.first_mailbox();
    if (moved || rng_() % 2 == 0) masks_and_filters();
    prepare_all();
    rig_.go();
  }

  void lives() {
    SCOPED_TRACE(testing::Message() << "seed " << GetParam());
    status_ = build_under_test() == nullptr || build_under_test()->features.status;
    rig_.configure(other_config());
    masks_and_filters();
    rig_.go();
    for (unsigned step = 0; step < 300 && !HasFailure(); ++step) {
      next_moment();
      for (unsigned i = static_cast<unsigned>(rng_() % 3); i > 0; --i) {
        if (rng_() % 4 == 0)
          raw();
        else
          software();
      }
      switch (rng_() % 24) {
        case 0: freeze(); break;
        case 1: sleep(); break;
        case 2: reset(); break;
        default: break;
      }
      if (step % 25 != 24) continue;
      rig_.disturb(0, 0);
      rig_.quiet();
      rig_.compare();
      final_status();
    }
  }
  bool extras_ = build_under_test() == nullptr || build_under_test()->features.extras;
  bool fifo_ = build_under_test() == nullptr || build_under_test()->features.fifo;
};

TEST_P(RandomLives, Lockstep) { lives(); }

INSTANTIATE_TEST_SUITE_P(Seeds, RandomLives, random_seeds(60));

// The profile that lacks every feature: what is left is as in any other core (PK-49).
class RandomSmall : public Random {
 protected:
  RandomSmall() : Random{&core_build("small")} {}
};
TEST_P(RandomSmall, Lockstep) { lockstep(); }
INSTANTIATE_TEST_SUITE_P(Seeds, RandomSmall, random_seeds(30));

class RandomAtEventsSmall : public RandomAtEvents {
 protected:
  RandomAtEventsSmall() : RandomAtEvents{&core_build("small")} {}
};
TEST_P(RandomAtEventsSmall, Lockstep) { lockstep(); }
INSTANTIATE_TEST_SUITE_P(Seeds, RandomAtEventsSmall, random_seeds(30));

}  // namespace
}  // namespace vericansim
