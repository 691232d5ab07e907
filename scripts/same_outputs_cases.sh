# shellcheck shell=bash disable=SC2154  # quick: of same_outputs.sh
# The calls that same_outputs.sh compares. Sourced in the folder to write, where inputs/ has the scenes. `run NAME ARGUMENTS...` is one
# call, `run_fit` may end with a verdict, `run_refused` must be refused. Sizes are small: what counts is that each way through the
# program is gone once, and what comes out of it kept. Where --quick leaves something out, another call goes nearly the same way.

small=inputs/scenes/small.toml
fit=inputs/scenes/fit.toml
loop=inputs/scenes/loop.toml
photo=inputs/examples/h000/photo.jpg
all_of() { ! $quick; }

# --- Words ---------------------------------------------------------------------------------------------------------------------------
run help --help
mapfile -t commands < <(sed -n '/^Exit codes:/q; s/^  \([a-z][a-z-]*\) .*/\1/p' logs/help.stdout)
((${#commands[@]} > 30)) || refuse "the help has ${#commands[@]} subcommands"
for command in "${commands[@]}"; do
  all_of || [[ $command == fit || $command == render ]] || continue
  run "help_$command" "$command" --help
done
run params params
run params_page params --markdown
run params_forms params --forms
run params_scene params inputs/gallery/sun_171.toml
run params_fit params inputs/examples/h000/blind.toml
run bodies bodies
run lines lines
run lines_page lines --markdown
run lines_table lines --csv
run lines_plot lines --quenching out/quenching.svg
run lines_plot_png lines --quenching out/quenching.png
run atmosphere atmosphere --conditions winter_quiet -o out/atmosphere.csv --plot out/atmosphere.svg
run electrons electrons --energy-kev 2 -o out/electrons.csv --plot out/electrons.svg
run invert invert --line 427.8=2300±50 --line 557.7=9000±200 --line 630.0=330±15 -o out/invert.json --plot out/invert.svg

# --- What is refused: the messages, and the hints in them ----------------------------------------------------------------------------
run_refused no_command rendre
run_refused no_output render $small
run_refused no_option render $small -o out/no.png --no-such-option
run_refused no_scene render missing.toml -o out/no.png
run_refused no_key render $small -o out/no.png --set sheet.main.energy_kevv=3
run_refused no_number render $small -o out/no.png --set sheet.main.energy_kev=three
run_refused below_limit render $small -o out/no.png --set sheet.main.energy_kev=-3
run_refused no_kind render $small -o out/no.gif
run_refused no_photo fit $fit --photo missing.png --out out/no
sed 's/^\[camera\]/[kamera]/' $small >inputs/kamera.toml
run_refused unknown_table render inputs/kamera.toml -o out/no.png
i=0
for free in sheet.main.beams sheet.other.energy_kev sheet.main.energy_spread sheet.main.peak_km blur.width_deg.6563 camera.width \
  site.latitude_deg; do
  sed "s/^free = .*/free = [\"$free\"]/" $fit >"inputs/free_$i.toml"
  run_refused "free_$free" fit "inputs/free_$i.toml" --photo $photo --out out/no
  i=$((i + 1))
done

# --- Pictures ------------------------------------------------------------------------------------------------------------------------
# The gallery with fewer pixels and beams: a display picture, the lines, and all layers.
gallery_options() { # NAME: sets options
  local sheet
  options=(--set camera.width=120 --set camera.height=80 --set camera.focal_px=38)
  if grep -q '"equirectangular"' "inputs/gallery/$1.toml"; then options=(--set camera.width=120 --set camera.height=60); fi
  while read -r sheet; do options+=(--set "sheet.$sheet.beams_per_km=4"); done < <(
    awk '/^\[/ { sheet = /^\[\[sheet\]\]/ } sheet && /^name = / { gsub(/"/, ""); print $3 }' "inputs/gallery/$1.toml"
  )
}
for scene in inputs/gallery/*.toml; do
  name=$(basename "$scene" .toml)
  case $name in
    all_sky | band | corona | crab | diffuse_patches | dusk | footprint_bands | from_orbit | solar_corona | sun_171 | trifid) ;;
    *) all_of || continue ;;
  esac
  gallery_options "$name"
  run "gallery_$name" render "$scene" "${options[@]}" -o "out/gallery_$name.png" --lines "out/gallery_$name.lines.exr"
  all_of || continue
  run "gallery_layers_$name" render "$scene" "${options[@]}" -o "out/gallery_$name.exr" --layers sheets
  run "gallery_brightness_$name" brightness "$scene" "${options[@]}" --json
done

# One small scene in every format, and by every switch of the simulator.
picture() { # NAME ARGUMENTS...: of small.toml, as linear light and as a display picture
  local name=$1
  shift
  run "render_$name" render $small "$@" -o "out/render_$name.png" --lines "out/render_$name.lines.exr"
}
picture plain
for name in a.exr a.tif a.jpg; do run "format_$name" render $small -o "out/format_$name"; done
run format_16 render $small -o out/format_16.png --bits 16
run format_coarse render $small -o out/format_coarse.jpg --quality 30
run layers render $small -o out/layers.exr --layers sheets --camera-json --set stars.shown=true --set 'sky.curvature=[0.01, 0.02, 0.03]'
run as_seen render $small -o out/as_seen.png --as-seen
run photograph render $small -o out/photograph.png --photograph --set 'sensor.exposure="camera"' --set time.exposure_s=8 \
  --set sensor.vignetting_cos_power=4
run photograph_exr render $small -o out/photograph.exr --photograph --set 'sensor.response="nikon_d200"' \
  --set 'sensor.matrix_rule="colorimetric"' --set 'sensor.white_balance_rule="daylight"'
run raw render $small --raw out/raw.png
run dark render $small -o out/dark.png --set camera.azimuth_deg=180
picture physical_blur --set 'blur.model="physical"' --set 'blur.wind_m_s=[100, -50]'
picture paper --set 'blur.kernel="paper"' --set 'film.splat="nearest"' --set 'film.weight="unit"' \
  --set 'sheet.main.spacing_rule="literal"' --set 'sheet.main.pitch_law="product"'
picture dipole --set 'field.model="dipole"' --set 'emission.flux_law="linear"' --set 'sheet.main.spacing_rule="tied"'
picture moving --set time.start_s=12.5 --set time.exposure_s=0.5 --set time.instants=3 --set 'sheet.main.drift_km_s=[2, -1]' \
  --set sheet.main.sine_speed_km_s=8.5 --set substorm.quiet=0.2
picture textured --set sheet.main.fold_spacing_km=40 --set sheet.main.curl_spacing_km=8 --set sheet.main.ray_contrast=0.5 \
  --set sheet.main.patch_size_km=20 --set sheet.main.border_amplitude_km=3 --set sheet.main.arcs=2
picture fisheye --set 'camera.model="equidistant"' --set camera.focal_px=55 --set camera.elevation_deg=80 --set camera.roll_deg=20
picture night --set 'air.model="standard"' --set airglow.green_rayleigh=200 --set twilight.shown=true \
  --set light_pollution.luminance_mcd_m2=1 --set stars.shown=true
for profile in mono gaussian form spline; do
  picture "profile_$profile" --set "sheet.main.profile=\"$profile\""
done
picture brightness --set sheet.main.brightness_kilorayleigh=20 --set 'sheet.main.step_rule="energy"'
run drawn render inputs/examples/drawn/scene.toml --set camera.width=160 --set camera.height=107 --set sheet.arc.beams_per_km=8 \
  -o out/drawn.png --lines out/drawn.lines.exr
run curtain render inputs/examples/curtain/scene.toml --set camera.width=224 --set camera.height=126 --set sheet.main.beams=100 \
  --set sheet.far.beams=100 -o out/curtain.png --lines out/curtain.lines.exr

# Everything that marches, in one scene: footprints before a sheet, behind them a picture's depth.
{
  cat $small
  printf '[[footprint]]\nname = "arc"\neast_km = [-60.0, 0.0, 60.0]\nnorth_km = [150.0, 160.0, 150.0]\n'
  printf '[[footprint]]\nname = "foot"\nsource = "sheets"\n'
} >inputs/footprints.toml
run footprints render inputs/footprints.toml -o out/footprints.exr
run footprints_add render inputs/footprints.toml -o out/footprints_add.png --set march.blend=add --set march.shrink=2 \
  --set march.smooth_px=1 --set march.glow=0.2

# An ejection of each kind, before a corona; also in time.
cat >inputs/ejections.toml <<'TOML'
seed = 3
[emission]
lines = [656.3, 560.0]
[camera]
width = 90
height = 80
hfov_deg = 1.6
azimuth_deg = 180
elevation_deg = 45
[sun]
shown = true
azimuth_deg = 180
elevation_deg = 45
photosphere_rayleigh = [50, 50]
[[corona]]
name = "quiet"
share = [1.0]
power = [6.0]
reach = 4
rayleigh = [0.2, 2]
[[ejection]]
name = "rope"
latitude_deg = 15
longitude_deg = 80
width_deg = 35
start_height = 100
strands = 12
rayleigh = [60, 30]
[[ejection]]
name = "shell"
kind = "shell"
latitude_deg = -30
longitude_deg = -70
width_deg = 50
start_height = 200
rayleigh = [0, 10]
[blur]
width_deg = [0.004, 0.004]
[sensor]
response = "grey"
colour_table = "304"
gain_per_kilorayleigh = 0.1
TOML
run ejections render inputs/ejections.toml -o out/ejections.png --lines out/ejections.lines.exr
run ejections_grey render inputs/ejections.toml -o out/ejections_grey.png --set 'sensor.colour_table="none"'
run ejections_animated animate inputs/ejections.toml -o out/ejections/##.png --frames 0:2 --fps 0.01

# --- In motion -----------------------------------------------------------------------------------------------------------------------
gallery_options dance
run dance animate inputs/gallery/dance.toml "${options[@]}" -o out/dance/####.png --frames 0:40:20 --camera-json
run dance_list animate inputs/gallery/dance.toml -o out/none##.png --frames 0:5 --list
run dance_movie animate inputs/gallery/dance.toml "${options[@]}" -o out/dance.mp4 --frames 0:5
run preview preview $small -o out/preview --frames 3 --turn 12 --size 80x80
run preview_fast preview $small -o out/preview_fast --frames 2 --size 80x80 --points 5e3 --run --fps 2

# --- Light for other programs --------------------------------------------------------------------------------------------------------
run points points $small -o out/points.ply --set sheet.main.beams=20
run export export $small --web out/small.html
run points_table points $small -o out/points.csv --max-points 10000 --unit m
run volume volume $small -o out/volume.vdb --voxel-km 4
run volume_houdini volume $small -o out/houdini.vdb --voxel-km 4 --lines 557.7 --for houdini
run volume_foot volume inputs/footprints.toml -o out/foot.vdb --voxel-km 4 --of foot
run volume_ejections volume inputs/ejections.toml -o out/ejections.vdb --voxel 20 --of shell
run volume_rope volume inputs/ejections.toml -o out/rope.vdb --of rope --voxel 1.4
run grid_text grid out/volume.vdb -o out/volume.txt --channel density --blur 2 --sharpen 1
run grid_back grid out/volume.txt -o out/volume_back.vdb
run slices slices $small -o out/slices.svg --voxel 8
run slices_png slices out/rope.vdb -o out/slices.png --log --colours gold --count 4 --along x
run slices_loop slices inputs/gallery/solar_corona.toml -o out/slices_loop.png --of low --voxel 0.5
{
  sed '/^\[\[sheet\]\]/,/^$/d' $small
  printf '[[volume]]\nname = "band"\nfile = "../out/volume.vdb"\n'
} >inputs/seen.toml
run volume_seen render inputs/seen.toml -o out/seen.png --lines out/seen.lines.exr

# --- What photographs say ------------------------------------------------------------------------------------------------------------
run describe describe $photo -o out/describe.toml
run profile profile $photo -o out/profile.csv --plot out/profile.svg
run profile_scene profile $photo -o out/profile_scene.csv --scene inputs/examples/h000/scene.toml --roi 100,50,500,400 --lines
run profile_plot profile $photo -o out/profile_few.csv --bands 3 --plot out/profile.png --decoding gamma:2.2
run profile_directions profile $photo -o out/profile_directions.csv --scene inputs/examples/h000/scene.toml --azimuths 350,0,10 \
  --elevation-step 2
run mask mask $photo -o out/mask.png --polygon 0,0 100,0 0,100 --circle 360,240,400 --horizon 0,400 719,420 \
  --horizon-csv out/mask.csv --stars --hot --text --saturated --show out/mask_shown.png
run profile_masked profile $photo -o out/profile_masked.csv --mask out/mask.png
run sdf sdf $photo -o out/sdf.exr --threshold 0.3 --signed
run sdf_png sdf $photo -o out/sdf.png --threshold 0.3 --spread 100
run directions directions $small -o out/directions.exr
run directions_fits directions $small -o out/directions.fits
run horizon horizon --size 600,400 --points 100,200 300,190 500,200 --hfov 53.13 -o out/horizon.toml
run horizon_photo horizon $photo --points 100,300 600,310 --focal-35mm 24
run photometry photometry inputs/counts.toml inputs/stars/stars.pgm --camera inputs/stars/camera.toml --exposure 200 --time 2000-01-01T12:00:00Z \
  --stars-out out/stars_of_counts.csv
run linearise_rayleigh linearise inputs/stars/stars.pgm --rayleigh inputs/counts.toml --exposure 200 -o out/rayleighs.fits
run linearise linearise out/photograph.png $small --set 'sensor.exposure="camera"' --set time.exposure_s=8 \
  --set sensor.vignetting_cos_power=4 -o out/linear.exr
awk 'BEGIN {
  print "name,azimuth_deg,zenith_deg,x_px,y_px"
  for (i = 0; i < 12; ++i) {
    azimuth = 77 * i % 360; zenith = 8 + 6 * i; r = 15 * zenith * atan2(0, -1) / 180; a = azimuth * atan2(0, -1) / 180
    printf "star %d,%g,%g,%.6f,%.6f\n", i, azimuth, zenith, 33 + r * sin(a), 23 + r * cos(a)
  }
}' >inputs/stars.csv
run calibrate calibrate inputs/stars.csv -o out/camera.toml --size 64,48 --site 65,20,100 --time 2020-01-01T20:00:00Z \
  --residuals out/residuals.csv --json out/calibrate.json --plot out/residuals.svg
# Stars without a rough camera: a field whose time is known, not known or wrong, over a ground too; and with one.
SOURCE=$source_folder
# shellcheck source=tests/cli/star_field.sh
source "$source_folder/tests/cli/star_field.sh"
sky_to 0 >inputs/stars/field.pgm
sky_to 0 25 >inputs/stars/skyline.pgm
field=(--decoding linear --site 0,0 --time 2020-12-22T00:00:00Z)
run calibrate_blind calibrate --image inputs/stars/field.pgm "${field[@]}" -o out/camera_field.toml --stars-out out/stars_field.csv \
  --overlay out/stars_field.png --residuals out/stars_field_residuals.csv --plot out/stars_field.svg --json out/stars_field.json \
  --axy-out out/stars_field.axy --corr-out out/stars_field.corr
run calibrate_unplaced calibrate --image inputs/stars/field.pgm --decoding linear --stars-out out/stars_unplaced.csv
run calibrate_night calibrate --image inputs/stars/field.pgm --decoding linear --site 0,0 --date 2020-12-21 --level
call 5 calibrate_elsewhere calibrate --image inputs/stars/field.pgm --decoding linear --site 0,0 --time 2020-12-22T12:00:00Z \
  -o out/no.toml
call 5 calibrate_nothing calibrate --image inputs/stars/empty.pgm "${field[@]}" -o out/no.toml
run calibrate_rough calibrate --image inputs/stars/stars.pgm --camera inputs/stars/camera.toml --time 2000-01-01T12:00:00Z \
  -o out/camera_rough.toml --overlay out/stars_rough.png --free rotation,focal --json
run calibrate_list calibrate out/stars_field.axy --camera out/camera_field.toml "${field[@]}" -o out/camera_list.toml
run calibrate_pairs calibrate out/stars_field.corr --size 480,360 --site 0,0 --time 2020-12-22T00:00:00Z -o out/camera_pairs.toml \
  --lens equidistant --terms none --hold-centre
run directions_wcs directions out/camera_field.toml -o out/directions.wcs
run calibrate_wcs calibrate --wcs out/directions.wcs "${field[@]:2}" -o out/camera_wcs.toml
run_refused calibrate_no_stars calibrate -o out/no.toml
run_refused calibrate_no_time calibrate --image inputs/stars/stars.pgm --camera out/camera.toml -o out/no.toml
run_refused calibrate_no_output calibrate inputs/stars.csv --size 64,48
run_refused calibrate_same calibrate inputs/stars.csv --size 64,48 -o inputs/stars.csv
run mask_skyline mask inputs/stars/skyline.pgm -o out/mask_skyline.png --horizon auto --horizon-csv out/mask_skyline.csv \
  --decoding linear --json
awk 'BEGIN { print "P2 200 160 255"
  for (y = 0; y < 160; ++y) for (x = 0; x < 200; ++x) print (x - 103.3) ^ 2 + (y - 79.2) ^ 2 < 70.5 ^ 2 ? 120 + int(x / 20) : 2 }' >inputs/circle.pgm
run mask_circle mask inputs/circle.pgm -o out/mask_circle.png --circle auto --circle-margin 4
run_refused mask_nothing mask $photo -o out/no.png
run_refused mask_no_circle mask $photo -o out/no.png --circle auto
run_refused mask_polygon mask $photo -o out/no.png --polygon 1,2 3,x
run horizon_orbit horizon --size 600,400 --points 100,200 300,190 500,200 550,204 --hfov 53.13 --altitude-m 400000 --json
run horizon_lens horizon inputs/stars/skyline.pgm --points 20,200 240,200 450,200 --lens out/camera_field.toml --azimuth 20 \
  -o out/horizon_lens.toml
run_refused horizon_lens_of_other horizon $photo --points 100,300 600,310 --lens out/camera_field.toml

# From a photograph to an answer: with a camera, by stars, by a skyline, by nothing; and its stages alone.
run band render inputs/scenes/map_light.toml --set camera.width=216 --set camera.height=144 -o out/band.png
awk '/^\[/ { is_camera = /^\[(camera|site)\]/ } is_camera' inputs/scenes/map.toml |
  sed 's/^width.*/width = 216/; s/^height.*/height = 144/; s/^latitude_deg.*/&\nlongitude_deg = 20.0/' >inputs/band_camera.toml
run border border inputs/band_camera.toml --photo out/band.png --out out/border
run_fit border_dark border inputs/band_camera.toml --photo out/band.png --out out/border_dark --channel red --set camera.elevation_deg=80
all_of && run_fit map map inputs/scenes/map.toml --photo out/band.png --set camera.width=216 --set camera.height=144 --out out/map --replicates 2 \
  --sparsity 16 --farthest-km 400
run measure measure out/band.png --camera inputs/band_camera.toml --no-map --out out/measure
all_of && run_fit measure_mapped measure out/band.png --camera inputs/band_camera.toml --site "67N,20°0'E" --replicates 2 --line 557.7 \
  --time 2020-01-01T21:00:00+01:00 --out out/measure_mapped
call 5 measure_unknown measure out/band.png --out out/measure_unknown
call 5 measure_circle measure inputs/circle.pgm --no-map --json --out out/measure_circle
call 5 measure_photo measure $photo --no-map --out out/measure_photo
run_fit measure_example measure $photo --camera inputs/examples/h000/scene.toml --site 64.8,-147 --no-map --out out/measure_example
run_fit measure_masked measure $photo --camera inputs/examples/h000/scene.toml --site 64.8,-147 --mask out/mask.png --no-map \
  --out out/measure_masked
run measure_stars measure inputs/stars/field.pgm "${field[@]}" --no-map --out out/measure_stars
run measure_zenith measure inputs/stars/stars.pgm --time 2000-01-01T12:00:00Z --site 65,150 --no-map --out out/measure_zenith
call 5 measure_skyline measure inputs/stars/skyline.pgm --decoding linear --out out/measure_skyline
call 5 measure_skyline_stars measure inputs/stars/skyline.pgm "${field[@]}" --no-map --out out/measure_skyline_stars
call 5 measure_elsewhere measure inputs/stars/skyline.pgm --decoding linear --site 0,0 --time 2020-12-22T12:00:00Z --no-map \
  --out out/measure_elsewhere
run measure_unmasked measure inputs/stars/field.pgm "${field[@]}" --mask out/band.png --no-map --out out/measure_unmasked
run_refused measure_again measure out/band.png --out out/measure
run_refused measure_no_place measure out/band.png --site 67N,20N --out out/no
run_refused measure_no_time measure out/band.png --time yesterday --out out/no
run_refused measure_no_photo measure none.png --out out/no
run directions_aida directions $small -o out/directions.acc
run calibrate_aida calibrate --acc out/directions.acc --size 160,120 -o out/camera_aida.toml
run calibrate_maps calibrate --azimuth-map out/directions_az.fits --elevation-map out/directions_el.fits -o out/camera_maps.toml \
  --site 65,20 --json out/calibrate_maps.json
run camera_taken render $small --camera out/camera.toml -o out/camera_taken.png
run brightness brightness $small
run brightness_json brightness $small --json --set sheet.main.brightness_kilorayleigh=100 --set time.exposure_s=2
run brightness_footprint brightness inputs/footprints.toml
i=0
for time in 193000 193010 193030 193100; do
  run "keogram_frame_$i" render $small -o "out/sky_20140221_$time.png" --set "sheet.main.center_km.north=$((210 - 10 * i))"
  i=$((i + 1))
done
run keogram keogram out/sky_*.png -o out/keogram.png -o out/keogram.svg -o out/keogram.exr -o out/keogram.csv
run keogram_netcdf keogram out/sky_*.png -o out/keogram.nc
run to_netcdf to-netcdf out/keogram.csv -o out/keogram_of_csv.nc
run keogram_meridian keogram out/sky_*.png -o out/meridian.csv --scene $small --channel g

# --- Fits ----------------------------------------------------------------------------------------------------------------------------
fit_example() { # NAME SCENE: of the photograph beside it
  run_fit "fit_$1" fit "inputs/examples/$2.toml" --photo "inputs/examples/${2%/*}/photo.jpg" --out "out/fit_$1" "${@:3}"
}
fit_example few h000/scene --set sheet.main.beams=400 --max-evaluations 60
if all_of; then
  for name in h000 h001 h002 h003; do fit_example $name $name/scene; done
  fit_example blind h000/blind
fi
fit_example freeform h000/freeform --set sheet.main.beams=200 --set fit.bands=4 --set sheet.main.spline_knots=8
run_fit derivatives_h000 fit inputs/examples/h000/blind.toml --photo $photo --check-derivatives --set sheet.main.beams=300

# All error bars, a run that is cut short, several photographs, a sequence, comparisons.
for i in 1 2 3; do run "frame_$i" render $small -o "out/frame_$i.png" --set "sheet.main.energy_kev=3.$((2 * i))"; done
run_fit fit_judged fit $fit --photo out/render_plain.png --out out/fit_judged --intervals --bootstrap 20 --mcmc 10
run_fit fit_short fit $fit --photo out/render_plain.png --out out/fit_short --max-evaluations 4
run_fit fit_masked fit $fit --photo $photo --mask out/mask.png --out out/fit_masked --set camera.width=720 --set camera.height=480 \
  --max-evaluations 12
sed -e 's/^free = .*/free = ["sheet.main.center_km.north"]/' -e 's/^energy_kev = .*/energy_kev = 6.0/' $fit >inputs/held.toml
run_fit fit_held fit inputs/held.toml --photo out/render_plain.png --out out/fit_held
run_fit compare compare out/fit_judged out/fit_held
run_fit sequence sequence $fit --photos out/frame_1.png out/frame_2.png out/frame_3.png -o out/sequence
# Of a survey's shards the bytes tell how often they were written to: beside the outputs.
mkdir inputs/survey
cp $fit inputs/survey/scene.toml
for i in 1 2 3; do cp "out/frame_$i.png" "inputs/survey/20190301_22100$i.png"; done
printf '[survey]\nname = "night"\nwork = ["border", "fit"]\nscene = "scene.toml"\n[[camera]]\nname = "a"\nframes = ["."]\n' >inputs/survey/survey.toml
run survey_plan survey plan inputs/survey/survey.toml -o out/plan.json
run survey_run survey run out/plan.json --out inputs/survey/shards
run survey_merge survey merge inputs/survey/shards -o out/survey.sqlite
run survey_export survey export out/survey.sqlite -o out/survey.csv
run survey_smooth survey smooth out/survey.sqlite -o out/survey_smooth.sqlite
run survey_netcdf survey export out/survey_smooth.sqlite -o out/survey.nc
run survey_report survey report out/survey_smooth.sqlite -o out/survey_pages --plan out/plan.json
cat $small - >inputs/both.toml <<'TOML'

[fit]
bands = 4
free = ["sheet.main.center_km.north", "sheet.main.energy_kev",
  { path = "camera.elevation_deg", photo = "far", prior = { mean = 40.0, sigma = 0.1 } }]
model_error = 0.01
scan_points = 0

[[fit.photo]]
file = "../out/render_plain.png"

[[fit.photo]]
name = "far"
file = "../out/far.png"
set.site.latitude_deg = 65.6
set.camera.elevation_deg = 40.0
TOML
run far render $small -o out/far.png --set site.latitude_deg=65.6 --set camera.elevation_deg=40 \
  --set sheet.main.center_km.north=152.2 --set sheet.main.center_km.east=19.6
run_fit fit_both fit inputs/both.toml --out out/fit_both --set sheet.main.center_km.north=228 --set sheet.main.energy_kev=3.6

# Every statistic, noise of the sensor, a loss, gains per channel; profiles along the elevation, a curve that is found.
run_fit fit_statistics fit $fit --photo out/render_textured.png --out out/fit_statistics --max-evaluations 25 \
  --set fit.colour_weight=1 --set fit.horizontal_weight=1 --set fit.border_weight=1 --set fit.image_weight=1 \
  --set fit.texture_weight=1 --set sheet.main.ray_contrast=0.4
run_fit fit_robust fit $fit --photo out/photograph.png --out out/fit_robust --max-evaluations 25 --set 'fit.loss="huber"' \
  --set 'fit.photo_noise="sensor"' --set fit.white_balance_known=false --set 'fit.profile_along="elevation"'
run_fit fit_field fit $fit --photo out/render_plain.png --out out/fit_field --max-evaluations 25 --set 'fit.profile_along="field"' \
  --set fit.band_sky=true --set 'fit.decoding="unknown"'
run_fit fit_night fit $fit --photo out/render_night.png --out out/fit_night --max-evaluations 15 \
  --set 'air.model="standard"' --set airglow.green_rayleigh=200 --set light_pollution.luminance_mcd_m2=1
for colour in green red; do
  awk -v scale=$((${#colour} * 900)) 'BEGIN {
    print "P2\n160 120\n65535"
    for (y = 0; y < 120; ++y) for (x = 0; x < 160; ++x) print int(1000 + scale * exp(-(y - 60 - x / 20) ^ 2 / 300))
  }' >out/filter_$colour.pgm
done
run_fit fit_filters fit $fit --line 557.7=out/filter_green.pgm --line 630=out/filter_red.pgm --out out/fit_filters \
  --set 'sensor.response="filters"' --max-evaluations 10

# Volumes: an arc by its footprint, lobes, the Crab's shape in a picture of its own.
run arc_truth render inputs/examples/arc/truth.toml -o out/arc.png --photograph
run_fit derivatives_arc fit inputs/examples/arc/scene.toml --photo out/arc.png --check-derivatives --set camera.width=240
run lobes_truth render inputs/examples/lobes/truth.toml -o out/lobes.png --photograph
run_fit derivatives_lobes fit inputs/examples/lobes/scene.toml --photo out/lobes.png --check-derivatives
if all_of; then
  run_fit fit_arc fit inputs/examples/arc/scene.toml --photo out/arc.png --out out/fit_arc
  run_fit fit_lobes fit inputs/examples/lobes/scene.toml --photo out/lobes.png --out out/fit_lobes
  run crab_picture render inputs/examples/crab/scene.toml -o out/crab.png --set node.hull.radius=1.2
  run_fit fit_crab fit inputs/examples/crab/scene.toml --photo out/crab.png --out out/fit_crab --max-evaluations 12
fi

# The Sun: across a loop, away from the limb, granules, ejections.
sed 's/^\[fit\]/&\nmodel_error = 0.01\nscan_points = 0\nfree = ["loop.clear.height", "loop.clear.tilt_deg", "loop.clear.strand_radius"]/' \
  $loop >inputs/loop_fit.toml
run loop_picture render $loop -o out/loop.png
run profile_loop profile out/loop.png --scene $loop -o out/profile_loop.csv --plot out/profile_loop.svg
run_fit fit_loop fit inputs/loop_fit.toml --photo out/loop.png --out out/fit_loop --set loop.clear.height=73 --set fit.band_sky=true
cat >inputs/corona_fit.toml <<'TOML'
[emission]
lines = [560.0]
[camera]
width = 120
height = 120
hfov_deg = 1.2
azimuth_deg = 180
elevation_deg = 45
[sun]
shown = true
azimuth_deg = 180
elevation_deg = 45
[[corona]]
name = "whole"
share = [1.0]
power = [7.0]
reach = 8.0
light = "density"
rayleigh = [100]
[sensor]
response = "grey"
[fit]
profile_along = "limb"
bands = 4
limb_lowest = 1.2
limb_highest = 2.0
limb_step = 0.05
sky_terms = 1
free = [{ path = "corona.whole.power.0", min = 0.5, max = 40 }]
TOML
run corona_picture render inputs/corona_fit.toml -o out/limb.png --set corona.whole.power.0=8
run_fit fit_corona fit inputs/corona_fit.toml --photo out/limb.png --out out/fit_corona
cat >inputs/granules.toml <<'TOML'
seed = 5
[emission]
lines = [30.4]
[camera]
width = 96
height = 96
hfov_deg = 0.25
azimuth_deg = 180
elevation_deg = 45
[sun]
shown = true
azimuth_deg = 180
elevation_deg = 45
photosphere_rayleigh = [1000]
[[chromosphere]]
name = "noise"
scale = 40
octaves = 4
coverage = 0.2
rayleigh = [300]
step = 2.0
[blur]
width_deg = [0.0]
[sensor]
response = "grey"
exposure = "gain"
gain_per_kilorayleigh = 0.2
[fit]
bands = 1
profile_weight = 0
granulation_weight = 1
sky_terms = 1
scan_points = 0
free = ["chromosphere.noise.scale"]
TOML
run granules_picture render inputs/granules.toml -o out/granules.png --seed 99
run_fit fit_granules fit inputs/granules.toml --photo out/granules.png --out out/fit_granules --set chromosphere.noise.scale=55 \
  --max-evaluations 5
{
  cat inputs/ejections.toml
  printf '[fit]\nbands = 4\nsky_terms = 1\nscan_points = 0\nmodel_error = 0.01\n'
  printf 'free = ["ejection.rope.speed_km_s", "ejection.shell.width_deg", "corona.quiet.power.0"]\n'
} >inputs/ejections_fit.toml
run_fit derivatives_ejections fit inputs/ejections_fit.toml --photo out/ejections_grey.png --check-derivatives
run_fit fit_ejections fit inputs/ejections_fit.toml --photo out/ejections_grey.png --out out/fit_ejections --max-evaluations 8 \
  --set ejection.rope.speed_km_s=480 --set ejection.shell.width_deg=48
