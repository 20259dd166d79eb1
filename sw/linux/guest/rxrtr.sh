# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# imx28: from the FIFO to mailboxes and back while the module is loaded. In mailbox mode the driver
# says that it receives no remote frames.
exchange() {
  up can0 500000
  up can1 500000
  sleep 0.001
  tell log "$1-bus.log"
  listen can0 "$1-can0.log"
  listen can1 "$1-can1.log"
  goal0=$(($(sent can0) + 60)) goal1=$(($(sent can1) + 60))
  cangen can0 -g 0 -n 60 -I r -L r -D r
  cangen can1 -g 0 -n 60 -e -I r -L r -D r
  wait_until 5 has_sent can0 $goal0
  wait_until 5 has_sent can1 $goal1
  cansend can0 123#R4
  cansend can0 124#01
  sleep 0.002
  ethtool --show-priv-flags can1 >"$1-flags.txt"
  status "$1"
  # While a device is up its mode cannot change.
  ethtool --set-priv-flags can1 rx-rtr "$2" 2>/dev/null && echo "FAILED: switched while up"
  hush
  tell log off
  down can0
  down can1
}
tell bitrate 500000
exchange fifo off
ethtool --set-priv-flags can0 rx-rtr off || echo "FAILED: rx-rtr off"
ethtool --set-priv-flags can1 rx-rtr off || echo "FAILED: rx-rtr off"
exchange mailbox on
ethtool --set-priv-flags can0 rx-rtr on || echo "FAILED: rx-rtr on"
ethtool --set-priv-flags can1 rx-rtr on || echo "FAILED: rx-rtr on"
exchange again off
