#include "fit/report/columns/density_texts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/quantile.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace density_texts {

using Json = nlohmann::ordered_json;

Json known(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number_json(const SampledNumber& of) {
  return {{"value", known(of.value)},
          {"68", Json::array({known(of.low68), known(of.high68)})},
          {"95", Json::array({known(of.low95), known(of.high95)})}};
}

std::string range_words(const DensityFacts& facts) {
  return fmt::format("electrons of {:.3g} to {:.3g} keV", facts.energies.least_kev, facts.energies.most_kev);
}

std::string verdict_of(const DensitySpectrum& spectrum) {
  switch (spectrum.verdict) {
    case DensityVerdict::explained:
      return "the density is explained";
    case DensityVerdict::contradicted:
      return "no electrons explain this density";
    case DensityVerdict::no_electrons:
      return "no electrons of these energies are seen";
    case DensityVerdict::too_few_altitudes:
      return "unknown, of too few altitudes";
    case DensityVerdict::not_found:
      break;
  }
  return "unknown, the samples do not converge";
}

/// The five numbers of an estimate as variables NAME, NAME_68_low ...
struct Part {
  const char *ending, *words;
  double SampledNumber::*number;
};
constexpr Part kParts[] = {{"", "", &SampledNumber::value},
                           {"_68_low", ", lower end of the interval of 68 %", &SampledNumber::low68},
                           {"_68_high", ", upper end of the interval of 68 %", &SampledNumber::high68},
                           {"_95_low", ", lower end of the interval of 95 %", &SampledNumber::low95},
                           {"_95_high", ", upper end of the interval of 95 %", &SampledNumber::high95}};

/// A cell of CSV, empty for what is unknown.
std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : ""; }

std::string one_number(const char* name, const SampledNumber& of) {
  return fmt::format("  {:<21}{:<7.4g} {:.4g} to {:<10.4g} {:.4g} to {:.4g}\n", name, of.value, of.low68,
                     of.high68, of.low95, of.high95);
}

}  // namespace density_texts

bool most_contradict(const std::vector<DensitySpectrum>& spectra) {
  std::size_t contradicting = 0, explained = 0;
  for (const DensitySpectrum& one : spectra)
    contradicting += one.contradicts() ? 1 : 0, explained += one.has_numbers() ? 1 : 0;
  return contradicting > explained;
}

std::string density_text(const InvertedDensities& inverted, const DensityFacts& facts) {
  using namespace density_texts;
  std::string text =
      fmt::format("{} altitudes from {:g} to {:g} km, {}\n{}; recombination {}; air {}\nerrors: {}\n",
                  inverted.table.altitude_km.size(), inverted.table.altitude_km.front(),
                  inverted.table.altitude_km.back(), facts.balance, range_words(facts), facts.recombination,
                  facts.air, facts.errors);
  if (inverted.spectra.size() == 1) {
    const DensitySpectrum& one = inverted.spectra.front();
    if (one.has_numbers()) {
      text += "                       value   68 %                95 %\n";
      text += one_number("energy flux (mW m⁻²)", one.energy_flux_mw_m2);
      text += one_number("mean energy (keV)", one.mean_energy_kev);
    }
    if (one.verdict == DensityVerdict::no_electrons)
      text += fmt::format("  energy flux below {:.3g} mW m⁻² (68 %), {:.3g} mW m⁻² (95 %)\n",
                          one.energy_flux_mw_m2.high68, one.energy_flux_mw_m2.high95);
    text += "verdict: " + verdict_of(one);
    if (std::isfinite(one.chi2))
      text += fmt::format(" (chi² {:.3g}, {:.1f} degrees of freedom)", one.chi2, one.degrees_of_freedom);
    return text + "\n";
  }
  std::vector<double> flux, energy;
  const auto count = [&](DensityVerdict verdict) {
    return std::count_if(inverted.spectra.begin(), inverted.spectra.end(),
                         [&](const DensitySpectrum& one) { return one.verdict == verdict; });
  };
  for (const DensitySpectrum& one : inverted.spectra) {
    if (!one.has_numbers()) continue;
    flux.push_back(one.energy_flux_mw_m2.value);
    energy.push_back(one.mean_energy_kev.value);
  }
  const auto profiles = static_cast<std::ptrdiff_t>(inverted.spectra.size());
  const std::ptrdiff_t too_short = count(DensityVerdict::too_few_altitudes);
  text += fmt::format("{} profiles\n", profiles);
  for (const auto& [name, values] :
       {std::pair{"energy flux (mW m⁻²)", &flux}, {"mean energy (keV)", &energy}}) {
    if (values->empty()) continue;
    const auto [least, most] = std::minmax_element(values->begin(), values->end());
    const double low = *least, high = *most;
    text += fmt::format("  {:<21}{:.3g} to {:.3g}, median {:.3g}\n", name, low, high,
                        sim::quantile(*values, 0.5));
  }
  if (too_short > 0) text += fmt::format("{} profiles have too few altitudes\n", too_short);
  for (const auto& [verdict, words] :
       {std::pair{DensityVerdict::contradicted, "no electrons explain"},
        {DensityVerdict::no_electrons, "no electrons of these energies are seen in"},
        {DensityVerdict::not_found, "the samples do not converge of"}})
    if (count(verdict) > 0) text += fmt::format("{} {} of the densities\n", words, count(verdict));
  return text + fmt::format("verdict: electrons explain {} of {} densities\n",
                            count(DensityVerdict::explained), profiles - too_short);
}

