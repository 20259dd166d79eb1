// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_rx: the chosen buffer against a model of the comparison table and the selection
// (flexcan.md 3.5), and of the search for the buffer that answers (3.7).
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>

#include "Vcan_mb_rx.h"
#include "verilated.h"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 64;

struct Buffer {
  unsigned code = 0;
  bool serviced = false, ide = false, rtr = false;
  std::uint32_t id = 0, mask = 0;
  [[nodiscard]] std::uint32_t cs() const {
    return (std::uint32_t{serviced} << 31) | (code << 24) | (std::uint32_t{ide} << 21) |
           (std::uint32_t{rtr} << 20);
  }
};

struct Header {
  std::uint32_t id = 0;  ///< as in the ID word
  bool ide = false, rtr = false;
};

class MbRx : public ::testing::TestWithParam<unsigned> {
 protected:
  MbRx() {
    top_.rst_ni = 0;
    top_.eval();
    top_.rst_ni = 1;
    top_.maxmb_i = 63;
    top_.bcc_i = GetParam() & 1;
    top_.eacen_i = (GetParam() >> 1) & 1;
    top_.rrs_i = (GetParam() >> 2) & 1;
  }

  bool asks(const Header &header) const { return header.rtr && top_.rrs_i == 0; }

  bool matches(unsigned i, const Header &header) const {
    const Buffer &buffer = buffers_[i];
    if (i > top_.maxmb_i || i < top_.first_i) return false;
    if (asks(header))
      return buffer.code == 0xA && buffer.ide == header.ide &&
             buffer.id >> (header.ide ? 0 : 18) == header.id >> (header.ide ? 0 : 18);
    if (buffer.code != 4 && buffer.code != 2 && buffer.code != 6) return false;
    const bool compare_ide = top_.eacen_i == 0 || ((buffer.mask >> 30) & 1) != 0;
    const bool compare_rtr = top_.eacen_i != 0 && (buffer.mask >> 31) != 0;
    if (compare_ide && buffer.ide != header.ide) return false;
    if (compare_rtr && buffer.rtr != header.rtr) return false;
    for (unsigned bit = header.ide ? 0 : 18; bit < 29; ++bit)
      if (((buffer.mask >> bit) & 1) != 0 && ((buffer.id ^ header.id) >> bit & 1) != 0)
        return false;
    return true;
  }

  bool free(unsigned i) const {
    const bool locked = top_.lock_i != 0 && top_.lock_idx_i == i;
    const bool filling = top_.waits_i != 0 && top_.waits_idx_i == i;
    return !locked && !filling && (buffers_[i].code == 4 || buffers_[i].serviced);
  }

  std::optional<unsigned> expected(const Header &header) const {
    std::optional<unsigned> last;
    for (unsigned i = 0; i < kBuffers; ++i) {
      if (!matches(i, header)) continue;
      if (free(i) || top_.bcc_i == 0 || asks(header)) return i;
      last = i;
    }
    return last;
  }

  void clock(std::optional<unsigned> write = {}, const Buffer &value = {}) {
    top_.gnt_i = 0;
    top_.eval();
    const bool grant = top_.req_o != 0 && random() % 3 != 0;
    top_.gnt_i = grant;
    const Buffer read = buffers_[top_.idx_o];
    const bool collides = grant && collides_ == top_.idx_o;
    if (collides) collides_.reset();
    if (write) buffers_[*write] = value;
    top_.eval();
    top_.clk_i = 1;
    top_.eval();
    top_.clk_i = 0;
    top_.rx_hdr_i = 0;
    if (grant) {
      top_.cs_i = read.cs();
      top_.id_i = read.id;
      top_.mask_i = top_.ans_o != 0 ? 0xFFFFFFFF : read.mask;  // as can_mb_match reads it
    }
    top_.stale_i = collides;
    if (collides) top_.cs_i = ~read.cs();
    top_.cs_written_i = write.has_value();
    if (write) top_.cs_written_idx_i = *write;
  }

  void start(const Header &header) {
    top_.rx_hdr_i = 1;
    top_.rx_id_i = header.id;
    top_.rx_ide_i = header.ide;
    top_.rx_rtr_i = header.rtr;
    clock();
  }

  void finish() {
    for (unsigned i = 0; i < 400; ++i) clock();
    top_.eval();
    ASSERT_TRUE(top_.done_o);
  }

  /// A search in which the CPU writes what make() returns to buffers, one in three clocks.
  template <typename Make>
  void search_beside_writes(const Header &header, Make make) {
    start(header);
    for (unsigned i = 0; i < 100; ++i) {
      if (random() % 3 != 0)
        clock();
      else
        clock(random() % kBuffers, make());
    }
    finish();
  }

  Buffer random_buffer() {
    static constexpr unsigned kCodes[] = {4, 4, 2, 6, 0, 8, 12, 10};
    Buffer buffer{.code = kCodes[random() % 8],
                  .serviced = random() % 2 == 0,
                  .ide = random() % 2 == 0,
                  .rtr = random() % 2 == 0,
                  .id = ((random() % 4) << 18) | (random() % 2),
                  .mask = random() | random()};
    if (buffer.code != 2 && buffer.code != 6) buffer.serviced = false;
    return buffer;
  }

  Header random_header() {
    Header header{.id = (random() % 4) << 18, .ide = random() % 2 == 0, .rtr = random() % 4 == 0};
    if (header.ide) header.id |= random() % 2;
    return header;
  }

  std::array<Buffer, kBuffers> buffers_{};
  std::optional<unsigned> collides_;  ///< its next read is in the clock of a write to it
  std::uint32_t random() { return static_cast<std::uint32_t>(rng_()); }
  std::mt19937 rng_{3};
  Vcan_mb_rx top_;
};

