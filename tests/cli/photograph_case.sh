# A photograph has the sensor's noise, by the seed alone; it goes back to linear light; without the flag there is no noise.
source "$(dirname "$0")/case.sh"
camera=(--set 'sensor.exposure="camera"' --set time.exposure_s=8 --set sensor.vignetting_cos_power=4)
for name in a.png a.tif a.jpg a.exr; do
  expect_exit 0 render "$SCENES/small.toml" "${camera[@]}" -o "$name" --photograph --threads 1
  expect_exit 0 render "$SCENES/small.toml" "${camera[@]}" -o "again-$name" --photograph --threads 2
  expect_same "$name" "again-$name"
  expect_exit 0 render "$SCENES/small.toml" "${camera[@]}" -o "clean-$name"
  expect_different "$name" "clean-$name"
done
expect_exit 0 render "$SCENES/small.toml" "${camera[@]}" -o other.png --photograph --seed 8
expect_different a.png other.png
# The keys of the noise leave a picture without noise as it is.
expect_exit 0 render "$SCENES/small.toml" --lines lines.exr -o b.exr
expect_exit 0 render "$SCENES/small.toml" -o plain.png
grep -qaF "sRGB-encoded" plain.png || fail "no units in plain.png"
# The raw numbers are 16-bit and of one channel (PNG: depth in byte 24, colour type 0 in byte 25).
expect_exit 0 render "$SCENES/small.toml" "${camera[@]}" --raw raw.png
[[ $(od -An -tu1 -j24 -N2 raw.png | xargs) == "16 0" ]] || fail "raw.png is no grey picture of 16 bits"
expect_exit 2 render "$SCENES/small.toml" --raw raw.jpg
expect_stderr "cannot hold 16-bit numbers"
expect_exit 2 render "$SCENES/small.toml" --raw raw2.png --photograph
expect_stderr "--photograph"
# Back to linear light.
for name in a.png a.tif a.jpg a.exr; do
  expect_exit 0 linearise "$name" "$SCENES/small.toml" "${camera[@]}" -o "linear-$name.exr"
  expect_stdout "160 x 120 pixels, sensor: "
  for text in variance.R saturated.G vegard:scene; do
    grep -qaF "$text" "linear-$name.exr" || fail "no '$text' in linear-$name.exr"
  done
done
expect_exit 2 linearise a.png "$SCENES/small.toml" "${camera[@]}" -o linear-a.png.exr
expect_exit 2 linearise a.png "$SCENES/small.toml" -o out.png
expect_exit 3 linearise b.exr "$SCENES/small.toml" "${camera[@]}" -o out.exr
expect_stderr "linear light already"
# Behind a matrix a display file has lost some of the light, and whoever asks for lines is told.
behind=(--set 'sensor.response="nikon_d200"' --set 'sensor.matrix_rule="colorimetric"')
expect_exit 0 render "$SCENES/small.toml" "${behind[@]}" -o behind.png
{ cat "$SCENES/small.toml"; printf '\n[sensor]\nresponse = "nikon_d200"\nmatrix_rule = "colorimetric"\n'; } >behind.toml
expect_exit 0 profile behind.png --scene behind.toml --lines -o behind.csv
expect_stderr "out of gamut"
expect_exit 2 linearise a.png "$SCENES/small.toml" --set camera.width=80 -o out.exr
expect_stderr "camera.width"
expect_exit 2 profile a.png -o profile.csv --decoding sensor
expect_stderr "no scene"
# A camera that is not exposed, a tone curve that is missing or none.
expect_exit 2 render "$SCENES/small.toml" --set 'sensor.exposure="camera"' -o out.png
expect_stderr "time.exposure_s"
expect_exit 2 render "$SCENES/small.toml" --set 'sensor.tone="file"' -o out.png
expect_stderr "sensor.tone_file"
printf 'linear,encoded\n0,0\n0.2,0.6\n1,1\n' >curve.csv
cp "$SCENES/small.toml" scene.toml
printf '\n[sensor]\ntone = "file"\ntone_file = "curve.csv"\n' >>scene.toml
expect_exit 0 render scene.toml -o measured.png --photograph
grep -qaF "curve.csv-encoded" measured.png || fail "the curve's name is not in measured.png"
printf 'linear,encoded\n0,0\n0.2,0.6\n0.3,0.5\n1,1\n' >curve.csv
expect_exit 3 render scene.toml -o out.png
expect_stderr "curve.csv"
expect_one_message
[[ ! -e out.png && ! -e out.exr ]] || fail "a refused run has left a file"
# A filmic picture says so, and its light comes back: the same profile as of a picture without a roll-off.
bright=(--set sensor.gain_per_kilorayleigh=0.16 --bits 16)
expect_exit 0 render "$SCENES/small.toml" "${bright[@]}" -o plain16.png
expect_exit 0 render "$SCENES/small.toml" "${bright[@]}" -o filmic.png --set 'sensor.tone="filmic"'
expect_different plain16.png filmic.png
for name in plain16 filmic; do expect_exit 0 profile "$name.png" -o "$name.csv"; done
expect_stdout "filmic"
light() { grep -v '^#' "$1" | cut -d, -f4-6; }
paste -d, <(light plain16.csv) <(light filmic.csv) | awk -F, '
  NR > 1 { for (c = 1; c <= 3; ++c) if ($c != "") { d = $c - $(c + 3); if (d < 0) d = -d; if (d > worst) worst = d; if ($c > most) most = $c } }
  END { exit !(most > 0.6 && worst < 1e-3) }' || fail "the light of a filmic picture is not what it was"
expect_exit 2 linearise filmic.png "$SCENES/small.toml" --set 'sensor.tone="filmic"' -o out.exr
expect_stderr "sensor.tone"
expect_one_message
# Frames have a noise of their own, and --photograph makes another animation.
expect_exit 0 animate "$SCENES/small.toml" "${camera[@]}" -o frames/#.png --frames 0:1 --fps 1000 --photograph
expect_different frames/0.png frames/1.png
expect_exit 2 animate "$SCENES/small.toml" "${camera[@]}" -o frames/#.png --frames 0:1 --fps 1000
expect_stderr "--photograph differs"
