# A survey of eight frames: whatever cuts or kills it, the same bytes come out; and its refusals.
source "$(dirname "$0")/case.sh"
mkdir night
cp "$SCENES/fit.toml" night/scene.toml
for i in 0 1 2 3 4 5 6; do
  expect_exit 0 render "$SCENES/small.toml" -o "night/20190301_22100$i.png" --set "sheet.main.energy_kev=3.$i"
done
head -c 3000 night/20190301_221000.png >night/20190301_221005.png # cut off
cat >night/survey.toml <<'TOML'
[survey]
name = "night"
work = ["border", "fit"]
scene = "scene.toml"
block_frames = 3
[[camera]]
name = "a"
frames = [".", "late.txt"]
[[skip]]
from = "2019-03-01T22:10:06Z"
until = "2019-03-01T22:10:07Z"
reason = "a lamp"
TOML
printf 'late.png 2019-03-01T22:10:07Z\n' >night/late.txt
expect_exit 0 survey plan night/survey.toml -o plan.json
expect_stdout "8 frames | 1 skipped | 3 blocks"

query() { sqlite3 "$1" "$2" 2>/dev/null || python3 -c 'import sqlite3, sys
for row in sqlite3.connect(sys.argv[1]).execute(sys.argv[2]): print("|".join(map(str, row)))' "$1" "$2"; }

expect_exit 0 survey run plan.json --out whole
expect_stdout "shard 1/1: 8 of 8 frames"
expect_exit 0 survey merge whole -o whole.sqlite
expect_stdout "8 frames of 1 database"
[[ $(query whole.sqlite "SELECT status || ': ' || coalesce(reason, '') FROM frame WHERE frame > 4 ORDER BY frame" | sed 's/unreadable: .*/unreadable/') == \
  $'unreadable\nskipped: a lamp\nmissing: there is no such file' ]] || fail "other states of frames"
[[ $(query whole.sqlite "SELECT group_concat(start, ' ') FROM (SELECT start FROM result WHERE work = 'fit' ORDER BY frame)") == \
  "full warm warm full warm" ]] || fail "frames start elsewhere"
[[ $(query whole.sqlite "SELECT count(*) FROM quantity WHERE name = 'sheet.main.energy_kev' AND abs(value - 3 - frame / 10.0) < 0.1") == 5 ]] ||
  fail "other energies"

# A frame's number that no survey has is a damaged database, not an internal error.
cp whole.sqlite huge.sqlite
python3 -c 'import sqlite3
with sqlite3.connect("huge.sqlite") as database: database.execute("UPDATE frame SET frame = frame + 4294967296")'
expect_exit 3 survey report huge.sqlite -o huge --no-keograms
expect_stderr "huge.sqlite: | number"
expect_one_message

# A disk without locks, as NFS without its daemon: SQLite takes that for another process.
if command -v gcc >/dev/null; then
  cat >nolock.c <<'C'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
static int asked(const char* name, int file, int command, void* argument) {
  if (command == F_SETLK || command == F_SETLKW) return errno = ENOLCK, -1;
  int (*real)(int, int, ...) = dlsym(RTLD_NEXT, name);
  return real(file, command, argument);
}
int fcntl(int file, int command, ...) {
  va_list list;
  va_start(list, command);
  void* argument = va_arg(list, void*);
  va_end(list);
  return asked("fcntl", file, command, argument);
}
int fcntl64(int file, int command, ...) {
  va_list list;
  va_start(list, command);
  void* argument = va_arg(list, void*);
  va_end(list);
  return asked("fcntl64", file, command, argument);
}
C
  gcc -shared -fPIC -o nolock.so nolock.c -ldl
  status=0
  LD_PRELOAD=./nolock.so "$VEGARD" survey run plan.json --out unlocked >"$stdout" 2>"$stderr" || status=$?
  [[ $status -eq 6 ]] || fail "exit $status instead of 6 on a disk without locks"
  expect_stderr "no locks"
fi

# In two shards and by several processes.
expect_exit 0 survey run plan.json --out two --shard 2/2
expect_exit 5 survey merge two -o part.sqlite
expect_stdout "not there yet"
expect_exit 0 survey run plan.json --out two --shard 1/2
expect_exit 0 survey merge two/shard-0002-of-0002.sqlite two/shard-0001-of-0002.sqlite -o two.sqlite
expect_same whole.sqlite two.sqlite
expect_exit 0 survey run plan.json --out local --local 2 --threads 2
[[ $(find local -name 'shard-*-of-0003.sqlite' | wc -l) -eq 3 ]] || fail "not three shards"
expect_exit 0 survey merge local -o local.sqlite
expect_same whole.sqlite local.sqlite

# Interrupted at its beginning, when it has most to do, where it has said nothing yet; then killed again and again.
"$VEGARD" survey run plan.json --out killed >"$stdout" 2>"$stderr" &
wait_until_interruptible $!
kill -INT $! 2>/dev/null || true
status=0
wait $! || status=$?
[[ $status -eq 130 || $status -eq 0 ]] || fail "exit $status after Ctrl-C"
for work in 5 20 35 25 15 45; do
  "$VEGARD" survey run plan.json --out killed >"$stdout" 2>"$stderr" &
  wait_until_worked $! "$work"
  kill -KILL $! 2>/dev/null || true
  wait $! 2>/dev/null || true
done
expect_exit 0 survey run plan.json --out killed
expect_stdout "8 of 8 frames"
expect_exit 0 survey merge killed -o killed.sqlite
expect_same whole.sqlite killed.sqlite

# What was missing has come: it is done, and nothing else.
cp -r whole again
expect_exit 0 survey run plan.json --out again --again
expect_stdout "shard 1/1: 8 of 8 frames"
! grep -q "frames again" "$stdout" || fail "frames are done again that are what they were"
cp night/20190301_221004.png night/late.png
expect_exit 0 survey run plan.json --out again
expect_exit 0 survey merge again -o again.sqlite
expect_same whole.sqlite again.sqlite
expect_exit 0 survey run plan.json --out again --again
expect_stdout "shard 1/1: 1 frames again"
expect_exit 0 survey merge again -o again.sqlite --overwrite
expect_exit 0 survey run plan.json --out fresh
expect_exit 0 survey merge fresh -o fresh.sqlite
expect_same again.sqlite fresh.sqlite
! cmp -s again.sqlite whole.sqlite || fail "what has come is missing still"
rm night/late.png

# What there is to take away.
expect_exit 0 survey export whole.sqlite -o wide.csv
[[ $(wc -l <wide.csv) -eq 9 ]] || fail "not a row a frame"
grep -q '^7,a,late.png,2019-03-01T22:10:07Z,missing,there is no such file,' wide.csv || fail "no row of the missing frame"
for table in frames results quantities; do
  expect_exit 0 survey export whole/shard-0001-of-0001.sqlite -o "$table.csv" --table "$table"
  expect_file "$table.csv"
done

# How curtains move.
expect_exit 0 survey smooth whole.sqlite -o moving.sqlite --quantity sheet.main.energy_kev
expect_stdout "tracks of"
[[ $(query moving.sqlite "SELECT count(*) FROM velocity WHERE velocity_unit = 'keV/s' AND abs(velocity - 0.1) < 4 * velocity_sigma") == 5 ]] ||
  fail "other velocities"
expect_exit 0 survey smooth local.sqlite -o smoothed_again.sqlite --quantity sheet.main.energy_kev
expect_same moving.sqlite smoothed_again.sqlite
expect_exit 0 survey export moving.sqlite -o velocities.csv --table velocities
grep -q ',fit,0,sheet.main.energy_kev,' velocities.csv || fail "no velocity of the energy"
expect_exit 2 survey export whole.sqlite -o none.csv --table velocities
expect_stderr "vegard survey smooth"
expect_exit 0 survey export moving.sqlite -o moving.nc
[[ $(head -c 4 moving.nc | tail -c 3) == HDF ]] || fail "no netCDF-4"
expect_exit 0 survey export smoothed_again.sqlite -o again.nc
expect_same moving.nc again.nc
expect_exit 2 survey export moving.sqlite -o other.nc --table wide
expect_stderr "all of a frame in one"
expect_exit 2 survey smooth whole.sqlite -o none.sqlite --false-alarms 0.7
expect_one_message

# Pages to look at.
expect_exit 0 survey report moving.sqlite -o pages --plan plan.json
expect_stdout "1 night, 1 keogram"
for text in 'a lamp' 'there is no such file' 'href="../night/20190301_221005.png"' '<image'; do
  grep -qF -- "$text" pages/night-2019-03-01.html || fail "the night's page has no '$text'"
done
grep -q ',sheet.main.energy_kev,keV,' pages/night-2019-03-01-physics.csv || fail "no energy with what others say"
grep -q '8 frames of 1 camera in 1 night' pages/index.html || fail "another first sentence"
! grep -qE '<script|(src|href)="http' pages/*.html || fail "a page wants something from elsewhere"
expect_exit 2 survey report whole.sqlite -o pages
expect_stderr "pages"
cp -r pages first_pages
expect_exit 0 survey report smoothed_again.sqlite -o pages --plan plan.json --overwrite
for page in index night-2019-03-01; do expect_same "first_pages/$page.html" "pages/$page.html"; done
expect_exit 0 survey report whole.sqlite -o without --no-keograms
expect_stdout "0 keograms"

# Refusals.
expect_exit 3 survey report whole.sqlite -o none --plan night/survey.toml
expect_exit 2 survey run plan.json --out whole --shard 1/2
expect_stderr "is cut into 1"
expect_exit 2 survey run plan.json --out other --shard 3/2
expect_one_message
expect_exit 3 survey run night/survey.toml --out other
expect_exit 2 survey merge whole -o whole.sqlite
expect_exit 2 survey merge whole -o whole/shard-0001-of-0001.sqlite --overwrite
mkdir begun && : >begun/shard-0001-of-0001.sqlite # what is left where a run ended before its first frame was kept
expect_exit 2 survey merge begun -o none.sqlite
expect_stderr "no frame"
expect_exit 0 survey run plan.json --out begun
expect_exit 2 survey merge night -o none.sqlite
expect_stderr "no shard"
expect_exit 3 survey merge plan.json -o none.sqlite
expect_stderr "plan.json"
expect_one_message
expect_exit 3 survey export night/late.txt -o none.csv
expect_exit 3 survey export none.sqlite -o none.csv
[[ ! -e none.sqlite && ! -e none.csv ]] || fail "something was written"
# What the plan was made of has changed; then the plan has.
cp -r night changed
sed 's/"night"/"changed"/' plan.json >changed.json
cp changed/scene.toml scene.toml
sed -i 's/^bands = 4/bands = 5/' changed/scene.toml
expect_exit 2 survey run changed.json --out other
expect_stderr "setup of a | calibration 1"
[[ ! -e other ]] || fail "something was written"
expect_exit 2 survey run changed.json --out other --local 2
expect_one_message
cp scene.toml changed/scene.toml
expect_exit 2 survey run changed.json --out whole
expect_stderr "another plan"
expect_exit 0 survey run changed.json --out other
expect_exit 2 survey merge whole other -o none.sqlite
expect_stderr "of 2 plans"
expect_exit 0 survey merge whole other -o mixed.sqlite --mixed
expect_stdout "2 plans | 1 version"
# A full disk keeps what was finished.
(
  ulimit -f $(($(stat -c %s whole/shard-0001-of-0001.sqlite) / 1024 - 6)) # kB
  status=0
  "$VEGARD" survey run plan.json --out full >"$stdout" 2>"$stderr" || status=$?
  [[ $status -eq 6 ]] || fail "exit $status on a full disk"
  expect_one_message
)
expect_exit 0 survey run plan.json --out full
expect_exit 0 survey merge full -o full.sqlite
expect_same whole.sqlite full.sqlite
