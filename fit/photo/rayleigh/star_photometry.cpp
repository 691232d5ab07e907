#include "fit/photo/rayleigh/star_photometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "fit/photo/pointing/star_finder.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/star_photometry.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr double kMagnitudesPerDepth = 1.0857362047581296;  // 2.5 / ln 10
constexpr double kSquareCm = 1e4;

/// A star of the catalogue where a picture should have it.
struct PlacedStar {
  const sim::BrightStar* star = nullptr;
  double x_px = 0.0, y_px = 0.0, elevation_deg = 0.0, light = 0.0;
};

std::vector<PlacedStar> placed_stars(const sim::Scene& scene, double julian_date,
                                     const StarPhotometrySettings& settings) {
  const sim::Observer observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m,
                               settings.refracting_air};
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  // All of the catalogue, to magnitude 6: what is not measured may still
  // disturb.
  std::vector<PlacedStar> placed;
  for (const sim::BrightStar& star : sim::catalogue_stars()) {
    const std::array<double, 3> enu = sim::direction_of_star(star.place, observer, julian_date);
    PlacedStar one;
    if (enu[2] < 0.0 || !sim::pixel_of_enu(view, enu.data(), one.x_px, one.y_px)) continue;
    one.star = &star;
    one.elevation_deg = std::asin(std::min(enu[2], 1.0)) / sim::kRadiansPerDegree;
    one.light = std::pow(10.0, -0.4 * star.magnitude);
    placed.push_back(one);
  }
  return placed;
}

/// True if a neighbour in the catalogue puts more than a fiftieth of the star's own light into its circle.
bool is_disturbed(const PlacedStar& star, const std::vector<PlacedStar>& all, const Aperture& aperture) {
  constexpr double kStarsWidth_px = 1.0, kMaxShare = 0.02;
  const double near = aperture.radius_px + kStarsWidth_px;
  double others = 0.0;
  for (const PlacedStar& other : all)
    if (other.star != star.star && std::hypot(other.x_px - star.x_px, other.y_px - star.y_px) < near)
      others += other.light;
  return others > kMaxShare * star.light;
}

/// All other stars of the catalogue that reach into its ring.
std::vector<Neighbour> neighbours_of(const PlacedStar& star, const std::vector<PlacedStar>& all,
                                     const Aperture& aperture) {
  const double reach = 2.0 * aperture.radius_px + aperture.gap_px + aperture.ring_px + 1.0;
  std::vector<Neighbour> neighbours;
  for (const PlacedStar& other : all)
    if (other.star != star.star && std::hypot(other.x_px - star.x_px, other.y_px - star.y_px) < reach)
      neighbours.push_back({other.x_px, other.y_px});
  return neighbours;
}

/// Moves stars to the points of light that they are seen as: bright ones each to its own, the others by as
/// much as these on the whole, so that what is too faint to be found is measured all the same.
void move_to_points(std::vector<PlacedStar>& stars, const CountPicture& picture) {
  constexpr double kFarthest_px = 2.5, kMinSignal = 8.0;
  StarFinderSettings finder;
  finder.min_signal = kMinSignal;
  const std::vector<FoundStar> points = find_stars(picture.rate, finder, picture.usable);
  std::vector<double> dx, dy;
  std::vector<const FoundStar*> own(stars.size(), nullptr);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    double nearest = kFarthest_px;
    for (const FoundStar& point : points) {
      const double away = std::hypot(point.x_px - stars[i].x_px, point.y_px - stars[i].y_px);
      if (away >= nearest) continue;
      nearest = away;
      own[i] = &point;
    }
    if (own[i] == nullptr) continue;
    dx.push_back(own[i]->x_px - stars[i].x_px);
    dy.push_back(own[i]->y_px - stars[i].y_px);
  }
  const double shift_x = sim::median(dx), shift_y = sim::median(dy);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    stars[i].x_px = own[i] != nullptr ? own[i]->x_px : stars[i].x_px + shift_x;
    stars[i].y_px = own[i] != nullptr ? own[i]->y_px : stars[i].y_px + shift_y;
  }
}

