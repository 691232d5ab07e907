#include "sim/emit/aurora/curl.h"

namespace vegard::sim {

Curls::Curls(const Sheet& sheet, std::uint32_t layer_address, std::uint64_t seed, double instant_s,
             double drifted_km)
    : seed_(seed),
      address_(layer_address),
      spacing_km_(sheet.curl_spacing_km),
      radius_km_(sheet.curl_radius_km),
      gather_(sheet.curl_gather),
      turn_rad_(sheet.curl_turn_rad),
      lifetime_s_(sheet.curl_lifetime_s),
      instant_s_(instant_s),
      moved_km_(drifted_km + sheet.curl_speed_km_s * instant_s) {}

Curls Curls::spirals(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
                     double drifted_km) {
  Curls spirals;
  spirals.stream_ = Stream::spiral;
  spirals.seed_ = seed;
  spirals.address_ = arc_address;
  spirals.spacing_km_ = sheet.spiral_spacing_km;
  spirals.radius_km_ = sheet.spiral_radius_km;
  spirals.turn_rad_ = -sheet.spiral_turn_rad;
  spirals.lifetime_s_ = sheet.spiral_lifetime_s;
  spirals.instant_s_ = instant_s;
  spirals.moved_km_ = drifted_km + sheet.spiral_speed_km_s * instant_s;
  return spirals;
}

Curl Curls::of_slot(std::int64_t slot) const {
  const SlotLife life = slot_life(seed_, stream_, address_, slot, instant_s_, lifetime_s_);
  const Words words = slot_words(seed_, stream_, address_, slot, life.generation);
  const double place = 0.25 + 0.5 * uniform(words[0]);  // jittered by a half spacing
  return {(static_cast<double>(slot) + place) * spacing_km_ + moved_km_, radius_km_, gather_ * life.strength,
          turn_rad_ * life.strength};
}

}  // namespace vegard::sim
