#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times the depth codecs natively and as WebAssembly under node, on folders with
# depth/*.png:  tools/bench_web.sh FOLDER...  (--no-liftoff: the time once all is compiled)
set -euo pipefail
[ $# -gt 0 ] || { echo "usage: tools/bench_web.sh FOLDER..." >&2; exit 1; }
folders=()
for folder in "$@"; do folders+=("$(realpath "$folder")"); done
cd "$(dirname "$0")/.."

for preset in release web; do
    cmake --preset $preset > /dev/null
    cmake --build --preset $preset --target depth_decoders > /dev/null
done
frames=$(mktemp)
trap 'rm -f "$frames"' EXIT

for folder in "${folders[@]}"; do
    build/release/bench/depth_decoders pack "$folder" "$frames"
    echo "$(basename "$folder"), ms a frame"
    printf '  %-14s %10s %10s %12s %12s\n' codec "encode" "decode" "encode, web" "decode, web"
    join <(build/release/bench/depth_decoders time "$frames" | sort) \
         <(node --no-liftoff build/web/bench/depth_decoders.js time "$frames" | sort) |
        while read -r name encode decode web_encode web_decode; do
            printf '  %-14s %10s %10s %12s %12s\n' \
                "$name" "$encode" "$decode" "$web_encode" "$web_decode"
        done
done
