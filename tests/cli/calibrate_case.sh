# A camera from its stars, and that camera in a scene.
source "$(dirname "$0")/case.sh"
# Twelve stars as an equidistant lens of 15 px to a radian sees them, axis to the zenith, centre at (33, 23).
stars_to() {
  awk -v wrong="$1" 'BEGIN {
    print "name,azimuth_deg,zenith_deg,x_px,y_px"
    for (i = 0; i < 12; ++i) {
      azimuth = 77 * i % 360; zenith = 8 + 6 * i; r = 15 * zenith * atan2(0, -1) / 180; a = azimuth * atan2(0, -1) / 180
      printf "star %d,%g,%g,%.6f,%.6f\n", i, azimuth, zenith, 33 + r * sin(a) + (i == wrong ? 6 : 0), 23 + r * cos(a)
    }
  }'
}
stars_to -1 >stars.csv
expect_exit 0 calibrate stars.csv -o camera.toml --size 64,48 --site 65,20,100 --time 2020-01-01T20:00:00Z \
  --residuals residuals.csv --json all.json --plot residuals.svg
expect_stdout "lens: equidistant"
expect_stdout "over 12 of 12 stars"
grep -q '^model = "equidistant"' camera.toml || fail "another model in camera.toml"
grep -q '^time_utc = "2020-01-01T20:00:00Z"' camera.toml || fail "no time in camera.toml"
awk '/^focal_px/ && ($3 < 14.999 || $3 > 15.001) { exit 1 }' camera.toml || fail "another scale"
[[ $(wc -l <residuals.csv) -eq 13 ]] || fail "not a line for every star"
grep -q '^<svg' residuals.svg || fail "no SVG"
expect_stdout "note: | wrong time"
grep -q '^# stars alone cannot reveal' camera.toml || fail "the doubt is not in camera.toml"
# A time with a zone and a site with letters are the same time and site.
expect_exit 0 calibrate stars.csv -o zone.toml --size 64,48 --site 65N,20E,100m --time 2020-01-01T21:00:00+01:00
expect_same camera.toml zone.toml
expect_exit 2 calibrate stars.csv -o no.toml --size 64,48 --site 65E,20E --time 2020-01-01T20:00:00Z
expect_stderr "--site: | '65E,20E'"
expect_exit 2 calibrate stars.csv -o no.toml --size 64,48 --site 65,20 --time 2020-01-01T20:00:00+1
expect_stderr "zone"
# The same again gives the same bytes.
expect_exit 0 calibrate stars.csv -o again.toml --size 64,48 --site 65,20,100 --time 2020-01-01T20:00:00Z
expect_same camera.toml again.toml
# A scene takes it: its size, its lens, its site.
expect_exit 0 render "$SCENES/small.toml" --camera camera.toml -o seen.exr
expect_exit 0 render "$SCENES/small.toml" -o plain.exr
expect_different seen.exr plain.exr
echo 'seed = 3' | cat - camera.toml >seeded.toml
expect_exit 2 render "$SCENES/small.toml" --camera seeded.toml -o no.exr
expect_stderr "seeded.toml:1: seed"
# And it is no output.
cp camera.toml kept.toml
expect_exit 2 render "$SCENES/small.toml" --camera camera.toml -o seen.exr --lines ./camera.toml --overwrite
expect_stderr "the camera's file"
expect_one_message
mkdir run
cp camera.toml run/camera.toml
for out in run run/ ./run run/camera.toml; do
  expect_exit 2 fit "$SCENES/fit.toml" --camera run/camera.toml --photo plain.exr --out "$out" --overwrite
  expect_stderr "--out: the camera's file"
  expect_one_message
