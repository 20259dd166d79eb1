// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VCD reader: header, choice of a signal, value changes.
#include "trace/vcd_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>

#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

/// Values of a bit: besides the four those of VHDL, as GTKWave reads them.
constexpr std::string_view kBits = "01xXzZuUwWlLhH-";

/// A signal's name with its modules; many signals in deep modules must not fill the memory.
constexpr std::size_t kLongestName = 1024;

/// Words between white space, with the line of the last one.
class Words {
 public:
  Words(std::string_view text, std::size_t line) : text_{text}, line_{line} {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_;
};

struct Scale {
  Time unit;      // ps per tick
  Time fraction;  // ticks per ps
};

/// "1 ns", "100ps", "10 fs"; nothing if it is none of 1, 10, 100 times s, ms, us, ns, ps, fs.
std::optional<Scale> parse_timescale(const std::string &text) {
  static constexpr std::pair<const char *, Time> kUnits[] = {{"fs", 0},
                                                             {"ps", kPicosecond},
                                                             {"ns", kNanosecond},
                                                             {"us", kMicrosecond},
                                                             {"ms", kMillisecond},
                                                             {"s", kSecond}};
  const std::size_t digits = text.find_first_not_of("0123456789");
  const std::string number = text.substr(0, digits);
  if (digits == std::string::npos || (number != "1" && number != "10" && number != "100"))
    return std::nullopt;
  for (const auto &[name, unit] : kUnits) {
    if (text.substr(digits) != name) continue;
    const Time factor = std::stoi(number);
    return unit != 0 ? Scale{unit * factor, 1} : Scale{1, 1000 / factor};
  }
  return std::nullopt;
}

std::string lower(std::string_view text) {
  std::string result{text};
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool ends_as_name(const std::string &full, const std::string &end) {
  return full == end || (full.size() > end.size() && full.ends_with(end) &&
                         full[full.size() - end.size() - 1] == '.');
}

/// "pins" of "pins[3]", also of "rx[0:0]".
std::string without_index(const std::string &name) {
  return name.ends_with(']') ? name.substr(0, name.rfind('[')) : name;
}

bool is_called(const std::string &name, const std::string &end) {
  return ends_as_name(name, end) || ends_as_name(without_index(name), end);
}

/// The words of a name: its index and what analysers call a channel ("Channel 0") stand apart.
std::string joined_name(const std::vector<std::string_view> &words, std::size_t first) {
  std::string name{words[first]};
  for (std::size_t i = first + 1; i < words.size(); ++i)
    name.append(words[i].starts_with('[') ? "" : " ").append(words[i]);
  return name;
}

/// True for variables whose values are no bits, whatever their width.
bool is_text_or_real(const VcdSignal &signal) {
  return signal.type == "string" || signal.type == "real" || signal.type == "realtime";
}

bool is_one_bit(const VcdSignal &signal) { return signal.width == 1 && !is_text_or_real(signal); }

/// Refuses a value of several bits that holds something else.
void check_vector(const std::string &path, std::string_view word, std::size_t line) {
  const bool bits = word[0] == 'b' || word[0] == 'B';
  if (bits && (word.size() == 1 || word.find_first_not_of(kBits, 1) != std::string_view::npos))
    throw InputError(path, line,
                     "value " + in_quotes(std::string(word)) +
                         " is not allowed; allowed behind b: digits 0, 1, x, z");
}

/// Behind `word`, a keyword among the value changes, and behind the text of a comment.
void pass_keyword(const std::string &path, Words &words, std::string_view word) {
  constexpr std::string_view kDumps[] = {"$dumpall", "$dumpoff", "$dumpon", "$dumpvars", "$end"};
  const std::size_t line = words.line();
  if (word == "$comment") {
    while (!word.empty() && word != "$end") word = words.next();
    if (word.empty()) throw InputError(path, line, "$comment has no $end");
  } else if (std::find(std::begin(kDumps), std::end(kDumps), word) == std::end(kDumps)) {
    throw InputError(path, line,
                     "keyword " + in_quotes(std::string(word)) +
                         " is not allowed among value changes; allowed: $comment, $dumpall, "
                         "$dumpoff, $dumpon, $dumpvars, $end");
  }
}

}  // namespace

VcdFile::VcdFile(std::string path) : path_{std::move(path)}, text_{read_text_file(path_)} {
  parse_header();
}

VcdFile::VcdFile(std::string path, std::string text)
    : path_{std::move(path)}, text_{std::move(text)} {
  parse_header();
}

void VcdFile::parse_header() {
  constexpr std::string_view kFst{"\0\0\0\0\0\0\0\x01\x49", 9};  // its first block and length
  if (text_.starts_with(kFst))
    throw InputError(path_, 0, "FST cannot be read; allowed: VCD, as 'fst2vcd' makes it");
  refuse_utf16(text_, path_);
  Words words{text_, 1};
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::size_t line = words.line();
    if (!word.starts_with("$"))
      throw InputError(path_, line,
                       "expected a VCD keyword such as $timescale or $var, found " +
                           in_quotes(std::string(word)));
    std::vector<std::string_view> arguments;
    std::string_view argument = words.next();
    for (; !argument.empty() && argument != "$end"; argument = words.next())
      arguments.push_back(argument);
    if (argument.empty()) throw InputError(path_, line, std::string(word) + " has no $end");
    if (word == "$timescale") {
      std::string joined;
      for (const std::string_view part : arguments) joined += part;
      const auto scale = parse_timescale(joined);
      if (!scale)
        throw InputError(path_, line,
                         "timescale " + in_quotes(joined) +
                             " is not allowed; allowed: 1, 10 or 100 of s, ms, us, ns, ps, fs");
      unit_ = scale->unit;
      fraction_ = scale->fraction;
    } else if (word == "$scope") {
      scopes_.emplace_back(arguments.size() > 1 ? arguments[1] : "?");
    } else if (word == "$upscope") {
      if (scopes_.empty()) throw InputError(path_, line, "$upscope without $scope");
      scopes_.pop_back();
    } else if (word == "$var") {
      parse_var(arguments, line);
    } else if (word == "$enddefinitions") {
      body_ = words.at();
      body_line_ = words.line();
      if (unit_ == 0) throw InputError(path_, line, "the header has no $timescale");
      return;
    }
  }
  throw InputError(path_, 0, "is no VCD file: $enddefinitions is missing");
}

