#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# quiet.sh [--show] WHAT COMMAND...: runs a command with one progress line; its output is shown if
# it fails, or with --show.
set -euo pipefail
. "$(dirname "$0")/common.sh"
show=0
if [ "${1:-}" = --show ]; then
  show=1
  shift
fi
needs 2 "quiet.sh [--show] WHAT COMMAND..." "$@"
what=$1
shift
if [ "$show" -eq 1 ]; then
  echo "$what"
  exec "$@"
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
start=$SECONDS

progress() {  # On a terminal: Ninja's [done/total] beside the headline.
  while sleep 1; do
    printf '\r\033[K%s ... %s' "$what" "$(grep -o '^\[[0-9/]*\]' "$log" | tail -n 1)"
  done
}
if [ -t 1 ]; then
  progress &
  trap 'kill $! 2>/dev/null; rm -f "$log"' EXIT
fi

if "$@" >"$log" 2>&1 </dev/null; then
  status=0
else
  status=$?
fi
if [ -t 1 ]; then
  kill $! 2>/dev/null || true
  printf '\r\033[K'
fi
if [ "$status" -ne 0 ]; then
  # Errors first; the whole log only if nothing in it looks like one.
  grep -E -A 12 '^FAILED|error|Error|ERROR' "$log" | head -n 80 >&2 || tail -n 60 "$log" >&2
  echo "$what failed (status $status): $*" >&2
  exit "$status"
fi
echo "$what: done in $((SECONDS - start)) s"
