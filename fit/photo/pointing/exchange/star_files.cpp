#include "fit/photo/pointing/exchange/star_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/version.h"
#include "sim/view/camera/lens.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxPointsOfList = 100000;

sim::Equatorial degrees_of(const Eigen::Vector3d& v) {
  constexpr double kTurn_deg = 360.0;
  const double ra = std::atan2(v.y(), v.x()) / sim::kRadiansPerDegree;
  return {ra < 0.0 ? ra + kTurn_deg : ra,
          std::atan2(v.z(), std::hypot(v.x(), v.y())) / sim::kRadiansPerDegree};
}

int side_in(const sim::FitsKeywords& keywords, const char* key) {
  const auto found = keywords.find(key);
  double value = 0.0;
  if (found == keywords.end() ||
      std::from_chars(found->second.data(), found->second.data() + found->second.size(), value).ec !=
          std::errc())
    return 0;
  return value >= 1.0 && value <= sim::longest_side_px ? static_cast<int>(value) : 0;
}

}  // namespace

bool is_star_list(std::string_view bytes, const std::string& file) {
  if (!is_fits_table(bytes)) return false;
  const sim::FitsTable table = sim::read_fits_table(bytes, file);
  return table.columns.count("X") != 0 && table.columns.count("Y") != 0 &&
         table.columns.count("field_x") == 0;
}

StarPoints read_star_list(std::string_view bytes, const std::string& file) {
  const sim::FitsTable table = sim::read_fits_table(bytes, file);
  const std::vector<double>&x = table.columns.at("X"), &y = table.columns.at("Y");
  if (x.empty() || x.size() > kMaxPointsOfList)
    throw sim::unreadable(file, "it has " + std::to_string(x.size()) + " points").expected("1 to 100000");
  StarPoints list;
  const sim::FitsKeywords header = sim::read_fits_header(bytes, file);  // the table has one of its own
  list.frame = {side_in(header, "IMAGEW"), side_in(header, "IMAGEH"), true};
  if (list.frame.width_px == 0 || list.frame.height_px == 0) list.frame = {};
  const auto flux = table.columns.find("FLUX");
  for (std::size_t i = 0; i < x.size(); ++i) {
    FoundStar point;
    point.x_px = x[i] - 0.5;
    point.y_px = y[i] - 0.5;
    constexpr double kFarthest_px = 1e6;
    if (!(std::abs(point.x_px) < kFarthest_px && std::abs(point.y_px) < kFarthest_px))
      throw sim::unreadable(file, "X or Y of row " + std::to_string(i + 1) + " is out of range");
    if (flux != table.columns.end()) point.flux = flux->second[i];
    list.points.push_back(point);
  }
  if (flux != table.columns.end())
    std::stable_sort(list.points.begin(), list.points.end(),
                     [](const FoundStar& a, const FoundStar& b) { return a.flux > b.flux; });
  return list;
}

std::string encode_star_list(const std::vector<FoundStar>& points, const Frame& frame,
                             const std::string& name) {
  sim::FitsColumn x{"X", "pix", {}}, y{"Y", "pix", {}}, flux{"FLUX", "", {}};
  for (const FoundStar& point : points) {
    x.values.push_back(point.x_px + 0.5);
    y.values.push_back(point.y_px + 0.5);
    flux.values.push_back(point.flux);
  }
  return sim::encode_fits_table({x, y, flux},
                                {{"IMAGEW", static_cast<double>(frame.width_px), "width of the picture"},
                                 {"IMAGEH", static_cast<double>(frame.height_px), "height of the picture"},
                                 {"ORIGIN", "vegard " + sim::version(), ""}},
                                name);
}

std::string encode_star_pairs(const Calibration& calibration, const SkyOfPicture& sky,
                              const std::string& name) {
  std::vector<sim::FitsColumn> columns = {
      {"field_x", "pix", {}}, {"field_y", "pix", {}}, {"field_ra", "deg", {}}, {"field_dec", "deg", {}},
      {"index_x", "pix", {}}, {"index_y", "pix", {}}, {"index_ra", "deg", {}}, {"index_dec", "deg", {}}};
  const sim::Lens<double> lens = true_lens(calibration.camera);
  for (std::size_t i = 0; i < calibration.stars.size(); ++i) {
    const StarSighting& star = calibration.stars[i];
    const StarResidual& left = calibration.residuals[i];
    double own[3];
    if (!left.used || !sim::unproject(lens, star.x_px, star.y_px, own)) continue;
    const Eigen::Vector3d seen =
        (calibration.camera.camera_from_enu.transpose() * Eigen::Vector3d(own[0], own[1], own[2]))
            .normalized();
    const sim::Equatorial field = degrees_of(j2000_of_direction(seen, *sky.observer, *sky.julian_date));
    const sim::Equatorial index = degrees_of(j2000_of_direction(
        Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]), *sky.observer, *sky.julian_date));
    const double row[] = {star.x_px + 0.5,
                          star.y_px + 0.5,
                          field.right_ascension_deg,
                          field.declination_deg,
                          star.x_px - left.dx_px + 0.5,
                          star.y_px - left.dy_px + 0.5,
                          index.right_ascension_deg,
                          index.declination_deg};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
  }
  return sim::encode_fits_table(columns, {{"ORIGIN", "vegard " + sim::version(), ""}}, name);
}

}  // namespace vegard::fit
