#!/usr/bin/env bash
# Installs what Octolume needs on a bare Debian 12 (other systems: C and C++ compilers, a Vulkan
# driver and rustup), then opens the built-in scene; without a display it renders it to
# octolume.png instead. `setup.sh --install-only` stops after installing.
set -euo pipefail
cd "$(dirname "$0")"

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

# Mesa of Debian 12 (22.3) ends long shader loops silently, so voxels would be lost; backports has 25.
add_backports() {
    local sources=/etc/apt/sources.list.d/debian.sources
    local backports=/etc/apt/sources.list.d/octolume-backports.sources
    [ -e "$backports" ] && return
    [ -e "$sources" ] || { echo "setup.sh: $sources is missing; add bookworm-backports to apt yourself" >&2; return 1; }
    sed 's/^Suites: bookworm .*/Suites: bookworm-backports/; s/^Suites: bookworm$/Suites: bookworm-backports/' "$sources" \
        | sed '/^$/,$d' | as_root tee "$backports" >/dev/null
}

install_debian() {
    export DEBIAN_FRONTEND=noninteractive
    add_backports
    as_root apt-get -qq update
    as_root apt-get -qq install -y --no-install-recommends ca-certificates curl git g++ libc6-dev \
        libvulkan1 xvfb xauth xdotool imagemagick fonts-dejavu-core jq x11-apps \
        libx11-6 libx11-xcb1 libxcursor1 libxi6 libxrandr2 libxkbcommon0 libxkbcommon-x11-0 xkb-data
    as_root apt-get -qq install -y --no-install-recommends -t bookworm-backports mesa-vulkan-drivers
}

if [ -r /etc/os-release ] && grep -q '^VERSION_CODENAME=bookworm' /etc/os-release; then
    install_debian >&2
else
    echo "setup.sh: not Debian 12; install C and C++ compilers and a Vulkan driver (Mesa 24 or newer, or the vendor's) yourself" >&2
fi
if ! command -v cargo >/dev/null; then
    curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --profile minimal --component clippy,rustfmt >&2
    . "$HOME/.cargo/env"
fi
[ "${1:-}" = "--install-only" ] && exit 0

cargo build --release
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    exec target/release/octolume
fi
target/release/octolume render courtyard -o octolume.png
echo "No display: the built-in scene is in octolume.png" >&2
