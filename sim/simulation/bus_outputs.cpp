// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusOutputs.
#include "simulation/bus_outputs.hpp"

#include "trace/output_file.hpp"

namespace vericansim {

BusOutputs::BusOutputs(const Outputs &outputs, Bus &bus, Time bit_time)
    : database_{outputs.database}, report_frames_{outputs.report_frames} {
  const auto add_wave = [&](std::unique_ptr<WaveSink> sink) {
    waves_.push_back(std::make_unique<BusWave>(bus, std::move(sink), bit_time));
    bus.add(*waves_.back());
  };
  if (!outputs.vcd.empty()) add_wave(open_vcd(outputs.vcd));
  if (!outputs.fst.empty()) add_wave(open_fst(outputs.fst));
  if (!outputs.candump.empty()) {
    candump_file_ = std::make_unique<OutputFile>(outputs.candump);
    candump_ = std::make_unique<CandumpWriter>(candump_file_->stream());
  }
  if (!outputs.pcap.empty()) pcap_ = std::make_unique<PcapWriter>(outputs.pcap);
  if (database_) signals_ = std::make_unique<SignalRecorder>(database_, outputs.signals_csv);
  if (!outputs.ids_csv.empty()) ids_file_ = std::make_unique<OutputFile>(outputs.ids_csv);
  if (!outputs.report.empty()) page_ = std::make_unique<ReportWriter>(outputs.report);
}

void BusOutputs::record(Bus &bus, BusMonitor &monitor, const ReportSetup &setup) {
  if (!page_) return;
  recorder_ = std::make_unique<ReportRecorder>(bus, monitor, setup, report_frames_);
  bus.add(*recorder_);
}

void BusOutputs::on_level(Time time, Level level) {
  if (recorder_) recorder_->on_level(time, level);
}

void BusOutputs::begin(Time now) {
  start_ = now;
  if (recorder_) recorder_->begin();
}

void BusOutputs::write(const BusFrame &frame, const FrameOrigin &origin) {
  const LogEntry entry{frame.start, "can0", frame.frame};
  if (candump_) candump_->write(entry);
  if (pcap_) pcap_->write(entry);
  if (signals_) signals_->add(entry);
  identifiers_.add(entry.channel, frame.frame, frame.start - start_);
  if (recorder_) recorder_->add(frame, origin);
}

void BusOutputs::finish(Time time) {
  for (const auto &wave : waves_) wave->finish(time);
  if (candump_file_) candump_file_->commit();
  if (pcap_) pcap_->commit();
  if (signals_) signals_->finish();
  if (ids_file_) {
    write_csv(identifiers_, ids_file_->stream());
    ids_file_->commit();
  }
  if (recorder_) recorder_->finish();
}

void BusOutputs::write_report(ReportExtras extras) {
  extras.database = database_.get();
  if (recorder_) page_->write(*recorder_, extras);
}

}  // namespace vericansim
