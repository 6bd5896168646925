#!/usr/bin/env bash
# Puts KayKit's Knight into room.gltf, a room with a glossy floor, a red and a green wall, open towards the
# camera: FOLDER/knight-room.gltf.
#
#   assets/measured/knight_room.sh KNIGHT.glb FOLDER
#
# Needs jq.
set -euo pipefail

knight=$1
folder=$2
room=$(dirname "$0")/room.gltf

# A .glb file: 12 bytes, then chunks of length, kind and content, JSON before buffer.
json_length=$(od -An -tu4 -j12 -N4 "$knight" | tr -d ' ')
head -c $((20 + json_length)) "$knight" | tail -c +21 >"$folder/knight.json"
tail -c +$((20 + json_length + 9)) "$knight" >"$folder/Knight.bin"

# Numbers of the room's parts go on behind the knight's.
jq --slurpfile rooms "$room" '
    . as $knight | $rooms[0] as $room
    | ($knight.nodes | length) as $nodes | ($knight.meshes | length) as $meshes
    | ($knight.materials | length) as $materials | ($knight.accessors | length) as $accessors
    | ($knight.bufferViews | length) as $views | ($knight.buffers | length) as $buffers
    | .buffers[0].uri = "Knight.bin"
    | .buffers += $room.buffers
    | .bufferViews += [$room.bufferViews[] | .buffer += $buffers]
    | .accessors += [$room.accessors[] | .bufferView += $views]
    | .materials += $room.materials
    | .meshes += [$room.meshes[] | .primitives[] |=
        (.attributes |= map_values(. + $accessors) | .indices += $accessors | .material += $materials)]
    | .nodes += [$room.nodes[] | .mesh += $meshes]
    | .scenes[0].nodes += [$room.scenes[0].nodes[] + $nodes]
' "$folder/knight.json" >"$folder/knight-room.gltf"
rm "$folder/knight.json"
