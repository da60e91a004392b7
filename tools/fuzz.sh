#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every fuzz target for SECONDS, starting from tests/corpus/TARGET (chosen by hand),
# tests/corpus/TARGET.tar.gz (what longer runs found, minimised) and the files that tests/foreign makes.
# Usage: fuzz.sh [SECONDS [TARGET...]]
set -euo pipefail
cd "$(dirname "$0")/.."
time=${1:-60}
shift || true

cmake --preset dev > /dev/null
cmake --build --preset dev --target fuzzers
mapfile -t targets < build/dev/fuzzers.txt
[ $# -eq 0 ] || targets=("$@")

python3 -B tests/foreign/foreign_test.py --seeds build/dev/foreign

# Two at a time where there are two cores; each says how it went when it has ended.
fuzz_one() {
    local time=$1 target=$2 binary found=build/dev/corpus/$2 log=build/dev/$2.log seeds=()
    binary=$(find build/dev -type f -name "$target" -perm -u+x | head -n 1)
    mkdir -p "$found"
    [ -f "tests/corpus/$target.tar.gz" ] && tar -xzf "tests/corpus/$target.tar.gz" -C "$found"
    [ -d "tests/corpus/$target" ] && seeds=("tests/corpus/$target")
    [ -d "build/dev/foreign/$target" ] && seeds+=("build/dev/foreign/$target")
    if ! "$binary" -max_total_time="$time" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
        -artifact_prefix="build/dev/$target-" "$found" "${seeds[@]}" > "$log" 2>&1; then
        printf '%-28s FAILED\n' "$target"
        grep -E 'ERROR|SUMMARY|runtime error|^ +#[0-9]+ .*theatron|Test unit' "$log" | head -n 12 > "$log.failed"
        tail -n 3 "$log" >> "$log.failed"
        return 1
    fi
    printf '%-28s ok, %s runs\n' "$target" \
        "$(grep -oE 'stat::number_of_executed_units: [0-9]+' "$log" | grep -oE '[0-9]+$')"
}
export -f fuzz_one
rm -f build/dev/*.log.failed
code=0
printf '%s\n' "${targets[@]}" | xargs -I{} -P "$(nproc)" bash -c 'fuzz_one "$@"' fuzz "$time" {} || code=$?
# Last, so that the end of a long output tells the reason.
for failed in build/dev/*.log.failed; do
    [ -e "$failed" ] || continue
    printf '== %s\n' "$(basename "$failed" .log.failed)"
    cat "$failed"
done
exit "$code"
