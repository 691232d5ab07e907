#include "fit/track/sgp4.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace sgp4 {

using sim::kTwoPi;

// WGS 72.
constexpr double kEarthKm = 6378.135, kMu = 398600.8;  // km^3 s^-2
constexpr double kJ2 = 0.001082616, kJ3 = -0.00000253881, kJ4 = -0.00000165597;
constexpr double kMinutesPerDay = 1440.0, kDeepMinutes = 225.0, kNearlyRound = 1e-4;

/// The square root of the gravity, in Earth radii and minutes.
double root_gravity() { return 60.0 / std::sqrt(kEarthKm * kEarthKm * kEarthKm / kMu); }

double cube(double x) { return x * x * x; }
double fourth(double x) { return x * x * x * x; }

/// Reads a field of a line, columns counted from 1.
class Line {
 public:
  Line(const std::string& text, const std::string& file, int number)
      : text_(text), file_(file), number_(number) {}

  std::string words(std::size_t first, std::size_t last) const {
    return std::string(sim::trimmed(text_.substr(first - 1, last - first + 1)));
  }

  double number(std::size_t first, std::size_t last, const char* prefix = "") const {
    std::string digits = words(first, last);
    bool is_negative = false;
    if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) {
      is_negative = digits.front() == '-';
      digits.erase(0, 1);
    }
    digits = prefix + std::string(sim::trimmed(digits));
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size())
      throw bad(fmt::format("columns {} to {} are no number", first, last));
    return is_negative ? -value : value;
  }

  /// A number such as -12345-3, which is -0.12345e-3.
  double with_exponent(std::size_t first, std::size_t last) const {
    const double mantissa = number(first, last - 2, "0."), exponent = number(last - 1, last);
    return mantissa * std::pow(10.0, exponent);
  }

  sim::Error bad(const std::string& problem) const {
    return sim::unreadable(file_, problem).line(number_).expected("two-line elements, 69 columns");
  }

  void check() const {
    constexpr std::size_t kColumns = 69;
    if (text_.size() < kColumns) throw bad(fmt::format("the line has {} columns", text_.size()));
    int sum = 0;
    for (std::size_t i = 0; i + 1 < kColumns; ++i) {
      if (text_[i] >= '0' && text_[i] <= '9') sum += text_[i] - '0';
      if (text_[i] == '-') ++sum;
    }
    if (text_[kColumns - 1] != '0' + sum % 10)
      throw bad(fmt::format("its checksum is {} and not {}", sum % 10, text_[kColumns - 1]));
  }

 private:
  std::string text_, file_;
  int number_;
};

double epoch_of(const Line& line) {
  constexpr double kCentury = 57.0, kDay_s = 86400.0;  // years of two digits begin in 1957
  const double digits = line.number(19, 20), day = line.number(21, 32);
  const int year = static_cast<int>(digits) + (digits < kCentury ? 2000 : 1900);
  const std::optional<double> start = sim::utc_seconds(std::to_string(year) + "-01-01T00:00:00Z");
  if (!start || !(day >= 1.0 && day < 367.0)) throw line.bad("its epoch is no day of a year");
  return *start + (day - 1.0) * kDay_s;
}

}  // namespace sgp4

std::vector<OrbitalElements> read_orbital_elements(const std::string& text, const std::string& name) {
  using sgp4::Line;
  std::vector<OrbitalElements> all;
  std::optional<Line> first;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    const bool is_first = line.rfind("1 ", 0) == 0, is_second = line.rfind("2 ", 0) == 0;
    if (!is_first && !is_second) continue;  // a name, a comment
    const Line here(line, name, number);
    here.check();
    if (is_first) {
      first = here;
      continue;
    }
    if (!first || first->words(3, 7) != here.words(3, 7))
      throw here.bad("there is no first line of this satellite before it");
    OrbitalElements of;
    of.satellite = here.words(3, 7);
    of.epoch_s = sgp4::epoch_of(*first);
    of.drag = first->with_exponent(54, 61);
    of.inclination_deg = here.number(9, 16);
    of.node_deg = here.number(18, 25);
    of.eccentricity = here.number(27, 33, "0.");
    of.perigee_deg = here.number(35, 42);
    of.anomaly_deg = here.number(44, 51);
    of.turns_per_day = here.number(53, 63);
    all.push_back(of);
    first.reset();
  }
  if (all.empty())
    throw sim::unreadable(name, "there are no elements in it")
        .expected("two-line elements: lines that begin with 1 and 2");
  return all;
}

