#!/usr/bin/env bash
# Every check and test, fast ones first: format, lints with and without the window, documentation,
# tests, a real window on a virtual display, a release build and one picture drawn by it.
# Needs what `setup.sh --install-only` installs; no display, no input.
set -euo pipefail
cd "$(dirname "$0")"
command -v cargo >/dev/null || . "$HOME/.cargo/env"

step() {
    local start=$SECONDS
    echo "== $*" >&2
    "$@"
    echo "== done in $((SECONDS - start)) s" >&2
}

# Dependencies are built once, as they are released. Our own code checks itself, and is built sooner.
checked=(--release)
for setting in opt-level=1 debug-assertions=true overflow-checks=true; do
    checked+=(--config "profile.release.package.octolume.$setting")
done

documentation() { RUSTDOCFLAGS="-D warnings" cargo doc "${checked[@]}" --no-deps --document-private-items; }

step cargo fmt --check
step cargo clippy "${checked[@]}" --all-targets -- -D warnings
step cargo clippy "${checked[@]}" --all-targets --no-default-features -- -D warnings
step documentation
step cargo test "${checked[@]}"
pictures=$(mktemp -d)
trap 'jobs -p | xargs --no-run-if-empty kill 2>/dev/null; rm -rf "$pictures"' EXIT
# The window, by the program that checks itself, while the one that is released is built.
cp target/release/octolume "$pictures/checked"
step tests/window/drive.sh "$pictures/checked" courtyard "$pictures" &
window=$!
step cargo build --release
wait "$window"
step target/release/octolume render courtyard -o "$pictures/courtyard.png" --size 640x360
echo "All checks passed." >&2
