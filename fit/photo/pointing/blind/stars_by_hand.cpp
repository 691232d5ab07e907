#include "fit/photo/pointing/blind/stars_by_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "sim/base/error.h"

namespace vegard::fit {
namespace {

constexpr double kShortest = 0.1, kLongest = 30.0;  // focal lengths, in larger sides of the picture
constexpr int kBisections = 60;
constexpr double kNear = 0.02;  // of the larger side: what a wrong lens may miss the stars by

sim::Error unread(const std::string& option, const std::string& problem) {
  return sim::Error(sim::ErrorKind::usage, problem)
      .key(option)
      .expected(
          "NAME=X,Y for two stars or more, such as \"Vega=812,344\": pixels from the upper left corner");
}

Eigen::Vector3d sky_of(const StarSighting& star) { return {star.enu[0], star.enu[1], star.enu[2]}; }

std::optional<Eigen::Vector3d> seen(const SkyCamera& camera, const StarSighting& star) {
  double direction[3];
  if (!sim::unproject(true_lens(camera), star.x_px, star.y_px, direction)) return std::nullopt;
  return Eigen::Vector3d(direction[0], direction[1], direction[2]);
}

/// The two stars that are farthest apart in the picture.
std::pair<const StarSighting*, const StarSighting*> farthest_pair(const std::vector<StarSighting>& named) {
  std::pair<const StarSighting*, const StarSighting*> pair{&named[0], &named[1]};
  double most = -1.0;
  for (const StarSighting& a : named)
    for (const StarSighting& b : named) {
      const double apart = std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
      if (apart <= most) continue;
      most = apart;
      pair = {&a, &b};
    }
  return pair;
}

/// The focal length at which two stars are as far apart in the picture as in the sky. A longer one makes
/// less of the same pixels.
bool set_focal_length(const StarSighting& a, const StarSighting& b, double side_px, SkyCamera& camera) {
  const double apart = std::acos(std::clamp(sky_of(a).dot(sky_of(b)), -1.0, 1.0));
  double shortest = kShortest * side_px, longest = kLongest * side_px;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(shortest * longest);
    camera.numbers[focal_px_number] = middle;
    const std::optional<Eigen::Vector3d> of_a = seen(camera, a), of_b = seen(camera, b);
    // Where the lens has no image there, its focal length is too short.
    const bool is_wide = !of_a || !of_b || std::acos(std::clamp(of_a->dot(*of_b), -1.0, 1.0)) > apart;
    (is_wide ? shortest : longest) = middle;
  }
  camera.numbers[focal_px_number] = longest;
  return shortest > kShortest * side_px && longest < kLongest * side_px;
}

/// Right-handed axes by two directions.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d axes;
  axes.col(0) = (a + b).normalized();
  axes.col(1) = (b - a).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

bool set_rotation(const StarSighting& a, const StarSighting& b, SkyCamera& camera) {
  const std::optional<Eigen::Vector3d> of_a = seen(camera, a), of_b = seen(camera, b);
  if (!of_a || !of_b) return false;
  camera.camera_from_enu = axes_of(*of_a, *of_b) * axes_of(sky_of(a), sky_of(b)).transpose();
  return true;
}

/// Lenses that it may be.
std::vector<SkyCamera> lenses(const Frame& frame, const std::optional<SkyCamera>& known) {
  if (known) return {*known};
  std::vector<SkyCamera> all;
  for (const bool mirrored : {false, true})
    for (const sim::LensModel model : {sim::LensModel::pinhole, sim::LensModel::equidistant,
                                       sim::LensModel::equisolid, sim::LensModel::stereographic}) {
      SkyCamera camera;
      camera.model = model;
      camera.mirrored = mirrored;
      camera.numbers[centre_x_number] = 0.5 * frame.width_px;
      camera.numbers[centre_y_number] = 0.5 * frame.height_px;
      all.push_back(camera);
    }
  return all;
}

}  // namespace

std::vector<StarSighting> stars_by_hand(const std::vector<std::string>& words, const SkyOfPicture& sky,
                                        const std::string& option) {
  std::string table = "star,x_px,y_px\n";
  std::vector<std::string> names;
  for (const std::string& word : words) {
    const std::size_t equals = word.rfind('='),
                      comma = word.find(',', equals == std::string::npos ? 0 : equals);
    if (equals == std::string::npos || equals == 0 || comma == std::string::npos ||
        word.find_first_of(",;\"\n") < equals)
      throw unread(option, "'" + word + "' is no star with its place");
    names.push_back(word.substr(0, equals));
    table += names.back() + "," + word.substr(equals + 1, comma - equals - 1) + "," + word.substr(comma + 1) +
             "\n";
  }
  if (names.size() < 2) throw unread(option, "one star alone does not tell where a camera looks");
  std::vector<StarSighting> stars = parse_star_table(table, option, sky);
  for (std::size_t i = 0; i < stars.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (sky_of(stars[i]).dot(sky_of(stars[k])) > 1.0 - 1e-12)
        throw unread(option, "'" + names[i] + "' and '" + names[k] + "' are one star");
      else if (stars[i].x_px == stars[k].x_px && stars[i].y_px == stars[k].y_px)
        throw unread(option, "'" + names[i] + "' and '" + names[k] + "' have one place");
  return stars;
}

std::vector<SkyCamera> cameras_by_hand(const std::vector<StarSighting>& named, const Frame& frame,
                                       const std::optional<SkyCamera>& lens) {
  const double side_px = std::max(frame.width_px, frame.height_px);
  const auto [a, b] = farthest_pair(named);
  std::vector<LensNumber> free = {turn_about_right, turn_about_down, turn_about_forward};
  if (!lens) free.push_back(focal_px_number);
  std::vector<std::pair<double, SkyCamera>> found;
  for (SkyCamera camera : lenses(frame, lens)) {
    if (!lens && !set_focal_length(*a, *b, side_px, camera)) continue;
    if (!set_rotation(*a, *b, camera)) continue;
    const CameraFit fit = fit_camera(camera, free, named);
    if (!fit.good) continue;
    const double rms_px = std::sqrt(fit.sum_of_squares / static_cast<double>(named.size()));
    if (rms_px <= kNear * side_px) found.emplace_back(rms_px, with_rotation_applied(fit.camera));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& one, const auto& other) { return one.first < other.first; });
  std::vector<SkyCamera> cameras;
  for (auto& [rms_px, camera] : found) cameras.push_back(std::move(camera));
  return cameras;
}

}  // namespace vegard::fit
