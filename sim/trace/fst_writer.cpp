// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FST writer on GTKWave's fstapi, which comes with Verilator.
#include <gtkwave/fstapi.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "trace/fst_files.h"
#include "trace/output_file.hpp"
#include "trace/unfinished_files.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

/// A file that is gone at the end, if nobody took it.
struct Scratch {
  explicit Scratch(std::string path) : name{std::move(path)} {}
  ~Scratch() {
    ::unlink(name.c_str());
    forget_unfinished(name);
  }
  Scratch(const Scratch &) = delete;
  Scratch &operator=(const Scratch &) = delete;
  std::string name;
};

class FstWriter : public WaveSink {
 public:
  // The library writes by name, and goes back in its file.
  explicit FstWriter(const std::string &path) : file_{path}, scratch_{file_.make_scratch()} {
    verican_fst_error();  // of nobody
    fst_ = fstWriterCreate(scratch_.name.c_str(), 1);
    if (fst_ == nullptr)
      throw OutputError(path, "cannot be opened for writing", verican_fst_error());
    fstWriterSetTimescaleFromString(fst_, "1ps");
    fstWriterSetPackType(fst_, FST_WR_PT_LZ4);
    fstWriterSetVersion(fst_, "VeriCAN");
  }
  ~FstWriter() override {
    if (fst_ != nullptr) fstWriterClose(fst_);
  }

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
    check();
  }
  void set(Time time, Signal signal, std::string_view text) override {
    advance(time);
    fstWriterEmitVariableLengthValueChange(fst_, variables_[signal].handle, text.data(),
                                           static_cast<std::uint32_t>(text.size()));
    check();
  }
  void finish(Time time) override {
    advance(time);
    fstWriterClose(fst_);
    fst_ = nullptr;
    check();
    file_.commit(scratch_.name);
  }

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
    check();
  }

  /// Throws if the library could not write; it goes on as if nothing were wrong.
  void check() const {
    if (const int error = verican_fst_error(); error != 0)
      throw OutputError(file_.path(), "cannot be written to its end", error);
  }

  OutputFile file_;
  Scratch scratch_;
  void *fst_ = nullptr;
  Time time_ = -1;
  std::string scope_;
  std::vector<Variable> variables_;
};

}  // namespace

std::unique_ptr<WaveSink> open_fst(const std::string &path) {
  return std::make_unique<FstWriter>(path);
}

}  // namespace vericansim
