#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/earth.h"
#include "sim/scene/table/value_check.h"
#include "sim/scene/table/value_words.h"

namespace vegard::sim {
namespace {

class SunCheck {
 public:
  SunCheck(const Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  [[noreturn]] void refuse(const Complaint& complaint, const std::string& key) const {
    complain(complaint, {scene_.file, 0, path_ + "." + key});
  }

  void check_shown() const {
    if (!scene_.sun.shown)
      refuse({"it stands on the Sun, which is not in the scene", "shown = true in [sun]", ""}, "name");
  }

  void check_lines(const std::vector<double>& list, bool may_be_empty, const char* key) const {
    const std::size_t lines = scene_.emission.lines.size();
    if (list.size() == lines || (may_be_empty && list.empty())) return;
    refuse({std::to_string(list.size()) + " numbers for " + std::to_string(lines) + " emission lines",
            "one per line of emission.lines, in its order", ""},
           key);
  }

  void check_below(double low, const char* low_key, double high, const char* high_key) const {
    if (low < high) return;
    refuse(
        {std::string(low_key) + " is not below " + high_key, std::string(low_key) + " below " + high_key, ""},
        low_key);
  }

 private:
  const Scene& scene_;
  std::string path_;
};

void check_chromosphere(const Scene& scene, const Chromosphere& c) {
  const SunCheck check(scene, "chromosphere." + c.name);
  check.check_shown();
  check.check_lines(c.rayleigh, true, "rayleigh");
  check.check_below(c.innerradius, "innerradius", c.outerradius, "outerradius");
  constexpr double kMostSteps = 100000.0;
  const double steps = 2.0 * c.outerradius / c.step;
  if (steps > kMostSteps)
    check.refuse({short_real_text(steps) + " steps from side to side",
                  "at most " + short_real_text(kMostSteps), "a larger step"},
                 "step");
  if (c.peak != 0.0 && c.biasmap.empty())
    check.refuse({"there is no map for the peak", "biasmap = \"a picture's name\"", "or peak = 0"}, "peak");
}

void check_loop(const Scene& scene, const Loop& l) {
  const SunCheck check(scene, "loop." + l.name);
  check.check_shown();
  check.check_lines(l.rayleigh, false, "rayleigh");
  const double reach = std::hypot(0.5 * l.width, l.spread);
  if (scene.sun.shown && reach >= scene.sun.radius)
    check.refuse(
        {"its feet would stand " + short_real_text(reach) +
             " from the middle between them, beside a Sun of radius " + short_real_text(scene.sun.radius),
         "half the width and the spread together below the Sun's radius", ""},
        "width");
  if (l.voxel > l.strand_radius)
    check.refuse({"strands of radius " + short_real_text(l.strand_radius) + " would fall between voxels of " +
                      short_real_text(l.voxel),
                  "at most strand_radius", "half of it shows the falloff"},
                 "voxel");
  if (l.voxel == 0.0 && (l.blur > 0 || l.sharpen > 0))
    check.refuse({"there is no grid to filter", "voxel above 0", "or blur = 0 and sharpen = 0"},
                 l.blur > 0 ? "blur" : "sharpen");
}

void check_corona(const Scene& scene, const Corona& c) {
  const SunCheck check(scene, "corona." + c.name);
  check.check_shown();
  check.check_lines(c.rayleigh, false, "rayleigh");
  if (c.share.empty() || c.share.size() != c.power.size())
    check.refuse(
        {std::to_string(c.share.size()) + " of share for " + std::to_string(c.power.size()) + " of power",
         "as many of one as of the other, and at least one", ""},
        "share");
}

void check_bundle(const Scene& scene, const Bundle& b) {
  const SunCheck check(scene, "bundle." + b.name);
  check.check_shown();
  check.check_lines(b.rayleigh, false, "rayleigh");
  check.check_below(b.lowest_latitude_deg, "lowest_latitude_deg", b.highest_latitude_deg,
                    "highest_latitude_deg");
  // Places of a latitude are from |latitude - B0| to 180° - |latitude + B0| off the middle of the disc.
  const double b0 = scene.sun.latitude_deg;
  const auto within = [&](double latitude) {
    return std::clamp(latitude, b.lowest_latitude_deg, b.highest_latitude_deg);
  };
  const double least = std::abs(within(b0) - b0), most = 180.0 - std::abs(within(-b0) + b0);
  const double limb = std::acos(std::min(1.0, scene.sun.radius * scene.sun.unit_km / scene.sun.distance_km)) /
                      kRadiansPerDegree;
  if (limb + b.horizon_deg < least || limb - b.horizon_deg > most)
    check.refuse({"no place between these latitudes is within " + short_real_text(b.horizon_deg) +
                      " degrees of the limb",
                  "a larger horizon_deg, or other latitudes", ""},
                 "horizon_deg");
}

}  // namespace

void check_sun(const Scene& scene) {
  if (scene.sun.shown) {
    const SunCheck check(scene, "sun");
    check.check_lines(scene.sun.photosphere_rayleigh, true, "photosphere_rayleigh");
    if (scene.sun.limb_darkening + scene.sun.limb_darkening_square > 1.0)
      check.refuse(
          {"the limb would be darker than black", "limb_darkening + limb_darkening_square of at most 1", ""},
          "limb_darkening");
    if (scene.sun.distance_km <= scene.sun.radius * scene.sun.unit_km)
      check.refuse({"the observer is inside of the Sun", "a distance above radius times unit_km", ""},
                   "distance_km");
  }
  for (const Chromosphere& chromosphere : scene.chromospheres) check_chromosphere(scene, chromosphere);
  for (const Loop& loop : scene.loops) check_loop(scene, loop);
  for (const Corona& corona : scene.coronae) check_corona(scene, corona);
  for (const Bundle& bundle : scene.bundles) check_bundle(scene, bundle);
  for (const Ejection& ejection : scene.ejections) {
    const SunCheck check(scene, "ejection." + ejection.name);
    check.check_shown();
    check.check_lines(ejection.rayleigh, false, "rayleigh");
  }
}

}  // namespace vegard::sim
