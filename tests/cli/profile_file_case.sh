# A sheet whose profile comes from a file: every command takes it, a run keeps it, and what is wrong with it is told
# before any work.
source "$(dirname "$0")/case.sh"
mkdir scenes
sed -e 's/^energy_kev = .*/profile = "file"\nprofile_file = "tables\/drawn.csv"/' "$SCENES/small.toml" >scenes/scene.toml
mkdir scenes/tables
table=scenes/tables/drawn.csv
cat >$table <<'CSV'
# photons cm-3 s-1 at 1 mW m-2
altitude_km,630.0,5577,ver_4278
95,0,0,0
108,0.5,250,60
125,3,90,12
250,8,1,0
400,0,0,0
CSV
expect_exit 0 render scenes/scene.toml -o photo.png
expect_stdout "R at 557.7 nm"
expect_exit 0 animate scenes/scene.toml -o frame##.png --frames 0:0
expect_same photo.png frame00.png
expect_exit 0 points scenes/scene.toml -o points.ply --max-points 2000
expect_exit 0 profile photo.png -o profile.csv --scene scenes/scene.toml
# The light above 160 km is gone with its rows.
sed -i '/^250/d; /^400/d' $table
expect_exit 0 render scenes/scene.toml -o cut.png
expect_different photo.png cut.png

# A run has the table beside its best scene.
{
  cat scenes/scene.toml
  printf '[fit]\nbands = 4\nscan_points = 0\nfree = ["sheet.main.bearing_deg", { path = "sheet.main.phase_rad", start = 2.1 }]\n'
} >scenes/fit.toml
# However few pixels: good or doubtful is not the question here.
status=0
"$VEGARD" fit scenes/fit.toml --photo cut.png --out run >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 0 || $status -eq 5 ]] || fail "the fit ends with $status"
expect_same run/drawn.csv $table
grep -qF 'profile_file = "drawn.csv"' run/best.toml || fail "best.toml looks for its table elsewhere"
! grep -E 'mean electron energy.*[0-9] keV' "$stdout" || fail "a mean energy of electrons that nobody knows"
grep -qF 'the height profile is not that of known electrons' run/result.json || fail "nor why there is none"
rm -r scenes/tables
expect_exit 0 render run/best.toml -o best.png

# What is wrong.
expect_exit 3 render scenes/scene.toml -o out.png
expect_stderr "tables/drawn.csv"
expect_one_message
mkdir scenes/tables
refused() {  # TEXT_OF_THE_TABLE WORDS
  printf '%b' "$1" >$table
  for command in "render scenes/scene.toml -o out.png" "points scenes/scene.toml -o out.ply" \
    "fit scenes/fit.toml --photo cut.png --out out"; do
    # shellcheck disable=SC2086
    expect_exit 3 $command
    expect_stderr "$2"
    expect_one_message
    [[ ! -e out.png && ! -e out.ply && ! -e out ]] || fail "something was written"
  done
}
refused 'altitude_km,6300,5577\n100,1,1\n120,2,2\n' "427.8 nm"
refused 'altitude_km,6300,5577,4278\n100,1,1,0\n120,2,-2,0\n' "drawn.csv:3: -2 in column '5577'"
refused 'altitude_km,6300,5577,4278\n120,1,1,0\n100,2,2,0\n' "drawn.csv:3"
sed -i '/^profile_file/d' scenes/scene.toml
expect_exit 2 render scenes/scene.toml -o out.png
expect_stderr "scene.toml:$(grep -n '^profile =' scenes/scene.toml | cut -d: -f1)"
expect_stderr "profile_file names none"
sed -i 's/^profile = .*/&\nprofile_file = "drawn.txt"/' scenes/scene.toml
expect_exit 2 render scenes/scene.toml -o out.png
expect_stderr "'drawn.txt' | CSV"
# What the light does not depend on cannot be free.
sed -i 's/free = .*/free = ["sheet.main.energy_kev"]/' scenes/fit.toml
expect_exit 2 fit scenes/fit.toml --photo cut.png --out out
expect_stderr "has no effect"
sed -i 's/sheet.main.energy_kev/sheet.main.energy_spread/' scenes/fit.toml
expect_exit 2 fit scenes/fit.toml --photo cut.png --out out
expect_stderr "energy_spread has no effect"
