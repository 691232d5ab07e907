// The kernel's door: beams in, light on a film out. One call works through groups of sixteen beams on one
// thread.
//
// Behind it is what is compiled once per instruction set; what crosses the door are plain arrays
// (sim/render/beams/kernel_types.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/emission_points.h"
#include "sim/render/beams/kernel_types.h"
#include "sim/view/film/tangent_film.h"

namespace vegard::sim {

/// Lets the groups fall on `film`, [row][column][stride] integers, stride as in the profiles. Returns the
/// number of deflection points computed.
std::uint64_t fall_on_film(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           std::int64_t* film);

/// The same, and the derivatives on `tangents`.
std::uint64_t fall_on_film_with_tangents(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents);

/// The reference: the same kernel over double, on a film of rayleighs in double. Slow.
std::uint64_t fall_on_film_reference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film);

/// Adds precomputed light at precomputed places in the very way of fall_on_film: the floor that benchmarks
/// compare with. Points are beam by beam; weights[point * stride + line] in rayleighs, column and row in
/// cells as the splat has them.
void splat_on_film(const FilmGeometry& geometry, int stride, const float* column, const float* row,
                   const float* weights, std::size_t points, std::int64_t* film);

/// The part of fall_on_film before the film, to no effect: for benchmarks.
std::uint64_t fall_until(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         FallPhase phase);

/// Appends to `record` what fall_on_film would splat. Returns the number of deflection points computed.
std::uint64_t record_splats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            SplatRecord& record);

/// Appends the points of the groups to `out`, whether the film has them or not.
void list_points(const KernelScene& scene, const BeamGroup* groups, std::size_t count, EmissionPoints& out);

/// The instruction set that fall_on_film was dispatched to, "AVX3".
const char* kernel_instruction_set();

}  // namespace vegard::sim
