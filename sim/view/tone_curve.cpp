#include "sim/view/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/base/csv_table.h"
#include "sim/base/error.h"
#include "sim/scene/table_files.h"
#include "sim/view/transfer_curve.h"

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
  if (sensor.tone == "srgb") {
    kind_ = Kind::srgb, name_ = "sRGB";
  } else if (sensor.tone == "linear") {
    kind_ = Kind::linear, name_ = "linear";
  } else if (sensor.tone == "gamma") {
    kind_ = Kind::gamma, gamma_ = sensor.gamma;
    std::ostringstream text;
    text << "gamma " << gamma_;
    name_ = text.str();
  } else {
    kind_ = Kind::file, name_ = sensor.tone_file.substr(sensor.tone_file.rfind('/') + 1);
    const CsvTable table = read_csv_table(table_text(scene, "sensor.tone_file"), sensor.tone_file);
    table.require_increasing("linear");
    table.require_increasing("encoded");
    table.require_within("encoded", 0.0, 1.0);
    linear_ = table.column("linear"), encoded_ = table.column("encoded");
    if (table.rows() < 2 || linear_.front() != 0.0 || linear_.back() != 1.0) {
      ErrorDetails details;
      details.file = sensor.tone_file;
      details.line = table.lines.front();
      details.key = "linear";
      details.problem = "the curve does not run from black to white";
      details.expected = "rows from linear 0 to linear 1";
      throw Error(ErrorKind::unreadable_input, details);
    }
  }
}

double ToneCurve::encode(double linear) const {
  switch (kind_) {
    case Kind::srgb:
      return srgb_encode(linear);
    case Kind::gamma:
      return std::copysign(std::pow(std::abs(linear), 1.0 / gamma_), linear);
    case Kind::file:
      return straight_between(linear_, encoded_, linear);
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
    case Kind::linear:
      break;
  }
  return encoded;
}

}  // namespace vegard::sim
