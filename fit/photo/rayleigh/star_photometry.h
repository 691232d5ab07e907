// Finds the rayleighs per count and second from stars whose spectra are known.
//
// A star of F photons cm^-2 s^-1 through the filter (rayleigh_camera.h) puts as many counts into its image as
// an even sky of
//   B = F 4 pi / (1e6 Omega) rayleighs
// puts into one pixel there, Omega the pixel's solid angle by the lens (a rayleigh is 1e6 / 4 pi photons
// cm^-2 s^-1 sr^-1: sim/view/colour/radiometry.h). Counts are those of aperture.h on a picture over its flat
// field; the lens's collecting area, its vignetting at that place and the sensor drop out. The air takes its
// share of the star's light; the factor is for light below the air.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/rayleigh/aperture.h"
#include "fit/photo/rayleigh/count_picture.h"
#include "fit/photo/rayleigh/factor_fit.h"
#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

enum class ExtinctionBy {
  choice,  ///< by the stars where they stand at enough different airmasses, else by the air
  stars,   ///< found with the factor
  air,     ///< of the scene's air (sim/view/sky/air.h), the standard one where it has none
  number   ///< given
};

struct StarPhotometrySettings {
  Aperture aperture;
  double faintest = 4.0, min_elevation_deg = 20.0;
  ExtinctionBy extinction = ExtinctionBy::choice;
  double magnitudes_per_airmass = 0.0;  ///< of ExtinctionBy::number
  bool refracting_air = true;
};

/// A star on average of the pictures that it was measured in.
struct MeasuredStar {
  std::string name;
  double magnitude = 0.0, colour_index = 0.0;
  double x_px = 0.0, y_px = 0.0;  ///< in the first of them
  double elevation_deg = 0.0, airmass = 1.0;
  int pictures = 0;
  double rate = 0.0, rate_error = 0.0;  ///< counts s^-1
  double rayleighs = 0.0;               ///< B above, without the air
  double factor = 0.0;                  ///< R per count s^-1 by this star alone, with the answer's extinction
  bool used = false;
};

struct StarFactor {
  RayleighFactor factor;  ///< its error has all of what follows in quadrature
  double star_error = 0.0, spectrum_error = 0.0, width_error = 0.0;  ///< relative
  int degrees_of_freedom = 0;
  double scatter = 0.0;                            ///< of single stars, relative, beyond their noise
  ExtinctionBy extinction = ExtinctionBy::choice;  ///< what it was by
  double magnitudes_per_airmass = 0.0;             ///< of the air the mean over the stars
  std::optional<double> extinction_error;          ///< where it was found
  /// Median over the bright stars (50 of their errors, three or more) of what a circle wider by half has over
  /// the aperture's light, less 1.
  double light_outside = 0.0;
  std::vector<MeasuredStar> stars;  ///< the brightest first
  std::vector<std::string> notes;
};

/// Measures the stars of one picture after another, all through one filter and by one camera, and keeps none
/// of them.
class StarPhotometer {
 public:
  /// `scene`: its camera of the pictures' size and its site.
  StarPhotometer(const sim::Scene& scene, const FilterBand& band, const StarPhotometrySettings& settings);

  /// `julian_date`: of the middle of its exposure.
  void add(const CountPicture& picture, double julian_date);

  /// Throws sim::Error(unreadable_input), naming `name`, if fewer stars are left than the numbers that are to
  /// be found and three more.
  StarFactor answer(const std::string& name) const;

 private:
  /// Measurements of one star, summed over pictures.
  struct Sum {
    MeasuredStar star;
    double ratio = 0.0, ratio_variance = 0.0;  ///< counts s^-1 per rayleigh that its light is worth
    double outside = 0.0;                      ///< light of a wider circle over that of the aperture, less 1
    int with_outside = 0;
  };
  static void take_means(Sum& sum);

  sim::Scene scene_;
  FilterBand band_;
  StarPhotometrySettings settings_;
  std::map<std::ptrdiff_t, Sum> sums_;  ///< by the stars' places in catalogue_stars(); not all have a
                                        ///< number
};

/// Kasten and Young 1989, doi:10.1364/AO.28.004735.
double relative_airmass(double elevation_deg);

}  // namespace vegard::fit
