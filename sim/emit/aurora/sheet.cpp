#include "sim/emit/aurora/sheet.h"

#include <cmath>

#include "sim/base/earth.h"
#include "sim/base/normal_quantile.h"
#include "sim/base/random.h"

namespace vegard::sim {
namespace {

/// Van der Corput's sequence in base 2: the bits of i mirrored at the point.
double van_der_corput(std::uint32_t i) {
  std::uint32_t bits = 0;
  for (int b = 0; b < 32; ++b) bits |= ((i >> b) & 1u) << (31 - b);
  return (static_cast<double>(bits) + 0.5) / 4294967296.0;
}

}  // namespace

StretchOfSheet stretch_of(const Sheet& sheet) {
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  return {sheet.center_km.east * std::sin(bearing) + sheet.center_km.north * std::cos(bearing),
          sheet.length_km};
}

std::vector<BeamPlace> beam_places(const Sheet& sheet, std::uint32_t sheet_index, std::uint32_t layer,
                                   std::uint64_t seed, double beyond) {
  const bool literal = sheet.spacing_rule == "literal";
  // An odd number of beams more puts both ends into the middle of a beam: at a border the light has a kink.
  const auto more =
      literal || beyond <= 0.0 ? 0u : 2u * static_cast<std::uint32_t>(beyond * sheet.beams) + 1u;
  const std::uint32_t n = static_cast<std::uint32_t>(sheet.beams) + more;
  beyond = 0.5 * more / sheet.beams;
  const std::uint32_t which = sheet_index * 256 + layer;
  const double even_step = 1.0 / n;
  const double shift = uniform(random_words(seed, Stream::cross_section, 0, which)[0]);
  std::vector<BeamPlace> places(n);
  double s = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = uniform(random_words(seed, Stream::beam_spacing, i, which)[0]);
    const double step = literal ? even_step * (u > 0.5 ? 1.0 + u : 1.0 - u)
                                : even_step * (1.0 + sheet.spacing_jitter * (2.0 * u - 1.0));
    BeamPlace& place = places[i];
    place.s = literal ? s : s + 0.5 * step;
    place.s_of_phase = literal ? i * even_step : place.s;
    place.from = s;
    place.to = s + (literal ? even_step : step);
    s += step;
    double across = van_der_corput(i) + shift;
    if (across >= 1.0) across -= 1.0;
    place.across = normal_quantile(across);
    place.depth = uniform(random_words(seed, Stream::depth, i, which)[0]);
  }
  if (!literal) {
    const auto scaled = [&](double at) { return at / s * (1.0 + 2.0 * beyond) - beyond; };
    for (BeamPlace& place : places) {
      place.from = scaled(place.from);
      place.to = scaled(place.to);
      place.s = place.s_of_phase = scaled(place.s);
    }
  }
  return places;
}

}  // namespace vegard::sim
