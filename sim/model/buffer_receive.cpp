// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferState, reception: which buffer a frame goes to, and what it does there (3.2, 3.5, 4).
#include <algorithm>

#include "model/buffer_state.hpp"

namespace vericansim {
namespace {

using Kind = Destination::Kind;

void add(std::vector<Destination> &list, const Destination &item) {
  if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

/// The filter table, from MB6 on.
std::vector<std::uint32_t> filter_table(const BufferState &state, const BufferConfig &config) {
  std::vector<std::uint32_t> table;
  for (unsigned i = 0; i < config.filter_elements(); ++i)
    table.push_back(state.mb[6 + i / 4].words.word[i % 4]);
  return table;
}

}  // namespace

KnownWords received_words(const ArrivedFrame &arrived) {
  const Frame &frame = arrived.frame;
  KnownWords words;
  words.word[0] = (std::uint32_t{frame.dlc} << 16) | arrived.stamp.value_or(0);
  if (frame.remote) words.word[0] |= 1u << 20;
  if (frame.extended) words.word[0] |= (1u << 21) | (1u << 22);
  if (!frame.extended) words.known[0] &= ~(1u << 22);  // SRR of a standard frame: open
  words.word[1] = frame.extended ? frame.id : frame.id << 18;
  words.known[1] = 0x1FFFFFFF;  // PRIO of a received frame: open
  words.known[2] = words.known[3] = 0;
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    const unsigned shift = 24 - 8 * (i % 4);
    words.word[2 + i / 4] |= std::uint32_t{frame.data[i]} << shift;
    words.known[2 + i / 4] |= 0xFFu << shift;
  }
  words.stamped = arrived.stamp.has_value();
  if (!words.stamped) words.known[0] &= ~0xFFFFu;
  return words;
}

bool BufferState::free_to_receive(unsigned n, bool open_as) const {
  if (lock == n || (released && released->first == n)) return false;
  if (mb[n].code() == kRxEmpty) return true;
  if (mb[n].serviced == Serviced::kOpen) return open_as;
  return mb[n].serviced == Serviced::kYes;
}

// As the match may find it, which looks at one buffer after the other (3.5): a lock or a mark that
// the CPU has moved since the header stood or did not.
bool BufferState::found_free(unsigned n, bool open_as) const {
  return ((lock_moved >> n) & 1) != 0 ? open_as : free_to_receive(n, open_as);
}

// The mailboxes that the rules of 3.5 may name, and kNowhere. Open are the service of some buffers,
// and whether one that the CPU has written since the header is looked at still: the write takes it
// out of the round (3.4), but how far the round was is not said.
void BufferState::mailbox_choices(const ArrivedFrame &arrived, const BufferMasks &masks,
                                  const BufferConfig &config, std::vector<Destination> &out) const {
  std::vector<unsigned> matches;
  for (unsigned n = config.first_mailbox(); n <= config.maxmb && n < config.num_mb; ++n) {
    const auto &words = mb[n].words.word;
    if (!code_receives(mb[n].code())) continue;
    const std::uint32_t mask = masks.of_mailbox(n, config.bcc);
    if (mailbox_accepts(arrived.frame, words[0], words[1], mask, config)) matches.push_back(n);
  }
  for (const unsigned n : matches) {  // BCC=1: the first free one; BCC=0: the first
    if (config.bcc && !found_free(n, true)) continue;
    add(out, {Kind::kMailbox, n});
    if (looked_at(n) && (!config.bcc || found_free(n, false))) return;
  }
  if (config.bcc) {  // none is free: the last
    for (auto n = matches.rbegin(); n != matches.rend(); ++n) {
      const bool taken = !found_free(*n, false);
      if (taken) add(out, {Kind::kMailbox, *n});
      if (taken && looked_at(*n)) return;
    }
  }
  add(out, {Kind::kNowhere, 0});
}

// As above; where no mailbox stores the frame, the first one that waits with an answer to it (3.7).
std::vector<Destination> BufferState::without_fifo(const ArrivedFrame &arrived,
                                                   const BufferMasks &masks,
                                                   const BufferConfig &config) const {
  std::vector<Destination> out;
  mailbox_choices(arrived, masks, config, out);
  if (out.back().kind != Kind::kNowhere) return out;
  out.pop_back();
  for (unsigned n = config.first_mailbox(); n <= config.maxmb && n < config.num_mb; ++n) {
    const auto &words = mb[n].words.word;
    if (mb[n].code() != kTxAnswerWaits || !answer_fits(arrived.frame, words[0], words[1], config))
      continue;
    add(out, {Kind::kAnswer, n});
    if (looked_at(n)) return out;
  }
  add(out, {Kind::kNowhere, 0});
  return out;
}

std::vector<Destination> BufferState::destinations(const ArrivedFrame &arrived,
                                                   const BufferMasks &masks,
                                                   const BufferConfig &config) const {
  if (arrived.own && config.srx_dis) return {{Kind::kNowhere, 0}};
  const std::vector<Destination> mailboxes = without_fifo(arrived, masks, config);
  if (!config.fen) return mailboxes;
  const auto hit = fifo_accepts(arrived.frame, filter_table(*this, config), masks, config);
  if (!hit) return mailboxes;
  const bool full = fifo.size() == kFifoDepth;
  const Destination into_fifo{full ? Kind::kOverflow : Kind::kFifo, *hit};
  if (!config.mrp && !full) return {into_fifo};
  std::vector<Destination> out;
  for (const Destination &to : mailboxes) {
    // Whether an answer counts as a free mailbox is open.
    const bool answer = to.kind == Kind::kAnswer;
    const bool nowhere = to.kind == Kind::kNowhere;
    const bool queue = config.bcc && !full && !nowhere;
    const bool free = queue && !answer && found_free(to.index, true);
    const bool taken = queue && !answer && !found_free(to.index, false);
    if (!nowhere && (!queue || free || answer)) add(out, to);
    if (nowhere || taken || (queue && answer)) add(out, into_fifo);
  }
  return out;
}

std::optional<Destination> BufferState::late_place(const BufferMasks &masks,
                                                   const BufferConfig &config) const {
  if (!config.fen || fifo.size() == kFifoDepth) return std::nullopt;
  if (destination.kind == Kind::kOverflow) return Destination{Kind::kFifo, destination.index};
  const bool overruns = destination.kind == Kind::kMailbox && config.bcc &&
                        !free_to_receive(destination.index, false) &&
                        !move_shown(destination.index);
  if (!overruns) return std::nullopt;
  const auto hit = fifo_accepts(matching->frame, filter_table(*this, config), masks, config);
  return hit ? std::optional{Destination{Kind::kFifo, *hit}} : std::nullopt;
}

void BufferState::move_in(unsigned n, const ArrivedFrame &arrived) {
  BufferContent &buffer = mb.change(n);
  const bool was_empty = buffer.code() == kRxEmpty;
  const bool overrun = !was_empty && buffer.serviced != Serviced::kYes;
  const bool open = !was_empty && buffer.serviced == Serviced::kOpen;
  buffer.words = received_words(arrived);
  buffer.words.word[0] |= (overrun ? kRxOverrun : kRxFull) << 24;
  if (open) buffer.words.known[0] &= ~(1u << 26);  // FULL or OVERRUN
  buffer.serviced = Serviced::kNo;
  moving &= ~(std::uint64_t{1} << n);
  iflag |= std::uint64_t{1} << n;
}

void BufferState::push(const ArrivedFrame &arrived, unsigned id_hit) {
  fifo.push_back({arrived, id_hit});
  if (fifo.size() == 5) iflag |= kFlagWarning;
}

void BufferState::store(const ArrivedFrame &arrived, const Destination &to, std::uint64_t now,
                        const BufferConfig &config) {
  switch (to.kind) {
    case Kind::kUndecided:
    case Kind::kNowhere: break;
    case Kind::kFifo: push(arrived, to.index); break;
    case Kind::kOverflow: iflag |= kFlagOverflow; break;
    case Kind::kAnswer: {
      BufferContent &buffer = mb.change(to.index);
      buffer.words.word[0] = (buffer.words.word[0] & ~0x0F000000u) | (kTxAnswer << 24);
      buffer.words.known[0] &= ~0xFFFFu;  // whether the request leaves its stamp is open
      buffer.request = request_of(to.index, config, now);
      break;
    }
    case Kind::kMailbox:
      if (lock == to.index) {
        waiting.emplace(to.index, arrived);
      } else {
        move_in(to.index, arrived);
      }
      break;
  }
}

}  // namespace vericansim
