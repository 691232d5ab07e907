#include "sim/view/colour/filter_response.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/lines/emission_line.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {
namespace {

constexpr double kHalfBase_nm = 5.0;

std::size_t filters(const Scene& scene) { return std::min<std::size_t>(3, scene.emission.lines.size()); }

}  // namespace

bool sees_through_filters(const Scene& scene) { return scene.sensor.response == "filters"; }

std::vector<Vector3> filter_colours(const Scene& scene) {
  std::vector<Vector3> colours(scene.emission.lines.size(), Vector3{});
  for (std::size_t i = 0; i < filters(scene); ++i) colours[i][i] = 1.0;
  return colours;
}

ChannelTable filter_channels(const Scene& scene) {
  ChannelTable table;
  std::vector<double>& nm = table.wavelength_nm;
  for (std::size_t i = 0; i < filters(scene); ++i)
    for (const double offset : {-kHalfBase_nm, 0.0, kHalfBase_nm})
      nm.push_back(scene.emission.lines[i] + offset);
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  for (std::size_t c = 0; c < 3; ++c)
    for (const double at : nm) {
      const double line = c < filters(scene) ? scene.emission.lines[c] : 0.0;
      // Responses are per power, and a photon of a longer wave has less of it.
      const double per_photon = colour_matching(kGreenNm)[1] * at / kGreenNm;
      table.response[c].push_back(per_photon * std::max(0.0, 1.0 - std::abs(at - line) / kHalfBase_nm));
    }
  return table;
}

}  // namespace vegard::sim
