#include "fit/triangulation/sight_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMostRows = 200'000;
/// Of a curve in one picture: the time to match two grows with the product of their points.
constexpr std::size_t kMostPoints = 5000;

class SightReader {
 public:
  SightReader(std::string name, const std::vector<std::string>& cameras, const SightTableFormat& format)
      : name_(std::move(name)), cameras_(cameras), format_(format) {}

  std::vector<SightedFeature> read(std::string_view text) {
    if (sim::starts_with(text, "\xef\xbb\xbf")) text.remove_prefix(3);
    for (const std::string_view whole : sim::split(text, '\n')) {
      ++line_;
      const std::string_view line = sim::trimmed(whole);
      if (line.empty() || line[0] == '#') continue;
      if (columns_.empty())
        read_names(line);
      else
        read_row(line);
    }
    if (features_.empty())
      throw bad_line("there is nothing in the table").expected("a line of column names, and rows");
    for (SightedFeature& feature : features_) settle(feature);
    return std::move(features_);
  }

 private:
  sim::Error bad_line(const std::string& problem) const {
    return sim::unreadable(name_, problem).line(line_);
  }

  std::vector<std::string> cells_of(std::string_view line) const {
    std::vector<std::string> cells;
    for (const std::string_view cell : sim::split(line, separator_))
      cells.emplace_back(sim::trimmed(cell, " \t\r\""));
    return cells;
  }

  void read_names(std::string_view line) {
    separator_ = sim::table_separator(line);
    const std::vector<std::string> names = cells_of(line);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!columns_.emplace(sim::lowered(names[i]), i).second)
        throw bad_line("two columns are called '" + names[i] + "'").expected("one of each");
    for (const char* needed : {"name", "camera", "x_px", "y_px"})
      if (columns_.count(needed) == 0)
        throw bad_line(std::string("there is no column ") + needed)
            .expected("name, camera, x_px, y_px and, if known, sigma_px")
            .hint("the first line has " + sim::joined(names));
  }

  double number(const char* column) const {
    const std::string cell = sim::with_decimal_point(cells_[columns_.at(column)], separator_);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (problem != std::errc() || end != cell.data() + cell.size() || !(std::abs(value) < 1e6))
      throw bad_line("'" + cell + "' is no number of pixels").key(column).expected("a number");
    return value;
  }

  std::size_t camera() const {
    const std::string& word = cells_[columns_.at("camera")];
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (problem == std::errc() && end == word.data() + word.size() && number >= 1 &&
        number <= cameras_.size())
      return number - 1;
    const auto found = std::find(cameras_.begin(), cameras_.end(), word);
    if (found == cameras_.end())
      throw bad_line("'" + word + "' is none of the cameras")
          .key("camera")
          .expected("1 to " + std::to_string(cameras_.size()) + ", or " +
                    sim::joined(cameras_, ", ", " or "));
    if (std::count(cameras_.begin(), cameras_.end(), word) > 1)
      throw bad_line("several cameras are called '" + word + "'")
          .key("camera")
          .expected("its number, 1 to " + std::to_string(cameras_.size()) +
                    ", in the order of the command line");
    return static_cast<std::size_t>(found - cameras_.begin());
  }

  void read_row(std::string_view line) {
    cells_ = cells_of(line);
    if (cells_.size() != columns_.size())
      throw bad_line(std::to_string(cells_.size()) + " cells")
          .expected(std::to_string(columns_.size()) + ", as in the line of column names");
    if (++rows_ > kMostRows)
      throw bad_line("the table is too long").expected("at most " + std::to_string(kMostRows) + " rows");
    Sight sight;
    sight.camera = camera();
    sight.pixel = {number("x_px") + 0.5 - format_.first_pixel, number("y_px") + 0.5 - format_.first_pixel};
    sight.pixel_error_px = format_.error_px;
    if (columns_.count("sigma_px") != 0 && !cells_[columns_.at("sigma_px")].empty()) {
      sight.pixel_error_px = number("sigma_px");
      if (!(sight.pixel_error_px > 0.0))
        throw bad_line("an error of 0 or less").key("sigma_px").expected("a number above 0, or nothing");
    }
    const std::string& name = cells_[columns_.at("name")];
    const auto [place, is_new] = by_name_.emplace(name, features_.size());
    if (is_new) {
      features_.emplace_back();
      features_.back().name = name;
      features_.back().line = line_;
    }
    features_[place->second].sights.push_back(sight);
  }

  /// Finds out whether its rows are those of a point or of a curve.
  void settle(SightedFeature& feature) {
    line_ = feature.line;
    std::vector<std::size_t> rows(cameras_.size());
    for (const Sight& sight : feature.sights) ++rows[sight.camera];
    std::size_t least = kMostRows, most = 0, seen_by = 0;
    for (const std::size_t count : rows) {
      if (count == 0) continue;
      ++seen_by;
      least = std::min(least, count);
      most = std::max(most, count);
    }
    if (seen_by < 2)
      throw bad_line("'" + feature.name + "' is seen by one camera alone").expected("rows of two cameras");
    if (most == 1) return;
    if (least == 1)
      throw bad_line("'" + feature.name + "' is a point in one picture and a curve in another")
          .expected("one row for each camera, or two and more for each");
    if (most > kMostPoints)
      throw bad_line("'" + feature.name + "' has " + std::to_string(most) + " points in one picture")
          .expected("at most " + std::to_string(kMostPoints) + " of a curve");
    for (std::size_t c = 0; c < rows.size(); ++c) {
      if (rows[c] == 0) continue;
      PictureCurve curve;
      curve.name = feature.name;
      curve.camera = c;
      for (const Sight& sight : feature.sights) {
        if (sight.camera != c) continue;
        if (!curve.points.empty() && curve.points.back().x_px == sight.pixel.x_px &&
            curve.points.back().y_px == sight.pixel.y_px)
          throw bad_line("'" + feature.name + "' has the same pixel twice, one after the other")
              .expected("different pixels along a curve");
        curve.points.push_back(sight.pixel);
        curve.error_px.push_back(sight.pixel_error_px);
      }
      feature.curves.push_back(std::move(curve));
    }
    feature.sights.clear();
  }

  std::string name_;
  const std::vector<std::string>& cameras_;
  SightTableFormat format_;
  int line_ = 0;
  char separator_ = ',';
  std::map<std::string, std::size_t> columns_, by_name_;
  std::vector<std::string> cells_;
  std::size_t rows_ = 0;
  std::vector<SightedFeature> features_;
};

}  // namespace

std::vector<SightedFeature> read_sights(std::string_view text, const std::string& name,
                                        const std::vector<std::string>& cameras,
                                        const SightTableFormat& format) {
  return SightReader(name, cameras, format).read(text);
}

}  // namespace vegard::fit
