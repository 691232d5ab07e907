# Points of all beams, whole or not at all, the same for any number of threads and wherever the camera looks.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
points_of() { sed 's/^[^:]*: \([0-9]*\) points.*/\1/' "$stdout"; }
expect_exit 0 points "$small" -o one.ply --threads 1
expect_stdout "points, all beams"
count=$(points_of)
[[ $count -gt 250000 ]] || fail "$count points of 450 beams of some 600"
grep -qaF "element vertex $count" one.ply || fail "the header does not say $count"
expect_starts one.ply 706c790a
expect_exit 0 points "$small" -o two.ply --threads 2 --set camera.azimuth_deg=180
expect_same one.ply two.ply
expect_exit 0 points "$small" -o thin.csv --max-points 10000 --unit m
[[ $(points_of) -le 10000 && $(points_of) -gt 5000 ]] || fail "$(points_of) points of at most 10000"
[[ $(grep -vc '^[#x]' thin.csv) -eq $(points_of) ]] || fail "thin.csv has another number of rows"
expect_exit 2 points "$small" -o one.ply
expect_stderr "--overwrite"
expect_exit 2 points "$small" -o points.obj
expect_exit 2 points "$small"
expect_exit 2 points "$small" -o few.ply --max-points 100
expect_stderr "--max-points"
expect_exit 2 points "$small" -o few.ply --max-points 0
expect_stderr "1 to 1000000000000"
[[ $(wc -c <"$stderr") -lt 300 ]] || fail "a long message"
expect_exit 2 points "$small" -o few.ply --unit mile
# Without sheets there are no points, however many are allowed.
sed '/^\[\[sheet\]\]/,/^$/d' "$small" >dark.toml
expect_exit 0 points dark.toml -o none.csv
expect_exit 0 points dark.toml -o thin_none.csv --max-points 100
expect_stdout "0 points, all beams"
expect_same none.csv thin_none.csv
# Nor is a table of the scene ever replaced.
printf 'altitude_km,rate\n100,1\n110,2\n120,1\n' >rates.csv
cp rates.csv before.csv
sed 's/^\[\[sheet\]\]/&\nprofile = "spline"\nprofile_file = "rates.csv"/' "$small" >table.toml
expect_exit 2 points table.toml -o rates.csv --overwrite
expect_stderr "table of the"
expect_same rates.csv before.csv
rm dark.toml none.csv thin_none.csv rates.csv before.csv table.toml
expect_exit 6 points "$small" -o no/such/folder/out.ply
status=0
(ulimit -f 64 && exec "$VEGARD" points "$small" -o full.ply >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
# Ctrl-C: exit 130 and nothing written.
set -m # a job of its own; else the shell has it ignore the signal
"$VEGARD" points "$small" -o long.ply --set sheet.main.beams=1000000 >"$stdout" 2>"$stderr" &
job=$!
until compgen -G '.long.partial-*' >/dev/null; do
  kill -0 "$job" 2>/dev/null || fail "ended before it was interrupted"
  sleep 0.02
done
kill -INT "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "interrupted"
expect_only one.ply two.ply thin.csv
