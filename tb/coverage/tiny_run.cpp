// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Drives module tiny: tiny_run INPUT... Each input is held for one clock. A first instance, gone
// before the second is made, gets inputs 0 and 0.
#include <cstdlib>
#include <memory>

#include "Vtiny.h"

namespace {

class Tiny {
 public:
  Tiny() {
    top_.rst_ni = 0;
    clock(0);
    top_.rst_ni = 1;
  }
  ~Tiny() { top_.final(); }
  void clock(int input) {
    top_.in_i = static_cast<unsigned char>(input);
    top_.clk_i = 0;
    top_.eval();
    top_.clk_i = 1;
    top_.eval();
  }

 private:
  VerilatedContext context_;
  Vtiny top_{&context_, "tiny"};
};

}  // namespace

int main(int argc, char **argv) {
  {
    Tiny first;
    first.clock(0);
    first.clock(0);
  }
  Tiny second;
  for (int i = 1; i < argc; ++i) second.clock(std::atoi(argv[i]));
  return 0;
}
