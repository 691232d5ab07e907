#include "fit/map/precipitation_planes.h"

#include <charconv>
#include <cmath>

#include "sim/base/declared_unit.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr int kPlanesOfMap = 5;
constexpr long long kMaxCellsOfMap = 4194304;

class PlanesReader {
 public:
  explicit PlanesReader(const std::string& file)
      : file_(file),
        fits_(sim::read_fits_image(
            sim::input_bytes(file, "the precipitation.fits of a map", sim::kMaxPictureBytes), file)) {}

  PrecipitationPlanes read() const {
    const sim::Image& image = fits_.image;
    if (image.channels() != kPlanesOfMap)
      throw sim::unreadable(file_, "it has " + std::to_string(image.channels()) + " planes")
          .expected("the five of a map");
    if (static_cast<long long>(image.width) * image.height > kMaxCellsOfMap)
      throw sim::unreadable(file_, "it has more than 4194304 cells").expected("a map of vegard's");
    if (text("CTYPE1") != "EAST" || text("CTYPE2") != "NORTH")
      throw sim::unreadable(file_, "its axes are not EAST and NORTH").expected("a map of vegard's");
    PrecipitationPlanes planes;
    planes.columns = image.width;
    planes.rows = image.height;
    planes.step_km = number("CDELT1");
    if (!(planes.step_km > 0.0) || number("CDELT2") != planes.step_km)
      throw sim::unreadable(file_, "its cells are no squares").expected("CDELT1 and CDELT2 alike, above 0");
    planes.west_km = number("CRVAL1") + (1.0 - number("CRPIX1")) * planes.step_km;
    planes.south_km = number("CRVAL2") + (1.0 - number("CRPIX2")) * planes.step_km;
    planes.height_km = number("HEIGHTKM");
    planes.site.latitude_deg = number("SITELAT");
    planes.site.longitude_deg = number("SITELONG");
    if (!(std::abs(planes.site.latitude_deg) <= 90.0 && std::abs(planes.site.longitude_deg) <= 360.0))
      throw sim::unreadable(file_, "its site is no place on the Earth")
          .expected("SITELAT and SITELONG in degrees");
    planes.flux_is_absolute = text("FLUXCAL") != "relative";
    if (!text("SPECTRUM").empty()) planes.spectrum = text("SPECTRUM");
    planes.time_s = sim::utc_seconds(text("DATE-OBS"));
    int plane = 0;
    for (std::vector<double>* values :
         {&planes.energy_flux_mw_m2, &planes.energy_kev, &planes.relative_flux_error, &planes.ln_energy_error,
          &planes.sensitivity})
      take_plane(plane++, *values);
    scale(0, sim::Quantity::energy_flux_mw_m2, planes.energy_flux_mw_m2);
    scale(1, sim::Quantity::energy_kev, planes.energy_kev);
    return planes;
  }

 private:
  std::string text(const std::string& keyword) const {
    const auto found = fits_.keywords.find(keyword);
    return found == fits_.keywords.end() ? std::string() : found->second;
  }

  double number(const std::string& keyword) const {
    const std::string words = text(keyword);
    double value = 0.0;
    const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), value);
    if (error != std::errc() || end != words.data() + words.size() || !std::isfinite(value))
      throw sim::unreadable(file_, "its header has no number " + keyword).expected("a map of vegard's");
    return value;
  }

  /// To the quantity's unit, by the header.
  void scale(int plane, sim::Quantity quantity, std::vector<double>& values) const {
    std::string key;
    const std::string unit = sim::unit_of_plane(fits_.keywords, plane, false, key);
    const double factor = sim::declared_factor(unit, quantity, file_, key);
    for (double& value : values) value *= factor;
  }

  void take_plane(int plane, std::vector<double>& values) const {
    const sim::Image& image = fits_.image;
    for (int row = 0; row < image.height; ++row)
      for (int x = 0; x < image.width; ++x) {
        const std::size_t at = image.index(x, image.height - 1 - row, plane);
        values.push_back(fits_.known[at] != 0 ? static_cast<double>(image.data[at]) : sim::kNaN);
      }
  }

  std::string file_;
  sim::FitsImage fits_;
};

}  // namespace

PrecipitationPlanes read_precipitation_planes(const std::string& directory) {
  return PlanesReader(directory + "/precipitation.fits").read();
}

}  // namespace vegard::fit
