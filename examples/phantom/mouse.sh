#!/bin/sh
# Drives the window of phantom with the synthetic pointer of xdotool, as a person would: puts the hand
# on the tissue, grasps, pulls, releases, quits. Use, inside xvfb-run: mouse.sh PHANTOM
: >log
"$1" --frames a --every 1 --seconds 60 >log 2>&1 &
phantom=$!

# await TEXT: waits until phantom has printed it, at most 30 s
await() {
  tries=300
  until grep -q "$1" log; do
    tries=$((tries - 1))
    if [ $tries -eq 0 ] || ! kill -0 $phantom; then
      cat log
      echo "mouse.sh: phantom did not print: $1"
      kill $phantom
      exit 1
    fi
    sleep 0.1
  done
}

await "the hand grasps"
window=$(xdotool search --sync --onlyvisible --name "orifice" | head -n 1)
xdotool mousemove --window "$window" 400 320
sleep 0.3
xdotool click 3
sleep 0.3
# on a busy machine the hand may come after the button, which then finds no tissue
for try in 1 2 3 4 5; do
  xdotool mousedown 1
  sleep 0.4
  grep -q "grasps node" log && break
  xdotool mouseup 1
  sleep 0.4
done
await "grasps node"
# 120 pixels (9 mm) upwards at 60 Hz, then 8 mm towards the eye
step=0
while [ $step -lt 40 ]; do
  xdotool mousemove_relative -- 0 -3
  sleep 0.016
  step=$((step + 1))
done
xdotool click --repeat 8 --delay 30 5
sleep 1
xdotool mouseup 1
await "releases it"
xdotool windowfocus --sync "$window" key q
wait $phantom
result=$?
cat log
exit $result
