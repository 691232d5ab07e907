# A run that exists is refused before the work, and replaced whole with --overwrite; what is no run never is.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out run
cp run/result.json before.json
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out run --set sheet.main.beams=3000000
expect_stderr "run"
expect_stderr "--overwrite"
expect_one_message
expect_same run/result.json before.json
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out run --overwrite
expect_different run/result.json before.json
mkdir precious
echo precious >precious/words
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out precious --overwrite
[[ $(cat precious/words) == precious ]] || fail "a folder that is no run was touched"
# What is not vegard's beside a run's own files is named, and stays, with the run.
cp -r run kept
echo years >run/thesis.tex
mkdir run/model
ln -s ../photo.png run/mine.png
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out run --overwrite
expect_stderr "mine.png (a link) | model (a folder) | thesis.tex"
expect_one_message
[[ $(cat run/thesis.tex) == years && -d run/model && -L run/mine.png ]] || fail "something of the user's is gone"
rm -r run/thesis.tex run/model run/mine.png
diff -r run kept >&2 || fail "the run was touched"
# A result.json of another program, or an empty one, makes no run.
for text in "" "{}" '{"verdict": "guilty"}' "[1, 2]"; do
  mkdir -p court
  printf '%s' "$text" >court/result.json
  echo years >court/thesis.tex
  expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out court --overwrite
  expect_stderr "not a run"
  expect_one_message
  [[ $(cat court/thesis.tex) == years ]] || fail "a thesis is gone"
  [[ $(cat court/result.json) == "$text" ]] || fail "another program's file is gone"
done
# It is not replaced under the feet of whoever stands in it.
(cd run && expect_exit 2 fit "$SCENES/fit.toml" --photo ../photo.png --out . --overwrite)
expect_stderr "current folder"
diff -r run kept >&2 || fail "the run was touched"
rm -r kept court
# A run is not replaced, and no sequence begun, where an input of theirs lies.
cp photo.png run/arc.png
cp "$SCENES/fit.toml" volume.toml
printf '[[footprint]]\nsource = "image"\nimage = "run/arc.png"\n' >>volume.toml
cp photo.png run/mine.png
cp "$SCENES/fit.toml" run/mine.toml
expect_exit 0 render "$SCENES/small.toml" -o run/white.png --set "sky.level=[50, 50, 50]"
refused() {
  expect_exit 2 "$@"
  expect_stderr "--out"
  expect_stderr "lies in it"
  expect_one_message
  expect_same run/arc.png photo.png
  expect_same run/mine.png photo.png
  expect_file run/white.png
  expect_same run/mine.toml "$SCENES/fit.toml"
}
refused fit volume.toml --photo photo.png --out run --overwrite
refused fit "$SCENES/fit.toml" --photo run/mine.png --out run --overwrite
refused fit "$SCENES/fit.toml" --photo photo.png --mask run/white.png --out run --overwrite
refused fit run/mine.toml --photo photo.png --out run --overwrite
refused sequence volume.toml --photos photo.png -o run --overwrite
refused sequence "$SCENES/fit.toml" --photos run/mine.png -o run --overwrite
rm volume.toml
expect_only before.json photo.png precious run
