// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The paper's experiments with errors: missing ACK, error passive, bus-off, recovery (figures 14 to
// 18).
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "paper/paper_bench.hpp"
#include "simulation/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// One error frame of the IP.
struct ErrorFrame {
  Time time = 0;            ///< sample point of the bit that showed the error
  unsigned tec_before = 0;  ///< when the error was seen
  unsigned tec_after = 0;
  unsigned dominant = 0;     ///< dominant bits that the IP sends as its flag
  std::size_t next_sof = 0;  ///< bits from the error to the next own SOF, 0 if there is none
};

std::vector<ErrorFrame> error_frames(const std::vector<BitRecord> &bits) {
  std::vector<ErrorFrame> frames;
  for (std::size_t i = 1; i < bits.size(); ++i) {
    if (bits[i].after.errors == 0) continue;
    ErrorFrame frame;
    frame.time = bits[i].time;
    frame.tec_before = bits[i - 1].after.tec;
    frame.tec_after = bits[i].after.bus_off ? 256U : bits[i].after.tec;
    for (std::size_t k = i + 1; k < bits.size() && bits[k].at.field == Field::kErrFlag; ++k)
      frame.dominant += bits[k].at.tx == Level::kDominant ? 1 : 0;
    const auto sof = std::find_if(bits.begin() + static_cast<std::ptrdiff_t>(i) + 1, bits.end(),
                                  [](const BitRecord &b) { return b.at.field == Field::kSof; });
    frame.next_sof = sof == bits.end() ? 0 : static_cast<std::size_t>(sof - bits.begin()) - i;
    frames.push_back(frame);
  }
  return frames;
}

PaperCheck check_flags(const std::vector<ErrorFrame> &frames) {
  unsigned active = 0, passive = 0;
  bool ok = frames.size() > 20;
  std::optional<Time> first_passive;
  for (const ErrorFrame &f : frames) {
    if (f.dominant != 6 && !first_passive) first_passive = f.time;
    (f.dominant == 6 ? active : passive) += 1;
    ok = ok && f.dominant == (f.tec_before < 0x80 ? 6U : 0U);
  }
  return {"14", "active error flags while the TEC is below 0x80, passive ones from 0x80 on",
          fmt::format("{} active flags below, {} passive ones from 0x80 on", active, passive), ok,
          first_passive};
}

PaperCheck check_counter(const std::vector<ErrorFrame> &frames) {
  std::string seen;
  bool ok = true;
  std::optional<Time> full;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const unsigned wanted = std::min<unsigned>(8 * (static_cast<unsigned>(i) + 1), 128);  // FC-18
    ok = ok && frames[i].tec_after == wanted;
    if (frames[i].tec_after == 128 && !full) full = frames[i].time;
    if (i < 2 || i == 15 || i == 16)
      seen += fmt::format("{}{}: 0x{:02X}", seen.empty() ? "after attempt " : ", ", i + 1,
                          frames[i].tec_after);
  }
  return {"14", "each missing ACK adds 8 up to 0x80, where it stays", seen, ok, full};
}

/// Figure 15 / 16: the error frame and the retransmission after it (RO-04).
PaperCheck check_frame(const std::vector<ErrorFrame> &frames, bool passive) {
  const auto frame = std::find_if(frames.begin(), frames.end(), [&](const ErrorFrame &f) {
    return (f.tec_before >= 0x80) == passive && f.next_sof != 0;
  });
  const std::size_t wanted = passive ? 26 : 18;
  const bool ok =
      frame != frames.end() && frame->dominant == (passive ? 0U : 6U) && frame->next_sof == wanted;
  return {passive ? "16" : "15",
          passive ? "a passive error frame, then retransmission"
                  : "an active error frame, then retransmission",
          frame == frames.end()
              ? "none"
              : fmt::format("{} dominant flag bits, next SOF {} bits after the ACK slot",
                            frame->dominant, frame->next_sof),
          ok, frame == frames.end() ? std::nullopt : std::optional{frame->time}};
}

PaperCheck check_bus_off(const std::vector<BitRecord> &bits,
                         const std::vector<ErrorFrame> &frames) {
  const auto off =
      std::find_if(bits.begin(), bits.end(), [](const BitRecord &b) { return b.after.bus_off; });
  if (off == bits.end() || frames.empty()) return {"17", "bus-off at 0x100", "no bus-off", false};
  const bool was_passive = (off - 1)->after.passive && frames.back().tec_before == 0xF8;
  const bool silent = std::all_of(off + 1, bits.end(), [](const BitRecord &b) {
    return b.at.tx == Level::kRecessive || !b.after.bus_off;
  });
  return {"17", "at 0x100 the node goes from error passive to BUS_OFF_RECOVERY and sends no more",
          fmt::format("TEC 0x{:02X} to 0x{:X} after {} errors, then {}", frames.back().tec_before,
                      frames.back().tec_after, frames.size(),
                      silent ? "nothing sent" : "dominant bits sent"),
          was_passive && silent && frames.back().tec_after == 0x100, off->time};
}

