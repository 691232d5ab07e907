// The interface of the kernel: beams in, light on a film out. One call processes groups of sixteen beams on
// one thread.
//
// The implementation is compiled once per instruction set; the interface passes plain arrays
// (sim/render/beams/kernel_types.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/kernel_types.h"
#include "sim/view/film/tangent_film.h"

namespace vegard::sim {

/// Adds the light of the groups to `film`, [row][column][stride] integers, with the stride of the profiles.
/// Returns the number of deflection points computed.
std::uint64_t fall_on_film(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                           std::int64_t* film);

/// Does the same, and adds the derivatives to `tangents`.
std::uint64_t fall_on_film_with_tangents(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents);

/// The reference for tests: the same kernel in double precision, on a film of rayleighs in double. Slow.
std::uint64_t fall_on_film_reference(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film);

/// Adds precomputed light at precomputed places exactly as fall_on_film does: the lower limit of its time in
/// benchmarks. Points are in the order of the beams; weights[point * stride + line] are in rayleighs, column
/// and row in cells.
void splat_on_film(const FilmGeometry& geometry, int stride, const float* column, const float* row,
                   const float* weights, std::size_t points, std::int64_t* film);

/// Does the part of fall_on_film before the film without any result; for benchmarks.
std::uint64_t fall_until(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                         FallPhase phase);

/// Appends to `record` the samples that fall_on_film would add to the film. Returns the number of deflection
/// points computed.
std::uint64_t record_splats(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                            SplatRecord& record);

/// Appends the points of the groups to `out`, whether they are on the film or not.
void list_points(const KernelScene& scene, const BeamGroup* groups, std::size_t count, EmissionPoints& out);

/// Returns the instruction set that fall_on_film was dispatched to, such as "AVX3".
const char* kernel_instruction_set();

/// Distributes the samples of fall_on_film, for one line whose atoms move before they emit, to the films of a
/// ladder of blurs (sim/view/film/level_ladder.h): films[level][row][column], in the units of the value film.
/// The height profiles hold one line. Returns the number of deflection points computed.
std::uint64_t fall_on_levels(const KernelScene& scene, const KernelLevels& levels, const BeamGroup* groups,
                             std::size_t count, std::int64_t* const* films);

// These are the functions above for every lens except a plain pinhole; they are called by the functions
// above.
std::uint64_t fall_on_film_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                   std::int64_t* film);
std::uint64_t fall_with_tangents_by_lens(const KernelScene& scene, const SharedChain& shared,
                                         const BeamGroup* groups, const GroupChain* chains, std::size_t count,
                                         std::int64_t* film, TangentFilm& tangents);
std::uint64_t fall_reference_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                     double* film);
std::uint64_t fall_until_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                 FallPhase phase);
std::uint64_t record_splats_by_lens(const KernelScene& scene, const BeamGroup* groups, std::size_t count,
                                    SplatRecord& record);

}  // namespace vegard::sim
