#include "fit/compare/linear_bins.h"

namespace vegard::fit {

void LinearBins::append(const Profile& data, const std::vector<double>& sigma_of_data, int picture_height) {
  mean.insert(mean.end(), data.mean.begin(), data.mean.end());
  sigma.insert(sigma.end(), sigma_of_data.begin(), sigma_of_data.end());
  for (int b = 0; b < data.bands; ++b)
    for (int r = 0; r < data.rows; ++r) {
      const std::size_t bin = data.index(b, r, 0) / 3;
      const double row = data.grid != nullptr ? data.grid->row[bin] : r;
      band.push_back(data.grid != nullptr ? data.grid->band[bin] : b);
      place.push_back((data.region.y + row + 0.5) / picture_height);
    }
}

void LinearBins::append_with_skies(const Profile& data, const std::vector<double>& sigma_of_data) {
  append(data, sigma_of_data, 1);
  skies = data.bands;
  for (std::size_t bin = 0; bin < place.size(); ++bin)
    place[bin] = (static_cast<double>(bin % data.rows) + 0.5) / data.rows;
}

}  // namespace vegard::fit
