# Pictures all around: sizes, what a panorama does not have, a movie's and an EXR's word of it.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
around=(--set camera.model=equirectangular --set camera.width=128 --set camera.height=64 --set camera.elevation_deg=0 --set camera.roll_deg=0)
expect_exit 0 render "$small" "${around[@]}" -o around.exr
expect_exit 0 render "$small" "${around[@]}" -o again.exr --threads 1
expect_same around.exr again.exr
grep -qa whiteLuminance around.exr || fail "no whiteLuminance in the EXR"
expect_exit 0 render "$small" -o flat.exr
! grep -qa whiteLuminance flat.exr || fail "a pinhole's EXR is not as it was"
for layout in cross:64x48 strip:96x16 grid:48x32; do
  size=${layout#*:}
  expect_exit 0 render "$small" --set camera.model=cube --set camera.cube_layout="${layout%:*}" --set camera.width="${size%x*}" \
    --set camera.height="${size#*x}" -o "${layout%:*}.png"
done
expect_exit 0 animate "$small" "${around[@]}" --frames 0:2 --set sheet.main.beams=40 -o around.mp4
grep -qa "GSpherical:ProjectionType>equirectangular" around.mp4 || fail "the movie does not say that it is a panorama"
grep -qa sv3d around.mp4 || fail "no second version of Spherical Video"
expect_exit 0 directions "$small" "${around[@]}" -o directions.exr
# What a panorama is not.
expect_exit 2 render "$small" "${around[@]}" --set camera.width=100 -o no.png
expect_one_message
expect_stderr "twice as wide"
expect_exit 2 render "$small" --set camera.model=cube --set camera.width=100 --set camera.height=100 -o no.png
expect_one_message
expect_stderr "4 faces | 3 high"
for setting in camera.k1=0.1 camera.principal_x_px=3 sensor.vignetting_cos_power=4 march.glow=0.1; do
  expect_exit 2 render "$small" "${around[@]}" --set "$setting" -o no.png
  expect_one_message
  expect_stderr "${setting%=*}"
done
expect_exit 0 render "$small" "${around[@]}" -o around.png
expect_exit 2 fit "$SCENES/fit.toml" --photo around.png "${around[@]}" --out run
expect_one_message
expect_stderr "panoramas"
expect_only around.exr again.exr flat.exr around.png cross.png strip.png grid.png around.mp4 directions.exr
