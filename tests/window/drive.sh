#!/usr/bin/env bash
# Drives the real window by mouse and keyboard on a display of its own: filter, timeline, level,
# view, scene tree, lights, slice, pointers of a node, screenshot, cones, the path tracer beside them, lens, help, and
# a saved picture that is opened again.
# Photographs every step into FOLDER. Fails if the window does not open, a photo is uniform, or a control that
# must change the picture does not.
#
#   tests/window/drive.sh PROGRAM SCENE FOLDER
#
# Needs Xvfb, xdotool and ImageMagick. SCENE is a file with an animation, or a built-in scene.
set -euo pipefail

program=$(realpath "$1")
scene=$2
if [[ -e $scene ]]; then scene=$(realpath "$scene"); fi
mkdir -p "$3"
folder=$(realpath "$3")

# Places in a window of 1440 x 900, as it opens.
readonly NEAREST="133 494" SPLIT="230 494" MEASURE="15 705"
readonly VOXELS="114 808" MESH="164 808" GHOST="211 808"
readonly LEVEL_LEAVES="214 855" LEVEL_MIDDLE="150 855"
readonly TIME_START="342 882" TIME_MIDDLE="700 882"
readonly TREE_SECOND_ROW="400 93"
readonly VIEW_MIDDLE="690 460" VIEW_ASIDE="810 520" SCREENSHOT="1201 17"
# With Scene, Discretization and Filter folded, and Light unfolded.
readonly FILTER="15 464" DISCRETIZATION="15 274" SCENE="15 46" LIGHT="15 148"
readonly FIRST_LIGHT="16 176" SKY="120 278"
readonly COLOR="145 660" RADIANCE="128 806" VOXELS_BELOW="114 564" SLICE="110 588" SHADOW_MAP="173 588"
readonly HEIGHT_MIDDLE="155 636" HEIGHT_LOW="110 636"
# With Timings folded, and the node's section unfolded; its rows are those of a lit node.
readonly TIMINGS="1107 46" NODE="1107 81" DRAW_POINTERS="1106 105" FIRST_CHILD="1200 283" ABOVE="1200 371"
# With Light and the node folded too. The divider of the wipe is in the middle at first.
readonly SURFACES="250 231" CONE_TRACING="15 444" HALF_RESOLUTION="15 733" ORTHO="194 351"
readonly REFERENCE="1107 115" SAMPLES="1197 140" START="1238 140" WIPE="1299 252"
# With Scene unfolded.
readonly PATH_FIELD="130 96"
readonly DIVIDER="692 460" DIVIDER_LEFT="480 460"
# The picture alone, without the texts over it.
readonly VIEW=770x740+300+80
readonly PATIENCE_SECS=120
# Fewer pixels are dust, not another picture.
readonly CHANGED_PX=300

fail() {
    echo "drive.sh: $1" >&2
    tail -n 5 "$folder/program.log" >&2 || true
    exit 1
}

photograph() { import -window root "$folder/$1.png"; }

crop() { convert "$folder/$1.png" -crop "$VIEW" +repage "$folder/$1.view.png"; }

# How many pixels of the picture differ between two photos.
difference() {
    crop "$1"; crop "$2"
    # compare says "different" with exit code 1, and writes the count to standard error.
    { compare -metric AE "$folder/$1.view.png" "$folder/$2.view.png" null: 2>&1 || true; } | awk '{ printf "%d", $1 }'
}

# Whether the top bar tells of work that goes on: in the green of its progress bar.
is_working() {
    local green
    green=$(convert "$folder/$1.png" -crop 500x24+204+5 +repage -fx 'g - r > 0.25' -format '%[fx:maxima]' info:)
    [[ $green != 0 ]]
}

# Photographs until the whole window stays the same for a while: nothing is built or drawn any more.
photograph_at_rest() {
    local until=$((SECONDS + PATIENCE_SECS)) still=0 last="" now
    until ((still >= 3)) && photograph "$1" && ! is_working "$1"; do
        ((SECONDS < until)) || fail "the window does not come to rest before $1"
        kill -0 "$window" 2>/dev/null || fail "the window closed before $1"
        sleep 0.4
        now=$(import -window root rgb:- | sha256sum)
        if [[ $now == "$last" ]]; then still=$((still + 1)); else still=0; fi
        last=$now
    done
    crop "$1"
    (($(identify -format %k "$folder/$1.view.png") > 20)) || fail "the picture of $1 is uniform"
    echo "$1: photographed"
}

