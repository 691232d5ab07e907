#!/usr/bin/env bash
# Do two builds of the command give the same outputs, byte for byte? For changes that are not meant to change any.
#
#   scripts/same_outputs.sh write [--quick] BINARY DIR   every call of same_outputs_cases.sh with that binary, in the new folder DIR
#   scripts/same_outputs.sh compare DIR DIR              which files differ; exit code 1 if any do
#   scripts/same_outputs.sh self-check DIR               that `compare` finds whatever is changed in a copy of DIR
#
# --quick takes about a minute on two cores, all of it about five. The scenes and photographs are those of this tree's data/ and
# tests/, copied into DIR, so that both binaries work on the same. All names in a call are relative to DIR: no output holds a folder.
#
# DIR/logs has the output, the messages and the exit code of each call, DIR/out the files that it wrote. Files are compared byte for
# byte. Taken out before are only
#   - the version of vegard, in texts, if the two binaries differ in it (pictures carry it too, and then differ)
#   - in messages, how long a stage of a fit took and will take: "(12 s, about 5 s to go)" at the end of a line
#   - in the output of `vegard preview`, how fast its frames were
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_folder=$(dirname "$here")

usage() {
  sed -n '4,6s/^# *//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

refuse() {
  echo "same_outputs.sh: $*" >&2
  exit 2
}

# call WANTED NAME ARGUMENTS...: one call of the command that may end with any of the exit codes WANTED. With another exit code it is
# told, since a call that went wrong compares little, and `write` fails in the end.
call() {
  local wanted=$1 name=$2 status=0 start=$SECONDS
  shift 2
  [[ ! -e logs/$name.exit ]] || refuse "two calls are named $name"
  "$binary" "$@" >"logs/$name.stdout" 2>"logs/$name.stderr" </dev/null || status=$?
  echo "$status" >"logs/$name.exit"
  printf '%-36s exit %-3s %4d s\n' "$name" "$status" $((SECONDS - start)) >&2
  if [[ " $wanted " != *" $status "* ]]; then
    sed 's/^/  /' "logs/$name.stderr" >&2
    unexpected+=("$name")
  fi
}
run() { call 0 "$@"; }
# A fit whose verdict is "doubtful" (5) or "failed" (4) has outputs as well.
run_fit() { call "0 4 5" "$@"; }
run_refused() { call "2 3" "$@"; }

write() {
  local quick=false
  if [[ ${1:-} == --quick ]]; then
    # shellcheck disable=SC2034  # same_outputs_cases.sh asks for it
    quick=true
    shift
  fi
  [[ $# -eq 2 ]] || usage
  [[ -x $1 ]] || refuse "$1 is no program"
  [[ ! -e $2 ]] || refuse "$2 exists"
  local binary unexpected=()
  binary=$(realpath "$1")
  mkdir -p "$2"
  cd "$2"
  mkdir inputs logs out
  cp -r "$source_folder/data/gallery" "$source_folder/data/examples" "$source_folder/tests/cli/scenes" inputs
  mkdir inputs/stars
  (cd inputs/stars && python3 "$source_folder/tests/cli/made_stars.py" "$source_folder/data/stars/bright_stars.csv")
  printf '%s\n' 'dark_counts = 100' '[[filter]]' 'name = "green"' 'line_nm = 557.7' 'width_nm = 2' \
    'rayleigh_per_count_s = 25' >inputs/counts.toml
  ln -s "$binary" vegard  # results hold the name by which it was called
  binary=$PWD/vegard
  unset DISPLAY WAYLAND_DISPLAY
  export LC_ALL=C
  run version --version
  # shellcheck source=scripts/same_outputs_cases.sh
  source "$here/same_outputs_cases.sh"
  echo "$(find logs -name '*.exit' | wc -l) calls, $(find out -type f | wc -l) files, $SECONDS s" >&2
  [[ ${#unexpected[@]} -eq 0 ]] || { echo "an unexpected exit code: ${unexpected[*]}" >&2; return 1; }
}

version_of() { sed -n '1s/^vegard //p' "$1/logs/version.stdout"; }

# without_times FILE: its bytes, less what is told at the top.
without_times() {
  case $1 in
    *.stderr) sed -E 's/ \([0-9]+ (s|min|h)[^()]*\)$/ (TIME)/' "$1" ;;
    logs/preview*.stdout) sed -E 's/median .*/SPEED/' "$1" ;;
    *) cat "$1" ;;
  esac
}

# comparable FOLDER FILE OWN_VERSION OTHER_VERSION
comparable() {
  (
    cd "$1"
    case $2 in
      *.stdout | *.stderr | *.json | *.csv | *.toml | *.html | *.svg | *.txt)
        if [[ $3 != "$4" ]]; then without_times "$2" | sed "s/${3//./\\.}/VERSION/g"; else without_times "$2"; fi
        ;;
      *) cat "$2" ;;
    esac
  )
}

# by_how_much FILE FILE: of tables, scenes and words that are alike but for their numbers: how many differ, and by how much at most, as
# a share of the larger; of linear pictures, by how much at most. Nothing of others.
by_how_much() {
  local number='[-+]?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?'
  case $1 in
    *.exr)
      command -v oiiotool >/dev/null || return 0
      timeout 20 oiiotool --diff "$1" "$2" 2>/dev/null | sed -n 's/^ *Max error *= \([^ ]*\).*/ (by at most \1)/p'
      ;;
    *.csv | *.json | *.toml | *.stdout | *.svg)
      cmp -s <(sed -E "s/$number/0/g" "$1") <(sed -E "s/$number/0/g" "$2") || { echo " (not only in numbers)"; return; }
      paste <(grep -oE -- "$number" "$1") <(grep -oE -- "$number" "$2") | awk '
        $1 != $2 {
          ++count
          larger = $1 ^ 2 > $2 ^ 2 ? $1 : $2
          share = sqrt((($1 - $2) / larger) ^ 2)
          if (larger != 0 && share > most) { most = share; from = $1; to = $2 }
        }
        END { printf " (%d numbers, by at most %.1g of themselves: %s, %s)", count, most, from, to }'
      ;;
  esac
}

