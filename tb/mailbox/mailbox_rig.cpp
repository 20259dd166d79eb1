// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MailboxRig: see mailbox_rig.hpp.
#include "mailbox/mailbox_rig.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace vericansim {

MbWords mb_words(const Frame &frame, unsigned code) {
  MbWords words;
  words.cs = (code << 24) | (std::uint32_t{frame.dlc} << 16);
  if (frame.remote) words.cs |= reg::kCsRtr;
  if (frame.extended) words.cs |= reg::kCsIde | reg::kCsSrr;
  words.id = frame.extended ? frame.id : frame.id << 18;
  for (unsigned i = 0; i < 4; ++i) {
    words.low |= std::uint32_t{frame.data[i]} << (24 - 8 * i);
    words.high |= std::uint32_t{frame.data[4 + i]} << (24 - 8 * i);
  }
  return words;
}

Frame mb_frame(const MbWords &words) {
  Frame frame;
  frame.extended = (words.cs & reg::kCsIde) != 0;
  frame.remote = (words.cs & reg::kCsRtr) != 0;
  frame.dlc = (words.cs >> 16) & 0xF;
  frame.id = frame.extended ? words.id & 0x1FFFFFFF : (words.id >> 18) & 0x7FF;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] =
        static_cast<std::uint8_t>((i < 4 ? words.low : words.high) >> (24 - 8 * (i % 4)));
  return frame;
}

namespace {
std::vector<std::unique_ptr<RtlNode>> make_nodes(unsigned count, const CoreBuild &build) {
  std::vector<std::unique_ptr<RtlNode>> nodes;
  for (unsigned n = 0; n < count; ++n)
    nodes.push_back(make_node("node" + std::to_string(n), build));
  return nodes;
}
}  // namespace

MailboxRig::MailboxRig(unsigned nodes, unsigned num_mb)
    : MailboxRig{nodes, CoreBuild{.num_mb = num_mb}} {}
MailboxRig::MailboxRig(unsigned nodes, const CoreBuild &build)
    : MailboxRig{make_nodes(nodes, build)} {}

MailboxRig::MailboxRig(std::vector<std::unique_ptr<RtlNode>> nodes)
    : num_mb_{nodes.front()->num_mb()},
      nodes_{std::move(nodes)},
      hammers_(nodes_.size()),
      last_(nodes_.size()) {
  for (auto &node : nodes_) bus_.add(*node);
  wave_.emplace(bus_);
}

void MailboxRig::step() {
  for (unsigned n = 0; n < nodes_.size(); ++n) {
    if (!hammers_[n]) continue;
    // One transfer in its data phase and one in its address phase, at least.
    while (last_[n] < 2 || node(n).master().done(last_[n] - 2))
      last_[n] = node(n).master().submit(hammers_[n]()) + 1;
  }
  bus_.step();
}

AhbResult MailboxRig::access(unsigned n, const AhbTransfer &transfer) {
  const BusMaster::Ticket ticket = node(n).master().submit(transfer);
  last_[n] = ticket + 1;
  while (!node(n).master().done(ticket)) step();
  return node(n).master().result(ticket);
}

std::vector<AhbResult> MailboxRig::burst(unsigned n, const std::vector<AhbTransfer> &transfers) {
  std::vector<BusMaster::Ticket> tickets;
  for (const AhbTransfer &transfer : transfers)
    tickets.push_back(node(n).master().submit(transfer));
  last_[n] = tickets.back() + 1;
  while (!node(n).master().done(tickets.back())) step();
  std::vector<AhbResult> results;
  for (BusMaster::Ticket ticket : tickets) results.push_back(node(n).master().result(ticket));
  return results;
}

void MailboxRig::run(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) step();
}

bool MailboxRig::run_until(const std::function<bool()> &done, unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) {
    if (done()) return true;
    step();
  }
  return done();
}

void MailboxRig::configure(unsigned n, const RigConfig &config) {
  write(n, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt);
  if (!run_until([&] { return (read(n, reg::kMcr) & reg::kMcrFrzAck) != 0; }, 1000))
    throw std::runtime_error("no freeze mode after reset");
  write(n, reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | reg::kMcrWrnEn | config.mcr | (num_mb_ - 1));
  write(n, reg::kCtrl, config.ctrl);
  for (unsigned mb = 0; mb < num_mb_; ++mb) write(n, reg::rximr(mb), 0xFFFFFFFF);
}

void MailboxRig::go(unsigned n) {
  write(n, reg::kMcr, read(n, reg::kMcr) & ~(reg::kMcrFrz | reg::kMcrHalt));
  const auto synch = [&] { return (read(n, reg::kEsr) & (1u << 18)) != 0; };
  if (!run_until(synch, 4000)) throw std::runtime_error("the node does not integrate");
}

bool MailboxRig::freeze(unsigned n, unsigned clocks) {
  write(n, reg::kMcr, read(n, reg::kMcr) | reg::kMcrFrz | reg::kMcrHalt);
  return run_until([&] { return (read(n, reg::kMcr) & reg::kMcrFrzAck) != 0; }, clocks);
}

void MailboxRig::put(unsigned n, unsigned mb, const MbWords &words) {
  write(n, reg::mb(mb, 2), words.low);
  write(n, reg::mb(mb, 3), words.high);
  write(n, reg::mb(mb, 1), words.id);
  write(n, reg::mb(mb, 0), words.cs);
}

void MailboxRig::put_rx(unsigned n, unsigned mb, const Frame &like,
                        std::optional<std::uint32_t> mask) {
  MbWords words = mb_words(like, 0x4);
  words.cs &= reg::kCodeMask | reg::kCsIde;
  write(n, reg::mb(mb, 0), 0);
  if (mask) write(n, reg::rximr(mb), *mask);
  write(n, reg::mb(mb, 1), words.id);
  write(n, reg::mb(mb, 0), words.cs);
}

MbWords MailboxRig::get(unsigned n, unsigned mb) {
  MbWords words;
  do words.cs = read(n, reg::mb(mb, 0));
  while ((words.cs & reg::kCodeRxBusy) != 0 && words.code() < 8);
  words.id = read(n, reg::mb(mb, 1));
  words.low = read(n, reg::mb(mb, 2));
  words.high = read(n, reg::mb(mb, 3));
  return words;
}

std::uint64_t MailboxRig::flags(unsigned n) {
  const std::uint64_t high = num_mb_ > 32 ? read(n, reg::kIflag2) : 0;
  return (high << 32) | read(n, reg::kIflag1);
}

void MailboxRig::clear_flag(unsigned n, unsigned mb) {
  write(n, mb < 32 ? reg::kIflag1 : reg::kIflag2, 1u << (mb % 32));
}

bool MailboxRig::wait_flag(unsigned n, unsigned mb, unsigned clocks) {
  const Time limit = bus_.now() + static_cast<Time>(clocks) * 125 * kNanosecond;
  while (bus_.now() < limit)
    if (((flags(n) >> mb) & 1) != 0) return true;
  return false;
}

bool MailboxRig::violated() const {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [](const auto &node) { return !node->master().report().violations.empty(); });
}

unsigned MailboxRig::max_waits() const {
  unsigned waits = 0;
  for (const auto &node : nodes_) waits = std::max(waits, node->master().report().max_waits);
  return waits;
}

}  // namespace vericansim
