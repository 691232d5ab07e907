#!/usr/bin/env bash
# Adding is cheap: a dummy of each kind, added to a copy of the sources by a new file and few edits, is built and works.
# usage: adding_test.sh ROOT BUILD
# BUILD: a build of ROOT by Ninja, whose flags and libraries are used; only what the additions touch is compiled.
set -euo pipefail
root=$(realpath "$1") build=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
copy=$work/copy

fail() {
  echo "adding_test: $*" >&2
  exit 1
}

ninja -C "$build" -t commands vegard >"$work/commands" || fail "$build is no build by Ninja"

# A copy of what may be edited: sources and pages. In a repository its files alone; else (an unpacked archive) what is there.
fresh_copy() {
  rm -rf "$copy" "$work"/objects
  mkdir -p "$copy" "$work/objects"
  if git -C "$root" rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    (cd "$root" && git ls-files -z --cached --others --exclude-standard -- apps fit sim scripts cmake docs '*.md' | xargs -0 ls -d 2>/dev/null)
  else
    (cd "$root" && find apps fit sim scripts cmake docs ./*.md -type f)
  fi | tar -C "$root" -cf - -T - | tar -C "$copy" -xf -
  cp -r "$copy" "$work/before"
}

# insert_before PATTERN FILE TEXT: a line of text before the first line that the pattern fits.
insert_before() {
  grep -qE -- "$1" "$copy/$2" || fail "$2 has no line like $1"
  awk -v pattern="$1" -v text="$3" '!done && $0 ~ pattern { print text; done = 1 } { print }' "$copy/$2" >"$work/edited"
  cp "$work/edited" "$copy/$2"
}

# expect_edits MOST: how many files of before are changed, besides the new ones.
expect_edits() {
  local edited
  edited=$(diff -rq "$work/before" "$copy" | grep -c '^Files' || true)
  ((edited > 0 && edited <= $1)) || fail "$kind: $edited files are edited, at most $1 may be"
  echo "$kind: a new file and $edited edits: $(diff -rq "$work/before" "$copy" | sed -n "s|^Files $work/before/\([^ ]*\) .*|\1|p" | tr '\n' ' ')"
}

# compile LIBRARY FILE...: files of the copy, with the flags of the library.
compile() {
  local flags file
  # Of a unit, where there are units: other files may have flags of their own.
  flags=$(grep -m1 -E "$1\.dir/Unity/[^ ]*\.o -c " "$work/commands" || grep -m1 -E "$1\.dir/[^ ]*\.o -c " "$work/commands") ||
    fail "there is no command for $1"
  flags=$(sed -E "s/ -M[DTF]( [^ ]*\.o(\.d)?)?//g; s/ -o [^ ]* -c .*//; s|-I$root([ /])|-I$copy\1|g" <<<"$flags")
  for file in "${@:2}"; do
    (cd "$build" && bash -c "$flags -o $work/objects/${file//\//_}.o -c $copy/$file") || fail "$kind: $file does not compile"
  done
}

# Links the program anew: what was compiled comes first, in place of the same in the libraries.
link() {
  local command
  command=$(grep -E -- ' -o vegard ' "$work/commands" | sed -E 's/ && cd .*//; s/^: && //')
  [[ -e $work/objects/apps_vegard.cpp.o ]] && command=${command/apps\/CMakeFiles\/vegard.dir\/vegard.cpp.o/}
  command=${command/ -o vegard / -Wl,--allow-multiple-definition -o $work\/vegard $(echo "$work"/objects/*.o) }
  (cd "$build" && bash -c "${command% && :}") >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "$kind: it does not link"; }
}

add_subcommand() {
  cat >"$copy/apps/commands/dummy.cpp" <<'CPP'
#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/standard_streams.h"

namespace vegard::apps {

void add_dummy_command(Program& program) {
  program.add("dummy", "Say that it is there").runs([] {
    say_result("The dummy is there.\n");
    return good;
  });
}

}  // namespace vegard::apps
CPP
  insert_before '^struct CommandGroup' apps/commands/commands.h 'AddCommand add_dummy_command;'
  sed -i 's/{add_params_command, /&add_dummy_command, /' "$copy/apps/commands/commands.h"
  insert_before '^## ' docs/measure.md 'The dummy says that it is there.'
  insert_before '^### Added' CHANGELOG.md '- A dummy'
  expect_edits 3
  compile vegard apps/vegard.cpp
  compile vegard_apps apps/commands/dummy.cpp
  link
  [[ $("$work/vegard" dummy) == "The dummy is there." ]] || fail "$kind: it does not run"
  "$work/vegard" --help >"$work/words"
  grep -q '^  dummy  *Say that it is there' <(sed -n '/^Reference/,$p' "$work/words") || fail "$kind: it is not in the help"
  "$work/vegard" manual dummy >"$work/words"
  grep -qF 'vegard\-dummy' "$work/words" || fail "$kind: it has no manual page"
  "$work/vegard" manual --completion bash >"$work/words"
  grep -qF "'dummy'" "$work/words" || fail "$kind: it is not completed"
}

# A format of arrays: "DUMMY", width and height in a byte each, pixels in a byte each.
add_array_format() {
  cat >"$copy/sim/base/array/dummy_arrays.cpp" <<'CPP'
#include "sim/base/array/array_format.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace {

constexpr std::string_view kDummy = "DUMMY";

class DummyArrays : public ArrayFile {
 public:
  DummyArrays(const std::string& name, std::string_view bytes)
      : ArrayFile(name, "dummy"), bytes_(bytes.data() != nullptr ? std::string(bytes) : input_bytes(name, "a dummy")) {
    if (bytes_.size() < kDummy.size() + 2) throw unreadable(name_, "the file is truncated");
    StoredArray image;
    image.name = "image";
    for (const std::size_t at : {kDummy.size() + 1, kDummy.size()})
      image.dims.push_back(static_cast<unsigned char>(bytes_[at]));
    arrays_ = {image};
  }

 private:
  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    return block_of(std::string_view(bytes_).substr(kDummy.size() + 2), array, start, count);
  }
  std::string bytes_;
};

}  // namespace

bool is_dummy(std::string_view beginning) { return beginning.substr(0, kDummy.size()) == kDummy; }

std::unique_ptr<ArrayFile> open_dummy(const std::string& name, std::string_view bytes) {
  return std::make_unique<DummyArrays>(name, bytes);
}

}  // namespace vegard::sim
CPP
  insert_before '^struct ArrayFormat' sim/base/array/array_format.h 'IsArrayFormat is_dummy; OpenArrayFile open_dummy;'
  sed -i 's/kArrayFormats\[\] = {/&{"dummy", is_dummy, open_dummy, true}, /' "$copy/sim/base/array/array_format.h"
  insert_before '^Arrays of one size' docs/file_formats.md '- dummy: its image'
  insert_before '^### Added' CHANGELOG.md '- Dummies are read.'
  expect_edits 3
  compile vegard_sim sim/base/array/array_format.cpp sim/base/array/dummy_arrays.cpp
  compile vegard_fit fit/photo/frames/open_frame_store.cpp
  link
  { printf 'DUMMY\x05\x03' && printf '\x10%.0s' {1..15}; } >"$work/picture.dummy"
  is_described 5 x 3
}

# A format of pictures: "GREY", width and height in a byte each, pixels in a byte each.
add_picture_format() {
  cat >"$copy/fit/photo/codec/grey_picture.cpp" <<'CPP'
#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"

namespace vegard::fit {

ImageFile walk_grey(std::string_view bytes, const std::string& file) {
  ImageFile image;
  if (bytes.size() < 6) throw sim::truncated(file, "it has no size");
  image.width = static_cast<unsigned char>(bytes[4]);
  image.height = static_cast<unsigned char>(bytes[5]);
  if (bytes.size() != 6 + static_cast<std::size_t>(image.width * image.height))
    throw sim::truncated(file, "its last pixels are missing");
  return image;
}

PictureCodes decode_grey(std::string_view bytes, const ImageFile& image, const std::string& /*file*/) {
  PictureCodes codes;
  codes.width = static_cast<int>(image.width);
  codes.height = static_cast<int>(image.height);
  codes.channels = 1;
  codes.kind = kind_of_codes(image);
  for (const char pixel : bytes.substr(6)) codes.values.push_back(static_cast<unsigned char>(pixel));
  return codes;
}

}  // namespace vegard::fit
CPP
  insert_before '^struct PictureFormat [{]' fit/photo/codec/picture_format.h 'WalkPicture walk_grey; DecodePicture decode_grey;'
  insert_before '^      {"HEIC"' fit/photo/codec/picture_format.h '      {"GREY", {".grey"}, {"GREY"sv}, nullptr, walk_grey, decode_grey},'
  insert_before '^White pixels and NaN' docs/file_formats.md '- sRGB: GREY'
  insert_before '^### Added' CHANGELOG.md '- Pictures in GREY are read.'
  expect_edits 3
  compile vegard_fit fit/photo/codec/picture_format.cpp fit/photo/codec/grey_picture.cpp
  link
  { printf 'GREY\x06\x04' && printf '\x20%.0s' {1..24}; } >"$work/picture.dummy"
  is_described 6 x 4
}

# is_described SIZE...: the program reads picture.dummy, and the one without the addition does not.
is_described() {
  "$build/vegard" describe "$work/picture.dummy" >/dev/null 2>&1 && fail "$kind: it is read without the addition"
  "$work/vegard" describe "$work/picture.dummy" >"$work/words" 2>&1 || { cat "$work/words" >&2; fail "$kind: it is not read"; }
  grep -q -- "$*" "$work/words" || { cat "$work/words" >&2; fail "$kind: its size is not told"; }
}

# shellcheck source=tests/house/adding/statistic_and_number.sh
source "$root/tests/house/adding/statistic_and_number.sh"

for kind in subcommand array_format picture_format statistic result_number; do
  rm -rf "$work/before"
  fresh_copy
  "add_$kind"
done
