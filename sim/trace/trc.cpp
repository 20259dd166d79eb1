// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PCAN-View trace files: parser. Each version is a list of columns.
#include "trace/trc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "trace/candump.hpp"
#include "trace/fd_lengths.hpp"
#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"
#include "trace/text.hpp"
#include "trace/trc_format.hpp"

namespace vericansim {
namespace {

using text::fail;
using text::Place;
using Fields = std::vector<std::string_view>;

struct Version {
  std::string_view number;
  std::string_view columns;  ///< letters of $COLUMNS
};
constexpr std::array<Version, 6> kVersions = {{{"1.0", "NOILD"},
                                               {"1.1", "NOTILD"},
                                               {"1.2", "NOBTILD"},
                                               {"1.3", "NOBTIRLD"},
                                               {"2.0", "NOTIdlD"},
                                               {"2.1", "NOTBIdRLD"}}};

/// Which kind of frame a type is.
struct Type {
  std::string_view name;
  bool fd = false;
  unsigned fd_flags = 0;
  bool remote = false;
  Direction direction = Direction::kUnknown;
};
constexpr std::array<Type, 8> kTypes = {{{"Rx", false, 0, false, Direction::kReceived},
                                         {"Tx", false, 0, false, Direction::kSent},
                                         {"DT"},
                                         {"RR", false, 0, true},
                                         {"FD", true, 0},
                                         {"FB", true, 1},
                                         {"FE", true, 2},
                                         {"BI", true, 3}}};

/// Reads the lines of one file.
class TrcReader {
 public:
  void line(std::string_view line, const Place &place) {
    const Fields fields = text::split_blanks(line);
    if (fields.empty()) return;
    if (fields[0].front() == ';')
      header(text::trimmed(line), place);
    else
      entry(fields, place);
  }
  CanLog finish() { return log_.finish(start_ns_ != 0); }

 private:
  void header(std::string_view line, const Place &place) {
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos) return;
    const std::string_view value = text::trimmed(line.substr(sign + 1));
    if (line.starts_with(";$FILEVERSION=")) {
      const auto *version = std::find_if(kVersions.begin(), kVersions.end(),
                                         [value](const Version &v) { return v.number == value; });
      if (version == kVersions.end())
        fail(place, "version " + in_quotes(std::string(value)) +
                        " is not known; allowed: 1.0, 1.1, 1.2, 1.3, 2.0, 2.1");
      columns_ = version->columns;
    }
    if (line.starts_with(";$COLUMNS=")) {
      columns_.clear();
      for (const std::string_view letter : text::split_commas(value))
        columns_ += text::trimmed(letter);
      if (columns_.find_first_not_of("NOTBIdRlLD") != std::string::npos ||
          columns_.find('I') == std::string::npos || columns_.find('O') == std::string::npos)
        fail(place, "columns " + in_quotes(std::string(value)) +
                        " are not known; allowed: N,O,T,B,I,d,R,l,L,D, with O and I");
    }
    if (!line.starts_with(";$STARTTIME=")) return;
    const auto start = trc::start_ns(value);
    if (!start)
      fail(place, "start time " + in_quotes(std::string(value)) +
                      " is not allowed; allowed: days since the end of 1899, up to the year 2262");
    start_ns_ = *start;
  }

  /// The field of column `letter`; empty if there is none.
  [[nodiscard]] std::string_view field(const Fields &fields, char letter) const {
    const std::size_t at = columns_.find(letter);
    return at < fields.size() ? fields[at] : std::string_view{};
  }

  void entry(const Fields &fields, const Place &place) {
    // A file that tells no version is of the first one, or of 1.1 without its header.
    if (columns_.empty())
      columns_ = fields.size() > 2 && fields[2].find_first_of("xgn") != std::string_view::npos
                     ? kVersions[1].columns
                     : kVersions[0].columns;
    if (fields.size() < 3) fail(place, "expected NUMBER TIME TYPE IDENTIFIER LENGTH BYTES");
    const std::string_view name =
        columns_.find('T') == std::string::npos ? "DT" : field(fields, 'T');
    const auto *type = std::find_if(kTypes.begin(), kTypes.end(),
                                    [name](const Type &t) { return t.name == name; });
    if (type == kTypes.end() || field(fields, 'I') == "FFFFFFFF") return log_.skip();
    const auto ns = text::parse_decimal(field(fields, 'O'), 1'000'000);
    if (!ns)
      fail(place,
           "time " + in_quotes(std::string(field(fields, 'O'))) + " is no number of milliseconds");
    CandumpLine result;
    if (__builtin_add_overflow(start_ns_, *ns, &result.ns)) fail(place, "time is out of range");
    result.frame = frame(fields, *type, place);
    result.direction = type->direction;
    if (const std::string_view way = field(fields, 'd'); !way.empty())
      result.direction = direction_of(way, place);
    const std::string_view number = field(fields, 'B');
    const auto bus = text::parse_unsigned(number, 10);
    if (!number.empty() && !bus)
      fail(place, "bus " + in_quotes(std::string(number)) + " is not allowed; allowed: a number");
    if (bus && *bus != 0) result.channel = fmt::format("can{}", *bus - 1);
    add_candump_line(result, log_, place);
  }

  /// The frame as candump writes it.
  [[nodiscard]] std::string frame(const Fields &fields, const Type &type,
                                  const Place &place) const {
    const std::string_view id = field(fields, 'I');
    if (id.size() != 4 && id.size() != 7 && id.size() != 8)
      fail(place, "identifier " + in_quotes(std::string(id)) +
                      " is not allowed; allowed: 4 or 8 hexadecimal digits");
    const auto number = text::parse_unsigned(id, 16);
    Frame checked;
    if (!number) fail(place, "identifier " + in_quotes(std::string(id)) + " is not hexadecimal");
    text::set_id(checked, *number, id.size() != 4, place);
    const bool told = columns_.find('l') != std::string::npos;  // a length, no DLC
    const std::string_view text = field(fields, told ? 'l' : 'L');
    const auto dlc = text::parse_unsigned(text, 10);
    if (!dlc || *dlc > (told ? (type.fd ? 64U : 8U) : 15U))
      fail(place, "length " + in_quotes(std::string(text)) +
                      (told ? " is not allowed; allowed: 0 to 8, CAN FD to 64"
                            : " is not allowed; allowed: 0 to 15"));
    const std::string head = fmt::format("{:0{}X}#", *number, checked.extended ? 8 : 3) +
                             (type.fd ? fmt::format("#{:X}", type.fd_flags) : std::string{});
    const std::string raw = !type.fd && *dlc > 8 ? fmt::format("_{:X}", *dlc) : std::string{};
    if (type.remote || field(fields, 'D') == "RTR")
      return head + fmt::format("R{}", std::min<std::uint64_t>(*dlc, 8)) + raw;
    const std::size_t length =
        type.fd && !told ? kFdLengths[*dlc] : std::min<std::size_t>(*dlc, type.fd ? 64 : 8);
    const std::size_t first = std::min(columns_.find('D'), fields.size());
    return head + text::byte_digits(fields, first, length, place) + raw;
  }

  LogBuilder log_;
  std::string columns_;
  std::int64_t start_ns_ = 0;
};

}  // namespace

CanLog parse_trc(std::string_view text, const std::string &file) {
  TrcReader reader;
  text::for_each_line(text, file,
                      [&](std::string_view line, const Place &place) { reader.line(line, place); });
  return reader.finish();
}

}  // namespace vericansim
