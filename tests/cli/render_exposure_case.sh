# render --auto-exposure chooses the gain and tells it; --grain tells by how much another draw of the paths differs.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o auto.png --auto-exposure --set sensor.gain_per_kilorayleigh=50
expect_stdout "exposed with sensor.gain_per_kilorayleigh = "
gain=$(sed -n 's/^exposed with sensor.gain_per_kilorayleigh = //p' "$stdout")
awk -v gain="$gain" 'BEGIN { exit !(gain > 0 && gain < 50) }' || fail "the gain is $gain"
expect_exit 0 render "$SCENES/small.toml" -o other.png --auto-exposure
cmp -s auto.png other.png || fail "the picture depends on the gain that the scene had"
expect_exit 0 render "$SCENES/small.toml" -o camera.png --auto-exposure --set 'sensor.exposure="camera"' --set time.exposure_s=4
expect_stdout "exposed with sensor.iso = "
# Where no gain does it, that is told, and the scene's own stays.
expect_exit 0 render "$SCENES/small.toml" -o day.png --auto-exposure --set 'sky.level=[1.0, 1.0, 1.0]'
expect_stderr "--auto-exposure found none"
! grep -q "exposed with" "$stdout" || fail "a gain is told that was not found"

expect_exit 0 render "$SCENES/small.toml" -o plain.png
expect_exit 0 render "$SCENES/small.toml" -o grain.png --grain
grep -qE '^grain [0-9.]+ % of a pixel.s light at 630.0 nm, [0-9.]+ % of' "$stdout" || fail "no grain is told"
expect_same grain.png plain.png
expect_exit 2 render "$SCENES/small.toml" -o out.png --grain --set 'blur.model="physical"'
expect_one_message
expect_stderr "--grain"
