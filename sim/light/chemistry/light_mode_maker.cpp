#include "sim/light/chemistry/light_mode_maker.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/parallel.h"
#include "sim/light/chemistry/physics_draw.h"
#include "sim/light/tables/light_modes.h"

namespace vegard::sim {
namespace {

/// Light that is less than this of a line's peak is as good as none: its changes are damped to 0 in
/// logarithms.
constexpr double kFaintOfPeak = 1e-4;
constexpr std::size_t kEveryOther = 2;  // of the energies and altitudes that the tables have

/// The light of all lines at all energies: [column][energy][altitude].
using LightOfLines = std::vector<std::vector<std::vector<double>>>;

std::vector<double> energies_of_modes(const TableRequest& request) {
  std::vector<double> kev;
  for (std::size_t e = 0; e < request.maxwellian_kev.size(); ++e)
    if (e % kEveryOther == 0 || e + 1 == request.maxwellian_kev.size())
      kev.push_back(request.maxwellian_kev[e]);
  return kev;
}

std::vector<std::size_t> altitudes_of_modes() {
  std::vector<std::size_t> rows;
  const std::size_t all = made_altitudes_km().size();
  for (std::size_t a = 0; a < all; ++a)
    if (a % kEveryOther == 0 || a + 1 == all) rows.push_back(a);
  return rows;
}

/// The changes of light against that of the usual numbers.
class Changes {
 public:
  Changes(std::vector<std::string> columns, LightOfLines usual)
      : columns_(std::move(columns)), usual_(std::move(usual)) {
    const std::vector<double> altitudes = made_altitudes_km();
    for (std::size_t c = 0; c < columns_.size(); ++c)
      for (const std::vector<double>& rate : usual_[c]) {
        double column = 0.0;
        std::vector<double> shares;
        for (std::size_t a = 0; a < rate.size(); ++a) {
          const double below = altitudes[a] - altitudes[a > 0 ? a - 1 : a],
                       above = altitudes[a + 1 < rate.size() ? a + 1 : a] - altitudes[a];
          shares.push_back(0.5 * (below + above) * rate[a]);
          column += shares.back();
        }
        for (const double share : shares)
          weight_.push_back(column > 0.0 ? mode_weight(columns_[c]) * share / column : 0.0);
      }
  }

  std::size_t size() const { return weight_.size(); }

  /// Returns the changes of the logarithm, without weights.
  Eigen::VectorXd of(const LightOfLines& light) const {
    Eigen::VectorXd change(static_cast<Eigen::Index>(size()));
    Eigen::Index i = 0;
    for (std::size_t c = 0; c < usual_.size(); ++c)
      for (std::size_t e = 0; e < usual_[c].size(); ++e) {
        const std::vector<double>&before = usual_[c][e], &now = light[c][e];
        const double faint = kFaintOfPeak * *std::max_element(before.begin(), before.end());
        for (std::size_t a = 0; a < before.size(); ++a)
          change[i++] = faint > 0.0 ? std::log((now[a] + faint) / (before[a] + faint)) : 0.0;
      }
    return change;
  }

  Eigen::VectorXd weights() const {
    return Eigen::Map<const Eigen::VectorXd>(weight_.data(), static_cast<Eigen::Index>(size()));
  }

