#include "fit/photo/pointing/star_check.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kStarsNarrowest = 0.01;  // width over length: of a line

}  // namespace

void check_stars(const std::vector<StarSighting>& stars, int free_numbers, const std::string& name,
                 const std::string& called) {
  const int n = static_cast<int>(stars.size());
  // Four residuals more than numbers, two to a star.
  const int needed = (free_numbers + 4 + 1) / 2;
  if (n < needed)
    throw sim::unreadable(name, std::to_string(n) + " " + (n == 1 && called == "stars" ? "star" : called) +
                                    " for a camera of " + std::to_string(free_numbers) + " numbers")
        .expected("at least " + std::to_string(needed))
        .hint("add " + called + ", or hold numbers with --free and --camera");
  Eigen::MatrixXd places(n, 2), directions(n, 3);
  for (int i = 0; i < n; ++i) {
    places.row(i) << stars[i].x_px, stars[i].y_px;
    directions.row(i) << stars[i].enu[0], stars[i].enu[1], stars[i].enu[2];
  }
  const Eigen::MatrixXd about = places.rowwise() - places.colwise().mean();
  const Eigen::VectorXd spread =
      sim::symmetric_eigen(about.transpose() * about / n).values.cwiseMax(0.0).cwiseSqrt();
  if (spread[1] < 1.0)
    throw sim::unreadable(name, "all " + called + " are at one point of the picture")
        .expected(called + " all over it");
  if (spread[0] < kStarsNarrowest * spread[1])
    throw sim::unreadable(name, "all " + called + " are on one line of the picture")
        .expected(called + " on both sides of it");
  const Eigen::MatrixXd across = directions.rowwise() - directions.colwise().mean();
  const Eigen::VectorXd width =
      sim::symmetric_eigen(across.transpose() * across / n).values.cwiseMax(0.0).cwiseSqrt();
  if (width[2] < 1e-5)
    throw sim::unreadable(name, "all " + called + " are at one point of the sky")
        .expected("different " + called);
  if (width[1] < kStarsNarrowest * width[2])
    throw sim::unreadable(name, "all " + called + " are on one line of the sky")
        .expected(called + " on both sides of it");
}

void check_star_places(const std::vector<StarSighting>& stars, const Frame& frame, const std::string& name) {
  constexpr double kSlack_px = 1.0;  // of where the first pixel's centre is counted from
  for (const StarSighting& star : stars) {
    if (star.x_px >= -kSlack_px && star.x_px <= frame.width_px + kSlack_px && star.y_px >= -kSlack_px &&
        star.y_px <= frame.height_px + kSlack_px)
      continue;
    throw sim::unreadable(name, "a star at (" + sim::short_number(star.x_px, 6) + ", " +
                                    sim::short_number(star.y_px, 6) + ") px, outside of the picture of " +
                                    std::to_string(frame.width_px) + " x " + std::to_string(frame.height_px) +
                                    " px")
        .line(star.line)
        .expected("the places of stars in this picture, at this size")
        .hint(
            "is the table another picture's, or this one's before it was made smaller? --offset is for a "
            "table of a crop");
  }
}

int ninth_of(const Frame& frame, double x_px, double y_px) {
  const auto third = [](double place, int length) {
    return std::clamp(static_cast<int>(3.0 * place / std::max(length, 1)), 0, 2);
  };
  return 3 * third(y_px, frame.height_px) + third(x_px, frame.width_px);
}

std::string region_name(const Frame& frame, double x_px, double y_px) {
  constexpr std::array<const char*, kPictureNinths> kNames = {
      "upper left", "top", "upper right", "left", "middle", "right", "lower left", "bottom", "lower right"};
  return kNames[static_cast<std::size_t>(ninth_of(frame, x_px, y_px))];
}

bool only_in_first_quarter(const std::vector<StarSighting>& stars, const Frame& frame) {
  constexpr std::size_t kEnoughStars = 6;
  for (const StarSighting& star : stars)
    if (2.0 * star.x_px > frame.width_px || 2.0 * star.y_px > frame.height_px) return false;
  return stars.size() >= kEnoughStars;
}

}  // namespace vegard::fit
