#!/bin/sh
# The window under Xvfb: it shows the picture that dump writes, arrow keys change it, Esc closes it.
# Needs: apt install libsdl2-dev xvfb xdotool imagemagick
# Usage: host-sim/tests/window.sh [DIRECTORY FOR SCREENSHOTS]
set -eu
cd "$(dirname "$0")/../.."
shots=${1:-$(mktemp -d)}
mkdir -p "$shots"
if [ "${ATTRACTOR_UNDER_XVFB:-}" != 1 ]; then
    cargo build --release --quiet -p attractor-sim --features window
    ATTRACTOR_UNDER_XVFB=1 exec timeout 120 xvfb-run -a -s "-screen 0 1024x768x24" "$0" "$shots"
fi
attractor=target/release/attractor
fail() {
    echo "window: $1" >&2
    [ -z "${pid:-}" ] || kill "$pid" 2>/dev/null || true
    exit 1
}
# Waits until the window shows this file.
shows() {
    for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
        sleep 0.4
        import -window "$window" "$shots/$2.png" || continue
        [ "$(compare -metric AE "$1" "$shots/$2.png" null: 2>&1)" = 0 ] && return 0
    done
    fail "does not show $1 (see $shots/$2.png)"
}
"$attractor" dump figure-6-gg figure-6-ff-diffuse -o "$shots/dump" >/dev/null
"$attractor" window figure-6-gg &
pid=$!
window=$(timeout 20 xdotool search --sync --onlyvisible --name '^attractor$' | head -1)
[ -n "$window" ] || fail "did not open"
shows "$shots/dump/figure-6-gg.png" first
xdotool windowfocus "$window"
sleep 0.2
xdotool key Right
shows "$shots/dump/figure-6-ff-diffuse.png" next
xdotool key Left
shows "$shots/dump/figure-6-gg.png" back
xdotool key Escape
for _ in 1 2 3 4 5 6 7 8 9 10; do
    sleep 0.3
    kill -0 "$pid" 2>/dev/null || break
done
kill -0 "$pid" 2>/dev/null && fail "Esc does not close it"
wait "$pid" || fail "ended with code $?"
echo "window: shows the picture, follows the arrow keys, closes on Esc"
