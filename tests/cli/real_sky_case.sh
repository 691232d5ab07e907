# The sky of a place and a time, and the ground below it.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
place=(--set site.latitude_deg=67.84 --set site.longitude_deg=20.41)
real=("${place[@]}" --set stars.shown=true --set stars.source=catalogue --set stars.planets=true --set moon.shown=true --set moon.skylight=true)
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T21:00:00Z --set ground.shown=true -o sky.png
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T21:00:00Z --set ground.shown=true -o again.png --threads 1
expect_same sky.png again.png
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T23:00:00Z --set ground.shown=true -o later.png
! cmp -s sky.png later.png || fail "two hours later the sky is the same"
# Nobody knows when, or where. Of a date alone the sky would be that of any hour.
for setting in moon.shown moon.skylight stars.planets stars.milky_way; do
  for time in "" 2012-03-08 1899-12-31T12:00:00Z 2201-01-01T12:00:00Z; do
    expect_exit 2 render "$small" "${place[@]}" --set "$setting=true" --set "site.time_utc=$time" -o no.png
    expect_one_message
    expect_stderr "site.time_utc"
    expect_stderr "1900 to 2200"
  done
  expect_exit 2 render "$small" --set "$setting=true" --set site.time_utc=2012-03-08T21:00:00Z -o no.png
  expect_one_message
  expect_stderr "site.longitude_deg"
done
# By day there is no twilight that was measured.
expect_exit 2 render "$small" --set twilight.shown=true --set twilight.sun=time "${place[@]}" --set site.time_utc=2012-06-21T12:00:00Z -o no.png
expect_one_message
expect_stderr "twilight.sun"
# Lux, for people and for programs.
expect_exit 0 brightness "$small"
expect_stdout "on level ground"
expect_exit 0 brightness "$small" --json
expect_stdout '"aurora_lx": '
expect_exit 0 brightness "$small" --set site.altitude_m=400000 --set camera.elevation_deg=-20
! grep -q "on level ground" "$stdout" || fail "there is ground in orbit"
expect_only sky.png again.png later.png
