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
for file in sequence.csv sequence.svg sequence.json frames/frame_1.json frames/frame_3/report.html; do
  expect_file "all/$file"
done
[[ $(grep -c '^frame_' all/sequence.csv) -eq 3 ]] || fail "not three rows"
grep -q '^frame_2,2.5,good,warm,' all/sequence.csv || fail "no row of the second frame"

# As if killed before the last frame was done: the others are not fitted again.
cp -r all resumed
rm resumed/frames/frame_3.json
stamp=$(stat -c %Y.%i resumed/frames/frame_2/result.json)
expect_exit 0 sequence "$SCENES/fit.toml" --photos list.txt -o resumed
expect_stdout "frame_2: good (done before)"
[[ $(stat -c %Y.%i resumed/frames/frame_2/result.json) == "$stamp" ]] || fail "a finished frame was fitted again"
for file in sequence.csv sequence.svg sequence.json frames/frame_3.json frames/frame_3/profiles.csv; do
  expect_same "all/$file" "resumed/$file"
done

# Another scene is another sequence.
expect_exit 2 sequence "$SCENES/fit.toml" --photos list.txt -o all --set fit.bands=5
expect_stderr "is of another sequence, scene or version"
expect_exit 2 sequence "$SCENES/fit.toml" --photos frame_1.png ./frame_1.png -o other
expect_stderr "two photographs are called 'frame_1'"
printf 'frame_1.png soon\n' >bad.txt
expect_exit 3 sequence "$SCENES/fit.toml" --photos bad.txt -o other
expect_stderr "bad.txt:1"
expect_exit 3 sequence "$SCENES/fit.toml" --photos none.png -o other
[[ ! -e other ]] || fail "something was written"
