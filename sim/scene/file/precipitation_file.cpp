#include "sim/scene/file/precipitation_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>

#include "sim/base/declared_unit.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {
namespace {

constexpr float kDarkMapShare =
    1e-6f;  // of the largest energy flux; what is left of a sum, or of a Gaussian's tail

// With all derivatives a cell takes 272 bytes.
constexpr double kMaxMapCells = 4194304.0, kMinCellKm = 0.01, kMaxCellKm = 100.0;

class MapReader {
 public:
  explicit MapReader(const std::string& place)
      : place_(place),
        fits_(read_fits_image(input_bytes(place, "a FITS file of precipitation", kMaxPictureBytes), place)) {}

  PrecipitationMap read() const {
    PrecipitationMap map;
    const Image& image = fits_.image;
    if (image.channels() < 2)
      throw bad_map("the image has one plane alone").expected("a cube: energy flux in mW m-2, energy in keV");
    for (const char* axis : {"1", "2"}) {
      const std::string name = std::string("CTYPE") + axis, unit = std::string("CUNIT") + axis;
      const std::string wanted = axis[0] == '1' ? "EAST" : "NORTH";
      if (text(name) != wanted)
        throw bad_map(name + " is '" + text(name) + "'").expected(name + " = '" + wanted + "'");
      if (text(unit) != "km") throw bad_map(unit + " is '" + text(unit) + "'").expected(unit + " = 'km'");
    }
    const double east_step = number("CDELT1"), north_step = number("CDELT2");
    if (!(east_step >= kMinCellKm && east_step <= kMaxCellKm) ||
        !(std::abs(north_step - east_step) <= 1e-6 * east_step))
      throw bad_map("cells of " + short_real_text(east_step) + " by " + short_real_text(north_step) + " km")
          .expected("CDELT1 and CDELT2 alike, from 0.01 to 100 km");
    map.columns = image.width;
    map.rows = image.height;
    if (static_cast<double>(map.columns) * map.rows > kMaxMapCells)
      throw bad_map("a map of " + std::to_string(map.columns) + " by " + std::to_string(map.rows) + " cells")
          .expected("at most 4194304 cells");
    map.cell_km = east_step;
    map.west_km = number("CRVAL1") + (0.5 - number("CRPIX1")) * east_step;
    map.south_km = number("CRVAL2") + (0.5 - number("CRPIX2")) * east_step;
    constexpr double kFarthestKm = 1e5;
    if (!(std::abs(map.west_km) < kFarthestKm && std::abs(map.south_km) < kFarthestKm))
      throw bad_map("the map begins " + short_real_text(map.west_km) + " km to the east and " +
                    short_real_text(map.south_km) + " km to the north")
          .expected("CRVAL1 and CRVAL2 in km from the site");
    read_cells(map);
    read_site(map);
    return map;
  }

 private:
  Error bad_map(const std::string& problem) const {
    return unreadable(place_, "'" + place_ + "': " + problem);
  }

  std::string text(const std::string& keyword) const {
    const auto found = fits_.keywords.find(keyword);
    if (found == fits_.keywords.end()) return "";
    std::string value = found->second;
    value.erase(value.find_last_not_of(' ') + 1);
    return value;
  }
  double number(const std::string& keyword) const {
    const std::string value = text(keyword);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !std::isfinite(number))
      throw bad_map(value.empty() ? "there is no " + keyword : keyword + " is '" + value + "'")
          .expected("the linear axes of a map: CRPIX, CRVAL and CDELT of both");
    return number;
  }

  /// To mW m-2 or keV, by the header.
  double factor_of_plane(int plane, Quantity quantity) const {
    std::string key;
    const std::string unit = unit_of_plane(fits_.keywords, plane, false, key);
    return declared_factor(unit, quantity, place_, key);
  }

