// The chromosphere and the corona as fields in space, in the Sun's frame and unit, for grids.
#pragma once

#include <vector>

#include "sim/emit/sun/chromosphere_density.h"
#include "sim/emit/sun/corona_emitter.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A field between two spheres around the Sun's middle.
class ShellField : public LightField {
 public:
  double unit_cm() const override { return unit_cm_; }
  Box3 bounds() const override;
  bool is_dark(const Box3& box) const override;
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override;

 protected:
  struct Here {
    double light, density;  ///< `light` for rayleigh = 1 of the line
  };

  /// `light`: rayleighs of density 1 per unit of path, per line, or empty.
  ShellField(const Sun& sun, double inner, double outer, const std::vector<double>& light, int lines);
  virtual Here here(const double place[3]) const = 0;

 private:
  double unit_cm_, inner_, outer_;
  std::vector<double> rate_;  ///< photons cm^-3 s^-1 for density 1, per line
};

/// The field's density is the absorbing one; it is 0 if the extinction is 0.
class ChromosphereField : public ShellField {
 public:
  ChromosphereField(const Scene& scene, int index, const Image* biasmap);

 private:
  ChromosphereField(const Scene& scene, const Chromosphere& c, int index, const Image* biasmap);
  Here here(const double place[3]) const override;
  ChromosphereDensity<double> density_;
  bool absorbs_;
};

/// Scattered light is that towards the scene's observer. The corona absorbs nothing.
class CoronaField : public ShellField {
 public:
  CoronaField(const Scene& scene, const Corona& corona);

 private:
  Here here(const double place[3]) const override;
  CoronaSource<double> source_;
  double observer_[3];
};

}  // namespace vegard::sim
