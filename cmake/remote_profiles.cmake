# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Parameters of can_remote by the profile's name (section 10 of docs/remote-node.md), and of two
# variants that tests have. tools/synth.sh reads the profiles, so they are written out.
set(remote_small "")
set(remote_standard NumProd=8 NumMap=8 TxDepth=4 Protect=1)
set(remote_full NumProd=8 NumMap=8 TxDepth=4 Protect=1 Block=1 AutoRate=1 Counters=1)
set(remote_standard16 ${remote_standard} StageBytes=16)
set(remote_same SameId=1)
