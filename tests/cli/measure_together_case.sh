# Two photographs of one arc from places 80 km apart: the height of its border by geometry alone, then with the map of both, and clear answers where there is none.
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
time_utc = "2014-02-21T19:30:40Z"
[field]
model = "igrf" # that of the Earth, as the maps of several pictures have it
[camera]
model = "equidistant"
width = 280
height = 280
focal_px = 90.0
elevation_deg = 90.0
[sensor]
gain_per_kilorayleigh = 0.05
[[sheet]]
form = "rayed_arc"
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
times=(--time 2014-02-21T19:30:40Z --time 2014-02-21T19:30:43Z)
"$VEGARD" measure "${both[@]}" "${times[@]}" --no-map --out run >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 0 || $status -eq 5 ]] || fail "exit $status"
for file in report.html together.json picture_1/report.html picture_2/report.html; do expect_file "run/$file"; done
[[ ! -e run/map && ! -e run/picture_1/map ]] || fail "a map that is not wanted"
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
# Ctrl-C during the map of both: the geometry's answer is there, and --resume goes on to the end.
set -m # jobs of their own; else the shell has them ignore the signal
"$VEGARD" measure "${both[@]}" "${times[@]}" --replicates 0 --out mapped >"$stdout" 2>"$stderr" </dev/null &
job=$!
until grep -qs '"place"' mapped/map.part; do # a step is finished
  kill -0 "$job" 2>/dev/null || fail "ended before the map of both had begun"
  sleep 0.02
done
kill -INT "$job"
status=0
wait "$job" || status=$?
[[ $status == 130 ]] || fail "exit code $status of an interrupted measurement"
python3 - run/together.json mapped/together.json <<'PYTHON' || fail "another answer after Ctrl-C"
import json, sys
whole, interrupted = (json.load(open(file)) for file in sys.argv[1:])
assert interrupted["interrupted"] and "interrupted" not in whole
assert interrupted["pairs"][0]["border"] == whole["pairs"][0]["border"]
PYTHON
cp mapped/map.part earlier.part
expect_exit 2 measure "${both[@]}" "${times[@]}" --out run --resume # nothing interrupted it
status=0
"$VEGARD" measure "${both[@]}" "${times[@]}" --replicates 0 --out mapped --resume >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 0 || $status -eq 5 ]] || fail "exit $status"
for file in scene.toml map/report.html; do expect_file "mapped/$file"; done
[[ -z $(find mapped -name '*.part') ]] || fail "a finished measurement leaves journals"
grep -q 'href="map/report.html"' mapped/report.html || fail "the report does not show the map"
python3 - mapped/together.json <<'PYTHON' || fail "another map"
import json, sys
answer = json.load(open(sys.argv[1]))
made = answer["map"]
assert "interrupted" not in answer and made["missing"] is None and made["pictures"] == [1, 2], answer["map"]
curtain = made["main_curtain"]
# The arc is 110 km to the north of the first camera; half of the peak's light is 96 km high.
# A pixel is 6 km of the distance from the second camera.
assert abs(made["nearest_km"]["value"] - 110) < 9 and abs(curtain["lower_border_km"]["value"] - 96.2) < 4, made
# So small a picture may have no light above its noise for a map of its own.
assert any("main_curtain" in picture for picture in answer["pictures"]), answer["pictures"]
assert not made["contradictions"], made
PYTHON
# A minute and more apart; the same place; the same picture; a folder that is there; too few cameras.
# An earlier measurement of three pictures is replaced as a whole, with its maps and the journals of one that
# was interrupted.
cp -r mapped late
mkdir -p late/picture_3
echo '{}' >late/picture_3/measure.json
rm -rf late/picture_2/map # a picture may have none of its own
cp -r mapped/map late/picture_2/map
for place in late late/picture_1; do cp earlier.part $place/map.part; done
expect_exit 5 measure "${both[@]}" --time 2014-02-21T19:30:40Z --time 2014-02-21T19:33:40Z --out late --overwrite
[[ ! -e late/picture_3 ]] || fail "a picture of an earlier measurement is left"
grep -q '180 s apart' late/together.json || fail "pictures three minutes apart are compared"
grep -q '"missing": ".*180 s apart' late/together.json || fail "no reason why there is no map"
[[ ! -e late/map ]] || fail "a map of pictures three minutes apart"
[[ -z $(find late -name map -o -name map.part -o -name scene.toml) ]] || fail "maps of an earlier measurement are left"
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
