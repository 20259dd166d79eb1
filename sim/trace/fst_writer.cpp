// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FST writer on GTKWave's fstapi, which comes with Verilator.
#include <gtkwave/fstapi.h>

#include <vector>

#include "trace/input_error.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

class FstWriter : public WaveSink {
 public:
  explicit FstWriter(const std::string &path) : fst_{fstWriterCreate(path.c_str(), 1)} {
    if (fst_ == nullptr) throw InputError(path, 0, "cannot be opened for writing");
    fstWriterSetTimescaleFromString(fst_, "1ps");
    fstWriterSetPackType(fst_, FST_WR_PT_LZ4);
    fstWriterSetVersion(fst_, "VeriCAN");
  }
  ~FstWriter() override { fstWriterClose(fst_); }

  Signal add_wire(const std::string &scope, const std::string &name, unsigned width) override {
    return declare(scope, name, FST_VT_VCD_WIRE, width);
  }
  Signal add_text(const std::string &scope, const std::string &name) override {
    return declare(scope, name, FST_VT_GEN_STRING, 0);
  }
  void start() override {
    if (!scope_.empty()) fstWriterSetUpscope(fst_);
  }

  void set(Time time, Signal signal, std::uint64_t value) override {
    advance(time);
    const Variable &variable = variables_[signal];
    std::string bits(variable.width, '0');
    for (unsigned i = 0; i < variable.width; ++i)
      if (((value >> i) & 1) != 0) bits[variable.width - 1 - i] = '1';
    fstWriterEmitValueChange(fst_, variable.handle, bits.data());
  }
  void set(Time time, Signal signal, std::string_view text) override {
    advance(time);
    fstWriterEmitVariableLengthValueChange(fst_, variables_[signal].handle, text.data(),
                                           static_cast<std::uint32_t>(text.size()));
  }
  void finish(Time time) override { advance(time); }

 private:
  struct Variable {
    fstHandle handle;
    unsigned width;
  };

  Signal declare(const std::string &scope, const std::string &name, fstVarType type,
                 unsigned width) {
    if (scope != scope_) {
      if (!scope_.empty()) fstWriterSetUpscope(fst_);
      fstWriterSetScope(fst_, FST_ST_VCD_MODULE, scope.c_str(), nullptr);
      scope_ = scope;
    }
    const fstHandle handle =
        fstWriterCreateVar(fst_, type, FST_VD_IMPLICIT, width, name.c_str(), 0);
    variables_.push_back({handle, width});
    return static_cast<Signal>(variables_.size() - 1);
  }

  void advance(Time time) {
    if (time <= time_) return;
    time_ = time;
    fstWriterEmitTimeChange(fst_, static_cast<std::uint64_t>(time));
  }

  void *fst_;
  Time time_ = -1;
  std::string scope_;
  std::vector<Variable> variables_;
};

}  // namespace

std::unique_ptr<WaveSink> open_fst(const std::string &path) {
  return std::make_unique<FstWriter>(path);
}

}  // namespace vericansim
