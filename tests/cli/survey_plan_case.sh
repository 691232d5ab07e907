# A plan of a survey: its file, the same bytes wherever it is made from, and its refusals.
source "$(dirname "$0")/case.sh"
mkdir -p night/a other
for i in 0 1 2; do cp "$SCENES/fit.toml" "night/a/20190301_22100$i.png"; done # no frame is opened
cp "$SCENES/fit.toml" night/scene.toml
cat >night/survey.toml <<'TOML'
[survey]
name = "night"
work = ["border", "fit"]
scene = "scene.toml"
block_frames = 2
[[camera]]
name = "a"
frames = ["a", "b.txt"]
[[skip]]
until = "2019-03-01T22:10:01Z"
reason = "a lamp"
TOML
printf '# not there yet\nb/frame.pgm#7 2019-03-01T22:10:02.5Z\n' >night/b.txt
expect_exit 0 survey plan night/survey.toml -o plan.json
expect_stdout "1 camera | 4 frames | 1 skipped | 2 blocks | 7 s | 1 shard"
grep -q '"folder": "night"' plan.json || fail "another folder"
grep -qF '["a/20190301_221000.png",1551478200.0,"a lamp"]' plan.json || fail "no row of the first frame"
grep -qF '["b/frame.pgm#7",1551478202.5]' plan.json || fail "no row of the last frame"
(cd night && "$VEGARD" survey plan survey.toml -o ../again.json >/dev/null)
expect_same plan.json again.json

# Refusals.
sed 's/"name": "night"/"name": "night; true"/' plan.json >named.json # names go into scripts
! cmp -s plan.json named.json || fail "the name is not where it was"
expect_exit 3 survey run named.json --out named
expect_one_message
expect_exit 2 survey plan night/survey.toml -o plan.json
expect_one_message
expect_exit 0 survey plan night/survey.toml -o plan.json --overwrite
expect_exit 2 survey plan night/survey.toml -o night/scene.toml --overwrite
expect_stderr "camera a"
expect_exit 3 survey plan night/none.toml -o none.json
expect_exit 2 survey
expect_stderr "which subcommand"
expect_exit 2 survey plna
expect_stderr "did you mean 'plan'?"
expect_exit 2 survey plan night/survey.toml --outptu none.json
expect_stderr "did you mean '--output'?"
sed -i 's/^free = .*/free = []/' night/scene.toml
expect_exit 2 survey plan night/survey.toml -o none.json
expect_stderr "fit.free: nothing is free"
sed -i 's/block_frames/block_frame/' night/survey.toml
expect_exit 2 survey plan night/survey.toml -o none.json
expect_stderr "night/survey.toml:5"
expect_one_message
[[ ! -e none.json ]] || fail "something was written"
