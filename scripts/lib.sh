# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# What scripts/run and scripts/test share: packages, configuring, building. Sourced, not run.
#
# All of it talks on standard error, so that standard output is the recipe's (or the tests') alone, and none
# of it asks anything: where it cannot go on it says what is missing and stops with 1.

set -euo pipefail

lacuna_root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
lacuna_preset=release
lacuna_build=$lacuna_root/build/$lacuna_preset
lacuna_options=()  # of CMake

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }
die() { say "$@"; exit 1; }

# Is this Debian package there? A tool that came another way (a newer CMake in /usr/local, say) counts too.
have_package()
{
    case $1 in
        cmake | g++ | lua5.4) command -v "$1" >/dev/null && return ;;
        ninja-build) command -v ninja >/dev/null && return ;;
    esac
    command -v dpkg-query >/dev/null \
        && [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing_packages()
{
    local package
    for package in "$@"; do
        have_package "$package" || printf '%s\n' "$package"
    done
}

# apt-get as root, with nothing asked: root itself, or a sudo that wants no password.
apt_as_root()
{
    local options=(-qq -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300)
    if [[ $(id -u) == 0 ]]; then
        DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" "$@" </dev/null >&2
    else
        sudo -n env DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" "$@" </dev/null >&2
    fi
}

# Install what is missing of the packages named. Quick when nothing is.
need_packages()
{
    local missing
    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]})) || return 0

    command -v apt-get >/dev/null \
        || die "missing: ${missing[*]}; there is no apt-get here to install them with"
    if [[ $(id -u) != 0 ]] && ! sudo -n true 2>/dev/null; then
        die "missing: ${missing[*]}; installing them takes root, or a sudo that asks for no password"
    fi
    say "installing ${missing[*]}"
    apt_as_root update || say "apt-get update failed; trying with the package lists there are"
    apt_as_root install -y --no-install-recommends "${missing[@]}" || true

    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]} == 0)) || die "could not be installed: ${missing[*]}"
}

# What building needs, and with "tests" what testing needs besides.
need_build_packages()
{
    local packages=(cmake ninja-build g++ libeigen3-dev liblua5.4-dev libedit-dev lua5.4 doctest-dev
        zlib1g-dev libseccomp-dev libfmt-dev)
    # A Gmsh SDK of the person's own comes before the one of the distribution.
    [[ -n ${GMSH_ROOT:-} ]] || packages+=(libgmsh-dev)
    [[ ${1:-} != tests ]] \
        || packages+=(python3-gmsh python3-numpy calculix-ccx libmedc-dev libhdf5-dev libmed-tools)
    need_packages "${packages[@]}"
    [[ ${1:-} != tests ]] || lacuna_options=(-DLACUNA_MED=ON)

    local version
    version=$(cmake --version | sed -n '1s/[^0-9]*//p')
    [[ $(printf '%s\n' 3.25 "$version" | sort -V | head -n 1) == 3.25 ]] \
        || die "CMake 3.25 or newer is needed, this one is $version: $(command -v cmake)"

    local library
    for library in "${GMSH_ROOT:+$GMSH_ROOT/lib}"/libgmsh.so; do
        [[ -e $library ]] || continue
        local unmet
        unmet=$(ldd "$library" 2>/dev/null | sed -n 's/^[[:space:]]*\(.*\) => not found/\1/p' | paste -sd' ')
        [[ -z $unmet ]] || die "$library wants libraries that are not installed: $unmet"
    done
}

# Configure where that was not done yet, or was done for another Gmsh; CMake itself notices the rest.
configure()
{
    local stamp=$lacuna_build/.gmsh_root wanted=${GMSH_ROOT:-}
    if [[ -f $lacuna_build/build.ninja && $lacuna_build/build.ninja -nt $lacuna_root/CMakePresets.json \
        && -f $stamp && $(<"$stamp") == "$wanted" ]] \
        && { ((${#lacuna_options[@]} == 0)) \
            || grep -q '^LACUNA_MED:BOOL=ON' "$lacuna_build/CMakeCache.txt"; }; then
        return 0
    fi
    local fresh=()
    [[ ! -f $stamp || $(<"$stamp") == "$wanted" ]] || fresh=(--fresh)  # forget where the other Gmsh was
    (cd "$lacuna_root" \
        && cmake --preset "$lacuna_preset" -G Ninja "${fresh[@]}" "${lacuna_options[@]}" \
            ${wanted:+-DGMSH_ROOT="$wanted"} >&2) \
        || die "could not be configured; CMake's words are above"
    printf '%s\n' "$wanted" >"$stamp"
}

# build [TARGET...]: with all cores, without a word when there is nothing to do. One build at a time.
build()
{
    mkdir -p "$lacuna_build"
    exec {build_lock}>"$lacuna_build/.lock"
    flock "$build_lock"
    configure
    local state
    state=$(ninja -C "$lacuna_build" -n "$@" 2>&1 || true)
    if [[ $state != *"no work to do"* ]]; then
        ninja -C "$lacuna_build" -j "$(nproc)" "$@" >&2 \
            || die "could not be built; the compiler's words are above"
    fi
    exec {build_lock}>&-
}
