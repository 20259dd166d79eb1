// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The recordings, see scenarios.hpp. Each checks that it got where it wanted to, so that a
// recording of a core that did nothing is not taken for one.
#include "four_state/scenarios.hpp"

#include <stdexcept>
#include <string>

#include "bus/faults.hpp"

namespace vericansim {
namespace {

constexpr Time kClock = 125'000;  // ps, 8 MHz
constexpr unsigned kBit = 8;      // clocks
constexpr unsigned kTxMb = 8;
constexpr unsigned kRxMb = 3;
constexpr std::uint32_t kWindow = 0x2000;  // bytes

void need(bool done, const char *what) {
  if (!done) throw std::runtime_error(std::string{"recording: "} + what);
}

void bring_up(MailboxRig &rig, const RigConfig &config = {}) {
  for (unsigned n : {0u, 1u}) rig.configure(n, n == 0 ? config : RigConfig{});
  for (unsigned n : {0u, 1u}) {
    rig.write(n, reg::kCtrl2, reg::kCtrl2Rrs);  // remote frames are stored like others
    rig.put_rx(n, kRxMb, {.id = 0x155}, 0);
    rig.put_rx(n, kRxMb + 1, {.id = 0x155, .extended = true}, 0);
    rig.write(n, reg::kImask1, 0xFFFFFFFF);
  }
  rig.go(0);
  rig.go(1);
}

// From reset on: every address, while the buffer RAM is still being cleared and afterwards, in
// disable and in freeze mode; all sizes; errors; patterns into everything; soft reset.
void registers(MailboxRig &rig) {
  const auto read_all = [&](std::uint32_t step) {
    for (std::uint32_t address = 0; address < 0xC00; address += step)
      (void)rig.access(0, {.address = address});
    for (std::uint32_t address = 0x1000; address < 0x1020; address += 4)
      (void)rig.access(0, {.address = address});
  };
  for (std::uint32_t address = 0x80; address < 0xC0; address += 4) (void)rig.read(0, address);
  read_all(4);
  rig.configure(0);
  read_all(4);
  for (const std::uint32_t pattern : {0xFFFFFFFFu, 0x00000000u, 0xA5C3'96F0u}) {
    // Not MCR and CTRL1: the core stays where it can be written.
    for (std::uint32_t address = 8; address < 0xA00; address += pattern == 0 ? 4 : 12)
      rig.write(0, address, pattern);
    read_all(20);
  }
  for (std::uint32_t address = 0x80; address < 0x90; ++address) {
    (void)rig.access(0, {.address = address, .write = true, .size = AhbSize::kByte, .data = 0x5A});
    (void)rig.access(0, {.address = address, .size = AhbSize::kByte});
    (void)rig.access(0, {.address = address & ~1u, .size = AhbSize::kHalf});
  }
  need(rig.access(0, {.address = 0x81}).error, "an unaligned access gets no ERROR");
  need(rig.access(0, {.address = kWindow}).error, "an access beyond the window gets no ERROR");
  rig.write(0, reg::kMcr, rig.read(0, reg::kMcr) | reg::kMcrSoftRst);
  need(rig.run_until([&] { return (rig.read(0, reg::kMcr) & reg::kMcrSoftRst) == 0; }, 200),
       "soft reset does not end");
  read_all(28);
}

// Base and extended, data and remote frames, sent and received; some buffers locked on the way.
void frames(MailboxRig &rig) {
  bring_up(rig);
  const Frame kinds[] = {
      {.id = 0x123, .dlc = 8, .data = {1, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF}},
      {.id = 0x1ABCDE5, .extended = true, .dlc = 3, .data = {0, 0, 0}},
      {.id = 0x7FF, .remote = true, .dlc = 4},
      {.id = 0x1FFFFFFF, .extended = true, .remote = true, .dlc = 0},
  };
  for (unsigned sender : {0u, 1u}) {
    for (const Frame &frame : kinds) {
      const unsigned mb = kRxMb + frame.extended;
      rig.put_tx(sender, kTxMb, frame);
      need(rig.wait_flag(sender, kTxMb), "a frame is not sent");
      need(rig.wait_flag(1 - sender, mb), "a frame is not received");
      (void)rig.get(1 - sender, mb);
      (void)rig.read(1 - sender, reg::kTimer);
      for (unsigned n : {0u, 1u}) rig.write(n, reg::kIflag1, 0xFFFFFFFF);
    }
  }
  rig.put_tx(0, kTxMb, kinds[0]);  // one that is aborted
  rig.put(0, kTxMb + 1, mb_words(kinds[2], 0xC));
  rig.write(0, reg::mb(kTxMb), 0x9u << 24);
  rig.run(200 * kBit);
}

// The Rx FIFO with each format of filters, overflow, output by reading.
void fifo(MailboxRig &rig) {
  bring_up(rig, {.mcr = reg::kMcrBcc | reg::kMcrSrxDis | reg::kMcrFen});
  for (unsigned format = 0; format < 3; ++format) {
    need(rig.freeze(0), "no freeze mode");
    const std::uint32_t mcr = rig.read(0, reg::kMcr) & ~reg::mcr_idam(3);
    rig.write(0, reg::kMcr, mcr | reg::mcr_idam(format));
    rig.write(0, reg::kRxfgmask, 0);
    for (unsigned i = 0; i < 8; ++i) {
      rig.write(0, reg::filter(i), 0);
      rig.write(0, reg::rximr(i), 0);
    }
    rig.go(0);
    const unsigned count = format == 0 ? 8 : 2;
    for (unsigned i = 0; i < count; ++i) {
      rig.put_tx(1, kTxMb, {.id = 0x100 + i, .dlc = static_cast<std::uint8_t>(i), .data = {7, 6}});
      need(rig.wait_flag(1, kTxMb), "a frame for the FIFO is not sent");
      rig.clear_flag(1, kTxMb);
    }
    need((rig.read(0, reg::kIflag1) & reg::kIflagFifo) != 0, "the FIFO stays empty");
    while ((rig.read(0, reg::kIflag1) & reg::kIflagFifo) != 0) {
      (void)rig.get(0, 0);
      (void)rig.read(0, reg::kRxfir);
      rig.write(0, reg::kIflag1, reg::kIflagFifo);
    }
    rig.write(0, reg::kIflag1, 0xFFFFFFFF);
  }
}

// Both send at once: the recorded node loses, then wins.
void arbitration(MailboxRig &rig) {
  bring_up(rig);
  for (const std::uint32_t id : {0x2AAu, 0x0F0u}) {
    rig.put_tx(1, kTxMb, {.id = 0x155, .dlc = 2, .data = {0x55, 0xAA}});
    rig.put_tx(0, kTxMb, {.id = id, .dlc = 1, .data = {0xFF}});
    rig.put_tx(0, kTxMb + 1, {.id = 0x05555555, .extended = true, .dlc = 1});
    need(rig.wait_flag(0, kTxMb) && rig.wait_flag(1, kTxMb) && rig.wait_flag(0, kTxMb + 1),
         "a frame is not sent");
    for (unsigned n : {0u, 1u}) rig.write(n, reg::kIflag1, 0xFFFFFFFF);
  }
}

// A level of the bus forced for some clocks, from the next one on.
class Disturbance {
 public:
  Disturbance(MailboxRig &rig, NodeId victim, Effect effect, unsigned clocks)
      : fault_{victim, effect, {rig.bus().now() + kClock, rig.bus().now() + kClock * (clocks + 1)}},
        rig_{rig} {
    rig.bus().add(fault_);
    rig_.run(clocks + 2);
  }

 private:
  LevelFault fault_;
  MailboxRig &rig_;
};

// Every kind of error, as transmitter and as receiver, up to error passive; overload.
void errors(MailboxRig &rig, std::vector<std::unique_ptr<Disturbance>> &faults) {
  bring_up(rig, {.ctrl = kTiming8 | reg::kCtrlErrMsk});
  const auto disturb = [&](unsigned sender, Field field, NodeId victim, Effect effect) {
    rig.put_tx(sender, kTxMb, {.id = 0x2A5, .dlc = 4, .data = {0x0F, 0xF0, 0x33, 0xCC}});
    need(rig.run_until([&] { return rig.field(0) == field; }, 3000), "a field does not come");
    faults.push_back(std::make_unique<Disturbance>(rig, victim, effect, 2 * kBit));
    need(rig.wait_flag(sender, kTxMb, 8000), "a frame is not repeated");
    for (unsigned n : {0u, 1u}) rig.write(n, reg::kIflag1, 0xFFFFFFFF);
    (void)rig.read(0, reg::kEsr);
    rig.write(0, reg::kEsr, reg::kEsrInterrupts);
  };
  for (unsigned sender : {0u, 1u}) {
    disturb(sender, Field::kDlc, kAllNodes, Effect::kDominant);
    disturb(sender, Field::kData, kAllNodes, Effect::kRecessive);
    disturb(sender, Field::kData, 0, Effect::kFlip);
    disturb(sender, Field::kCrc, 0, Effect::kFlip);
    disturb(sender, Field::kAck, kAllNodes, Effect::kRecessive);
    disturb(sender, Field::kEof, kAllNodes, Effect::kDominant);
    disturb(sender, Field::kInt, kAllNodes, Effect::kDominant);
  }
}
void errors(MailboxRig &rig) {
  std::vector<std::unique_ptr<Disturbance>> faults;
  errors(rig, faults);
  need(rig.freeze(0), "no freeze mode");
  need(rig.read(0, reg::kEcr) != 0, "no error was counted");
}

// Error passive, bus-off and recovery. The counters are preset, as TH-02 allows.
void bus_off(MailboxRig &rig) {
  bring_up(rig, {.ctrl = kTiming8 | reg::kCtrlErrMsk | reg::kCtrlBoffMsk});
  need(rig.freeze(0), "no freeze mode");
  rig.write(0, reg::kEcr, 0x00F0);
  rig.go(0);
  std::vector<std::unique_ptr<Disturbance>> faults;
  rig.put_tx(0, kTxMb, {.id = 0x111, .dlc = 1});
  const auto off = [&] { return (rig.read(0, reg::kEsr) & 0x20) != 0; };
  for (int i = 0; i < 8 && !off(); ++i) {
    need(rig.run_until([&] { return rig.field(0) == Field::kDlc; }, 4000), "no new attempt");
    faults.push_back(std::make_unique<Disturbance>(rig, kAllNodes, Effect::kDominant, 3 * kBit));
    rig.run(30 * kBit);
  }
  need(off(), "no bus-off");
  need(rig.wait_flag(0, kTxMb, 13'000), "no recovery");
}

// Freeze, disable, soft reset and stop mode in the middle of frames; both ways to wake up; hard
// reset.
void modes(MailboxRig &rig) {
  bring_up(rig, {.mcr = reg::kMcrBcc | reg::kMcrSrxDis | (1u << 22) | (1u << 26)});
  const auto busy = [&](unsigned sender) {
    rig.put_tx(sender, kTxMb, {.id = 0x155, .dlc = 8, .data = {0xFF, 0, 0xFF, 0, 0xFF, 0, 1, 2}});
    need(rig.run_until([&] { return rig.field(0) == Field::kData; }, 3000), "no frame");
  };
  for (unsigned sender : {0u, 1u}) {
    busy(sender);
    need(rig.freeze(0), "no freeze mode");
    rig.go(0);
    busy(sender);
    rig.write(0, reg::kMcr, rig.read(0, reg::kMcr) | reg::kMcrMdis);
    need(rig.run_until([&] { return (rig.read(0, reg::kMcr) & reg::kMcrLpmAck) != 0; }, 2000),
         "no disable mode");
    rig.write(0, reg::kMcr, rig.read(0, reg::kMcr) & ~reg::kMcrMdis);
    rig.go(0);
  }
  for (const std::uint32_t source : {0u, 1u << 19}) {
    need(rig.freeze(0), "no freeze mode");
    rig.write(0, reg::kMcr, rig.read(0, reg::kMcr) | source);
    rig.go(0);
    rig.node(0).request_stop(true);
    need(rig.run_until([&] { return (rig.read(0, reg::kMcr) & reg::kMcrLpmAck) != 0; }, 2000),
         "no stop mode");
    rig.run(100);
    busy(1);
    need((rig.read(0, reg::kEsr) & 1) != 0, "no wake-up");
    rig.node(0).request_stop(false);
    rig.write(0, reg::kEsr, 1);
  }
  rig.run(100 * kBit);
  busy(0);
  rig.write(0, reg::kMcr, rig.read(0, reg::kMcr) | reg::kMcrSoftRst);
  rig.run(300 * kBit);
  rig.node(0).reset();
  rig.run(300);
  rig.configure(0);
  rig.go(0);
  busy(0);
}

}  // namespace

const std::vector<Recording> &recordings() {
  static const std::vector<Recording> kAll = {
      {"registers", registers}, {"frames", frames},
      {"fifo", fifo},           {"arbitration", arbitration},
      {"errors", errors},       {"bus_off", bus_off},
      {"modes", modes},
  };
  return kAll;
}

}  // namespace vericansim
