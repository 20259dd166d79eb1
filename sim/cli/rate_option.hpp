// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Options for bit rates and clocks, with the units that people write.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "trace/wave_decode.hpp"

namespace vericansim::cli {

/// A transformation of CLI11 to bit/s: "500000", "500k", "500 kbit/s", in capitals or not.
[[nodiscard]] CLI::Validator bitrate_units();
/// The same to Hz: "8000000", "8M", "8 MHz".
[[nodiscard]] CLI::Validator clock_units();

/// Adds an option for the rate of a bus, 1 kbit/s to 1 Mbit/s.
CLI::Option *add_bitrate_option(CLI::App &command, const std::string &names, double &bitrate,
                                const std::string &help);

/// Warns that `wave`, in which no frame was found, was read at another rate than its edges show.
void warn_of_bitrate(const Wave &wave, const std::string &path);

/// Warns that `wave` begins too late for its first frame.
void warn_of_beginning(const Wave &wave, int sample_point, const std::string &path);

}  // namespace vericansim::cli
