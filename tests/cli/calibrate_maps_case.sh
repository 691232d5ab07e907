# A camera from maps of directions.
source "$(dirname "$0")/case.sh"
scene=$SCENES/small.toml
fisheye="--set camera.model=equisolid --set camera.focal_px=52 --set camera.elevation_deg=87 --set camera.roll_deg=33
  --set camera.principal_x_px=2.5 --set camera.mirrored=true"
expect_exit 0 directions "$scene" $fisheye -o maps.fits
maps="--azimuth-map maps_az.fits --elevation-map maps_el.fits"
expect_exit 0 calibrate $maps -o camera.toml --lens equisolid --site 65,20 --residuals residuals.csv --json all.json --plot plot.svg
expect_stdout "lens: equisolid, mirrored"
expect_stdout "all 19200 pixels: rms"
grep -q '^mirrored = true' camera.toml || fail "not mirrored in camera.toml"
grep -q '^# maps: maps_az.fits, maps_el.fits' camera.toml || fail "it is not told where the camera comes from"
grep -q '^latitude_deg = 65' camera.toml || fail "no site in camera.toml"
awk '/^focal_px/ { found = $3 > 51.999 && $3 < 52.001 } END { exit !found }' camera.toml || fail "another scale"
awk -F'[:,]' '/"largest_px"/ { found = $2 < 1e-3 } END { exit !found }' all.json || fail "some pixel is off"
grep -q '^<svg' plot.svg || fail "no SVG"
# The camera sees what maps and the scene see: profiles by direction agree. Maps are floats, so that a few pixels at the
# edge of a bin may change sides.
expect_exit 0 render "$scene" $fisheye -o sky.png
expect_exit 0 profile sky.png -o maps.csv $maps --azimuths 350,0,10 --elevation-step 5
expect_exit 0 profile sky.png -o camera.csv --scene "$scene" --camera camera.toml --azimuths 350,0,10 --elevation-step 5
paste -d, <(grep -v '^#' maps.csv | tail -n +2 | cut -d, -f1,2,10) <(grep -v '^#' camera.csv | tail -n +2 | cut -d, -f1,2,10) |
  awk -F, '$1 != $4 || $2 != $5 || $3 - $6 > 3 || $6 - $3 > 3 { exit 1 } END { exit NR < 30 }' || fail "maps and camera disagree"
# Separate maps are flipped as skymaps are: the mirror image of a mirror image is none.
expect_exit 0 calibrate $maps -o flipped.toml --lens equisolid --skymap-flip columns
! grep -q '^mirrored = true' flipped.toml || fail "mirrored all the same"
# What is refused.
refused() {  # EXIT WORDS ARGUMENTS...
  local code=$1 words=$2
  shift 2
  expect_exit "$code" calibrate -o no.toml "$@"
  expect_stderr "$words"
  expect_one_message
  [[ ! -e no.toml ]] || fail "something was written"
}
refused 2 "stars and maps" stars.csv $maps
refused 2 "--azimuth-map" --elevation-map maps_el.fits
refused 2 "another size" $maps --size 100,100
refused 3 "missing.fits" --azimuth-map missing.fits
expect_exit 2 calibrate $maps -o maps_az.fits --overwrite
expect_stderr "maps_az.fits"
