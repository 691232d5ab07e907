#include "apps/options/spectrum_options.h"

#include "apps/options/refusals.h"

namespace vegard::apps {

void add_spectrum_options(const Command& command, SpectrumOptions& options) {
  command.option("--spectrum", options.spectrum, "Spectrum of the electrons")
      .one_of({"maxwellian", "gaussian", "mono", "kappa"})
      .shows_default();
  command.option("--spread", options.spread, "Standard deviation of a Gaussian over E0 (default: 0.25)")
      .finite_range(0.01, 1.0);
  command.option("--kappa", options.kappa, "Kappa of a kappa distribution (default: 5)")
      .finite_range(sim::kMinKappa, sim::kMaxKappa);
}

sim::ElectronSpectrum electron_spectrum(const SpectrumOptions& options) {
  const auto refuse = [&](const std::optional<double>& value, const char* option, const char* spectrum) {
    if (value && options.spectrum != spectrum)
      throw usage_error(option, "a spectrum of the kind '" + options.spectrum + "' has no such number",
                        std::string("--spectrum ") + spectrum + " beside it");
  };
  refuse(options.spread, "--spread", "gaussian");
  refuse(options.kappa, "--kappa", "kappa");
  sim::ElectronSpectrum spectrum;
  spectrum.kind = sim::spectrum_kind(options.spectrum);
  spectrum.spread = options.spread.value_or(spectrum.spread);
  spectrum.kappa = options.kappa.value_or(spectrum.kappa);
  return spectrum;
}

}  // namespace vegard::apps
