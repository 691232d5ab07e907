#!/usr/bin/env bash
# Does key_literals_test.sh find what it is there to find, and nothing else?
# usage: key_literals_self_check.sh
set -euo pipefail
checker=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/key_literals_test.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree" "$tree.log"' EXIT
failures=0

mkdir -p "$tree/sim/scene/rows" "$tree/sim/scene/emitters" "$tree/fit/search" "$tree/fit/parameters"
cat >"$tree/sim/scene/rows/sheet.cpp" <<'ROWS'
      Row("energy_kev", &Sheet::energy_kev).in("keV").may_be_free(logarithmic)
          .means("energy"),
      Row("center_km", &Sheet::center_km).of({"east", "north"}).in("km")
          .may_be_free(linear),
      Row("camera", "k1", &Scene::camera, &Camera::k1).may_be_free(linear),
      Row("profile", &Sheet::profile).one_of({"form", "file"}),
ROWS

# judge refuses|accepts LINE: the line alone in a file of the search
judge() {
  printf '%s\n' "$2" >"$tree/fit/search/one.cpp"
  local found=refuses
  "$checker" "$tree" >"$tree.log" 2>&1 && found=accepts
  if [[ $found != "$1" ]]; then
    echo "$found, and should not: $2"
    failures=$((failures + 1))
  elif [[ $1 == refuses ]] && ! grep -qF fit/search/one.cpp:1 "$tree.log"; then
    echo "found, but not under its name: $2"
    failures=$((failures + 1))
  fi
}

judge accepts '#include "fit/search/energy_kev"'
judge accepts 'return free.id.role() == ParameterRole::energy;'
judge accepts '// as in key == "energy_kev"'
judge accepts 'complain("set energy_kev of the sheet");'
judge accepts 'if (profile == "form") return;'
judge refuses 'if (number.key() == "energy_kev") return;'
judge refuses 'if ("energy_kev" != key) return;'
judge refuses 'if (is(number, "center_km")) return;'
judge refuses 'if (path == "camera.k1") return;'
judge refuses 'for (const char* key : {"k1", "k2"}) find(key);'
judge refuses 'static const std::set<std::string> kOverall = {"center_km"};'
rm "$tree/fit/search/one.cpp"
printf '%s\n' 'if (key == "k1") return;' >"$tree/fit/parameters/two.cpp"
if "$checker" "$tree" >"$tree.log" 2>&1; then
  echo "not found in fit/parameters"
  failures=$((failures + 1))
fi
rm "$tree/fit/parameters/two.cpp"

# judge_scene refuses|accepts LINE: the line alone in a file of the scene
mkdir -p "$tree/sim/scene/table"
judge_scene() {
  printf '%s\n' "$2" >"$tree/sim/scene/table/one.cpp"
  local found=refuses
  "$checker" "$tree" >"$tree.log" 2>&1 && found=accepts
  if [[ $found != "$1" ]]; then
    echo "$found in sim/scene, and should not: $2"
    failures=$((failures + 1))
  elif [[ $1 == refuses ]] && ! grep -qF sim/scene/table/one.cpp:1 "$tree.log"; then
    echo "found, but not under its name: $2"
    failures=$((failures + 1))
  fi
}

judge_scene accepts 'refuse({"energy_kev is below 0", "a number above 0", ""}, "energy_kev");'
judge_scene accepts 'complain(complaint, {scene.file, 0, "camera.k1"});'
judge_scene accepts 'if (response == "cie") return;'
judge_scene accepts '// as in key == "energy_kev"'
judge_scene refuses 'if (path.row->key == "energy_kev") return;'
judge_scene refuses 'if (key != "profile") return;  // a key that is never free'
judge_scene refuses 'return "k1" == key;'
judge_scene refuses 'if (path.text == "camera.k1") return;'
judge_scene refuses 'if (is_one_of(key, {"center_km", "width"})) return;'
judge_scene refuses 'static const std::set<std::string> kOfSine = {"center_km",'
judge_scene refuses 'if (key.rfind("k1", 0) == 0) return;'
rm "$tree/sim/scene/table/one.cpp"

if "$checker" "$tree/fit" >"$tree.log" 2>&1; then
  echo "a tree without rows is accepted"
  failures=$((failures + 1))
fi

if [[ $failures -gt 0 ]]; then
  echo "$failures of the self-checks failed"
  exit 1
fi
