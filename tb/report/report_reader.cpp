// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportPage: see report_reader.hpp.
#include "report/report_reader.hpp"

#include <zlib.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace vericansim {
namespace {

[[noreturn]] void fail(const std::string &what) { throw std::runtime_error("report: " + what); }

std::string element(const std::string &html, const std::string &head) {
  const std::size_t begin = html.find(head);
  if (begin == std::string::npos) fail("no element " + head);
  const std::size_t end = html.find("</script", begin);
  if (end == std::string::npos) fail("element without end");
  return html.substr(begin + head.size(), end - begin - head.size());
}

// RFC 4648, 4: six bits a character, "=" fills the last group.
std::string decode_base64(const std::string &text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  int value[256];
  std::fill(std::begin(value), std::end(value), -1);
  for (std::size_t i = 0; i < alphabet.size(); ++i)
    value[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
  std::string bytes;
  std::uint32_t word = 0;
  unsigned count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int six = value[static_cast<unsigned char>(c)];
    if (six < 0) fail("not base64");
    word = word << 6 | static_cast<std::uint32_t>(six);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(word >> count);
  }
  if (text.size() % 4 != 0) fail("base64 is cut");
  return bytes;
}

std::string inflate_all(const std::string &packed) {
  z_stream zlib{};
  if (inflateInit(&zlib) != Z_OK) fail("zlib");
  zlib.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(packed.data()));
  zlib.avail_in = static_cast<unsigned>(packed.size());
  std::string bytes, part(1 << 16, '\0');
  int status = Z_OK;
  while (status == Z_OK) {
    zlib.next_out = reinterpret_cast<Bytef *>(part.data());
    zlib.avail_out = static_cast<unsigned>(part.size());
    status = inflate(&zlib, Z_NO_FLUSH);
    bytes.append(part, 0, part.size() - zlib.avail_out);
  }
  inflateEnd(&zlib);
  if (status != Z_STREAM_END) fail("the zlib stream does not end");
  return bytes;
}

template <class T>
std::vector<double> column_of(const std::string &bytes, std::size_t offset, std::size_t length) {
  if (offset % 8 != 0) fail("offset is no multiple of 8");
  if (offset + length * sizeof(T) > bytes.size()) fail("array beyond the end");
  std::vector<double> values(length);
  for (std::size_t i = 0; i < length; ++i) {
    T value;
    std::memcpy(&value, bytes.data() + offset + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(value);
  }
  return values;
}

std::vector<double> read_array(const nlohmann::json &array, const std::string &bytes) {
  const std::string type = array.at("type");
  const std::size_t offset = array.at("offset"), length = array.at("length");
  if (type == "u8") return column_of<std::uint8_t>(bytes, offset, length);
  if (type == "i8") return column_of<std::int8_t>(bytes, offset, length);
  if (type == "u16") return column_of<std::uint16_t>(bytes, offset, length);
  if (type == "i16") return column_of<std::int16_t>(bytes, offset, length);
  if (type == "u32") return column_of<std::uint32_t>(bytes, offset, length);
  if (type == "f64") return column_of<double>(bytes, offset, length);
  fail("type " + type);
}

}  // namespace

ReportPage::ReportPage(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail("cannot open " + path);
  html.assign(std::istreambuf_iterator<char>(file), {});
  read();
}

ReportPage::ReportPage(std::string text, int) : html{std::move(text)} { read(); }

void ReportPage::read() {
  meta =
      nlohmann::json::parse(element(html, R"(<script type="application/json" id="verican-meta">)"));
  const std::string bytes =
      inflate_all(decode_base64(element(html, R"(<script type="text/plain" id="verican-data">)")));
  for (const auto &array : meta.at("arrays")) {
    const std::string name = array.at("name");
    if (!columns_.emplace(name, read_array(array, bytes)).second) fail("twice: " + name);
  }
}

const std::vector<double> &ReportPage::column(const std::string &name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) fail("no array " + name);
  return found->second;
}

Frame ReportPage::frame(std::size_t row) const {
  const auto word = static_cast<std::uint32_t>(at("f.id", row));
  Frame frame;
  frame.extended = (word >> 31) != 0;
  frame.remote = ((word >> 30) & 1) != 0;
  frame.id = word & 0x1FFFFFFF;
  frame.dlc = static_cast<std::uint8_t>(at("f.dlc", row));
  for (unsigned i = 0; i < 8; ++i)
    frame.data[i] = static_cast<std::uint8_t>(at("f.data", row * 8 + i));
  return frame;
}

std::vector<ReportBit> ReportPage::bits(std::size_t lane) const {
  const auto first = static_cast<std::size_t>(at("b.first", lane));
  const auto count = static_cast<std::size_t>(at("b.count", lane));
  std::vector<ReportBit> bits;
  for (std::size_t i = first; i < first + count; ++i) {
    const auto code = static_cast<unsigned>(at("bit", i));
    bits.push_back({static_cast<Field>(code & 0x1F), (code >> 5 & 1) != 0,
                    static_cast<Level>(code >> 6 & 1), static_cast<Level>(code >> 7 & 1),
                    static_cast<int>(at("bit.q", i))});
  }
  return bits;
}

std::vector<std::pair<double, Level>> ReportPage::edges(const std::string &name) const {
  const bool wire = name == "wire";
  const auto &initial = meta.at("initial");
  const int start = wire ? initial.at("wire").get<int>()
                         : initial.at(name.substr(0, 2)).at(std::stoul(name.substr(2))).get<int>();
  const double tick = meta.at("tick_ps").get<double>() / 1e3;
  std::vector<std::pair<double, Level>> edges{{0.0, static_cast<Level>(start)}};
  double ticks = 0;
  for (const double distance : column(name)) {
    ticks += distance;
    if (distance == 4294967295.0) continue;
    edges.emplace_back(ticks * tick, !edges.back().second);
  }
  return edges;
}

std::pair<std::string, std::string> ReportPage::cause(std::size_t event) const {
  const auto &cause = meta.at("causes").at(static_cast<std::size_t>(at("e.cause", event)));
  return {cause.at("text"), cause.at("rule")};
}

}  // namespace vericansim
