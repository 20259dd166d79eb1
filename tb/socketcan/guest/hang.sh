# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A script without an end, with a busy process beside it.
(while :; do :; done) &
echo >hanging
sleep 100000