Sgp4::Sgp4(const OrbitalElements& of, const std::string& name)
    : name_(name),
      drag_(of.drag),
      inclination_(of.inclination_deg * sim::kRadiansPerDegree),
      node_(of.node_deg * sim::kRadiansPerDegree),
      perigee_(of.perigee_deg * sim::kRadiansPerDegree),
      anomaly_(of.anomaly_deg * sim::kRadiansPerDegree),
      eccentricity_(of.eccentricity),
      motion_(of.turns_per_day * sim::kTwoPi / sgp4::kMinutesPerDay) {
  using namespace sgp4;
  if (!(motion_ > 0.0) || !(eccentricity_ >= 0.0 && eccentricity_ < 1.0))
    throw sim::unreadable(name, "its elements are those of no ellipse").expected("elements of an orbit");
  if (kTwoPi / motion_ >= kDeepMinutes)
    throw sim::unreadable(
        name, fmt::format("the satellite {} takes {:.0f} minutes for a turn", of.satellite, kTwoPi / motion_))
        .expected("an orbit of less than 225 minutes, near the Earth");

  // The mean motion and the axis without what J2 adds to them.
  const double e = eccentricity_, round = 1.0 - e * e, root = std::sqrt(round);
  const double cosine = std::cos(inclination_), sine = std::sin(inclination_), cosine2 = cosine * cosine;
  const double gravity = root_gravity();
  const double apparent = std::pow(gravity / motion_, 2.0 / 3.0);
  const double flattening = 0.75 * kJ2 * (3.0 * cosine2 - 1.0) / (root * round);
  double change = flattening / (apparent * apparent);
  const double better =
      apparent * (1.0 - change * change - change * (1.0 / 3.0 + 134.0 * change * change / 81.0));
  change = flattening / (better * better);
  motion_ /= 1.0 + change;
  axis_ = std::pow(gravity / motion_, 2.0 / 3.0);

  const double parameter = axis_ * round, by_parameter2 = 1.0 / (parameter * parameter);
  const double perigee_height_km = (axis_ * (1.0 - e) - 1.0) * kEarthKm;
  is_low_ = perigee_height_km < 220.0;
  // The density of the air falls with the fourth power of the height over this one.
  double floor_km = 78.0;
  if (perigee_height_km < 156.0) floor_km = perigee_height_km < 98.0 ? 20.0 : perigee_height_km - 78.0;
  const double thickness = fourth((120.0 - floor_km) / kEarthKm), floor = floor_km / kEarthKm + 1.0;

  by_cosine_ = 3.0 * cosine2 - 1.0;
  by_sine_square_ = 1.0 - cosine2;
  by_seven_cosine_ = 7.0 * cosine2 - 1.0;
  const double five_cosine = 1.0 - 5.0 * cosine2;
  const double xi = 1.0 / (axis_ - floor);
  eta_ = axis_ * e * xi;
  const double eta2 = eta_ * eta_, e_eta = e * eta_, psi = std::abs(1.0 - eta2);
  const double air = thickness * fourth(xi), air_psi = air / std::pow(psi, 3.5);
  const double c2 = air_psi * motion_ *
                    (axis_ * (1.0 + 1.5 * eta2 + e_eta * (4.0 + eta2)) +
                     0.375 * kJ2 * xi / psi * by_cosine_ * (8.0 + 3.0 * eta2 * (8.0 + eta2)));
  c1_ = drag_ * c2;
  const bool is_round = e <= kNearlyRound;
  const double c3 = is_round ? 0.0 : -2.0 * air * xi * kJ3 / kJ2 * motion_ * sine / e;
  c4_ = 2.0 * motion_ * air_psi * axis_ * round *
        (eta_ * (2.0 + 0.5 * eta2) + e * (0.5 + 2.0 * eta2) -
         kJ2 * xi / (axis_ * psi) *
             (-3.0 * by_cosine_ * (1.0 - 2.0 * e_eta + eta2 * (1.5 - 0.5 * e_eta)) +
              0.75 * by_sine_square_ * (2.0 * eta2 - e_eta * (1.0 + eta2)) * std::cos(2.0 * perigee_)));
  c5_ = 2.0 * air_psi * axis_ * round * (1.0 + 2.75 * (eta2 + e_eta) + e_eta * eta2);

  const double cosine4 = cosine2 * cosine2;
  const double first = 1.5 * kJ2 * by_parameter2 * motion_, second = 0.5 * first * kJ2 * by_parameter2,
               third = -0.46875 * kJ4 * by_parameter2 * by_parameter2 * motion_;
  anomaly_rate_ = motion_ + 0.5 * first * root * by_cosine_ +
                  0.0625 * second * root * (13.0 - 78.0 * cosine2 + 137.0 * cosine4);
  perigee_rate_ = -0.5 * first * five_cosine + 0.0625 * second * (7.0 - 114.0 * cosine2 + 395.0 * cosine4) +
                  third * (3.0 - 36.0 * cosine2 + 49.0 * cosine4);
  const double turning = -first * cosine;
  node_rate_ =
      turning + (0.5 * second * (4.0 - 19.0 * cosine2) + 2.0 * third * (3.0 - 7.0 * cosine2)) * cosine;
  perigee_drag_ = drag_ * c3 * std::cos(perigee_);
  anomaly_drag_ = is_round ? 0.0 : -2.0 / 3.0 * air * drag_ / e_eta;
  node_drag_ = 3.5 * round * turning * c1_;
  t2_ = 1.5 * c1_;
  constexpr double kAlmostNone = 1.5e-12;
  const double below = std::abs(1.0 + cosine) > kAlmostNone ? 1.0 + cosine : kAlmostNone;
  long_longitude_ = -0.25 * kJ3 / kJ2 * sine * (3.0 + 5.0 * cosine) / below;
  long_y_ = -0.5 * kJ3 / kJ2 * sine;
  anomaly_cube_ = cube(1.0 + eta_ * std::cos(anomaly_));
  anomaly_sine_ = std::sin(anomaly_);
  if (is_low_) return;
  const double c1_2 = c1_ * c1_;
  d2_ = 4.0 * axis_ * xi * c1_2;
  const double part = d2_ * xi * c1_ / 3.0;
  d3_ = (17.0 * axis_ + floor) * part;
  d4_ = 0.5 * part * axis_ * xi * (221.0 * axis_ + 31.0 * floor) * c1_;
  t3_ = d2_ + 2.0 * c1_2;
  t4_ = 0.25 * (3.0 * d3_ + c1_ * (12.0 * d2_ + 10.0 * c1_2));
  t5_ = 0.2 * (3.0 * d4_ + 12.0 * c1_ * d3_ + 6.0 * d2_ * d2_ + 15.0 * c1_2 * (2.0 * d2_ + c1_2));
}

