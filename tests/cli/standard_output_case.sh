# Words that cannot be written are no success: whatever a subcommand prints goes one way, and the exit code is 6 with one message if
# the disk is full or nobody listens.
# shellcheck disable=SC2154  # stdout, stderr: of case.sh
source "$(dirname "$0")/case.sh"

small=$SCENES/small.toml
sed "s/^beams = .*/beams = 20/" "$small" >few.toml && small=few.toml
expect_exit 0 render "$small" -o a.png
expect_exit 0 render "$small" -o b.png --set sheet.main.energy_kev=3.2
expect_exit 0 volume "$small" -o grid.vdb --voxel-km 12
fit=(fit "$SCENES/fit.toml" --photo a.png --max-evaluations 3 --set sheet.main.beams=20)
for run in one two; do "$VEGARD" "${fit[@]}" --out $run >/dev/null 2>&1 || true; expect_file $run/result.json; done
awk 'BEGIN {
  print "name,azimuth_deg,zenith_deg,x_px,y_px"
  for (i = 0; i < 12; ++i) {
    azimuth = 77 * i % 360; zenith = 8 + 6 * i; r = 15 * zenith * atan2(0, -1) / 180; a = azimuth * atan2(0, -1) / 180
    printf "star %d,%g,%g,%.6f,%.6f\n", i, azimuth, zenith, 33 + r * sin(a), 23 + r * cos(a)
  }
}' >stars.csv

tried=
# Words go one way, so that a full disk is tried with every subcommand, and nobody who listens with the first ones.
ways="full closed"
# refused ARGUMENTS...: what prints ends so, on a full disk or with the standard output closed. out* is removed in between.
refused() {
  local way status
  tried+=" $1"
  for way in $ways; do
    rm -rf out*
    status=0
    if [[ $way == full ]]; then
      "$VEGARD" "$@" >/dev/full 2>"$stderr" || status=$?
    else
      "$VEGARD" "$@" >&- 2>"$stderr" || status=$?
    fi
    [[ $status -eq 6 ]] || fail "exit $status instead of 6, standard output $way: vegard $*"
    [[ $(grep -c "the standard output: cannot be written" "$stderr") -eq 1 ]] || fail "not told once ($way): vegard $*"
  done
}

