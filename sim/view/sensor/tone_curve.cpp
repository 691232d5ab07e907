#include "sim/view/sensor/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::sim {
namespace {

/// y at x of straight lines through points with increasing x, which is limited to theirs.
double straight_between(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  if (!(x > xs.front())) return ys.front();
  if (x >= xs.back()) return ys.back();
  const std::size_t i = std::upper_bound(xs.begin(), xs.end(), x) - xs.begin();
  return ys[i - 1] + (ys[i] - ys[i - 1]) * ((x - xs[i - 1]) / (xs[i] - xs[i - 1]));
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
  const auto refuse = [&](const std::string& problem) {
    ErrorDetails details;
    details.file = file;
    details.line = table.lines.front();
    details.key = "linear";
    details.problem = problem;
    details.expected = "rows from linear 0 to linear 1";
    throw Error(ErrorKind::unreadable_input, details);
  };
  if (table.column("linear").size() < 2) refuse("one row is no curve");
  table.require_increasing("linear");
  table.require_increasing("encoded");
  table.require_within("linear", 0.0, 1.0);
  table.require_within("encoded", 0.0, 1.0);
  linear_ = table.column("linear"), encoded_ = table.column("encoded");
  if (linear_.front() != 0.0 || linear_.back() != 1.0) refuse("the curve does not run from black to white");
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
    case Kind::linear:
      break;
  }
  return encoded;
}

}  // namespace vegard::sim
