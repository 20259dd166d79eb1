// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EngineFrame, ByteWiseFrame: the frame on the bus as an engine hands it out, header and byte by
// byte.
#pragma once

#include <cstdint>

#include "model/frame.hpp"

namespace vericansim {

/// Puts a frame together from the ports of a Verilated can_core.
class EngineFrame {
 public:
  /// True if the ports of this clock have anything for clocked().
  template <typename Core>
  [[nodiscard]] static bool concerns(const Core &core) {
    return (core.start_o | core.rx_hdr_o | core.rx_byte_we_o | core.rx_valid_o) != 0;
  }
  /// To be called after each clock edge that concerns it.
  template <typename Core>
  void clocked(const Core &core) {
    clocked(core, core.rx_byte_o);
  }
  /// What has passed of it; whole from rx_valid_o on, for senders from tx_ok_o on.
  [[nodiscard]] const Frame &frame() const { return frame_; }

 protected:
  /// As above, with the byte that rx_byte_we_o tells of.
  template <typename Core>
  void clocked(const Core &core, std::uint8_t byte) {
    if (core.start_o) {
      bytes_ = 0;
      frame_ = {};
    }
    if (core.rx_byte_we_o && bytes_ < 8) frame_.data[bytes_++] = byte;
    if (core.rx_hdr_o) {
      frame_.extended = core.rx_ide_o;
      frame_.remote = core.rx_rtr_o;
      frame_.id = core.rx_ide_o ? core.rx_id_o : core.rx_id_o >> 18;
    }
    if (core.rx_valid_o || core.rx_byte_we_o) frame_.dlc = core.rx_dlc_o;
  }

 private:
  Frame frame_;
  unsigned bytes_ = 0;
};

/// The same of an engine with ByteWise = 1, which hands out received bytes alone; those of an own
/// frame are what it takes.
class ByteWiseFrame : public EngineFrame {
 public:
  template <typename Core>
  [[nodiscard]] static bool concerns(const Core &core) {
    return EngineFrame::concerns(core) || core.tx_next_o != 0;
  }
  template <typename Core>
  void clocked(const Core &core) {
    EngineFrame::clocked(core, core.transmitter_o ? sent_ : core.rx_byte_o);
    if (core.tx_next_o) sent_ = static_cast<std::uint8_t>(core.tx_word_i >> 18);
  }

 private:
  std::uint8_t sent_ = 0;  // byte that is being sent
};

}  // namespace vericansim
