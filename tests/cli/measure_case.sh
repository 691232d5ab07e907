# From a photograph to an answer in one command: what each stage writes, and what is said where one finds nothing.
source "$(dirname "$0")/case.sh"
# Of 96 x 64 pixels the light's lower border would be as sharp as a skyline.
expect_exit 0 render "$SCENES/map_light.toml" --set camera.width=216 --set camera.height=144 -o photo.png
awk '/^\[/ { is_camera = /^\[camera\]/ } is_camera' "$SCENES/map.toml" |
  sed 's/^width.*/width = 216/; s/^height.*/height = 144/' >camera.toml
grep -q '^width' camera.toml || fail "no camera to start from"

# With the camera known: the border, and on from there the map.
expect_exit 0 measure photo.png --camera camera.toml --site 67,20 --no-map --out run
for file in report.html measure.json sky.png border/border.csv border/report.html; do expect_file "run/$file"; done
expect_stdout "$ vegard mask"
expect_stdout "$ vegard border"
grep -qF '"Trace 1: azimuths' run/measure.json || fail "another answer"
grep -qF '"trust": "good"' run/measure.json || fail "another trust"
expect_file run/traces.svg
# The answer is of the claimed border, with its height in the error of the distance: truth 190 km to the north.
python3 - run/measure.json <<'PYTHON' || fail "another answer"
import json, sys
found = json.load(open(sys.argv[1]))
main = found["main_border"]
near, far = main["distance_km_for_95_and_110_km"]
assert abs(main["distance_km"]["value"] - 190) < 19 and near < main["distance_km"]["value"] < far
assert main["distance_km"]["error"] > (far - near) / 12 ** 0.5 * 0.99
assert "north" in found["answer"][0] and found["not_known"]
PYTHON
# A map of which nothing is certain, for want of error bars, leaves no good answer.
expect_exit 5 measure photo.png --camera camera.toml --site 67,20 --replicates 0 --out mapped
grep -qF '"trust": "doubtful"' mapped/measure.json || fail "a map without error bars is good"
grep -qF '"main_curtain"' mapped/measure.json || fail "no curtain in the answer"
for file in scene.toml mask.png map/map.json map/precipitation.fits; do expect_file "mapped/$file"; done
expect_same run/border/border.csv mapped/border/border.csv

# The command that a stage shows, whose input is what it wrote, writes the same, byte for byte.
same_by_hand() { # FOLDER
  local line
  cp -r "$1" by_hand
  python3 -c 'import json, sys
for stage in json.load(open(sys.argv[1]))["stages"]:
    if stage["command"]: print(stage["exit_code"], stage["command"])' "$1/measure.json" >commands.txt
  [[ $(wc -l <commands.txt) -ge 2 ]] || fail "no commands are shown"
  while IFS= read -r line; do
    status=0
    bash -c "\"$VEGARD\" ${line#* vegard }" >"$stdout" 2>"$stderr" </dev/null || status=$?
    [[ $status == "${line%% *}" ]] || fail "exit code $status of $line"
  done <commands.txt
  diff -r by_hand "$1" || fail "another result by hand"
  rm -r by_hand
}
same_by_hand run
same_by_hand mapped

# What a stage found as numbers, as its command has them.
expect_exit 0 measure photo.png --camera camera.toml --site 67,20 --no-map --json --out numbers
python3 - "$stdout" run/border/border.json <<'PYTHON' || fail "other numbers"
import json, sys
answer, border = (json.load(open(file)) for file in sys.argv[1:])
stages = {stage["title"]: stage["numbers"] for stage in answer["stages"]}
assert stages["The lower border of the light"]["traces"] == border["traces"]
sky = stages["Which part of it is sky"]
assert sky["used_px"] + sky["left_out_px"] == 216 * 144
assert stages["What the picture says of itself"]["site"]["latitude_deg"] == 67
PYTHON

# Nothing known and no stars: a report of what is lacking, not an error.
expect_exit 5 measure photo.png --out bare
expect_file bare/report.html
expect_stdout "Needed"
expect_stdout "--camera"
grep -qF '"trust": "unconstrained"' bare/measure.json || fail "something is told"

