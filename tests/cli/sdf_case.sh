# The distance field of a picture: into every format, with and without a sign, and what is refused.
source "$(dirname "$0")/case.sh"
photo=$SOURCE/data/examples/h000/photo.jpg
expect_exit 0 sdf "$photo" -o field.exr --threshold 0.3
expect_stdout "field.exr: 720 x 480 pixels"
expect_stdout "distances from 0.00 to"
expect_starts field.exr 762f3101
expect_exit 0 sdf "$photo" -o signed.exr --threshold 0.3 --signed
expect_stdout "distances from -"
expect_exit 0 sdf "$photo" -o wrapped.exr --threshold 0.3 --wrap
expect_different field.exr wrapped.exr
expect_exit 0 sdf "$photo" -o field.png --threshold 0.3 --spread 100
expect_starts field.png 89504e470d0a1a0a
expect_exit 0 sdf "$photo" -o again.exr --threshold 0.3 --unsigned
expect_same field.exr again.exr
# Refused: no spread, an output that exists, an input as the output, nothing bright, no picture.
expect_exit 2 sdf "$photo" -o no.png --threshold 0.3
expect_stderr "--spread"
expect_one_message
for spread in inf nan -4 0; do
  expect_exit 2 sdf "$photo" -o no.png --threshold 0.3 --spread=$spread
  expect_stderr "0.01 to 1000000"
  expect_one_message
done
expect_exit 2 sdf "$photo" -o no.exr --threshold 0.3 --spread 100
expect_stderr "--spread"
expect_one_message
# An output that exists or cannot be, before the picture is even looked for.
expect_exit 2 sdf none.png -o field.exr
expect_stderr "field.exr"
expect_exit 6 sdf none.png -o no/such/folder/out.exr
expect_exit 2 sdf "$photo" -o no.exr --threshold 0.999
expect_stderr "threshold"
expect_exit 2 sdf "$photo" -o no.exr --threshold 2
expect_one_message
expect_exit 3 sdf none.png -o no.exr
expect_one_message
expect_exit 2 sdf "$photo" -o field.exr --threshold 0.3
expect_stderr "field.exr"
expect_exit 0 sdf "$photo" -o field.exr --threshold 0.3 --overwrite
expect_only field.exr signed.exr wrapped.exr field.png again.exr
