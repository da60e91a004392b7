#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over the sources that differ from a commit, or over all of them. Fails on any finding.
# Usage: tidy.sh COMMIT|--all
set -euo pipefail
cd "$(dirname "$0")/.."
since=${1:?a commit or --all}

# The compile commands, and what is generated.
cmake --preset dev > /dev/null
cmake --build --preset dev --target generated

sources() { git ls-files -- 'src/*.cpp' 'apps/*.cpp' | grep -v '_web\.cpp$'; }
if [ "$since" = --all ]; then
    mapfile -t files < <(sources)
elif git rev-parse --quiet --verify "$since^{commit}" > /dev/null; then
    # A header is checked where the source of the same name includes it.
    mapfile -t files < <(comm -12 <(sources | sort) \
        <(git diff --name-only "$since" -- 'src/*' 'apps/*' | sed 's/\.h$/.cpp/' | sort -u))
else
    echo "tidy: there is no commit $since here to compare with, so nothing is checked."
    exit 0
fi
[ ${#files[@]} -gt 0 ] || { echo "tidy: no source has changed."; exit 0; }
echo "tidy: ${#files[@]} file(s)"
printf '%s\0' "${files[@]}" |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet --warnings-as-errors='*' \
        --header-filter="^$PWD/(src|apps)/" -p build/dev 2> /dev/null
