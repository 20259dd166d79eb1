# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Remote frames each way, base and extended.
tell bitrate 500000
up can0 500000
up can1 500000
sleep 0.001
tell log bus.log
listen can0 can0.log
listen can1 can1.log
cansend can0 123#R
cansend can0 12345678#R5
cansend can0 124#R8
cansend can0 125#1122
sleep 0.002
cansend can1 223#R
cansend can1 02345678#R5
cansend can1 224#R8
cansend can1 225#3344
sleep 0.002
status remote
hush
down can0
down can1