done
cp camera.toml camera.exr
cp camera.toml camera.csv
expect_exit 2 directions "$SCENES/small.toml" --camera camera.exr -o camera.exr --overwrite
expect_stderr "an input"
expect_exit 2 points "$SCENES/small.toml" --camera camera.csv -o camera.csv --overwrite
expect_stderr "the camera's file"
for file in camera.toml camera.exr camera.csv; do expect_same "$file" kept.toml; done
expect_same camera.toml run/camera.toml
# A star that is none.
stars_to 4 >mistaken.csv
expect_exit 0 calibrate mistaken.csv -o mistaken.toml --size 64,48
expect_stdout "star 4 | line 6"
# Of few stars none is left out for less than a pixel.
awk -F, -v OFS=, 'NR == 5 { $4 += 0.6 } { print }' stars.csv >near.csv
expect_exit 0 calibrate near.csv -o near.toml --size 64,48
expect_stdout "over 12 of 12 stars"
# A table of the picture before it was made smaller.
awk -F, -v OFS=, 'NR > 1 { $4 *= 3.5; $5 *= 3.5 } { print }' stars.csv >large.csv
expect_exit 3 calibrate large.csv -o no.toml --size 64,48
expect_stderr "large.csv:"
expect_stderr "64 x 48 px"
expect_one_message
expect_exit 0 calibrate large.csv -o large.toml --size 600,600
expect_stdout "upper left quarter"
# An all-sky camera, by the stars of a time two hours off.
printf '[camera]\nmodel = "equidistant"\nwidth = 64\nheight = 48\nfocal_px = 15.0\nelevation_deg = 90.0\n' >zenith.toml
awk -F, -v OFS=, 'BEGIN { pi = atan2(0, -1); d = pi / 180; l = 65 * d; h = 30 * d }
  NR > 1 {
    e = sin($3 * d) * sin($2 * d); n = sin($3 * d) * cos($2 * d); u = cos($3 * d)
    p = n * cos(l) + u * sin(l); q = -n * sin(l) + u * cos(l)   # along the pole; away from it on the meridian
    t = e * cos(h) + q * sin(h); q = q * cos(h) - e * sin(h); e = t
    n = p * cos(l) - q * sin(l); u = p * sin(l) + q * cos(l)
    $2 = atan2(e, n) / d; if ($2 < 0) $2 += 360; $3 = atan2(sqrt(e * e + n * n), u) / d
    if ($3 > 90) next
  } { print }' stars.csv >late.csv
expect_exit 0 calibrate late.csv -o late.toml --size 64,48 --camera zenith.toml --site 65,20
expect_stdout "--camera | zenith | axis"
expect_stdout "2 h 0 min"
# Only the turn, of a camera that is known.
expect_exit 0 calibrate stars.csv -o turned.toml --size 64,48 --camera camera.toml --free rotation
expect_stdout "over 12 of 12 stars"
# The same stars, in the pixels of a crop that begins at (20, 10).
awk -F, -v OFS=, 'NR > 1 { $4 = sprintf("%.6f", $4 - 20); $5 = sprintf("%.6f", $5 - 10) } { print }' stars.csv >crop.csv
expect_exit 0 calibrate crop.csv -o crop.toml --size 64,48 --offset 20,10 --lens equidistant
awk '/^focal_px/ && ($3 < 14.999 || $3 > 15.001) { exit 1 }
  /^principal_x_px/ && ($3 < 0.999 || $3 > 1.001) { exit 1 }
  /^principal_y_px/ && ($3 > -0.999 || $3 < -1.001) { exit 1 }' crop.toml || fail "another camera by a crop"
# solve-field's table of stars: FITS, with a row of four whole numbers; recognised by its content.
cards() { printf '%-80s' "$@" END; }
block() { head -c "$((($1 + 2879) / 2880 * 2880 - $1))" /dev/zero; }
corr_with() {
  cards "SIMPLE  =                    T" "BITPIX  =                    8" "NAXIS   =                    0" |
    dd bs=2880 conv=sync,block cbs=2880 status=none
  cards "XTENSION= 'BINTABLE'" "BITPIX  =                    8" "NAXIS   =                    2" \
    "NAXIS1  =                   16" "NAXIS2  =                    $1" "PCOUNT  =                    0" \
    "GCOUNT  =                    1" "TFIELDS =                    4" "TTYPE1  = '$2'" "TFORM1  = '1J'" \
    "TTYPE2  = 'field_y'" "TFORM2  = '1J'" "TTYPE3  = 'index_ra'" "TFORM3  = '1J'" \
    "TTYPE4  = 'index_dec'" "TFORM4  = '1J'" | dd bs=2880 conv=sync,block cbs=2880 status=none
  [[ $1 -eq 0 ]] || { printf '\0\0\0\x0b\0\0\0\x15\0\0\x01\x17\0\0\0\x26'; block 16; }
}
corr_with 1 field_x >crop.corr
expect_exit 2 calibrate crop.corr -o no.toml --site 65,20
expect_stderr "crop.corr: --time"
expect_one_message
expect_exit 2 calibrate crop.corr -o no.toml --time 2020-01-01T20:00:00Z
expect_stderr "crop.corr: --site"
expect_exit 3 calibrate crop.corr -o no.toml --site 65,20 --time 2020-01-01T20:00:00Z
expect_stderr "crop.corr: 1 star"
corr_with 0 field_x >none.corr
expect_exit 3 calibrate none.corr -o no.toml --site 65,20 --time 2020-01-01T20:00:00Z
expect_stderr "none.corr: | no rows"
expect_one_message
corr_with 1 x >other.corr
expect_exit 3 calibrate other.corr -o no.toml --site 65,20 --time 2020-01-01T20:00:00Z
expect_stderr "other.corr: | field_x"
expect_one_message
# A picture that says when and where it was taken, by FITS or EXIF.
{ cards "SIMPLE  =                    T" "BITPIX  =                    8" "NAXIS   =                    2" \
    "NAXIS1  =                   64" "NAXIS2  =                   48" "DATE-OBS= '2020-01-01T20:00:00'" |
    dd bs=2880 conv=sync,block cbs=2880 status=none; head -c 5760 /dev/zero; } >sky.fits
