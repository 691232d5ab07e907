// Vignetting: the decrease of a lens's light from the middle of the picture to its edges.
//
// cos^n of the angle off the axis (n = 4: natural vignetting, the illumination of a plane behind a simple
// lens) times an even polynomial in the distance from the middle, 1 + a r^2 + b r^4 + c r^6 with r = 1 in the
// corners (form of Goldman 2010, IEEE TPAMI 32, 2276, doi:10.1109/TPAMI.2010.55).
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Light at a point of the picture, in pixels, over the light in its middle. At least 0.
class Vignetting {
 public:
  explicit Vignetting(const Scene& scene);
  bool none() const { return none_; }
  double at(double x_px, double y_px) const;

 private:
  Camera camera_;
  Lens<double> lens_;
  double cos_power_;
  std::array<double, 3> polynomial_;
  bool none_;
};

/// Multiplies every channel by the vignetting at the pixels' centres.
void darken(const Vignetting& vignetting, Image& image);

}  // namespace vegard::sim