/// True if the stars can determine the extinction: there are enough of them, over a range of 0.7 airmasses.
bool tell_extinction(const std::vector<FactorDatum>& data) {
  constexpr std::size_t kMinStars = 10;
  constexpr double kMinSpan = 0.7;
  if (data.size() < kMinStars) return false;
  const auto ends =
      std::minmax_element(data.begin(), data.end(),
                          [](const FactorDatum& a, const FactorDatum& b) { return a.airmass < b.airmass; });
  return ends.second->airmass - ends.first->airmass >= kMinSpan;
}

}  // namespace

double relative_airmass(double elevation_deg) {
  return 1.0 / (std::sin(elevation_deg * sim::kRadiansPerDegree) +
                0.50572 * std::pow(std::max(elevation_deg, 0.0) + 6.07995, -1.6364));
}

StarPhotometer::StarPhotometer(const sim::Scene& scene, const FilterBand& band,
                               const StarPhotometrySettings& settings)
    : scene_(scene), band_(band), settings_(settings) {}

void StarPhotometer::add(const CountPicture& picture, double julian_date) {
  const std::vector<PlacedStar> all = placed_stars(scene_, julian_date, settings_);
  std::vector<PlacedStar> stars;
  for (const PlacedStar& one : all)
    if (one.star->magnitude <= settings_.faintest && one.elevation_deg >= settings_.min_elevation_deg &&
        one.star->colour_index >= sim::kBluestStar && one.star->colour_index <= sim::kReddestStar &&
        !is_disturbed(one, all, settings_.aperture))
      stars.push_back(one);
  move_to_points(stars, picture);
  const sim::Lens<double> lens = sim::camera_view(scene_.camera).lens;
  Aperture wider = settings_.aperture;
  constexpr double kWider = 1.5;
  wider.radius_px *= kWider;
  wider.gap_px = std::max(0.0, settings_.aperture.radius_px + settings_.aperture.gap_px - wider.radius_px);
  for (const PlacedStar& one : stars) {
    const std::vector<Neighbour> neighbours = neighbours_of(one, all, settings_.aperture);
    const double steradians = sim::pixel_steradians(lens, one.x_px, one.y_px);
    const std::optional<ApertureLight> light =
        aperture_light(picture, one.x_px, one.y_px, settings_.aperture, neighbours);
    if (!light || !(steradians > 0.0) || !(light->sigma > 0.0)) continue;
    const double photons = star_photons_in_band(band_, one.star->magnitude, one.star->colour_index);
    const double rayleighs = photons * kSquareCm / (sim::kPhotonsPerRayleigh_m2_s_sr * steradians);
    Sum& sum = sums_[one.star - sim::catalogue_stars().data()];
    if (sum.star.pictures == 0) {
      sum.star.name = one.star->label();
      sum.star.magnitude = one.star->magnitude;
      sum.star.colour_index = one.star->colour_index;
      sum.star.x_px = one.x_px;
      sum.star.y_px = one.y_px;
    }
    ++sum.star.pictures;
    sum.star.elevation_deg += one.elevation_deg;
    sum.star.airmass += relative_airmass(one.elevation_deg);
    sum.star.rate += light->rate;
    sum.star.rate_error += light->sigma * light->sigma;
    sum.star.rayleighs += rayleighs;
    sum.ratio += light->rate / rayleighs;
    sum.ratio_variance += light->sigma * light->sigma / (rayleighs * rayleighs);
    constexpr double kBright = 50.0;
    if (is_disturbed(one, all, wider)) continue;
    if (const auto more = aperture_light(picture, one.x_px, one.y_px, wider, neighbours);
        more && light->rate > kBright * light->sigma) {
      sum.outside += more->rate / light->rate - 1.0;
      ++sum.with_outside;
    }
  }
}

void StarPhotometer::take_means(Sum& sum) {
  MeasuredStar& star = sum.star;
  const double count = star.pictures;
  star.airmass = (star.airmass - 1.0) / count;  // it began at 1
  star.elevation_deg /= count;
  star.rate /= count;
  star.rate_error = std::sqrt(star.rate_error) / count;
  star.rayleighs /= count;
  sum.ratio /= count;
  sum.ratio_variance /= count * count;
}

