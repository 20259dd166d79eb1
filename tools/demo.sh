#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# demo.sh BUILD OUT: the examples, the paper's experiments, Cortex-M3 firmware and a real recording
# through the tool; waveforms and logs go to OUT.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 2 "demo.sh BUILD OUT" "$@"
build=$1
out=$2
verican=$build/verican
recording=../shared/data/traffic/canboat_candumpSample3.txt
mkdir -p "$out"
failed=()

headline() { printf '\n== %s\n' "$1"; }
run() {  # WHAT COMMAND...: goes on after a failure, and says so at the end
  local what=$1
  shift
  "$@" || failed+=("$what")
}

for scenario in examples/*.yaml; do
  if [ "$scenario" = examples/mixed.yaml ]; then continue; fi  # waits for a program: below
  if [ "$scenario" = examples/timesync.yaml ]; then continue; fi  # a case: below
  name=$(basename "$scenario" .yaml)
  headline "$scenario"
  run "$scenario" "$verican" run "$scenario" --fst "$out/$name.fst" --candump "$out/$name.log" \
    --report "$out/$name.html"
done

headline "The cabinet: five nodes without a processor, 10,000 cycles of a millisecond"
run "the cabinet" examples/remote/cabinet.py --verican "$verican" -- --report "$out/cabinet.html"
for variant in plug noise stage; do
  headline "The cabinet: variant $variant"
  run "the cabinet, $variant" examples/remote/cabinet.py --verican "$verican" \
    --variant "$variant" -- --report "$out/cabinet-$variant.html"
done

robot() {  # OPTIONS...
  env PYTHONPATH="$build/python" examples/robot/robot.py "$@"
}
if compgen -G "$build/python/verican/_core*.so" >/dev/null; then
  headline "A robot on CANopen: host, six joints, two sensors, SYNC each millisecond, 1 Mbit/s"
  run "the robot" robot --seconds 1 --report "$out/robot.html"
  headline "The robot: the receiver of a joint breaks for 3 ms"
  run "the robot, a joint fails" robot --seconds 0.2 --fail --report "$out/robot-failure.html"
else
  headline "A robot on CANopen: left out, it needs pybind11-dev and python3-dev"
fi

headline "The paper's experiments (Son, Park, Kang 2016): what the core does, what they report"
run "the paper's experiments" "$verican" paper --out "$out/paper" --report "$out/paper"

headline "Clocks synchronised over the bus: a case, and IEEE 1588 over CAN as published (2014)"
run "examples/timesync.yaml" "$verican" timesync examples/timesync.yaml
run "the published clock synchronisation" "$verican" timesync --p4

firmware() {  # NAME SCENARIO ELF...
  local name=$1 scenario=sw/firmware/$2
  shift 2
  headline "Cortex-M3 firmware: $name"
  run "firmware $name" "$verican" firmware "${@/#/$build/firmware/}" --bus "$scenario" \
    --fst "$out/firmware-$name.fst" --candump "$out/firmware-$name.log"
}
firmware ping ping/ping.yaml ping.elf pong.elf
firmware fault_demo fault_demo/faults.yaml fault_demo.elf

# A program of this computer on the bus, by TCP: no CAN in the kernel is needed.
with_python_can() {  # NAME SIGNAL COMMAND...: SIGNAL ends the command when the program is done
  local log=$out/$1.txt signal=$2 tool port="" tries=100 status=0
  shift 2
  "$@" >"$log.summary" 2>"$log" &
  tool=$!
  while [ -z "$port" ] && [ "$((tries--))" -gt 0 ]; do
    sleep 0.1
    port=$(sed -n 's/.* at 127\.0\.0\.1:\([0-9]*\)$/\1/p' "$log")
  done
  examples/python_can.py "${port:-0}" || status=$?
  if [ -n "$signal" ]; then kill -"$signal" "$tool"; fi
  wait "$tool" || status=$?
  cat "$log" "$log.summary"
  return "$status"
}
headline "python-can on the simulated bus: examples/python_can.py"
run "bridge" with_python_can python-can TERM "$verican" bridge --socketcand 127.0.0.1:0 \
  --bus examples/bridge.yaml --wait-for-clients 1 --errors state \
  --candump "$out/python-can.log" --report "$out/python-can.html"

headline "Two boards, a recording of a boat and python-can on one bus with a fault"
sed -e 's/socketcand: 29536/socketcand: "127.0.0.1:0"/' \
  -e "s|\.\./build/release|$(realpath "$build")|" \
  -e "s|boat.log|$PWD/examples/boat.log|" examples/mixed.yaml >"$out/mixed.yaml"
run "mixed" with_python_can mixed "" "$verican" run "$out/mixed.yaml" --fst "$out/mixed.fst" \
  --candump "$out/mixed.log" --report "$out/mixed.html"

headline "A SystemC platform: two cores on TLM-2.0 sockets, each with the C driver"
run "SystemC" env SYSTEMC_DISABLE_COPYRIGHT_MESSAGE=1 "$build/systemc_platform" --frames 4

if [ -f "$recording" ]; then
  headline "Replay of a real recording: a boat's NMEA 2000 network on four nodes"
  run "replay" "$verican" replay "$recording" --nodes 4 --bitrate 250k --fast \
    --candump "$out/replay.log"
fi

headline "What is left to look at"
waves() { find "$out" -name '*.fst' -o -name '*.vcd'; }
echo "$(waves | wc -l) waveforms in $out and $out/paper, for example:"
echo "  gtkwave $out/arbitration.fst"
echo "$(find "$out" -name '*.html' | wc -l) pages for the browser, for example:"
echo "  $out/faults.html"
echo "$(find "$out" -name '*.log' | wc -l) logs in candump's format, for example:"
echo "  $out/sixteen-nodes.log"
if [ "${#failed[@]}" -ne 0 ]; then
  printf 'demo: failed: %s\n' "${failed[@]}" >&2
  exit 1
fi
echo "demo: everything went as expected"
