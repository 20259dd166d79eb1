// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferState, the CPU's side and transmission: see buffer_state.hpp. Reception is in
// buffer_receive.cpp.
#include "model/buffer_state.hpp"

#include <algorithm>
#include <bit>

namespace vericansim {
namespace {

constexpr std::uint32_t kStampBits = 0xFFFF;
constexpr std::uint32_t kOneShotBit = 1u << 28;

void set_code(KnownWords &words, unsigned code) {
  words.word[0] = (words.word[0] & ~0x0F000000u) | (std::uint32_t{code} << 24);
  words.known[0] |= 0x0F000000;
}

void set_stamp(KnownWords &words, Stamp stamp) {
  words.word[0] = (words.word[0] & ~kStampBits) | stamp.value_or(0);
  words.known[0] = stamp ? words.known[0] | kStampBits : words.known[0] & ~kStampBits;
  words.stamped = stamp.has_value();
}

}  // namespace

std::uint64_t BufferState::digest() const {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15;
  std::uint64_t sum = mb.digest();
  const auto add = [&sum](std::uint64_t value) { sum = std::rotl((sum ^ value) * kFactor, 29); };
  add(iflag);
  add(std::uint64_t{lock.value_or(~0u)} << 32 | (flight ? flight->mb : ~0u));
  add(std::uint64_t{waiting ? waiting->first : ~0u} << 32 | (released ? released->first : ~0u));
  add(std::uint64_t{moved_out.value_or(~0u)} << 32 | destination.index);
  add(left_round * 3 ^ lock_moved * 5 ^ moving * 7);
  add(fifo.size() << 8 | static_cast<unsigned>(destination.kind) << 4 |
      unsigned{matching.has_value()} << 2 | unsigned{ended.has_value()} << 1 | unsigned{valid});
  return sum;
}

SendRequest BufferState::request_of(unsigned n, const BufferConfig &config,
                                    std::uint64_t now) const {
  const auto &words = mb[n].words.word;
  return {.frame = buffer_frame(words),
          .value = arbitration_value(n, words[0], words[1], config),
          .since = now,
          .one_shot = config.one_shot || (config.osmb && mb[n].one_shot)};
}

void BufferState::withdraw(unsigned n, std::uint64_t now) {
  if (!mb[n].request) return;
  auto &request = mb.change(n).request;
  request->until = now;
  withdrawn.emplace_back(n, *request);
  request.reset();
}

void BufferState::write(unsigned n, unsigned word, std::uint32_t data, std::uint32_t lanes,
                        const BufferConfig &config, std::uint64_t now) {
  BufferContent &buffer = mb.change(n);
  KnownWords &words = buffer.words;
  const bool mailbox = n >= config.first_mailbox();
  const bool cs = word == 0 && mailbox;
  const std::uint32_t stored = cs ? data & kCsStored : data;
  words.word[word] = (words.word[word] & ~lanes) | (stored & lanes);
  words.known[word] |= lanes;
  if (!cs) return;
  if ((lanes & kStampBits) != 0) words.stamped = false;
  if ((lanes & kOneShotBit) != 0)
    buffer.one_shot = config.osmb && (data & kOneShotBit) != 0 && buffer.code() == kTxActive;
  if (matching) left_round |= std::uint64_t{1} << n;
  // A C/S write ends the lock, the pending frame and the request of this buffer (3.4).
  if (lock == n) lock.reset();
  if (waiting && waiting->first == n) waiting.reset();
  if (released && released->first == n) released.reset();
  moving &= ~(std::uint64_t{1} << n);
  if (flight && flight->mb == n) flight->orphan = true;
  if (ended && ended->flight.mb == n) ended->flight.orphan = true;
  withdraw(n, now);
  buffer.serviced = code_receives(buffer.code()) ? Serviced::kOpen : Serviced::kNo;
  if (!code_sends(buffer.code()) || !config.takes_part(n)) return;
  buffer.request = request_of(n, config, now);
}

bool BufferState::write_blocked(unsigned n) const {
  return (flight && flight->mb == n) || (ended && ended->flight.mb == n) || moved_out == n;
}

bool BufferState::read_locks(unsigned n, const BufferConfig &config) const {
  if (n < config.first_mailbox()) return false;
  const unsigned code = mb[n].code();
  return code == kRxFull || code == kRxOverrun || (!config.bcc && code == kRxEmpty);
}

void BufferState::lock_for_read(unsigned n) {
  lock = n;
  const bool filling = released && released->first == n;  // not free before, nor now
  if (matching && !filling) lock_moved |= std::uint64_t{1} << n;
  if (!filling) return;
  waiting = released;  // locked again before it moved
  released.reset();
}

const ArrivedFrame *BufferState::on_its_way(unsigned n) const {
  if (lock == n) return nullptr;
  if (released && released->first == n) return &released->second;
  return valid && destination == Destination{Destination::Kind::kMailbox, n} ? &*matching : nullptr;
}

void BufferState::end_round() {
  matching.reset();
  destination = {};
  valid = false;
  left_round = 0;
  lock_moved = 0;
}

void BufferState::unlock(bool read, std::uint64_t now) {
  if (!lock) return;
  if (read) mb.change(*lock).serviced = Serviced::kYes;
  if (matching && !waiting) lock_moved |= std::uint64_t{1} << *lock;
  lock.reset();
  if (!waiting) return;
  released = waiting;
  released_since = now;
  waiting.reset();
}

void BufferState::release() {
  const auto [n, frame] = *released;
  released.reset();
  move_in(n, frame);
}

void BufferState::abort(unsigned n, std::uint64_t now) {
  withdraw(n, now);
  BufferContent &buffer = mb.change(n);
  set_code(buffer.words, kTxAbort);
  buffer.guarded = true;
  iflag |= std::uint64_t{1} << n;
}

void BufferState::clear_flags(std::uint64_t bits, const BufferConfig &config) {
  if (config.fen) {
    if ((bits & kFlagAvailable) != 0 && !fifo.empty()) fifo.erase(fifo.begin());
    bits &= ~kFlagAvailable;
  }
  iflag &= ~bits;
  for (unsigned n = 0; n < mb.size(); ++n)
    if (((bits >> n) & 1) != 0 && mb[n].guarded) mb.change(n).guarded = false;
}

void BufferState::area_changed(bool fifo_too) {
  lock.reset();
  waiting.reset();
  if (!fifo_too) return;
  fifo.clear();
  iflag &= ~(kFlagAvailable | kFlagWarning | kFlagOverflow);
  for (unsigned n = 0; n < 6; ++n) mb.change(n).words = {.word = {}, .known = {}};
}

void BufferState::soft_reset() {
  iflag = 0;
  lock.reset();
  waiting.reset();
  released.reset();
  moving = 0;
  fifo.clear();
  flight.reset();
  ended.reset();
  moved_out.reset();
  end_round();
  for (unsigned n = 0; n < mb.size(); ++n) {
    BufferContent &buffer = mb.change(n);
    buffer.serviced = Serviced::kNo;
    buffer.guarded = false;
  }
}

void BufferState::finish(const FlightEnd &end, std::uint64_t now) {
  const Flight &flight_ended = end.flight;
  if (flight_ended.orphan) return;
  BufferContent &buffer = mb.change(flight_ended.mb);
  const bool answer = buffer.code() == kTxAnswer;
  if (!end.success) {
    if (flight_ended.abort || flight_ended.request.one_shot) {
      abort(flight_ended.mb, now);
      buffer.words.known[0] &= ~kStampBits;  // whether a failed frame leaves its stamp is open
    } else {
      buffer.request = flight_ended.request;
    }
    return;
  }
  withdraw(flight_ended.mb, now);
  set_stamp(buffer.words, end.stamp);
  if (answer) {
    set_code(buffer.words, kTxAnswerWaits);
  } else if (flight_ended.request.frame.remote) {
    set_code(buffer.words, kRxEmpty);
    buffer.serviced = Serviced::kNo;
  } else {
    set_code(buffer.words, kTxInactive);
  }
  iflag |= std::uint64_t{1} << flight_ended.mb;
  buffer.guarded = true;
}

}  // namespace vericansim
