# Keys move the scene and its camera; frames are stills of their time, resume, and do not depend on the threads.
source "$(dirname "$0")/case.sh"
scene_with 's/beams = 150/beams = 30/; s/^width = 160/width = 80/; s/^height = 120/height = 60/'
cat >>scene.toml <<'TOML'
[time]
frames_per_second = 2.0
frames = 4
[[key]]
time_s = 0.0
path = "site.altitude_m"
value = 0.0
[[key]]
time_s = 1.5
path = "site.altitude_m"
value = 300e3
[[key]]
time_s = 0.0
path = "site.latitude_deg"
value = 65.0
[[key]]
time_s = 1.5
path = "site.latitude_deg"
value = 61.0
[[key]]
time_s = 0.5
path = "camera.elevation_deg"
value = 32.0
ease = "linear"
[[key]]
time_s = 1.5
path = "camera.elevation_deg"
value = -12.0
TOML
expect_exit 0 animate scene.toml -o all/#.png --threads 1
expect_stdout "4 frames"
for frame in 0 1 2; do expect_different "all/$frame.png" "all/$((frame + 1)).png"; done
expect_exit 0 animate scene.toml -o some/#.png --frames 0:2:2 --threads 2
expect_exit 0 animate scene.toml -o some/#.png --threads 2
expect_stdout "2 of them"
for frame in 0 1 2 3; do expect_same "all/$frame.png" "some/$frame.png"; done
expect_exit 0 render scene.toml --set time.start_s=1 -o still.png
expect_same still.png all/2.png
# A picture says from what it was made.
grep -qaF "camera.elevation_deg" still.png || fail "no keys in still.png"
# Another key is another animation.
sed 's/300e3/200e3/' scene.toml >other.toml
expect_exit 2 animate other.toml -o all/#.png
expect_stderr "the scene differs"
# The blur of a camera that moves: with more instants another picture; at rest the same to the last bit.
# (What follows the words in a PNG is the end of its light, with the sum over all of it.)
blurred=(--set time.exposure_s=0.4 --set time.instants=4)
expect_exit 0 render scene.toml "${blurred[@]}" --set time.start_s=1 -o blurred.png
expect_different blurred.png still.png
grep -v '^#' scene.toml >rest.toml
expect_exit 0 render rest.toml --set time.start_s=9 -o rest.png
expect_exit 0 render rest.toml "${blurred[@]}" --set time.start_s=9 -o rest4.png
cmp <(tail -c 200 rest.png) <(tail -c 200 rest4.png) || fail "a camera at rest is blurred"
# What is wrong with keys: one message each, and nothing is left.
# A fit is of a scene that stands still; what keys move is not to be set.
expect_exit 2 fit scene.toml --photo none.png --out none
expect_one_message
expect_stderr "[[key]]"
expect_exit 2 render scene.toml -o none.png --set site.altitude_m=5
expect_one_message
expect_stderr "--set | site.altitude_m"
refused() {  # SED WORDS
  sed "$1" scene.toml >bad.toml
  expect_exit 2 animate bad.toml -o bad/#.png
  expect_stderr "$2"
  expect_stderr "bad.toml:"
  expect_one_message
  [[ ! -e bad ]] || fail "a folder is left"
}
refused 's/^time_s = 1.5/time_s = -1.5/' "order"
refused 's/^value = 0.0/value = -9000.0/' "inside the Earth"
refused 's/camera.elevation_deg/camera.width/' "camera.width"
refused 's/camera.elevation_deg/camera.elevation/' "elevation_deg"
expect_exit 2 animate scene.toml -o bad/#.png --camera-json
expect_stderr "--camera-json"
# Other commands take the scene as it is at its start.
expect_exit 0 points scene.toml --set time.start_s=1.5 -o points.csv
