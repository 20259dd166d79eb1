// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Cases of register fuzzing: see register_case.hpp.
#include "fuzz/register_case.hpp"

#include <fmt/format.h>

#include <array>

#include "model/registers.hpp"
#include "trace/input_error.hpp"
#include "trace/text.hpp"

namespace vericansim::fuzz {
namespace {

constexpr std::uint32_t kWindow = 0x2000;
constexpr std::uint8_t kUser = 0b0001;

std::uint32_t draw_address(Random &random) {
  const auto word = [&](std::uint32_t base, std::uint32_t words) {
    return base + 4 * static_cast<std::uint32_t>(draw(random, words));
  };
  const std::uint64_t kind = draw(random, 100);
  if (kind < 38) return word(reg::mb(0), 256);
  if (kind < 42) return reg::kMcr;
  if (kind < 45) return reg::kCtrl;
  if (kind < 65) return word(0, 32);  // the other registers of the first block
  if (kind < 72) return word(reg::rximr(0), 64);
  if (kind < 80) return word(0x1000, 8);  // extension page
  if (kind < 92) return word(0, kWindow / 4);
  const auto any = static_cast<std::uint32_t>(random());
  return kind < 96 ? any : (any & 0xFFFF0000U) | word(0, kWindow / 4);  // other bits of the region
}

std::uint32_t draw_cs(Random &random) {
  // Codes of FlexCAN: inactive, empty, transmit, abort, answer to remote frames...
  constexpr std::array<std::uint32_t, 8> kCodes = {0x0, 0x4, 0x8, 0x9, 0xA, 0xC, 0xC, 0xE};
  const auto any = static_cast<std::uint32_t>(random());
  return kCodes[draw(random, kCodes.size())] << 24U | (any & 0x007FFFFFU);
}

std::uint32_t draw_mcr(Random &random) {
  constexpr std::array<std::uint32_t, 8> kModes = {0,
                                                   reg::kMcrFrz | reg::kMcrHalt,
                                                   reg::kMcrMdis,
                                                   reg::kMcrSoftRst,
                                                   0,
                                                   reg::kMcrFrz,
                                                   reg::kMcrHalt,
                                                   reg::kMcrFrz | reg::kMcrHalt | reg::kMcrFen};
  const auto any = static_cast<std::uint32_t>(random());
  return kModes[draw(random, kModes.size())] | (any & 0x00FFFFFFU);
}

std::uint32_t draw_data(Random &random, std::uint32_t address) {
  if (address == reg::kMcr && chance(random, 80)) return draw_mcr(random);
  const bool cs = address >= reg::mb(0) && address < reg::mb(64) && address % 16 == 0;
  if (cs && chance(random, 80)) return draw_cs(random);
  const auto any = static_cast<std::uint32_t>(random());
  switch (draw(random, 8)) {
    case 0: return 0;
    case 1: return 0xFFFFFFFF;
    case 2: return 1U << (any % 32);
    case 3: return ~(1U << (any % 32));
    case 4: return any & 0xFF;
    default: return any;
  }
}

unsigned draw_pause(Random &random) {
  const std::uint64_t kind = draw(random, 100);
  if (kind < 70) return 0;
  if (kind < 95) return 1 + static_cast<unsigned>(draw(random, 8));
  return static_cast<unsigned>(draw(random, 150));
}

AhbTransfer draw_transfer(Random &random, bool users) {
  AhbTransfer transfer;
  transfer.address = draw_address(random);
  transfer.write = chance(random, 55);
  if (chance(random, 30)) transfer.size = static_cast<AhbSize>(draw(random, 3));
  if (transfer.size != AhbSize::kWord)
    transfer.address += static_cast<std::uint32_t>(draw(random, 4));
  if (chance(random, 3)) transfer.size = AhbSize::kDouble;
  if (chance(random, 4)) transfer.address += static_cast<std::uint32_t>(draw(random, 4));
  transfer.data = draw_data(random, transfer.address);
  if (chance(random, 10)) transfer.hprot = static_cast<std::uint8_t>(draw(random, 16)) | 2U;
  if (users && chance(random, 30)) transfer.hprot = kUser;
  transfer.pause = draw_pause(random);
  return transfer;
}

/// The beats of a burst, BUSY before some of them.
void add_burst(Random &random, AhbTransfer beat, RegisterCase &sequence) {
  beat.burst = static_cast<AhbBurst>(draw(random, 8));
  const unsigned fixed = ahb_beats(beat.burst);
  const unsigned beats = fixed != 0 ? fixed : 1 + static_cast<unsigned>(draw(random, 8));
  for (unsigned i = 0; i < beats && sequence.size() < 64; ++i) {
    sequence.push_back(beat);
    beat.address = ahb_next_address(beat.address, beat.size, beat.burst);
    beat.data = static_cast<std::uint32_t>(random());
    beat.trans = AhbTrans::kSeq;
    beat.pause = chance(random, 20) ? 1 + static_cast<unsigned>(draw(random, 3)) : 0;
  }
}

}  // namespace

RegisterCase draw_case(Random &random, bool users) {
  RegisterCase sequence;
  const std::size_t size = 8 + draw(random, 57);
  while (sequence.size() < size) {
    const AhbTransfer transfer = draw_transfer(random, users);
    if (chance(random, 6))
      add_burst(random, transfer, sequence);
    else
      sequence.push_back(transfer);
  }
  return sequence;
}

bool expects_error(const AhbTransfer &transfer) {
  const std::uint32_t offset = transfer.address & 0xFFFF;  // RegionBits = 16
  const std::uint32_t size = 1U << static_cast<unsigned>(transfer.size);
  return size > 4 || offset % size != 0 || offset >= kWindow;
}

std::string to_text(const AhbTransfer &t) {
  return fmt::format("{} {:08X} {} {:08X} hprot {} burst {} trans {} pause {}", t.write ? 'W' : 'R',
                     t.address, static_cast<unsigned>(t.size), t.data, t.hprot,
                     static_cast<unsigned>(t.burst), static_cast<unsigned>(t.trans), t.pause);
}

std::string to_text(const Episode &episode) {
  std::string text = fmt::format("episode {}\n", episode.seed);
  for (const RegisterCase &sequence : episode.cases) {
    text += "case\n";
    for (const AhbTransfer &transfer : sequence) text += to_text(transfer) + "\n";
  }
  return text;
}

Episode parse_episode(const std::string &text, const std::string &file) {
  Episode episode;
  text::for_each_line(text, file, [&](std::string_view line, const text::Place &place) {
    const auto words = text::split_blanks(line);
    if (words.empty() || words[0].front() == '#') return;
    const auto number = [&](std::size_t at, int base, std::uint64_t most) {
      const auto value = at < words.size() ? text::parse_unsigned(words[at], base) : std::nullopt;
      if (!value || *value > most)
        text::fail(place, "word " + std::to_string(at + 1) + " is no number up to " +
                              std::to_string(most));
      return *value;
    };
    if (words[0] == "episode") {
      episode.seed = number(1, 10, ~0ULL);
    } else if (words[0] == "case") {
      episode.cases.emplace_back();
    } else if ((words[0] == "R" || words[0] == "W") && !episode.cases.empty()) {
      episode.cases.back().push_back({.address = static_cast<std::uint32_t>(number(1, 16, ~0U)),
                                      .write = words[0] == "W",
                                      .size = static_cast<AhbSize>(number(2, 10, 3)),
                                      .data = static_cast<std::uint32_t>(number(3, 16, ~0U)),
                                      .hprot = static_cast<std::uint8_t>(number(5, 10, 15)),
                                      .burst = static_cast<AhbBurst>(number(7, 10, 7)),
                                      .trans = static_cast<AhbTrans>(number(9, 10, 3)),
                                      .pause = static_cast<unsigned>(number(11, 10, 100'000))});
    } else {
      text::fail(place, "expected 'episode SEED', 'case', or a transfer within a case");
    }
  });
  return episode;
}

}  // namespace vericansim::fuzz
