#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages of `make package` into a Debian 12 that has nothing else, hosts a session there without any
# network but loopback, fetches its page, joins, kills a host that systemd runs, and purges them again. The root is made in
# FOLDER, in namespaces of its own, and removed afterwards.
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
    unshare --mount --propagation private --pid --fork --kill-child --mount-proc "$0" --inside "$folder" "$PWD" || code=$?
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
[ -z "$(find "$folder/etc/systemd" -name 'theatron*')" ] || fail "installed, and a unit starts by itself"
for page in SECURITY.md LICENSE docs/service.md examples/proxy/nginx.conf; do
    [ -e "$folder/usr/share/doc/theatron/$page" ] || fail "theatron-doc lacks $page"
done

health() { [ "$("$@" curl -sk -o /dev/null -w '%{http_code}' https://127.0.0.1:4400/health)" = 200 ]; }

# start_host STATE: in the background, as the host's user; `pid` is the process itself, which a signal reaches.
start_host() {
    rm -f "$folder/greeting"
    chroot "$folder" /usr/bin/env -i "${environment[@]}" HOME=/var/lib/theatron/or \
        setpriv --reuid theatron --regid theatron --init-groups \
        theatron host --state "$1" --config /etc/theatron/or.conf > "$folder/greeting" &
    pid=$!
    while [ ! -s "$folder/greeting" ] && kill -0 "$pid" 2> /dev/null; do
        sleep 0.1
    done
    grep -q '"link"' "$folder/greeting" || fail "the host did not start with $1"
    health || fail "/health is not 200 with $1"
}

end_host() {
    local code=0
    kill "$pid"
    wait "$pid" || code=$?
    [ "$code" -eq 0 ] || fail "the host did not end well ($code)"
}

# In the order of docs/service.md: the example is checked as the host's user and with a mistake, a host runs with it as
# that user, the page comes, somebody joins without FFmpeg, another user is kept out, and a full /var keeps no host from
# starting again.
host() {
    local pid page
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
    start_host /var/lib/theatron/or
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
    end_host

    mount -t tmpfs -o size=4m tmpfs "$folder/mnt"
    inside "install -d -o theatron -g theatron -m 0700 /mnt/or"
    cp -a "$folder"/var/lib/theatron/or/* "$folder/mnt/or"
    dd if=/dev/zero of="$folder/mnt/full" 2> /dev/null && fail "the disk is not full"
    start_host /mnt/or
    end_host
    umount "$folder/mnt"
}
say "a host with its page, with loopback only"
unshare --net bash -c "set -euo pipefail; $(declare -f inside host start_host end_host health fail); $(declare -p environment folder); host"

say "debian/tests/session, with loopback only: a session, its recording, Python"
cp "$source/debian/tests/session" "$folder/tmp/session"
unshare --net bash -c "set -euo pipefail; $(declare -f inside); $(declare -p environment folder); ip link set lo up; inside /tmp/session" ||
    fail "debian/tests/session fails"

# boot ROOT: systemd as the first process of namespaces of its own, with ROOT as its root, since no process below a chroot
# may make the user namespace that the unit asks for.
boot() {
    mount --bind "$1" "$1"
    mount -t proc proc "$1/proc"
    mount -t sysfs sysfs "$1/sys"
    mount -t cgroup2 cgroup2 "$1/sys/fs/cgroup"
    mount -t tmpfs tmpfs "$1/run"
    ip link set lo up
    mkdir "$1/old"
    cd "$1"
    pivot_root . old
    exec env -i container=theatron PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        sh -c 'umount -l /old && rmdir /old && exec /lib/systemd/systemd --unit=basic.target --log-target=journal'
}

# The unit as systemd runs it: killed, the host is back with its session in 3 s.
unit() {
    local outer init='' before killed ms
    unshare --mount --pid --fork --kill-child --net --uts --ipc --cgroup \
        bash -c "set -e; $(declare -f boot); boot '$folder'" > "$source/build/packages_unit.log" 2>&1 &
    outer=$!
    until init=$(pgrep -P "$outer" -x systemd); do
        kill -0 "$outer" 2> /dev/null || fail "systemd did not start: $(cat "$source/build/packages_unit.log")"
        sleep 0.1
    done
    there() { nsenter --target "$init" --all --root --wd /usr/bin/env -i "${environment[@]}" bash -c "$1"; }
    main_pid() { there 'systemctl show --property MainPID --value theatron-host@or'; }
    until there '[ -S /run/systemd/private ]' 2> /dev/null; do
        sleep 0.1
    done
    there 'systemctl is-system-running --wait' > /dev/null || true
    there 'systemctl start theatron-host@or' || fail "the unit does not start: $(there 'journalctl -u theatron-host@or')"
    before=$(main_pid)
    killed=$(date +%s%N)
    there 'systemctl kill --signal=KILL theatron-host@or'
    until [ "$(main_pid)" != "$before" ] && health nsenter --target "$init" --net; do
        [ $(($(date +%s%N) - killed)) -lt 60000000000 ] || fail "a killed host does not come back"
        sleep 0.02
    done
    ms=$((($(date +%s%N) - killed) / 1000000))
    echo "packages_root: a killed host is back after $ms ms"
    [ "$ms" -le 3000 ] || fail "a killed host is back after $ms ms, which is more than 3 s"
    there 'runuser -u theatron -- theatron session list --state /var/lib/theatron/or' | grep -q ': open' ||
        fail "the session is not open again"
    there 'systemctl stop theatron-host@or' || fail "the unit does not stop"
    kill -KILL "$outer"
    wait "$outer" 2> /dev/null || true
}
say "the unit under systemd"
if unshare --mount --pid --fork --kill-child --net --uts --ipc --cgroup sh -c 'mount -t cgroup2 cgroup2 /sys/fs/cgroup' 2> /dev/null; then
    unit
else
    echo "packages_root: left out, no cgroups can be mounted here"
fi

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

say "purge beside a host that was started by hand"
cp "$folder/bin/sleep" "$folder/tmp/theatron"
chroot "$folder" setpriv --reuid theatron --regid theatron --clear-groups /tmp/theatron 600 &
pid=$!
inside "apt-get purge -y -q theatron-server" >> "$source/build/packages_root.log" 2>&1 && fail "it is purged while a host runs"
grep -q "Nothing was deleted" "$source/build/packages_root.log" || fail "nobody says why it cannot be purged"
[ "$(written)" = "$before" ] || fail "a purge that failed deleted something"
kill "$pid"
wait "$pid" 2> /dev/null || true

say "purge"
inside "apt-get purge -y -q theatron theatron-server theatron-doc python3-theatron" >> "$source/build/packages_root.log"
left=$(cd "$folder" && find etc usr var/lib/theatron var/cache/theatron -iname '*theatron*' -not -path 'etc/theatron*' \
    -not -path 'var/lib/dpkg/*' 2> /dev/null || true)
[ -z "$left" ] || fail "purged, and this is left: $left"
[ -e "$folder/etc/theatron/or.conf" ] || fail "the administrator's configuration is gone"
say "all of it worked"
