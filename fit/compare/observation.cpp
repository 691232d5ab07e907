#include "fit/compare/observation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "fit/measure/profile_bins.h"
#include "sim/base/error.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/lens.h"

namespace vegard::fit {
namespace {

constexpr double kSearchError = 0.1;  // the search weighs bright and dark alike
constexpr double kSearchPeakShare = 0.5;
constexpr double kSearchFineness = 1.0;
constexpr double kSmoothingPerBin = 2.0;  // standard deviations of the smoothing, in bins

void check_sizes(const sim::Scene& scene, const Photo& photo) {
  const sim::PictureSize file_size = size_of_file(photo);
  if (file_size.width == scene.camera.width && file_size.height == scene.camera.height) return;
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
  throw sim::Error(sim::ErrorKind::scene, "the camera has " + size(scene.camera.width, scene.camera.height) +
                                              " pixels, " + photo.file_name + " has " +
                                              size(file_size.width, file_size.height))
      .file(scene.file)
      .key("camera.width")
      .expected("the photograph's size")
      .hint("set camera.width and camera.height");
}

/// A film that counts points, or puts each into one cell, has no derivative by the points' places; and a fit
/// blurs lines, not colours.
void check_film(const sim::Scene& scene) {
  const auto refuse = [&](const std::string& key, auto value, auto needed, const char* hint) {
    if (value == needed) return;
    throw sim::Error(sim::ErrorKind::scene, "\"" + sim::word_of(value) + "\" cannot be fitted")
        .file(scene.file)
        .key(key)
        .expected("\"" + sim::word_of(needed) + "\"")
        .hint(hint);
  };
  const char* literal = "the literal forward map is for rendering only";
  refuse("film.weight", scene.film.weight, sim::PointWeight::rayleigh, literal);
  refuse("film.splat", scene.film.splat, sim::SplatRule::bilinear, literal);
  refuse("blur.order", scene.blur.order, sim::BlurOrder::lines,
         "the blur after colour is for rendering only");
  if (sim::is_panorama(scene.camera.model))
    refuse("camera.model", scene.camera.model, sim::LensModel::pinhole, "panoramas are for rendering only");
  for (const sim::Nebula& nebula : scene.nebulae)
    refuse("nebula." + nebula.name + ".method", nebula.method, sim::NebulaMethod::physical,
           "the literal march makes colours, not light that could be compared");
}

/// What the simulation's own sampling leaves in a profile, as a fraction of its brightness: beams may be
/// drawn, volumes are not.
double sampling_error_of(const sim::Scene& scene, const Photo& photo, const Profile& data, int threads) {
  if (scene.sheets.empty() || !is_drawn(scene)) return 0.0;
  std::array<ModelProfile, 2> samplings;
  for (std::size_t i = 0; i < samplings.size(); ++i)
    ProfileModel(scene, photo, data.region, data.bands, 1.0, kProfileSmoothing_px, threads, i)
        .evaluate(scene, samplings[i]);
  return sampling_error(samplings[0].value, samplings[1].value, data.bands);
}

/// The photograph's noise and structure that the model does not have, of which `model_error` is a share, in
/// quadrature.
std::vector<double> whole_sigma(const sim::Scene& scene, const Photo& photo, const Profile& data,
                                double model_error) {
  std::vector<double> sigma = profile_sigma(data, model_error);
  if (scene.fit.profile_along != sim::ProfileAlong::columns) return sigma;
  const std::vector<double> ray_sigma =
      realisation_sigma(photo, data.region, data.bands, kProfileSmoothing_px);
  for (std::size_t i = 0; i < sigma.size(); ++i)
    if (sigma[i] > 0.0) sigma[i] = std::hypot(sigma[i], ray_sigma[i]);
  return sigma;
}

/// Rows to a bin of the search: what is smoothed over many rows needs fewer.
int search_rows(const sim::Scene& scene, double smooth_rows) {
  return has_smooth_bands(scene) ? std::max(1, static_cast<int>(smooth_rows / kSmoothingPerBin)) : 1;
}

double weights(const std::vector<double>& sigma) {
  double sum = 0.0;
  for (const double s : sigma)
    if (s > 0.0) sum += 1.0 / (s * s);
  return sum;
}

/// The photograph's profile and its noise, and the comparison for the last word.
void compare_at_full_resolution(const Profile& data, int threads, Observation& o) {
  o.sum_of_weights = weights(whole_sigma(o.scene, *o.photo, data, o.scene.fit.model_error));
  const double model_error = std::hypot(o.scene.fit.model_error, o.sampling_error);
  o.full = std::make_unique<Comparison>(
      o.scene, *o.photo, data, whole_sigma(o.scene, *o.photo, data, model_error),
      Comparison::Resolution{1.0, kProfileSmoothing_px, threads, Statistics::ModelError{model_error}, 0,
                             kLastFineness});
}

}  // namespace

sim::Scene scene_of_pixels(const sim::Scene& scene, const Photo& photo) {
  check_sizes(scene, photo);
  const sim::PictureSize file_size = size_of_file(photo);
  checked_region(scene.fit.roi_px, file_size.width, file_size.height);
  return averaged_scene(scene, {file_size, {photo.linear.width, photo.linear.height}});
}

Observation observed(const sim::Scene& given, const Photo& photo, int threads, const PhotoFrame& frame) {
  const sim::Scene scene = scene_of_pixels(given, photo);
  check_film(scene);
  Observation o;
  o.photo = &photo;
  o.scene = scene;
  o.frame = frame;
  o.region = checked_region(scene.fit.roi_px, photo.linear.width, photo.linear.height);
  const Profile rows =
      measured_profile(scene, photo, std::make_shared<const BinGrid>(profile_bins(scene, o.region)));
  const Profile data = smoothed_by_px(rows, kProfileSmoothing_px);
  o.sampling_error = sampling_error_of(scene, photo, data, threads);
  compare_at_full_resolution(data, threads, o);
  const double smooth_rows = scene.fit.search_smoothing * o.region.height;
  const int rows_of_bin = search_rows(scene, smooth_rows);
  const Profile smooth_data =
      smoothed_by_px(rows_of_bin == 1 ? rows
                                      : measured_profile(scene, photo,
                                                         std::make_shared<const BinGrid>(column_bins(
                                                             o.region, scene.fit.bands, rows_of_bin))),
                     smooth_rows);
  std::vector<double> sigma = profile_sigma(smooth_data, kSearchError, kSearchPeakShare);
  for (double& s : sigma) s /= std::sqrt(static_cast<double>(rows_of_bin));  // of a row each, as before
  o.coarse = std::make_unique<Comparison>(
      scene, photo, smooth_data, std::move(sigma),
      Comparison::Resolution{scene.fit.search_beams, smooth_rows, threads,
                             Statistics::ModelError{kSearchError, kSearchPeakShare}, 0, kSearchFineness});
  return o;
}

Observation with_other_decoding(const Observation& before, const Photo& photo, int threads) {
  Observation o;
  o.photo = &photo;
  o.scene = before.scene;
  o.frame = before.frame;
  o.region = before.region;
  o.sampling_error = before.sampling_error;
  o.radars = before.radars;
  const Profile rows = measured_profile(o.scene, photo, before.full->data().grid);
  compare_at_full_resolution(smoothed_by_px(rows, kProfileSmoothing_px), threads, o);
  return o;
}

void add_radars(const sim::Scene& scene, std::vector<Observation>& observations) {
  if (scene.fit.radars.empty()) return;
  observations.front().radars = std::make_shared<const SceneRadars>(SceneRadars{Radars(scene), scene});
}

std::vector<CostTerm> cost_terms(const std::vector<Observation>& observations,
                                 const std::vector<FreeNumber>& free, Detail detail) {
  std::vector<CostTerm> terms;
  for (const Observation& o : observations)
    terms.push_back({o.scene, ParameterMap(o.scene, free, o.frame),
                     detail == Detail::full ? o.full.get() : o.coarse.get()});
  if (const auto& radars = observations.front().radars)
    terms.front().radar = std::make_shared<const RadarTerm>(
        RadarTerm{&radars->radars, radars->scene, ParameterMap(radars->scene, free)});
  return terms;
}

}  // namespace vegard::fit
