# What is told of a scene's brightness: for people aligned, for programs as JSON; the same for any number of threads.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
expect_exit 0 brightness "$small"
[[ ! -s $stderr ]] || fail "messages for a good run"
for words in 'sheet main' 'IBC 1' 'kR of 557.7 nm, one layer' 'mean energy 6 keV' 'mW m⁻² at the peak' 'per km of arc' \
  'in the picture' 'pixel (' 'mag arcsec⁻²' 'to the eye' 'grey: rods see' 'how sure'; do
  expect_stdout "$words"
done
cp "$stdout" one.txt
expect_exit 0 brightness "$small" --threads 1
expect_same one.txt "$stdout"
# 5 mW m^-2 over 2 km sqrt(2 pi) and 3 layers of 330 km: 24.8 MW.
expect_stdout "75.2 kW per km | 24.8 MW"
expect_exit 0 brightness "$small" --json --set sheet.main.brightness_kilorayleigh=100 --set time.exposure_s=2
for words in '"class": "IBC 3"' '"luminance_cd_m2": ' '"relative_uncertainty": null'; do expect_stdout "$words"; done
# Nothing in view, nothing luminous: no numbers that are none.
expect_exit 0 brightness "$small" --set camera.azimuth_deg=180
expect_stderr "no light"
expect_stdout "dark"
expect_exit 0 brightness "$small" --set camera.azimuth_deg=180 --json
grep -q '"magnitudes_per_square_arcsecond": null' "$stdout" || fail "a magnitude of darkness"
# Points of unit weight are no rayleighs.
expect_exit 2 brightness "$small" --set film.weight=unit
expect_one_message
expect_stderr "film.weight"
expect_exit 2 brightness
expect_only one.txt
