# A preview without a display: frames of a camera that turns, whole or not at all, and what they cost.
source "$(dirname "$0")/case.sh"
unset DISPLAY WAYLAND_DISPLAY
scene_with 's/beams = 150/beams = 40/'

same_pixels() { oiiotool --fail 0 --diff "$1" "$2" >.diff 2>&1 || fail "$1 and $2 differ: $(cat .diff)"; }

# Frames are the very stills that `render` makes of the same camera and size.
expect_exit 0 preview scene.toml -o frames --frames 3 --turn 12 --size 80x80 --threads 1
expect_stdout "3 frames | 80 x 60 | median"
(cd frames && expect_only frame_0000.png frame_0001.png frame_0002.png)
small=(--set camera.width=80 --set camera.height=60 --set march.step_km=4 --set march.shrink=2)
for n in 0 1 2; do
  expect_exit 0 render scene.toml "${small[@]}" --set "camera.azimuth_deg=$((6 * n))" -o still.png --overwrite
  same_pixels "frames/frame_000$n.png" still.png
done
expect_different frames/frame_0000.png frames/frame_0002.png

# Threads make no difference, and neither does what came before: a scene that is turned already is the same.
expect_exit 0 preview scene.toml -o again --frames 3 --turn 12 --size 80x80 --threads 2
for n in 0 1 2; do expect_same "frames/frame_000$n.png" "again/frame_000$n.png"; done
expect_exit 0 preview scene.toml -o turned --frames 1 --size 80x80 --set camera.azimuth_deg=12
expect_same turned/frame_0000.png frames/frame_0002.png

# Time runs if it is asked to.
expect_exit 0 preview scene.toml -o still --frames 2 --turn 0 --size 60x60
expect_same still/frame_0000.png still/frame_0001.png
expect_exit 0 preview scene.toml -o moving --frames 2 --turn 0 --size 60x60 --run --fps 2 --set sheet.main.drift_km_s.east=40
expect_different moving/frame_0000.png moving/frame_0001.png

# Fewer beams where they would take too long.
expect_exit 0 preview scene.toml -o coarse --frames 1 --size 80x80 --points 5e3
expect_different coarse/frame_0000.png frames/frame_0000.png

# --bench writes nothing.
expect_exit 0 preview scene.toml --bench --frames 2 --size 40x40
expect_stdout "2 frames | 40 x 30 | median"

# A folder is replaced only if asked for, and only if it holds nothing else.
before=$(stat -c %y frames/frame_0001.png)
expect_exit 2 preview scene.toml -o frames --frames 1
expect_stderr frames
expect_one_message
[[ $before == "$(stat -c %y frames/frame_0001.png)" ]] || fail "a frame was replaced unasked"
expect_exit 0 preview scene.toml -o frames --frames 1 --size 40x40 --overwrite
(cd frames && expect_only frame_0000.png)
echo precious >frames/notes.txt
expect_exit 2 preview scene.toml -o frames --frames 1 --overwrite
expect_stderr notes.txt
expect_one_message
expect_file frames/notes.txt
# Frames of another program, by whatever name, are none of a preview's.
mkdir blender
cp still.png blender/frame_0000.png
expect_exit 2 preview scene.toml -o blender --frames 1 --overwrite
expect_stderr frame_0000.png
expect_one_message
expect_same blender/frame_0000.png still.png
mkdir holds
cp scene.toml holds/
expect_exit 2 preview holds/scene.toml -o holds --frames 1 --overwrite
expect_file holds/scene.toml

# Wrong words.
for size in 640 0x10 10x0 10x10x10 axb 20000x10 -5x5; do
  expect_exit 2 preview scene.toml --bench --frames 1 "--size=$size"
  expect_stderr --size
  expect_one_message
done
expect_exit 2 preview scene.toml
expect_stderr "no display"
expect_one_message
expect_exit 2 preview scene.toml --frames 3
expect_stderr "no folder"
expect_exit 2 preview scene.toml --bench --save kept.toml
expect_exit 2 preview scene.toml --bench -o none
expect_exit 2 preview scene.toml --bench --frames 0
expect_exit 2 preview scene.toml --bench --shrink 17
expect_exit 3 preview missing.toml -o none
[[ ! -e none ]] || fail "a folder is left"
expect_exit 2 preview scene.toml -o none --frames 2 --turn 300 --set camera.azimuth_deg=3500
expect_stderr azimuth
[[ ! -e none ]] || fail "a folder is left"

# Interrupted, it leaves nothing.
"$VEGARD" preview scene.toml -o none --frames 9999 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
kill -INT "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
[[ ! -e none ]] || fail "a folder is left"
expect_exit 0 preview scene.toml -o next/to/nothing --frames 1 --size 40x40
[[ -z $(find . -name '*.partial-*') ]] || fail "a temporary is left"
