#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every fuzz target for SECONDS, starting from tests/corpus/TARGET (chosen by hand) and
# tests/corpus/TARGET.tar.gz (what longer runs found, minimised).
# Usage: fuzz.sh [SECONDS [TARGET...]]
set -euo pipefail
cd "$(dirname "$0")/.."
time=${1:-60}
shift || true

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target fuzzers
mapfile -t targets < build/fuzz/fuzzers.txt
[ $# -eq 0 ] || targets=("$@")

for target in "${targets[@]}"; do
    binary=$(find build/fuzz -type f -name "$target" -perm -u+x | head -n 1)
    found=build/fuzz/corpus/$target
    mkdir -p "$found"
    [ -f "tests/corpus/$target.tar.gz" ] && tar -xzf "tests/corpus/$target.tar.gz" -C "$found"
    seeds=()
    [ -d "tests/corpus/$target" ] && seeds=("tests/corpus/$target")
    printf '%-28s' "$target"
    if ! "$binary" -max_total_time="$time" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/$target-" "$found" "${seeds[@]}" > "build/fuzz/$target.log" 2>&1; then
        echo " FAILED"
        tail -n 40 "build/fuzz/$target.log"
        exit 1
    fi
    echo " ok, $(grep -oE 'stat::number_of_executed_units: [0-9]+' "build/fuzz/$target.log" | grep -oE '[0-9]+$') runs"
done
