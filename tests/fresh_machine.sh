#!/usr/bin/env bash
# Tries ./run demo and ./run test on a bare Debian 12, as a newcomer's machine may be: no compiler, no
# Python, no git, no sudo, no terminal. Needs root, debootstrap, git and some 3 GB; takes long; not part of CI.
#
#   tests/fresh_machine.sh [--keep] [RUN_COMMAND]…     default: demo test
#
# Takes the last commit of this checkout. The bare system's packages come from where this machine's come.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

keep=
if [ "${1:-}" = --keep ]; then keep=yes; shift; fi
commands=("$@")
[ $# -gt 0 ] || commands=(demo test)
[ "$(id -u)" -eq 0 ] || { echo "fresh_machine: run this as root" >&2; exit 1; }
for tool in debootstrap git; do
  command -v $tool >/dev/null || { echo "fresh_machine: install $tool first" >&2; exit 1; }
done

# Where this machine's own packages come from, if it is a Debian 12; else say where in MIRROR.
mirror=${MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
  'Origin: Debian' 'Codename: bookworm' | sed -n 1p)}
[ -n "$mirror" ] || { echo "fresh_machine: set MIRROR to an address of Debian's archive" >&2; exit 1; }

root=$(mktemp -d)
chmod 755 "$root"
clean_up() {
  ! mountpoint -q "$root/proc" || umount "$root/proc" || { echo "left mounted: $root/proc" >&2; return; }
  if [ -n "$keep" ]; then echo "kept: $root"; else rm -rf --one-file-system "$root"; fi
}
trap clean_up EXIT
trap 'exit 130' INT TERM

echo "== a bare Debian 12 in $root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
  { tail -5 "$root.log" >&2; exit 1; }
rm -f "$root.log"
cp /etc/hosts /etc/resolv.conf "$root/etc/"
apt-config dump | grep -E "^Acquire::.*Proxy \"." >"$root/etc/apt/apt.conf.d/proxy" || true
mount --bind /proc "$root/proc"
git clone --quiet --no-hardlinks . "$root/root/first_contact"

results=()
code=0
for command in "${commands[@]}"; do
  echo "== ./run $command"
  start=$SECONDS
  chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    sh -c "cd / && root/first_contact/run $command" </dev/null && status=0 || status=$?
  [ $status -eq 0 ] || code=$status
  results+=("./run $command: exit code $status after $((SECONDS - start)) s")
done
echo "== on the bare machine"
printf '%s\n' "${results[@]}"
exit $code
