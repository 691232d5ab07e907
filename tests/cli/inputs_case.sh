# Whatever is named as an input and is no file that can be read is refused at once: a pipe into which nobody writes
# would be waited for for ever, and a device read without end.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
cp "$SCENES/fit.toml" "$SCENES/small.toml" .
mkdir folder.png folder.exr folder.csv folder.toml folder.txt folder.vdb folder.pbrt folder.fits
for ending in png exr csv toml txt vdb pbrt fits; do
  mkfifo "pipe.$ending"
  ln -s /dev/zero "device.$ending"
  if [[ $(id -u) -ne 0 ]]; then
    cp photo.png "closed.$ending"
    chmod 000 "closed.$ending"
  fi
done

# refused ENDING ARGUMENTS...: @ stands for the input. A pipe for all of them, the others once for each ending: what is no file is
# found out in one place, and the pipe shows who asks there.
declare -A asked
refused() {
  local ending=$1 input status words inputs=(pipe)
  shift
  [[ -n ${asked[$ending]:-} ]] || inputs+=(folder device closed none)
  asked[$ending]=true
  for input in "${inputs[@]}"; do
    input=$input.$ending
    [[ -e $input || $input == none.* ]] || continue
    words=("${@//@/$input}")
    status=0
    # As much memory as a refusal may take, and then some for the libraries; as much time as a busy machine needs.
    (ulimit -v 4000000; exec timeout -k 5 100 "$VEGARD" "${words[@]}") >"$stdout" 2>"$stderr" </dev/null || status=$?
    [[ $status -eq 3 ]] || fail "exit $status instead of 3: vegard ${words[*]}"
    expect_one_message
    expect_stderr "$input"
    [[ ! -e out.png && ! -e out.csv && ! -e out.exr && ! -e run ]] || fail "something was written"
  done
}

refused toml render @ -o out.png
refused toml render small.toml --camera @ -o out.png
refused toml params @
refused csv render small.toml --set 'sensor.tone="file"' --set sensor.tone_file=@ -o out.png
refused csv render small.toml --set sensor.response=@ -o out.png
refused png render small.toml --set composite.background=@ -o out.png
refused exr render small.toml --set composite.background=@ -o out.png
refused png fit fit.toml --photo @ --out run
refused fits fit fit.toml --photo @ --out run
refused png fit fit.toml --photo photo.png --mask @ --out run
refused csv fit fit.toml --photo photo.png --decoding curve:@ --out run
refused txt sequence fit.toml --photos @ -o run
refused png sequence fit.toml --photos photo.png --mask @ -o run
refused png profile @ -o out.csv
refused txt keogram @ -o out.csv
refused csv keogram photo.png photo.png --times @ -o out.csv
refused csv calibrate @ --size 160,120 -o out.csv
refused fits profile photo.png --azimuth-map @ --directions 4 -o out.csv
refused exr profile photo.png --azimuth-map @ --directions 4 -o out.csv
refused png mask @ --stars -o out.png
refused png mask photo.png --draw @ -o out.png
refused png describe @
refused png linearise @ small.toml -o out.png.exr
refused png sdf @ -o out.exr
refused vdb grid @ -o out.vdb
refused pbrt grid @ -o out.vdb
refused vdb slices @ -o out.png
for kind in pipe folder device; do
  mkdir -p "$kind"
  ln -s "../$kind.toml" "$kind/result.json"
  expect_exit 3 compare "$kind" "$kind"
  expect_stderr result.json
done