OrbitState Sgp4::at(double t) const {
  using namespace sgp4;
  const auto no_orbit = [&](const char* problem) {
    return sim::unreadable(name_, fmt::format("{:.0f} minutes after its elements {}", t, problem))
        .expected("times near the epoch of the elements");
  };
  const double gravity = root_gravity();
  // Secular changes, by gravity and drag.
  const double straight = anomaly_ + anomaly_rate_ * t;
  double perigee = perigee_ + perigee_rate_ * t, anomaly = straight;
  const double t2 = t * t, node = node_ + node_rate_ * t + node_drag_ * t2;
  double shrunk = 1.0 - c1_ * t, rounded = drag_ * c4_ * t, ahead = t2_ * t2;
  if (!is_low_) {
    const double shift =
        perigee_drag_ * t + anomaly_drag_ * (cube(1.0 + eta_ * std::cos(straight)) - anomaly_cube_);
    anomaly += shift;
    perigee -= shift;
    const double t3 = t2 * t, t4 = t3 * t;
    shrunk -= d2_ * t2 + d3_ * t3 + d4_ * t4;
    rounded += drag_ * c5_ * (std::sin(anomaly) - anomaly_sine_);
    ahead += t3_ * t3 + t4 * (t4_ + t * t5_);
  }
  const double axis = axis_ * shrunk * shrunk, motion = gravity / std::pow(axis, 1.5);
  double e = eccentricity_ - rounded;
  if (!(e < 1.0) || e < -0.001 || !(axis > 0.0)) throw no_orbit("there is no ellipse any more");
  e = std::max(e, 1e-6);
  anomaly += motion_ * ahead;
  const double longitude = anomaly + perigee + node;

  // Long periods, and Kepler's equation.
  const double cosine = std::cos(inclination_), sine = std::sin(inclination_);
  const double by_axis = 1.0 / (axis * (1.0 - e * e));
  const double ex = e * std::cos(perigee), ey = e * std::sin(perigee) + by_axis * long_y_;
  const double u = std::remainder(longitude + by_axis * long_longitude_ * ex - node, kTwoPi);
  double eccentric = u;
  constexpr int kTurns = 10;
  constexpr double kLongestStep = 0.95, kShortestStep = 1e-12;
  for (int i = 0; i < kTurns; ++i) {
    const double s = std::sin(eccentric), c = std::cos(eccentric);
    const double step =
        std::clamp((u - ey * c + ex * s - eccentric) / (1.0 - c * ex - s * ey), -kLongestStep, kLongestStep);
    eccentric += step;
    if (std::abs(step) < kShortestStep) break;
  }
  const double s = std::sin(eccentric), c = std::cos(eccentric);
  const double e_cos = ex * c + ey * s, e_sin = ex * s - ey * c, e2 = ex * ex + ey * ey;
  const double parameter = axis * (1.0 - e2);
  if (!(parameter > 0.0)) throw no_orbit("there is no ellipse any more");
  const double r = axis * (1.0 - e_cos), r_rate = std::sqrt(axis) * e_sin / r,
               across = std::sqrt(parameter) / r, beta = std::sqrt(1.0 - e2), part = e_sin / (1.0 + beta);
  const double sin_u = axis / r * (s - ey - ex * part), cos_u = axis / r * (c - ex + ey * part);
  const double sin_2u = 2.0 * cos_u * sin_u, cos_2u = 1.0 - 2.0 * sin_u * sin_u;

  // Short periods.
  const double first = 0.5 * kJ2 / parameter, second = first / parameter;
  const double radius = r * (1.0 - 1.5 * second * beta * by_cosine_) + 0.5 * first * by_sine_square_ * cos_2u;
  const double angle = std::atan2(sin_u, cos_u) - 0.25 * second * by_seven_cosine_ * sin_2u;
  const double turned = node + 1.5 * second * cosine * sin_2u,
               tilt = inclination_ + 1.5 * second * cosine * sine * cos_2u;
  const double outwards = r_rate - motion * first * by_sine_square_ * sin_2u / gravity;
  const double onwards = across + motion * first * (by_sine_square_ * cos_2u + 1.5 * by_cosine_) / gravity;
  if (radius < 1.0) throw no_orbit("the satellite has come down");

  const double sin_a = std::sin(angle), cos_a = std::cos(angle), sin_n = std::sin(turned),
               cos_n = std::cos(turned), sin_i = std::sin(tilt), cos_i = std::cos(tilt);
  const std::array<double, 3> out = {-sin_n * cos_i * sin_a + cos_n * cos_a,
                                     cos_n * cos_i * sin_a + sin_n * cos_a, sin_i * sin_a};
  const std::array<double, 3> on = {-sin_n * cos_i * cos_a - cos_n * sin_a,
                                    cos_n * cos_i * cos_a - sin_n * sin_a, sin_i * cos_a};
  const double km_s = kEarthKm * gravity / 60.0;
  OrbitState state;
  for (std::size_t i = 0; i < 3; ++i) {
    state.km[i] = kEarthKm * radius * out[i];
    state.km_s[i] = km_s * (outwards * out[i] + onwards * on[i]);
  }
  return state;
}

}  // namespace vegard::fit
