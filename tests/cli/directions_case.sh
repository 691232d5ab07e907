# Where a camera's pixels look, as maps; and profiles by direction from them, or from the scene.
source "$(dirname "$0")/case.sh"
scene=$SCENES/small.toml
expect_exit 0 directions "$scene" -o maps.exr
expect_stdout "maps.exr: | 160 x 120 | 19200"
expect_starts maps.exr 762f3101
expect_exit 0 directions "$scene" -o again.exr
expect_same maps.exr again.exr
expect_exit 2 directions "$scene" -o maps.exr
expect_stderr "--overwrite"
expect_exit 2 directions "$scene" -o maps.png
expect_stderr "--output"
# A FITS file for each.
expect_exit 0 directions "$scene" -o maps.fits
expect_stdout "maps_el.fits: 160 x 120 pixels"
expect_starts maps_az.fits 53494d504c45

expect_exit 0 render "$scene" -o sky.png
rows() { grep -v '^#' "$1" | tail -n +2; }
expect_exit 0 profile sky.png -o scene.csv --scene "$scene" --azimuths 350,0,10 --elevation-step 2 --plot scene.svg
expect_stdout "scene.csv: | 3 directions | 45 steps"
grep -q '^<svg' scene.svg || fail "no SVG"
[[ $(rows scene.csv | cut -d, -f1 | sort -u | paste -sd' ') == "0 10 350" ]] || fail "not the three azimuths"
# Maps of the same camera give the same numbers; all around as well as by name.
expect_exit 0 profile sky.png -o maps.csv --azimuth-map maps.exr --elevation-map maps.exr --azimuths 350,0,10 --elevation-step 2
cmp -s <(rows scene.csv) <(rows maps.csv) || fail "camera and maps disagree"
expect_exit 0 profile sky.png -o fits.csv --azimuth-map maps_az.fits --elevation-map maps_el.fits --azimuths 350,0,10 --elevation-step 2
cmp -s <(rows scene.csv) <(rows fits.csv) || fail "camera and FITS disagree"
expect_exit 0 profile sky.png -o around.csv --azimuth-map maps.exr --directions 8 --dark 0.01,0.01,0.01
expect_stdout "8 directions of 90 steps"
# Rows have the maps' elevations where no direction is asked for.
expect_exit 0 profile sky.png -o bands.csv --azimuth-map maps.exr --bands 1
expect_exit 0 profile sky.png -o bands_scene.csv --scene "$scene" --bands 1
paste -d, <(rows bands.csv | cut -d, -f3) <(rows bands_scene.csv | cut -d, -f3) |
  awk -F, '{ d = $1 - $2; if (d < -0.3 || d > 0.3) exit 1 } END { exit NR != 120 }' || fail "other elevations"

# From above the air rows have tangent altitudes; from the ground they have none.
head -n 40 bands_scene.csv | grep -q tangent_altitude_km && fail "a tangent altitude from the ground"
sed '/^altitude_m/d; s/^\[site\]/[site]\naltitude_m = 400000.0/' "$scene" >orbit.toml
grep -q '^altitude_m = 400000' orbit.toml || printf '[site]\naltitude_m = 400000.0\n' >>orbit.toml
sed -i 's/^elevation_deg = .*/elevation_deg = -18.0/' orbit.toml
expect_exit 0 profile sky.png -o orbit.csv --scene orbit.toml --bands 1
grep -q '^band,row_px,elevation_deg,tangent_altitude_km,' orbit.csv || fail "no tangent altitudes"
expect_exit 0 profile sky.png -o limb.csv --scene orbit.toml --azimuths 0 --tangent-step 5 --tangent-range 0,300
expect_stdout "limb.csv: | 1 directions | 60 steps | tangent altitude"
expect_stdout "azimuth 0°:"
expect_stdout "0.1° | 3.5 km"
grep -q '^# green_layer: azimuth 0°:' limb.csv || fail "no layer in the table"

refused() {  # EXIT WORDS ARGUMENTS...
  local code=$1 words=$2
  shift 2
  expect_exit "$code" profile sky.png -o no.csv "$@"
  expect_stderr "$words"
  expect_one_message
  [[ ! -e no.csv ]] || fail "something was written"
}
refused 2 "not known" --azimuths 0
refused 2 "--elevation-map" --elevation-map maps.exr --azimuths 0
refused 2 "overlap" --azimuth-map maps.exr --azimuths 0,5 --azimuth-width 20
refused 2 "no pixel looks" --azimuth-map maps.exr --azimuths 180
refused 2 "--directions" --azimuth-map maps.exr --azimuths 0 --directions 4
refused 2 "--dark" --azimuth-map maps.exr --dark 1,1,1
refused 2 "nothing of green" --azimuth-map maps.exr --azimuths 0 --dark 0,384,0
refused 2 "--elevation-step" --azimuth-map maps.exr --azimuths 0 --elevation-step 0
refused 2 "--lines" --scene "$scene" --lines --azimuths 0
refused 2 "--tangent-step" --scene "$scene" --tangent-step 5
refused 2 "--tangent-range" --scene "$scene" --azimuths 0 --tangent-range 0,200
refused 2 "site.altitude_m" --scene "$scene" --azimuths 0 --tangent-step 5
refused 2 "--elevation-step" --scene "$scene" --azimuths 0 --tangent-step 5 --elevation-step 1
refused 3 "sky.png" --azimuth-map sky.png --azimuths 0
refused 3 "missing.exr" --azimuth-map missing.exr --azimuths 0
expect_exit 0 directions "$scene" -o wide.exr --set camera.width=200
refused 3 "wide.exr: | 200 x 120" --azimuth-map wide.exr --azimuths 0
head -c 20000 maps.exr >cut.exr
refused 3 "cut.exr" --azimuth-map cut.exr --azimuths 0
