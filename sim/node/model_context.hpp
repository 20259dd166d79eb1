// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SerialContext, ModelContext: the context of Verilated models that work in the thread that calls
// them and may be destroyed in any order.
#pragma once

#include <verilated.h>

namespace vericansim {

/// A plain context starts a thread for each further CPU of the machine when it gets a model, though
/// only models that were Verilated for threads use them.
class SerialContext : public VerilatedContext {
 public:
  SerialContext() { threads(1); }
};

/// To be declared behind the models of `context`, so that it is destroyed before them: a model
/// leaves the names of its scopes to the thread's context when it is destroyed, and that is the one
/// made last, which may be gone.
class ModelContext {
 public:
  explicit ModelContext(VerilatedContext &context) : context_{context} {}
  ~ModelContext() { Verilated::threadContextp(&context_); }
  ModelContext(const ModelContext &) = delete;
  ModelContext &operator=(const ModelContext &) = delete;

 private:
  VerilatedContext &context_;
};

}  // namespace vericansim