std::string density_json(const InvertedDensities& inverted, const DensityFacts& facts) {
  using namespace density_texts;
  Json json;
  json["kind"] = "vegard invert --density";
  json["version"] = sim::version();
  json["tables"] = facts.tables;
  json["air"] = facts.air;
  json["recombination"] = facts.recombination;
  json["balance"] = facts.balance;
  json["errors"] = facts.errors;
  json["altitude_km"] = inverted.table.altitude_km;
  json["energies_kev"] = {facts.energies.least_kev, facts.energies.most_kev};
  json["profiles"] = Json::array();
  for (std::size_t p = 0; p < inverted.spectra.size(); ++p) {
    const DensitySpectrum& one = inverted.spectra[p];
    Json profile;
    if (inverted.table.has_times()) profile["time_s"] = inverted.table.profiles[p].time_s;
    profile["energy_flux_mw_m2"] = number_json(one.energy_flux_mw_m2);
    profile["mean_energy_kev"] = number_json(one.mean_energy_kev);
    profile["chi2"] = known(one.chi2);
    profile["degrees_of_freedom"] = known(one.degrees_of_freedom);
    profile["chance"] = known(one.chance);
    profile["verdict"] = verdict_of(one);
    profile["spectrum"] = Json::array();
    const EnergyBins& bins = inverted.physics.bins();
    for (std::size_t j = 0; j < bins.count(); ++j) {
      if (!std::isfinite(one.flux_cm2_s_kev[j].high95)) continue;
      Json bin = {{"energy_kev", bins.middle_kev(j)}};
      bin["flux_cm2_s_kev"] = number_json(one.flux_cm2_s_kev[j]);
      profile["spectrum"].push_back(bin);
    }
    profile["density_cm3"] = Json::array();
    for (const double density : one.density_cm3) profile["density_cm3"].push_back(known(density));
    json["profiles"].push_back(profile);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string density_csv(const InvertedDensities& inverted, const DensityFacts& facts) {
  using namespace density_texts;
  std::string text = sim::csv_comment(fmt::format("vegard invert {}, {}, {}", sim::version(),
                                                  range_words(facts), facts.balance)) +
                     sim::csv_comment("air: " + facts.air + "; recombination: " + facts.recombination) +
                     sim::csv_comment("errors: " + facts.errors);
  const bool has_times = inverted.table.has_times();
  if (has_times) text += "time_s,";
  for (const char* name : {"energy_flux_mw_m2", "mean_energy_kev"})
    for (const Part& part : kParts) text += fmt::format("{}{},", name, part.ending);
  text += "chi2,chance\n";
  for (std::size_t p = 0; p < inverted.spectra.size(); ++p) {
    const DensitySpectrum& one = inverted.spectra[p];
    if (has_times) text += sim::csv_number(inverted.table.profiles[p].time_s) + ",";
    for (const SampledNumber* number : {&one.energy_flux_mw_m2, &one.mean_energy_kev})
      for (const Part& part : kParts) text += cell(number->*part.number) + ",";
    text += cell(one.chi2) + "," + cell(one.chance) + "\n";
  }
  return text;
}

sim::NetcdfDataset density_dataset(const InvertedDensities& inverted, const DensityFacts& facts) {
  using namespace density_texts;
  sim::NetcdfDataset dataset("spectra of precipitating electrons by density profiles",
                             "vegard " + sim::version());
  dataset.attribute("emission_tables", facts.tables);
  dataset.attribute("air", facts.air);
  dataset.attribute("recombination", facts.recombination);
  dataset.attribute("balance", facts.balance);
  dataset.attribute("errors", facts.errors);
  const EnergyBins& bins = inverted.physics.bins();
  const std::size_t profiles = inverted.spectra.size(), energies = bins.count(),
                    altitudes = inverted.table.altitude_km.size();
  dataset.dimension("profile", profiles);
  dataset.dimension("energy", energies);
  dataset.dimension("altitude", altitudes);
  std::vector<double> middles;
  for (std::size_t j = 0; j < energies; ++j) middles.push_back(bins.middle_kev(j));
  dataset.real("energy", "energy of electrons", "keV", {"energy"}, middles);
  dataset.real("altitude", "altitude", "km", {"altitude"}, inverted.table.altitude_km)
      .with("standard_name", "altitude")
      .with("positive", "up");
  if (inverted.table.has_times()) {
    std::vector<double> times;
    for (const DensityProfile& profile : inverted.table.profiles) times.push_back(profile.time_s);
    dataset.real("time", "time of the profile, as in its file", "s", {"profile"}, times);
  }
  const auto add = [&](const std::string& name, const std::string& words, const std::string& unit,
                       const SampledNumber DensitySpectrum::*number) {
    for (const Part& part : kParts) {
      std::vector<double> values;
      for (const DensitySpectrum& one : inverted.spectra) values.push_back((one.*number).*part.number);
      dataset.real(name + part.ending, words + part.words, unit, {"profile"}, values);
    }
  };
  add("energy_flux", "energy flux of " + range_words(facts), "mW m-2", &DensitySpectrum::energy_flux_mw_m2);
  add("mean_energy", "mean energy of " + range_words(facts), "keV", &DensitySpectrum::mean_energy_kev);
  for (const Part& part : kParts) {
    std::vector<double> values;
    for (const DensitySpectrum& one : inverted.spectra)
      for (const SampledNumber& number : one.flux_cm2_s_kev) values.push_back(number.*part.number);
    dataset.real("flux" + std::string(part.ending), "number flux of electrons" + std::string(part.words),
                 "cm-2 s-1 keV-1", {"profile", "energy"}, values);
  }
  std::vector<double> measured, sigma, found, chi2, chance;
  constexpr double kPerM3 = 1e6;
  for (std::size_t p = 0; p < profiles; ++p) {
    for (std::size_t i = 0; i < altitudes; ++i) {
      measured.push_back(kPerM3 * inverted.table.profiles[p].density_cm3[i]);
      sigma.push_back(kPerM3 * inverted.table.profiles[p].sigma_cm3[i]);
      found.push_back(kPerM3 * inverted.spectra[p].density_cm3[i]);
    }
    chi2.push_back(inverted.spectra[p].chi2);
    chance.push_back(inverted.spectra[p].chance);
  }
  dataset.real("density", "measured density of electrons", "m-3", {"profile", "altitude"}, measured)
      .with("ancillary_variables", "density_sigma");
  dataset.real("density_sigma", "standard deviation of density", "m-3", {"profile", "altitude"}, sigma);
  dataset.real("density_of_spectrum", "density of electrons that the spectrum makes", "m-3",
               {"profile", "altitude"}, found);
  dataset.real("chi2", "chi squared of the density", "1", {"profile"}, chi2);
  dataset.real("chance", "probability of so large a chi2 by chance", "1", {"profile"}, chance);
  return dataset;
}

Plot density_plot(const InvertedDensities& inverted, const DensityFacts& facts) {
  using namespace density_texts;
  const DensitySpectrum& one = inverted.spectra.front();
  Panel spectrum;
  spectrum.title = "Spectrum";
  spectrum.x.label = "log10(energy in keV)";
  spectrum.y.label = "log10(electrons cm⁻² s⁻¹ keV⁻¹)";
  Series wide, narrow;
  wide.label = "95 %";
  narrow.label = "median, 68 %";
  wide.colour = distinct_colour(1);
  narrow.colour = distinct_colour(0);
  wide.width_px = 0.5;
  for (std::size_t j = 0; j < inverted.physics.bins().count(); ++j) {
    const SampledNumber& number = one.flux_cm2_s_kev[j];
    if (!std::isfinite(number.value)) continue;
    const double at = std::log10(inverted.physics.bins().middle_kev(j));
    narrow.x.push_back(at);
    narrow.y.push_back(std::log10(number.value));
    narrow.low.push_back(std::log10(number.low68));
    narrow.high.push_back(std::log10(number.high68));
    wide.x.push_back(at);
    wide.y.push_back(std::log10(number.value));
    wide.low.push_back(std::log10(number.low95));
    wide.high.push_back(std::log10(number.high95));
  }
  spectrum.series = {wide, narrow};
  Panel density;
  density.title = "Density";
  density.x.label = "density of electrons (10¹¹ m⁻³)";
  density.y.label = "altitude (km)";
  constexpr double kShown = 1e-5;  // of cm^-3
  Series measured, found;
  measured.label = "measured";
  measured.mark = Mark::points;
  measured.width_px = 4.0;
  measured.band_along_x = measured.error_bars = true;
  measured.colour = distinct_colour(1);
  found.label = "of the spectrum";
  found.colour = distinct_colour(0);
  for (std::size_t i = 0; i < inverted.table.altitude_km.size(); ++i) {
    const DensityProfile& profile = inverted.table.profiles.front();
    measured.x.push_back(kShown * profile.density_cm3[i]);
    measured.low.push_back(kShown * (profile.density_cm3[i] - profile.sigma_cm3[i]));
    measured.high.push_back(kShown * (profile.density_cm3[i] + profile.sigma_cm3[i]));
    measured.y.push_back(inverted.table.altitude_km[i]);
    found.x.push_back(kShown * one.density_cm3[i]);
    found.y.push_back(inverted.table.altitude_km[i]);
  }
  density.series = {found, measured};
  Plot plot;
  plot.title = one.has_numbers() ? fmt::format("Electrons by density: {:.3g} mW m⁻², mean energy {:.3g} keV",
                                               one.energy_flux_mw_m2.value, one.mean_energy_kev.value)
                                 : "Electrons by density: " + verdict_of(one);
  plot.note = range_words(facts) + "; " + facts.balance;
  if (one.has_numbers()) plot.panels.push_back(spectrum);
  plot.panels.push_back(density);
  return plot;
}

}  // namespace vegard::fit
