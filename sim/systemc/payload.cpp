// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Payload: see payload.hpp.
#include "systemc/payload.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace vericansim {
namespace {

static_assert(std::endian::native == std::endian::little,
              "data of a payload has the host's byte order, the bus is little-endian");

constexpr std::size_t kBurst = 16;
constexpr std::uint32_t kBurstBoundary = 0x400;
constexpr unsigned kNoLanes = 4;  // stands in for a size where no byte is enabled

bool has_unit(unsigned length) { return length == 1 || length == 2 || length % 4 == 0; }

tlm::tlm_response_status check(const tlm::tlm_generic_payload &payload, unsigned width) {
  if (!payload.is_read() && !payload.is_write()) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (payload.get_data_ptr() == nullptr) return tlm::TLM_GENERIC_ERROR_RESPONSE;
  const unsigned length = payload.get_data_length();
  if (length == 0 || width == 0 || !has_unit(width) || length % width != 0)
    return tlm::TLM_BURST_ERROR_RESPONSE;
  const std::uint64_t address = payload.get_address();
  if (address >= kSocketRegion || width > kSocketRegion - address ||
      address % std::min(width, 4u) != 0)
    return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (payload.get_byte_enable_ptr() != nullptr && payload.get_byte_enable_length() == 0)
    return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  return tlm::TLM_OK_RESPONSE;
}

// Which of the `count` bytes at `offset` are enabled, as bits; false if a byte is neither.
bool lanes(const tlm::tlm_generic_payload &payload, unsigned offset, unsigned count,
           unsigned &mask) {
  const unsigned char *enable = payload.get_byte_enable_ptr();
  mask = (1u << count) - 1;
  if (enable == nullptr) return true;
  mask = 0;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned char byte = enable[(offset + i) % payload.get_byte_enable_length()];
    if (byte == TLM_BYTE_ENABLED) {
      mask |= 1u << i;
    } else if (byte != TLM_BYTE_DISABLED) {
      return false;
    }
  }
  return true;
}

// The aligned piece that the lanes make: its size in bytes (kNoLanes + 1 if they make none).
unsigned piece(unsigned mask, unsigned &first) {
  first = mask == 0 ? 0 : static_cast<unsigned>(std::countr_zero(mask));
  switch (mask >> first) {
    case 0: return 0;
    case 0b1: return 1;
    case 0b11: return first % 2 == 0 ? 2 : kNoLanes + 1;
    case 0b1111: return 4;
    default: return kNoLanes + 1;
  }
}

AhbSize size_of(unsigned bytes) {
  if (bytes == 1) return AhbSize::kByte;
  return bytes == 2 ? AhbSize::kHalf : AhbSize::kWord;
}

// Words in a row become bursts of undefined length.
void mark_bursts(std::vector<Beat> &beats) {
  std::size_t run = 1;
  for (std::size_t i = 1; i < beats.size(); ++i) {
    AhbTransfer &before = beats[i - 1].transfer;
    AhbTransfer &next = beats[i].transfer;
    const bool follows = before.size == AhbSize::kWord && next.size == AhbSize::kWord &&
                         next.address == before.address + 4 && next.address % kBurstBoundary != 0 &&
                         run < kBurst;
    run = follows ? run + 1 : 1;
    if (!follows) continue;
    before.burst = next.burst = AhbBurst::kIncr;
    next.trans = AhbTrans::kSeq;
  }
}

}  // namespace

tlm::tlm_response_status plan_beats(const tlm::tlm_generic_payload &payload,
                                    std::vector<Beat> &beats) {
  beats.clear();
  const unsigned length = payload.get_data_length();
  const unsigned width = std::min(payload.get_streaming_width(), length);
  if (const auto status = check(payload, width); status != tlm::TLM_OK_RESPONSE) return status;
  const AhbProtection *protection = payload.get_extension<AhbProtection>();
  const unsigned step = std::min(width, 4u);
  for (unsigned offset = 0; offset < length; offset += step) {
    unsigned mask = 0, first = 0;
    if (!lanes(payload, offset, step, mask)) return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
    const unsigned bytes = piece(mask, first);
    if (bytes > kNoLanes) return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
    if (bytes == 0) continue;
    Beat beat;
    beat.offset = offset + first;
    beat.transfer.address =
        static_cast<std::uint32_t>(payload.get_address()) + offset % width + first;
    beat.transfer.size = size_of(bytes);
    beat.transfer.write = payload.is_write();
    if (protection != nullptr) beat.transfer.hprot = protection->hprot & 0xF;
    if (payload.is_write())
      std::memcpy(&beat.transfer.data, payload.get_data_ptr() + beat.offset, bytes);
    beats.push_back(beat);
  }
  mark_bursts(beats);
  return tlm::TLM_OK_RESPONSE;
}

void store_read(tlm::tlm_generic_payload &payload, const Beat &beat, std::uint32_t data) {
  std::memcpy(payload.get_data_ptr() + beat.offset, &data,
              1u << static_cast<unsigned>(beat.transfer.size));
}

std::size_t chunk_end(const std::vector<Beat> &beats, std::size_t first) {
  std::size_t end = first + 1;
  while (end < beats.size() &&
         (end - first < kBurst || beats[end].transfer.trans == AhbTrans::kSeq))
    ++end;
  return end;
}

}  // namespace vericansim
