// A night that is made: what the sky does at every moment, for two cameras. A pure function of its seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::made_night {

/// What there is of aurora.
enum class Aurora { none, diffuse, arc };

/// The sky at a moment, the same for both cameras.
struct SkyState {
  Aurora aurora = Aurora::none;
  double flux_mw_m2 = 0.0, energy_kev = 3.0;
  double north_km = 220.0, east_km = 0.0;  ///< of the sheet's middle, from camera a
  double bearing_deg = 90.0, thickness_km = 4.0, wavelength_km = 70.0, phase_rad = 0.0;
  double cloud_cover = 0.0;  ///< 0 clear, 1 overcast
  bool lamp = false;         ///< before both cameras, each its own
};

/// How a file is broken, if it is.
enum class Damage { none, missing, empty, cut, junk };

struct NightFrame {
  int camera = 0;  ///< 0: a, 1: b
  int number = 0;  ///< of the camera's frames
  double utc_s = 0.0;
  std::string name;  ///< of its file: "a/20141013_164000.jpg"
  Damage damage = Damage::none;
};

class Night {
 public:
  /// `frames`: of both cameras together.
  Night(std::uint64_t seed, int frames);

  std::uint64_t seed() const { return seed_; }
  const std::vector<NightFrame>& frames() const { return frames_; }
  SkyState sky(double utc_s) const;
  double begin_s() const { return begin_s_; }

  /// The scene by which a camera's frames are fitted: it knows camera, place, field and blur, and nothing of
  /// the aurora but that it is a sheet.
  static std::string scene_text(int camera);
  /// The scene of a frame as it is: of its aurora, its airglow, stars and twilight.
  sim::Scene truth(const NightFrame& frame) const;
  /// The distance of the sheet's line along the middle of the camera's view, which a fit of scene_text()
  /// finds.
  static double distance_km(const sim::Scene& truth);

 private:
  std::uint64_t seed_;
  double begin_s_ = 0.0;
  std::vector<NightFrame> frames_;
  struct Spell {
    double until_s = 0.0;
    double value = 0.0;
  };
  std::vector<Spell> aurora_, clouds_, lamps_;
};

}  // namespace vegard::made_night