compare() {
  [[ $# -eq 2 ]] || usage
  local folder a=$1 b=$2 version_a version_b differ=0 total=0 file
  for folder in "$a" "$b"; do
    [[ -s $folder/logs/version.stdout ]] || refuse "$folder was not written by 'same_outputs.sh write'"
  done
  version_a=$(version_of "$a") version_b=$(version_of "$b")
  while IFS= read -r file; do
    total=$((total + 1))
    if [[ ! -e $a/$file ]]; then
      echo "only in $b: $file"
    elif [[ ! -e $b/$file ]]; then
      echo "only in $a: $file"
    elif cmp -s "$a/$file" "$b/$file"; then
      continue
    elif cmp -s <(comparable "$a" "$file" "$version_a" "$version_b") <(comparable "$b" "$file" "$version_b" "$version_a"); then
      continue
    else
      echo "differs: $file$(by_how_much "$a/$file" "$b/$file")"
    fi
    differ=$((differ + 1))
  done < <({ (cd "$a" && find . -type f -printf '%P\n'); (cd "$b" && find . -type f -printf '%P\n'); } | LC_ALL=C sort -u)
  echo "$differ of $total files differ"
  [[ $differ -eq 0 ]]
}

# Changes one thing at a time in a copy: a byte in the middle of a file of each kind, an exit code, a file that is gone or new.
self_check() {
  [[ $# -eq 1 ]] || usage
  [[ -d $1/logs ]] || refuse "$1 was not written by 'same_outputs.sh write'"
  copy=$(mktemp -d)
  trap 'rm -rf "$copy"' EXIT
  local original=$1 file kind checks=0
  cp -r "$original/." "$copy"
  compare "$original" "$copy" >/dev/null || refuse "a copy differs from its original"
  expect_found() { # WHAT FILE
    checks=$((checks + 1))
    if compare "$original" "$copy" >"$copy.said"; then refuse "$1 is not found: $2"; fi
    grep -qF "$2" "$copy.said" || refuse "$1 is not named: $2"
    rm "$copy.said"
    rm -f "$copy/$2"
    [[ ! -e $original/$2 ]] || cp "$original/$2" "$copy/$2"
  }
  while IFS= read -r kind; do
    file=$(cd "$original" && find out logs -type f -size +0 -name "*.$kind" | LC_ALL=C sort | head -1)
    flip_middle_byte "$copy/$file"
    expect_found "a changed byte" "$file"
  done < <(cd "$original" && find out logs -type f -size +0 | sed 's/.*\.//' | LC_ALL=C sort -u)
  rm "$copy/logs/version.stderr"
  expect_found "a file that is gone" logs/version.stderr
  echo new >"$copy/out/new.txt"
  expect_found "a new file" out/new.txt
  echo 1 >"$copy/logs/version.exit"
  expect_found "an exit code" logs/version.exit
  compare "$original" "$copy" >/dev/null || refuse "the copy was not mended"
  echo "$checks changes, all found"
}

flip_middle_byte() {
  local at old
  at=$(($(stat -c %s "$1") / 2))
  old=$(od -An -v -tu1 -j "$at" -N1 "$1")
  # shellcheck disable=SC2059  # the format is the byte
  printf "\\x$(printf '%02x' $((old ^ 1)))" | dd of="$1" bs=1 seek="$at" conv=notrunc status=none
}

case ${1:-} in
  write | compare) "$@" ;;
  self-check) shift && self_check "$@" ;;
  *) usage ;;
esac
