// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals for people, programs and spreadsheets.
#include "signals/signal_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iterator>

#include "signals/signal_text.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Integers of the file stay integers.
OrderedJson number_json(const SignalValue &value) {
  const Signal &signal = *value.signal;
  if (signal.is_float || signal.factor != 1 || signal.offset != 0) return value.value;
  return signal.is_signed ? OrderedJson(static_cast<std::int64_t>(value.raw))
                          : OrderedJson(value.raw);
}

OrderedJson value_json(const SignalValue &value) {
  OrderedJson json{{"value", number_json(value)}};
  if (!value.signal->unit.empty()) json["unit"] = value.signal->unit;
  if (const auto choice = choice_of(value)) json["text"] = *choice;
  return json;
}

std::string id_text(const Frame &frame) {
  return fmt::format("{:0{}X}", frame.id, frame.extended ? 8 : 3);
}

}  // namespace

std::string to_text(const SignalReport &report) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "  {} frames of the database's messages, {} others\n", report.known,
                 report.unknown);
  if (report.signals.empty()) return text;
  fmt::format_to(out, "  {:<36} {:>8} {:>14} {:>14} {:>14} {:>14}  {}\n", "signal", "frames",
                 "last", "min", "max", "mean", "unit");
  for (const SignalSummary &s : report.signals) {
    const Signal &signal = *s.last.signal;
    const auto choice = choice_of(s.last);
    fmt::format_to(out, "  {:<36} {:>8} {:>14} {:>14} {:>14} {:>14}  {}\n",
                   text::printable(s.message->name + "." + signal.name), s.count,
                   choice ? text::printable(*choice) : number_text(s.last), number_text(s.least),
                   number_text(s.most), plain_number(s.mean()), text::printable(signal.unit));
  }
  return text;
}

OrderedJson to_json(const SignalReport &report) {
  OrderedJson list = OrderedJson::array();
  for (const SignalSummary &s : report.signals)
    list.push_back({{"message", s.message->name},
                    {"signal", s.last.signal->name},
                    {"unit", s.last.signal->unit},
                    {"count", s.count},
                    {"first", value_json(s.first)},
                    {"last", value_json(s.last)},
                    {"min", number_json(s.least)},
                    {"max", number_json(s.most)},
                    {"mean", s.mean()}});
  return {{"frames", {{"known", report.known}, {"unknown", report.unknown}}}, {"signals", list}};
}

OrderedJson signals_json(const std::vector<SignalValue> &values) {
  OrderedJson json = OrderedJson::object();
  for (const SignalValue &value : values) json[value.signal->name] = value_json(value);
  return json;
}

DecodedFrame decode(const Database &database, const Frame &frame) {
  const SignalMessage *message = database.find(frame.id, frame.extended);
  if (message == nullptr) return {};
  return {message, decode(*message, frame)};
}

std::string to_text(const DecodedFrame &decoded, const Frame &frame) {
  if (decoded.message == nullptr) return "unknown";
  if (frame.remote) return decoded.message->name + ", remote";
  return to_text(*decoded.message, decoded.values);
}

void add_signals(OrderedJson &json, const DecodedFrame &decoded) {
  if (decoded.message == nullptr) return;
  json["message"] = decoded.message->name;
  json["signals"] = signals_json(decoded.values);
}

SignalCsv::SignalCsv(const std::string &path, std::int64_t start_ns)
    : file_{path}, start_ns_{start_ns} {
  file_.stream() << "time,interface,id,message,signal,raw,value,unit,choice\n";
}

void SignalCsv::write(const LogEntry &entry, const DecodedFrame &decoded) {
  if (decoded.message == nullptr) return;
  constexpr Time kSecondInNs = 1'000'000'000;
  const Time ns = start_ns_ + entry.time / kNanosecond;
  const std::string start = fmt::format("{}.{:09},{},{},{}", ns / kSecondInNs, ns % kSecondInNs,
                                        text::csv_field(entry.channel), id_text(entry.frame),
                                        text::csv_field(decoded.message->name));
  for (const SignalValue &value : decoded.values) {
    const Signal &signal = *value.signal;
    const auto raw = signal.is_signed && !signal.is_float
                         ? fmt::format("{}", static_cast<std::int64_t>(value.raw))
                         : fmt::format("{}", value.raw);
    file_.stream() << fmt::format("{},{},{},{},{},{}\n", start, text::csv_field(signal.name), raw,
                                  number_text(value), text::csv_field(signal.unit),
                                  text::csv_field(choice_of(value).value_or("")));
  }
}

void SignalCsv::finish() { file_.commit(); }

SignalRecorder::SignalRecorder(std::shared_ptr<const Database> database, const std::string &csv)
    : database_{database}, statistics_{std::move(database)} {
  if (!csv.empty()) csv_ = std::make_unique<SignalCsv>(csv, kLogOriginNs);
}

void SignalRecorder::add(const LogEntry &entry) {
  const DecodedFrame decoded = decode(*database_, entry.frame);
  statistics_.add(decoded.message, decoded.values);
  if (csv_) csv_->write(entry, decoded);
}

void SignalRecorder::finish() {
  if (csv_) csv_->finish();
}

}  // namespace vericansim
