#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every check that must hold, the quick ones first, then a table of what each step took.
# Used by `make test` and by CI. With --all also what takes long (`make test-all`).
set -euo pipefail
cd "$(dirname "$0")/.."
all=${1:-}

table=$(mktemp)
finish() {
    local code=$?
    printf '\n%-46s %8s %8s\n' "step" "seconds" "CPU s"
    awk -F'\t' '{ printf "%-46s %8.0f %8.0f\n", $1, $2, $3 + $4; wall += $2; cpu += $3 + $4 }
        END { printf "%-46s %8.0f %8.0f\n", "together", wall, cpu }' "$table"
    rm -f "$table" "$table.step"
    [ "$code" -eq 0 ] && echo "Every check of this run holds." || echo "Failed in the last step above."
}
trap finish EXIT

# step NAME COMMAND...: runs it and keeps what it took.
step() {
    local name=$1 code=0 TIMEFORMAT=$'%R\t%U\t%S'
    shift
    printf '\n== %s (%s)\n' "$name" "$(date +%H:%M:%S)"
    { time "$@" 2>&3 || code=$?; } 3>&2 2> "$table.step"
    printf '%s\t%s\n' "$name" "$(tail -n 1 "$table.step")" >> "$table"
    return "$code"
}

# Compiles three modules anew for it.
world_with_sanitizers() {
    cmake --build --preset dev --target world_test && env SEEDS=20 MINUTES=20 build/dev/tests/world/world_test
}

# Where no root or container can be made, the tool says so and ends with 77.
may_be_left_out() {
    local code=0
    "$@" || code=$?
    [ "$code" -eq 77 ] || return "$code"
}

tools/scipy.sh
step "Format and licence lines" tools/check_sources.py
step "Directions of dependencies" tools/check_includes.py
step "Build: release" tools/build.sh release
step "Build: assertions, ASan, UBSan, fuzz targets" tools/build.sh dev unit_tests fuzzers
step "Build: web modules with em++" tools/build.sh web
# Long scenarios: the release build runs them, and here their parts are in other tests. The modules registration, cases
# and voice leave out others, by a filter in their CMakeLists.txt, which this one does not replace.
long='RecordedBackground.*:WatchedCamera.AnHour*'
[ "$all" = --all ] && long=
step "Unit tests with assertions, ASan and UBSan" env GTEST_FILTER="-$long" ctest --preset dev
if [ "$all" = --all ]; then
    step "clang-tidy on everything" tools/tidy.sh --all
    step "Threaded modules under TSan" tools/test_tsan.sh
    step "Every fuzz target for a minute" tools/fuzz.sh 60
else
    step "Some threaded modules under TSan" tools/test_tsan.sh base net record send
    step "Every fuzz target for two seconds" tools/fuzz.sh 2
fi
if [ "$all" = --all ]; then
    step "Cameras that come and go for ten minutes" tools/test_many.sh release 600
    step "The same for a minute under TSan" tools/test_many.sh tsan 60
    step "A thousand crowds in the World" env SEEDS=1000 MINUTES=20 \
        build/release/tests/world/world_test --gtest_filter='WorldSeeds.*'
    step "The World with assertions, ASan and UBSan" world_with_sanitizers
    step "An hour before fixed cameras without an alarm" env MINUTES=60 \
        build/release/src/registration/registration_test --gtest_filter='Watching.NoAlarm*'
    step "Rates, ages and shaped links" ctest --preset timing
    step "Debian packages, twice" tools/package.sh --twice
    step "Packages in a Debian that has nothing else" may_be_left_out tools/packages_root.sh
    step "A container of the packages" may_be_left_out tools/container.sh
    step "Frame rate beside strangers and expensive guests" env PYTHONPATH=tests/end_to_end \
        python3 tests/end_to_end/guests_run.py
    step "Recorders over a link that breaks for 20 minutes" env PYTHONPATH=tests/end_to_end \
        python3 tests/end_to_end/breaks_run.py --minutes 20
    step "Two sessions beside 200 hostile connections" env PYTHONPATH=tests/end_to_end \
        python3 tests/end_to_end/hostile_links_run.py --minutes 10
    step "Cameras registered, four seeds" build/release/apps/theatron/theatron_bench registration \
        --seeds 4 --json build/registration.json
    step "Accuracy of registration as promised" tools/check_registration.py build/registration.json
fi
# ctest keeps what the tests of its last run printed, so that of both runs is kept apart.
logs=build/test_logs
mkdir -p "$logs"
keep_log() { cp build/release/Testing/Temporary/LastTest.log "$logs/$1.log"; }
without_processes() {
    local code=0
    ctest --preset release || code=$?
    keep_log release
    return "$code"
}
with_processes() {
    local code=0
    ctest --preset process || code=$?
    keep_log process
    tools/repeated_tests.py "$logs/process.log" --keep build/repeated_tests.txt --most 2 || code=1
    return "$code"
}
step "Tests in one process" without_processes
# Last, so that its closing lines are those of the whole.
step "Tests that run processes" with_processes
tools/skipped_tests.py "$logs"/*.log build/dev build/tsan