 private:
  std::vector<std::string> columns_;
  LightOfLines usual_;
  std::vector<double> weight_;  ///< [column][energy][altitude]
};

LightOfLines light_of_lines(const TableRequest& request, const std::vector<double>& energies_kev,
                            const std::map<int, double>& processes) {
  const Degradation degradation = table_degradation(request, processes);
  LightOfLines light;
  for (const double energy : energies_kev) {
    const MadeLight made = made_light({SpectrumKind::maxwellian, 1.0, energy, 1.0}, request, degradation);
    light.resize(made.rayleigh.size());
    for (std::size_t c = 0; c < light.size(); ++c) light[c].push_back(made.rates[c]);
  }
  return light;
}

std::vector<std::string> lines_of_tables(const TableRequest& request) {
  std::vector<std::string> names =
      made_light({SpectrumKind::maxwellian, 1.0, request.maxwellian_kev.front(), 1.0}, request,
                 table_degradation(request))
          .names;
  names.pop_back();  // ion pairs
  return names;
}

}  // namespace

double mode_weight(const std::string& column) {
  if (column == "ver_4278") return 4.0;
  if (column == "ver_5577" || column == "ver_6300") return 1.0;
  return column == "ver_5200" ? 0.1 : 0.5;
}

std::string make_light_modes(const TableRequest& request, const ModeRequest& modes, int threads,
                             ModeSummary& summary,
                             const std::function<void(std::size_t, std::size_t)>& progress) {
  require_air_of_tables(request);
  TableRequest usual = request;
  usual.mono_kev.clear();
  usual.refinement *= kModeRefinement;
  usual.air = changed_air(usual.air, {});  // what it leaves to formulae, as the draws have it
  const std::vector<double> energies_kev = energies_of_modes(request);
  const std::vector<std::string> columns = lines_of_tables(usual);
  const auto draws = static_cast<std::size_t>(modes.draws);
  std::vector<LightOfLines> lights(draws + 1);  // the last one: of the usual numbers
  std::atomic<std::size_t> done{0};
  parallel_for(lights.size(), threads, [&](std::size_t d, int) {
    TableRequest drawn = usual;
    PhysicsDraw draw;
    if (d < draws) {
      draw = draw_physics(modes.seed, static_cast<std::uint32_t>(d));
      drawn.reactions = usual.reactions.scaled(draw.reactions);
      drawn.air = changed_air(usual.air, draw.of_the_air);
      drawn.seconds *= draw.of_the_air.at(UncertainAir::seconds);
    }
    lights[d] = light_of_lines(drawn, energies_kev, draw.processes);
    const std::size_t now = ++done;
    if (progress) progress(now, lights.size());
  });

  const Changes changes(columns, lights.back());
  std::vector<Eigen::VectorXd> rows;  // the covariance is the sum of their squares
  for (std::size_t d = 0; d < draws; ++d)
    rows.push_back(changes.of(lights[d]) / std::sqrt(static_cast<double>(draws)));

  // Principal components by the small matrix of inner products: change = sum of sqrt(value) component.
  const auto count = static_cast<Eigen::Index>(rows.size());
  const Eigen::VectorXd weights = changes.weights();
  Eigen::MatrixXd inner(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      inner(i, j) = inner(j, i) =
          rows[static_cast<std::size_t>(i)].cwiseProduct(weights).dot(rows[static_cast<std::size_t>(j)]);
  const SymmetricEigen eigen = symmetric_eigen(inner);
  const double all = eigen.values.sum();
  std::string text = "mode,E0_keV,altitude_km";
  for (const std::string& column : columns) text += "," + column;
  text += "\n";
  const std::vector<double> altitudes = made_altitudes_km();
  summary = {};
  while (summary.modes < kMaxLightModes && summary.modes < count &&
         summary.carried_share < modes.carried_share) {
    const Eigen::Index k = count - 1 - summary.modes;
    // With orthonormal v of the inner products the mode sum of v_i row_i has the norm sqrt(value): one
    // standard deviation.
    Eigen::VectorXd mode = Eigen::VectorXd::Zero(weights.size());
    for (Eigen::Index i = 0; i < count; ++i) mode += eigen.vectors(i, k) * rows[static_cast<std::size_t>(i)];
    if (mode.cwiseProduct(weights).sum() < 0.0) mode = -mode;  // more light, by and large
    ++summary.modes;
    summary.carried_share += eigen.values[k] / all;
    for (std::size_t e = 0; e < energies_kev.size(); ++e)
      for (const std::size_t a : altitudes_of_modes()) {
        text += std::to_string(summary.modes) + table_number(",%.5g", energies_kev[e]) +
                table_number(",%g", altitudes[a]);
        for (std::size_t c = 0; c < columns.size(); ++c)
          text += table_number(
              ",%.4f", mode[static_cast<Eigen::Index>((c * energies_kev.size() + e) * altitudes.size() + a)]);
        text += "\n";
      }
  }
  return text;
}

}  // namespace vegard::sim
