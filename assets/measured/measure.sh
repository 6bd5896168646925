#!/usr/bin/env bash
# Makes the files of measurements in this folder again: those that are named, otherwise all.
#
#   assets/measured/measure.sh PROGRAM SCENES_FOLDER [FILE…]
#
# Scenes are looked for by name anywhere below SCENES_FOLDER: Fox.glb, CesiumMan.glb, Knight.glb, robot.glb,
# mannequiny.glb, CornellBox.glb and Sponza.gltf (docs/performance.md says where they come from). A file
# whose scene is not there is left as it is. Afterwards `OCTOLUME_WRITE_TABLES=1 cargo test --test suite doc_tables`
# writes the tables of the documentation. Needs jq and cargo; takes about 10 minutes on two cores without a GPU.
set -euo pipefail

if (($# < 2)); then
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2
    exit 2
fi
program=$(realpath "$1")
scenes=$(realpath "$2")
shift 2
wanted=("$@")
cd "$(dirname "$0")/../.."
readonly FOLDER=assets/measured

made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
# What is measured is not read from an earlier run.
export OCTOLUME_CACHE_DIR=

say() { echo "measure.sh: $1" >&2; }

is_wanted() {
    local name
    ((${#wanted[@]} == 0)) && return
    for name in "${wanted[@]}"; do [[ ${name##*/} == "$1" ]] && return; done
    return 1
}

# The path of a scene by its file's name.
find_scene() { find "$made" "$scenes" -name invalid -prune -o -name "$1" -print | sort | sed -n 1p; }

# measure FILE ARGUMENT…: what the program prints as JSON, beside the command as a reader would give it.
measure() {
    local file=$1 argument path arguments=()
    shift
    is_wanted "$file" || return 0
    for argument in "$@"; do
        if [[ $argument == *.gl[tb]* ]]; then
            path=$(find_scene "$argument")
            [[ -n $path ]] || { say "$file is left as it is: there is no $argument"; return 0; }
            argument=$path
        fi
        arguments+=("$argument")
    done
    say "$file: octolume $*"
    "$program" "${arguments[@]}" --json >"$made/report"
    # Where the scene lay is nobody's business; its digest stays.
    jq --arg command "octolume $*" --argjson cores "$(nproc)" \
        '(.settings.shot.scene.source | strings) |= (split("/") | last) | {$command, $cores, report: .}' \
        "$made/report" >"$made/file"
    mv "$made/file" "$FOLDER/$file"
}

# measure_by_test TEST FILE…: what a test writes.
measure_by_test() {
    local test=$1 file
    shift
    for file in "$@"; do
        is_wanted "$file" || continue
        say "$*: cargo test --test suite $test"
        OCTOLUME_MEASURED=$PWD/$FOLDER cargo test --quiet --test suite "$test::" >&2
        return
    done
}

readonly LIT_SPONZA=(Sponza.gltf --sun 60000 --light-dir 0.12,-1,0.3 --sky 2500,3500,5000
    --eye=-2,4,0 --target 8,2.6,0 --fov 75)
readonly CORNELL_BOX=(CornellBox.glb --eye=-278,274,800 --target=-278,274,-280 --fov 38)
readonly LIT_ROOM=(knight-room.gltf --sun off --add-light point:at=0.5,3.4,1:candela=30 --eye 0,2,5.5 --target 0,1.6,0)

knight=$(find_scene Knight.glb)
if [[ -n $knight ]]; then "$FOLDER/knight_room.sh" "$knight" "$made"; fi

for characters in 1 16 64 256; do
    "$program" make dynamic --characters "$characters" -o "$made/dynamic-$characters.glb"
done

"$program" make elastic -o "$made/elastic.glb"

for scene in courtyard Sponza.gltf Fox.glb; do
    name=${scene%%.*}
    measure "discretizers-${name,,}.json" bench "$scene" --discretizers --grid 256 --warmup 1 --runs 7
done
for characters in 1 16 64 256; do
    measure "discretizers-dynamic-$characters.json" bench "dynamic-$characters.glb" --discretizers --grid 256 --warmup 1 \
        --runs 3
done
for scene in Fox CesiumMan robot Knight; do
    measure "discretizers-${scene,,}-512.json" bench "$scene.glb" --discretizers --grid 512 --time 0.5 --warmup 1 --runs 7
done
measure discretizers-elastic.json bench elastic.glb --discretizers --grid 256 --time 0.5 --warmup 1 --runs 7
measure voxels-moving.json accuracy Fox.glb CesiumMan.glb Knight.glb robot.glb mannequiny.glb --grids 128,512 \
    --stretching move
for weights in interpolated flat; do
    measure "voxels-$weights.json" accuracy Fox.glb CesiumMan.glb --grids 64,256 --times 0.5 --stretching move \
        --weights "$weights"
done
measure voxels-turned.json accuracy Sponza.gltf --turns 0,10,37 --grids 128,512
measure shadows.json accuracy courtyard Sponza.gltf --lighting --grids 256 --turns 0,37
measure cones-cornell.json accuracy "${CORNELL_BOX[@]}" --rendering --size 256x256 --samples 256
measure cones-knight.json accuracy "${LIT_ROOM[@]}" --rendering --samples 96
measure cones-courtyard.json accuracy courtyard --rendering --sky 1,1,2 --grids 256 --samples 64
measure cones-sponza.json accuracy "${LIT_SPONZA[@]}" --rendering --grids 256 --samples 64
measure rebuild-rest.json bench Sponza.gltf --grid 512 --warmup 2 --runs 7
measure rebuild-turned.json bench Sponza.gltf --grid 512 --turn 0,10,0 --lighting --warmup 2 --runs 7
measure light-courtyard.json bench courtyard --grid 256 --lighting --warmup 2 --runs 7
measure surfaces-courtyard.json bench courtyard --grid 128 --surfaces --warmup 1 --runs 3
measure surfaces-sponza.json bench Sponza.gltf --grid 256 --surfaces --warmup 1 --runs 3
measure_by_test leaks leaks.json
measure_by_test furnace furnace-narrow.json furnace-wide.json
measure_by_test cone_forms walls.json holes.json