expect_exit 0 calibrate stars.csv -o told.toml --image sky.fits --site 65,20,100
expect_stdout 'from the photograph: site.time_utc = "2020-01-01T20:00:00Z" (FITS DATE-OBS)'
grep -q '^# from the photograph: site.time_utc' told.toml || fail "not told in told.toml"
cmp -s <(grep '^[a-z]' camera.toml) <(grep '^[a-z]' told.toml) || fail "another camera by the picture's time"
expect_exit 2 calibrate crop.corr -o no.toml --image sky.fits --site 65,20 --no-metadata
expect_stderr "crop.corr: --time"
expect_exit 0 calibrate stars.csv -o given.toml --image sky.fits --site 65,20,100 --time 2021-01-01T20:00:00Z
grep -q '^time_utc = "2021-01-01T20:00:00Z"' given.toml || fail "--time does not win"
! grep -q 'from the photograph' "$stdout" || fail "something was taken all the same"
# One lens for two tables, an attitude for each.
awk -F, -v OFS=, 'NR > 1 { $2 = ($2 + 40) % 360 } { print }' stars.csv >later.csv
expect_exit 0 calibrate stars.csv later.csv --same-lens -o same.toml --size 64,48 --lens equidistant --residuals same.csv
for file in same.toml same.2.toml; do
  awk '/^focal_px/ && ($3 < 14.999 || $3 > 15.001) { exit 1 }' $file || fail "another scale in $file"
done
diff <(grep '^focal_px' same.toml) <(grep '^focal_px' same.2.toml) >/dev/null || fail "two lenses"
[[ $(wc -l <same.csv) -eq 25 ]] || fail "not a line for every star of both"
expect_exit 2 calibrate stars.csv later.csv -o no.toml --size 64,48
expect_stderr "--same-lens"
expect_exit 2 calibrate stars.csv --same-lens -o no.toml --size 64,48
expect_stderr "--same-lens"
# No star is left out where none is to be.
expect_exit 0 calibrate mistaken.csv -o kept_all.toml --size 64,48 --keep-all
expect_stdout "over 12 of 12 stars"
# What is refused.
expect_exit 2 calibrate -o no.toml --offset 1,2 --image stars.csv --camera camera.toml
expect_stderr "--offset"
head -4 stars.csv >few.csv
expect_exit 3 calibrate few.csv -o no.toml
expect_stderr "few.csv: | 3 stars | 6 numbers"
expect_one_message
expect_exit 2 calibrate stars.csv -o camera.toml
expect_stderr camera.toml
expect_exit 2 calibrate -o no.toml
expect_one_message
expect_exit 2 calibrate stars.csv -o no.toml --free rotation
expect_exit 2 calibrate stars.csv -o no.toml --lens fisheye
expect_exit 2 calibrate stars.csv -o no.toml --lens equisolid --terms k1
expect_exit 2 calibrate stars.csv -o stars.csv --overwrite
printf 'star,x_px,y_px\nVega,1,2\n' >named.csv
expect_exit 2 calibrate named.csv -o no.toml
expect_stderr "--time"
[[ ! -e no.toml ]] || fail "a refused calibration left its output"

# Without a scene there is no sensor to invert.
for command in "calibrate --image any.png -o sensor.toml" "measure any.png" "mask any.png -o sensor.png --stars"; do
  # shellcheck disable=SC2086  # the words of a command
  expect_exit 2 $command --decoding sensor
  expect_one_message
  expect_stderr "no scene"
done
