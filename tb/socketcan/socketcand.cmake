# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican bridge --socketcand with python-can of the system's Python as the other side.
include(unittest_cases)
verican_unittest_cases("${CMAKE_CURRENT_LIST_DIR}/socketcand_cases.py" socketcan)
