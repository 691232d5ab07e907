#include "fit/answer/tables_correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/line_light.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::fit {
namespace {

constexpr double kModeDifference = 0.1;  // standard deviations, to either side
constexpr double kTablesRefuted = 2.0;   // standard deviations
constexpr double kTablesNarrowed = 0.5;  // of the tables' error
constexpr double kSameCourse = 1e-6;     // of logarithms: as that of the reference, but for rounding

/// The first sheet whose light comes from the tables; -1 if there is none.
int sheet_of_tables(const sim::Scene& scene) {
  const auto found = std::find_if(scene.sheets.begin(), scene.sheets.end(), [](const sim::Sheet& sheet) {
    return sim::is_of_electrons(sheet.profile);
  });
  return found == scene.sheets.end() ? -1 : static_cast<int>(found - scene.sheets.begin());
}

struct ColumnOfLine {
  double wavelength_nm = 0.0, rayleigh = 0.0;
  Eigen::VectorXd by_mode;  ///< of the logarithm
};

std::vector<ColumnOfLine> columns_of_lines(const sim::Scene& scene, int sheet,
                                           const std::vector<int>& modes) {
  std::vector<ColumnOfLine> columns;
  for (const double nm : scene.emission.lines) {
    if (!sim::has_line(nm, scene, sheet)) continue;
    const auto light = [&](int mode, double step) {
      sim::Scene changed = scene;
      sim::add_to_mode(changed, mode, step);
      return sim::line_light(nm, changed, sheet).column_rayleigh;
    };
    ColumnOfLine column{nm, sim::line_light(nm, scene, sheet).column_rayleigh,
                        Eigen::VectorXd(static_cast<Eigen::Index>(modes.size()))};
    if (!(column.rayleigh > 0.0)) continue;
    for (std::size_t m = 0; m < modes.size(); ++m)
      column.by_mode(static_cast<Eigen::Index>(m)) =
          std::log(light(modes[m], kModeDifference) / light(modes[m], -kModeDifference)) /
          (2.0 * kModeDifference);
    columns.push_back(column);
  }
  return columns;
}

}  // namespace

std::vector<LineByModes> lines_by_modes(const sim::Scene& best, const std::vector<int>& modes) {
  const int sheet = sheet_of_tables(best);
  if (sheet < 0 || modes.empty()) return {};
  const std::vector<ColumnOfLine> columns = columns_of_lines(best, sheet, modes);
  const auto reference =
      std::max_element(columns.begin(), columns.end(), [](const ColumnOfLine& a, const ColumnOfLine& b) {
        const bool a_is_green = a.wavelength_nm == sim::kGreenNm,
                   b_is_green = b.wavelength_nm == sim::kGreenNm;
        return a_is_green != b_is_green ? b_is_green : a.rayleigh < b.rayleigh;
      });
  std::vector<LineByModes> lines;
  for (const ColumnOfLine& line : columns) {
    const Eigen::VectorXd by_mode = line.by_mode - reference->by_mode;
    if (!(by_mode.norm() > kSameCourse)) continue;
    lines.push_back({line.wavelength_nm, reference->wavelength_nm, {}});
    lines.back().ln_ratio.assign(by_mode.data(), by_mode.data() + by_mode.size());
  }
  return lines;
}

std::vector<TablesCorrection> tables_corrections(const std::vector<LineByModes>& lines,
                                                 const LearntModes& learnt) {
  std::vector<TablesCorrection> corrections;
  for (const LineByModes& line : lines) {
    const Eigen::Map<const Eigen::VectorXd> by_mode(line.ln_ratio.data(),
                                                    static_cast<Eigen::Index>(line.ln_ratio.size()));
    TablesCorrection c;
    c.wavelength_nm = line.wavelength_nm;
    c.over_nm = line.over_nm;
    c.ln_sigma_of_tables = by_mode.norm();
    c.ln_sigma = std::sqrt(std::max(0.0, by_mode.dot(learnt.covariance * by_mode)));
    const double ln_factor = by_mode.dot(learnt.value);
    c.factor = std::exp(ln_factor);
    if (std::abs(ln_factor) > kTablesRefuted * c.ln_sigma ||
        c.ln_sigma < kTablesNarrowed * c.ln_sigma_of_tables)
      corrections.push_back(c);
  }
  return corrections;
}

std::string correction_words(const std::string& what, double factor, double ln_sigma,
                             double ln_sigma_of_tables) {
  return fmt::format(
      "{}: these data ask for {:.2f} ± {:.2f} of the tables' light, which is known to {:.0f} %", what, factor,
      factor * ln_sigma, 100.0 * ln_sigma_of_tables);
}

std::string correction_words(const TablesCorrection& c) {
  return correction_words(sim::line_words(c.wavelength_nm) + " over " + sim::line_words(c.over_nm), c.factor,
                          c.ln_sigma, c.ln_sigma_of_tables);
}

}  // namespace vegard::fit
