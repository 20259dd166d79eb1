// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Differences between a node and the model that the rule book leaves open (19.5, item 5).
#pragma once

#include "judge/node_bit.hpp"
#include "model/node_model.hpp"

namespace vericansim {

/// FC-05b: for the stuff bit right after RTR both a step of 8 and none are allowed. True if that
/// explains the difference of TEC; the model then goes on with the node's value.
[[nodiscard]] bool settle_tec(NodeModel &model, const NodeBit &bit);

/// FC-10, FC-14: REC from 128 on is only ">= 128", and is set back to any of 119..127; the step of
/// a CRC error may come one bit early or late. True if one of these explains the difference.
/// `last_rec`: of the model before the bit. `crc_step`: kept by the caller, false at first and
/// after each bit in which both agree.
[[nodiscard]] bool settle_rec(NodeModel &model, int last_rec, bool &crc_step, const NodeBit &bit);

}  // namespace vericansim
