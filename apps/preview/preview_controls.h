// The effect of a preview's keys and mouse on its scene. No window is needed for it.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {

/// Returns the step by which a key changes a number: the relative change for a logarithmic one, else the
/// change in the number's unit. It is a degree or 0.02 rad for an angle. For others it is a twentieth of the
/// value, or for a value of zero a thousandth of the range between its limits (0.01 without limits); these
/// are rounded down to 1, 2 or 5 times a power of ten.
double natural_step(const sim::ParameterRow& row, double value);

/// The present scene of a preview, and the number that is selected.
class PreviewControls {
 public:
  explicit PreviewControls(const sim::Scene& scene);

  const sim::Scene& scene() const { return scene_; }

  /// All real numbers of the scene: first those of footprints, then of nebulae, then of the camera.
  const std::vector<sim::ParameterPath>& paths() const { return paths_; }
  const sim::ParameterPath& chosen() const { return paths_[chosen_]; }

  void choose_next(int by);         ///< cyclically
  void change_chosen(int steps);    ///< within its limits
  void change_step(double factor);  ///< multiplies the step of the selected number
  void pan(double right_px,
           double down_px);       ///< moves the view as if the sky were dragged by this many pixels
  void zoom(double steps);        ///< narrows the view by a twentieth per step
  void reset();                   ///< restores the original scene; the selection stays
  void run_time(double seconds);  ///< advances the scene's clock

  /// "footprint.arc.energy_kev = 3 keV  (x 1.05)", in ASCII.
  std::string words() const;

 private:
  /// Sets the number if the scene is then valid; otherwise the scene is unchanged.
  void set(const sim::ParameterPath& path, double value);
  void set_camera(double* number, const std::string& path, double value);

  sim::Scene scene_, given_;
  std::vector<sim::ParameterPath> paths_;
  std::vector<double> steps_;  ///< of each path
  std::size_t chosen_ = 0;
};

}  // namespace vegard::apps
