#!/usr/bin/env bash
# Drives the real window by mouse and keyboard on a display of its own, and photographs every step.
# Fails if the window does not open, a photo is uniform, or a control that must change the picture
# does not.
#
#   tests/window/drive.sh PROGRAM SCENE FOLDER
#
# Needs Xvfb, xdotool and ImageMagick. Places are those of a window of 1440 x 900.
set -euo pipefail

program=$(realpath "$1")
scene=$2
[[ -e $scene ]] && scene=$(realpath "$scene")
mkdir -p "$3"
folder=$(realpath "$3")

readonly VIEW=760x730+300+90
readonly NEAREST="133 0" SPLIT="230 0"

fail() { echo "drive.sh: $1" >&2; exit 1; }

# A display with a number nobody uses.
exec 3<> <(:)
mkfifo "$folder/display"
Xvfb -displayfd 1 -screen 0 1440x900x24 >"$folder/display" 2>/dev/null &
server=$!
read -r number <"$folder/display"
rm "$folder/display"
export DISPLAY=:$number

(cd "$folder" && exec "$program" "$scene") >"$folder/program.log" 2>&1 &
window_process=$!
trap 'kill $window_process $server 2>/dev/null; wait 2>/dev/null' EXIT
