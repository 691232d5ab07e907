#include "sim/view/sensor/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/parallel.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/sensor/filmic_tone.h"

namespace vegard::sim {
namespace {

/// Returns y at x of straight lines through points with increasing x, which is limited to theirs.
double straight_between(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  if (!(x > xs.front())) return ys.front();
  if (x >= xs.back()) return ys.back();
  const std::size_t i = std::upper_bound(xs.begin(), xs.end(), x) - xs.begin();
  return ys[i - 1] + (ys[i] - ys[i - 1]) * ((x - xs[i - 1]) / (xs[i] - xs[i - 1]));
}

// The standard's rounded constants leave a step of 1e-8 where line and power meet. The power meets the line
// of slope 12.92 at this encoded value and its twelfth; cutting both directions at the same place keeps them
// inverse to each other.
constexpr double kEncodedKnee = 0.04045;
constexpr double kLinearKnee = kEncodedKnee / 12.92;

constexpr double kAtWhite = 2.4 / 1.055;  // d ln D / d v there
constexpr int kBentMaxHalvings = 200;     // far more than a double has bits
constexpr double kBentCloseEnough = 1e-13;

/// Returns d ln D / d v of sRGB's decoding.
double srgb_log_slope(double encoded) {
  return encoded <= kEncodedKnee ? 1.0 / encoded : 2.4 / (encoded + 0.055);
}

int number_of(const ToneCurve& tone, float light) {
  const auto encoded = static_cast<float>(tone.encode(std::clamp<double>(light, 0.0, 1.0)));
  return static_cast<int>(std::lround(std::clamp(static_cast<double>(encoded), 0.0, 1.0) * 255.0));
}

}  // namespace

ToneCurve::ToneCurve(const Scene& scene) {
  const Sensor& sensor = scene.sensor;
  switch (sensor.tone) {
    case ToneKind::srgb:
      kind_ = Kind::srgb, name_ = "sRGB";
      break;
    case ToneKind::linear:
      kind_ = Kind::linear, name_ = "linear";
      break;
    case ToneKind::gamma:
      be_gamma(sensor.gamma);
      break;
    case ToneKind::file:
      be_table(table_text(scene, "sensor.tone_file"), sensor.tone_file);
      break;
    case ToneKind::filmic:
      *this = filmic();
      break;
  }
}

ToneCurve ToneCurve::of_gamma(double gamma) {
  ToneCurve curve;
  curve.be_gamma(gamma);
  return curve;
}

ToneCurve ToneCurve::of_table(const std::string& text, const std::string& file) {
  ToneCurve curve;
  curve.be_table(text, file);
  return curve;
}

ToneCurve ToneCurve::filmic() {
  ToneCurve curve;
  curve.kind_ = Kind::filmic, curve.name_ = "filmic";
  return curve;
}

ToneCurve ToneCurve::of_bent(const BentSrgb& bent) {
  ToneCurve curve;
  curve.kind_ = Kind::bent;
  curve.bent_ = bent;
  std::ostringstream text;
  text << "sRGB^" << bent.black;
  if (bent.white != bent.black) text << " to " << bent.white;
  curve.name_ = text.str();
  return curve;
}

void ToneCurve::be_gamma(double gamma) {
  kind_ = Kind::gamma, gamma_ = gamma;
  std::ostringstream text;
  text << "gamma " << gamma_;
  name_ = text.str();
}

void ToneCurve::be_table(const std::string& text, const std::string& file) {
  kind_ = Kind::file, name_ = file.substr(file.rfind('/') + 1);
  const CsvTable table = read_csv_table(text, file);
  const auto bad_curve = [&](const std::string& problem) {
    return unreadable(file, problem)
        .line(table.lines.front())
        .key("linear")
        .expected("rows from linear 0 to linear 1");
  };
  if (table.column("linear").size() < 2) throw bad_curve("one row is no curve");
  table.require_increasing("linear");
  table.require_increasing("encoded");
  table.require_within("linear", 0.0, 1.0);
  table.require_within("encoded", 0.0, 1.0);
  linear_ = table.column("linear"), encoded_ = table.column("encoded");
  if (linear_.front() != 0.0 || linear_.back() != 1.0)
    throw bad_curve("the curve does not run from black to white");
}

double ToneCurve::encode(double linear) const {
  switch (kind_) {
    case Kind::srgb:
      return srgb_encode(linear);
    case Kind::gamma:
      return std::copysign(std::pow(std::abs(linear), 1.0 / gamma_), linear);
    case Kind::file:
      return straight_between(linear_, encoded_, linear);
    case Kind::bent:
      return bent_.encode(linear);
    case Kind::filmic:
      return srgb_encode(filmic_roll_off(linear));
    case Kind::linear:
      break;
  }
  return linear;
}

double ToneCurve::decode(double encoded) const {
  switch (kind_) {
    case Kind::srgb:
      return srgb_decode(encoded);
    case Kind::gamma:
      return std::copysign(std::pow(std::abs(encoded), gamma_), encoded);
    case Kind::file:
      return straight_between(encoded_, linear_, encoded);
    case Kind::bent:
      return bent_.decode(encoded);
    case Kind::filmic:
      return filmic_light(srgb_decode(encoded));
    case Kind::linear:
      break;
  }
  return encoded;
}

double srgb_encode(double linear) {
  const double size = std::abs(linear);
  const double encoded = size <= kLinearKnee ? 12.92 * size : 1.055 * std::pow(size, 1.0 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

double srgb_decode(double encoded) {
  const double size = std::abs(encoded);
  const double linear = size <= kEncodedKnee ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

double BentSrgb::decode(double encoded) const {
  const double size = std::abs(encoded);
  const double light =
      std::pow(srgb_decode(size), black) * std::exp((white - black) * kAtWhite * (size - 1.0));
  return std::copysign(light, encoded);
}

double BentSrgb::slope(double encoded) const {
  return decode(encoded) * (black * srgb_log_slope(encoded) + (white - black) * kAtWhite);
}

double BentSrgb::encode(double linear) const {
  const double light = std::abs(linear);
  if (!(light > 0.0)) return linear;
  if (black == white) return std::copysign(srgb_encode(std::pow(light, 1.0 / black)), linear);
  // Newton's steps in the logarithm of the light, kept between brackets that close.
  double low = 0.0, high = 1.0;
  while (decode(high) < light && high < 1e6) high *= 2.0;
  double v = std::min(high, srgb_encode(std::pow(light, 2.0 / (black + white))));
  for (int i = 0; i < kBentMaxHalvings && high - low > kBentCloseEnough * high; ++i) {
    const double here = decode(v);
    (here < light ? low : high) = v;
    double next = here > 0.0 ? v - std::log(here / light) * here / slope(v) : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - v) <= kBentCloseEnough * v) return std::copysign(next, linear);
    v = next;
  }
  return std::copysign(v, linear);
}

DisplayTable::DisplayTable(const ToneCurve& tone) : white_(static_cast<std::uint8_t>(number_of(tone, 1.0f))) {
  first_.fill(std::numeric_limits<float>::infinity());
  first_[0] = 0.0f;
  for (int number = 1; number <= white_; ++number) {
    // The curve increases, so that halving finds the least float.
    float below = 0.0f, at_least = 1.0f;
    if (number_of(tone, 0.0f) >= number) at_least = 0.0f;
    while (std::nextafter(below, 1.0f) < at_least) {
      const float middle = 0.5f * (below + at_least);
      (number_of(tone, middle) >= number ? at_least : below) = middle;
    }
    first_[number] = at_least;
  }
  for (int cell = 0, number = 0; cell < kCells; ++cell) {
    const float light = static_cast<float>(cell) / kCells;
    while (light >= first_[number + 1]) ++number;
    least_[cell] = static_cast<std::uint8_t>(number);
  }
}

std::vector<std::uint8_t> DisplayTable::bytes(const Image& light, int threads) const {
  std::vector<std::uint8_t> all(light.data.size());
  const std::size_t of_row = static_cast<std::size_t>(light.width) * light.channels();
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    for (std::size_t i = row * of_row; i < (row + 1) * of_row; ++i) all[i] = (*this)(light.data[i]);
  });
  return all;
}

}  // namespace vegard::sim
