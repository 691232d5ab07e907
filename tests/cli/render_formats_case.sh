# Every kind of picture is written, and is what its name says.
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
