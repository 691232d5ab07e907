#include "fit/survey/survey_columns.h"

#include <limits>
#include <tuple>

#include "fit/survey/profile_work.h"

namespace vegard::fit {
namespace {

bool is_in_column(SurveyWork work, const SurveyQuantity& quantity) {
  constexpr int kMiddleStrip = (kSurveyStrips + 1) / 2;
  return work == SurveyWork::profile ? quantity.item == kMiddleStrip : quantity.item <= 1;
}

}  // namespace

bool SurveyColumn::operator<(const SurveyColumn& o) const {
  return std::tie(work, name, unit) < std::tie(o.work, o.name, o.unit);
}

SurveyColumns survey_columns(const SurveyReader& reader) {
  SurveyColumns all;
  reader.frames(0, std::numeric_limits<int>::max(), [&](const FrameAnswer& answer) {
    ++all.frames;
    for (const WorkAnswer& w : answer.works) {
      all.verdicts[w.work].insert(w.verdict);
      for (const SurveyQuantity& q : w.quantities) {
        if (!is_in_column(w.work, q)) continue;
        all.columns.insert({w.work, q.name, q.unit});
        if (q.trust) all.with_trust.insert({w.work, q.name, q.unit});
      }
    }
  });
  return all;
}

const WorkAnswer* work_in(const FrameAnswer& answer, SurveyWork work) {
  for (const WorkAnswer& one : answer.works)
    if (one.work == work) return &one;
  return nullptr;
}

const SurveyQuantity* quantity_in(const WorkAnswer* work, const SurveyColumn& column) {
  if (work == nullptr) return nullptr;
  for (const SurveyQuantity& q : work->quantities)
    if (is_in_column(work->work, q) && q.name == column.name && q.unit == column.unit) return &q;
  return nullptr;
}

}  // namespace vegard::fit
