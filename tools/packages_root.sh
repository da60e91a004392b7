#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages of `make package` into a Debian 12 that has nothing else, hosts a session there without any
# network but loopback, fetches its page, joins, and purges them again. The root is made in FOLDER, in namespaces of its own,
# and removed afterwards.
# Usage, as root: packages_root.sh [FOLDER=/var/tmp/theatron_packages]     Exit code 77: no root can be made here
set -euo pipefail

if [ "${1:-}" != --inside ]; then
    cd "$(dirname "$0")/.."
    [ "$(id -u)" -eq 0 ] || { echo "packages_root: left out, making a root needs root"; exit 77; }
    unshare --mount --pid --fork true 2> /dev/null || { echo "packages_root: left out, no namespaces can be made here"; exit 77; }
    ls build/packages/theatron_*.deb > /dev/null || { echo "packages_root: build the packages first: make package" >&2; exit 1; }
    tools/setup.sh packages_fresh_root.txt
    folder=${1:-/var/tmp/theatron_packages}
    [ ! -e "$folder" ] || { echo "packages_root: $folder is there already; remove it" >&2; exit 1; }
    code=0
    unshare --mount --propagation private --pid --fork --kill-child "$0" --inside "$folder" "$PWD" || code=$?
    rm -rf --one-file-system "$folder"
    exit "$code"
fi

folder=$2 source=$3
say() { printf '\npackages_root: %s (%s)\n' "$1" "$(date +%H:%M:%S)"; }
fail() { echo "packages_root: $1" >&2; exit 1; }

say "Debian 12 in $folder"
debootstrap --variant=minbase --include=ca-certificates --cache-dir=/var/cache/apt/archives bookworm "$folder" \
    http://deb.debian.org/debian > "$source/build/packages_root.log"
rm -f "$folder/etc/apt/sources.list"
grep -rlE '^(URIs:|deb) .*/debian(-security)?\b' /etc/apt/sources.list /etc/apt/sources.list.d 2> /dev/null |
    xargs -I{} cp {} "$folder/etc/apt/sources.list.d/" || true
cp /etc/resolv.conf "$folder/etc/resolv.conf"
printf '127.0.0.1 localhost\n::1 localhost\n' > "$folder/etc/hosts"
mount --bind "$folder" "$folder"
mount -t proc proc "$folder/proc"
mount --rbind /sys "$folder/sys"
mount --rbind /dev "$folder/dev"
mount -t tmpfs tmpfs "$folder/run"
mount --bind /var/cache/apt/archives "$folder/var/cache/apt/archives"
# No service starts while packages are installed into a root.
printf '#!/bin/sh\nexit 101\n' > "$folder/usr/sbin/policy-rc.d"
chmod +x "$folder/usr/sbin/policy-rc.d"
environment=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive)
for name in http_proxy https_proxy no_proxy; do
    [ -z "${!name:-}" ] || environment+=("$name=${!name}")
done
inside() { chroot "$folder" /usr/bin/env -i "${environment[@]}" bash -c "$1"; }

