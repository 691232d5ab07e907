# A small fit that finds what the picture was made from: exit 0, a whole run, the same for any number of threads.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out runs/one --threads 1
expect_stdout "Believable"
expect_stdout "sheet.main.energy_kev"
expect_stdout "runs/one/report.html"
[[ $(wc -l <"$stderr") -lt 20 ]] || fail "more than a line a stage"
found=$(find runs/one -mindepth 1 -printf '%f\n' | LC_ALL=C sort | xargs)
[[ $found == "best.toml map.svg model.exr profiles.csv report.html residual.exr result.json trace.csv" ]] ||
  fail "the run holds: $found"
for text in '"verdict": "good"' '"termination": "converged: ' '(Ceres: ' '"role": "photo"' '"name": "photo.png"' '"seed": 7' \
  "\"sha256\": \"$(sha256sum photo.png | cut -d' ' -f1)\"" "\"sha256\": \"$(sha256sum "$SCENES/fit.toml" | cut -d' ' -f1)\"" \
  '"command": "vegard fit '; do
  grep -qF -- "$text" runs/one/result.json || fail "no '$text' in result.json"
done
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out runs/two --threads 2
for file in profiles.csv trace.csv map.svg model.exr residual.exr; do expect_same "runs/one/$file" "runs/two/$file"; done
diff <(grep -v '"command"' runs/one/result.json) <(grep -v '"command"' runs/two/result.json) >&2 ||
  fail "result.json depends on the threads"
# The best scene is a scene, and its picture is close to the one that was fitted.
expect_exit 0 render runs/one/best.toml -o best.png
expect_exit 0 params runs/one/best.toml
# A mask that lets all through is an input too.
expect_exit 0 render "$SCENES/small.toml" -o white.png --set 'sky.level=[1.0, 1.0, 1.0]'
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --mask white.png --out runs/masked
grep -qF '"role": "mask"' runs/masked/result.json || fail "the mask is no input"
