# Stars of a picture recognised without time, place or camera, and with them.
source "$(dirname "$0")/case.sh"
source "$SOURCE/tests/cli/star_field.sh"
sky_to 0 >sky.pgm
# Without time: the place in the sky, and a table of the stars.
expect_exit 0 calibrate --image sky.pgm --decoding linear --stars-out stars.csv --overlay seen.png
expect_stdout "Recognised"
expect_starts seen.png 89504e47
expect_stdout "right ascension 9"
grep -q 'Betelgeuse,88\.' stars.csv || fail "no Betelgeuse among the stars"
awk -F, '$1 == "Rigel" && ($2 < 78.5 || $2 > 78.8) { exit 1 }' stars.csv || fail "Rigel elsewhere"
# No camera without a time: that is said, and nothing is written.
expect_exit 5 calibrate --image sky.pgm --decoding linear -o camera.toml
expect_stdout "azimuth | elevation | --time | --site"
[[ ! -e camera.toml ]] || fail "a camera without a time"
# The times that a site and a day allow.
expect_exit 0 calibrate --image sky.pgm --decoding linear --site 0,0 --date 2020-12-21
expect_stdout "2020-12-21T18:"
# With time and site a camera; six hours later the other side of the Earth is there.
expect_exit 0 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o camera.toml
expect_stdout "lens: equidistant"
awk '/^elevation_deg/ && ($3 < 89) { exit 1 }' camera.toml || fail "not to the zenith"
awk '/^focal_px/ && ($3 < 249 || $3 > 251) { exit 1 }' camera.toml || fail "another scale"
expect_exit 5 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T12:00:00Z -o none.toml
expect_stdout "below the horizon"
[[ ! -e none.toml ]] || fail "a camera below the horizon"
# The table with time and site gives the camera as well.
expect_exit 0 calibrate stars.csv --size 480,360 --site 0,0 --time 2020-12-22T00:00:00Z -o again.toml
# Two stars by hand, marked as well as a finger points, and a third that is mistaken.
marked() { awk -F, -v star="$1" -v by="$2" '/^[a-z#]/ && !x { for (i = 1; i <= NF; ++i) { if ($i == "x_px") x = i; if ($i == "y_px") y = i } }
  $1 == star { print star "=" $x + by "," $y - by }' stars.csv; }
by_hand=(--image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z)
expect_exit 0 calibrate "${by_hand[@]}" --star "$(marked Betelgeuse 3)" --star "$(marked Sirius -2)" -o hand.toml
awk '/^focal_px/ && ($3 < 249 || $3 > 251) { exit 1 }' hand.toml || fail "another scale by hand"
expect_exit 0 calibrate "${by_hand[@]}" --camera camera.toml --free rotation --star "$(marked Betelgeuse 3)" --star "$(marked Rigel -2)" -o lens.toml
rigel=$(marked Rigel 0)
expect_exit 0 calibrate "${by_hand[@]}" --star "$(marked Betelgeuse 3)" --star "Aldebaran=${rigel#*=}" --star "$(marked Sirius 0)" -o third.toml
expect_stdout "note: Aldebaran | Rigel"
# The mistaken star makes the first lenses wide; the narrow ones have the faint stars of their own field all the same.
narrow_sky >narrow.pgm
expect_exit 0 calibrate --image narrow.pgm --decoding linear --site 0,0 --time 2020-12-22T00:30:00Z --star Tejat=365,266 \
  --star Mebsuta=79,112 --star Sirius=475,265 -o narrow.toml
expect_stdout "note: Sirius | Propus"
awk '/^hfov_deg/ { width = $3 } END { exit !(width > 8.05 && width < 8.1) }' narrow.toml || fail "another scale of a narrow field"
expect_exit 5 calibrate "${by_hand[@]}" --star "Betelgeuse=${rigel#*=}" --star "Rigel=10,20" -o none.toml
[[ ! -e none.toml ]] || fail "a camera by mistaken stars"
expect_exit 2 calibrate "${by_hand[@]}" --star Betelgeuse=1,2 -o none.toml
expect_stderr "--star | one star"
expect_exit 2 calibrate stars.csv --size 480,360 --star Betelgeuse=1,2 --star Rigel=30,4 -o none.toml
expect_stderr "--star"
expect_exit 2 calibrate sky.pgm sky.pgm --same-lens --star Betelgeuse=1,2 --star Rigel=30,4 -o none.toml
expect_stderr "--same-lens | --star"
# Mirrored, it is told so.
sky_to 1 >mirrored.pgm
expect_exit 0 calibrate --image mirrored.pgm --decoding linear
expect_stdout "mirrored"
# Noise alone: what was seen and what would help, and no camera.
awk 'BEGIN { srand(3); print "P2 300 200 65535"; for (p = 0; p < 60000; ++p) print int(1000 + 90 * rand()) }' >noise.pgm
expect_exit 5 calibrate --image noise.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o none.toml
expect_stdout "What would help"
[[ ! -e none.toml ]] || fail "a camera out of noise"
# Nor from an earlier camera, whose lens is held or not.
for held in "" "--free rotation,centre" "--free rotation --twist 180"; do
  # shellcheck disable=SC2086  # the words of options
  expect_exit 5 calibrate --image noise.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z --camera camera.toml $held \
    -o none.toml
  [[ ! -e none.toml ]] || fail "a camera out of noise and an earlier one"
done
# The earlier camera with its own picture: what was held out is told, and where.
expect_exit 0 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z --camera camera.toml \
  --free rotation,centre -o turned.toml --residuals turned.csv
expect_stdout "held out"
expect_stdout "points of light"
grep -q '^# stars held out' turned.toml || fail "nothing held out in turned.toml"
head -1 turned.csv | grep -q 'region,without_region_dx_px,without_region_dy_px' || fail "no regions in turned.csv"
expect_exit 0 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o with_stars.toml \
  --stars-out placed.csv
grep -q '^# stars held out' placed.csv || fail "nothing held out in placed.csv"
expect_exit 0 calibrate placed.csv --size 480,360 --site 0,0 --time 2020-12-22T00:00:00Z -o placed.toml
# What belongs together.
expect_exit 2 calibrate stars.csv --size 480,360 --site 0,0 --time 2020-12-22T00:00:00Z
expect_stderr "-o CAMERA.toml"
expect_exit 2 calibrate stars.csv --size 480,360 --stars-out other.csv -o none.toml
expect_stderr "recognised blindly"
expect_exit 2 calibrate --image sky.pgm --decoding linear --stars-out stars.csv
expect_stderr "stars.csv"
# Outputs whole or not at all: where one may not be replaced, none is written, and what was there stays.
echo mine >mine.toml
expect_exit 2 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o mine.toml --stars-out new.csv
expect_stderr "mine.toml"
[[ ! -e new.csv ]] || fail "stars beside a camera that was refused"
[[ $(cat mine.toml) == mine ]] || fail "a camera replaced unasked"
expect_exit 2 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o new.toml --stars-out stars.csv
[[ ! -e new.toml ]] || fail "a camera beside stars that were refused"
expect_exit 0 calibrate --image sky.pgm --decoding linear --site 0,0 --time 2020-12-22T00:00:00Z -o mine.toml --stars-out stars.csv \
  --overwrite
grep -q '^focal_px' mine.toml || fail "no camera in the place of the old file"
# A planet is named where the picture shows sky, and not where the mask hides it.
jupiter_up=(--site 0,0 --time 2025-12-22T00:00:00Z)
expect_exit 0 calibrate --image sky.pgm --decoding linear "${jupiter_up[@]}" -o with_jupiter.toml
place=$(sed -n 's/^Jupiter should be at (\([0-9.]*\), \([0-9.]*\)).*/\1 \2/p' "$stdout")
[[ -n $place ]] || fail "no Jupiter in the picture"
awk -v place="$place" 'BEGIN { split(place, at, " "); print "P2 480 360 255"
  for (y = 0; y < 360; ++y) for (x = 0; x < 480; ++x) print (x - at[1]) ^ 2 + (y - at[2]) ^ 2 < 400 ? 0 : 255 }' >hides_it.pgm
expect_exit 0 calibrate --image sky.pgm --decoding linear "${jupiter_up[@]}" --mask hides_it.pgm -o without.toml
! grep -q Jupiter "$stdout" || fail "Jupiter behind the mask"