  /// The upper row of the image is the northern one, unless the file's rows run from the top down.
  void read_cells(PrecipitationMap& map) const {
    const Image& image = fits_.image;
    const bool top_down = text("ROWORDER") == "TOP-DOWN";
    const ParameterRow& energy_row = *parameter_with(ParameterRole::footprint_energy, 0).row;
    const std::size_t cells = static_cast<std::size_t>(map.columns) * map.rows;
    map.energy_flux_mw_m2.assign(cells, 0.0f);
    map.energy_kev.assign(cells, 0.0f);
    const double to_flux = factor_of_plane(0, Quantity::energy_flux_mw_m2),
                 to_kev = factor_of_plane(1, Quantity::energy_kev);
    float most = 0.0f;
    for (std::size_t from = 0; from < image.data.size(); from += static_cast<std::size_t>(image.channels()))
      if (fits_.known[from] != 0) most = std::max(most, static_cast<float>(to_flux * image.data[from]));
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column) {
        const int y = top_down ? row : map.rows - 1 - row;
        const std::size_t from =
            (static_cast<std::size_t>(y) * map.columns + column) * static_cast<std::size_t>(image.channels());
        if (fits_.known[from] == 0) continue;
        const auto flux = static_cast<float>(to_flux * image.data[from]),
                   energy = static_cast<float>(to_kev * image.data[from + 1]);
        const auto cell = [&] {
          return " in the cell " + std::to_string(column + 1) + ", " + std::to_string(row + 1);
        };
        if (flux < 0.0f)
          throw bad_map("an energy flux of " + short_real_text(flux) + " mW m-2" + cell())
              .expected("an energy flux of at least 0");
        if (flux <= kDarkMapShare * most) continue;
        const bool has_energy = fits_.known[from + 1] != 0 && energy != 0.0f;
        if (has_energy && !(energy >= energy_row.min && energy <= energy_row.max))
          throw bad_map("an energy of " + short_real_text(energy) + " keV" + cell())
              .expected("energies from " + short_real_text(energy_row.min) + " to " +
                        short_real_text(energy_row.max) + " keV where there is an energy flux");
        const std::size_t to = static_cast<std::size_t>(row) * map.columns + column;
        map.energy_flux_mw_m2[to] = flux;
        if (has_energy) map.energy_kev[to] = energy;
      }
  }

  void read_site(PrecipitationMap& map) const {
    const bool has_latitude = !text("SITELAT").empty(), has_longitude = !text("SITELONG").empty();
    if (!has_latitude && !has_longitude) return;
    if (has_latitude != has_longitude)
      throw bad_map(std::string("there is ") + (has_latitude ? "SITELAT" : "SITELONG") + " alone")
          .expected("SITELAT and SITELONG, or neither");
    Site site;
    site.latitude_deg = number("SITELAT");
    site.longitude_deg = number("SITELONG");
    if (!(std::abs(site.latitude_deg) <= 90.0 && std::abs(site.longitude_deg) <= 360.0))
      throw bad_map("a site at latitude " + short_real_text(site.latitude_deg) + ", longitude " +
                    short_real_text(site.longitude_deg))
          .expected("SITELAT and SITELONG in degrees");
    map.site = site;
  }

  std::string place_;
  FitsImage fits_;
};

}  // namespace

PrecipitationMap read_precipitation_map(const std::string& place) { return MapReader(place).read(); }

std::map<std::string, PrecipitationMap> read_precipitation_maps(const Scene& scene) {
  std::map<std::string, PrecipitationMap> maps;
  for (const Footprint& f : scene.footprints) {
    if (f.source != FootprintSource::precipitation || f.file.empty() || maps.count(f.file) > 0) continue;
    try {
      maps[f.file] =
          read_precipitation_map((std::filesystem::path(scene.file).parent_path() / f.file).string());
    } catch (const Error& error) {
      const std::string& hint = error.details().hint;
      throw Error(error)
          .key("footprint." + f.name + ".file")
          .hint(hint.empty() ? "its name is relative to the scene's file" : hint);
    }
  }
  return maps;
}

}  // namespace vegard::sim
