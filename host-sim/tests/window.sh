#!/usr/bin/env bash
# The window under Xvfb: it shows the picture that dump writes, keys change the scene, keys and mouse move about
# in it, and what it saves can be shown again from the lines that it prints. It never goes black, stays bright
# however far one zooms, and Esc closes it at any time. A picture in it takes little more than the same picture
# as a file.
# Needs: apt install libsdl2-dev xvfb xdotool imagemagick
# Usage: host-sim/tests/window.sh [DIRECTORY FOR SCREENSHOTS]
# ATTRACTOR_IS_BUILT=1 takes target/debug/attractor as it is.
set -eu
cd "$(dirname "$0")/../.."
shots=${1:-$(mktemp -d)}
mkdir -p "$shots"
shots=$(cd "$shots" && pwd)
rm -f "$shots"/tip-*.png "$shots"/mandelbrot-*.png
if [ "${ATTRACTOR_UNDER_XVFB:-}" != 1 ]; then
    # the profile of the tests: optimised, with every overflow checked
    [ "${ATTRACTOR_IS_BUILT:-}" = 1 ] || cargo build --quiet -p attractor-sim --features window
    ATTRACTOR_UNDER_XVFB=1 exec timeout 300 xvfb-run -a -s "-screen 0 1024x768x24" "$0" "$shots"
fi
attractor=$PWD/target/debug/attractor
fail() {
    echo "window: $1" >&2
    [ -z "${pid:-}" ] || kill "$pid" 2>/dev/null || true
    exit 1
}
# Waits until the window shows this file.
shows() {
    for _ in $(seq 50); do
        sleep 0.4
        import -window "$window" "$shots/$2.png" || continue
        [ "$(compare -metric AE "$1" "$shots/$2.png" null: 2>&1)" = 0 ] && return 0
    done
    fail "does not show $1 (see $shots/$2.png)"
}
# The mean brightness of what the window shows, in thousandths.
brightness() {
    import -window "$window" "$shots/$1.png"
    convert "$shots/$1.png" -colorspace gray -format '%[fx:int(1000*mean)]' info:
}
# Opens a window on a scene, in the directory of the shots.
open() {
    cd "$shots"
    "$attractor" window "$@" >"$shots/said" 2>"$shots/keys" &
    pid=$!
    cd - >/dev/null
    window=$(timeout 20 xdotool search --sync --onlyvisible --name '^attractor$' | head -1)
    [ -n "$window" ] || fail "did not open"
    xdotool windowfocus "$window"
    sleep 0.2
}
closes() {
    xdotool key Escape
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        sleep 0.3
        kill -0 "$pid" 2>/dev/null || break
    done
    kill -0 "$pid" 2>/dev/null && fail "Esc does not close it"
    wait "$pid" || fail "ended with code $?"
}
"$attractor" dump figure-6-gg figure-6-ff-diffuse fern mandelbrot -o "$shots/dump" >/dev/null

open figure-6-gg
grep -q 'Enter *save' "$shots/keys" || fail "does not say its keys"
shows "$shots/dump/figure-6-gg.png" first
xdotool key n
shows "$shots/dump/figure-6-ff-diffuse.png" next
xdotool key Page_Up
shows "$shots/dump/figure-6-gg.png" back
# round the surface, and home again
xdotool key Right Right plus
sleep 1
import -window "$window" "$shots/round.png"
[ "$(compare -metric AE "$shots/dump/figure-6-gg.png" "$shots/round.png" null: 2>&1)" != 0 ] || fail "does not walk round a surface"
xdotool key r
shows "$shots/dump/figure-6-gg.png" home
closes

# the light of a world by keys; what Enter prints shows the same
"$attractor" dump lens -o "$shots/dump/lens.png" >/dev/null
rm -f "$shots"/lens-*.png
open lens
shows "$shots/dump/lens.png" lens
xdotool key l i
sleep 1
xdotool key Return
i=0
while [ $i -lt 60 ]; do
    sleep 0.5
    i=$((i + 1))
    grep -q color "$shots/said" && break
done
closes
[ "$(compare -metric AE "$shots/dump/lens.png" "$shots/lens-1.png" null: 2>&1)" != 0 ] || fail "does not move the light"
grep -q '^I J K L' <(sed 's/^ *//' "$shots/keys") || fail "does not say which keys move the light"

# into the Mandelbrot set by keys and mouse, about a point where it looks the same at every depth: past 32 bits, past 64, past 128
cat >"$shots/tip.toml" <<'END'
kind = "mandelbrot"
centre = ["0", "1"]
width = "3"
palette = "dusk"
cycle = 16
END
"$attractor" dump "$shots/tip.toml" -o "$shots/dump/tip.png" >/dev/null
open "$shots/tip.toml"
shows "$shots/dump/tip.png" tip
i=0
while [ $i -lt 120 ]; do
    xdotool key plus
    i=$((i + 1))
done
xdotool key bracketleft
sleep 1
xdotool mousemove --window "$window" 100 90 click 1 click 4
sleep 2
xdotool key Return
# what is being drawn is finished first
i=0
while [ $i -lt 60 ]; do
    sleep 0.5
    i=$((i + 1))
    grep -q max_dwell "$shots/said" && break
