#include "fit/photo/pointing/star_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/text.h"
#include "sim/scene/rows/complaint.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {
namespace {

class Reader {
 public:
  Reader(const std::string& name, const SkyOfPicture& sky, double first_pixel, bool ra_is_hours = false)
      : name_(name), sky_(sky), shift_px_(0.5 - first_pixel), ra_is_hours_(ra_is_hours) {}

  std::vector<StarSighting> read(const std::string& text) {
    std::size_t begin = sim::starts_with(text, "\xef\xbb\xbf") ? 3 : 0;
    for (; begin < text.size(); ++line_) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string line = text.substr(begin, end - begin);
      if (line.find('\0') != std::string::npos)
        throw bad_line("there are bytes of zero in it").expected("text").hint("was the file cut or damaged?");
      if (columns_.empty() && line[0] != '#') separator_ = sim::table_separator(line);
      cells_ = cells_of(line);
      begin = end + 1;
      if (cells_.size() == 1 && cells_[0].empty()) continue;
      if (!cells_[0].empty() && cells_[0][0] == '#') continue;
      if (columns_.empty())
        header();
      else
        star();
    }
    if (columns_.empty()) throw bad_line("an empty table").expected("names of columns in the first line");
    return stars_;
  }

 private:
  std::vector<std::string> cells_of(const std::string& line) const {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == separator_ && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    }
    for (std::string& cell : cells) cell = std::string(sim::trimmed(cell));
    return cells;
  }

  sim::Error bad_line(const std::string& problem) const {
    return sim::unreadable(name_, problem).line(line_);
  }

  bool has(const char* column) const { return columns_.count(column) != 0; }

  void header() {
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (!columns_.emplace(sim::lowered(cells_[i]), i).second)
        throw bad_line("two columns are called '" + cells_[i] + "'").expected("one of each");
    if (!has("x_px") || !has("y_px"))
      throw bad_line("no columns x_px and y_px")
          .expected(
              "where each star was seen; names of columns in the first line, with commas, semicolons or "
              "tabs between")
          .hint("the first line has " + sim::joined(cells_));
    if (has("azimuth_deg") && (has("elevation_deg") || has("zenith_deg"))) return;
    if ((has("ra_deg") || has("ra_hours")) && has("dec_deg")) return require_sky(sky_, name_);
    if (has("star")) return require_sky(sky_, name_);
    throw bad_line("no columns that say where the stars are")
        .expected("azimuth_deg and elevation_deg or zenith_deg; ra_deg or ra_hours, and dec_deg; or star");
  }

  const std::string& text(const char* column) const { return cells_[columns_.at(column)]; }

  double number(const char* column, double least, double most) const {
    std::string cell = sim::with_decimal_point(text(column), separator_);
    if (!cell.empty() && cell[0] == '+') cell.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
      throw bad_line("'" + text(column) + "' is no number").expected("a number").key(column);
    if (value < least || value > most)
      throw bad_line(text(column) + " is out of range")
          .expected(std::to_string(static_cast<int>(least)) + " to " + std::to_string(static_cast<int>(most)))
          .key(column);
    return value;
  }

  void star() {
    if (cells_.size() != columns_.size())
      throw bad_line(std::to_string(cells_.size()) + " cells")
          .expected(std::to_string(columns_.size()) + ", as in the first line");
    StarSighting star;
    star.line = line_;
    star.x_px = number("x_px", -1e6, 1e6) + shift_px_;
    star.y_px = number("y_px", -1e6, 1e6) + shift_px_;
    if (has("magnitude") && !text("magnitude").empty()) star.magnitude = number("magnitude", -30, 30);
    if (has("name")) star.name = text("name");
    if (has("azimuth_deg") && (has("elevation_deg") || has("zenith_deg"))) {
      const double azimuth = number("azimuth_deg", -720, 720) * sim::kRadiansPerDegree;
      const double elevation =
          (has("elevation_deg") ? number("elevation_deg", -90, 90) : 90.0 - number("zenith_deg", 0, 180)) *
          sim::kRadiansPerDegree;
      star.enu = {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                  std::sin(elevation)};
      star.is_direction_given = true;
    } else if (has("dec_deg")) {
      sim::CataloguePlace place;
      const bool is_hours = ra_is_hours_ || !has("ra_deg");
      const char* const column = has("ra_deg") ? "ra_deg" : "ra_hours";
      place.j2000 = {is_hours ? 15.0 * number(column, 0, 24) : number(column, 0, 360),
                     number("dec_deg", -90, 90)};
      star.enu = sim::direction_of_star(place, *sky_.observer, *sky_.julian_date);
    } else {
      catalogued(star);
    }
    if (star.name.empty() && has("star")) star.name = text("star");
    stars_.push_back(star);
  }

  void catalogued(StarSighting& star) const {
    const sim::BrightStar* known = sim::find_bright_star(text("star"));
    if (known == nullptr) {
      std::vector<std::string> names;
      for (const sim::BrightStar& one : sim::bright_stars())
        for (const std::string& name : {one.name, one.designation})
          if (!name.empty()) names.push_back(name);
      throw bad_line("no star '" + text("star") + "' in the table of bright stars")
          .expected("a name, a designation such as \"alf Lyr\", \"HIP 91262\" or \"HD 172167\"")
          .key("star")
          .hint(sim::nearest_hint(text("star"), names));
    }
    star.name = known->label();
    if (std::isnan(star.magnitude)) star.magnitude = known->magnitude;
    star.enu = sim::direction_of_star(known->place, *sky_.observer, *sky_.julian_date);
  }

  const std::string& name_;
  const SkyOfPicture& sky_;
  double shift_px_;
  bool ra_is_hours_;  ///< also of ra_deg
  char separator_ = ',';
  int line_ = 1;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string> cells_;
  std::vector<StarSighting> stars_;
};

