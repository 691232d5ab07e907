# Elevation and roll from points on the horizon; the camera is a scene.
source "$(dirname "$0")/case.sh"
photo=$SOURCE/data/examples/h000/photo.jpg
# A level horizon through the middle, and 2 atan(1/2) = 53.13 degrees across: it is the axis' own height.
expect_exit 0 horizon --size 600,400 --points 100,200 500,200 --hfov 53.13 -o camera.toml
grep -q '^elevation_deg = 0.000000 ' camera.toml || fail "the horizon is not in the middle"
grep -q '^roll_deg = 0.000000 ' camera.toml || fail "the horizon is not level"
grep -q '^azimuth_deg = 0.000000  # assumed' camera.toml || fail "the azimuth is not marked as assumed"
expect_exit 0 render camera.toml -o camera.png --set camera.width=60 --set camera.height=40
# 600 px below the middle of a focal length of 600 px: 45 degrees.
expect_exit 0 horizon --size 600,1200 --points 300,1200 500,1200 --hfov 53.13010235 --azimuth 350
expect_stdout "camera.elevation_deg  45.0"
expect_stdout "350 (given)"
# By the 35 mm equivalent; a picture gives its size.
expect_exit 0 horizon "$photo" --points 100,300 600,310 --focal-35mm 24
expect_stdout "camera.hfov_deg       73.74"
# One message each.
for words in "--points 1,1" "--points 1,1 1,1" "--points 1,1 900,1" "--points 1,1 500,1x" "--points 300,1 300,399" \
  "--points 1,1 500,300 --sky 500,700 --sky 1,2" "--points 1,1 500,300 --fit-hfov"; do
  # shellcheck disable=SC2086  # the words are several
  expect_exit 2 horizon --size 600,400 --hfov 50 $words
  expect_one_message
done
expect_exit 2 horizon --points 1,1 500,1 --hfov 50
expect_stderr "--size"
expect_exit 2 horizon --size 600,400 --points 1,1 500,1
expect_stderr "straight horizon"
expect_exit 2 horizon "$photo" --points 1,1 500,1
expect_stderr "--hfov"
expect_exit 2 horizon --size 600,400 --points 100,200 500,200 --hfov 53 -o camera.toml
expect_stderr "--overwrite"
expect_exit 3 horizon nowhere.jpg --points 1,1 500,1 --hfov 50
# Any lens that a file has, wherever that points to. The horizon at an azimuth a from an axis 30 degrees high is, in the
# camera's axes, (sin a, cos a sin 30, cos a cos 30); r = 300 px theta.
printf '[camera]\nmodel = "equidistant"\nwidth = 600\nheight = 400\nfocal_px = 300.0\nelevation_deg = 77.0\nmirrored = true\n' >lens.toml
points=$(awk 'BEGIN { r = atan2(0, -1) / 180
  for (a = -40; a <= 40; a += 20) {
    x = sin(a * r); z = cos(a * r) * cos(30 * r); y = cos(a * r) * sin(30 * r)
    across = sqrt(x * x + y * y); theta = atan2(across, z)
    printf "%.4f,%.4f ", 300 - 300 * theta * x / across, 200 + 300 * theta * y / across } }')
# shellcheck disable=SC2086  # the points are several
expect_exit 0 horizon --size 600,400 --points $points --lens lens.toml -o by_lens.toml
grep -qE '^elevation_deg = (30.000|29.999)' by_lens.toml || fail "another elevation by a fisheye's horizon"
grep -qE '^roll_deg = -?0.000' by_lens.toml || fail "another roll by a fisheye's horizon"
grep -q '^model = "equidistant"' by_lens.toml || fail "another lens"
grep -q '^mirrored = true' by_lens.toml || fail "not mirrored"
grep -q '^focal_px = 300' by_lens.toml || fail "another scale"
# shellcheck disable=SC2086
expect_exit 2 horizon --size 600,401 --points $points --lens lens.toml
expect_stderr "--lens"
expect_exit 2 horizon --size 600,400 --points 1,1 500,1 --lens lens.toml --hfov 50
expect_one_message
