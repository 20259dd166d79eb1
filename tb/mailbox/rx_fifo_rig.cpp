// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RxFifoRig: see rx_fifo_rig.hpp.
#include "mailbox/rx_fifo_rig.hpp"

#include <algorithm>
#include <stdexcept>

namespace vericansim {
namespace {

constexpr unsigned kTxBuffer = 60;

/// One element: flag bits and identifier bits, the most significant bit first; where the first of
/// them lies in the word and in the mask.
struct Element {
  const FilterWord &filter;
  unsigned rem, ext, top;  ///< bits of REM, EXT and of the identifier's first bit

  [[nodiscard]] bool bit_fits(unsigned bit, bool value) const {
    return ((filter.mask >> bit) & 1) == 0 || (((filter.word >> bit) & 1) != 0) == value;
  }
  /// `count` identifier bits at most.
  [[nodiscard]] bool id_fits(const Frame &frame, unsigned count) const {
    const unsigned width = frame.extended ? 29 : 11;
    for (unsigned i = 0; i < std::min(count, width); ++i)
      if (!bit_fits(top - i, ((frame.id >> (width - 1 - i)) & 1) != 0)) return false;
    return true;
  }
  [[nodiscard]] bool flags_fit(const Frame &frame) const {
    return bit_fits(rem, frame.remote) && bit_fits(ext, frame.extended);
  }
};

}  // namespace

std::optional<unsigned> filter_element(unsigned format, const FilterWord &filter,
                                       const Frame &frame) {
  if (format == 0) {
    const Element whole{filter, 31, 30, 29};
    if (whole.flags_fit(frame) && whole.id_fits(frame, 29)) return 0;
  } else if (format == 1) {
    for (unsigned half = 0; half < 2; ++half) {
      const Element element{filter, 31 - 16 * half, 30 - 16 * half, 29 - 16 * half};
      if (element.flags_fit(frame) && element.id_fits(frame, 14)) return half;
    }
  } else if (format == 2) {
    for (unsigned byte = 0; byte < 4; ++byte) {
      const Element element{filter, 0, 0, 31 - 8 * byte};
      if (element.id_fits(frame, 8)) return byte;
    }
  }
  return std::nullopt;
}

RxFifoRig::RxFifoRig(const FifoConfig &config) : MailboxRig{2, config.num_mb} {
  configure(kSender, {.ctrl = config.ctrl});
  configure(kReceiver, {.ctrl = config.ctrl});
  set(config);
}

void RxFifoRig::set(const FifoConfig &config) {
  config_ = config;
  write(kReceiver, reg::kMcr,
        reg::kMcrFrz | reg::kMcrHalt | reg::kMcrFen | reg::kMcrWrnEn | config.mcr |
            (config.bcc ? reg::kMcrBcc : 0) | reg::mcr_idam(config.format) | (num_mb() - 1));
  write(kReceiver, reg::kCtrl2, config.ctrl2 | reg::ctrl2_rffn(config.rffn));
  for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask, reg::kRxfgmask})
    write(kReceiver, mask, 0);
  for (unsigned mb = 0; mb < num_mb(); ++mb) write(kReceiver, reg::rximr(mb), 0);
  for (unsigned k = 0; k < 8 * (config.rffn + 1) && k < 4 * (num_mb() - 6); ++k)
    write(kReceiver, reg::filter(k), 0);
}

void RxFifoRig::set_filter(unsigned k, const FilterWord &filter) {
  write(kReceiver, reg::filter(k), filter.word);
  if (config_.bcc && k < std::min(first_mailbox(), 32u))
    write(kReceiver, reg::rximr(k), filter.mask);
}

void RxFifoRig::join() {
  go(kSender);
  go(kReceiver);
}

void RxFifoRig::send(const Frame &frame) {
  const unsigned mb = std::min(kTxBuffer, num_mb() - 1);
  put_tx(kSender, mb, frame);
  if (!wait_flag(kSender, mb)) throw std::runtime_error("the frame is not sent");
  clear_flag(kSender, mb);
  write(kSender, reg::mb(mb), reg::kCodeTxInactive);
  run(24);  // the receiver sees it one bit earlier; this is for its move
}

FifoOutput RxFifoRig::output() {
  FifoOutput entry;
  entry.words = {.cs = read(kReceiver, reg::mb(0, 0)),
                 .id = read(kReceiver, reg::mb(0, 1)),
                 .low = read(kReceiver, reg::mb(0, 2)),
                 .high = read(kReceiver, reg::mb(0, 3))};
  entry.idhit = read(kReceiver, reg::kRxfir);
  return entry;
}

std::vector<Frame> RxFifoRig::drain() {
  std::vector<Frame> frames;
  while (available()) {
    frames.push_back(mb_frame(output().words));
    pop();
  }
  return frames;
}

}  // namespace vericansim
