#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Repeats the README's two commands on a Debian 12 that has nothing but git and make. The root is made in
# FOLDER, which is removed afterwards; `make test` runs without any network but loopback. Everything is mounted
# in namespaces of its own, so that nothing stays mounted or running, however it ends.
# Usage, as root: fresh_root.sh [FOLDER=/var/tmp/theatron_root [COMMAND...]]
#   COMMAND: make targets instead of `make demo SECONDS=20` and `make test`
#   KEEP=1: FOLDER is kept, and used again as it is      CCACHE=DIR: use what was compiled before
set -euo pipefail

if [ "${1:-}" != --inside ]; then
    cd "$(dirname "$0")/.."
    [ "$(id -u)" -eq 0 ] || { echo "fresh_root: making a root needs root" >&2; exit 1; }
    tools/setup.sh packages_fresh_root.txt
    folder=${1:-/var/tmp/theatron_root}
    shift || true
    if [ -e "$folder" ] && [ -z "${KEEP:-}" ]; then
        echo "fresh_root: $folder is there already; remove it, or set KEEP=1 to go on with it" >&2
        exit 1
    fi
    [ -z "$(git status --porcelain --untracked-files=no)" ] ||
        echo "fresh_root: only what is committed is tested"
    code=0
    unshare --mount --propagation private --pid --fork --kill-child \
        "$0" --inside "$folder" "$PWD" "$@" || code=$?
    [ -n "${KEEP:-}" ] || rm -rf --one-file-system "$folder"
    exit "$code"
fi

folder=$2 source=$3
shift 3
say() { printf '\nfresh_root: %s (%s)\n' "$1" "$(date +%H:%M:%S)"; }

if [ ! -e "$folder/etc/debian_version" ]; then
    say "Debian 12 with git and make in $folder"
    # Packages that were fetched before are not fetched again.
    debootstrap --variant=minbase --include=git,make,ca-certificates \
        --cache-dir=/var/cache/apt/archives bookworm "$folder" http://deb.debian.org/debian
    # Debian's own sources as on this machine, and no others.
    rm -f "$folder/etc/apt/sources.list"
    grep -rlE '^(URIs:|deb) .*/debian(-security)?\b' /etc/apt/sources.list /etc/apt/sources.list.d 2> /dev/null |
        xargs -I{} cp {} "$folder/etc/apt/sources.list.d/" || true
fi
cp /etc/resolv.conf "$folder/etc/resolv.conf"

# As after Debian's installer, which debootstrap is not.
[ -e "$folder/etc/hosts" ] || printf '127.0.0.1 localhost\n::1 localhost\n' > "$folder/etc/hosts"
# In a root that is no mount of its own, nothing can be mounted privately, as for network namespaces.
mount --bind "$folder" "$folder"
mount -t proc proc "$folder/proc"
mount --rbind /sys "$folder/sys"
mount --rbind /dev "$folder/dev"
mount -t tmpfs tmpfs "$folder/run"
mount --bind /var/cache/apt/archives "$folder/var/cache/apt/archives"
environment=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8)
for name in http_proxy https_proxy no_proxy; do
    [ -z "${!name:-}" ] || environment+=("$name=${!name}")
done
if [ -n "${CCACHE:-}" ]; then
    mkdir -p "$folder/ccache"
    mount --bind "$CCACHE" "$folder/ccache"
    environment+=(CCACHE_DIR=/ccache CCACHE_BASEDIR=/ CCACHE_NOHASHDIR=1)
fi
rm -rf "$folder/theatron"
git clone --quiet "$source" "$folder/theatron"

inside() { chroot "$folder" /usr/bin/env -i "${environment[@]}" bash -c "cd /theatron && $1"; }
if [ $# -eq 0 ]; then
    say "make demo SECONDS=20"
    inside "make demo SECONDS=20"
    say "make test, with loopback only"
    unshare --net bash -c "$(declare -f inside); $(declare -p environment folder)
        inside 'ip link set lo up && make test'"
fi
for target in "$@"; do
    say "make $target"
    inside "make $target"
done
say "all of it worked"
