// What belongs to one of several photographs alone: its own free numbers, and the frame in which it sees the
// sheets.
//
// Free numbers of sheets refer to the frame of the scene's own site. For a photograph from another station
// they are carried over to its frame (sim/scene/structs/station.h), and so are their derivatives, by the
// chain rule.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/station.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

struct PhotoFrame {
  std::string name;  ///< name of the photograph; empty: the shared scene itself, or a fit's only photograph
  sim::Station station;
  std::vector<sim::Sheet> sheets_at_home;  ///< sheets of its scene before they were carried over

  /// to_site_frame() gives a scene's sheets their positions in the frame of the scene's site, so that free
  /// numbers can be written into them; carry() carries them over again. Both do nothing for a photograph from
  /// the scene's own site.
  void to_site_frame(sim::Scene& scene) const;
  void carry(sim::Scene& scene) const;

  /// Replaces derivatives by numbers of sheets in the site's frame (`at_home`) by those in the photograph's
  /// frame (`there`); other numbers are unchanged. `slopes`: d number / d free, row-major [number][moved];
  /// empty stands for the identity.
  void carry(const sim::Scene& at_home, const sim::Scene& there, std::vector<sim::ParameterId>& numbers,
             std::vector<double>& slopes) const;

 private:
  template <class Take, class Give>
  void carry_curve(int sheet, const sim::Sheet& at_home, double instant_s, std::size_t moved,
                   const Take& take, const Give& give) const;
};

/// The scene of one photograph, and its frame.
struct FramedScene {
  sim::Scene scene;
  PhotoFrame frame;
};
FramedScene framed_scene(const sim::Scene& scene, const sim::PhotoEntry& entry);

}  // namespace vegard::fit
