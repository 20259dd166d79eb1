// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveform of a soft-error run: the wire, the three pins and where the node under test is.
#pragma once

#include <string>

#include "softerror/world.hpp"

namespace vericansim {

/// From now on every clock of `world` goes into a VCD file (gtkwave), 125 ns each; `flop` is the
/// flip-flop that is shown beside the rest. The file is whole when close_wave() has been called.
/// Throws InputError if it cannot be written.
void open_wave(World &world, const std::string &path, unsigned flop);
void close_wave(World &world);

}  // namespace vericansim
