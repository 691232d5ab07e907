# The lower border of the light: its files, the same bytes again, and its refusals.
source "$(dirname "$0")/case.sh"
camera=(--set camera.width=360 --set camera.height=240)
expect_exit 0 render "$SCENES/map_light.toml" "${camera[@]}" -o photo.png
expect_exit 0 border "$SCENES/map.toml" "${camera[@]}" --photo photo.png --out run
for file in border.csv border.json border.svg report.html; do expect_file "run/$file"; done
expect_stdout "Trace 1: azimuths"
expect_stdout "105 km high"
grep -q '^trace,azimuth_deg,elevation_deg,elevation_error_deg,' run/border.csv || fail "another head of the table"
expect_exit 0 border "$SCENES/map.toml" "${camera[@]}" --photo photo.png --out again
for file in border.csv border.svg; do expect_same "run/$file" "again/$file"; done

# Nothing to trace is an answer, of exit code 5.
expect_exit 0 render "$SCENES/map.toml" "${camera[@]}" -o dark.png
expect_exit 5 border "$SCENES/map.toml" "${camera[@]}" --photo dark.png --out dark
expect_stdout "no lower border"

# Refusals.
expect_exit 2 border "$SCENES/map.toml" "${camera[@]}" --photo photo.png --out run
expect_one_message
expect_exit 2 border "$SCENES/map.toml" "${camera[@]}" --photo photo.png
expect_stderr "--out"
expect_exit 2 border "$SCENES/map.toml" "${camera[@]}" --out none
expect_stderr "--photo"
expect_exit 2 border "$SCENES/map.toml" --photo photo.png --no-metadata --out none
expect_one_message
echo thesis >run/thesis.tex
expect_exit 2 border "$SCENES/map.toml" "${camera[@]}" --photo photo.png --out run --overwrite
expect_stderr thesis.tex
