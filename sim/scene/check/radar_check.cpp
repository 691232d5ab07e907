// The entries of [[fit.radar]]: files, names, limits, and which keys go together.
#include <map>
#include <string>
#include <utility>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

Origin origin_of_radar(const Scene& scene, const RadarEntry& entry, const std::string& key) {
  return {scene.file, entry.line, std::string(free_table) + "." + radar_key + (key.empty() ? "" : "." + key)};
}

void check_radar(const Scene& scene, const RadarEntry& entry) {
  const auto refuse = [&](const std::string& key, const Complaint& complaint) {
    throw scene_error(complaint, origin_of_radar(scene, entry, key));
  };
  if (entry.file.empty())
    refuse("", {"the radar has no file", "file = \"the name of a CSV or HDF5 file\"", ""});
  for (const RadarNumberKey& key : radar_number_keys()) {
    const std::optional<double>& number = entry.*key.place;
    if (number && !(*number >= key.min && *number <= key.max))
      refuse(key.key, {real_text(*number) + " is not possible",
                       "a number from " + short_real_text(key.min) + " to " + short_real_text(key.max), ""});
  }
  const auto need_both = [&](const std::optional<double>& a, const char* name_a,
                             const std::optional<double>& b, const char* name_b) {
    if (a.has_value() == b.has_value()) return;
    refuse(a ? name_a : name_b,
           {std::string(a ? name_a : name_b) + " needs " + (a ? name_b : name_a), "both or neither", ""});
  };
  need_both(entry.latitude_deg, "latitude_deg", entry.longitude_deg, "longitude_deg");
  need_both(entry.azimuth_deg, "azimuth_deg", entry.elevation_deg, "elevation_deg");
  need_both(entry.site_latitude_deg, "site_latitude_deg", entry.site_longitude_deg, "site_longitude_deg");
  if (entry.latitude_deg && entry.azimuth_deg)
    refuse("azimuth_deg",
           {"latitude_deg and azimuth_deg both say where the radar looks", "one of the two", ""});
  if ((entry.site_latitude_deg || entry.site_altitude_m) && !entry.azimuth_deg)
    refuse("site_latitude_deg",
           {"the radar's site says nothing without its beam", "azimuth_deg and elevation_deg beside it", ""});
  if (!(entry.lowest_km.value_or(kRadarLowestKm) < entry.highest_km.value_or(kRadarHighestKm)))
    refuse("lowest_km", {"lowest_km is not below highest_km", "a range of altitudes", ""});
}

}  // namespace

void check_radars(const Scene& scene) {
  std::map<std::string, int> line_of_name;
  for (const RadarEntry& entry : scene.fit.radars) {
    check_radar(scene, entry);
    if (!line_of_name.emplace(entry.name, entry.line).second)
      throw scene_error({"two radars are called '" + entry.name + "'", "a name of its own for each radar",
                         "a radar without a name is called by its file's name without its ending"},
                        origin_of_radar(scene, entry, "name"));
  }
}

}  // namespace vegard::sim
