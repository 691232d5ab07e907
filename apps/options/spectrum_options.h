// The spectrum of electrons on command lines.
#pragma once

#include <optional>
#include <string>

#include "apps/options/command.h"
#include "sim/light/spectrum_profile.h"

namespace vegard::apps {

struct SpectrumOptions {
  std::string spectrum = "maxwellian";
  std::optional<double> spread, kappa;
};

/// Adds --spectrum, --spread and --kappa.
void add_spectrum_options(const Command& command, SpectrumOptions& options);

/// Throws Error(usage) for a number that the kind of spectrum does not have.
sim::ElectronSpectrum electron_spectrum(const SpectrumOptions& options);

}  // namespace vegard::apps
