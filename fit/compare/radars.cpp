#include "fit/compare/radars.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fit/radar/density_table.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/table_files.h"

namespace vegard::fit {
namespace radars {
namespace {

constexpr double kLeastFlux = 0.01;  // of a sheet's largest: three widths away
constexpr double kPerThousand = 1e-3;

using sim::FootElectrons;
using sim::FootPlace;
using sim::NumberAs;

sim::Error refusal(const sim::Scene& scene, const sim::RadarEntry& entry, const std::string& key,
                   const std::string& problem) {
  return sim::Error(sim::ErrorKind::scene, "radar '" + entry.name + "': " + problem)
      .file(scene.file)
      .line(entry.line)
      .key("fit.radar" + (key.empty() ? std::string() : "." + key));
}

sim::ElectronSpectrum spectrum_of(const sim::Sheet& sheet) {
  sim::ElectronSpectrum spectrum;
  spectrum.spread = sheet.energy_spread;
  if (sheet.profile == sim::ProfileKind::gaussian) spectrum.kind = sim::ElectronSpectrum::Kind::gaussian;
  if (sheet.profile == sim::ProfileKind::mono) spectrum.kind = sim::ElectronSpectrum::Kind::mono;
  return spectrum;
}

/// A density follows from electrons whose spectrum and energy flux are known at every foot.
void require_known_electrons(const sim::Scene& scene, const sim::RadarEntry& entry) {
  if (scene.sheets.empty() || !scene.footprints.empty())
    throw refusal(scene, entry, "", "densities are compared with the electrons of sheets")
        .expected("[[sheet]], and no [[footprint]]");
  for (const sim::Sheet& sheet : scene.sheets) {
    const std::string key = "sheet." + sheet.name + ".";
    const auto refuse = [&](const std::string& of, const std::string& problem, const std::string& expected) {
      throw refusal(scene, entry, "", "the sheet '" + sheet.name + "' " + problem)
          .key(key + of)
          .expected(expected);
    };
    if (!sim::is_of_electrons(sheet.profile) || sheet.profile == sim::ProfileKind::form)
      refuse("profile", "has light without known electrons", "\"maxwellian\", \"gaussian\" or \"mono\"");
    if (sim::has_given_brightness(sheet))
      refuse("brightness_kilorayleigh", "has a brightness in place of an energy flux", "energy_flux_mw_m2");
    if (sheet.fold_spacing_km > 0.0 || sheet.curl_spacing_km > 0.0 || sheet.spiral_spacing_km > 0.0)
      refuse("fold_spacing_km", "has folds, curls or spirals, whose places are drawn",
             "0, as of curl_spacing_km and spiral_spacing_km");
  }
}

/// A place on the Earth says nothing of a scene that may be anywhere.
void require_site(const sim::Scene& scene, const sim::RadarEntry& entry) {
  const bool looks_from_site = entry.azimuth_deg && !entry.site_latitude_deg;
  if (looks_from_site || (sim::is_latitude_given(scene) && sim::is_longitude_given(scene))) return;
  throw refusal(scene, entry, "", "where the scene's site is is not given")
      .key("site.latitude_deg, site.longitude_deg")
      .expected("[site] with latitude_deg and longitude_deg");
}

/// The one that is compared.
const DensityProfile& chosen_profile(const sim::Scene& scene, const sim::RadarEntry& entry,
                                     const DensityTable& table) {
  const std::vector<DensityProfile>& all = table.profiles;
  if (all.size() == 1) return all.front();
  if (!entry.time_s)
    throw refusal(
        scene, entry, "time_s",
        fmt::format("{} has {} profiles", std::filesystem::path(entry.file).filename().string(), all.size()))
        .expected(fmt::format("time_s, from {:.0f} to {:.0f}", all.front().time_s, all.back().time_s));
  const auto distance = [&](const DensityProfile& one) { return std::abs(one.time_s - *entry.time_s); };
  const DensityProfile& nearest = *std::min_element(
      all.begin(), all.end(),
      [&](const DensityProfile& a, const DensityProfile& b) { return distance(a) < distance(b); });
  std::vector<double> steps;
  for (std::size_t i = 1; i < all.size(); ++i) steps.push_back(all[i].time_s - all[i - 1].time_s);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  if (distance(nearest) > steps[steps.size() / 2])
    throw refusal(
        scene, entry, "time_s",
        fmt::format("no profile is near {:.0f} s; the nearest is of {:.0f} s", *entry.time_s, nearest.time_s))
        .expected(fmt::format("a time from {:.0f} to {:.0f}", all.front().time_s, all.back().time_s));
  return nearest;
}

/// Where a beam is at an altitude, in the frame of the scene's site.
sim::PointInSpace point_of_beam(const sim::Scene& scene, const sim::RadarEntry& entry, double altitude_km) {
  sim::Site radar = scene.site;
  radar.latitude_deg = entry.site_latitude_deg.value_or(radar.latitude_deg);
  radar.longitude_deg = entry.site_longitude_deg.value_or(radar.longitude_deg);
  radar.altitude_m = entry.site_altitude_m.value_or(radar.altitude_m);
  const double azimuth = *entry.azimuth_deg * sim::kRadiansPerDegree,
               elevation = *entry.elevation_deg * sim::kRadiansPerDegree;
  const double from_centre_km = scene.body.radius_km + kPerThousand * radar.altitude_m,
               rise_km = from_centre_km * std::sin(elevation), radius_km = scene.body.radius_km + altitude_km;
  const double range_km =
      std::sqrt(rise_km * rise_km + radius_km * radius_km - from_centre_km * from_centre_km) - rise_km;
  const double along[3] = {range_km * std::cos(elevation) * std::sin(azimuth),
                           range_km * std::cos(elevation) * std::cos(azimuth),
                           range_km * std::sin(elevation)};
  const sim::SiteTurn turn = sim::turn_between(radar, scene.site, scene.body.radius_km);
  sim::PointInSpace point;
  for (int i = 0; i < 3; ++i) {
    point.enu_km[i] = turn.shift_km[i];
    for (int j = 0; j < 3; ++j) point.enu_km[i] += turn.turn[i][j] * along[j];
  }
  return point;
}

template <class T>
FootPlace<T> foot_of(const sim::Scene& scene, const std::vector<sim::PointInSpace>& points,
                     std::size_t altitude, const NumberAs<T>& number) {
  if (points.size() == 1) return {T(points.front().enu_km[0]), T(points.front().enu_km[1])};
  return sim::foot_below(scene, points[altitude].enu_km, number);
}

/// Ion pairs of one sheet, with the derivatives that go on to its numbers.
template <class T>
T pairs_of(const RadarDensity::Pairs& pairs, std::size_t altitude, const FootElectrons<T>& electrons,
           const T& spread) {
  // Of value 0: what moves the logarithm of the energy and the spread.
  const T energy = electrons.ln_energy_kev - sim::value_of(electrons.ln_energy_kev),
          wider = spread - sim::value_of(spread);
  return electrons.energy_flux_mw_m2 *
         (energy * pairs.by_ln_energy[altitude] + wider * pairs.by_spread[altitude] + pairs.value[altitude]);
}

/// The densities of the scene's electrons, by altitude.
template <class T>
std::vector<T> densities(const RadarDensity& density, const std::vector<sim::PointInSpace>& points,
                         const sim::Scene& scene, const NumberAs<T>& number) {
  struct Known {
    int sheet = -1;
    double ln_energy = 0.0;
    RadarDensity::Pairs pairs;
  };
  std::vector<Known> known(scene.sheets.size());
  std::vector<T> spreads;
  for (const sim::Sheet& sheet : scene.sheets) spreads.push_back(number(sheet.energy_spread));
  std::vector<T> all;
  std::vector<FootElectrons<T>> electrons;
  for (std::size_t i = 0; i < density.altitudes(); ++i) {
    if (i == 0 || points.size() > 1) {
      const FootPlace<T> foot = foot_of<T>(scene, points, i, number);
      electrons = sim::foot_electrons<T>(scene, foot.east_km, foot.north_km, number);
    }
    T pairs(0.0);
    for (const FootElectrons<T>& one : electrons) {
      Known& at = known[static_cast<std::size_t>(one.sheet)];
      const double ln_energy = sim::value_of(one.ln_energy_kev);
      if (at.sheet < 0 || at.ln_energy != ln_energy)
        at = {one.sheet, ln_energy,
              density.pairs(spectrum_of(scene.sheets[static_cast<std::size_t>(one.sheet)]),
                            std::exp(ln_energy))};
      pairs = pairs + pairs_of(at.pairs, i, one, spreads[static_cast<std::size_t>(one.sheet)]);
    }
    const RadarDensity::Density made = density.density(i, sim::value_of(pairs));
    all.push_back((pairs - sim::value_of(pairs)) * made.by_pairs + made.value);
  }
  return all;
}

/// The electrons of all sheets at a foot: Q is the sum, the energy that of the strongest.
struct Strongest {
  double flux_mw_m2 = 0.0, energy_kev = sim::kNaN, strongest_mw_m2 = 0.0;
  int sheet = -1;
};
Strongest strongest_at(const sim::Scene& scene, const FootPlace<double>& foot) {
  Strongest all;
  for (const FootElectrons<double>& one :
       sim::foot_electrons<double>(scene, foot.east_km, foot.north_km, sim::plain_number)) {
    all.flux_mw_m2 += one.energy_flux_mw_m2;
    if (one.energy_flux_mw_m2 <= all.strongest_mw_m2) continue;
    all.strongest_mw_m2 = one.energy_flux_mw_m2;
    all.energy_kev = std::exp(one.ln_energy_kev);
    all.sheet = one.sheet;
  }
  return all;
}

Strongest require_light(const sim::Scene& scene, const sim::RadarEntry& entry,
                        const FootPlace<double>& foot) {
  const Strongest electrons = strongest_at(scene, foot);
  double most = 0.0;
  for (const sim::Sheet& sheet : scene.sheets) most = std::max(most, sheet.energy_flux_mw_m2);
  if (electrons.flux_mw_m2 > kLeastFlux * most) return electrons;
  const sim::PlaceOnEarth place = sim::place_of_foot(scene, {foot.east_km, foot.north_km});
  throw refusal(scene, entry, "",
                fmt::format("hardly any electrons fall at its field line (foot {:.2f}, {:.2f} deg, at {:.1f} "
                            "km east, {:.1f} km north): the nearest sheet is {:.1f} km away",
                            place.latitude_deg, place.longitude_deg, foot.east_km, foot.north_km,
                            sim::distance_to_sheets_km(scene, foot.east_km, foot.north_km)))
      .expected("a sheet over it at the start")
      .hint("move a sheet there, or leave the radar out");
}

}  // namespace
}  // namespace radars

Radars::Radar Radars::prepared(const sim::Scene& scene, const sim::RadarEntry& entry) {
  using namespace radars;
  require_known_electrons(scene, entry);
  require_site(scene, entry);
  const std::string file = sim::table_place(scene, entry.file);
  const DensityTable table = read_density_table(file, entry.lowest_km.value_or(sim::kRadarLowestKm),
                                                entry.highest_km.value_or(sim::kRadarHighestKm), entry.beam);
  const DensityProfile& profile = chosen_profile(scene, entry, table);
  if (profile.measured() < kLeastAltitudes)
    throw refusal(scene, entry, "time_s",
                  fmt::format("the profile has {} altitudes then", profile.measured()))
        .expected(fmt::format("at least {}", kLeastAltitudes));
  Radar radar;
  FittedRadar& measured = radar.measured;
  measured.name = entry.name;
  measured.file = std::filesystem::path(entry.file).filename().string();
  measured.sha256 = sim::sha256_of_file(file);
  measured.time_s = profile.time_s;
  bool has_places = true;
  for (std::size_t i = 0; i < table.altitude_km.size(); ++i) {
    if (!std::isfinite(profile.density_cm3[i])) continue;
    const double altitude_km = table.altitude_km[i];
    measured.altitude_km.push_back(altitude_km);
    measured.density_cm3.push_back(profile.density_cm3[i]);
    measured.sigma_cm3.push_back(profile.sigma_cm3[i]);
    has_places =
        has_places && std::isfinite(profile.latitude_deg[i]) && std::isfinite(profile.longitude_deg[i]);
    if (entry.azimuth_deg)
      radar.points.push_back(point_of_beam(scene, entry, altitude_km));
    else if (!entry.latitude_deg && has_places)
      radar.points.push_back(
          sim::point_above(scene, profile.latitude_deg[i], profile.longitude_deg[i], altitude_km));
  }
  if (entry.latitude_deg)
    radar.points = {sim::point_above(scene, *entry.latitude_deg, *entry.longitude_deg, sim::kFootAltitudeKm)};
  else if (!entry.azimuth_deg && !has_places)
    throw refusal(scene, entry, "latitude_deg", "nothing says where the radar looks")
        .expected(
            "latitude_deg and longitude_deg of the field line's foot, azimuth_deg and elevation_deg of "
            "the beam, or places in the file");
  const auto count = static_cast<Eigen::Index>(measured.altitude_km.size());
  measured.values = static_cast<int>(count);
  radar.density_cm3 = Eigen::Map<const Eigen::VectorXd>(measured.density_cm3.data(), count);
  radar.one_over_sigma = Eigen::Map<const Eigen::VectorXd>(measured.sigma_cm3.data(), count).cwiseInverse();
  radar.density_cm3.maxCoeff(&radar.strongest);
  const FootPlace<double> foot =
      foot_of<double>(scene, radar.points, static_cast<std::size_t>(radar.strongest), sim::plain_number);
  const Strongest electrons = require_light(scene, entry, foot);
  const sim::PlaceOnEarth place = sim::place_of_foot(scene, {foot.east_km, foot.north_km});
  measured.foot_latitude_deg = place.latitude_deg;
  measured.foot_longitude_deg = place.longitude_deg;

  RadarDensityOptions options;
  options.oxygen_factor = scene.emission.oxygen_factor;
  if (entry.seconds) options.seconds = *entry.seconds;
  radar.density =
      std::make_shared<const RadarDensity>(sim::emission_tables(scene), measured.altitude_km, options);
  radar.scale_sigma = entry.scale_sigma.value_or(0.0);
  Eigen::MatrixXd physics(count, 0);
  if (scene.emission.uncertainty != sim::TablesUncertainty::none) {
    const sim::Sheet& sheet = scene.sheets[static_cast<std::size_t>(electrons.sheet)];
    physics = radar.density->physics_modes(spectrum_of(sheet), electrons.energy_kev, electrons.flux_mw_m2,
                                           scene.seed);
  }
  const Eigen::Index scales = radar.scale_sigma > 0.0 ? 1 : 0;
  radar.modes.resize(count, scales + physics.cols());
  if (scales > 0) radar.modes.col(0).setConstant(radar.scale_sigma);
  radar.modes.rightCols(physics.cols()) = physics;
  return radar;
}

Radars::Radars(const sim::Scene& scene) {
  for (const sim::RadarEntry& entry : scene.fit.radars) {
    radars_.push_back(prepared(scene, entry));
    rows_ += static_cast<int>(radars_.back().modes.rows() + radars_.back().modes.cols());
  }
}

int Radars::values() const {
  int sum = 0;
  for (const Radar& radar : radars_) sum += radar.measured.values;
  return sum;
}

/// The least squares at some densities of the electrons.
struct Radars::Solution {
  Eigen::MatrixXd moved;         ///< B: what the modes change, in standard deviations
  Eigen::MatrixXd inverse;       ///< of B^T B + 1
  Eigen::VectorXd coefficients;  ///< c
  Eigen::VectorXd off;           ///< (d - N)/s
  Eigen::VectorXd residual() const { return off - moved * coefficients; }
};

Radars::Solution Radars::solved(const Radar& radar, const Eigen::VectorXd& electrons_cm3) {
  Solution s;
  s.off = (radar.density_cm3 - electrons_cm3).cwiseProduct(radar.one_over_sigma);
  s.moved = electrons_cm3.cwiseProduct(radar.one_over_sigma).asDiagonal() * radar.modes;
  const Eigen::Index count = radar.modes.cols();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(count, count);
  s.inverse = sim::solve_symmetric(Eigen::MatrixXd(s.moved.transpose() * s.moved + one), one);
  s.coefficients = s.inverse * (s.moved.transpose() * s.off);
  return s;
}

void Radars::evaluate(const sim::Scene& scene, const ParameterMap::Motion* motion,
                      std::vector<double>& residuals, std::vector<double>* jacobian) const {
  using namespace radars;
  residuals.clear();
  if (jacobian != nullptr) jacobian->clear();
  const std::size_t numbers = motion == nullptr ? 0 : motion->numbers.size();
  const auto moved = static_cast<Eigen::Index>(motion == nullptr ? 0 : motion->moved);
  for (const Radar& radar : radars_) {
    const auto count = static_cast<Eigen::Index>(radar.measured.values);
    Eigen::VectorXd electrons(count);
    Eigen::MatrixXd by_number(count, static_cast<Eigen::Index>(numbers));
    if (numbers == 0) {
      const std::vector<double> plain =
          densities<double>(*radar.density, radar.points, scene, sim::plain_number);
      electrons = Eigen::Map<const Eigen::VectorXd>(plain.data(), count);
    }
    for (std::size_t first = 0; first < numbers; first += sim::kTangentWidth) {
      const std::size_t some = std::min<std::size_t>(sim::kTangentWidth, numbers - first);
      const sim::Seeds seeds(scene, motion->numbers, first, some);
      const std::vector<sim::FreeDual> dual = densities<sim::FreeDual>(
          *radar.density, radar.points, scene, [&](const double& number) { return seeds(number); });
      for (Eigen::Index i = 0; i < count; ++i) {
        const sim::FreeDual& here = dual[static_cast<std::size_t>(i)];
        electrons[i] = here.v;
        for (std::size_t k = 0; k < some; ++k)
          by_number(i, static_cast<Eigen::Index>(first + k)) = here.d.t[k];
      }
    }
    const Solution s = solved(radar, electrons);
    const Eigen::VectorXd residual = s.residual();
    residuals.insert(residuals.end(), residual.data(), residual.data() + residual.size());
    residuals.insert(residuals.end(), s.coefficients.data(), s.coefficients.data() + s.coefficients.size());
    if (jacobian == nullptr) continue;

    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd by_moved =
        numbers == 0 ? Eigen::MatrixXd::Zero(count, moved)
        : motion->slopes.empty()
            ? by_number
            : Eigen::MatrixXd(by_number * Eigen::Map<const RowMajor>(motion->slopes.data(),
                                                                     static_cast<Eigen::Index>(numbers),
                                                                     moved));
    RowMajor rows(count + radar.modes.cols(), moved);
    for (Eigen::Index j = 0; j < moved; ++j) {
      const Eigen::VectorXd by_sigma = by_moved.col(j).cwiseProduct(radar.one_over_sigma);
      const Eigen::MatrixXd turned = by_sigma.asDiagonal() * radar.modes;  // d B
      const Eigen::VectorXd right = turned.transpose() * (s.off - s.moved * s.coefficients) -
                                    s.moved.transpose() * (by_sigma + turned * s.coefficients);
      const Eigen::VectorXd coefficients = s.inverse * right;
      rows.col(j).head(count) = -by_sigma - turned * s.coefficients - s.moved * coefficients;
      rows.col(j).tail(radar.modes.cols()) = coefficients;
    }
    jacobian->insert(jacobian->end(), rows.data(), rows.data() + rows.size());
  }
}

std::vector<FittedRadar> Radars::fitted(const sim::Scene& scene) const {
  using namespace radars;
  std::vector<FittedRadar> all;
  for (const Radar& radar : radars_) {
    FittedRadar fitted = radar.measured;
    fitted.electrons_cm3 = densities<double>(*radar.density, radar.points, scene, sim::plain_number);
    const Eigen::VectorXd electrons = Eigen::Map<const Eigen::VectorXd>(
        fitted.electrons_cm3.data(), static_cast<Eigen::Index>(fitted.electrons_cm3.size()));
    const Solution s = solved(radar, electrons);
    const Eigen::VectorXd model = electrons + electrons.cwiseProduct(radar.modes * s.coefficients);
    fitted.model_cm3.assign(model.data(), model.data() + model.size());
    if (radar.scale_sigma > 0.0) {
      fitted.scale = 1.0 + radar.scale_sigma * s.coefficients[0];
      fitted.scale_sigma = radar.scale_sigma * std::sqrt(s.inverse(0, 0));
    }
    fitted.chi2 = s.residual().squaredNorm() + s.coefficients.squaredNorm();
    const FootPlace<double> foot =
        foot_of<double>(scene, radar.points, static_cast<std::size_t>(radar.strongest), sim::plain_number);
    const Strongest electrons_there = strongest_at(scene, foot);
    fitted.energy_flux_mw_m2 = electrons_there.sheet < 0 ? sim::kNaN : electrons_there.flux_mw_m2;
    fitted.energy_kev = electrons_there.energy_kev;
    all.push_back(std::move(fitted));
  }
  return all;
}

}  // namespace vegard::fit
