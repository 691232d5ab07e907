# A movie: resumable frames in a folder beside it, which is gone when the movie is there.
source "$(dirname "$0")/case.sh"
options=(--set "sheet.main.drift_km_s=[20.0, 0.0]" --set sheet.main.beams=40 --frames 0:5 --fps 12.5)
small=$SCENES/small.toml
expect_exit 0 animate "$small" "${options[@]}" -o movie.mp4 --camera-json
expect_stdout "6 frames | 160 x 120 | 12.5 per second"
[[ $(head -c 8 movie.mp4 | tail -c 4) == ftyp ]] || fail "movie.mp4 is no MP4"
expect_only movie.mp4 movie.camera.json
# The same again is the same, and nothing is replaced unasked.
expect_exit 0 animate "$small" "${options[@]}" -o again.mp4 --threads 1
expect_same movie.mp4 again.mp4
expect_exit 2 animate "$small" "${options[@]}" -o movie.mp4
expect_stderr "--overwrite"
expect_same movie.mp4 again.mp4
rm again.mp4
# Frames that are there are used, if they are of this movie.
echo "no movie" >movie.mp4
expect_exit 0 animate "$small" "${options[@]}" -o movie.mp4.frames/########.png
mv movie.mp4.frames/00000003.png kept.png
expect_exit 0 animate "$small" "${options[@]}" -o movie.mp4 --overwrite
expect_only movie.mp4 movie.camera.json kept.png
# Those of a longer movie that was interrupted are left for it.
expect_exit 0 animate "$small" "${options[@]}" -o long.mp4.frames/########.png
few=("${options[@]:0:4}" --fps 12.5)
expect_exit 0 animate "$small" "${few[@]}" -o long.mp4 --frames 0:3
(cd long.mp4.frames && expect_only 00000004.png 00000005.png animation.json)
expect_exit 0 animate "$small" "${few[@]}" -o long.mp4 --frames 4:5 --overwrite
expect_only long.mp4 movie.mp4 movie.camera.json kept.png
rm long.mp4
# Odd sizes, and options of pictures.
expect_exit 2 animate "$small" "${options[@]}" -o odd.mp4 --set camera.width=161
expect_stderr "camera.width=162"
expect_exit 2 animate "$small" "${options[@]}" -o odd.mp4 --bits 16
expect_exit 2 animate "$small" "${options[@]}" -o odd.mp4 --quality 101
expect_only movie.mp4 movie.camera.json kept.png
# For programs that cut and grade: ten bits, which are made from frames of sixteen.
expect_exit 0 animate "$small" "${options[@]}" -o graded.mov
expect_stdout "6 frames | ProRes 422 HQ"
[[ $(head -c 12 graded.mov | tail -c 8) == "ftypqt  " ]] || fail "graded.mov is no QuickTime"
rm graded.mov
expect_exit 0 animate "$small" "${options[@]}" -o graded.mov.frames/########.png
expect_exit 2 animate "$small" "${options[@]}" -o graded.mov # these have eight
rm -r graded.mov.frames
for option in "--bits 16" "--quality 50"; do
  expect_exit 2 animate "$small" "${options[@]}" -o graded.mov $option
  expect_one_message
done
expect_only movie.mp4 movie.camera.json kept.png
# A movie has a quality, which its frames do not depend on: those of a rough movie do for a fine one.
expect_exit 0 animate "$small" "${options[@]}" -o rough.mp4.frames/########.png
expect_exit 0 animate "$small" "${options[@]}" -o rough.mp4 --quality 20
expect_stdout "6 frames"
(($(stat -c %s rough.mp4) < $(stat -c %s movie.mp4))) || fail "a rough movie is no smaller"
rm rough.mp4
# A missing folder is made, unless it cannot be.
expect_exit 0 animate "$small" "${options[@]}" -o no/such/folder/movie.mp4
expect_same no/such/folder/movie.mp4 movie.mp4
for folder in kept.png kept.png/deeper; do
  expect_exit 6 animate "$small" "${options[@]}" -o "$folder/movie.mp4"
  expect_one_message
done
expect_only movie.mp4 movie.camera.json kept.png no
