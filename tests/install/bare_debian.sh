#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bare_debian.sh PACKAGES ROOT: installs the .deb files of the folder PACKAGES on a bare Debian 12, uses them.
#
# ROOT is a folder that debootstrap fills, or has filled. Takes root, debootstrap and the network: not one of
# ctest's tests. Make the packages first:
#   cmake --preset release -DCMAKE_INSTALL_PREFIX=/usr && cmake --build --preset release
#   (cd build/release && cpack -G DEB)
set -euo pipefail
packages=$1 root=$2
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)

[[ -x $root/bin/sh ]] || debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian
rm -rf "$root/packages" "$root/work"
mkdir -p "$root/packages" "$root/work"
cp "$packages"/*.deb "$root/packages"
cp -r "$here/hosts" "$root/work/"

cat >"$root/work/use.sh" <<'INSIDE'
set -eu
mount -t proc proc /proc 2>/dev/null || true
export DEBIAN_FRONTEND=noninteractive HOME=/work/home LC_ALL=C.UTF-8
mkdir -p "$HOME"
apt-get -qq update
# The program and CAD alone first: what they need must be what their packages name.
apt-get -qq -y --no-install-recommends install /packages/lacuna_*.deb /packages/lacuna-cad_*.deb >/dev/null
cd /work
lacuna --version
cat >box.geo <<'GEO'
SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 3, 2, 1};
GEO
lacuna info box.geo
cat >box.lua <<'RECIPE'
local lacuna = require "lacuna"
local void = lacuna.load("box.geo"):open_volume {
  source = { facing = { 0, 0, -1 } }, target = { facing = { 0, 0, 1 } }, walls = { facing = { 1, 0, 0 } } }
print(void.class)
local mesh = void:sweep { layers = 4, size = 0.25 }
mesh:write "box.msh"
void:write_cad "box.step"
RECIPE
lacuna box.lua
lacuna check box.msh
lacuna info box.step >/dev/null
lacuna convert box.msh box.vtu
lacuna view box.msh
[ -z "$(ls -A "$HOME")" ] || { echo "something was written to the home folder"; exit 1; }

# The module and the library, and what a host is compiled with; not FreeCAD, which is large.
apt-get -qq -y --no-install-recommends install $(ls /packages/*.deb | grep -v freecad-lacuna) \
    lua5.4 gcc libc6-dev pkg-config python3 >/dev/null
lua5.4 -e 'print(require("lacuna").synthetic.prism { sides = 4 }:describe())'
gcc hosts/host.c -o host_c $(pkg-config --cflags --libs lacuna)
./host_c
python3 -c 'import lacuna; print(lacuna.synthetic.prism(sides=4).open_volume().sweep(layers=2, size=0.5))'
apt-get -qq -y remove lacuna >/dev/null
echo "all of it works"
INSIDE
unshare --mount --pid --fork chroot "$root" /bin/sh /work/use.sh
