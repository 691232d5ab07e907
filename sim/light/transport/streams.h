// Directions of electrons to the field, and how elastic collisions share them out.
#pragma once

#include <cstddef>
#include <vector>

namespace vegard::sim {

/// Cosines of the pitch angle, first those downwards (negative), then those upwards, by Gauss's quadrature in
/// each half, whose weights sum up to 1 there.
struct Streams {
  std::vector<double> cosine, weight;

  std::size_t size() const { return cosine.size(); }
  std::size_t half() const { return cosine.size() / 2; }
};

/// 4 or 8 in each half.
Streams pitch_streams(int half);

/// The part of elastic collisions that turns electrons into other streams: [to * size + from] for electrons
/// per cosine, times all elastic collisions. What is left of `kept` goes straight on.
struct ElasticTurn {
  std::vector<double> into;
  double kept = 0.0;  ///< 1 - f: the share that counts as collisions
};

/// Screened Rutherford scattering, p(cos) ~ 1/(1 + 2 a - cos)^2, whose screening a gives the mean 1 - cos
/// `transfer_ratio`. Legendre's polynomials below the half's number are kept; the moment of that number is
/// the share f that goes straight on (delta-M: Wiscombe 1977, J. Atmos. Sci. 34, 1408).
ElasticTurn elastic_turn(const Streams& streams, double transfer_ratio);

/// Legendre's moments 0 to `highest` of that scattering.
std::vector<double> scattering_moments(double transfer_ratio, int highest);

}  // namespace vegard::sim
