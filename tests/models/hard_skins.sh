#!/usr/bin/env bash
# Draws the skins of the test suite that break viewers, at rest and at the end of their clip, on one sheet.
#
#   tests/models/hard_skins.sh PROGRAM SHEET.png
#
# Needs what contact_sheet.sh needs, and cargo, which writes the models.
set -euo pipefail
here=$(realpath "$(dirname "$0")")

cd "$here/../.."
cargo test --quiet --test suite skins_hard::rigs_are_written_as_files >&2
models=$(cargo metadata --format-version 1 --no-deps | jq -r .target_directory)/tmp/hard_skins
cd - >&2

sheets=$(mktemp -d)
trap 'rm -rf "$sheets"' EXIT
for time in 0 1; do
    "$here/contact_sheet.sh" "$1" "$models" "$sheets/$time.png" --time "$time"
done
convert "$sheets/0.png" "$sheets/1.png" -append "$2"
