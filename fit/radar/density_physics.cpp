#include "fit/radar/density_physics.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/light/ionosphere/ionosphere_model.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::fit {

double EnergyBins::middle_kev(std::size_t bin) const { return std::sqrt(edge_kev[bin] * edge_kev[bin + 1]); }

EnergyBins usual_energy_bins() {
  constexpr int kBins = 36;
  constexpr double kLeastKev = 0.1, kDecades = 3.0;
  EnergyBins bins;
  for (int i = 0; i <= kBins; ++i) bins.edge_kev.push_back(kLeastKev * std::pow(10.0, kDecades * i / kBins));
  return bins;
}

DensityPhysics::DensityPhysics(const sim::EmissionTables& tables, const std::optional<sim::AirTable>& air,
                               sim::RecombinationLaw law, const std::vector<double>& altitudes_km)
    : law_(law), altitudes_km_(altitudes_km), bins_(usual_energy_bins()) {
  if (!tables.maxwellian().has("ionisation_electron"))
    throw sim::unreadable(tables.folder().place + "/" + sim::kMaxwellianFile, "the tables have no ion pairs")
        .expected("a column ionisation_electron, as vegard tables writes it");
  const sim::FieldPlace place;  // ions do not depend on the field
  const sim::AirTable own = sim::air_of_tables(tables);
  table_ = air.value_or(own);
  const std::vector<double>& made_km = tables.mono().altitudes_km();
  of_tables_ = sim::ionosphere_air(own, made_km, place);
  air_ = sim::ionosphere_air(table_, altitudes_km_, place);
  const sim::IonosphereAir at_made = sim::ionosphere_air(table_, made_km, place);
  table_pairs_.setZero(static_cast<Eigen::Index>(made_km.size()), static_cast<Eigen::Index>(bins_.count()));
  pairs_.setZero(static_cast<Eigen::Index>(altitudes_km_.size()), table_pairs_.cols());
  sim::ElectronSpectrum mono;
  mono.kind = sim::ElectronSpectrum::Kind::mono;
  constexpr int kParts = 3;  // of a bin, as electrons' ranges differ within it
  for (std::size_t bin = 0; bin < bins_.count(); ++bin) {
    const auto column = static_cast<Eigen::Index>(bin);
    for (int part = 0; part < kParts; ++part) {
      const double share = (part + 0.5) / kParts;
      const double energy_kev =
          bins_.edge_kev[bin] * std::pow(bins_.edge_kev[bin + 1] / bins_.edge_kev[bin], share);
      const std::vector<double> made = sim::ion_pairs(tables, mono, energy_kev, 1.0 / kParts);
      for (std::size_t i = 0; i < made.size(); ++i)
        table_pairs_(static_cast<Eigen::Index>(i), column) += made[i];
    }
    const Eigen::VectorXd made = table_pairs_.col(column);
    const std::vector<double> list(made.data(), made.data() + made.size());
    const std::vector<double> moved = sim::moved_ion_pairs(list, of_tables_, air_);
    for (std::size_t i = 0; i < moved.size(); ++i) pairs_(static_cast<Eigen::Index>(i), column) = moved[i];
    const std::vector<double> whole = sim::moved_ion_pairs(list, of_tables_, at_made);
    const double middle_kev = bins_.middle_kev(bin);
    const bool is_known =
        middle_kev >= tables.mono().min_energy_kev() && middle_kev <= tables.mono().max_energy_kev();
    const auto most = std::max_element(whole.begin(), whole.end()) - whole.begin();
    peak_km_.push_back(is_known ? made_km[static_cast<std::size_t>(most)] : sim::kNaN);
  }
}

sim::Recombination DensityPhysics::recombination(std::size_t place, double electrons_cm3) const {
  if (law_ == sim::RecombinationLaw::vickrey)
    return {sim::vickrey_recombination_cm3_s(altitudes_km_[place]), 0.0};
  return sim::balance_recombination(air_.places[place], {}, electrons_cm3);
}

DensityPhysics::Change DensityPhysics::drawn(std::uint64_t seed, std::uint32_t draw,
                                             const Eigen::VectorXd& flux_mw_m2,
                                             const Eigen::VectorXd& electrons_cm3) const {
  const sim::PhysicsDraw numbers = sim::draw_physics(seed, draw);
  const sim::IonospherePhysics physics = sim::drawn_physics(numbers);
  const sim::IonosphereAir air =
      sim::ionosphere_air(sim::changed_air(table_, numbers.of_the_air), altitudes_km_, {});
  const Eigen::VectorXd made = table_pairs_ * flux_mw_m2, usual = pairs_ * flux_mw_m2;
  const std::vector<double> moved =
      sim::moved_ion_pairs({made.data(), made.data() + made.size()}, of_tables_, air);
  // Where there is next to nothing, the tables' own floor would be compared.
  constexpr double kNothingOfMost = 1e-5;
  const double nothing = kNothingOfMost * usual.maxCoeff();
  Change change{Eigen::VectorXd::Zero(usual.size()), Eigen::VectorXd::Zero(usual.size())};
  for (Eigen::Index i = 0; i < usual.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const double made_here = sim::ion_production(moved[place], air.places[place], physics).all();
    if (usual[i] > nothing && made_here > nothing) change.ln_pairs[i] = std::log(made_here / usual[i]);
    if (law_ == sim::RecombinationLaw::chemistry)
      change.ln_recombination[i] = std::log(
          sim::balance_recombination(air.places[place], physics, electrons_cm3[i]).coefficient_cm3_s /
          recombination(place, electrons_cm3[i]).coefficient_cm3_s);
  }
  return change;
}

}  // namespace vegard::fit
