// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See buffer_match.hpp.
#include "model/buffer_match.hpp"

#include <algorithm>

#include "bus/range.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kMaskRtr = 1u << 31;
constexpr std::uint32_t kMaskIde = 1u << 30;

/// The identifier as the ID word of a buffer has it.
std::uint32_t id_word(const Frame &frame) { return frame.extended ? frame.id : frame.id << 18; }

/// Bits of the ID word that a frame of this format compares.
std::uint32_t id_bits(const Frame &frame) { return frame.extended ? 0x1FFFFFFF : 0x1FFC0000; }

/// Filter and frame differ in no bit of `compared`.
bool same(std::uint32_t a, std::uint32_t b, std::uint32_t compared) {
  return ((a ^ b) & compared) == 0;
}

/// Number of filters in one element, and whether filter `part` of it (0: uppermost) accepts.
struct Format {
  unsigned parts;
  bool (*accepts)(const Frame &, std::uint32_t filter, std::uint32_t mask);
};

bool accepts_a(const Frame &frame, std::uint32_t filter, std::uint32_t mask) {
  const std::uint32_t word = (std::uint32_t{frame.remote} << 31) |
                             (std::uint32_t{frame.extended} << 30) |
                             (frame.extended ? frame.id << 1 : frame.id << 19);
  const std::uint32_t compared = 0xC0000000 | (frame.extended ? 0x3FFFFFFE : 0x3FF80000);
  return same(filter, word, mask & compared);
}

bool accepts_b(const Frame &frame, std::uint32_t filter, std::uint32_t mask) {
  const std::uint32_t half = (std::uint32_t{frame.remote} << 15) |
                             (std::uint32_t{frame.extended} << 14) |
                             (frame.extended ? frame.id >> 15 : frame.id << 3);
  const std::uint32_t compared = 0xC000 | (frame.extended ? 0x3FFF : 0x3FF8);
  return same(filter, half, mask & compared);
}

bool accepts_c(const Frame &frame, std::uint32_t filter, std::uint32_t mask) {
  return same(filter, frame.extended ? frame.id >> 21 : frame.id >> 3, mask & 0xFF);
}

bool accepts_d(const Frame &, std::uint32_t, std::uint32_t) { return false; }

constexpr Format kFormats[4] = {{1, accepts_a}, {2, accepts_b}, {4, accepts_c}, {1, accepts_d}};

}  // namespace

void BufferConfig::validate() const {
  require_range("message buffers", num_mb, 16, 64);
  require_range("MCR.MAXMB", maxmb, 0, 127);
  require_range("MCR.IDAM", idam, 0, 3);
  require_range("CTRL2.RFFN", rffn, 0, 15);
}

std::uint32_t BufferMasks::of_mailbox(unsigned mb, bool bcc) const {
  if (bcc) return individual[mb];
  if (mb == 14) return mb14;
  return mb == 15 ? mb15 : global;
}

std::uint32_t BufferMasks::of_element(unsigned element, const BufferConfig &config) const {
  const unsigned own_masks = std::min(32u, 8 + 2 * config.rffn);
  return config.bcc && element < own_masks ? individual[element] : fifo;
}

bool mailbox_accepts(const Frame &frame, std::uint32_t cs, std::uint32_t id, std::uint32_t mask,
                     const BufferConfig &config) {
  frame.validate();
  if (frame.remote && !config.rrs) return false;
  const bool compare_ide = !config.eacen || (mask & kMaskIde) != 0;
  const bool compare_rtr = config.eacen && (mask & kMaskRtr) != 0;
  if (compare_ide && cs_ide(cs) != frame.extended) return false;
  if (compare_rtr && cs_rtr(cs) != frame.remote) return false;
  return same(id, id_word(frame), mask & id_bits(frame));
}

bool answer_fits(const Frame &frame, std::uint32_t cs, std::uint32_t id,
                 const BufferConfig &config) {
  frame.validate();
  return frame.remote && !config.rrs && cs_ide(cs) == frame.extended &&
         same(id, id_word(frame), id_bits(frame));
}

std::optional<unsigned> fifo_accepts(const Frame &frame, std::span<const std::uint32_t> table,
                                     const BufferMasks &masks, const BufferConfig &config) {
  frame.validate();
  config.validate();
  require_range("words of the filter table", table.size(), config.filter_elements(), 128);
  const Format &format = kFormats[config.idam];
  const unsigned width = 32 / format.parts;
  for (unsigned element = 0; element < config.filter_elements(); ++element) {
    const std::uint32_t mask = masks.of_element(element, config);
    for (unsigned part = 0; part < format.parts; ++part) {
      const unsigned shift = 32 - width * (part + 1);
      if (format.accepts(frame, table[element] >> shift, mask >> shift))
        return element * format.parts + part;
    }
  }
  return std::nullopt;
}

Frame buffer_frame(std::span<const std::uint32_t, 4> words) {
  Frame frame;
  frame.extended = cs_ide(words[0]);
  frame.remote = cs_rtr(words[0]);
  frame.dlc = (words[0] >> 16) & 0xF;
  frame.id = frame.extended ? words[1] & 0x1FFFFFFF : (words[1] >> 18) & 0x7FF;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(words[2 + i / 4] >> (24 - 8 * (i % 4)));
  return frame;
}

std::uint64_t arbitration_value(unsigned mb, std::uint32_t cs, std::uint32_t id,
                                const BufferConfig &config) {
  if (config.lbuf) return mb;
  const std::uint64_t base = (id >> 18) & 0x7FF;
  const std::uint64_t low = id & 0x3FFFF;
  const std::uint64_t rtr = cs_rtr(cs) ? 1 : 0;
  // 11 identifier bits, RTR or SRR, IDE, 18 identifier bits, RTR: as on the wire.
  std::uint64_t value = 0;
  if (cs_ide(cs)) {
    value = (base << 21) | (1u << 20) | (1u << 19) | (low << 1) | rtr;
  } else {
    value = (base << 21) | (rtr << 20);
  }
  if (config.lprio_en) value |= std::uint64_t{id >> 29} << 32;
  return (value << 6) | mb;  // ties: the lowest buffer
}

}  // namespace vericansim