# Place and time as calibrate takes them: with letters, in degrees and minutes, with a zone; said in one way.
expect_exit 0 measure photo.png --camera camera.toml --site "67N,20°0'E" --time 2020-01-01T21:00:00+01:00 --no-map --out words
expect_stdout "Taken at 2020-01-01T20:00:00Z; from 67,20,0."
expect_same run/border/border.csv words/border/border.csv
# The camera's file may know the place.
printf '[site]\nlatitude_deg = 67.0\nlongitude_deg = 20.0\n' | cat camera.toml - >placed.toml
expect_exit 0 measure photo.png --camera placed.toml --no-map --out placed
expect_stdout "from 67,20,0."
expect_same run/border/border.csv placed/border/border.csv
# What nobody can read is refused before any stage.
refused_at_once() {
  expect_exit 2 measure photo.png "$@" --out refused
  expect_one_message
  [[ ! -e refused ]] || fail "a folder before a refusal"
}
refused_at_once --site 67N,20N
expect_stderr "--site"
refused_at_once --site 97,20
refused_at_once --time yesterday
expect_stderr "--time"
# Of several, an empty place is left to the file.
expect_exit 3 measure photo.png none.png --site "" --site 67,20 --out refused
expect_stderr "none.png | no such file"

# Stars and a skyline, but no time: the stars tell the lens, which no file says, and with it the skyline the elevation.
source "$SOURCE/tests/cli/star_field.sh"
sky_to 0 25 >field.pgm
expect_exit 5 measure field.pgm --decoding linear --out field
expect_stdout "Its lens"
expect_stdout "--lens field/lens.toml"
awk '/^elevation_deg/ && ($3 < 24.5 || $3 > 25.7) { exit 1 }' field/camera.toml || fail "another elevation by the skyline"
grep -q '^focal_px = 2[45]' field/camera.toml || fail "another lens than the stars'"
# Up is towards the pole and 65 degrees from the equator: it looked southwards from a latitude of 65 degrees.
awk '/^azimuth_deg/ && ($3 < 178 || $3 > 182) { exit 1 }' field/camera.toml || fail "another azimuth by stars and skyline"
grep -qE 'latitude of 6[45]\.' "$stdout" || fail "another latitude by stars and skyline"

same_by_hand field

# A time at which the stars were below the horizon is told to be wrong, not missing.
expect_exit 5 measure field.pgm --decoding linear --site 0,0 --time 2020-12-22T12:00:00Z --no-map --out day
expect_stdout "time and place"

# An existing measurement stays unless asked, and what is none stays always.
expect_exit 2 measure photo.png --out run
expect_one_message
expect_exit 5 measure photo.png --out bare --overwrite
mkdir other
echo thesis >other/thesis.tex
expect_exit 2 measure photo.png --out other --overwrite
expect_stderr "no measurement"
expect_file other/thesis.tex
# An interrupted measurement leaves a folder that a rerun takes if asked to.
set -m # jobs of their own; else the shell has them ignore the signal
interrupted_at() { # FOLDER FILE ARGUMENTS...
  local folder=$1 file=$2 status=0 tries=0
  shift 2
  "$VEGARD" measure photo.png --camera camera.toml --site 67,20 --out "$folder" "$@" >"$stdout" 2>"$stderr" </dev/null &
  local job=$!
  until [[ -e $folder/$file ]]; do
    kill -0 "$job" || fail "ended before $file was there"
    ((++tries < 3000)) || fail "no $file"
    sleep 0.01
  done
  kill -INT "$job"
  wait "$job" || status=$?
  [[ $status == 130 ]] || fail "exit code $status of an interrupted measurement"
  grep -qE '"interrupted": ?true' "$folder/measure.json" || fail "the interruption is not told"
}
interrupted_at early measure.json
expect_exit 2 measure photo.png --camera camera.toml --site 67,20 --no-map --out early
expect_exit 0 measure photo.png --camera camera.toml --site 67,20 --no-map --out early --overwrite
! grep -qF '"interrupted"' early/measure.json || fail "still interrupted"
interrupted_at resumed measure.json
expect_exit 0 measure photo.png --camera camera.toml --site 67,20 --no-map --out resumed --resume
! grep -qF '"interrupted"' resumed/measure.json || fail "still interrupted"
expect_exit 2 measure photo.png --camera camera.toml --site 67,20 --no-map --out resumed --resume
expect_stderr "no interrupted measurement"
interrupted_at late map.part --replicates 1000
expect_exit 0 measure photo.png --camera camera.toml --site 67,20 --no-map --out late --overwrite
[[ ! -e late/map.part && ! -e late/scene.toml ]] || fail "a map of an earlier measurement is left"
expect_exit 3 measure none.png --out none
expect_one_message
[[ ! -e none ]] || fail "a folder of nothing"