must_change() {
    local pixels
    pixels=$(difference "$1" "$2")
    ((pixels >= CHANGED_PX)) || fail "from $1 to $2 only $pixels pixels of the picture changed"
    echo "$2: $pixels pixels changed from $1"
}

must_equal() {
    local pixels
    pixels=$(difference "$1" "$2")
    ((pixels == 0)) || fail "$pixels pixels of the picture differ between $1 and $2"
    echo "$2: same picture as $1"
}

# Slow enough that press, move and release come in frames of their own, also on a busy machine.
# Pointer away from every control afterwards, so that no tooltip lies over the picture.
click() { xdotool mousemove $1 sleep 0.3 click 1 sleep 0.3 mousemove 1200 860; }

drag() {
    xdotool mousemove $1 sleep 0.5 mousedown 1 sleep 0.5 mousemove $2 sleep 0.5 mouseup 1 sleep 0.5 mousemove 1200 860
}

# Into the number at a place.
enter() { click "$1"; xdotool type --delay 100 "$2"; xdotool key Return; }

# Instead of the text in the field at a place.
replace() { click "$1"; xdotool key ctrl+a; xdotool type --delay 50 "$2"; xdotool key Return; }

alt_click() { xdotool mousemove $1 sleep 0.5 keydown alt sleep 0.5 click 1 sleep 0.5 keyup alt sleep 0.5 mousemove 1200 860; }

zoom_in() { xdotool mousemove $1 sleep 0.5 click --repeat 12 --delay 100 4 sleep 0.5 mousemove 1200 860; }

