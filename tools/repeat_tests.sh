#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tests that run processes, again and again beside busy processes: finds those that fail by chance.
# Usage: repeat_tests.sh [TIMES [NAMES]], where NAMES is a regular expression; BUSY=4 busy processes.
set -euo pipefail
cd "$(dirname "$0")/.."
times=${1:-10}
names=${2:-.}
log=build/release/Testing/Temporary/LastTest.log
kept=build/repeated_tests.txt

cmake --preset release > /dev/null
cmake --build --preset release
busy=()
trap '[ ${#busy[@]} -eq 0 ] || kill "${busy[@]}"' EXIT
for _ in $(seq "${BUSY:-4}"); do
    while :; do :; done &
    busy+=($!)
done
repeats=0 failed=0
for run in $(seq "$times"); do
    printf '\n== run %d of %d (%s)\n' "$run" "$times" "$(date +%H:%M:%S)"
    ctest --preset process --tests-regex "$names" --no-tests=error || failed=$((failed + 1))
    tools/repeated_tests.py "$log" --keep "$kept" --most 1000000 | tee build/repeats_of_run.txt
    repeats=$((repeats + $(grep -c '^repeated: ' build/repeats_of_run.txt || true)))
done
rm -f build/repeats_of_run.txt
echo
echo "$times runs beside ${BUSY:-4} busy processes: $failed failed, $repeats tests needed a second try."
[ "$failed" -eq 0 ] && [ "$repeats" -le 3 ]
