#include "fit/photo/pointing/exchange/sip_wcs.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/version.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kMaxSipOrder = 9;
constexpr double kGoodSip_px = 0.02;
constexpr int kSipGridAcross = 48;

Eigen::Vector3d vector_of(const sim::Equatorial& place) {
  const double ra = place.right_ascension_deg * sim::kRadiansPerDegree,
               dec = place.declination_deg * sim::kRadiansPerDegree;
  return {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
}

sim::Equatorial place_of_vector(const Eigen::Vector3d& v) {
  constexpr double kTurn_deg = 360.0;
  const double ra = std::atan2(v.y(), v.x()) / sim::kRadiansPerDegree;
  return {ra < 0.0 ? ra + kTurn_deg : ra,
          std::atan2(v.z(), std::hypot(v.x(), v.y())) / sim::kRadiansPerDegree};
}

/// Columns: to the east and to the north of a place on the sky, and the place itself.
Eigen::Matrix3d tangent_frame(const sim::Equatorial& reference) {
  const double ra = reference.right_ascension_deg * sim::kRadiansPerDegree;
  Eigen::Matrix3d frame;
  frame.col(0) << -std::sin(ra), std::cos(ra), 0.0;
  frame.col(2) = vector_of(reference);
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

Eigen::Vector3d from_plane(const Eigen::Matrix3d& frame, const Eigen::Vector2d& plane_deg) {
  return (frame.col(2) +
          sim::kRadiansPerDegree * (plane_deg.x() * frame.col(0) + plane_deg.y() * frame.col(1)))
      .normalized();
}

/// The keywords of a header, with the errors about them.
class WcsHeader {
 public:
  WcsHeader(std::string_view bytes, const std::string& file)
      : file_(file), keywords_(sim::read_fits_header(bytes, file)) {}

  sim::Error bad_header(const std::string& problem) const {
    return sim::unreadable(file_, problem).expected("the .wcs file of solve-field");
  }
  std::string text(const std::string& key) const {
    const auto found = keywords_.find(key);
    return found == keywords_.end() ? std::string() : found->second;
  }
  double number(const std::string& key) const {
    const auto value = number_or_none(key);
    if (!value) throw bad_header(text(key).empty() ? "there is no " + key : key + " is '" + text(key) + "'");
    return *value;
  }
  double number(const std::string& key, double if_absent) const {
    return text(key).empty() ? if_absent : number(key);
  }

 private:
  std::optional<double> number_or_none(const std::string& key) const {
    std::string words = text(key);
    std::replace(words.begin(), words.end(), 'D', 'E');  // as Fortran has it
    if (!words.empty() && words[0] == '+') words.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), value);
    if (error != std::errc() || end != words.data() + words.size() || !std::isfinite(value))
      return std::nullopt;
    return value;
  }

  std::string file_;
  sim::FitsKeywords keywords_;
};

SipPolynomial polynomial_of(const WcsHeader& header, const std::string& name) {
  SipPolynomial made;
  const double order = header.number(name + "_ORDER", 0.0);
  if (order != std::floor(order) || order < 0.0 || order > kMaxSipOrder)
    throw header.bad_header(name + "_ORDER is " + header.text(name + "_ORDER"))
        .hint("orders up to 9 are read");
  made.order = static_cast<int>(order);
  if (made.order == 0) return made;
  for (int p = 0; p <= made.order; ++p)
    for (int q = 0; q <= made.order; ++q)
      made.terms.push_back(p + q <= made.order
                               ? header.number(name + "_" + std::to_string(p) + "_" + std::to_string(q), 0.0)
                               : 0.0);
  return made;
}

int size_in(const WcsHeader& header, const char* key, const char* of_image) {
  const double size = header.number(key, header.number(of_image, 0.0));
  if (size != std::floor(size) || size < 0.0 || size > sim::longest_side_px)
    throw header.bad_header(std::string(key) + " is " + header.text(key));
  return static_cast<int>(size);
}

