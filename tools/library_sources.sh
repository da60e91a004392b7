#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches Debian's sources of the libraries that the browser client compiles itself, into libraries/, in the version that is
# installed for the native program. They come from the machine's own Debian sources, with apt's check of their signatures;
# its configuration and its lists stay as they are, and no root is needed. Without them (no network, no apt) the page is built
# without zstd, lz4 and libopus. docs/decisions/library-sources.md gives the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=libraries
packages=(opus lz4 libzstd)
heads=("$folder/opus/include/opus.h" "$folder/lz4/lib/lz4.h" "$folder/libzstd/lib/zstd.h")

give_up() {
    echo "setup: $1, so the browser client is built without zstd, lz4 and its own Opus" >&2
    exit 0
}
is_complete() {
    local head
    for head in "${heads[@]}"; do
        [ -e "$head" ] || return 1
    done
}

command -v apt-get > /dev/null && command -v dpkg-source > /dev/null ||
    { is_complete && exit 0; give_up "this is no Debian system"; }
versions=$(dpkg-query -W -f='${source:Package} ${source:Version}\n' libopus-dev liblz4-dev libzstd-dev 2> /dev/null | sort || true)
is_complete && [ "$versions" = "$(cat $folder/versions.txt 2> /dev/null)" ] && exit 0
# Others than those that are installed are better than none.
is_complete && give_up() { echo "setup: $1, so the browser client keeps the sources in $folder/" >&2; exit 0; }

mkdir -p "$folder"
work=$(mktemp -d "$PWD/$folder/fetched.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/parts" "$work/lists/partial" "$work/cache/archives/partial" "$work/unpacked"
# Debian's own entries, those for sources instead of programs.
for file in /etc/apt/sources.list.d/*.sources; do
    [ -e "$file" ] || continue
    awk 'BEGIN { RS = ""; ORS = "\n\n" } /(^|\n)URIs:[^\n]*\/debian(-security)?\/?([ \n]|$)/' "$file" |
        sed 's/^Types:.*/Types: deb-src/' > "$work/parts/$(basename "$file")"
done
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -e "$file" ] || continue
    { grep -E '^deb .*/debian(-security)?/? ' "$file" || true; } |
        sed 's/^deb /deb-src /' > "$work/parts/$(basename "$file" .list).list"
done
grep -q deb-src "$work"/parts/* 2> /dev/null || give_up "apt has no sources of Debian"

options=(-q -o APT::Sandbox::User="$(id -un)" -o APT::Update::Error-Mode=any
    -o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20
    -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/parts"
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache")
apt() { apt-get "${options[@]}" "$@"; }
cache() { apt-cache "${options[@]}" "$@"; }
echo "setup: fetching the sources of ${packages[*]} for the browser client"
apt update > "$work/log" 2>&1 || give_up "Debian's lists of sources cannot be fetched"
cd "$work/unpacked"
# versions_of SOURCE: the installed version first, then what Debian's lists have, newest first.
versions_of() {
    awk -v name="$1" '$1 == name { print $2 }' <<< "$versions"
    cache showsrc "$1" 2>> "$work/log" | awk -v name="$1" '$1 == "Package:" { is_it = $2 == name } is_it && $1 == "Version:" { print $2 }' | sort -rV
}
# A mirror that is ahead of this machine, or behind its own lists, still has another version.
for package in "${packages[@]}"; do
    for version in $(versions_of "$package"); do
        apt source "$package=$version" >> "$work/log" 2>&1 && continue 2
    done
    give_up "the sources of $package cannot be fetched"
done
cd ../../..
for package in "${packages[@]}"; do
    rm -rf "${folder:?}/$package"
    mv "$work/unpacked/$package"-*/ "$folder/$package"
done
is_complete || give_up "the sources of ${packages[*]} have another form than expected"
echo "$versions" > "$folder/versions.txt"
