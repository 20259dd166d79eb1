// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferModel, the accesses of the CPU: see buffer_model.hpp.
#include <fmt/format.h>

#include <algorithm>

#include "model/buffer_model.hpp"
#include "model/registers.hpp"

namespace vericansim {
namespace {

using Kind = Destination::Kind;

constexpr std::uint32_t kCodeLane = 0x0F000000;
constexpr std::uint64_t kMoment = 4;  // clocks

struct Place {
  unsigned n;
  unsigned word;
};

std::optional<Place> buffer_place(std::uint32_t address, unsigned num_mb) {
  if (address < reg::mb(0) || address >= reg::mb(num_mb)) return std::nullopt;
  return Place{(address - 0x080) / 16, (address / 4) % 4};
}

}  // namespace

void BufferModel::cpu_write(std::uint32_t address, std::uint32_t data, std::uint64_t now,
                            std::uint32_t lanes) {
  if (const auto place = buffer_place(address, config_.num_mb)) {
    write_buffer(place->n, place->word, data, lanes, now);
  } else if (address == reg::kIflag1 || address == reg::kIflag2) {
    settle(now);
    const std::uint64_t bits = std::uint64_t{data & lanes} << (address == reg::kIflag2 ? 32 : 0);
    for (BufferState &state : states_) state.clear_flags(bits, config_);
  } else {
    settle(now);
    write_mask(address, data, lanes);
  }
}

namespace {

/// A write that was taken shows that the buffer is not protected, where that is open.
BufferState unguarded(BufferState state, unsigned n) {
  if (state.mb[n].guarded) state.mb.change(n).guarded = false;
  return state;
}

}  // namespace

void BufferModel::write_mask(std::uint32_t address, std::uint32_t data, std::uint32_t lanes) {
  std::uint32_t *mask = nullptr;
  if (address == reg::kRxgmask) mask = &masks_.global;
  if (address == reg::kRx14mask) mask = &masks_.mb14;
  if (address == reg::kRx15mask) mask = &masks_.mb15;
  if (address == reg::kRxfgmask) mask = &masks_.fifo;
  if (address >= reg::rximr(0) && address < reg::rximr(config_.num_mb))
    mask = &masks_.individual[(address - reg::rximr(0)) / 4];
  if (mask != nullptr) *mask = (*mask & ~lanes) | (data & lanes);
}

void BufferModel::write_buffer(unsigned n, unsigned word, std::uint32_t data, std::uint32_t lanes,
                               std::uint64_t now) {
  settle(now);
  const bool mailbox = n >= config_.first_mailbox();
  const bool cs = word == 0 && mailbox;
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        if (cs && config_.aen) return write_cs_aen(state, n, data, lanes, now, out);
        if (cs) return write_cs(state, n, data, lanes, now, out);
        const bool guarded = config_.aen && mailbox && state.mb[n].guarded;
        if (guarded) out.add(state);
        const unsigned code = state.mb[n].code();
        if (guarded && (code == kTxInactive || code == kTxAbort)) return;
        BufferState next = unguarded(state, n);
        next.write(n, word, data, lanes, config_, now);
        out.add(std::move(next));
      },
      [] { return "no state is left"; });
}

// The write takes effect; a match that had chosen this buffer is lost or made again (3.5).
void BufferModel::take_write(BufferState state, unsigned n, std::uint32_t data, std::uint32_t lanes,
                             std::uint64_t now, DistinctStates &out) const {
  const Destination &to = state.destination;
  const bool chosen = (to.kind == Kind::kMailbox || to.kind == Kind::kAnswer) && to.index == n;
  if (const ArrivedFrame *const arrived = state.on_its_way(n)) {
    // Cut short: words that nobody promises from here on.
    const KnownWords arriving = received_words(*arrived);
    KnownWords &words = state.mb.change(n).words;
    for (unsigned i = 1; i < 4; ++i)
      words.known[i] &= arriving.known[i] & ~(words.word[i] ^ arriving.word[i]);
  }
  state.write(n, 0, data, lanes, config_, now);
  if (chosen) {
    BufferState again = state;
    again.destination = {};
    out.add(std::move(again));
    state.destination = {Kind::kNowhere, 0};
  }
  out.add(std::move(state));
}

void BufferModel::write_cs(const BufferState &state, unsigned n, std::uint32_t data,
                           std::uint32_t lanes, std::uint64_t now, DistinctStates &out) const {
  take_write(state, n, data, lanes, now, out);
}

// AEN=1 (3.4): writes to a buffer that is moved out have no effect, but 1001 is remembered.
void BufferModel::write_cs_aen(const BufferState &given, unsigned n, std::uint32_t data,
                               std::uint32_t lanes, std::uint64_t now, DistinctStates &out) const {
  const unsigned before = given.mb[n].code();
  const bool abort = (lanes & kCodeLane) != 0 && cs_code(data) == kTxAbort;
  if (given.write_blocked(n)) {
    BufferState next = given;
    if (abort && next.flight) next.flight->abort = true;
    if (abort && next.moved_out == n) next.moved_out_abort = true;
    return out.add(std::move(next));
  }
  // Whether the flag of an answer, or of a request that turned into an Rx buffer, protects is open.
  if (given.mb[n].guarded) out.add(given);
  if (given.mb[n].guarded && (before == kTxInactive || before == kTxAbort)) return;
  const BufferState state = unguarded(given, n);
  if (abort && before == kTxAnswerWaits) out.add(state);
  // In the moment in which an attempt fails the buffer may still count as moved out.
  if (state.mb[n].request && !abort && now <= ended_at_ + kMoment) out.add(state);
  if (state.mb[n].request && !state.moved_out && !state.flight) {
    BufferState next = state;
    next.moved_out = n;
    next.moved_out_abort = abort;
    next.moved_out_since = now;
    out.add(std::move(next));
  }
  // Whether 1001 in a buffer with nothing to abort, a waiting answer included, sets the flag is
  // open.
  DistinctStates written;
  take_write(state, n, data, lanes, now, written);
  for (BufferState &next : written.take()) {
    if (!abort || !code_sends(before)) out.add(next);
    if (!abort) continue;
    next.withdraw(n, now);
    next.abort(n, now);
    next.mb.change(n).words.known[0] &= kCodeLane | ~kCsStored;
    out.add(std::move(next));
  }
}