// FX-3.5.a, FX-3.5.b, FX-3.5.c, FX-3.5.d, FX-3.5.e, FX-3.5.f, FX-3.5.h, FX-3.5.i, FX-3.5.l,
// FX-3.5.m, FX-3.5.n; a buffer that a frame waits for, locked or not, is not free.
TEST_P(MbRx, ChosenBufferIsThatOfTheModel) {
  for (unsigned round = 0; round < 1500; ++round) {
    const unsigned density = random() % 60;
    for (Buffer &buffer : buffers_) {
      buffer = random_buffer();
      if (random() % 60 < density) buffer.code = 0;
    }
    top_.maxmb_i = random() % 4 == 0 ? random() % 64 : 63;
    top_.first_i = random() % 4 == 0 ? 8 + 2 * (random() % 16) : 0;
    // Neither ever concerns a buffer that answers.
    top_.lock_idx_i = random() % kBuffers;
    top_.lock_i = random() % 2 == 0 && buffers_[top_.lock_idx_i].code != 10;
    top_.waits_idx_i = random() % kBuffers;
    top_.waits_i = random() % 2 == 0 && buffers_[top_.waits_idx_i].code != 10;
    const Header header = random_header();
    start(header);
    finish();
    const auto winner = expected(header);
    ASSERT_EQ(top_.hit_o != 0, winner.has_value()) << "round " << round;
    ASSERT_EQ(winner.value_or(top_.hit_idx_o), top_.hit_idx_o) << "round " << round;
    if (winner && !asks(header)) {
      ASSERT_EQ(top_.hit_free_o != 0, free(*winner));
    }
  }
}

TEST_P(MbRx, BuffersTakenAwayMeanwhileAreNotChosen) {  // 3.4: a C/S write removes it from the round
  for (unsigned round = 0; round < 1500; ++round) {
    for (Buffer &buffer : buffers_) buffer = random_buffer();
    const Header header = random_header();
    search_beside_writes(header, [] { return Buffer{}; });
    ASSERT_TRUE(top_.hit_o == 0 || matches(top_.hit_idx_o, header)) << "round " << round;
    // Nothing was added, so if one is left that matched all the time, one must have been found.
    ASSERT_TRUE(top_.hit_o != 0 || !expected(header)) << "round " << round;
  }
}

// 3.4: nor are those that a C/S write has made others, of whatever code, at whatever moment.
TEST_P(MbRx, BuffersRewrittenMeanwhileAreChosenAsTheyAre) {
  for (unsigned round = 0; round < 1500; ++round) {
    for (Buffer &buffer : buffers_) buffer = random_buffer();
    const Header header = random_header();
    search_beside_writes(header, [this] { return random_buffer(); });
    ASSERT_TRUE(top_.hit_o == 0 || matches(top_.hit_idx_o, header)) << "round " << round;
  }
}

// The mark of a buffer that the CPU has read and left (flexcan.md 3.6) may be written as the buffer
// is read for a frame, and the RAM returns anything then. It is a candidate all the same, the last
// one, whose read ends the search, too.
TEST_P(MbRx, BufferMarkedWhileItIsReadIsFound) {  // FX-3.5.a, FX-3.6.g
  const Header header{.id = 0x155u << 18};
  for (const unsigned last : {kBuffers - 1, 20u}) {
    top_.maxmb_i = last;
    for (unsigned i = 0; i <= last; ++i) {
      buffers_.fill({});
      buffers_[i] = {.code = 2, .serviced = true, .id = header.id, .mask = ~0u};
      collides_ = i;
      start(header);
      finish();
      ASSERT_FALSE(collides_) << "buffer " << i << " was not read";
      ASSERT_TRUE(top_.hit_o) << i;
      ASSERT_EQ(top_.hit_idx_o, i);
    }
  }
}

// A buffer that is written while it is read is read again, three times: a move writes it twice, its
// activation three times.
TEST_P(MbRx, BufferThatIsWrittenThreeTimesInARowIsFound) {  // FX-3.5.a
  const Header header{.id = 0x155u << 18};
  for (unsigned writes = 1; writes <= 3; ++writes) {
    buffers_.fill({});
    buffers_[9] = {.code = 4, .id = header.id, .mask = ~0u};
    unsigned left = writes;
    start(header);
    for (unsigned i = 0; i < 400; ++i) {
      if (!collides_ && left != 0) --left, collides_ = 9;
      clock();
    }
    ASSERT_FALSE(collides_) << writes << ": was read less often";
    ASSERT_TRUE(top_.done_o != 0 && top_.hit_o != 0) << writes;
    ASSERT_EQ(top_.hit_idx_o, 9);
  }
}

// A CPU that writes one C/S word without end does not hold up the search, whatever it writes.
TEST_P(MbRx, BufferThatIsWrittenWithoutEndHoldsNothingUp) {  // FX-3.5.a
  const Header header{.id = 0x155u << 18};
  for (const unsigned code : {0u, 4u, 8u, 12u})
    for (const unsigned every : {1u, 2u, 3u}) {
      buffers_.fill({});
      buffers_[10] = {.code = code, .id = 0x2AAu << 18, .mask = ~0u};
      buffers_[40] = {.code = 4, .id = header.id, .mask = ~0u};
      start(header);
      for (unsigned i = 0; i < 300; ++i) {
        if (i % every == 0)
          clock(10, buffers_[10]);
        else
          clock();
      }
      ASSERT_TRUE(top_.done_o != 0 && top_.hit_o != 0) << code << ' ' << every;
      ASSERT_EQ(top_.hit_idx_o, 40);
    }
}

INSTANTIATE_TEST_SUITE_P(BccEacenRrs, MbRx, ::testing::Range(0u, 8u));

}  // namespace
}  // namespace vericansim
