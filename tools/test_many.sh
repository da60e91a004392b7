#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sixteen cameras that come and go in a session of real processes (tests/end_to_end/many_timing.py).
# Usage: test_many.sh PRESET SECONDS, where PRESET is release or tsan.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
cmake --preset "$preset" > /dev/null
cmake --build "build/$preset" --target theatron
export THEATRON=$PWD/build/$preset/apps/theatron/theatron THEATRON_MANY_SECONDS=${2:-600}
export PYTHONPATH=$PWD/tests/end_to_end
fixed=()
if [ "$preset" = tsan ]; then
    export THEATRON_MANY_SLOWER=4
    export TSAN_OPTIONS="suppressions=$PWD/tests/sanitizers/threads.txt:second_deadlock_stack=1:halt_on_error=1"
    # See test_tsan.sh.
    setarch -R true 2> /dev/null && fixed=(setarch -R)
fi
"${fixed[@]}" python3 tests/end_to_end/run.py tests/end_to_end/many_timing.py
