# The same bytes for any number of threads and on every run.
source "$(dirname "$0")/case.sh"
for extension in exr png tif jpg; do
  expect_exit 0 render "$SCENES/small.toml" -o "one.$extension" --threads 1
  expect_exit 0 render "$SCENES/small.toml" -o "two.$extension" --threads 2
  expect_exit 0 render "$SCENES/small.toml" -o "again.$extension"
  expect_same "one.$extension" "two.$extension"
  expect_same "one.$extension" "again.$extension"
done