say "apt install"
mkdir "$folder/packages"
cp "$source"/build/packages/*.deb "$folder/packages/"
inside "apt-get update -q && apt-get install -y -q --no-install-recommends /packages/*.deb" >> "$source/build/packages_root.log"
inside "id theatron" > /dev/null || fail "the package made no user"
[ "$(inside 'stat -c %a:%U:%G /etc/theatron')" = 750:root:theatron ] || fail "/etc/theatron has other rights"

# In the order of docs/service.md: the example is checked as the host's user and with a mistake, a host runs with it as
# that user, the page comes, somebody joins without FFmpeg, and another user is kept out.
host() {
    local pid page code=0
    ip link set lo up
    inside "set -e
        install -m 0640 -g theatron /usr/share/doc/theatron-server/examples/operating-room.conf /etc/theatron/or.conf
        sed -i 's/^listen = .*/listen = 127.0.0.1:4400/; s/^#json = no/json = yes/; s/^#camera = k4a:0/camera = synthetic:room,seconds=2,quality=quick,color=depth/' \
            /etc/theatron/or.conf
        runuser -u theatron -- theatron host --config /etc/theatron/or.conf --check-config
        install -d -o theatron -g theatron -m 0700 /var/lib/theatron/or" || fail "the example cannot be used"
    inside "sed 's/^session = .*/sesion = OR 3/' /etc/theatron/or.conf > /tmp/wrong.conf
        theatron host --config /tmp/wrong.conf --check-config 2> /tmp/mistakes" && fail "a mistake is not told"
    grep -q ': sesion: there is no such option' "$folder/tmp/mistakes" || fail "a mistake is told otherwise"
    # The process itself, which a signal reaches.
    chroot "$folder" /usr/bin/env -i "${environment[@]}" HOME=/var/lib/theatron/or \
        setpriv --reuid theatron --regid theatron --init-groups \
        theatron host --state /var/lib/theatron/or --config /etc/theatron/or.conf > "$folder/greeting" &
    pid=$!
    while [ ! -s "$folder/greeting" ] && kill -0 "$pid" 2> /dev/null; do
        sleep 0.1
    done
    grep -q '"link"' "$folder/greeting" || fail "the host did not start"
    [ "$(curl -sk -o /dev/null -w '%{http_code}' https://127.0.0.1:4400/health)" = 200 ] || fail "/health is not 200"
    page=$folder/tmp/page.html
    curl -sk -o "$page" https://127.0.0.1:4400/ || fail "the page is not served"
    grep -qi '<!doctype html' "$page" || fail "the page is no page"
    ! ls "$folder"/usr/lib/*/libavcodec.so* > /dev/null 2>&1 || fail "FFmpeg is there, so nothing shows that it may be absent"
    inside "set -e
        runuser -u theatron -- theatron link --show expert --state /var/lib/theatron/or > /tmp/link
        theatron join @/tmp/link --seconds 3 --json" > "$folder/joined" || fail "nobody can join"
    grep -qE '"frames": ?[1-9]' "$folder/joined" || fail "a participant got no picture"
    inside "setpriv --reuid nobody --regid nogroup --clear-groups ls /var/lib/theatron" > /dev/null 2>&1 &&
        fail "another user can read the state"
    kill "$pid"
    wait "$pid" || code=$?
    [ "$code" -eq 0 ] || fail "the host did not end well ($code)"
}
say "a host with its page, with loopback only"
unshare --net bash -c "set -euo pipefail; $(declare -f inside host fail); $(declare -p environment folder); host"

say "debian/tests/session, with loopback only: a session, its recording, Python"
cp "$source/debian/tests/session" "$folder/tmp/session"
unshare --net bash -c "set -euo pipefail; $(declare -f inside); $(declare -p environment folder); ip link set lo up; inside /tmp/session" ||
    fail "debian/tests/session fails"

# The same program under another number. Neither another version nor removal changes what hosts and the administrator wrote.
say "an older version, this one again, remove"
mkdir "$folder/older"
for package in theatron theatron-server; do
    dpkg-deb --raw-extract "$source"/build/packages/"${package}"_[0-9]*.deb "$folder/older/$package"
    sed -i 's/^Version: .*/Version: 0.0.1/; s/theatron (>= [^)]*)/theatron (>= 0.0.1)/' "$folder/older/$package/DEBIAN/control"
    dpkg-deb --build -Znone "$folder/older/$package" "$folder/older/" > /dev/null
done
written() { (cd "$folder" && find etc/theatron var/lib/theatron -type f -exec sha256sum {} + | sort -k 2); }
before=$(written)
for change in "install --allow-downgrades /older/*.deb" "install /packages/*.deb" "remove theatron theatron-server"; do
    inside "apt-get -y -q $change" >> "$source/build/packages_root.log"
    [ "$(written)" = "$before" ] || fail "apt-get $change changed what a host or the administrator had written"
done

# As `systemctl enable theatron-host@or` does, which is not possible without systemd.
enabled=$folder/etc/systemd/system/multi-user.target.wants/theatron-host@or.service
mkdir -p "${enabled%/*}"
ln -s /lib/systemd/system/theatron-host@.service "$enabled"

say "purge"
inside "apt-get purge -y -q theatron theatron-server theatron-doc python3-theatron" >> "$source/build/packages_root.log"
left=$(cd "$folder" && find etc usr var/lib/theatron var/cache/theatron -iname '*theatron*' -not -path 'etc/theatron*' \
    -not -path 'var/lib/dpkg/*' 2> /dev/null || true)
[ -z "$left" ] || fail "purged, and this is left: $left"
[ -e "$folder/etc/theatron/or.conf" ] || fail "the administrator's configuration is gone"
say "all of it worked"
