# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""pack: what packagers of other tools take, made from the RTL's interfaces and the register map."""
