// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A generic payload as transfers on AHB-Lite: what can be done is planned, what cannot is named.
#pragma once

#include <cstdint>
#include <tlm>
#include <vector>

#include "node/ahb_master.hpp"

namespace vericansim {

/// The socket's addresses: the region that the core's hsel stands for. The core answers accesses
/// above its window of 8 KiB with ERROR.
inline constexpr std::uint64_t kSocketRegion = 0x10000;
inline constexpr std::uint64_t kSocketWindow = 0x2000;

/// Extension of a payload that sets HPROT of its transfers, which is otherwise 0b0011 (privileged
/// data). Ignorable: a payload may be without it.
class AhbProtection : public tlm::tlm_extension<AhbProtection> {
 public:
  explicit AhbProtection(std::uint8_t value = 0b0011) : hprot{value} {}
  [[nodiscard]] tlm::tlm_extension_base *clone() const override { return new AhbProtection(hprot); }
  void copy_from(const tlm::tlm_extension_base &other) override {
    hprot = static_cast<const AhbProtection &>(other).hprot;
  }

  std::uint8_t hprot;
};

/// One transfer, and where its data lies in the payload's.
struct Beat {
  AhbTransfer transfer;
  unsigned offset = 0;
};

/// Plans the transfers of a payload, in order; words that follow each other become bursts of up to
/// 16 that do not cross 1 KiB.
///
/// TLM_OK_RESPONSE, or, and then nothing may be done: TLM_COMMAND_ERROR_RESPONSE neither read nor
/// write; TLM_GENERIC_ERROR_RESPONSE no data pointer; TLM_BURST_ERROR_RESPONSE data length or
/// streaming width is not 1, 2 or a multiple of 4, or the length none of the width;
/// TLM_ADDRESS_ERROR_RESPONSE not aligned or beyond the region; TLM_BYTE_ENABLE_ERROR_RESPONSE
/// lanes of a word that are no aligned byte, half word or word.
tlm::tlm_response_status plan_beats(const tlm::tlm_generic_payload &payload,
                                    std::vector<Beat> &beats);

/// Puts the data that a beat has read into the payload.
void store_read(tlm::tlm_generic_payload &payload, const Beat &beat, std::uint32_t data);

/// End of the run of beats from `first` on that are handed to the bus at once: at most 16 and the
/// rest of a burst.
std::size_t chunk_end(const std::vector<Beat> &beats, std::size_t first);

}  // namespace vericansim
