#include "sim/light/ionosphere/ionosphere_model.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/scene/table/emission_folder.h"

namespace vegard::sim {
namespace {

/// What is drawn besides the numbers of uncertainties.csv, behind its tables.
constexpr std::uint32_t kCollisionTable = 4, kIonCollisions = 1, kElectronCollisions = 2, kNight = 3;
constexpr double kCollisionSigma = 0.2, kNightSigma = 1.1;  // the night's ions: a factor of 3
/// Total ionisation of N2, O2 and O among the processes.
constexpr std::array<int, kGases> kTotalIonisation = {110, 210, 310};

double drawn_factor(std::uint64_t seed, std::uint32_t draw, std::uint32_t which, double sigma_ln) {
  const Words words = random_words(seed, Stream::physics, draw, kCollisionTable, which);
  return std::exp(sigma_ln * normal_quantile(uniform(words[0])));
}

double factor_in(const std::map<int, double>& factors, int number) {
  const auto found = factors.find(number);
  return found == factors.end() ? 1.0 : found->second;
}

}  // namespace

AirTable air_of_tables(const EmissionTables& tables) {
  const TableFolder& folder = tables.folder();
  return read_air_table(folder.files.at(kTablesAirFile), folder.place + "/" + kTablesAirFile);
}

IonospherePhysics drawn_physics(const PhysicsDraw& numbers) {
  IonospherePhysics physics;
  physics.reactions = physics.reactions.scaled(numbers.reactions);
  for (std::size_t g = 0; g < kGases; ++g)
    physics.ionisation[g] = factor_in(numbers.processes, kTotalIonisation[g]);
  return physics;
}

IonosphereModel::IonosphereModel(const EmissionTables& tables, const IonosphereRequest& request)
    : tables_(tables), request_(request), altitudes_km_(tables.maxwellian().altitudes_km()) {
  if (!tables.maxwellian().has("ionisation_electron"))
    throw unreadable(tables.folder().place + "/" + kMaxwellianFile, "the tables have no ion pairs")
        .expected("a column ionisation_electron, as vegard tables writes it");
  const AirTable own = with_oxygen_factor(air_of_tables(tables), request.oxygen_factor);
  table_ = request.air ? *request.air : own;
  own_ = ionosphere_air(own, altitudes_km_, request.place);
  air_ = ionosphere_air(table_, altitudes_km_, request.place);
  const bool is_maxwellian = request.spectrum.kind == ElectronSpectrum::Kind::maxwellian;
  least_kev_ = is_maxwellian ? tables.energies_kev().front() : tables.mono().min_energy_kev();
  most_kev_ = is_maxwellian ? tables.energies_kev().back() : tables.mono().max_energy_kev();
}

bool IonosphereModel::is_steady() const { return std::isinf(request_.seconds); }

std::vector<double> IonosphereModel::pairs_at(double energy_kev, double energy_flux_mw_m2) const {
  return ion_pairs(tables_, request_.spectrum, energy_kev, energy_flux_mw_m2, request_.oxygen_factor);
}

Ionosphere IonosphereModel::at(double energy_kev, double energy_flux_mw_m2) const {
  std::vector<double> pairs = pairs_at(energy_kev, energy_flux_mw_m2);
  if (request_.air) pairs = moved_ion_pairs(pairs, own_, air_);
  IonospherePhysics physics;
  physics.seconds = request_.seconds;
  return ionosphere(air_, pairs, physics);
}

std::vector<double> IonosphereModel::altitudes_of_draws_km(std::size_t stride) const {
  std::vector<double> altitudes;
  for (std::size_t i = 0; i < altitudes_km_.size(); i += stride) altitudes.push_back(altitudes_km_[i]);
  return altitudes;
}

Ionosphere IonosphereModel::drawn(double energy_kev, double energy_flux_mw_m2, std::uint64_t seed,
                                  std::uint32_t draw, std::size_t stride) const {
  const PhysicsDraw numbers = draw_physics(seed, draw);
  IonospherePhysics physics = drawn_physics(numbers);
  physics.seconds = request_.seconds * numbers.of_the_air.at(UncertainAir::seconds);
  physics.collisions = {drawn_factor(seed, draw, kIonCollisions, kCollisionSigma),
                        drawn_factor(seed, draw, kElectronCollisions, kCollisionSigma)};
  physics.night = drawn_factor(seed, draw, kNight, kNightSigma);
  const IonosphereAir air =
      ionosphere_air(changed_air(table_, numbers.of_the_air), altitudes_of_draws_km(stride), request_.place);
  return ionosphere(air, moved_ion_pairs(pairs_at(energy_kev, energy_flux_mw_m2), own_, air), physics);
}

}  // namespace vegard::sim
