# The curtains of a map refined by beams: a run as any fit's, the same bytes for any number of threads and after an interruption, and
# what is no map of this photograph.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/map_light.toml" -o photo.png
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out map --replicates 2 --sparsity 4
expect_file map/faint_curtains.csv
fit_from() { expect_exit "$1" fit "$SCENES/map.toml" --photo photo.png --from-map "$2" --out "$3" "${@:4}"; }

# Residuals of 8 bits are correlated, which the verdict says.
fit_from 5 map run --threads 2
expect_stdout "curtain | settled"
expect_stdout "curtain_1 stays: BIC would be"
for file in result.json best.toml report.html model.exr trace.csv; do expect_file "run/$file"; done
grep -q '"change": "start"' run/result.json || fail "no steps"
grep -qF "Selection of curtains" run/report.html || fail "no table of the steps"
grep -q 'course = "curve"' run/best.toml || fail "no curve in the best scene"
expect_exit 0 render run/best.toml -o best.png

# An existing run stays; --overwrite replaces it, by the same bytes for another number of threads.
fit_from 2 map run
expect_one_message
cp -r run one
fit_from 5 map run --threads 1 --overwrite
for file in model.exr trace.csv profiles.csv; do expect_same "run/$file" "one/$file"; done

# Cut off by Ctrl-C and gone on with: the same bytes.
set -m
"$VEGARD" fit "$SCENES/map.toml" --photo photo.png --from-map map --out cut >"$stdout" 2>"$stderr" &
interrupt $!
[[ $status -eq 130 || $status -eq 5 ]] || fail "exit $status instead of 130"
[[ $status -eq 5 ]] || fit_from 5 map cut --resume
for file in model.exr trace.csv profiles.csv; do expect_same "run/$file" "cut/$file"; done

# Refusals, each in one line, with nothing left behind.
refused() {
  fit_from "$1" "$2" none "${@:4}"
  expect_one_message
  expect_stderr "$3"
}
refused 3 nowhere "nowhere/map.json"
refused 3 run "run/map.json"
changed() {
  rm -rf other
  cp -r map other
  sed -i "$1" other/map.json
  ! cmp -s map/map.json other/map.json || fail "'$1' changes nothing"
}
changed 's/"kind": "vegard map"/"kind": "a cake"/'
refused 3 other "is no map's"
changed 's/"version": "[^"]*"/"version": "0.0.1"/'
refused 3 other "vegard 0.0.1"
changed 's/"format": 1/"format": 99/'
refused 3 other "another format"
changed 's/"interrupted": false/"interrupted": true/'
refused 3 other "interrupted"
changed 's/"width_px"/"breadth"/'
refused 3 other "lacks"
changed '/"curtains": \[/,/^  \],/c\  "curtains": [],'
refused 3 other "no curtain"
changed 's/"faint_curtains": [0-9]*/"faint_curtains": 3/'
refused 3 other "faint_curtains.csv"
rm -rf other
cp -r map other
head -c 300 map/curtains.csv >other/curtains.csv
refused 3 other "curtains.csv"
expect_exit 0 render "$SCENES/map_light.toml" -o dimmer.png --set footprint.band.energy_flux_mw_m2=9
expect_exit 2 fit "$SCENES/map.toml" --photo dimmer.png --from-map map --out none
expect_one_message
expect_stderr "another photograph than dimmer.png"
refused 2 map "another site" --set site.latitude_deg=68
expect_exit 2 fit "$SCENES/map.toml" --photo photo.png --from-map map --out none --set camera.width=97 --no-metadata
expect_one_message
refused 2 map "decoding" --decoding unknown
[[ ! -e none && ! -e none.part ]] || fail "something was left of a fit that was refused"
