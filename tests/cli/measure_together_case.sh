# Two photographs of one arc from places 80 km apart: the height of its border by geometry alone, and clear answers where there is none.
source "$(dirname "$0")/case.sh"
# One arc for two observers: the second one stands 80 km to the south, for whom it is 80 km farther north.
for station in a b; do
  latitude=67.0 north=110.0
  [[ $station == a ]] || { latitude=66.280542 north=191.4; }
  cat >$station.scene.toml <<EOF
seed = 47
[site]
latitude_deg = $latitude
longitude_deg = 20.0
[field]
model = "dipole"
[camera]
model = "equidistant"
width = 280
height = 280
focal_px = 90.0
elevation_deg = 90.0
[sensor]
gain_per_kilorayleigh = 0.05
[[sheet]]
form = "homogeneous_arc"
center_km = [0.0, $north]
bearing_deg = 90.0
profile = "maxwellian"
energy_kev = 6.0
ibc = 2.5
EOF
  awk '/^\[/ { keeps = /^\[(site|camera)\]/ } keeps' $station.scene.toml >$station.toml
  expect_exit 0 render $station.scene.toml -o $station.png
done
# All of it is sky: an arc alone in a dark picture would be taken for the circle of the lens.
{ printf 'P5 280 280 255\n' && head -c 78400 /dev/zero | tr '\0' '\377'; } >sky.pgm
both=(a.png b.png --mask sky.pgm --mask sky.pgm --camera a.toml --camera b.toml --earth sphere --pointing-error 0.05)
status=0
"$VEGARD" measure "${both[@]}" --time 2014-02-21T19:30:40Z --time 2014-02-21T19:30:43Z --out run >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 0 || $status -eq 5 ]] || fail "exit $status"
for file in report.html together.json picture_1/report.html picture_2/report.html; do expect_file "run/$file"; done
python3 - run/together.json <<'PYTHON' || fail "another height"
import json, sys
pair = json.load(open(sys.argv[1]))["pairs"][0]
assert pair["refusal"] is None and abs(pair["base_km"] - 80) < 1 and abs(pair["apart_s"] - 3) < 1e-6, pair
# Maxwellian electrons of 6 keV give half of the peak's light at 96 km (data/emission/ver_maxwellian.csv).
border = pair["border"]
assert abs(border["height_km"] - 96.2) < 3 * border["height_error_km"] and border["height_error_km"] < 8, border
check = pair["cross_check"]
assert 0 <= check["covered"] <= check["points"] and check["sentence"], check
# The clocks' times are 3 s apart, the light the same: nothing tells which clock is off.
for picture in json.load(open(sys.argv[1]))["pictures"]:
    assert abs(picture["clock_offset_s"]) < 2 and 0 < picture["clock_offset_error_s"] < 2.1, picture
PYTHON
# A minute and more apart; the same place; the same picture; a folder that is there; too few cameras.
# An earlier measurement of three pictures is replaced as a whole.
mkdir -p late/picture_3
for file in late/together.json late/picture_3/measure.json; do echo '{}' >$file; done
expect_exit 5 measure "${both[@]}" --time 2014-02-21T19:30:40Z --time 2014-02-21T19:33:40Z --out late --overwrite
[[ ! -e late/picture_3 ]] || fail "a picture of an earlier measurement is left"
grep -q '180 s apart' late/together.json || fail "pictures three minutes apart are compared"
expect_exit 2 measure a.png a.png --camera a.toml --camera b.toml --out same
expect_one_message
[[ ! -e same ]] || fail "a refused measurement leaves a folder"
expect_exit 2 measure "${both[@]}" --out run
expect_stderr "--overwrite"
# Options before the pictures take no picture for a value of theirs.
expect_exit 3 measure --time 2014-02-21T19:30:40Z nothing.png --out none
expect_stderr "nothing.png"
expect_exit 3 measure --camera a.toml --mask sky.pgm --site 67,20 nothing.png --out none
expect_stderr "nothing.png"
expect_exit 3 measure --site 67,20 --site 66.3,20,100 nothing.png b.png --out none
expect_stderr "nothing.png"
# One time of two, and a time that is none, are told before anything is written.
expect_exit 2 measure "${both[@]}" --time 2014-02-21T19:30:40Z --out none
expect_stderr "--time"
expect_exit 2 measure "${both[@]}" --time 2014-02-21T19:30:40Z --time yesterday --out none
expect_stderr "yesterday"
[[ ! -e none ]] || fail "a refused measurement leaves a folder"
expect_exit 2 measure a.png b.png --camera a.toml --out few
expect_stderr "--camera"
