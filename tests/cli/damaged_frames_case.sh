# Files of frames that are damaged, or made to do harm, are refused in one message, whatever the frame, in bounded memory,
# and nothing is written.
source "$(dirname "$0")/case.sh"
python3 - <<'EOF'
import gzip

def frame(second, width=64, height=48, options="WIDTH=128 HEIGHT=48 XBIN=2 YBIN=1 MSEC=999", there=None):
    words = f'#"Exposure options" {options}\n#"Image request start" 2014-03-10 06:03:{second:02d}.012345 UTC\n'
    pixels = b"".join((997 * (second + 1) * k % 60000).to_bytes(2, "big") for k in range(width * height))
    return f"P5\n{words}{width} {height}\n65535\n".encode() + pixels[:there]

def put(name, data):
    gzip.open(name, "wb").write(data)

sound = frame(0) + frame(3) + frame(6)
put("sound.pgm.gz", sound)
packed = open("sound.pgm.gz", "rb").read()
open("cut.pgm.gz", "wb").write(packed[:len(packed) // 2])
open("short.pgm.gz", "wb").write(packed[:-4])
open("sum.pgm.gz", "wb").write(packed[:-6] + bytes([packed[-6] ^ 1]) + packed[-5:])
open("more.pgm.gz", "wb").write(packed + b"more")
put("order.pgm.gz", frame(0) + frame(6) + frame(3))
put("pixels.pgm.gz", frame(0) + frame(3, there=100))
put("size.pgm.gz", frame(0) + frame(3, 32, 48))
put("words.pgm.gz", frame(0, options="WIDTH=512 HEIGHT=256 XBIN=2 YBIN=1") + frame(3))
put("tail.pgm.gz", sound + b"GIF89a")
# A thousand times their own size: of one frame, of frames without end, of a header, behind a frame, of FITS.
put("wide.pgm.gz", b"P5 16384 16384 65535\n" + bytes(1 << 28))
put("many.pgm.gz", b"P5 1 1 255\na" * (1 << 20))
put("header.pgm.gz", b"P5\n" + b"#" * (1 << 26))
put("zeros.pgm.gz", b"P5 2 1 255\nab" + bytes(1 << 28))
put("long.fits.gz", b"SIMPLE  =                    T".ljust(80) + bytes(1 << 28))
EOF
expect_exit 0 profile sound.pgm.gz#1 -o sound.csv
expect_exit 0 mask sound.pgm.gz#0 -o mask.png --saturated --stars

# refused WORD ARGUMENTS...: as scripts/damage.py, a refusal takes 300 MB at most.
refused() {
  local word=$1 status=0
  shift
  python3 - "$VEGARD" "$@" >"$stdout" 2>"$stderr" <<'EOF' || status=$?
import resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdin=subprocess.DEVNULL).returncode
megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
sys.exit(code if megabytes < 300 else f"it held {megabytes:.0f} MB")
EOF
  [[ $status -eq 3 ]] || fail "exit $status instead of 3: vegard $*"
  expect_one_message
  expect_stderr "$word"
  [[ ! -e no.csv && ! -e no ]] || fail "something was written"
}
while IFS='|' read -r file word; do
  refused "$word" profile "$file.pgm.gz#0" -o no.csv
done <<'EOF'
cut|truncated
short|truncated
sum|incorrect data check
more|something else follows
order|frame 2 is out of order
pixels|frame 1 promises 6144 bytes of pixels and 100 are there
size|frame 1 has 32 x 48 pixels, the first 64 x 48
words|WIDTH=512
tail|behind its frame 2 stands something else than a frame
wide|a packed frame claims 16384 x 16384
many|more than 100000 frames
header|header of more than 64 kB
zeros|something else than a frame
EOF
# The others read frames as profile does.
for file in cut order many; do
  refused "$file" describe "$file.pgm.gz"
  refused "$file" keogram "$file.pgm.gz" -o no.csv
  refused "$file" fit "$SCENES/fit.toml" --photo "$file.pgm.gz#0" --out no
  refused "$file" sequence "$SCENES/fit.toml" --photos "$file.pgm.gz" -o no
  refused "$file" profile sound.pgm.gz#1 --mask "$file.pgm.gz#0" -o no.csv
done
refused "larger than 128 MB" profile long.fits.gz -o no.csv
