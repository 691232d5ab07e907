// Units as files declare them: FITS (BUNIT, TUNITn), attributes of HDF5, netCDF and EXR. What is declared is
// converted, or refused; it is never passed over.
//
// The notation is that of the FITS standard 4.0, section 4.3, and of UDUNITS as far as both agree: "kR",
// "10**10 photon m-2 s-1", "mW/m^2", "erg s-1 cm-2", with any prefix of the SI, and names in words
// ("kilorayleighs"). It is read here and not by UDUNITS, which does not know FITS's powers of ten and has R
// for the roentgen.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace vegard::sim {

enum class Quantity {
  /// Surface brightness in rayleighs: 1 R = 10^10 / (4 pi) photons m^-2 s^-1 sr^-1 (FITS standard, table 4),
  /// or
  /// 10^10 photons m^-2 s^-1 of a column (Hunten, Roach and Chamberlain 1956).
  brightness_rayleigh,
  angle_deg,
  energy_flux_mw_m2,
  energy_kev,
  length_km,
};

/// Returns the factor from a value in the declared unit to one in the unit of the quantity's name; none for a
/// unit that is unknown or of another quantity.
std::optional<double> factor_of_unit(std::string_view unit, Quantity quantity);

/// The same; 1 where no unit is declared (an empty text). Throws Error(unreadable_input) about the file and
/// the `key` that declares it.
double declared_factor(std::string_view unit, Quantity quantity, const std::string& file,
                       const std::string& key);

/// Returns the unit that the keywords of a FITS header declare for a plane, counted from 0: by BUNIT1, BUNIT2
/// ...; else by BUNIT, whose parts between commas or semicolons are those of the planes in order, and which
/// without them is that of all planes (`is_of_all`) or of the first. Empty if there is none. `key`: where it
/// stands.
std::string unit_of_plane(const std::map<std::string, std::string>& keywords, int plane, bool is_of_all,
                          std::string& key);

}  // namespace vegard::sim
