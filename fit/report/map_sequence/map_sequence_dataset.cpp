#include "fit/report/map_sequence/map_sequence_run.h"
#include "fit/report/netcdf/run_dataset.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {

void MapSequenceRun::write_netcdf(const std::string& file, const MapSequenceRunFacts& facts) const {
  sim::NetcdfDataset dataset("maps of precipitation over time", "vegard " + sim::version());
  dataset.attribute("command", facts.command);
  dataset.attribute("flux_calibration", is_absolute_ ? "absolute" : "relative");
  dataset.dimension("time", frames_.size());
  std::vector<double> time_s, chi2;
  for (const MappedFrame& f : frames_) {
    time_s.push_back(f.time_s);
    chi2.push_back(f.chi2_per_value);
  }
  sim::NetcdfVariable& time =
      dataset.real("time", "when the photographs were taken",
                   utc_.empty() ? "s" : "seconds since " + sim::in_utc(utc_), {"time"}, time_s);
  time.with("axis", "T");
  if (!utc_.empty()) time.with("standard_name", "time").with("calendar", "standard");
  add_map_places(places_, dataset);
  dataset.real("chi2_per_value", "chi2 per value of the pass forward", "1", {"time"}, chi2);
  const std::string places = "latitude longitude magnetic_latitude altitude";
  const auto plane = [&](const char* name, const std::string& long_name, const std::string& unit,
                         std::vector<float> FramePlanes::*values) -> sim::NetcdfVariable& {
    std::vector<double> all;
    all.reserve(planes_.size() * places_.cells());
    for (const FramePlanes& p : planes_) all.insert(all.end(), (p.*values).begin(), (p.*values).end());
    return dataset.real(name, long_name, unit, {"time", "north", "east"}, std::move(all))
        .with("coordinates", places);
  };
  plane("energy_flux", std::string("energy flux of the electrons") + (is_absolute_ ? "" : ", up to a factor"),
        is_absolute_ ? "mW m-2" : "1", &FramePlanes::energy_flux_mw_m2)
      .with("ancillary_variables", "energy_flux_error");
  plane("energy_flux_error", "relative standard error of energy_flux", "1",
        &FramePlanes::relative_flux_error);
  plane("energy", "characteristic energy E0 of the electrons", "keV", &FramePlanes::energy_kev)
      .with("ancillary_variables", "ln_energy_error");
  plane("ln_energy_error", "standard error of the logarithm of energy", "1", &FramePlanes::ln_energy_error);
  plane("velocity_east", "velocity of the light to the east", "km s-1", &FramePlanes::east_km_s)
      .with("ancillary_variables", "velocity_east_error");
  plane("velocity_east_error", "standard error of velocity_east", "km s-1", &FramePlanes::east_error_km_s);
  plane("velocity_north", "velocity of the light to the north", "km s-1", &FramePlanes::north_km_s)
      .with("ancillary_variables", "velocity_north_error");
  plane("velocity_north_error", "standard error of velocity_north", "km s-1", &FramePlanes::north_error_km_s);
  sim::write_netcdf(dataset, file, false);
}

}  // namespace vegard::fit