done
closes
grep -q '^tip-1.png$' "$shots/said" || fail "does not name the file that it saved"
# the lines that it printed make a scene: the same picture
{
    grep -v -e centre -e width "$shots/tip.toml"
    grep -v '\.png$' "$shots/said"
} >"$shots/place.toml"
"$attractor" dump "$shots/place.toml" -o "$shots/place.png" >/dev/null
[ "$(compare -metric AE "$shots/tip-1.png" "$shots/place.png" null: 2>&1)" = 0 ] || fail "the lines it prints show something else than what it saved"
grep -Eq '^width = "0\.0{30}' "$shots/place.toml" || fail "did not get deep: $(cat "$shots/place.toml")"
[ "$(convert "$shots/tip-1.png" -format %k info:)" -gt 9 ] || fail "shows nothing at depth (see $shots/tip-1.png)"

# a scene that shows all there is stays, and says so
open fern
shows "$shots/dump/fern.png" fern
xdotool key plus
sleep 0.5
shows "$shots/dump/fern.png" still
grep -q 'fern: .*all there is' "$shots/keys" || fail "does not say why it does not zoom"
closes

# the window of the README, 20 steps into the set: as bright as at home, and what it saves is what its lines
# show
open mandelbrot
shows "$shots/dump/mandelbrot.png" home
home=$(brightness home)
# about c = i, from which filaments go out at every depth: a corner of four pixels
xdotool mousemove --window "$window" 180 40 click 1
i=0
while [ $i -lt 20 ]; do
    xdotool key plus
    i=$((i + 1))
done
xdotool key Return
i=0
while [ $i -lt 60 ]; do
    sleep 0.5
    i=$((i + 1))
    grep -q equalised "$shots/said" && break
done
deep=$(brightness deep)
closes
[ "$deep" -ge "$home" ] || fail "is darker after 20 steps of zoom: $deep thousandths, $home at home (see $shots/deep.png)"
[ "$(convert "$shots/mandelbrot-1.png" -format %k info:)" -gt 12 ] || fail "shows few colours after 20 steps of zoom"
{
    sed -e '/max_dwell/d' -e '/^\[grey\]/,$d' host-sim/scenes/mandelbrot.toml
    grep -v '\.png$' "$shots/said"
} >"$shots/bright.toml"
"$attractor" dump "$shots/bright.toml" -o "$shots/bright.png" >/dev/null
[ "$(compare -metric AE "$shots/mandelbrot-1.png" "$shots/bright.png" null: 2>&1)" = 0 ] || fail "saves other colours than its lines show"

# a picture of some seconds: in hundredths of a second of processor time, what the window takes beyond one that
# shows next to nothing, over what the file takes
most=1.3
cat >"$shots/empty.toml" <<'END'
kind = "mandelbrot"
centre = ["5", "0"]
width = "1"
END
cat >"$shots/heavy.toml" <<'END'
kind = "mandelbrot"
centre = ["-0.743643887037151", "0.13182590420533"]
width = "2e-6"
max_dwell = 5000
palette = "fire"
END
ticks() {
    awk -v hz="$(getconf CLK_TCK)" '{ print 100 * ($14 + $15) / hz }' "/proc/$1/stat"
}
dumped() {
    local TIMEFORMAT='%U %S'
    { time "$attractor" dump "$shots/$1.toml" --size 800x600 -o "$shots/dump/$1.png" >/dev/null; } 2>&1 |
        awk '{ print 100 * ($1 + $2) }'
}
for scene in empty heavy; do
    file=$(dumped $scene)
    open "$shots/$scene.toml" --size 800x600
    shows "$shots/dump/$scene.png" $scene
    shown=$(ticks "$pid")
    closes
    [ $scene = heavy ] || opening=$shown
done
ratio=$(awk -v shown="$shown" -v opening="$opening" -v file="$file" 'BEGIN { printf "%.2f", (shown - opening) / file }')
echo "window: 800 x 600 pixels of a heavy scene: $shown hundredths of a second, $opening of them to open an empty window; $file for the file; ratio $ratio"
awk -v ratio="$ratio" -v most="$most" 'BEGIN { exit !(ratio > 0.8 && ratio <= most) }' || fail "takes $ratio times what the file takes, allowed is $most"

# an equalised picture: after a pan the last one stays, moved
cat >"$shots/slow.toml" <<'END'
kind = "mandelbrot"
centre = ["-0.7453", "0.1127"]
width = "0.0065"
max_dwell = 500
equalised = true
palette = "dusk"
END
"$attractor" dump "$shots/slow.toml" --size 800x600 -o "$shots/dump/slow.png" >/dev/null
open "$shots/slow.toml" --size 800x600
shows "$shots/dump/slow.png" whole
before=$(brightness before)
xdotool key Right
sleep 0.05
after=$(brightness after)
[ $((2 * after)) -ge "$before" ] || fail "goes dark after a pan: $after thousandths, $before before (see $shots/after.png)"
# now orbits that are a thousand times as long: minutes of work, in the middle of which Esc closes the window
# within a second
sed -i -e 's/-0.7453", "0.1127/-0.75", "0.00003/' -e 's/0.0065/0.00001/' -e 's/500/1000000/' "$shots/slow.toml"
xdotool key r
sleep 3
import -window "$window" "$shots/working.png"
xdotool key Escape
sleep 1
kill -0 "$pid" 2>/dev/null && fail "Esc does not close it within a second while an equalised picture is drawn"
wait "$pid" || fail "ended with code $?"
# it was at work: a tenth of the rows at most
[ "$(convert "$shots/working.png" -crop 800x540+0+60 -format %k info:)" = 1 ] || fail "has drawn in 3 s what takes minutes"
echo "window: shows the picture, follows the keys and the mouse, saves what it shows, stays bright, closes on Esc"
