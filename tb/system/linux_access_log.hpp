// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Replays a log of the register accesses of Linux' flexcan driver on a core: writes are stimuli,
// reads are expectations. A second core is the rest of the bus: it sends what the driver received
// and checks what it sent.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {

/// One line of a log.
struct LoggedAccess {
  bool write = false;
  std::uint32_t offset = 0;
  std::uint32_t value = 0;
  bool irq = false;  ///< level of the interrupt line after the access
  unsigned line = 0;
};

/// The accesses in `path`; lines of other forms are left out.
std::vector<LoggedAccess> read_access_log(const std::string &path);

/// Makes the node that it belongs to see and so send nothing dominant while it is on.
class DeafFault : public Fault {
 public:
  bool on = false;
  [[nodiscard]] Level level(NodeId receiver, Time, Level level) override {
    return on && receiver == 0 ? Level::kRecessive : level;
  }
};

/// The replay. Not compared, because it is a matter of time or of the model that the log was made
/// with:
/// - TIMER and stamps; IDLE, SYNCH, TX and RX of ESR1, and error bits besides those expected; ECR
/// in
///   bus-off; SRR of standard frames; bytes beyond the DLC;
/// - the warning masks of CTRL1 while MCR.WRN_EN = 0: the model shows them, here they read 0
///   (flexcan.md 1.1);
/// - frames that the model put into mailboxes in spite of CTRL2: remote ones with RRS = 0, extended
///   ones with EACEN = 0 and IDE = 0 in the buffers (flexcan.md 3.5).
class AccessLogReplay {
 public:
  AccessLogReplay(std::vector<LoggedAccess> log, unsigned num_mb);

  /// Replays all of it; what differs is reported as failures of the running test.
  void run();

  unsigned sent = 0;      ///< frames that the driver sent and the other node has
  unsigned received = 0;  ///< frames that the driver has read
  unsigned polls = 0;     ///< reads repeated while an acknowledge was awaited

 private:
  struct Burst;

  void write(const LoggedAccess &access);
  void read(const LoggedAccess &access);
  /// Before the first access with the line high: what the bus does until then.
  void prepare_burst(std::size_t first);
  /// Before a C/S word is written that starts a transmission.
  void prepare_transmission(std::size_t index, std::uint32_t cs);
  void check_transmission();
  void compare(const LoggedAccess &access, std::uint32_t value, std::uint32_t mask);
  [[nodiscard]] std::uint32_t read_mask(const LoggedAccess &access, std::uint32_t value);
  [[nodiscard]] Burst look_ahead(std::size_t first) const;
  [[nodiscard]] bool fifo() const { return (mcr_ & (1u << 29)) != 0; }
  [[nodiscard]] bool loop_back() const { return (ctrl_ & reg::kCtrlLpb) != 0; }
  /// Whether mailboxes as the driver writes them do not take the frame.
  [[nodiscard]] bool refuses(const Frame &frame) const;
  void tune_other_node();

  std::vector<LoggedAccess> log_;
  MailboxRig rig_;
  DeafFault deaf_;
  std::size_t at_ = 0;
  std::uint32_t mcr_ = 0, ctrl_ = 0, ctrl2_ = 0;  // as written last
  std::uint32_t other_ctrl_ = 0;                  // bit timing of the other node
  std::uint32_t ignored_flags_ = 0;               // IFLAG1 bits of frames that are not to be stored
  std::uint32_t buffer_ = 0, dlc_ = 0;            // of the C/S word read last
  std::vector<Frame> on_bus_;                     // sent, not yet seen at the other node
};

}  // namespace vericansim
