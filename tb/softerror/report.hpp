// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the flips have shown: figures and tables for people and for docs/verification.md.
#pragma once

#include <string>
#include <vector>

#include "softerror/campaign.hpp"

namespace vericansim {

/// Where a flip-flop is, as the tables have it: "bit", "frame", "mailbox", "RAM output",
/// "registers", "AHB".
[[nodiscard]] std::string block_of(const std::string &variable);

/// One flip with all that was seen.
void print_record(const Record &record);

/// The table of classes and blocks; false if a flip hung the core or let it babble.
[[nodiscard]] bool print_summary(const std::vector<Record> &records);

/// The result file of the campaign. Throws std::runtime_error if it cannot be written.
void write_json(const std::vector<Record> &records, const std::string &path);

}  // namespace vericansim
