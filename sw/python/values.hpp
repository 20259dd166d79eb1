// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values that a bus takes and gives, for Python: Frame, Message, NodeState.
#pragma once

#include <pybind11/pybind11.h>

namespace vericansim {

void bind_values(pybind11::module_ &m);

}  // namespace vericansim
