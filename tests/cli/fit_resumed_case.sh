# kill -9 in the middle of a fit, then --resume: the same result as an uninterrupted run, byte for byte. What
# was cut off is never thrown away unasked, and goes when the work is done. So after Ctrl-C.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
fit=(fit "$SCENES/fit.toml" --photo photo.png --set sheet.main.beams=2500 --set fit.scan_points=6)
expect_same_answer() { # RUN RUN
  for file in profiles.csv trace.csv model.exr residual.exr; do expect_same "$1/$file" "$2/$file"; done
  diff <(grep -v '"command"' "$1/result.json") <(grep -v '"command"' "$2/result.json") >&2 || fail "$1 and $2 differ"
}
# start_until STEPS: in the background, until so many steps are in the journal.
start_until() {
  "$VEGARD" "${fit[@]}" --out runs/cut --threads 1 >"$stdout" 2>"$stderr" &
  job=$!
  until [[ -e runs/cut.part ]] && [[ $(wc -l <runs/cut.part) -gt $1 ]]; do
    kill -0 "$job" 2>/dev/null || fail "ended before it was cut off"
    sleep 0.01
  done
}
expect_exit 0 "${fit[@]}" --out whole
[[ ! -e whole.part ]] || fail "the journal of a finished fit is left"

start_until 1
kill -KILL "$job"
wait "$job" 2>/dev/null || true
[[ ! -e runs/cut ]] || fail "a run appeared before it was whole"
cp runs/cut.part torn.part
expect_exit 2 "${fit[@]}" --out runs/cut
expect_stderr "runs/cut.part"
expect_stderr "--resume"
expect_one_message
expect_exit 2 "${fit[@]}" --out runs/cut --resume --max-evaluations 100
expect_stderr "another fit: --max-evaluations differs"
expect_exit 2 "${fit[@]}" --out runs/cut --resume --set fit.model_error=0.02
expect_stderr "another fit | scene"
expect_same runs/cut.part torn.part
# A step whose checksum is right and that lacks a number is somebody else's work.
step=$(sed -n 2p torn.part | cut -c 66- | sed 's/\("numbers":{"[^"]*":"\).\{16\}/\1/')
printf '%s\n%s %s\n' "$(sed -n 1p torn.part)" "$(printf %s "$step" | sha256sum | cut -c -64)" "$step" >runs/cut.part
expect_exit 2 "${fit[@]}" --out runs/cut --resume
expect_stderr "vegard: runs/cut.part ("
expect_stderr "finished step"
cp torn.part runs/cut.part
# As a kill in the middle of a line would leave it.
printf 'half of a st' >>runs/cut.part
expect_exit 0 "${fit[@]}" --out runs/cut --resume --threads 2
expect_stderr "going on after"
expect_same_answer whole runs/cut
[[ $(find runs -mindepth 1 -maxdepth 1 ! -name '.*' -printf '%f\n') == cut ]] || fail "the journal is left"
# What is finished is a run that exists, resumed or not.
expect_exit 2 "${fit[@]}" --out runs/cut --resume
expect_stderr "--overwrite"

# Ctrl-C, at once and after a step: the best so far is a run, which --resume goes on with and replaces.
set -m # jobs of their own; else the shell has them ignore the signal
for steps in 0 1; do
  rm -r runs
  if [[ $steps -eq 0 ]]; then
    : >"$stderr"
    "$VEGARD" "${fit[@]}" --out runs/cut --threads 1 >"$stdout" 2>"$stderr" &
    job=$!
    until [[ -s $stderr ]]; do sleep 0.01; done # the first stage is under way
  else
    start_until "$steps"
  fi
  kill -INT "$job"
  status=0
  wait "$job" || status=$?
  # After the search nothing is left that could be cut short.
  [[ $status -eq 130 || ($steps -gt 0 && $status -eq 0) ]] || fail "exit $status instead of 130"
  if [[ $status -eq 130 ]]; then
    expect_stderr "--resume goes on"
    grep -qF '"verdict": "interrupted"' runs/cut/result.json || fail "another verdict"
    expect_exit 0 "${fit[@]}" --out runs/cut --resume
  fi
  expect_same_answer whole runs/cut
  [[ ! -e runs/cut.part ]] || fail "the journal is left"
done
set +m

# --overwrite discards what was cut off, even of another fit; what is no journal stays.
mv torn.part other.part
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out other --overwrite
[[ ! -e other.part ]] || fail "the journal is left"
echo precious >precious.part
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out precious --overwrite
[[ $(cat precious.part) == precious ]] || fail "a file that is no journal was touched"

# A result that was damaged is none that Ctrl-C has left: it stays.
for result in '{"verdict": 5}' '{"verdict": "good", "validation_interrupted": [1]}' '[' 'null'; do
  echo "$result" >whole/result.json
  expect_exit 2 "${fit[@]}" --out whole --resume
  expect_one_message
  [[ $(cat whole/result.json) == "$result" ]] || fail "a run that is not known to be cut off was replaced"
done
