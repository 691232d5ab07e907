# What would take more memory than there may be is refused before the work, in little memory, and says how to need less; where
# memory ends all the same, that is told in words.
# shellcheck disable=SC2154  # stdout, stderr: of case.sh
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml fit=$SCENES/fit.toml
huge=(--set camera.width=65535 --set camera.height=65535)
expect_exit 0 render "$small" -o photo.png

# refused ARGUMENTS...: exit 2 with one message, and without even addresses for what it would take.
refused() {
  local status=0
  (ulimit -v 900000 && exec "$VEGARD" "$@" >"$stdout" 2>"$stderr") || status=$?
  [[ $status -eq 2 ]] || fail "exit $status instead of 2: vegard $*"
  expect_one_message
  expect_stderr "--memory-limit: "
  expect_stderr " would take about "
}
refused render "$small" -o no.png "${huge[@]}"
expect_stderr "65535 x 65535"
expect_stderr "camera.width | camera.height"
refused render "$small" -o no.exr "${huge[@]}" --memory-limit 16G
expect_stderr "16 GB"
refused animate "$small" -o no/##.png --frames 0:1 "${huge[@]}"
refused brightness "$small" "${huge[@]}"
refused fit "$fit" --photo photo.png --out no "${huge[@]}"
expect_stderr "fit.roi_px"
refused sequence "$fit" --photos photo.png -o no "${huge[@]}"
refused render "$small" -o no.png --set camera.width=2000 --set camera.height=1500 --memory-limit 200M
refused fit "$fit" --photo photo.png --out no --memory-limit 150M
refused volume "$small" -o no.vdb --set sheet.main.beams=20 --voxel 0.1 --memory-limit 10M
for word in none -3 3X 0 nan 1e30G; do
  expect_exit 2 render "$small" -o no.png --memory-limit "$word"
  expect_stderr "--memory-limit"
done

# Within the limit the picture is the same.
for limit in 200M 0.5 2GiB; do
  expect_exit 0 render "$small" -o "limited_$limit.png" --memory-limit "$limit"
  expect_same photo.png "limited_$limit.png"
done

# A fit that will take much says so before it begins: pixel by pixel, since large photographs are averaged.
expect_exit 2 fit "$fit" --photo photo.png --out no --set camera.width=6000 --set camera.height=4000 --set fit.average_rows=0 --memory-limit 3G
expect_stderr " would take about "
status=0
"$VEGARD" fit "$fit" --photo photo.png --out no --set camera.width=6000 --set camera.height=4000 --set fit.average_rows=0 --memory-limit 100G \
  >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 2 ]] || fail "a photograph of another size"
expect_stderr "6000 x 4000"

# Memory that ends in the middle of the work, on any thread.
for threads in 1 2; do
  status=0
  (ulimit -v 900000 && exec "$VEGARD" render "$small" -o no.png --set camera.width=6000 --set camera.height=4000 --set fit.average_rows=0 --memory-limit 100G \
    --threads $threads >"$stdout" 2>"$stderr") || status=$?
  [[ $status -eq 1 ]] || fail "exit $status instead of 1 without memory"
  expect_one_message
  expect_stderr "vegard render | camera.width"
done
rm -f limited_*
expect_only photo.png

# The estimate is not below what is taken, nor much above it.
[[ -x /usr/bin/time ]] || exit 0
for kind in png exr; do
  # The least limit that is accepted is the estimate, to 2 %.
  low=150 high=2000
  while ((high - low > low / 50)); do
    middle=$(((low + high) / 2))
    if "$VEGARD" render "$small" -o est.$kind --overwrite --set camera.width=2000 --set camera.height=1500 --set sheet.main.beams=1 \
      --set sheet.main.layers=1 --memory-limit "${middle}M" --threads 1 >/dev/null 2>&1; then high=$middle; else low=$middle; fi
  done
  taken=$(/usr/bin/time -f %M "$VEGARD" render "$small" -o est.$kind --overwrite --set camera.width=2000 --set camera.height=1500 \
    --set sheet.main.beams=60 --threads 1 2>&1 >/dev/null | tail -1)
  taken=$((taken / 1024))
  ((high * 100 >= taken * 98 && high * 100 <= taken * 135)) || fail "$kind: $high MB by the estimate, $taken MB taken"
done
