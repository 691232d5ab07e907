# Three frames of a sheet whose electrons grow harder; the same command goes on where it was interrupted, and
# ends with the same files.
source "$(dirname "$0")/case.sh"
for i in 1 2 3; do
  expect_exit 0 render "$SCENES/small.toml" -o "frame_$i.png" --set "sheet.main.energy_kev=3.$((2 * i))"
done
printf '# when, and of what\nframe_1.png 0\nframe_2.png 2.5\n\nframe_3.png 5\n' >list.txt
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o all
expect_stdout "frame_1: good (full search)"
expect_stdout "frame_2: good  sheet.main.energy_kev"
for file in sequence.csv sequence.svg sequence.json physics.csv physics.json frames/frame_1.json frames/frame_3/report.html; do
  expect_file "all/$file"
done
[[ $(grep -c '^frame_' all/sequence.csv) -eq 3 ]] || fail "not three rows"
grep -q '^frame_2,2.5,good,warm,' all/sequence.csv || fail "no row of the second frame"

# What the frames say together of the emission tables, and each one's answer with it.
grep -q '^frame_2,2.5,[a-z]*,sheet.main.energy_kev,keV,' all/physics.csv || fail "no energy with what others say"
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o all --json
expect_stdout "all/physics.csv"
expect_exit 0 sequence "$SCENES/fit.toml" --photos frame_1.png -o exact --set emission.uncertainty=none --reports none
[[ ! -e exact/physics.csv ]] || fail "a picture whose tables are exact says something of them"

# As if killed before the last frame was done: the others are not fitted again.
cp -r all resumed
rm resumed/frames/frame_3.json
stamp=$(stat -c %Y.%i resumed/frames/frame_2/result.json)
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o resumed
expect_stdout "frame_2: good (done before)"
[[ $(stat -c %Y.%i resumed/frames/frame_2/result.json) == "$stamp" ]] || fail "a finished frame was fitted again"
for file in sequence.csv sequence.svg sequence.json physics.csv physics.json frames/frame_3.json frames/frame_3/profiles.csv; do
  expect_same "all/$file" "resumed/$file"
done

# Rows alone: the same ones, and no run.
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o rows --reports none
for file in sequence.csv sequence.svg frames/frame_2.json; do expect_same "all/$file" "rows/$file"; done
[[ ! -e rows/frames/frame_2 ]] || fail "a run that nobody asked for"
# A frame that is fitted again leaves no run of the fit before.
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o rows --reports doubtful --set fit.bands=5 --overwrite
[[ ! -e rows/frames/frame_2 ]] || fail "a run of a good frame"
cp -r all again
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o again --reports none --set fit.bands=5 --overwrite
[[ ! -e again/frames/frame_2 ]] || fail "a run of another fit is left"

# Another scene is another sequence.
expect_exit 2 sequence "$SCENES/fit.toml" --photos list.txt -o all --set fit.bands=5
expect_stderr "another sequence"
# --overwrite begins one anew, in the place of a sequence alone, and replaces nothing that is not vegard's.
mkdir mine mine/frames
echo '{"years": 5}' >mine/sequence.json
echo years >mine/sequence.csv
echo '{}' >mine/frames/thesis.json
expect_exit 2 sequence "$SCENES/fit.toml" --photos list.txt -o mine --overwrite
expect_stderr "is no sequence"
[[ $(cat mine/sequence.csv) == years && -s mine/frames/thesis.json && ! -e mine/sequence.svg ]] || fail "something of the user's is gone"
other=(sequence "$SCENES/fit.toml" --photos frame_1.png -o all --set fit.bands=5 --overwrite)
cp -r all before
echo '{"years": 5}' >all/frames/thesis.json
expect_exit 3 "${other[@]}"
expect_stderr "thesis.json"
rm all/frames/thesis.json
echo years >all/frames/frame_1/thesis.tex
expect_exit 2 "${other[@]}"
expect_stderr "thesis.tex"
rm all/frames/frame_1/thesis.tex
echo years >thesis.csv
ln -sf ../thesis.csv all/sequence.csv
expect_exit 2 "${other[@]}"
expect_stderr "all/sequence.csv"
[[ $(cat thesis.csv) == years ]] || fail "a link was followed"
cp --remove-destination before/sequence.csv all/sequence.csv
diff -r all before >&2 || fail "the sequence was touched"
echo notes >all/notes.txt
expect_exit 0 "${other[@]}"
expect_different all/frames/frame_1/result.json before/frames/frame_1/result.json
[[ $(cat all/notes.txt) == notes ]] || fail "a note beside a sequence is gone"

expect_exit 2 sequence "$SCENES/fit.toml" --photos frame_1.png ./frame_1.png -o other
expect_stderr "'frame_1'"
printf 'frame_1.png soon\n' >bad.txt
expect_exit 3 sequence "$SCENES/fit.toml" --photos bad.txt -o other
expect_stderr "bad.txt:1"
expect_exit 3 sequence "$SCENES/fit.toml" --photos none.png -o other
[[ ! -e other ]] || fail "something was written"