constexpr double kFieldMaxPixels = 1e6;

}  // namespace

void require_sky(const SkyOfPicture& sky, const std::string& file) {
  if (sky.julian_date && sky.observer) return;
  throw sim::Error(sim::ErrorKind::usage,
                   "directions of stars by name or by right ascension depend on time and site")
      .file(file)
      .key(sky.julian_date ? "--site" : "--time")
      .expected("--time and --site");
}

std::vector<StarSighting> parse_star_table(const std::string& text, const std::string& name,
                                           const SkyOfPicture& sky, double first_pixel) {
  return Reader(name, sky, first_pixel).read(text);
}

std::vector<StarSighting> read_star_table(const std::string& file, const SkyOfPicture& sky,
                                          std::optional<double> first_pixel) {
  const std::string text = sim::input_bytes(file, "a table of stars");
  if (is_fits_table(text)) return solved_field(text, file, sky, first_pixel.value_or(1.0));
  return parse_star_table(text, file, sky, first_pixel.value_or(0.5));
}

std::optional<std::vector<StarSighting>> stars_with_hours(const std::string& file, const SkyOfPicture& sky,
                                                          std::optional<double> first_pixel) {
  const std::string text = sim::input_bytes(file, "a table of stars");
  if (is_fits_table(text) || sim::lowered(text.substr(0, text.find("dec_deg"))).find("ra_deg") == text.npos)
    return std::nullopt;
  try {
    return Reader(file, sky, first_pixel.value_or(0.5), true).read(text);
  } catch (const sim::Error&) {
    return std::nullopt;
  }
}

bool is_fits_table(std::string_view bytes) { return bytes.substr(0, 9) == "SIMPLE  ="; }

std::vector<StarSighting> solved_field(std::string_view bytes, const std::string& file,
                                       const SkyOfPicture& sky, double first_pixel) {
  constexpr std::array<const char*, 4> kNames = {"field_x", "field_y", "index_ra", "index_dec"};
  constexpr std::array<std::array<double, 2>, 4> kLimits = {{{-kFieldMaxPixels, kFieldMaxPixels},
                                                             {-kFieldMaxPixels, kFieldMaxPixels},
                                                             {0.0, 360.0},
                                                             {-90.0, 90.0}}};
  const sim::FitsTable table = sim::read_fits_table(bytes, file);
  std::array<const std::vector<double>*, 4> columns{};
  for (std::size_t c = 0; c < kNames.size(); ++c) {
    const auto found = table.columns.find(kNames[c]);
    if (found == table.columns.end())
      throw sim::unreadable(file, std::string("this FITS table has no column ") + kNames[c])
          .expected("the .corr file of solve-field: field_x, field_y, index_ra, index_dec");
    columns[c] = &found->second;
  }
  if (columns[0]->empty())
    throw sim::unreadable(file, "this FITS table has no rows")
        .expected("a star in each: was the field solved?");
  require_sky(sky, file);

  std::vector<StarSighting> stars;
  for (std::size_t row = 0; row < columns[0]->size(); ++row) {
    std::array<double, 4> numbers{};
    for (std::size_t c = 0; c < kNames.size(); ++c) {
      numbers[c] = (*columns[c])[row];
      if (!(numbers[c] >= kLimits[c][0] && numbers[c] <= kLimits[c][1]))
        throw sim::unreadable(
            file, std::string(kNames[c]) + " of row " + std::to_string(row + 1) + " is out of range")
            .expected(std::to_string(static_cast<int>(kLimits[c][0])) + " to " +
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
