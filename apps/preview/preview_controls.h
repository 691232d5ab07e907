// What the keys and the mouse of a preview do to its scene. No window is needed for it.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {

/// How far a key changes a number: of a logarithmic one the share that is added or taken away, else the
/// amount, in the number's unit. Of an angle a degree or 0.02 rad; of others a twentieth of the value, of
/// zero a thousandth of the way between its limits, either down to 1, 2 or 5 times a power of ten.
double natural_step(const sim::ParameterRow& row, double value);

/// A scene under way, and the number of it that is chosen.
class PreviewControls {
 public:
  explicit PreviewControls(const sim::Scene& scene);

  const sim::Scene& scene() const { return scene_; }

  /// Every real number of the scene: those of footprints first, then of nebulae, then of the camera.
  const std::vector<sim::ParameterPath>& paths() const { return paths_; }
  const sim::ParameterPath& chosen() const { return paths_[chosen_]; }

  void choose_next(int by);                   ///< round and round
  void change_chosen(int steps);              ///< within its limits
  void change_step(double factor);            ///< of the chosen number
  void pan(double right_px, double down_px);  ///< as if the sky were dragged by so many of the pixels
  void zoom(double steps);                    ///< a twentieth closer a step
  void reset();                               ///< the scene as it was given; the choice stays
  void run_time(double seconds);              ///< of the scene's own clock

  /// "footprint.arc.energy_kev = 3 keV  (x 1.05)", in ASCII.
  std::string words() const;

 private:
  /// Takes the number if the scene is then valid; else the scene stays as it was.
  void set(const sim::ParameterPath& path, double value);
  void set_camera(double* number, const std::string& path, double value);

  sim::Scene scene_, given_;
  std::vector<sim::ParameterPath> paths_;
  std::vector<double> steps_;  ///< of each path
  std::size_t chosen_ = 0;
};

}  // namespace vegard::apps
