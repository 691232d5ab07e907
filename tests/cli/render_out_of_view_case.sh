# A sheet behind the camera: a dark picture, and a warning that says why.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o dark.png --set camera.azimuth_deg=180
expect_stderr "warning: no light"
expect_stderr "'main'"
expect_file dark.png
