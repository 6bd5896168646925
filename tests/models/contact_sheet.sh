#!/usr/bin/env bash
# Renders every glTF model under FOLDER without a window and puts the pictures with their names on
# one sheet. Fails if a model does not open, or shows nothing although it holds triangles.
#
#   tests/models/contact_sheet.sh PROGRAM FOLDER SHEET.png [RENDER OPTION…]
#
# Folders named `invalid` are left out. Needs ImageMagick and jq.
set -euo pipefail

program=$(realpath "$1")
folder=$(realpath "$2")
mkdir -p "$(dirname "$3")"
sheet=$(realpath "$3")
shift 3

readonly SIZE=192x144 GRID=128 MOST_COLUMNS=11
# Of a picture that shows nothing, the background.
readonly EMPTY_COLOURS=1
export OCTOLUME_CACHE_DIR=

pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT

fail() {
    echo "contact_sheet.sh: $1" >&2
    failed=1
}

# The folder's name, or the file's where a folder holds several models.
label() {
    local inside stem=${1##*/}
    inside=$(dirname "$1")
    local siblings=("$folder/$inside"/*.gl[tb]*)
    if [[ $inside != . ]] && ((${#siblings[@]} == 1)); then echo "$inside"; else echo "${stem%.*}"; fi
}

failed=0
tiles=()
while IFS= read -r -d '' model; do
    name=$(realpath --relative-to "$folder" "$model")
    picture="$pictures/$(printf %04d ${#tiles[@]}).png"
    if ! "$program" render "$model" -o "$picture" --size "$SIZE" --grid "$GRID" "$@" 2>"$pictures/errors"; then
        fail "$name: $(tail -n 1 "$pictures/errors")"
        continue
    fi
    triangles=$("$program" info "$model" --json --grid 64 2>/dev/null | jq .triangles)
    if ((triangles > 0 && $(identify -format %k "$picture") <= EMPTY_COLOURS)); then
        fail "$name: nothing to see of $triangles triangles"
    fi
    tiles+=(-label "$(label "$name")" "$picture")
done < <(find "$folder" -name invalid -prune -o \( -name '*.gltf' -o -name '*.glb' \) -print0 | sort -z)

((${#tiles[@]} > 0)) || { echo "contact_sheet.sh: no model under $folder" >&2; exit 1; }
models=$((${#tiles[@]} / 3))
columns=$((models < MOST_COLUMNS ? models : MOST_COLUMNS))
font=$(convert -list font | awk '$1 == "Font:" && !found { print $2; found = 1 }')
[[ -n $font ]] || { echo "contact_sheet.sh: ImageMagick finds no font for the names" >&2; exit 1; }
montage -font "$font" -pointsize 11 -background '#202024' -fill '#d0d0d8' "${tiles[@]}" -tile "${columns}x" -geometry "$SIZE+4+4" "$sheet"
echo "$models models on $sheet" >&2
exit "$failed"
