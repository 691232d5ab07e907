#include "fit/measurement/calibration_inputs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "fit/measurement/words.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "fit/photo/pointing/map_calibration.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::fit {
namespace {

bool is_given_size(const CalibrationRequest& request, int width, int height) {
  return request.size_px.empty() || (request.size_px[0] == width && request.size_px[1] == height);
}

sim::DirectionMap map_of_wcs(const CalibrationRequest& request, int width, int height,
                             const SkyOfPicture& sky) {
  SipWcs wcs = read_sip_wcs(sim::input_bytes(request.wcs, "the .wcs file of solve-field"), request.wcs);
  require_sky(sky, request.wcs);
  if (wcs.width_px == 0 || wcs.height_px == 0) {
    wcs.width_px = width;
    wcs.height_px = height;
  }
  if (wcs.width_px == 0)
    throw usage_error("--size", "the solution does not say how large its picture is", "--size or --image");
  sim::check_pixel_limit(wcs.width_px, wcs.height_px, request.wcs);
  return directions_of_wcs(wcs, *sky.observer, *sky.julian_date);
}

sim::DirectionMap map_of_aida(const CalibrationRequest& request, int width, int height) {
  const std::vector<AidaCamera> cameras =
      read_aida_cameras(sim::input_bytes(request.acc, "a camera of AIDA_tools"), request.acc);
  const auto chosen = std::find_if(cameras.begin(), cameras.end(), [&](const AidaCamera& one) {
    return !request.acc_line || one.line == *request.acc_line;
  });
  if (cameras.size() > 1 && !request.acc_line)
    throw usage_error("--acc-line", "the file has " + std::to_string(cameras.size()) + " cameras",
                      "the line of one of them");
  if (chosen == cameras.end())
    throw usage_error("--acc-line", "there is no camera in line " + std::to_string(*request.acc_line),
                      "a line of the file");
  if (width == 0) throw usage_error("--size", "a camera of AIDA's has no size", "--size W,H or --image");
  return directions_of_aida(*chosen, width, height);
}

}  // namespace

Frame frame_of_stars(const CalibrationRequest& request, const std::optional<Photo>& photo,
                     const std::vector<StarSighting>& stars) {
  if (photo) {
    const Frame frame{photo->linear.width, photo->linear.height, true};
    if (!is_given_size(request, frame.width_px, frame.height_px))
      throw usage_error("--size", "the picture has another size", "no --size with --image");
    return frame;
  }
  if (!request.size_px.empty()) {
    if (request.size_px[0] < 1 || request.size_px[1] < 1 ||
        std::max(request.size_px[0], request.size_px[1]) > 65535)
      throw usage_error("--size", "no such size", "two numbers from 1 to 65535");
    return {request.size_px[0], request.size_px[1], true};
  }
  double right = 1.0, bottom = 1.0;
  for (const StarSighting& star : stars) {
    right = std::max(right, std::min(star.x_px, 65000.0));
    bottom = std::max(bottom, std::min(star.y_px, 65000.0));
  }
  return {static_cast<int>(std::ceil(right)), static_cast<int>(std::ceil(bottom)), false};
}

Frame frame_of_maps(const CalibrationRequest& request, const std::optional<Photo>& photo,
                    const sim::DirectionMap& map) {
  if (photo && (photo->linear.width != map.width || photo->linear.height != map.height))
    throw usage_error("--image", "the picture has another size than the maps", "the maps' own picture");
  if (!is_given_size(request, map.width, map.height))
    throw usage_error("--size", "the maps have another size", "no --size with maps");
  return {map.width, map.height, true};
}

std::optional<StarPoints> listed_points(const CalibrationRequest& request) {
  if (request.stars.empty()) return std::nullopt;
  const std::string bytes = sim::input_bytes(request.stars, "a table of stars");
  if (!is_star_list(bytes, request.stars)) return std::nullopt;
  if (request.camera.empty())
    throw usage_error("--camera", "points of light alone are stars of a rough camera",
                      "--camera CAMERA.toml with the list, or --image alone");
  return read_star_list(bytes, request.stars);
}

void move_by_offset(const CalibrationRequest& request, StarSighting& star) {
  if (request.offset_px.empty()) return;
  star.x_px += request.offset_px[0];
  star.y_px += request.offset_px[1];
}

std::vector<StarSighting> table_of(const CalibrationRequest& request, const SkyOfPicture& sky) {
  std::vector<StarSighting> stars = read_star_table(request.stars, sky, request.first_pixel);
  for (StarSighting& star : stars) move_by_offset(request, star);
  return stars;
}

KnownMaps told_directions(const CalibrationRequest& request, const std::optional<Photo>& photo,
                          const SkyOfPicture& sky) {
  int width = 0, height = 0;
  if (photo) {
    width = photo->linear.width;
    height = photo->linear.height;
  } else if (!request.size_px.empty()) {
    width = request.size_px[0];
    height = request.size_px[1];
    sim::check_pixel_limit(width, height, "--size");
  }
  KnownMaps known;
  known.file = request.source();
  known.names = std::filesystem::path(known.file).filename().string();
  known.map =
      request.wcs.empty() ? map_of_aida(request, width, height) : map_of_wcs(request, width, height, sky);
  flip_map(request.flip, known.map);
  return known;
}

}  // namespace vegard::fit
