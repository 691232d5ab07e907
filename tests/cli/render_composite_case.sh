# Pictures behind and before the aurora: their files are named beside the scene's, each fault in one message;
# layers stand in an EXR alone.
source "$(dirname "$0")/case.sh"
mkdir scene
cp "$SCENES/small.toml" scene/small.toml
cat >>scene/small.toml <<'END'
[composite]
foreground = "trees.png"
END
cp "$SOURCE/data/gallery/treeline.png" scene/trees.png
expect_exit 0 render scene/small.toml -o with.png
expect_exit 0 render scene/small.toml -o without.png --set 'composite.foreground=""'
expect_different with.png without.png
expect_exit 0 render scene/small.toml -o stars.png --set stars.shown=true
expect_different with.png stars.png
expect_exit 0 render scene/small.toml -o again.png --set stars.shown=true --threads 1
expect_same again.png stars.png

# A missing or damaged picture: exit 3, its name and the scene's key, and no output.
head -c 4000 scene/trees.png >scene/truncated.png
expect_exit 0 render scene/small.toml -o photo.jpg
head -c 1500 photo.jpg >scene/truncated.jpg
echo "not a picture" >scene/words.tif
: >scene/empty.exr
for key in foreground background mask; do
  for file in missing.png truncated.png truncated.jpg words.tif empty.exr; do
    expect_exit 3 render scene/small.toml -o bad.png --set "composite.$key=$file"
    expect_stderr "scene/$file: composite.$key: "
    expect_one_message
  done
done
# A foreground that nothing can be seen behind is the scene's fault, at its line.
cp photo.jpg scene/photo.jpg
sed -i 's/trees.png/photo.jpg/' scene/small.toml
expect_exit 2 render scene/small.toml -o bad.png
expect_stderr "small.toml:$(grep -n '^foreground' scene/small.toml | cut -d: -f1): composite.foreground"
expect_stderr "composite.mask"
expect_one_message
expect_exit 0 render scene/small.toml -o masked.png --set composite.mask=trees.png
# The pictures are not to be lost.
expect_exit 2 render scene/small.toml -o scene/photo.jpg --overwrite
expect_stderr "scene reads"

sed -i 's/photo.jpg/trees.png/' scene/small.toml
expect_exit 0 render scene/small.toml -o layers.exr --layers sheets --set stars.shown=true
for channel in main.R main.rayleigh.5577 rayleigh.5577 aurora.G sky.B stars.R foreground.G mask; do
  LC_ALL=C grep -qaF "$channel" layers.exr || fail "no channel $channel"
done
! LC_ALL=C grep -qaF background.R layers.exr || fail "a layer of what the scene does not have"
expect_exit 2 render scene/small.toml -o bad.png --layers sheets
expect_stderr "--layers"
expect_exit 2 render scene/small.toml -o bad.exr --layers everything
sed -i 's/name = "main"/name = "sky"/' scene/small.toml
expect_exit 2 render scene/small.toml -o bad.exr --layers sheets
expect_stderr "small.toml:$(grep -n '^name' scene/small.toml | cut -d: -f1): sheet.sky.name"
expect_only again.png layers.exr masked.png photo.jpg scene stars.png with.png without.png