/// A place of the picture, and where it looks on the sky.
struct SipPoint {
  double x_px = 0.0, y_px = 0.0;
  Eigen::Vector3d sky;
};

/// All u^p v^q with p + q from `lowest` to `order`.
std::vector<std::pair<int, int>> powers(int lowest, int order) {
  std::vector<std::pair<int, int>> all;
  for (int sum = lowest; sum <= order; ++sum)
    for (int p = 0; p <= sum; ++p) all.emplace_back(p, sum - p);
  return all;
}

/// Least squares of two polynomials of u, v; variables are scaled to 1 first.
std::array<SipPolynomial, 2> fitted(const std::vector<Eigen::Vector2d>& at,
                                    const std::vector<Eigen::Vector2d>& values, int order) {
  double scale = 1.0;
  for (const Eigen::Vector2d& p : at) scale = std::max({scale, std::abs(p.x()), std::abs(p.y())});
  const std::vector<std::pair<int, int>> terms = powers(0, order);
  Eigen::MatrixXd rows(at.size(), terms.size());
  Eigen::MatrixXd right(at.size(), 2);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t t = 0; t < terms.size(); ++t)
      rows(i, t) = std::pow(at[i].x() / scale, terms[t].first) * std::pow(at[i].y() / scale, terms[t].second);
    right.row(i) = values[i].transpose();
  }
  const Eigen::MatrixXd solved = sim::least_squares(rows, right);
  std::array<SipPolynomial, 2> made;
  for (int k = 0; k < 2; ++k) {
    made[k].order = order;
    made[k].terms.assign(static_cast<std::size_t>((order + 1) * (order + 1)), 0.0);
    for (std::size_t t = 0; t < terms.size(); ++t)
      made[k].terms[static_cast<std::size_t>(terms[t].first * (order + 1) + terms[t].second)] =
          solved(t, k) / std::pow(scale, terms[t].first + terms[t].second);
  }
  return made;
}

double term(const SipPolynomial& polynomial, int p, int q) {
  return polynomial.terms[static_cast<std::size_t>(p * (polynomial.order + 1) + q)];
}

/// The solution of one order about a place of the picture.
SipWcs solved_of_order(const std::vector<SipPoint>& points, const Eigen::Vector2d& middle_px,
                       const Eigen::Vector3d& middle_sky, int order) {
  SipWcs wcs;
  wcs.reference_px = middle_px.array() + 0.5;
  wcs.reference = place_of_vector(middle_sky);
  std::vector<Eigen::Vector2d> at;
  for (const SipPoint& p : points) at.emplace_back(p.x_px - middle_px.x(), p.y_px - middle_px.y());
  std::array<SipPolynomial, 2> plane;
  // The polynomials have no constant term: the reference moves to where it is 0.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Matrix3d frame = tangent_frame(wcs.reference);
    std::vector<Eigen::Vector2d> values;
    for (const SipPoint& p : points) {
      const Eigen::Vector3d own = frame.transpose() * p.sky;
      values.emplace_back(own.x() / own.z() / sim::kRadiansPerDegree,
                          own.y() / own.z() / sim::kRadiansPerDegree);
    }
    plane = fitted(at, values, order);
    if (round + 1 < kRounds)
      wcs.reference = place_of_vector(from_plane(frame, {term(plane[0], 0, 0), term(plane[1], 0, 0)}));
  }
  wcs.degrees_per_px << term(plane[0], 1, 0), term(plane[0], 0, 1), term(plane[1], 1, 0),
      term(plane[1], 0, 1);
  const Eigen::Matrix2d px_per_degree = wcs.degrees_per_px.inverse();
  wcs.a.order = wcs.b.order = order;
  wcs.a.terms.assign(plane[0].terms.size(), 0.0);
  wcs.b.terms = wcs.a.terms;
  for (const auto& [p, q] : powers(2, order)) {
    const Eigen::Vector2d both = px_per_degree * Eigen::Vector2d(term(plane[0], p, q), term(plane[1], p, q));
    const auto i = static_cast<std::size_t>(p * (order + 1) + q);
    wcs.a.terms[i] = both.x();
    wcs.b.terms[i] = both.y();
  }
  // And back: from the plane in pixels to the picture.
  std::vector<Eigen::Vector2d> from, to;
  for (const Eigen::Vector2d& p : at) {
    from.emplace_back(p.x() + wcs.a.at(p.x(), p.y()), p.y() + wcs.b.at(p.x(), p.y()));
    to.push_back(p - from.back());
  }
  const std::array<SipPolynomial, 2> back = fitted(from, to, order);
  wcs.ap = back[0];
  wcs.bp = back[1];
  return wcs;
}

