// `vegard keogram IMAGES… -o OUT`, also used by `vegard profile` for a list of pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/direction_maps.h"

namespace vegard::apps {

/// Options of a keogram; empty if not given.
struct KeogramOptions {
  std::vector<std::string> images, outputs;  ///< outputs by their endings: .png, .svg, .exr, .csv
  std::string mask, scene, decoding, times;
  std::vector<int> roi_px;
  MapOptions maps;
  std::string start;             ///< time of the first picture
  std::optional<double> step_s;  ///< from one picture to the next
  std::optional<double> azimuth_deg, width, step_deg;
  std::string channel;
  std::optional<double> black, white;
  bool overwrite = false;
};

/// Makes the keogram and prints what was done. Throws Error of all kinds.
void run_keogram(const KeogramOptions& options);

}  // namespace vegard::apps
