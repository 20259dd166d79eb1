// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportWriter: see report_writer.hpp.
#include "report/report_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "report/base64_stream.hpp"
#include "report/page_template.hpp"
#include "report/report_meta.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie");

/// Lists the arrays first, then writes them: the same calls in both rounds.
class ArrayList {
 public:
  template <class T>
  void operator()(const std::string &name, const std::vector<T> &values) {
    const std::size_t size = values.size() * sizeof(T);
    if (out_ == nullptr) {
      json_.push_back({{"name", name},
                       {"type", type_name(T{})},
                       {"offset", offset_},
                       {"length", values.size()}});
    } else {
      constexpr std::uint8_t kPadding[kAlignment] = {};
      out_->write(values.data(), size);
      out_->write(kPadding, (kAlignment - size % kAlignment) % kAlignment);
    }
    offset_ += (size + kAlignment - 1) / kAlignment * kAlignment;
  }
  void write_to(Base64Stream &out) { out_ = &out; }
  [[nodiscard]] const Json &json() const { return json_; }

 private:
  static constexpr std::size_t kAlignment = 8;
  static const char *type_name(std::uint8_t) { return "u8"; }
  static const char *type_name(std::int8_t) { return "i8"; }
  static const char *type_name(std::uint16_t) { return "u16"; }
  static const char *type_name(std::int16_t) { return "i16"; }
  static const char *type_name(std::uint32_t) { return "u32"; }
  static const char *type_name(double) { return "f64"; }

  Json json_ = Json::array();
  Base64Stream *out_ = nullptr;
  std::size_t offset_ = 0;
};

void visit_frames(ArrayList &list, const FrameColumns &f) {
  list("f.start", f.start);
  list("f.end", f.end);
  list("f.sender", f.sender);
  list("f.id", f.id);
  list("f.dlc", f.dlc);
  list("f.data", f.data);
  list("f.segment", f.segment);
  list("f.message", f.message);
  list("f.response", f.response);
  list("f.retries", f.retries);
  list("f.lost", f.lost);
}

void visit_events(ArrayList &list, const ReportData &data) {
  const EventColumns &e = data.events;
  list("e.kind", e.kind);
  list("e.start", e.start);
  list("e.end", e.end);
  list("e.node", e.node);
  list("e.error", e.error);
  list("e.field", e.field);
  list("e.index", e.index);
  list("e.segment", e.segment);
  list("e.cause", e.cause);
  const LossColumns &l = data.losses;
  list("l.time", l.time);
  list("l.node", l.node);
  list("l.field", l.field);
  list("l.index", l.index);
  list("l.segment", l.segment);
  list("l.winner", l.winner);
  const CounterColumns &c = data.counters;
  list("c.time", c.time);
  list("c.node", c.node);
  list("c.tec", c.tec);
  list("c.rec", c.rec);
  list("c.state", c.state);
}

void visit_bits(ArrayList &list, const ReportData &data) {
  const SegmentColumns &s = data.segments;
  list("s.start", s.start);
  list("s.end", s.end);
  list("s.lane", s.lane);
  list("s.lanes", s.lanes);
  const LaneColumns &b = data.lanes;
  list("b.node", b.node);
  list("b.start", b.start);
  list("b.tq", b.tq);
  list("b.first", b.first);
  list("b.count", b.count);
  list("bit", b.bit);
  list("bit.q", b.q);
}

void visit_edges(ArrayList &list, const ReportData &data) {
  list("wire", data.wire.distances());
  for (std::size_t i = 0; i < data.tx.size(); ++i)
    list(fmt::format("tx{}", i), data.tx[i].distances());
  for (std::size_t i = 0; i < data.rx.size(); ++i)
    list(fmt::format("rx{}", i), data.rx[i].distances());
}

void visit_remote(ArrayList &list, const RemoteColumns &remote) {
  list("f.words", remote.words);
  list("words", remote.text);
  list("n.time", remote.state_time);
  list("n.node", remote.state_node);
  list("n.state", remote.state);
  list("m.time", remote.byte_time);
  list("m.node", remote.byte_node);
  list("m.address", remote.byte_address);
  list("m.byte", remote.byte);
}

void visit(ArrayList &list, const ReportData &data, const ReportExtras &extras) {
  visit_frames(list, data.frames);
  visit_events(list, data);
  visit_bits(list, data);
  visit_edges(list, data);
  if (extras.remote != nullptr) visit_remote(list, *extras.remote);
}

/// The template up to and behind a place, which it must have.
std::pair<std::string_view, std::string_view> split(std::string_view text, std::string_view place) {
  const std::size_t at = text.find(place);
  if (at == std::string_view::npos)
    throw std::logic_error("the page has no place " + std::string{place});
  return {text.substr(0, at), text.substr(at + place.size())};
}

}  // namespace

ReportWriter::ReportWriter(std::string path) : file_{std::move(path)} {
  if (page_template().empty())
    throw InputError(file_.path(), 0,
                     "this build has no report page (it was configured with -DVERICAN_REPORT=OFF)");
}

void ReportWriter::write(const ReportRecorder &recorder, const ReportExtras &extras) {
  ArrayList arrays;
  visit(arrays, recorder.data(), extras);
  Json meta = report_meta(recorder, extras);
  meta["arrays"] = arrays.json();
  const auto [head, rest] = split(page_template(), kMetaPlace);
  const auto [middle, tail] = split(rest, kDataPlace);
  std::ostream &out = file_.stream();
  out << head << "<script type=\"application/json\" id=\"verican-meta\">" << script_json(meta)
      << "</script>" << middle << "<script type=\"text/plain\" id=\"verican-data\">";
  Base64Stream data{out};
  arrays.write_to(data);
  visit(arrays, recorder.data(), extras);
  data.finish();
  out << "</script>" << tail;
  file_.commit();
}

}  // namespace vericansim