KnownWords BufferModel::words_of(const BufferState &state, unsigned n) const {
  if (!config_.fen || n >= 6) return state.mb[n].words;
  KnownWords words;
  if (n == 0 && !state.fifo.empty()) return received_words(state.fifo.front().frame);
  words.known = {};  // internal, or the output of an empty FIFO
  return words;
}

bool BufferModel::fits(const KnownWords &words, unsigned word, std::uint32_t value) const {
  std::uint32_t known = words.known[word];
  if (word == 0 && words.stamped) {
    if ((known & 0xFFFF) == 0xFFFF) {
      const int offset = static_cast<std::int16_t>(value - words.word[0]);
      const bool exact = stamp_offset_ && !stamps_moved_;
      if (exact ? offset != *stamp_offset_ : std::abs(offset) > (stamps_moved_ ? 2 : 1))
        return false;
    }
    known &= ~0xFFFFu;
  }
  return ((value ^ words.word[word]) & known) == 0;
}

std::string BufferModel::allowed(unsigned n, unsigned word) const {
  std::string text;
  for (const BufferState &state : states_) {
    const KnownWords words = words_of(state, n);
    text += fmt::format(" {:08X} (known {:08X})", words.word[word], words.known[word]);
    if (text.size() > 400) return text + " ...";
  }
  return text;
}

// A frame on its way in replaces one word after the other; the flag is set after the last (3.5).
void BufferModel::read_word(unsigned n, unsigned word, std::uint32_t value) {
  const auto stands = [&](const BufferState &state) {
    return fits(words_of(state, n), word, value);
  };
  const auto replaced = [&](const BufferState &state) {
    const ArrivedFrame *const arrived = state.on_its_way(n);
    return arrived != nullptr && fits(received_words(*arrived), word, value);
  };
  keep([&](const BufferState &state) { return stands(state) || replaced(state); },
       [&] {
         return fmt::format("MB{} word {} reads {:08X}; allowed:{}", n, word, value,
                            allowed(n, word));
       });
  for (BufferState &state : states_)
    if (!stands(state)) state.show_move(n);
}

// All stamps stand in the same relation to the reference count; the first one read says in which.
void BufferModel::learn_stamp(unsigned n, std::uint32_t value) {
  if (stamp_offset_ || !ok()) return;
  const KnownWords words = words_of(states_.front(), n);
  if (words.stamped && (words.known[0] & 0xFFFF) == 0xFFFF)
    stamp_offset_ = static_cast<std::int16_t>(value - words.word[0]);
}

void BufferModel::read_cs(unsigned n, std::uint32_t value, std::uint64_t now) {
  const bool mailbox = n >= config_.first_mailbox();
  const bool shows_busy = mailbox && ((value >> 24) & 9) == 1;
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        const KnownWords words = words_of(state, n);
        // A move in progress may show as BUSY; it does not lock then.
        const bool moves = state.on_its_way(n) != nullptr;
        const bool busy = shows_busy && moves;
        if (!busy && (state.move_shown(n) || !fits(words, 0, value))) return;
        BufferState next = state;
        if (busy) next.show_move(n);
        if (next.lock && next.lock != n) {
          if (!mailbox) out.add(state);  // whether the FIFO's output ends a lock is open
          next.unlock(true, now);
        }
        if (busy) return out.add(std::move(next));
        if (next.read_locks(n, config_)) next.lock_for_read(n);
        out.add(std::move(next));
      },
      [&] { return fmt::format("MB{} C/S reads {:08X}; allowed:{}", n, value, allowed(n, 0)); });
  if (!shows_busy) learn_stamp(n, value);  // beside BUSY the stamp may be the new frame's already
}

void BufferModel::read_flags(unsigned half, std::uint32_t value) {
  const auto flags_of = [this, half](const BufferState &state) {
    return static_cast<std::uint32_t>(state.flags(config_.fen) >> (32 * half));
  };
  keep([&](const BufferState &state) { return flags_of(state) == value; },
       [&] {
         std::string expected;
         for (const BufferState &state : states_)
           if (expected.size() < 200) expected += fmt::format(" {:08X}", flags_of(state));
         return fmt::format("IFLAG{} reads {:08X}; allowed:{}", half + 1, value, expected);
       });
}

void BufferModel::cpu_read(std::uint32_t address, std::uint32_t value, std::uint64_t now) {
  settle(now);
  if (const auto place = buffer_place(address, config_.num_mb)) {
    if (place->word == 0) return read_cs(place->n, value, now);
    return read_word(place->n, place->word, value);
  }
  if (address == reg::kIflag1 || address == reg::kIflag2)
    return read_flags(address == reg::kIflag2 ? 1 : 0, value);
  if (address == reg::kTimer)
    for (BufferState &state : states_) state.unlock(true, now);
  if (address != reg::kRxfir) return;
  keep(
      [&](const BufferState &state) {
        if (!config_.fen) return value == 0;
        return state.fifo.empty() || state.fifo.front().id_hit == value;
      },
      [&] {
        if (!config_.fen) return fmt::format("RXFIR reads {} without the FIFO, not 0", value);
        return fmt::format("RXFIR reads {}, another filter accepted the frame", value);
      });
}

}  // namespace vericansim
