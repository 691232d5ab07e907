#!/usr/bin/env bash
# The Debian packages: they are made, lintian finds no error in them where it is installed, and each has what it is for.
# usage: package_test.sh CPACK BUILD_FOLDER [python]
set -euo pipefail
cpack=$1
build=$2
names=(vegard vegard-dev)
[[ ${3:-} != python ]] || names+=(python3-vegard)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "FAILED: $*" >&2
  exit 1
}

(cd "$build" && "$cpack" -G DEB -B "$work") >"$work/log" 2>&1 || fail "$(tail -20 "$work/log")"
for name in "${names[@]}"; do
  package=$(echo "$work/$name"_*.deb)
  [[ -f $package ]] || fail "there is no package $name"
  dpkg-deb -c "$package" | awk '{ print $6 }' >"$work/$name.files"
  if command -v lintian >/dev/null; then
    lintian --fail-on error --allow-root "$package" >"$work/lintian" 2>&1 || fail "lintian of $name: $(cat "$work/lintian")"
  fi
done
has() { # PACKAGE FILE
  grep -qxF "./usr/$2" "$work/$1.files" || fail "$1 has no $2"
}
for file in bin/vegard share/man/man1/vegard-fit.1.gz share/vegard/data/glow/glowlicense.txt share/doc/vegard/copyright \
  share/bash-completion/completions/vegard share/applications/vegard-studio.desktop share/icons/hicolor/scalable/apps/vegard.svg; do has vegard $file; done
for name in openexr openimageio openvdb opencv_codecs video movie window; do
  grep -q "^./usr/lib/.*vegard/vegard_$name\.so$" "$work/vegard.files" || fail "vegard has no module vegard_$name"
done
# What only the modules need is asked for too.
for library in libopenexr libopenimageio libopenvdb libopencv-imgcodecs libopencv-videoio libopencv-highgui libavformat; do
  dpkg-deb -f "$work"/vegard_*.deb Depends | grep -q "$library" || fail "vegard does not ask for $library"
done
for file in include/vegard/sim/render/render.h share/doc/vegard-dev/copyright; do has vegard-dev $file; done
if grep -q "^./usr/include" "$work/vegard.files"; then fail "headers are in the program's package"; fi
if [[ ${3:-} == python ]]; then
  for file in __init__.py __init__.pyi py.typed; do has python3-vegard lib/python3/dist-packages/vegard/$file; done
  grep -q "dist-packages/vegard/_vegard.*\.so$" "$work/python3-vegard.files" || fail "python3-vegard has no module"
  dpkg-deb -f "$work"/python3-vegard_*.deb Depends | grep -q "python3-numpy" || fail "python3-vegard does not ask for NumPy"
fi
