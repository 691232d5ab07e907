# What a picture says of itself: told, made a scene of, and taken where a scene says nothing; no more than that.
source "$(dirname "$0")/case.sh"
photo=$SOURCE/data/examples/h000/photo.jpg

# with_exif IN OUT FOCAL: the JPEG with 7.5 s, ISO 800 and a 35 mm equivalent of so many mm spliced in.
with_exif() {
  local focal
  focal=$(printf '\\x%02x' "$3")
  {
    head -c 2 "$1"
    printf '\xff\xe1\x00\x54Exif\0\0MM\0*\0\0\0\x08'
    printf '\0\x01\x87\x69\0\x04\0\0\0\x01\0\0\0\x1a\0\0\0\0'
    printf '\0\x03\x82\x9a\0\x05\0\0\0\x01\0\0\0\x44\x88\x27\0\x03\0\0\0\x01\x03\x20\0\0'
    printf '\xa4\x05\0\x03\0\0\0\x01\0'"$focal"'\0\0\0\0\0\0\0\0\0\x0f\0\0\0\x02'
    tail -c +3 "$1"
  } >"$2"
}
with_exif "$photo" phone.jpg 35

expect_exit 0 describe phone.jpg -o start.toml
expect_stdout "720 x 480 pixels"
expect_stdout "35 mm"
expect_stdout "7.5 s"
# 3:2 as the film: 2 atan(18 / 35).
expect_stdout "camera.hfov_deg = 54.4322 | FocalLengthIn35mmFilm 35 mm"
grep -q '^hfov_deg = 54.4322  # EXIF' start.toml || fail "the scene does not have the field of view"
grep -q '^iso = 800.0  # EXIF' start.toml || fail "the scene does not have the sensitivity"
grep -q '^azimuth_deg = 0.0  # assumed' start.toml || fail "what is assumed is not marked"
expect_exit 0 render start.toml -o start.png --set camera.width=72 --set camera.height=48
expect_exit 2 describe phone.jpg -o start.toml
expect_stderr "--overwrite"
expect_exit 3 describe nowhere.jpg
expect_one_message
expect_exit 0 describe "$photo"
expect_stdout "field of view"

# The rounding of the focal length is more than the error of a point: it is said.
expect_exit 0 horizon phone.jpg --points 10,400 700,410 -o camera.toml
expect_stdout "rounded"
grep -q '^elevation_deg = .*by the rounding of the focal length' camera.toml || fail "the rounding is not told"

# A scene without a camera takes it; one with a camera keeps it; and nothing at all with --no-metadata.
echo 'seed = 1' >empty.toml
expect_exit 0 profile phone.jpg -o taken.csv --scene empty.toml --bands 1
expect_stdout "from the photograph: camera.hfov_deg = 54.4322"
expect_exit 0 profile phone.jpg -o off.csv --scene empty.toml --bands 1 --no-metadata
! grep -q 'from the photograph' "$stdout" || fail "something was taken all the same"
expect_different taken.csv off.csv
printf '[camera]\nhfov_deg = 54.4322\n' >given.toml
expect_exit 0 profile phone.jpg -o given.csv --scene given.toml --bands 1
! grep -q 'from the photograph: camera.hfov_deg' "$stdout" || fail "what is given was taken"
expect_same taken.csv given.csv

# A fit says so in its run.
expect_exit 0 render "$SCENES/small.toml" -o small.jpg
with_exif small.jpg photo.jpg 30
sed '/^hfov_deg/d' "$SCENES/fit.toml" >fit.toml
"$VEGARD" fit fit.toml --photo photo.jpg --out run --max-evaluations 1 >"$stdout" 2>"$stderr" || true
expect_stdout "from the photograph: camera.hfov_deg = 59.9"
grep -q '"from_photograph"' run/result.json || fail "not in result.json"
grep -q '"path": "camera.hfov_deg"' run/result.json || fail "not in result.json"
grep -q '^# from the photograph: camera.hfov_deg' run/best.toml || fail "not told in best.toml"
grep -q '^hfov_deg = 59.9' run/best.toml || fail "not in best.toml"
"$VEGARD" fit fit.toml --photo photo.jpg --out set --max-evaluations 1 --set camera.hfov_deg=60 >"$stdout" 2>"$stderr" || true
! grep -q 'from the photograph: camera.hfov_deg' "$stdout" || fail "--set does not win"
grep -q '^hfov_deg = 60.0 ' set/best.toml || fail "--set does not win in best.toml"
"$VEGARD" fit "$SCENES/fit.toml" --photo small.jpg --out plain --max-evaluations 1 >"$stdout" 2>"$stderr" || true
expect_file plain/result.json
! grep -q 'from_photograph' plain/result.json || fail "a picture without words has said something"

# Cut short anywhere in its words, it is described or refused, with one message at most.
for size in 3 10 20 30 60 80 90; do
  head -c "$size" phone.jpg >cut.jpg
  expect_exit 3 describe cut.jpg
  expect_one_message
done
