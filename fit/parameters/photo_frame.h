// The properties that one of several photographs has for itself: its own free numbers, and the place from
// which it sees the sheets.
//
// Free numbers of sheets are those of the scene's own frame. A photograph of another station has them carried
// over (sim/scene/structs/station.h), and so has the chain rule.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/station.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

struct PhotoFrame {
  std::string name;  ///< the photograph's; empty: the shared scene itself, or a fit's only photograph
  sim::Station station;
  std::vector<sim::Sheet> sheets_at_home;  ///< of its scene before they were carried over

  /// Gives a scene's sheets the places that they have at home, for free numbers to be written into, and
  /// carries them over again. Nothing happens to a photograph of the scene's own site.
  void to_site_frame(sim::Scene& scene) const;
  void carry(sim::Scene& scene) const;

  /// Replaces the numbers of sheets at home by those that the photograph sees; other numbers stay. slopes: d
  /// number / d free, row-major [number][moved]; empty stands for the identity.
  void carry(const sim::Scene& at_home, const sim::Scene& there, std::vector<sim::ParameterId>& numbers,
             std::vector<double>& slopes) const;

 private:
  template <class Take, class Give>
  void carry_curve(int sheet, const sim::Sheet& at_home, double instant_s, std::size_t moved,
                   const Take& take, const Give& give) const;
};

/// Of a photograph of `scene`: its scene and its frame.
struct FramedScene {
  sim::Scene scene;
  PhotoFrame frame;
};
FramedScene framed_scene(const sim::Scene& scene, const sim::PhotoEntry& entry);

}  // namespace vegard::fit
