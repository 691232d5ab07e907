#include "fit/photo/pointing/solved_field.h"

#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"

namespace vegard::fit {
namespace {

constexpr double kFieldMostPixels = 1e6;

}  // namespace

bool is_fits_table(std::string_view bytes) { return bytes.substr(0, 9) == "SIMPLE  ="; }

std::vector<StarSighting> solved_field(std::string_view bytes, const std::string& file,
                                       const SkyOfPicture& sky, double first_pixel) {
  constexpr std::array<const char*, 4> kNames = {"field_x", "field_y", "index_ra", "index_dec"};
  constexpr std::array<std::array<double, 2>, 4> kLimits = {{{-kFieldMostPixels, kFieldMostPixels},
                                                             {-kFieldMostPixels, kFieldMostPixels},
                                                             {0.0, 360.0},
                                                             {-90.0, 90.0}}};
  const sim::FitsTable table = sim::read_fits_table(bytes, file);
  std::array<const std::vector<double>*, 4> columns{};
  for (std::size_t c = 0; c < kNames.size(); ++c) {
    const auto found = table.columns.find(kNames[c]);
    if (found == table.columns.end())
      sim::refuse_file(sim::ErrorKind::unreadable_input, file,
                       std::string("this FITS table has no column ") + kNames[c],
                       "the .corr file of solve-field: field_x, field_y, index_ra, index_dec");
    columns[c] = &found->second;
  }
  if (columns[0]->empty())
    sim::refuse_file(sim::ErrorKind::unreadable_input, file, "this FITS table has no rows",
                     "a star in each: was the field solved?");
  require_sky(sky, file);

  std::vector<StarSighting> stars;
  for (std::size_t row = 0; row < columns[0]->size(); ++row) {
    std::array<double, 4> numbers{};
    for (std::size_t c = 0; c < kNames.size(); ++c) {
      numbers[c] = (*columns[c])[row];
      if (!(numbers[c] >= kLimits[c][0] && numbers[c] <= kLimits[c][1]))
        sim::refuse_file(sim::ErrorKind::unreadable_input, file,
                         std::string(kNames[c]) + " of row " + std::to_string(row + 1) + " is out of range",
                         std::to_string(static_cast<int>(kLimits[c][0])) + " to " +
                             std::to_string(static_cast<int>(kLimits[c][1])));
    }
    StarSighting star;
    star.name = "row " + std::to_string(row + 1);
    star.x_px = numbers[0] + 0.5 - first_pixel;
    star.y_px = numbers[1] + 0.5 - first_pixel;
    sim::CataloguePlace place;
    place.j2000 = {numbers[2], numbers[3]};
    star.enu = sim::direction_of_star(place, *sky.observer, *sky.julian_date);
    stars.push_back(star);
  }
  return stars;
}

}  // namespace vegard::fit