refused --help
refused --version
refused render "$small" -o out.png
refused animate "$small" -o out/##.png --frames 0:1
ways=full
refused animate "$small" --frames 0:5 --list
refused preview "$small" -o out --frames 1 --size 40x40
refused points "$small" -o out.csv
refused volume "$small" -o out.vdb --voxel-km 12
refused describe a.png
refused describe a.png -o out.toml
refused horizon --size 600,400 --points 100,200 300,190 500,200 --hfov 53.13
refused profile a.png -o out.csv
for site in "69.35 20.36" "68.03 21.69"; do
  printf '[site]\nlatitude_deg = %s\nlongitude_deg = %s\n[camera]\nmodel = "equidistant"\nwidth = 1000\nheight = 1000\nfocal_px = 300.0\nelevation_deg = 90.0\n' \
    ${site% *} ${site#* } >"at_${site%%.*}.toml"
done
printf 'name,camera,x_px,y_px\nknot,1,465.5,354.3\nknot,2,358.2,680.5\n' >sights.csv
refused triangulate sights.csv --camera at_69.toml --camera at_68.toml --pointing-error 0.1
refused keogram a.png b.png -o out.csv
refused directions "$small" -o out.exr
refused export "$small" --web out.html
expect_exit 0 render "$SCENES/map_light.toml" -o band.png
few_pixels=(--set camera.width=48 --set camera.height=32) # a map of them is drawn in about a second
expect_exit 0 render "$SCENES/map_light.toml" "${few_pixels[@]}" -o little.png
refused map "$SCENES/map.toml" --photo little.png --out out_map --replicates 0 --sparsity 4 "${few_pixels[@]}"
refused border "$SCENES/map_light.toml" --photo band.png --out out_border
refused measure band.png --out out_measure
refused mask a.png -o out.png --circle 40,40,30
refused brightness "$small"
refused brightness "$small" --json
refused calibrate stars.csv -o out.toml --size 64,48 --site 65,20,100 --time 2020-01-01T20:00:00Z
refused "${fit[@]}" --out out
refused "${fit[@]}" --check-derivatives
refused compare one two
refused sequence "$SCENES/fit.toml" --photos a.png b.png -o out --max-evaluations 3 --set sheet.main.beams=20
refused to-netcdf one -o out.nc
expect_exit 5 map "$SCENES/map.toml" --photo little.png --out calibrated --replicates 2 --sparsity 16 "${few_pixels[@]}" \
  --set sensor.calibration_error=0.1
refused to-gemini calibrated --out out --time 2014-03-10T06:05:33Z
refused to-lompe calibrated -o out.nc --time 2014-03-10T06:05:33Z
printf 'time,lat,lon,alt\n2014-03-10T06:05:33Z,68.0,-0.5,460\n' >track.csv
refused track calibrated --along track.csv --time 2014-03-10T06:05:33Z
refused grid grid.vdb -o out.txt --channel density
refused slices grid.vdb -o out.svg
refused sdf a.png -o out.exr --threshold 0.3
refused linearise a.png "$small" -o out.exr
python3 "$SOURCE/tests/cli/made_stars.py" "$SOURCE/data/stars/bright_stars.csv"
printf '%s\n' 'dark_counts = 100' '[[filter]]' 'name = "green"' 'line_nm = 557.7' 'width_nm = 2' 'rayleigh_per_count_s = 25' >counts.toml
refused linearise stars.pgm --rayleigh counts.toml --exposure 200 -o out.fits
refused photometry counts.toml stars.pgm --camera camera.toml --exposure 200 --time 2000-01-01T12:00:00Z -o out.toml
refused electrons --spectrum mono --energy-kev 1
refused invert --line 427.8=2300±50 --line 630.0=330±15
refused lines --sources --energy-kev 0.1
refused ionosphere --energy-kev 3 --flux-mw-m2 8
refused atmosphere --list
refused atmosphere --conditions equinox
tried+=" tables" # a minute of work; its help is tried below, and its words go the same way
refused studio --no-browser --idle 0.1
refused manual
refused params
refused params --markdown
refused params "$small"
refused lines
refused lines --csv
refused bodies
mkdir night
cp "$SCENES/map_light.toml" night/scene.toml && cp band.png night/20190301_221000.png
printf '[survey]\nname = "night"\nwork = ["border"]\nscene = "scene.toml"\n[[camera]]\nname = "a"\nframes = ["."]\n' >night/survey.toml
refused survey plan night/survey.toml -o out.json
expect_exit 0 survey plan night/survey.toml -o plan.json
refused survey run plan.json --out out_run
expect_exit 0 survey run plan.json --out night_run
refused survey merge night_run -o out.sqlite
refused survey submit plan.json --out out_run --dry-run

# No subcommand is left out; the help of all goes the same way.
expect_exit 0 --help
names=$(sed -n '/^Exit codes:/q; s/^  \([a-z][a-z-]*\) .*/\1/p' "$stdout")
[[ $(wc -w <<<"$names") -ge 22 ]] || fail "the list of subcommands is not understood: $names"
for name in $names; do [[ " $tried " == *" $name "* ]] || fail "vegard $name is not tried here"; done
for name in fit survey tables; do refused "$name" --help; done

# Files that are written while nobody listens hold what they hold otherwise: no file takes the place of the closed standard output.
rm -rf out*
"$VEGARD" render "$small" -o out.png >/dev/null 2>&1
"$VEGARD" render "$small" -o out_closed.png >&- 2>&- <&- && fail "a closed output is no success"
expect_same out.png out_closed.png

# What prints nothing needs no standard output.
"$VEGARD" lines --quenching out.svg >&- || fail "nothing is printed, and yet it fails"

# A reader that has enough ends the program quietly.
{ "$VEGARD" params --markdown 2>"$stderr" || true; } | head -1 >/dev/null
[[ ! -s $stderr ]] || fail "words about a reader that has gone"
