#!/usr/bin/env bash
# Installs the current build, moves it elsewhere, and builds and runs an outside project against it.
# usage: install_test.sh CMAKE SOURCE_DIR BUILD_DIR COMPILER FLAGS [PYTHON PYTHON_DIR]
# With an interpreter, the module of PYTHON_DIR below the prefix is to be there too, and to work.
set -euo pipefail
cmake=$1 source=$2 build=$3 compiler=$4 flags=$5 python=${6:-} python_dir=${7:-}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "install_test: $*" >&2
  exit 1
}

# Runs quietly; shows what was said only if it went wrong.
run() {
  "$@" >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail "failed: $*"
  }
}

run "$cmake" --install "$build" --prefix "$work/first"
mv "$work/first" "$work/moved" # an installed package is used where it is found, not where it was made
prefix=$work/moved

for file in bin/vegard include/vegard/sim/base/image.h include/vegard/fit/scene_fit.h share/vegard/data/README.md \
  share/vegard/data/glow/ver_maxwellian.csv share/vegard/data/glow/glowlicense.txt share/doc/vegard/LICENSE \
  share/doc/vegard/NOTICE share/man/man1/vegard-fit.1 share/bash-completion/completions/vegard \
  share/zsh/vendor-completions/_vegard share/fish/vendor_completions.d/vegard.fish; do
  [[ -e $prefix/$file ]] || fail "$file is not installed"
done
if grep -rlF -e "$source/" -e "$build/" --include='*.cmake' --include='*.h' "$prefix" >&2; then
  fail "the files above name the folder they were built in"
fi

# The program finds its modules, and so does one that others build, below.
(cd "$work" && run "$prefix/bin/vegard" render "$source/tests/cli/scenes/small.toml" -o installed.png)

# What is not promised, or needed by what is, is not installed.
for header in sim/base/data_folders.h sim/render/beams/kernel.h fit/search/search.h; do
  [[ -e $source/$header && ! -e $prefix/include/vegard/$header ]] || fail "$header is installed, or no more there"
done

# The example of the documentation, word for word.
awk '/^```cpp$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$source/docs/library.md" >"$work/example.cpp"
[[ -s $work/example.cpp ]] || fail "docs/library.md has no example"
run "$cmake" -S "$source/tests/house/outside" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" -DEXAMPLE="$work/example.cpp" \
  -DPUBLIC_HEADERS="$source/cmake/public_headers.txt"
run "$cmake" --build "$work/build"
run "$work/build/outside"
cp "$source/data/examples/h000/scene.toml" "$source/data/examples/h000/photo.jpg" "$work"
(cd "$work" && run "$work/build/example" scene.toml photo.jpg)
grep -q '^Believable' "$work/log" || fail "the example of docs/library.md finds something else: $(cat "$work/log")"
[[ -s $work/run/report.html && -s $work/light.exr ]] || fail "the example of docs/library.md writes something else"

if [[ -n $python ]]; then
  for file in __init__.py __init__.pyi py.typed; do
    [[ -e $prefix/$python_dir/vegard/$file ]] || fail "$python_dir/vegard/$file is not installed"
  done
  # From elsewhere than the sources, whose own folder has a module of that name too.
  (cd "$work" && run env "PYTHONPATH=$prefix/$python_dir" "$python" -B -c \
    'import vegard; assert vegard.parse("[camera]\nwidth = 48\nheight = 32\n").render().rayleigh.shape == (32, 48, 3)')
fi
