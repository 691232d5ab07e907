# What becomes of a picture: every kind is written and is what its name says, the same bytes on every run and for any number of
# threads; what exists is not replaced unless it is asked for; what cannot be written leaves nothing behind.
source "$(dirname "$0")/case.sh"
for name in a.exr a.png a.tif a.tiff a.jpg a.jpeg; do
  expect_exit 0 render "$SCENES/small.toml" -o "$name"
  expect_stdout "$name: 160 x 120 pixels"
  expect_stdout "deflection points, peak"
  expect_stdout "R at 557.7 nm"
  [[ ! -s $stderr ]] || fail "messages for a good run"
done
expect_starts a.exr 762f3101
expect_starts a.png 89504e470d0a1a0a
expect_starts a.tif 49492a00
expect_starts a.jpg ffd8ff
# Byte 24 of a PNG is its depth.
expect_exit 0 render "$SCENES/small.toml" -o b.png --bits 16
[[ $(od -An -tu1 -j24 -N1 a.png | tr -d ' ') -eq 8 ]] || fail "a.png is not of 8 bits"
[[ $(od -An -tu1 -j24 -N1 b.png | tr -d ' ') -eq 16 ]] || fail "b.png is not of 16 bits"
expect_exit 0 render "$SCENES/small.toml" -o coarse.jpg --quality 30
[[ $(wc -c <coarse.jpg) -lt $(wc -c <a.jpg) ]] || fail "a lower quality is no smaller"
expect_exit 0 render "$SCENES/small.toml" --lines lines.exr
[[ $(wc -c <lines.exr) -lt $(wc -c <a.exr) ]] || fail "the lines alone are no smaller than all"
# The header carries the scene, the seed, the version and the channels' names; the time is the scene's.
for text in 'vegard:scene' 'vegard:seed' 'vegard:version' 'energy_kev' 'rayleigh.5577' '2019:09:05 22:11:12'; do
  grep -qaF "$text" a.exr || fail "no '$text' in the header of a.exr"
done
! grep -qaF "$folder" a.exr || fail "a path is in the header"

# The same bytes for any number of threads and on every run.
for extension in exr png tif jpg; do
  for threads in 1 2; do
    expect_exit 0 render "$SCENES/small.toml" -o "$threads.$extension" --threads "$threads"
    expect_same "$threads.$extension" "a.$extension"
  done
done
rm -- *.exr *.png *.tif *.tiff *.jpg *.jpeg

# What exists is not replaced unless it is asked for.
echo precious >out.exr
expect_exit 2 render "$SCENES/small.toml" -o out.exr
expect_stderr "out.exr"
expect_stderr "--overwrite"
[[ $(cat out.exr) == precious ]] || fail "out.exr was touched"
expect_exit 2 render "$SCENES/small.toml" -o other.exr --lines out.exr
expect_only out.exr
expect_exit 0 render "$SCENES/small.toml" -o out.exr --overwrite
expect_starts out.exr 762f3101
expect_only out.exr
rm out.exr

# A folder that is missing, and a full disk (a limit on a file's size looks the same): exit 6, nothing left behind.
expect_exit 6 render "$SCENES/small.toml" -o no/such/folder/out.exr
expect_stderr "no/such/folder"
for name in out.exr out.png out.tif out.jpg; do
  status=0
  (ulimit -f 4 && exec "$VEGARD" render "$SCENES/small.toml" -o "$name" >"$stdout" 2>"$stderr") || status=$?
  [[ $status -eq 6 ]] || fail "exit $status instead of 6 for $name on a full disk"
  expect_stderr "$name"
done
# Two outputs appear both or not at all: the picture fits below the limit, the lines do not.
limit_kb=24
expect_exit 0 render "$SCENES/small.toml" -o out.jpg --quality 40 --lines lines.exr
[[ $(stat -c %s out.jpg) -lt $((limit_kb * 1024)) ]] || fail "the picture is too large for this case"
[[ $(stat -c %s lines.exr) -gt $((limit_kb * 1024)) ]] || fail "the lines are too small for this case"
rm out.jpg lines.exr
status=0
(ulimit -f "$limit_kb" && exec "$VEGARD" render "$SCENES/small.toml" -o out.jpg --quality 40 --lines lines.exr \
  >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 for lines on a full disk"
expect_stderr lines.exr
expect_only

# A sheet behind the camera: a dark picture, and a warning that says why.
expect_exit 0 render "$SCENES/small.toml" -o dark.png --set camera.azimuth_deg=180
expect_stderr "warning: no light"
expect_stderr "'main'"
expect_file dark.png