/// Computes the direction of a place of the picture, on the sky; false if it has none, or is below the
/// horizon.
bool sky_of_camera(const sim::Camera& camera, const sim::Observer& observer, double julian_date, double x_px,
                   double y_px, Eigen::Vector3d& sky) {
  const sim::Direction direction = sim::direction_of_pixel(camera, x_px, y_px);
  if (!std::isfinite(direction.elevation_deg) ||
      direction.elevation_deg <= sim::horizon_elevation_deg(observer))
    return false;
  Eigen::Vector3d enu;
  sim::enu_of_direction(direction, enu.data());
  sky = j2000_of_direction(enu, observer, julian_date);
  return true;
}

void measure_sip(const std::vector<SipPoint>& points, SipFit& fit) {
  double sum = 0.0;
  constexpr double kHalfPixel = 0.5;
  for (const SipPoint& p : points) {
    const Eigen::Vector3d at = sky_of_pixel(fit.wcs, p.x_px, p.y_px);
    // The size of a pixel on the sky, along rows and columns.
    const double across = (sky_of_pixel(fit.wcs, p.x_px + kHalfPixel, p.y_px) -
                           sky_of_pixel(fit.wcs, p.x_px - kHalfPixel, p.y_px))
                              .norm(),
                 down = (sky_of_pixel(fit.wcs, p.x_px, p.y_px + kHalfPixel) -
                         sky_of_pixel(fit.wcs, p.x_px, p.y_px - kHalfPixel))
                            .norm();
    const double off_px = (at - p.sky).norm() / std::min(across, down);
    sum += off_px * off_px;
    fit.largest_px = std::max(fit.largest_px, off_px);
  }
  fit.points = static_cast<int>(points.size());
  fit.rms_px = std::sqrt(sum / static_cast<double>(points.size()));
}

void add_terms(const SipPolynomial& polynomial, const std::string& name, int lowest,
               std::vector<sim::FitsKeyword>& keywords) {
  keywords.push_back({name + "_ORDER", static_cast<double>(polynomial.order), ""});
  for (const auto& [p, q] : powers(lowest, polynomial.order))
    keywords.push_back(
        {name + "_" + std::to_string(p) + "_" + std::to_string(q), term(polynomial, p, q), ""});
}

}  // namespace

double SipPolynomial::at(double u, double v) const {
  if (terms.empty()) return 0.0;
  double sum = 0.0;
  for (int p = order; p >= 0; --p) {
    double in_v = 0.0;
    for (int q = order; q >= 0; --q) in_v = in_v * v + terms[static_cast<std::size_t>(p * (order + 1) + q)];
    sum = sum * u + in_v;
  }
  return sum;
}

Eigen::Vector3d sky_of_pixel(const SipWcs& wcs, double x_px, double y_px) {
  const double u = x_px + 0.5 - wcs.reference_px.x(), v = y_px + 0.5 - wcs.reference_px.y();
  return from_plane(tangent_frame(wcs.reference),
                    wcs.degrees_per_px * Eigen::Vector2d(u + wcs.a.at(u, v), v + wcs.b.at(u, v)));
}

