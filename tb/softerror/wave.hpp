// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveform of a soft-error run: the wire, the three pins and where the node under test is.
#pragma once

#include <memory>
#include <string>

#include "softerror/world.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {

/// From now on every clock of `world` goes into a VCD file (gtkwave), 125 ns each; `flop` is the
/// flip-flop that is shown beside the rest. The file is there when close_wave() has been called.
/// Throws OutputError.
[[nodiscard]] std::shared_ptr<WaveSink> open_wave(World &world, const std::string &path,
                                                  unsigned flop);
/// `wave` may be empty: there is none.
void close_wave(World &world, const std::shared_ptr<WaveSink> &wave);

}  // namespace vericansim
