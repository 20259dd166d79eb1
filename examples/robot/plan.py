# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The robot in numbers: who is there, what is sent how often. Times in seconds."""
CYCLE = 1e-3
JOINTS, SENSORS = range(1, 7), range(7, 9)
SET_POINTS = (0x200, 0x280)   # three joints each, 16 bits for each
REACTION = (30e-6, 60e-6)     # of a device, from a received frame to its answer in the core, s
HOST_DELAY = 10e-6            # from SYNC to set points, s
BEAT = 0.1
START = 20e-3                 # the first SYNC
LOG = bytes(range(35))        # what the SDO client reads in the background
SDO_PERIOD = 10e-3
WATCH = 5                     # cycles without a position after which the host calls a joint lost
RESTART = 20e-3               # bus-off to the begin of recovery
FAILS = 3                     # the joint that fails
DISTURBED = 3                 # cycles in which a failing joint may disturb the others