void VcdFile::parse_var(const std::vector<std::string_view> &words, std::size_t line) {
  if (words.size() < 4)
    throw InputError(path_, line, "$var needs a type, a width, a code and a name");
  const auto width = text::parse_unsigned(words[1], 10);
  if (!width || *width > 1'000'000)
    throw InputError(path_, line,
                     "width " + in_quotes(std::string(words[1])) + " is no number of bits");
  std::string name;
  for (const std::string &scope : scopes_) {
    name += scope + ".";
    if (name.size() > kLongestName) break;
  }
  name += joined_name(words, 3);
  if (name.size() > kLongestName)
    throw InputError(path_, line,
                     fmt::format("the name {} is too long; allowed: {} characters with its scopes",
                                 in_quotes(name.substr(0, 2 * kLongestName)), kLongestName));
  signals_.push_back(
      {name, std::string(words[0]), static_cast<unsigned>(*width), std::string(words[2])});
}

void VcdFile::fail_with_list(const std::string &message) const {
  constexpr std::size_t kMostNames = 12;
  std::string names;
  std::size_t count = 0;
  for (const VcdSignal &signal : signals_) {
    if (!is_one_bit(signal)) continue;
    if (count++ < kMostNames) names += (names.empty() ? "" : ", ") + signal.name;
  }
  if (count > kMostNames) names += fmt::format(" and {} more", count - kMostNames);
  throw InputError(path_, 0,
                   message + (count != 0 ? "; one-bit signals are " + names
                                         : std::string("; there is no one-bit signal")));
}

