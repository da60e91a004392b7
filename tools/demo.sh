#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Opens the demo at once, and builds the browser client meanwhile.   demo.sh [OPTION of theatron demo...]
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/apps/theatron/theatron
log=build/page.log
builder=

end_builder() {
    [ -n "$builder" ] || return 0
    if kill -0 "$builder" 2> /dev/null; then
        kill -- -"$builder" 2> /dev/null || true
        echo "demo: the browser client is not complete yet; make build completes it"
    elif ! wait "$builder"; then
        echo "demo: the browser client could not be built; $log says why"
    fi
}
trap end_builder EXIT

[ -e demo/case ] || "$program" case synth demo/case --dicom demo/ct
if ! command -v em++ > /dev/null; then
    echo "demo: em++ is missing, so the demo has no browser client"
elif ! ninja -C build/web -n page 2> /dev/null | grep -q 'no work to do'; then
    echo "demo: the browser client is built while you look; its link opens in a browser in some minutes"
    # A process group of its own: Ctrl-C ends the demo, and the demo's end the building.
    setsid nice -n 15 sh -c 'cmake --preset web && cmake --build --preset web --target page' > "$log" 2>&1 &
    builder=$!
fi
"$program" demo "$@"
