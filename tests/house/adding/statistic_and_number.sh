# Read by adding_test.sh, which has `copy`, `work`, `build`, `insert_before`, `expect_edits`, `compile`, `link` and `fail`: a dummy of a
# statistic and one of a number of the result.

# A statistic of one residual, 0.5 whatever the model is.
add_statistic() {
  cat >"$copy/fit/compare/dummy_statistic.h" <<'CPP'
#pragma once

#include "fit/compare/statistic.h"

namespace vegard::fit {

class DummyStatistic final : public Statistic {
 public:
  std::size_t residuals() const override { return 1; }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override {
    residual[0] = 0.5;
    for (int j = 0; jacobian != nullptr && j < input.light.free; ++j) jacobian[j] = 0.0;
  }
};

}  // namespace vegard::fit
CPP
  sed -i 's/^enum class StatisticKind {.* texture, /&dummy, /' "$copy/sim/scene/structs/statistic_kinds.h"
  insert_before 'StatisticFacts.StatisticKind::granulation' sim/scene/structs/statistic_kinds.h \
    '    StatisticFacts{StatisticKind::dummy, "dummy", "weight of the dummy", 0.0, false, nullptr},'
  insert_before '^#include "fit/compare/granulation' fit/compare/statistics.cpp '#include "fit/compare/dummy_statistic.h"'
  insert_before '^    .StatisticKind::granulation' fit/compare/statistics.cpp \
    '    {StatisticKind::dummy, [](const StatisticSource&) { return made<DummyStatistic>(); }},'
  insert_before '^- `granulation_weight`' docs/fitting.md '- `dummy_weight`: nothing'
  expect_edits 3
  compile vegard_sim sim/scene/structs/scene.cpp sim/scene/rows/fit.cpp
  compile vegard_fit fit/compare/statistics.cpp fit/compare/comparison.cpp
  link
  "$work/vegard" params >"$work/words"
  grep -q 'dummy_weight' "$work/words" || fail "$kind: it has no key"
  fit_small --set fit.dummy_weight=2
  tr -d ' \n' <"$work/run/result.json" | grep -q '{"name":"dummy","weight":2.0,"residuals":1,"chi2":0.25}' ||
    fail "$kind: the result does not have it"
}

# A number of the result: three.
add_result_number() {
  cat >"$copy/fit/answer/dummy_number.h" <<'CPP'
#pragma once

#include "fit/answer/fit_result.h"

namespace vegard::fit {

inline std::optional<double> dummy_number(const FitResult& result) { return result.photos.empty() ? 2.0 : 3.0; }

}  // namespace vegard::fit
CPP
  insert_before '^namespace' fit/answer/result_numbers.cpp '#include "fit/answer/dummy_number.h"'
  insert_before '^      ."gradient_cosine"' fit/answer/result_numbers.cpp \
    '      {"dummy", "the dummy", Group::misfit, Form::number, dummy_number, nullptr, "The dummy", "It is three."},'
  insert_before '^- `gradient_cosine`' docs/file_formats.md '- `dummy`: three'
  expect_edits 2
  compile vegard_fit fit/answer/result_numbers.cpp
  link
  fit_small
  grep -q '"dummy": 3.0' "$work/run/result.json" || fail "$kind: result.json does not have it"
  grep -q 'The dummy.*It is three' "$work/run/report.html" || fail "$kind: the report does not show it"
}

# fit_small OPTION...: a short fit of a small picture, in the folder run.
fit_small() {
  local scenes=$root/tests/cli/scenes status=0
  rm -rf "$work/run" "$work/photo.png"
  "$work/vegard" render "$scenes/small.toml" -o "$work/photo.png" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "$kind: nothing renders"; }
  "$work/vegard" fit "$scenes/fit.toml" --photo "$work/photo.png" --out "$work/run" --max-evaluations 6 "$@" >>"$work/log" 2>&1 || status=$?
  [[ $status == [045] && -e $work/run/result.json ]] || { cat "$work/log" >&2; fail "$kind: the fit ends with $status"; }
}
