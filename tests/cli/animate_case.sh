# Frames are the very stills that `render` makes of their time, and a finished one is never made again.
source "$(dirname "$0")/case.sh"
scene_with 's/energy_kev = 3.0/energy_kev = 3.0\ndrift_km_s = [2.0, -1.0]\nsine_speed_km_s = 8.5/; s/beams = 150/beams = 40/'
cat >>scene.toml <<'TOML'
[time]
start_s = 0.1
instants = 2
exposure_s = 0.05
frames_per_second = 7.0
frames = 4
TOML

start_of() { "$VEGARD" animate scene.toml --list "${@:2}" --frames "$1:$1" | sed 's/^[0-9]* //'; }

for kind in exr png tif jpg; do
  expect_exit 0 animate scene.toml -o "$kind/a_####.$kind" --frames 1:3:2 --threads 1
  expect_stdout "2 frames | 160 x 120 | 0 of them"
  expect_exit 0 render scene.toml --set "$(start_of 3)" -o "still.$kind" --threads 2
  expect_same "$kind/a_0003.$kind" "still.$kind"
  expect_different "$kind/a_0001.$kind" "$kind/a_0003.$kind"
done
[[ $(start_of 0) == time.start_s=0.1 ]] || fail "frame 0 is not the scene as it is"
# Options of the picture, the seed and the rate go the same way.
expect_exit 0 animate scene.toml -o deep/##.png --bits 16 --seed 9 --fps 3 --frames 1:1
expect_exit 0 render scene.toml --bits 16 --seed 9 --set "$(start_of 1 --fps 3)" -o deep.png
expect_same deep/01.png deep.png

# Pictures behind the aurora are part of it, and are not taken for frames.
mkdir sky
expect_exit 0 render "$SCENES/small.toml" -o sky/00.png --set camera.azimuth_deg=30
behind=(--set composite.background=sky/00.png --frames 2:2)
expect_exit 0 animate scene.toml -o over/##.png "${behind[@]}"
expect_exit 0 render scene.toml --set composite.background=sky/00.png --set "$(start_of 2)" -o over.png
expect_same over/02.png over.png
cp sky/00.png kept.png
expect_exit 2 animate scene.toml -o sky/##.png "${behind[@]}" --overwrite
expect_stderr "sky/00.png"
expect_same sky/00.png kept.png
expect_exit 0 render "$SCENES/small.toml" -o sky/00.png --set camera.azimuth_deg=40 --overwrite
expect_exit 2 animate scene.toml -o over/##.png "${behind[@]}"
expect_stderr "scene names differs"
rm sky/00.png
expect_exit 3 animate scene.toml -o none/##.png "${behind[@]}"
[[ ! -e none ]] || fail "a folder is left"

# What is there is kept, down to its time stamp; what is missing is made.
before=$(stat -c %y exr/a_0001.exr exr/a_0003.exr)
sed 's/^seed/# a remark\nseed/' scene.toml >same.toml
expect_exit 0 animate same.toml -o exr/a_####.exr --overwrite
expect_stdout "4 frames | 160 x 120 | 2 of them"
[[ $before == "$(stat -c %y exr/a_0001.exr exr/a_0003.exr)" ]] || fail "a finished frame was made again"
(cd exr && expect_only a_0000.exr a_0001.exr a_0002.exr a_0003.exr a.animation.json)

# An empty file is no finished frame, and a folder none at all.
: >exr/a_0002.exr
expect_exit 0 animate same.toml -o exr/a_####.exr
expect_stdout "4 frames | 160 x 120 | 3 of them"
expect_file exr/a_0002.exr
mv exr/a_0001.exr kept.exr
mkdir exr/a_0001.exr
for words in "" --overwrite "--seed 8 --overwrite"; do
  # shellcheck disable=SC2086  # none, or options and their values
  expect_exit 6 animate scene.toml -o exr/a_####.exr $words
  expect_stderr "a_0001.exr"
  expect_stderr "is a directory"
  expect_one_message
  expect_file exr/a_0000.exr
done
rmdir exr/a_0001.exr
mv kept.exr exr/a_0001.exr

# How long it is, what a fit is told, and a rate that was said already make no other animation.
expect_exit 0 animate scene.toml -o exr/a_####.exr --set time.frames=5 --set fit.bands=30
expect_stdout "5 frames | 160 x 120 | 4 of them"
rm exr/a_0004.exr
expect_exit 0 animate scene.toml -o exr/a_####.exr --fps 7 --set time.frames_per_second=3
expect_stdout "4 frames | 160 x 120 | 4 of them"

# Another animation's frames are not replaced unasked, and never mixed with its own.
cp exr/a_0000.exr old.exr
for change in "--seed 8" "--fps 8" "--set sheet.main.energy_kev=4"; do
  # shellcheck disable=SC2086  # an option and its value
  expect_exit 2 animate scene.toml -o exr/a_####.exr $change
  expect_stderr "another animation"
  expect_stderr "--overwrite"
  expect_one_message
done
expect_stderr "the scene differs"
expect_exit 2 animate scene.toml -o exr/a_####.exr --seed 8 --frames 0:1 --overwrite
expect_stderr "a_0002.exr"
expect_same exr/a_0000.exr old.exr
expect_exit 0 animate scene.toml -o exr/a_####.exr --seed 8 --overwrite
expect_different exr/a_0000.exr old.exr
rm exr/a.animation.json
expect_exit 2 animate scene.toml -o exr/a_####.exr --seed 8
expect_stderr "a_0000.exr"

# The camera, once for all frames.
expect_exit 0 animate scene.toml -o cam/####.png --frames 0:0 --camera-json
expect_exit 0 render scene.toml -o shot.png --camera-json
expect_same cam/camera.json shot.camera.json
expect_exit 2 render scene.toml -o shot.png --camera-json
echo precious >other.camera.json
expect_exit 2 render scene.toml -o other.png --camera-json
expect_stderr other.camera.json
[[ ! -e other.png ]] || fail "a picture without its camera"

# Wrong words.
for output in a.exr '#a#.exr' 'a####.xyz' '#########.png'; do
  expect_exit 2 animate scene.toml -o "$output"
  expect_one_message
done
expect_exit 2 animate scene.toml -o '#.png' --frames 0:10
expect_stderr "more #"
expect_exit 2 animate scene.toml -o '##.png' --frames 10:0
expect_exit 2 animate scene.toml -o '##.exr' --bits 8
expect_exit 2 animate scene.toml -o '##.png' --fps 0
expect_exit 2 animate scene.toml
expect_exit 2 animate scene.toml -o '########.png' --fps 0.001 --frames 99999999:99999999
expect_stderr time.start_s
# A full disk leaves nothing half done.
status=0
(ulimit -f 4 && exec "$VEGARD" animate scene.toml -o full/##.exr >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
# Nor does it leave the folder that it has made, nor a word of frames that are none.
[[ ! -e full ]] || fail "a folder is left: $(ls -A full)"
mkdir full && echo mine >full/mine
status=0
(ulimit -f 4 && exec "$VEGARD" animate scene.toml -o full/##.exr --camera-json >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
expect_stderr "nothing was left"
(cd full && expect_only mine)
# Frames that are finished stay, and it says so.
expect_exit 0 animate scene.toml -o part/##.exr --frames 0:0
status=0
(ulimit -f 4 && exec "$VEGARD" animate scene.toml -o part/##.exr >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
expect_stderr "1 of 4 | same command"
expect_one_message
(cd part && expect_only animation.json 00.exr)
echo >file
expect_exit 6 animate scene.toml -o file/##.exr
