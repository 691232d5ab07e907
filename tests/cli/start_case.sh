# A start loads no library that only a few commands need: OpenImageIO and OpenCV's codecs, movies and windows have 200 others
# behind them, OpenVDB 60 000 relocations. They are in modules (sim/base/module.h), loaded at their first use; PNGs need none.
# shellcheck disable=SC2154  # stdout, stderr: of case.sh
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
slow='openvdb|OpenImageIO|OpenColorIO|gdal|avcodec|opencv_(imgcodecs|videoio|highgui)'

# loads ARGUMENTS...: the slow libraries and the modules that a run loads, in `loaded`.
loads() {
  local status=0
  LD_DEBUG=files LD_DEBUG_OUTPUT=loading "$VEGARD" "$@" >"$stdout" 2>"$stderr" || status=$?
  [[ $status -eq 0 ]] || fail "exit $status: vegard $*"
  grep -ohE "file=[^ ]*($slow|vegard_[a-z_]*\.so)" loading.* | sort -u >loaded || true
  rm loading.*
}
loads_nothing() {
  loads "$@"
  [[ ! -s loaded ]] || fail "vegard $* loads $(cat loaded)"
}
loads_nothing --version
loads_nothing fit --help
loads_nothing params
loads_nothing describe "$SOURCE/data/examples/h000/photo.jpg"
loads_nothing render "$small" -o picture.png
loads_nothing profile picture.png -o profile.csv --bands 2

# What is needed is loaded, and no more.
loads render "$small" -o picture.exr
grep -q vegard_openexr.so loaded || fail "an EXR is written without its module"
if grep -q vegard_openimageio loaded; then fail "what writes an EXR loads more than its encoder"; fi
loads_nothing render "$small" -o picture.jpg
loads render "$small" -o picture.tif
grep -q vegard_openimageio.so loaded || fail "a TIFF is written without its module"
loads profile picture.tif -o profile.csv --overwrite --bands 2
grep -q vegard_opencv_codecs.so loaded || fail "a TIFF is read without its module"
if grep -qE 'vegard_(movie|window|openimageio|openvdb)' loaded; then fail "what reads a TIFF loads more than its decoder"; fi

# A copy of the program still finds the modules of the build.
mkdir alone
cp "$VEGARD" alone/copy
VEGARD=$folder/alone/copy expect_exit 0 render "$small" -o by_copy.exr

# A program without its modules: it works as far as it does without, then says what is missing, and where it should be.
LC_ALL=C sed 's|/lib/vegard|/lib/nowher|g' "$VEGARD" >alone/vegard
chmod +x alone/vegard
VEGARD=$folder/alone/vegard
expect_exit 0 --version
expect_exit 1 render "$small" -o no.exr
expect_stderr "vegard_openexr.so | $folder/alone | No such file"
expect_one_message
[[ ! -e no.exr ]] || fail "a picture was written without its module"
expect_exit 1 profile picture.tif -o no.csv --bands 2
expect_stderr "vegard_opencv_codecs.so | $folder/alone"
expect_one_message
