// The functions of sim/render/beams/kernel.h for every lens except a plain pinhole.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/render/beams/kernel_types.h"
#include "sim/view/film/tangent_film.h"

namespace vegard::sim {

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