SipWcs read_sip_wcs(std::string_view bytes, const std::string& file) {
  const WcsHeader header(bytes, file);
  const std::string first = header.text("CTYPE1"), second = header.text("CTYPE2");
  if (first.empty())
    throw header.bad_header("there is no solution in this FITS header").hint("was the field solved?");
  if ((first != "RA---TAN" && first != "RA---TAN-SIP") || (second != "DEC--TAN" && second != "DEC--TAN-SIP"))
    throw header.bad_header("its axes are " + first + " and " + second)
        .hint("RA---TAN-SIP and DEC--TAN-SIP are read");
  if (header.number("EQUINOX", 2000.0) != 2000.0)
    throw header.bad_header("its equinox is " + header.text("EQUINOX")).hint("2000 is read");
  SipWcs wcs;
  wcs.width_px = size_in(header, "IMAGEW", "NAXIS1");
  wcs.height_px = size_in(header, "IMAGEH", "NAXIS2");
  wcs.reference_px << header.number("CRPIX1"), header.number("CRPIX2");
  wcs.reference = {header.number("CRVAL1"), header.number("CRVAL2")};
  if (std::abs(wcs.reference.declination_deg) > 90.0)
    throw header.bad_header("CRVAL2 is " + header.text("CRVAL2"));
  wcs.degrees_per_px << header.number("CD1_1"), header.number("CD1_2"), header.number("CD2_1"),
      header.number("CD2_2");
  if (!(std::abs(wcs.degrees_per_px.determinant()) > 1e-20)) throw header.bad_header("its CD matrix is none");
  wcs.a = polynomial_of(header, "A");
  wcs.b = polynomial_of(header, "B");
  wcs.ap = polynomial_of(header, "AP");
  wcs.bp = polynomial_of(header, "BP");
  return wcs;
}

std::string encode_sip_wcs(const SipWcs& wcs, const std::string& words, const std::string& name) {
  std::vector<sim::FitsKeyword> keywords = {
      {"WCSAXES", 2.0, ""},
      {"CTYPE1", "RA---TAN-SIP", "tangent plane with SIP polynomials"},
      {"CTYPE2", "DEC--TAN-SIP", "tangent plane with SIP polynomials"},
      {"EQUINOX", 2000.0, ""},
      {"LONPOLE", 180.0, ""},
      {"LATPOLE", 0.0, ""},
      {"CRVAL1", wcs.reference.right_ascension_deg, "right ascension of the reference point"},
      {"CRVAL2", wcs.reference.declination_deg, "declination of the reference point"},
      {"CRPIX1", wcs.reference_px.x(), "its column, the first pixel's centre at 1"},
      {"CRPIX2", wcs.reference_px.y(), "its row, from the top of the picture"},
      {"CUNIT1", "deg", ""},
      {"CUNIT2", "deg", ""},
      {"CD1_1", wcs.degrees_per_px(0, 0), ""},
      {"CD1_2", wcs.degrees_per_px(0, 1), ""},
      {"CD2_1", wcs.degrees_per_px(1, 0), ""},
      {"CD2_2", wcs.degrees_per_px(1, 1), ""},
      {"IMAGEW", static_cast<double>(wcs.width_px), "width of the picture"},
      {"IMAGEH", static_cast<double>(wcs.height_px), "height of the picture"}};
  add_terms(wcs.a, "A", 2, keywords);
  add_terms(wcs.b, "B", 2, keywords);
  add_terms(wcs.ap, "AP", 0, keywords);
  add_terms(wcs.bp, "BP", 0, keywords);
  keywords.push_back({"VEGARD", words, ""});
  keywords.push_back({"ORIGIN", "vegard " + sim::version(), ""});
  return sim::encode_fits_header(keywords, name);
}

