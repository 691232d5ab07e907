// Mean light in bins, of whatever statistics are linear in the gains and the sky.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/measure/profile.h"

namespace vegard::fit {

struct LinearBins {
  std::vector<double> mean, sigma;  ///< [bin][channel]; a sigma of 0: not used
  std::vector<int> band;            ///< [bin]: whose gain it has
  std::vector<double> place;  ///< [bin]: down the picture, 0 top to 1 bottom, for the sky; of bands' own
                              ///< skies, along the positions, 0 first to 1 last
  int skies = 1;              ///< how many there are: one, or one per band, whose number is `band`

  /// A profile's bins after those that are there.
  void append(const Profile& data, const std::vector<double>& sigma_of_data, int picture_height);
  /// Of a profile all of whose bands have a sky of their own. Nothing else may be there.
  void append_with_skies(const Profile& data, const std::vector<double>& sigma_of_data);
};

}  // namespace vegard::fit
