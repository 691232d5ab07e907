# A survey's filter: frames without an arc are neither traced nor fitted, and say so; a model of one's own; the refusals.
source "$(dirname "$0")/case.sh"
mkdir night
sed 's/^latitude_deg = .*/&\nlongitude_deg = 20.0/' "$SCENES/fit.toml" >night/scene.toml
expect_exit 0 render "$SCENES/small.toml" -o night/20190301_221000.png
expect_exit 0 render "$SCENES/small.toml" -o night/20190301_221001.png --set sheet.main.energy_flux_mw_m2=0.001
expect_exit 0 render "$SCENES/small.toml" -o night/20190301_221002.png
# An arc is what stands out of its sky.
line='{"slope": 1, "offset": 0}'
# weights CONSTANT: of a question that no feature answers.
weights() { echo "\"line\": $line, \"line_with_trees\": $line, \"grey\": {\"constant\": $1, \"terms\": []}, \"colour\": {\"constant\": $1, \"terms\": []}"; }
{
  echo "{\"kind\": \"vegard sky kinds\", \"format\": 2, \"questions\": {\"arc\": {$(weights 0), \"trees\":"
  echo '[[{"feature": "contrast", "threshold": 0.2, "missing": "below", "below": 1, "above": 2}, {"score": -2}, {"score": 2}]]},'
  echo "\"cloud\": {$(weights 1), \"trees\": []},"
  for question in twilight moon lamp; do echo "\"$question\": {$(weights -4), \"trees\": []},"; done
  echo "\"aurora\": {$(weights -4), \"trees\": []}}}"
} >night/model.json
cat >night/survey.toml <<'TOML'
[survey]
name = "night"
work = ["fit", "filter"]
scene = "scene.toml"
[[camera]]
name = "a"
frames = ["."]
filter = "model.json"
TOML
expect_exit 0 survey plan night/survey.toml -o plan.json
grep -q '"filter":"model.json"' plan.json || fail "the plan names no model"

query() { sqlite3 "$1" "$2" 2>/dev/null || python3 -c 'import sqlite3, sys
for row in sqlite3.connect(sys.argv[1]).execute(sys.argv[2]): print("|".join(map(str, row)))' "$1" "$2"; }

expect_exit 0 survey run plan.json --out whole
expect_exit 0 survey merge whole -o whole.sqlite
[[ $(query whole.sqlite "SELECT status || ' ' || coalesce(reason, '') FROM frame ORDER BY frame") == \
  $'done \nfiltered no arc: cloud\ndone ' ]] || fail "other states of frames"
[[ $(query whole.sqlite "SELECT group_concat(work || ' ' || verdict, ', ') FROM (SELECT * FROM result ORDER BY frame, work)") == \
  "filter arc, fit good, filter cloud, filter arc, fit good" ]] || fail "other works"
# What is let pass starts where the last fit ended, over what is not.
[[ $(query whole.sqlite "SELECT group_concat(start, ' ') FROM (SELECT start FROM result WHERE work = 'fit' ORDER BY frame)") == \
  "full warm" ]] || fail "frames start elsewhere"
[[ $(query whole.sqlite "SELECT count(*) FROM quantity WHERE work = 'filter'") == 144 ]] || fail "not 48 numbers a frame"
[[ $(query whole.sqlite "SELECT value FROM quantity WHERE name = 'score of arc' AND frame = 1") == 0.1192* ]] || fail "another score"
expect_exit 0 survey status whole
expect_stdout "3 of 3 frames | 2 done | 0 skipped | 0 missing | 0 unreadable | 1 filtered"
expect_exit 0 survey export whole.sqlite -o wide.csv
head -1 wide.csv | grep -q 'filter verdict.*filter: banded' || fail "no columns of the filter"
# Those built in, and learnt anew of what is known.
sed -i '/^filter/d' night/survey.toml
expect_exit 0 survey plan night/survey.toml -o built_in.json
expect_exit 0 survey run built_in.json --out built_in
# With Debian's own interpreter, for which its NumPy is, whatever else there is in PATH.
with_numpy=/usr/bin/python3
if "$with_numpy" -c 'import numpy' 2>/dev/null; then
  printf 'file,arc,twilight,cloud,moon,lamp,aurora\n' >truth.csv
  for i in 0 1 2; do echo "20190301_22100$i.png,$((i != 1)),0,0,0,0,$((i != 1))" >>truth.csv; done
  "$with_numpy" "$(dirname "$0")/../../scripts/learn_sky_kind.py" --results whole.sqlite --truth truth.csv -o night/learnt.json >/dev/null
  sed -i 's/^name = "a"/&\nfilter = "learnt.json"/' night/survey.toml
  expect_exit 0 survey plan night/survey.toml -o learnt_plan.json
  expect_exit 0 survey run learnt_plan.json --out learnt
  expect_exit 0 survey merge learnt -o learnt.sqlite
  [[ $(query learnt.sqlite "SELECT group_concat(verdict, ' ') FROM (SELECT verdict FROM result WHERE work = 'filter' ORDER BY frame)") == \
    "arc dark arc" ]] || fail "it has not learnt what it was taught"
fi
# Another model is another survey; what is none is told, and one of an earlier version is.
sed -i 's/0.2/0.3/' night/model.json
expect_exit 2 survey run plan.json --out whole
expect_stderr "not what"
sed -i 's/contrast/contrats/' night/model.json
expect_exit 3 survey run plan.json --out other
expect_stderr "'contrats'"
expect_one_message
echo '{"kind": "vegard sky trees", "format": 1, "trees": {}}' >night/model.json
expect_exit 3 survey run plan.json --out other
expect_stderr "model.json: | another version | learn it anew"
expect_one_message
