#include "apps/commands/electrons/electron_options.h"

#include <cmath>

#include <fmt/format.h>

#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/light/transport/electron_transport.h"

namespace vegard::apps {
namespace {

sim::SpectrumKind kind_of(const std::string& word) {
  if (word == "mono") return sim::SpectrumKind::mono;
  if (word == "gaussian") return sim::SpectrumKind::gaussian;
  if (word == "kappa") return sim::SpectrumKind::kappa;
  if (word == "accelerated") return sim::SpectrumKind::accelerated;
  if (word == "table") return sim::SpectrumKind::table;
  return sim::SpectrumKind::maxwellian;
}

/// An option that belongs to one spectrum alone.
void refuse_elsewhere(const std::optional<double>& value, const char* option, const ElectronOptions& request,
                      const char* spectrum) {
  if (value && request.spectrum != spectrum)
    throw usage_error(option, "a spectrum of the kind '" + request.spectrum + "' has no such number",
                      std::string("--spectrum ") + spectrum + " as well");
}

sim::IncidentSpectrum table_spectrum(const std::string& file) {
  const sim::CsvTable table =
      sim::read_csv_table(sim::input_bytes(file, "a table of the columns energy_keV and flux"), file);
  table.require_increasing("energy_keV");
  table.require_within("energy_keV", sim::kMinSpectrumKev, sim::kHighestKev);
  table.require_within("flux", 0.0, 1e300);
  sim::IncidentSpectrum spectrum;
  spectrum.kind = sim::SpectrumKind::table;
  spectrum.table_energy_kev = table.column("energy_keV");
  spectrum.table_flux = table.column("flux");
  double most = 0.0;
  for (const double flux : spectrum.table_flux) most = flux > most ? flux : most;
  if (table.rows() < 2 || most <= 0.0)
    throw sim::unreadable(file, "the table has no electrons")
        .expected("two rows or more, a flux above 0 in one of them");
  return spectrum;
}

}  // namespace

sim::IncidentSpectrum spectrum_of(const ElectronOptions& request) {
  refuse_elsewhere(request.spread, "--spread", request, "gaussian");
  refuse_elsewhere(request.kappa, "--kappa", request, "kappa");
  refuse_elsewhere(request.potential_kev, "--potential-kev", request, "accelerated");
  if (request.spectrum == "table") {
    if (request.table.empty())
      throw usage_error("--spectrum", "a table has no name", "--spectrum-table FILE.csv with it");
    if (request.energy_kev)
      throw usage_error("--energy-kev", "a table has its energies", "no --energy-kev with it");
    return table_spectrum(request.table);
  }
  if (!request.table.empty())
    throw usage_error("--spectrum-table", "the spectrum is of the kind '" + request.spectrum + "'",
                      "--spectrum table as well");
  if (!request.energy_kev)
    throw usage_error("--energy-kev", "it is missing", "the energy of the electrons in keV, such as 5");
  sim::IncidentSpectrum spectrum;
  spectrum.kind = kind_of(request.spectrum);
  spectrum.energy_kev = *request.energy_kev;
  spectrum.spread = request.spread.value_or(spectrum.spread);
  spectrum.kappa = request.kappa.value_or(spectrum.kappa);
  if (spectrum.kind == sim::SpectrumKind::accelerated) {
    if (!request.potential_kev)
      throw usage_error("--potential-kev", "it is missing", "what the electrons have fallen through, in keV");
    spectrum.potential_kev = *request.potential_kev;
  }
  return spectrum;
}

std::string electron_words(const ElectronOptions& request, const sim::IncidentSpectrum& spectrum) {
  std::string words = request.spectrum;
  if (spectrum.kind == sim::SpectrumKind::table)
    words += " " + file_name_of(request.table);
  else
    words += fmt::format(", {:g} keV", spectrum.energy_kev);
  if (spectrum.kind == sim::SpectrumKind::gaussian) words += fmt::format(", spread {:g}", spectrum.spread);
  if (spectrum.kind == sim::SpectrumKind::kappa) words += fmt::format(", kappa {:g}", spectrum.kappa);
  if (spectrum.kind == sim::SpectrumKind::accelerated)
    words += fmt::format(", through {:g} kV", spectrum.potential_kev);
  return words +
         fmt::format(", {:g} mW m^-2, {}, dip {:g} deg", request.flux_mw_m2, request.pitch, request.dip_deg);
}

sim::PitchAngles pitch_angles_of(const ElectronOptions& options) {
  return options.pitch == "isotropic" ? sim::PitchAngles::isotropic : sim::PitchAngles::field_aligned;
}

void require_balance(const ElectronOptions& request, double missing_share) {
  if (air_file(request.atmosphere).empty() || std::abs(missing_share) <= sim::kMaxMissingShare) return;
  throw sim::unreadable(
      request.atmosphere,
      fmt::format("the energy of the electrons does not balance in this air, {:.0f} % of it",
                  100.0 * std::abs(missing_share)))
      .expected("densities that fall off smoothly, to where electrons pass freely at the top");
}

std::vector<Option> add_electron_options(const Command& command, ElectronOptions& options) {
  std::vector<Option> all;
  all.push_back(command.option("--spectrum", options.spectrum, "Spectrum of the electrons")
                    .one_of({"mono", "gaussian", "maxwellian", "kappa", "accelerated", "table"})
                    .shows_default());
  all.push_back(
      command
          .option("--energy-kev", options.energy_kev,
                  "E0: the electrons' energy (mono, gaussian), or half the mean energy of a Maxwellian")
          .finite_range(sim::kMinSpectrumKev, sim::kMaxSpectrumKev));
  all.push_back(
      command.option("--spread", options.spread, "Standard deviation of a Gaussian over E0 (default: 0.1)")
          .finite_range(0.01, 1.0));
  all.push_back(command.option("--kappa", options.kappa, "Kappa of a kappa distribution (default: 5)")
                    .finite_range(2.1, 100.0));
  all.push_back(command
                    .option("--potential-kev", options.potential_kev,
                            "Energy that the spectrum accelerated has gained, in keV")
                    .finite_range(0.0, sim::kMaxSpectrumKev));
  all.push_back(
      command
          .option(
              "--spectrum-table", options.table,
              "Number flux against energy: columns energy_keV and flux, in any unit (needs --spectrum table)")
          .type_name("FILE.csv"));
  all.push_back(
      command.option("--flux-mw-m2", options.flux_mw_m2, "Energy flux through a plane across the field")
          .finite_range(1e-6, 1e4)
          .shows_default());
  all.push_back(command
                    .option("--pitch", options.pitch,
                            "Pitch angles: isotropic over the downward hemisphere, or along the field")
                    .one_of({"isotropic", "field-aligned"})
                    .shows_default());
  all.push_back(command.option("--dip-deg", options.dip_deg, "Inclination of the field to the horizontal")
                    .finite_range(10.0, 90.0)
                    .shows_default());
  all.push_back(add_air_option(command, options.atmosphere));
  return all;
}

}  // namespace vegard::apps
