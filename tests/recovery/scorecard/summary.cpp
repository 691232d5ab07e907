#include "tests/recovery/scorecard/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "tests/recovery/scorecard/score.h"

namespace vegard::scorecard {
namespace {

using Which = std::function<bool(const Row&)>;

std::vector<std::string> missed(const Row& row) {
  std::vector<std::string> all;
  for (int s = 0; s < row.sheets; ++s)
    for (const std::string& name : missed_criteria(row.sheet[s])) all.push_back(name);
  return all;
}

bool recovered(const Row& row) { return missed(row).empty(); }

/// "12 of 20 | 60 ± 11 %": a share with its binomial standard error.
std::string share_cells(int hits, int of) {
  if (of == 0) return "0 of 0 | –";
  const double p = static_cast<double>(hits) / of;
  return fmt::format("{} of {} | {:.1f} ± {:.1f} %", hits, of, 100.0 * p,
                     100.0 * std::sqrt(p * (1.0 - p) / of));
}

std::string by_class(const std::vector<Row>& rows) {
  const std::vector<std::pair<std::string, Which>> classes = {
      {"all", [](const Row&) { return true; }},
      {"beams", [](const Row& r) { return r.line_of_sight == 0; }},
      {"lines of sight", [](const Row& r) { return r.line_of_sight != 0; }},
      {"one sheet", [](const Row& r) { return r.sheets == 1; }},
      {"two sheets", [](const Row& r) { return r.sheets == 2; }},
      {"with rays", [](const Row& r) { return r.rays != 0; }},
      {"without rays", [](const Row& r) { return r.rays == 0; }},
      {"with folds", [](const Row& r) { return r.folds != 0; }},
      {"without folds", [](const Row& r) { return r.folds == 0; }},
  };
  std::string text = "| scenes | recovered | share |\n|---|---|---|\n";
  for (const auto& [name, which] : classes) {
    const auto of = std::count_if(rows.begin(), rows.end(), which);
    const auto hits = std::count_if(rows.begin(), rows.end(),
                                    [&, &is = which](const Row& r) { return is(r) && recovered(r); });
    text += fmt::format("| {} | {} |\n", name, share_cells(static_cast<int>(hits), static_cast<int>(of)));
  }
  return text;
}

std::string by_criterion(const std::vector<Row>& rows) {
  std::map<std::string, int> misses;
  int sheets = 0, with_waves = 0;
  for (const Row& row : rows)
    for (int s = 0; s < row.sheets; ++s) {
      ++sheets;
      if (row.sheet[s].waves_in_view >= Criteria::kWavesInView) ++with_waves;
      for (const std::string& name : missed_criteria(row.sheet[s])) ++misses[name];
    }
  std::string text = "| criterion, per sheet | met | share |\n|---|---|---|\n";
  for (const char* name : {"E0", "distance", "bearing", "wavelength", "amplitude"}) {
    const int of = std::string(name) == "wavelength" ? with_waves : sheets;
    text += fmt::format("| {} | {} |\n", name, share_cells(of - misses[name], of));
  }
  return text;
}

std::string confusion(const std::vector<Row>& rows) {
  std::string text = "| verdict | recovered | not recovered |\n|---|---|---|\n";
  int told[2] = {0, 0}, all[2] = {0, 0};
  for (const char* verdict : {"good", "doubtful", "failed", "interrupted"}) {
    int counts[2] = {0, 0};
    for (const Row& row : rows)
      if (row.verdict == verdict) ++counts[recovered(row) ? 0 : 1];
    for (int i = 0; i < 2; ++i) {
      all[i] += counts[i];
      if (std::string(verdict) != "good") told[i] += counts[i];
    }
    if (counts[0] + counts[1] > 0) text += fmt::format("| {} | {} | {} |\n", verdict, counts[0], counts[1]);
  }
  return text + "\n| | count | share |\n|---|---|---|\n| recovered, but not called good | " +
         share_cells(told[0], all[0]) + " |\n| not recovered, and not called good | " +
         share_cells(told[1], all[1]) + " |\n";
}

/// Of each quantity of each sheet: how often it was called good where it is right, and where it is wrong.
std::string trust_by_quantity(const std::vector<Row>& rows) {
  struct Asked {
    const char* name;
    bool (*is_right)(const SheetRow&);
    std::string SheetRow::*trust;
  };
  static const auto meets = [](const SheetRow& sheet, const char* criterion) {
    const std::vector<std::string> all = missed_criteria(sheet);
    return std::find(all.begin(), all.end(), criterion) == all.end();
  };
  const Asked all[] = {
      {"E0", [](const SheetRow& s) { return meets(s, "E0"); }, &SheetRow::energy_trust},
      {"distance", [](const SheetRow& s) { return meets(s, "distance"); }, &SheetRow::distance_trust},
      {"lower border",
       [](const SheetRow& s) { return std::abs(s.border_km - s.border_true_km) <= Criteria::kBorder_km; },
       &SheetRow::border_trust},
      {"bearing", [](const SheetRow& s) { return meets(s, "bearing"); }, &SheetRow::bearing_trust},
      {"wavelength", [](const SheetRow& s) { return meets(s, "wavelength"); }, &SheetRow::wavelength_trust},
      {"amplitude", [](const SheetRow& s) { return meets(s, "amplitude"); }, &SheetRow::amplitude_trust}};
  std::string text =
      "| quantity, per sheet | not called good where right | share | not called good where wrong | share "
      "|\n|---|---|---|---|---|\n";
  for (const Asked& asked : all) {
    int doubted[2] = {0, 0}, of[2] = {0, 0};
    for (const Row& row : rows)
      for (int s = 0; s < row.sheets; ++s) {
        const int wrong = asked.is_right(row.sheet[s]) ? 0 : 1;
        ++of[wrong];
        if (row.sheet[s].*asked.trust != "good") ++doubted[wrong];
      }
    text += fmt::format("| {} | {} | {} |\n", asked.name, share_cells(doubted[0], of[0]),
                        share_cells(doubted[1], of[1]));
  }
  // Only the ends of a sheet tell these, which stand outside of most pictures.
  for (const auto& [name, trust] :
       {std::pair("length", &SheetRow::length_trust), {"phase", &SheetRow::phase_trust}}) {
    int told[3] = {0, 0, 0}, asked = 0;
    for (const Row& row : rows)
      for (int s = 0; s < row.sheets; ++s) {
        const std::string& word = row.sheet[s].*trust;
        if (word.empty()) continue;
        ++asked;
        ++told[word == "good" ? 0 : word == "doubtful" ? 1 : 2];
      }
    if (asked > 0)
      text += fmt::format("\n{} of {} sheets: good {}, doubtful {}, unconstrained {}\n", name, asked, told[0],
                          told[1], told[2]);
  }
  return text;
}

std::string coverage(const std::vector<Row>& rows, const std::string& title, const Which& which) {
  struct Number {
    const char* name;
    std::vector<double> z;
    int without = 0;
    void take(double value) {
      if (std::isfinite(value))
        z.push_back(value);
      else
        ++without;
    }
  };
  Number numbers[3] = {{"E0", {}}, {"distance", {}}, {"brightness ratio", {}}};
  for (const Row& row : rows) {
    if (!which(row)) continue;
    for (int s = 0; s < row.sheets; ++s) {
      numbers[0].take(row.sheet[s].energy_z);
      numbers[1].take(row.sheet[s].distance_z);
    }
    if (row.sheets == 2) numbers[2].take(row.ratio_z);
  }
  std::string text = "| " + title +
                     " | in 68 % | share | in 95 % | share | mean z | rms z | without an interval "
                     "|\n|---|---|---|---|---|---|---|---|\n";
  for (const Number& number : numbers) {
    constexpr double k68 = 1.0, k95 = 1.959964;
    const int n = static_cast<int>(number.z.size());
    const auto inside = [&](double most) {
      return static_cast<int>(
          std::count_if(number.z.begin(), number.z.end(), [most](double z) { return std::abs(z) <= most; }));
    };
    double sum = 0.0, squares = 0.0;
    for (const double z : number.z) {
      sum += z;
      squares += z * z;
    }
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", number.name, share_cells(inside(k68), n),
                        share_cells(inside(k95), n), n > 0 ? fmt::format("{:.2f}", sum / n) : "–",
                        n > 0 ? fmt::format("{:.2f}", std::sqrt(squares / n)) : "–", number.without);
  }
  return text;
}

double median(std::vector<double> values) {
  if (values.empty()) return kNone;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::string cost(const std::vector<Row>& rows) {
  std::string text =
      "| sheets | scenes | median evaluations | with a Jacobian | seconds of one thread | chi² / dof |\n"
      "|---|---|---|---|---|---|\n";
  for (const int sheets : {1, 2}) {
    std::vector<double> evaluations, jacobians, seconds, chi2;
    for (const Row& row : rows) {
      if (row.sheets != sheets) continue;
      evaluations.push_back(row.evaluations);
      jacobians.push_back(row.jacobians);
      seconds.push_back(row.seconds);
      chi2.push_back(row.chi2_per_dof);
    }
    text += fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.2f} |\n", sheets, evaluations.size(),
                        median(evaluations), median(jacobians), median(seconds), median(chi2));
  }
  return text;
}

