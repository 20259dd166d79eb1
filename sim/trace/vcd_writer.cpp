// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VCD writer (IEEE 1364 value change dump, with GTKWave's string variables).
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "trace/output_file.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

/// "1 ps", "10 ns", ... of a power of ten in picoseconds.
std::string timescale_name(Time unit) {
  static constexpr const char *kNames[] = {"ps", "ns", "us", "ms", "s"};
  unsigned step = 0;
  while (unit >= 1000 && step + 1 < std::size(kNames)) {
    unit /= 1000;
    ++step;
  }
  return fmt::format("{} {}", unit, kNames[step]);
}

/// Short identifier codes. Readers that do not know string variables (sigrok) take a code that
/// stands alone for a value change; without the characters that begin one (# $ 0 1 x z b r s) it
/// means nothing to them.
std::string code_of(std::size_t index) {
  static constexpr std::string_view kLetters =
      "!%&'()*+,./23456789:;<=>?@ACDEFGHIJKLMNOPQTUVWY[]^_`acdefghijklmnopqtuvwy{|}~";
  std::string code;
  do {
    code += kLetters[index % kLetters.size()];
    index /= kLetters.size();
  } while (index-- != 0);
  return code;
}

class VcdWriter : public WaveSink {
 public:
  VcdWriter(const std::string &path, Time unit) : file_{path}, unit_{unit} {
    print("$comment written by VeriCAN $end\n$timescale {} $end\n", timescale_name(unit));
  }

  Signal add_wire(const std::string &scope, const std::string &name, unsigned width) override {
    const std::string range = width == 1 ? "" : fmt::format(" [{}:0]", width - 1);
    return declare(scope, {width, false, {}}, "wire", name + range);
  }
  Signal add_text(const std::string &scope, const std::string &name) override {
    return declare(scope, {1, true, {}}, "string", name);
  }

  void start() override {
    if (!scope_.empty()) print("$upscope $end\n");
    print("$enddefinitions $end\n");
  }

  void set(Time time, Signal signal, std::uint64_t value) override {
    const Variable &variable = variables_[signal];
    advance(time);
    if (variable.width == 1)
      print("{}{}\n", value & 1, variable.code);
    else
      print("b{:b} {}\n", value, variable.code);
  }
  void set(Time time, Signal signal, std::string_view text) override {
    advance(time);
    std::string word{text.empty() ? std::string_view{"-"} : text};
    std::replace(word.begin(), word.end(), ' ', '_');
    print("s{} {}\n", word, variables_[signal].code);
  }
  void finish(Time time) override {
    advance(time);
    flush();
    file_.commit();
  }

 private:
  struct Variable {
    unsigned width;
    bool text;
    std::string code;
  };

  template <typename... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    constexpr std::size_t kFull = 1 << 16;
    if (buffer_.size() > kFull) flush();
  }

  void flush() {
    file_.stream().write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  Signal declare(const std::string &scope, Variable variable, const char *type,
                 const std::string &name) {
    if (scope != scope_) {
      if (!scope_.empty()) print("$upscope $end\n");
      print("$scope module {} $end\n", scope);
      scope_ = scope;
    }
    variable.code = code_of(variables_.size());
    print("$var {} {} {} {} $end\n", type, variable.width, variable.code, name);
    variables_.push_back(std::move(variable));
    return static_cast<Signal>(variables_.size() - 1);
  }

  void advance(Time time) {
    const Time stamp = time / unit_;
    if (stamp <= stamp_) return;
    stamp_ = stamp;
    print("#{}\n", stamp);
  }

  OutputFile file_;
  Time unit_;
  Time stamp_ = -1;
  std::string scope_;
  fmt::memory_buffer buffer_;
  std::vector<Variable> variables_;
};

}  // namespace

std::unique_ptr<WaveSink> open_vcd(const std::string &path, Time unit) {
  return std::make_unique<VcdWriter>(path, unit);
}

}  // namespace vericansim
