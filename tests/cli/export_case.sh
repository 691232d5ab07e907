# A scene as a page: written whole, the same bytes again, from other words; what cannot be shown is refused by name.
# That it shows the scene's light is tests/browser/live.py.
source "$(dirname "$0")/case.sh"
sed 's/^length_km = .*/length_km = 30.0/' "$SCENES/small.toml" >small.toml
small=small.toml
expect_exit 0 export "$small" --web small.html
expect_stdout "small.html: 1"
expect_stdout "left out"
grep -q '"lines_nm":\[630.0,557.7,427.8\]' small.html || fail "the page has the scene's lines"
grep -qE 'src=|href="http|^import ' small.html && fail "the page loads something"
expect_exit 0 export "$small" --web again.html --threads 1
expect_same small.html again.html
expect_exit 0 export "$small" --web other.html --set sheet.main.energy_kev=5
expect_different small.html other.html
expect_exit 0 export "$small" --web time.html --seconds 10 --instants 2 --set sheet.main.ray_contrast=0.5 --set sheet.main.ray_speed_km_s=2
grep -q '"step_s":10.0' time.html || fail "the page has instants"
# Refused: an output that exists, the scene itself, another kind of file, and what no page shows.
expect_exit 2 export "$small" --web small.html
expect_stderr "small.html"
expect_exit 0 export "$small" --web small.html --overwrite
expect_exit 2 export "$small" --web small.png
expect_stderr "--web | .html"
expect_exit 2 export "$small"
expect_stderr "--web"
expect_exit 6 export "$small" --web no/such/folder.html
expect_exit 2 export "$SOURCE/data/gallery/crab.toml" --web crab.html
expect_stderr "nebula"
expect_one_message
expect_exit 2 export "$small" --web no.html --set blur.model=physical
expect_stderr "blur.model"
expect_one_message
# The map of a measured photograph, by the camera of its run.
mkdir run
printf '%s\n' '[site]' 'latitude_deg = 67.0' '[camera]' 'width = 96' 'height = 64' 'hfov_deg = 60' 'elevation_deg = 33' >run/camera.toml
mkdir run/map
python3 - <<'END'
import struct
cards = ["SIMPLE  = T", "BITPIX  = -32", "NAXIS   = 3", "NAXIS1  = 20", "NAXIS2  = 20", "NAXIS3  = 2", "CTYPE1  = 'EAST'", "CUNIT1  = 'km'",
  "CRPIX1  = 1.0", "CRVAL1  = -20.0", "CDELT1  = 2.0", "CTYPE2  = 'NORTH'", "CUNIT2  = 'km'", "CRPIX2  = 1.0", "CRVAL2  = 180.0",
  "CDELT2  = 2.0", "SITELAT = 67.0", "SITELONG= 0.0", "END"]
header = "".join(card.ljust(80) for card in cards).ljust(2880)
data = struct.pack(">800f", *[5.0] * 400, *[3.0] * 400).ljust(2880 * 2, b"\0")
open("run/map/precipitation.fits", "wb").write(header.encode() + data)
END
expect_exit 0 export run --web run.html
expect_stdout "run.html: 1"
expect_exit 2 export run --web no.html --set camera.width=3
mkdir empty
expect_exit 3 export empty --web no.html
expect_stderr "empty | map/precipitation.fits"
expect_one_message
rm -r run empty run.html
expect_only small.toml small.html again.html other.html time.html
