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
expect_only before.json photo.png precious run
