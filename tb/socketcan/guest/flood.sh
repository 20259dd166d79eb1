# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Both ways at once: 10,000 frames of cangen through vcan0 onto the bus, and 10,000 of a node of the
# scenario to vcan0. mon0 is told all that happens on the bus: its count tells when all is done.
interface vcan0 mon0
listen vcan0 vcan0.log
start_bridge bridge --if vcan0 --monitor mon0 --bus flood.yaml --fast --errors none \
  --candump bus.log
send() {
  cangen vcan0 -g 0 "$@" || complain "cangen $*"
}
send -n 1792 -I i -L i -D i
send -n 1792 -I i -L i -D 1122334455667788
send -e -n 3000 -I i -L i -D i
send -e -n 1624 -I i -L i -D FFFFFFFFFFFFFFFF
send -R -n 896 -I i -L i
send -R -e -n 896 -I i -L i
wait_until 200 has_passed mon0 20000
wait_until 60 has_lines vcan0.log 20000
stop_bridge
statistics vcan0 vcan0.json
statistics mon0 mon0.json
hush
