# A picture as the eye sees it: another than the camera's, whatever the sensor's gain; display pictures only.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
expect_exit 0 render "$small" -o camera.png
expect_exit 0 render "$small" -o eye.png --as-seen
expect_different camera.png eye.png
expect_exit 0 render "$small" -o same.png --as-seen --seen-half 20 --threads 1
expect_same eye.png same.png
expect_exit 0 render "$small" -o darker.jpg --as-seen --seen-half 2000
expect_exit 0 render "$small" -o eye.tif --as-seen --lines lines.exr
expect_exit 2 render "$small" -o eye.exr --as-seen
expect_one_message
expect_stderr "--as-seen"
expect_exit 2 render "$small" --lines only.exr --as-seen
expect_stderr "--as-seen"
expect_exit 2 render "$small" -o no.png --seen-half 5
expect_exit 2 render "$small" -o no.png --as-seen --seen-half 0
expect_exit 2 render "$small" -o no.png --as-seen --set film.weight=unit
expect_one_message
expect_stderr "film.weight"
expect_only camera.png eye.png same.png darker.jpg eye.tif lines.exr