PaperCheck check_recovery(const std::vector<BitRecord> &bits) {
  const auto off =
      std::find_if(bits.begin(), bits.end(), [](const BitRecord &b) { return b.after.bus_off; });
  const auto back =
      std::find_if(off, bits.end(), [](const BitRecord &b) { return !b.after.bus_off; });
  if (off == bits.end() || back == bits.end()) return {"18", "recovery", "none", false};
  const auto count = back - off;  // sampled bits while off
  const auto &next = back + 1 < bits.end() ? *(back + 1) : *back;
  // 128 or 129 times 11 (BO-02, BO-04).
  const bool ok =
      count >= 128L * 11 && count <= 129L * 11 + 2 && back->after.tec == 0 && back->after.rec == 0;
  return {"18", "after 0x80 times 11 recessive bits the node is in IDLE with both counters 0",
          fmt::format("{} recessive bits = {:.2f} x 11, then {} with TEC {} and REC {}", count,
                      static_cast<double>(count) / 11.0, field_name(next.at.field), back->after.tec,
                      back->after.rec),
          ok && (next.at.field == Field::kIdle || next.at.field == Field::kSof), back->time};
}

}  // namespace

PaperExperiment paper_missing_ack(const PaperFiles &files) {
  constexpr Time kAttempts = 24;
  constexpr Time kLongestAttempt = 90;  // bits
  PaperBench bench{files, "Figures 14 to 16: missing acknowledge", true};
  bench.send(PaperBench::kIp, kPaperFrame);
  bench.run_bits(kAttempts * kLongestAttempt);
  const auto &bits = bench.bits(PaperBench::kIp);
  const auto frames = error_frames(bits);
  PaperExperiment result{"missing-ack", files};
  result.checks = {check_flags(frames), check_counter(frames), check_frame(frames, false),
                   check_frame(frames, true)};
  bench.finish(result, first_sof(bits) - 20 * PaperBench::kBit, bits.back().time);
  return result;
}

PaperExperiment paper_bus_off(const PaperFiles &files) {
  // A missing ACK alone never leads beyond 0x80 (FC-05): bit errors do.
  DataBitFault fault{PaperBench::kIp};
  PaperBench bench{files, "Figures 17 and 18: bus-off and recovery", true};
  bench.add(fault);
  bench.send(PaperBench::kIp, kPaperFrame);
  const auto &bits = bench.bits(PaperBench::kIp);
  const auto off = [&] { return bits.back().after.bus_off; };
  bench.run_until(off, Time{40} * 90);
  fault.on = false;
  const auto frames = error_frames(bits);
  bench.run_until([&] { return !off(); }, 1500);
  bench.run_bits(3);
  PaperExperiment result{"bus-off", files};
  result.checks = {check_bus_off(bits, frames), check_recovery(bits)};
  bench.finish(result, first_sof(bits) - 20 * PaperBench::kBit, bits.back().time);
  return result;
}

std::vector<PaperExperiment> run_paper(const PaperOutputs &outputs) {
  for (const std::string &folder : {outputs.wave_folder, outputs.page_folder}) {
    if (folder.empty()) continue;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw InputError(folder, 0, "cannot be created: " + error.message());
  }
  const auto file = [](const std::string &folder, const std::string &name) {
    return folder.empty() ? std::string{} : folder + "/" + name;
  };
  const auto files = [&](const std::string &name) {
    return PaperFiles{file(outputs.wave_folder, name + outputs.suffix),
                      file(outputs.page_folder, name + ".html")};
  };
  constexpr std::pair<PaperExperiment (*)(const PaperFiles &), const char *> kAll[] = {
      {paper_reception, "fig11-reception"},
      {paper_transmission, "fig12-transmission"},
      {paper_arbitration, "fig13-arbitration"},
      {paper_missing_ack, "fig14-16-missing-ack"},
      {paper_bus_off, "fig17-18-bus-off"}};
  std::vector<PaperExperiment> done;
  for (const auto &[experiment, name] : kAll)
    if (!stop_requested()) done.push_back(experiment(files(name)));
  return done;
}

}  // namespace vericansim