StarFactor StarPhotometer::answer(const std::string& name) const {
  std::vector<Sum> stars;
  for (const auto& [star, sum] : sums_) {
    stars.push_back(sum);
    take_means(stars.back());
  }
  std::stable_sort(stars.begin(), stars.end(),
                   [](const Sum& a, const Sum& b) { return a.star.magnitude < b.star.magnitude; });
  std::vector<FactorDatum> data;
  for (const Sum& sum : stars) data.push_back({sum.ratio, std::sqrt(sum.ratio_variance), sum.star.airmass});

  StarFactor answer;
  answer.extinction = settings_.extinction;
  if (answer.extinction == ExtinctionBy::choice)
    answer.extinction = tell_extinction(data) ? ExtinctionBy::stars : ExtinctionBy::air;
  const double middle_nm = middle_of_band_nm(band_);
  std::optional<double> depth;
  if (answer.extinction == ExtinctionBy::number)
    depth = settings_.magnitudes_per_airmass / kMagnitudesPerDepth;
  if (answer.extinction == ExtinctionBy::air) {
    // The air's own transmission at each star's elevation, as so many airmasses of depth 1.
    sim::Scene with_air = scene_;
    with_air.air.model = sim::AirModel::standard;
    for (std::size_t i = 0; i < data.size(); ++i)
      data[i].airmass = -std::log(sim::air_transmission(with_air, middle_nm, stars[i].star.elevation_deg));
    depth = 1.0;
  }
  const std::optional<FactorFit> fit = fit_factor(data, depth);
  if (!fit)
    throw sim::unreadable(
        name, fmt::format("{} stars of the catalogue could be measured in it, which agree on nothing",
                          stars.size()))
        .expected("six or more")
        .hint("look at --stars-out, the camera, or a longer exposure; --catalogue-magnitude");

  answer.degrees_of_freedom = fit->degrees_of_freedom;
  answer.star_error = fit->ln_factor_error * student_68(fit->degrees_of_freedom);
  answer.spectrum_error = sim::star_flux_error(middle_nm);
  answer.width_error = band_.width_error;
  answer.scatter = fit->scatter;
  answer.factor.value = std::exp(fit->ln_factor);
  answer.factor.error = answer.factor.value * std::sqrt(answer.star_error * answer.star_error +
                                                        answer.spectrum_error * answer.spectrum_error +
                                                        answer.width_error * answer.width_error);
  double depths = 0.0, airmasses = 0.0;
  std::vector<double> outside;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    MeasuredStar& star = stars[i].star;
    star.used = fit->used[i] != 0;
    star.factor = std::exp(-fit->depth * data[i].airmass) / stars[i].ratio;
    depths += fit->depth * data[i].airmass;
    airmasses += star.airmass;
    if (stars[i].with_outside > 0) outside.push_back(stars[i].outside / stars[i].with_outside);
    answer.stars.push_back(star);
  }
  answer.magnitudes_per_airmass = kMagnitudesPerDepth * depths / airmasses;
  if (answer.extinction == ExtinctionBy::stars)
    answer.extinction_error = kMagnitudesPerDepth * fit->depth_error * student_68(fit->degrees_of_freedom);
  // The value of one or two stars may be noise.
  constexpr std::size_t kEnoughBright = 3;
  if (outside.size() >= kEnoughBright) answer.light_outside = sim::median(outside);
  constexpr double kMuchOutside = 0.03;
  if (answer.light_outside > kMuchOutside)
    answer.notes.push_back(
        fmt::format("a circle wider by half has {:.0f} % more of the bright stars' light: the "
                    "factor is too large by that; try a larger --aperture",
                    100.0 * answer.light_outside));
  if (answer.extinction == ExtinctionBy::stars && fit->depth < -2.0 * fit->depth_error)
    answer.notes.emplace_back(
        "the extinction that was found is below nothing: clouds, or a flat field that is none");
  return answer;
}

}  // namespace vegard::fit