const VcdSignal &VcdFile::find(const std::string &name) const {
  const VcdSignal *found = nullptr;
  for (const VcdSignal &signal : signals_) {
    if (!is_called(signal.name, name)) continue;
    if (signal.name == name) {
      found = &signal;
      break;
    }
    if (found != nullptr && found->code != signal.code)
      fail_with_list("signal " + in_quotes(name) + " is not unique");
    found = &signal;
  }
  if (found == nullptr) fail_with_list("no signal is called " + in_quotes(name));
  if (is_text_or_real(*found))
    fail_with_list(fmt::format("signal '{}' is a {}; allowed: one bit", found->name, found->type));
  if (found->width != 1)
    fail_with_list(fmt::format("signal '{}' has {} bits; allowed: 1", found->name, found->width));
  return *found;
}

const VcdSignal &VcdFile::guess_bus() const {
  std::vector<const VcdSignal *> single;
  for (const VcdSignal &signal : signals_)
    if (is_one_bit(signal)) single.push_back(&signal);
  if (single.size() == 1) return *single.front();
  for (const char *name :
       {"can", "can_bus", "bus", "canbus", "can_h", "can_rx", "can_rx_i", "rx", "rxd"})
    for (const VcdSignal *signal : single)
      if (is_called(lower(signal->name), name)) return *signal;
  fail_with_list("cannot tell which signal is the bus; give its name");
}

Time VcdFile::stamp(std::string_view word, Time now, std::size_t line) const {
  // Half of what Time holds: 53 days, and room for the bits behind the last edge.
  constexpr Time kLatest = std::numeric_limits<Time>::max() / 2;
  const auto ticks = text::parse_unsigned(word.substr(1), 10);
  if (!ticks || *ticks > static_cast<std::uint64_t>(kLatest / unit_))
    throw InputError(path_, line,
                     "time " + in_quotes(std::string(word)) +
                         " is not allowed; allowed: a number of ticks, up to 53 days");
  const Time time = static_cast<Time>(*ticks) * unit_ / fraction_;
  if (time < now)
    throw InputError(path_, line, "time " + in_quotes(std::string(word)) + " goes back");
  return time;
}

Time VcdFile::read(const VcdSignal &signal, const OnChange &change) const {
  std::unordered_set<std::string_view> codes;
  for (const VcdSignal &declared : signals_) codes.insert(declared.code);
  Words words{std::string_view{text_}.substr(body_), body_line_};
  std::optional<Time> begin;
  Time now = 0;
  int last = -1;
  const auto use = [&](char value) {
    const int level = value == '0' || value == 'L' || value == 'l' ? 0 : 1;  // L: a weak 0
    if (!begin) begin = now;
    if (last < 0 && now > *begin) change(*begin, static_cast<Level>(last = 1));  // it was x so far
    if (std::exchange(last, level) != level) change(now, static_cast<Level>(level));
  };
  constexpr std::string_view kSpaced = "bBrRsS";
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::size_t line = words.line();
    if (word[0] == '#') {
      now = stamp(word, now, line);
      if (!begin) begin = now;
      continue;
    }
    if (word[0] == '$') {
      pass_keyword(path_, words, word);
      continue;
    }
    const bool spaced = kSpaced.find(word[0]) != std::string_view::npos;
    if (!spaced && kBits.find(word[0]) == std::string_view::npos)
      throw InputError(path_, line,
                       "expected a value change, found " + in_quotes(std::string(word)));
    if (spaced) check_vector(path_, word, line);
    const std::string_view code = spaced ? words.next() : word.substr(1);
    if (code == signal.code)
      use(spaced ? (word.size() > 1 ? word.back() : 'x') : word[0]);
    else if (codes.find(code) == codes.end())
      throw InputError(path_, line,
                       "value " + in_quotes(std::string(word)) +
                           (code.empty() ? " has no code" : " is of a code that no $var declares") +
                           "; allowed: a value and the code of a signal");
  }
  return now;
}

}  // namespace vericansim
