# A photograph or mask that cannot be used: exit 3, one message that names it, and no run.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.jpg
expect_exit 0 render "$SCENES/small.toml" -o other_size.png --set camera.width=80
expect_exit 0 render "$SCENES/small.toml" -o black.png --set 'sky.level=[0.0, 0.0, 0.0]' --set camera.azimuth_deg=180
head -c 1500 photo.jpg >truncated.jpg
: >empty.jpg
echo "not a picture" >words.jpg
for image in missing.jpg truncated.jpg empty.jpg words.jpg; do
  expect_exit 3 fit "$SCENES/fit.toml" --photo "$image" --out run
  expect_stderr "$image"
  expect_one_message
  expect_exit 3 profile "$image" -o profile.csv
  expect_stderr "$image"
done
for mask in missing.png other_size.png black.png; do
  expect_exit 3 fit "$SCENES/fit.toml" --photo photo.jpg --mask "$mask" --out run
  expect_stderr "$mask"
  expect_one_message
done
# A scene that does not belong to the photograph is the scene's mistake.
expect_exit 2 fit "$SCENES/fit.toml" --photo other_size.png --out run
expect_stderr "fit.toml:$(grep -n '^width =' "$SCENES/fit.toml" | cut -d: -f1): camera.width"
sed 's/^bands = .*/bands = 4\nroi_px = [100, 0, 100, 120]/' "$SCENES/fit.toml" >fit.toml
expect_exit 2 fit fit.toml --photo photo.jpg --out run
expect_stderr "fit.toml:$(grep -n '^roi_px' fit.toml | cut -d: -f1): fit.roi_px"
expect_exit 2 profile photo.jpg --scene fit.toml -o profile.csv
expect_stderr "fit.toml:$(grep -n '^roi_px' fit.toml | cut -d: -f1): fit.roi_px"
sed 's/^bands = .*/bands = 1000/' "$SCENES/fit.toml" >fit.toml
expect_exit 2 fit fit.toml --photo photo.jpg --out run
expect_stderr "fit.toml:$(grep -n '^bands' fit.toml | cut -d: -f1): fit.bands"
expect_exit 2 profile other_size.png --scene fit.toml -o profile.csv
expect_stderr "fit.toml:$(grep -n '^width =' fit.toml | cut -d: -f1): camera.width"
rm fit.toml
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.jpg --out run --set 'fit.roi_px=[100, 0, 100, 120]'
expect_stderr fit.roi_px
expect_exit 2 fit "$SCENES/small.toml" --photo photo.jpg --out run
expect_stderr fit.free
expect_only black.png empty.jpg other_size.png photo.jpg truncated.jpg words.jpg
