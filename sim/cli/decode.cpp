// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican decode: a bus waveform to frames and error frames.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "signals/signal_output.hpp"
#include "trace/candump.hpp"
#include "trace/output_file.hpp"
#include "trace/pcap_file.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim::cli {
namespace {

struct DecodeOptions {
  std::string wave;
  WaveDecodeOptions decode;
  double bitrate = 0;
  double sample_point = 80;  // per cent
  std::string candump;
  std::string pcap;
  std::vector<std::string> databases;
  std::shared_ptr<const Database> database;
  bool json = false;
};

const char *name_of(BusEventKind kind) {
  switch (kind) {
    case BusEventKind::kFrame: return "frame";
    case BusEventKind::kErrorFrame: return "error";
    case BusEventKind::kOverloadFrame: return "overload";
    case BusEventKind::kBadFrame: return "bad frame";
  }
  return "";
}

const char *name_of(BusProblem problem) {
  switch (problem) {
    case BusProblem::kNone: return "none";
    case BusProblem::kStuff: return "stuff";
    case BusProblem::kForm: return "form";
    case BusProblem::kCrc: return "crc";
  }
  return "";
}

bool is_frame(const BusEvent &event) { return event.kind == BusEventKind::kFrame; }

Json event_json(const BusEvent &event, const Database *database) {
  Json json{{"kind", name_of(event.kind)}, {"start_ps", event.start}, {"end_ps", event.end}};
  if (is_frame(event) || event.kind == BusEventKind::kBadFrame) {
    json["frame"] = cli::to_json(event.frame);
    json["acked"] = event.acked;
    json["stuffed_length"] = event.stuffed_length;
    if (database != nullptr)
      vericansim::add_signals(json, vericansim::decode(*database, event.frame));
  }
  if (!is_frame(event)) {
    json["problem"] = name_of(event.problem);
    json["field"] = field_name(event.field);
    json["index"] = event.index;
    json["flag_bits"] = event.flag_bits;
  }
  return json;
}

std::string line_of(const BusEvent &event, const Database *database) {
  if (database == nullptr || !is_frame(event)) return to_string(event);
  return to_string(event) +
         " :: " + to_text(vericansim::decode(*database, event.frame), event.frame);
}

void write_logs(const DecodeOptions &options, const WaveDecodeResult &result) {
  std::unique_ptr<OutputFile> file;
  std::unique_ptr<CandumpWriter> candump;
  std::unique_ptr<PcapWriter> pcap;
  if (!options.candump.empty()) {
    file = std::make_unique<OutputFile>(options.candump);
    candump = std::make_unique<CandumpWriter>(file->stream());
  }
  if (!options.pcap.empty()) pcap = std::make_unique<PcapWriter>(options.pcap);
  for (const BusEvent &event : result.events) {
    if (!is_frame(event)) continue;
    const LogEntry entry{event.start, "can0", event.frame};
    if (candump) candump->write(entry);
    if (pcap) pcap->write(entry);
  }
  if (file) file->commit();
  if (pcap) pcap->commit();
}

int decode(DecodeOptions &options) {
  if (options.bitrate != 0) options.decode.bitrate = options.bitrate;
  options.database = with_files(nullptr, options.databases);
  std::vector<NamedFile> inputs{{"the waveform", options.wave}}, outputs;
  add_databases(inputs, options.database);
  if (!options.candump.empty()) outputs.push_back({"--candump", options.candump});
  if (!options.pcap.empty()) outputs.push_back({"--pcap", options.pcap});
  claim_files(inputs, outputs);
  options.decode.sample_point = static_cast<int>(options.sample_point * 10);
  const Wave wave = read_wave(options.wave, options.decode);
  const WaveDecodeResult result = decode_wave(wave, options.decode.sample_point);
  const bool found = !result.events.empty() || result.cut;
  if (found) write_logs(options, result);
  std::size_t frames = 0, errors = 0, overloads = 0;
  Json list = Json::array();
  for (const BusEvent &event : result.events) {
    frames += is_frame(event) ? 1 : 0;
    errors +=
        event.kind == BusEventKind::kErrorFrame || event.kind == BusEventKind::kBadFrame ? 1 : 0;
    overloads += event.kind == BusEventKind::kOverloadFrame ? 1 : 0;
    if (options.json)
      list.push_back(event_json(event, options.database.get()));
    else
      fmt::print("{}\n", line_of(event, options.database.get()));
  }
  if (result.cut && !options.json) fmt::print("{}\n", cut_text(*result.cut));
  if (options.json)
    print_json({{"signal", result.signal},
                {"bitrate", result.bitrate},
                {"end_ps", result.end},
                {"frames", frames},
                {"errors", errors},
                {"overloads", overloads},
                {"cut_ps", result.cut ? Json(*result.cut) : Json()},
                {"events", list}});
  else
    fmt::print("signal {}, {:.0f} bit/s: {} frames, {} error frames, {} overload frames in {}\n",
               result.signal, result.bitrate, frames, errors, overloads,
               time_text(wave.end - wave.begin()));
  if (frames == 0) warn_of_bitrate(wave, options.wave);
  warn_of_beginning(wave, options.decode.sample_point, options.wave);
  if (found) return kOk;
  print_error("verican: {}: no frame is in it\n", options.wave);
  return kFailed;
}

}  // namespace

void add_decode(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<DecodeOptions>();
  CLI::App *command = app.add_subcommand("decode", "Frames and error frames of a bus waveform");
  command->add_option("wave", options->wave, "VCD file")->required();
  command->add_option("--signal,-s", options->decode.signal,
                      "Signal of the bus, or the end of its name (guessed)");
  add_bitrate_option(*command, "--bitrate,-b", options->bitrate, "Bit rate, bit/s (detected)");
  command
      ->add_option("--sample-point", options->sample_point,
                   "Place of the sample, % of the bit (80)")
      ->check(CLI::Range(1.0, 99.0));
  command->add_option("--candump", options->candump, "Write the frames as a candump log");
  command->add_option("--pcap", options->pcap, "Write the frames as a capture for Wireshark");
  add_database_option(*command, options->databases);
  command->add_flag("--json", options->json, "Events as JSON");
  command->callback([options, &exit_code] { exit_code = decode(*options); });
}

}  // namespace vericansim::cli
