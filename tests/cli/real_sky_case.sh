# The sky of a place and a time.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
real=(--set stars.shown=true --set stars.source=catalogue --set stars.planets=true --set moon.shown=true --set moon.skylight=true)
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T21:00:00Z -o sky.png
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T21:00:00Z -o again.png --threads 1
expect_same sky.png again.png
expect_exit 0 render "$small" "${real[@]}" --set stars.milky_way=true --set site.time_utc=2012-03-08T23:00:00Z -o later.png
! cmp -s sky.png later.png || fail "two hours later the sky is the same"
# Nobody knows when.
for setting in moon.shown moon.skylight stars.planets stars.milky_way; do
  expect_exit 2 render "$small" --set "$setting=true" --set site.time_utc= -o no.png
  expect_one_message
  expect_stderr "site.time_utc"
done
# By day there is no twilight that was measured.
expect_exit 2 render "$small" --set twilight.shown=true --set twilight.sun=time --set site.time_utc=2012-06-21T12:00:00Z -o no.png
expect_one_message
expect_stderr "twilight.sun"
expect_only sky.png again.png later.png
