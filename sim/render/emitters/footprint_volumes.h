// The footprints of a scene as emitters, and as fields in space.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/light/colours_profile.h"
#include "sim/light/emitter.h"
#include "sim/light/profile_table.h"
#include "sim/render/beams/light_ages.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

// The instants at which a footprint's map is evaluated for the light of an exposure.
//
// A footprint that changes by itself is evaluated at each instant of an exposure and, since excited atoms
// emit with a delay, at earlier instants (sim/render/beams/light_ages.h): in each interval of age as often
// as the footprint changes in it. If only the substorm's level changes, it is evaluated once.

struct FootprintLook {
  std::vector<double> instants_s{};  ///< the light is the mean over them; empty: the scene's start
  double share = 1.0;                ///< factor on the light
  LightShare of_lines{};             ///< further factor for each line's light; empty: 1
};

/// Returns the looks whose sum is the light of an exposure. A footprint in two colours emits without delay,
/// and so does everything if emission.lag is "none". The number of evaluations in an interval of age is at
/// most 64 for a footprint of a box that only drifts, 16 for a curtain, 8 if the map must be made again each
/// time, and 4 around the Earth or if a flow must be followed. The past instants of the whole exposure are
/// put into this many groups of neighbours; all instants have the same weight.
std::vector<FootprintLook> footprint_looks(const Scene& scene, const Footprint& footprint);

/// Returns the bytes that the maps of all looks take, with numbers of `number_bytes` bytes.
double map_bytes(const Scene& scene, const Footprint& footprint, std::size_t number_bytes);

/// Returns the shortest time, in seconds, in which a footprint changes notably: by drifting over its own
/// width or cells, by its noise's lifetime, by a turn of its flow through one radian, by the phases of a
/// substorm, or by the changes of its sheets. Infinite for a steady one.
double soonest_change_s(const Scene& scene, const Footprint& footprint);

/// Returns the factor of the substorm on a footprint's light; 1 if the footprint's source includes it
/// already.
double substorm_share(const Scene& scene, const Footprint& footprint, double instant_s);

/// Makes the emitter of one look at a footprint of the scene; the light of an exposure is the sum over all
/// looks. A look at a box may have several instants. T is double or FreeDual.
template <class T>
std::unique_ptr<Emitter<T>> footprint_emitter(const Scene& scene, const Footprint& footprint,
                                              const VolumeFiles& files, const NumberAs<T>& number,
                                              int threads, const FootprintLook& look = {});

/// What the emitter of a volume is made of: the footprint with what its map says itself, the map of a box or
/// of a shell (the other is empty), and the profiles of its electrons.
struct FootprintParts {
  Footprint drawn;
  PlaneFootprint<double> plane;
  CubeFootprint<double> cube;
  ProfileTable profiles;
};

/// Returns the parts of one look at a footprint that is no curtain.
FootprintParts footprint_parts(const Scene& scene, const Footprint& footprint, const VolumeFiles& files,
                               int threads, const FootprintLook& look);

/// Makes the footprint's field in the observer's east, north and up, at the scene's start.
std::unique_ptr<LightField> footprint_field(const Scene& scene, const Footprint& footprint,
                                            const VolumeFiles& files, int threads);

// The pictures from which a footprint is made.

/// Returns the pictures of one footprint among those that have been read (sim/scene/file/named_files.h).
/// They live as long as `files`.
FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& footprint);

// The height profiles of a scene's footprints, according to their key `light`.

/// Returns the two colours of a footprint as amounts of the scene's lines, by the colours that the sensor
/// gives these lines.
ColourLadder colour_ladder(const Scene& scene, const Footprint& footprint);

/// Returns profile_table() of the scene's lines; with light = "colours", that table in the footprint's
/// colours.
ProfileTable footprint_profiles(const Scene& scene, const Footprint& footprint, double ln_least,
                                double ln_most);

}  // namespace vegard::sim
