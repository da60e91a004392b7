#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the demo alone and opens it at once; the other commands and the browser client are built meanwhile.
# Usage: demo.sh [OPTION of theatron demo...]
set -euo pipefail
cd "$(dirname "$0")/.."
demo=build/release/apps/theatron/theatron_demo
log=build/rest.log
rest="the other commands"
builder=

end_builder() {
    [ -n "$builder" ] || return 0
    if kill -0 "$builder" 2> /dev/null; then
        kill -- -"$builder" 2> /dev/null || true
        echo "demo: $rest are not complete yet; make build completes them"
    elif ! wait "$builder"; then
        echo "demo: $rest could not be built; $log says why"
    fi
}
trap end_builder EXIT

[ -e "$demo" ] || echo "demo: the demo is compiled first, which takes some minutes; the counter tells how far it is"
tools/build.sh release theatron_demo

build="tools/build.sh release theatron"
if command -v em++ > /dev/null; then
    build="$build; commands=\$?; tools/build.sh web page && exit \$commands"
    rest="the other commands and the browser client"
else
    echo "demo: em++ is missing, so the demo has no browser client"
fi
[ -e build/release/apps/theatron/theatron ] && [ -e build/release/apps/theatron/web/index.html ] ||
    echo "demo: $rest are built while you look, which takes some minutes more"
# A process group of its own: Ctrl-C ends the demo, and the demo's end the building. The kernel shares the processor out among
# sessions first, so its priority within its own one says nothing to the demo.
setsid nice -n 15 bash -c "{ echo 15 > /proc/self/autogroup; } 2> /dev/null; $build" > "$log" 2>&1 &
builder=$!
"$demo" demo "$@"