std::string failures(const std::vector<Row>& rows) {
  std::string text =
      "| scene | sheets | drawn by | rays | folds | verdict | missed | E0, true / found (keV) | distance "
      "(km) | "
      "bearing (°) | wavelength (km) | amplitude (km) | waves in view | chi² / dof |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    if (recovered(row)) continue;
    const auto pairs = [&](double SheetRow::*is, double SheetRow::*found, const char* format) {
      std::string cell;
      for (int s = 0; s < row.sheets; ++s)
        cell += (s > 0 ? ", " : "") + fmt::format(fmt::runtime(format), row.sheet[s].*is) + " / " +
                fmt::format(fmt::runtime(format), row.sheet[s].*found);
      return cell;
    };
    std::string waves;
    for (int s = 0; s < row.sheets; ++s)
      waves += (s > 0 ? ", " : "") + fmt::format("{:.1f}", row.sheet[s].waves_in_view);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} |\n",
                        row.scene, row.sheets, row.line_of_sight ? "lines of sight" : "beams",
                        row.rays ? "yes" : "no", row.folds ? "yes" : "no", row.verdict, row.missed,
                        pairs(&SheetRow::energy_true_kev, &SheetRow::energy_kev, "{:.2f}"),
                        pairs(&SheetRow::distance_true_km, &SheetRow::distance_km, "{:.1f}"),
                        pairs(&SheetRow::bearing_true_deg, &SheetRow::bearing_deg, "{:.1f}"),
                        pairs(&SheetRow::wavelength_true_km, &SheetRow::wavelength_km, "{:.1f}"),
                        pairs(&SheetRow::thickness_true_km, &SheetRow::thickness_km, "{:.2f}"), waves,
                        row.chi2_per_dof);
  }
  return text;
}

}  // namespace

std::string summary(const std::vector<Row>& rows) {
  return by_class(rows) + "\n" + by_criterion(rows) + "\n" + confusion(rows) + "\n" +
         trust_by_quantity(rows) + "\n" + coverage(rows, "recovered", recovered) + "\n" +
         coverage(rows, "called good", [](const Row& r) { return r.verdict == "good"; }) + "\n" +
         coverage(rows, "all", [](const Row&) { return true; }) + "\n" + cost(rows) + "\nNot recovered:\n\n" +
         failures(rows);
}

}  // namespace vegard::scorecard