Xvfb -displayfd 3 -screen 0 1440x900x24 3>"$folder/display" 2>/dev/null &
server=$!
trap 'kill "${window:-}" "$server" 2>/dev/null; wait 2>/dev/null || true' EXIT
for _ in {1..50}; do [[ -s $folder/display ]] && break; sleep 0.1; done
DISPLAY=:$(<"$folder/display")
export DISPLAY
rm "$folder/display" "$folder"/*.png "$folder"/Octolume/*.png 2>/dev/null || true

# Screenshots go where the desktop says that pictures are; an earlier window leaves no trace in this one.
echo "XDG_PICTURES_DIR=\"$folder\"" >"$folder/user-dirs.dirs"
(cd "$folder" && XDG_CONFIG_HOME=$folder exec "$program" --fresh "$scene") >"$folder/program.log" 2>&1 &
window=$!
id=$(timeout "$PATIENCE_SECS" xdotool search --sync --onlyvisible --name '^Octolume' | head -n 1) || fail "the window did not open"
# There is no window manager that would give it the keyboard.
xdotool windowfocus --sync "$id"

photograph_at_rest 01-opened
click "$NEAREST"; photograph_at_rest 02-nearest; must_change 01-opened 02-nearest
click "$SPLIT"; photograph_at_rest 03-split; must_equal 01-opened 03-split

drag "$TIME_START" "$TIME_MIDDLE"; photograph_at_rest 04-scrubbed; must_change 03-split 04-scrubbed
xdotool key Right key Right; photograph_at_rest 05-stepped; must_change 04-scrubbed 05-stepped
xdotool key space sleep 2; photograph 06-playing; sleep 1; photograph 06-playing-on
must_change 06-playing 06-playing-on
xdotool key space; photograph_at_rest 06-played; must_change 05-stepped 06-played

drag "$LEVEL_LEAVES" "$LEVEL_MIDDLE"; photograph_at_rest 07-level; must_change 06-played 07-level
drag "$LEVEL_MIDDLE" "$LEVEL_LEAVES"; photograph_at_rest 08-leaves; must_equal 06-played 08-leaves

click "$MESH"; photograph_at_rest 09-mesh; must_change 08-leaves 09-mesh
click "$GHOST"; photograph_at_rest 10-ghost; must_change 09-mesh 10-ghost
click "$VOXELS"; click "$MEASURE"; photograph_at_rest 11-measured; must_equal 08-leaves 11-measured

drag "$VIEW_MIDDLE" "$VIEW_ASIDE"; photograph_at_rest 12-orbited; must_change 11-measured 12-orbited
zoom_in "$VIEW_MIDDLE"; photograph_at_rest 12-zoomed; must_change 12-orbited 12-zoomed
xdotool key f; photograph_at_rest 13-framed; must_change 12-zoomed 13-framed

xdotool key t; click "$TREE_SECOND_ROW"; photograph_at_rest 14-tree; must_change 13-framed 14-tree
xdotool key h; photograph_at_rest 15-hidden; must_change 14-tree 15-hidden
xdotool key shift+h; photograph_at_rest 16-isolated; must_change 15-hidden 16-isolated
xdotool key f; photograph_at_rest 17-framed; must_change 16-isolated 17-framed
xdotool key ctrl+z; photograph_at_rest 18-undone; must_equal 16-isolated 18-undone
xdotool key alt+h; photograph_at_rest 19-shown; must_equal 14-tree 19-shown
xdotool key t; photograph_at_rest 20-folded; must_equal 13-framed 20-folded

for section in "$FILTER" "$DISCRETIZATION" "$SCENE" "$LIGHT"; do click "$section"; done
photograph_at_rest 21-sections; must_equal 20-folded 21-sections
click "$COLOR"; click "$RADIANCE"; photograph_at_rest 22-radiance; must_change 21-sections 22-radiance
enter "$SKY" 2; photograph_at_rest 23-sky; must_change 22-radiance 23-sky
click "$FIRST_LIGHT"; photograph_at_rest 24-light-off; must_change 23-sky 24-light-off
click "$FIRST_LIGHT"; photograph_at_rest 25-light-on; must_equal 23-sky 25-light-on
click "$SLICE"; photograph_at_rest 26-slice; must_change 25-light-on 26-slice
drag "$HEIGHT_MIDDLE" "$HEIGHT_LOW"; photograph_at_rest 27-slice-moved; must_change 26-slice 27-slice-moved
click "$SHADOW_MAP"; photograph_at_rest 28-shadow-map; must_change 27-slice-moved 28-shadow-map
click "$VOXELS_BELOW"; photograph_at_rest 29-voxels; must_equal 25-light-on 29-voxels

zoom_in "$VIEW_MIDDLE"; photograph_at_rest 30-near; must_change 29-voxels 30-near
click "$TIMINGS"; click "$NODE"; click "$DRAW_POINTERS"; alt_click "$VIEW_MIDDLE"
photograph_at_rest 31-node; must_change 30-near 31-node
click "$ABOVE"; photograph_at_rest 32-above; must_change 31-node 32-above
click "$FIRST_CHILD"; photograph_at_rest 33-child; must_change 32-above 33-child

click "$SCREENSHOT"; sleep 1; xdotool key ctrl+s; photograph_at_rest 34-saved
shots=("$folder"/Octolume/octolume-*.png)
((${#shots[@]} == 2)) || fail "two screenshots were asked for, there are ${#shots[@]}"
for shot in "${shots[@]}"; do
    (($(identify -format %k "$shot") > 20)) || fail "$shot is uniform"
done

# The notes about saved files lie over the picture for a while.
sleep 10
click "$LIGHT"; click "$NODE"; click "$SURFACES"; photograph_at_rest 35-surfaces; must_change 33-child 35-surfaces
click "$CONE_TRACING"; click "$HALF_RESOLUTION"; photograph_at_rest 36-full; must_change 35-surfaces 36-full
click "$HALF_RESOLUTION"; photograph_at_rest 37-half; must_equal 35-surfaces 37-half
click "$REFERENCE"; enter "$SAMPLES" 1; click "$START"; photograph_at_rest 38-traced; must_equal 37-half 38-traced
click "$WIPE"; photograph_at_rest 39-wipe; must_change 38-traced 39-wipe
drag "$DIVIDER" "$DIVIDER_LEFT"; photograph_at_rest 40-wiped; must_change 39-wipe 40-wiped

click "$WIPE"; click "$ORTHO"; photograph_at_rest 41-parallel; must_change 40-wiped 41-parallel
xdotool key F1; photograph_at_rest 42-help; must_change 41-parallel 42-help
xdotool key F1; photograph_at_rest 43-no-help; must_equal 41-parallel 43-no-help
# A picture that was saved brings back what it shows.
click "$SCENE"; replace "$PATH_FIELD" "${shots[0]}"; photograph_at_rest 44-reopened; must_change 43-no-help 44-reopened
echo "drive.sh: all steps done, photos in $folder"