sim::DirectionMap directions_of_wcs(const SipWcs& wcs, const sim::Observer& observer, double julian_date) {
  sim::DirectionMap map;
  map.width = wcs.width_px;
  map.height = wcs.height_px;
  const double horizon_deg = sim::horizon_elevation_deg(observer);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      sim::CataloguePlace place;
      place.j2000 = place_of_vector(sky_of_pixel(wcs, x + 0.5, y + 0.5));
      const std::array<double, 3> enu = sim::direction_of_star(place, observer, julian_date);
      const sim::Direction direction = sim::direction_of_enu(enu.data());
      const bool is_up = direction.elevation_deg > horizon_deg;
      map.azimuth_deg.push_back(static_cast<float>(is_up ? direction.azimuth_deg : sim::kNaN));
      map.elevation_deg.push_back(static_cast<float>(is_up ? direction.elevation_deg : sim::kNaN));
    }
  return map;
}

Eigen::Vector3d j2000_of_direction(const Eigen::Vector3d& enu, const sim::Observer& observer,
                                   double julian_date) {
  const auto seen = [&](const Eigen::Vector3d& sky, bool has_air) {
    sim::CataloguePlace place;
    place.j2000 = place_of_vector(sky);
    sim::Observer own = observer;
    own.refracting_air = has_air && observer.refracting_air;
    const std::array<double, 3> found = sim::direction_of_star(place, own, julian_date);
    return Eigen::Vector3d(found[0], found[1], found[2]);
  };
  // Without air and aberration it is a rotation.
  Eigen::Matrix3d turn;
  for (int i = 0; i < 3; ++i) turn.col(i) = seen(Eigen::Vector3d::Unit(i), false);
  Eigen::Vector3d sky = (turn.transpose() * enu).normalized();
  constexpr int kMaxRounds = 60;
  constexpr double kNear = 1e-12;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Eigen::Vector3d off = enu - seen(sky, true);
    sky = (sky + turn.transpose() * off).normalized();
    if (off.norm() < kNear) break;
  }
  return sky;
}

SipFit sip_of_camera(const sim::Camera& camera, const sim::Observer& observer, double julian_date,
                     double reach_deg) {
  const Eigen::Vector2d middle_px(0.5 * camera.width, 0.5 * camera.height);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const auto unseen = [](const std::string& problem) {
    return sim::Error(sim::ErrorKind::scene, problem)
        .key("camera")
        .expected("a picture of the sky")
        .hint("maps have all of it: -o MAPS.exr");
  };
  if (!sky_of_camera(camera, observer, julian_date, middle_px.x(), middle_px.y(), middle))
    throw unseen("the middle of the picture looks at nothing above the horizon");
  const double nearest = std::cos(reach_deg * sim::kRadiansPerDegree);
  std::vector<SipPoint> points;
  int places = 0;
  const double step =
      std::max(1.0, std::max(camera.width, camera.height) / static_cast<double>(kSipGridAcross));
  for (double y = 0.5 * step; y < camera.height; y += step)
    for (double x = 0.5 * step; x < camera.width; x += step) {
      ++places;
      SipPoint point{x, y, {}};
      if (sky_of_camera(camera, observer, julian_date, x, y, point.sky) && point.sky.dot(middle) >= nearest)
        points.push_back(point);
    }
  constexpr std::size_t kFewest = 120;  // twice the terms of the highest order
  if (points.size() < kFewest) throw unseen("too little of the picture looks above the horizon within reach");
  SipFit best;
  for (int order = 2; order <= kMaxSipOrder; ++order) {
    SipFit fit;
    fit.wcs = solved_of_order(points, middle_px, middle, order);
    measure_sip(points, fit);
    if (order == 2 || fit.rms_px < best.rms_px) best = fit;
    if (best.rms_px <= kGoodSip_px) break;
  }
  best.wcs.width_px = camera.width;
  best.wcs.height_px = camera.height;
  best.share = static_cast<double>(points.size()) / places;
  return best;
}

}  // namespace vegard::fit
