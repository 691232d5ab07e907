#include "sim/emit/footprint/footprint_emitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/emit/footprint/foot_projection.h"
#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/emit/footprint/lit_map.h"
#include "sim/emit/footprint/scalar_march.h"

namespace vegard::sim {
namespace {

/// The common part of all footprint emitters. G is the number type of their grids.
template <class T, class G>
class FootprintEmitter : public Emitter<T> {
 public:
  FootprintEmitter(const Scene& scene, const Footprint& footprint, const ProfileTable& profiles,
                   const ProfileChanges& changes, const NumberAs<T>& number, MarchBy by,
                   double turned_deg = 0.0)
      : profile_(profiles, footprint.top_km, scene.march.step_km),
        rays_(scene, footprint, profile_.bottom_km(), turned_deg),
        rule_(rule_of_foot<T>(scene, footprint, number, turned_deg)),
        step_cells_(scene.march.step_cells),
        in_lanes_(std::is_same_v<T, double> && by == MarchBy::lanes) {
    scalar_.projection = kernel_.projection = rule_.projection;
    scalar_.sphere_km = kernel_.sphere_km = rule_.sphere_km;
    for (int i = 0; i < 3; ++i) {
      scalar_.axis[i] = rule_.axis[i];
      kernel_.axis[i] = value_of(rule_.axis[i]);
    }
    scalar_.patches = kernel_.patches = rule_.patches ? rule_.patches->data() : nullptr;
    scalar_.profile = kernel_.profile = &profile_;
    scalar_.ln_energy_shift =
        (number(footprint.energy_kev) - footprint.energy_kev) * (1.0 / footprint.energy_kev);
    scalar_.flux_shift = number(footprint.energy_flux_mw_m2) - footprint.energy_flux_mw_m2;
    scalar_.oxygen_shift = number(scene.emission.oxygen_factor) - scene.emission.oxygen_factor;
    const auto step_profile = [&](const ProfileTable& table) {
      return table.of_energy.empty()
                 ? nullptr
                 : std::make_unique<StepProfile>(table, footprint.top_km, scene.march.step_km);
    };
    by_flux_ = step_profile(changes.by_flux);
    by_oxygen_ = step_profile(changes.by_oxygen);
    scalar_.profile_by_flux = by_flux_.get();
    scalar_.profile_by_oxygen = by_oxygen_.get();
  }

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override {
    if constexpr (std::is_same_v<T, double>)
      if (in_lanes_) return march_in_lanes(rays, out);
    const ScalarMarch<T, G> marcher(scalar_);
    for (std::size_t i = 0; i < rays.count; ++i) {
      const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
      MarchSpanOf<T> spans[2];
      const int count = rays_.cut(enu, rays.end_km[i], spans);
      Depth depth;
      for (int s = 0; s < count; ++s) {
        ScalarLight<T> light;
        marcher.march(spans[s], light);
        for (int l = 0; l < out.lines; ++l) {
          T& sum = out.rayleigh[l * rays.count + i];
          sum = sum + light.rayleigh[l];
          depth.light += value_of(light.rayleigh[l]);
        }
        depth.add(light.weighted_km, light.entry_km);
      }
      depth.write(i, out);
    }
  }

 protected:
  /// Texels by places, and the grid's faces.
  void set_grid(double texels, double first_x, double first_y) {
    scalar_.texels = kernel_.texels = texels;
    scalar_.first_x = kernel_.first_x = first_x;
    scalar_.first_y = kernel_.first_y = first_y;
    const double cell_km = is_shell_projection(kernel_.projection)
                               ? (kernel_.sphere_km + kFootAltitudeKm) / texels
                               : 1.0 / texels;
    rays_.limit_feet(plain_rule(rule_), step_cells_ * cell_km);
  }

  void set_face(int face, const FootprintGrid<G>& grid, double min_flux) {
    scalar_.grid[face] = &grid;
    if constexpr (std::is_same_v<T, double>)
      if (in_lanes_) {
        texels_[face] = TexelStore(grid, min_flux, profile_.energies() > 1);
        kernel_.window[face] = texels_[face].window();
      }
  }

  void set_lit(std::vector<LitMap> maps) {
    lit_ = std::move(maps);
    for (std::size_t face = 0; face < lit_.size(); ++face)
      scalar_.lit[face] = kernel_.lit[face] = &lit_[face];
  }

 private:
  struct Depth {
    double light = 0.0, weighted_km = 0.0, entry_km = std::numeric_limits<double>::infinity();
    void add(double weighted, double entry) {
      weighted_km += weighted;
      entry_km = std::min(entry_km, entry);
    }
    void write(std::size_t ray, const BundleLight<T>& out) const {
      if (!(light > 0.0)) return;
      out.entry_km[ray] = entry_km;
      out.depth_km[ray] = weighted_km / light;
    }
  };

  void march_in_lanes(const RayBundle<double>& rays, const BundleLight<double>& out) const {
    thread_local std::vector<MarchSpan> spans;
    thread_local std::vector<std::size_t> of_ray;
    thread_local std::vector<SpanLight> lights;
    spans.clear();
    of_ray.clear();
    for (std::size_t i = 0; i < rays.count; ++i) {
      const double enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
      MarchSpan cut[2];
      const int count = rays_.cut(enu, rays.end_km[i], cut);
      for (int s = 0; s < count; ++s) {
        spans.push_back(cut[s]);
        of_ray.push_back(i);
      }
    }
    lights.resize(spans.size());
    march_spans(kernel_, spans.data(), spans.size(), lights.data());
    for (std::size_t s = 0; s < spans.size();) {
      const std::size_t i = of_ray[s];
      Depth depth;
      for (; s < spans.size() && of_ray[s] == i; ++s) {
        for (int l = 0; l < out.lines; ++l) {
          out.rayleigh[l * rays.count + i] += lights[s].rayleigh[l];
          depth.light += lights[s].rayleigh[l];
        }
        depth.add(lights[s].weighted_km, lights[s].entry_km);
      }
      depth.write(i, out);
    }
  }

  StepProfile profile_;
  std::unique_ptr<StepProfile> by_flux_, by_oxygen_;
  MarchRays rays_;
  FootRule<T> rule_;
  double step_cells_;
  bool in_lanes_;
  std::array<TexelStore, 6> texels_;
  std::vector<LitMap> lit_;
  FootprintKernel kernel_;
  ScalarFootprint<T, G> scalar_;
};

template <class T>
double min_flux(const FootprintGrid<T>& grid, double least) {
  for (const T& flux : grid.flux_mw_m2) least = std::max(least, value_of(flux) * kDarkShare);
  return least;
}

template <class T>
class PlaneEmitter : public FootprintEmitter<T, T> {
 public:
  PlaneEmitter(const Scene& scene, const Footprint& footprint, PlaneFootprint<T> map,
               const ProfileTable& profiles, const ProfileChanges& changes, const NumberAs<T>& number,
               int threads, MarchBy by)
      : FootprintEmitter<T, T>(scene, footprint, profiles, changes, number, by), map_(std::move(map)) {
    const double texels = 1.0 / map_.cell_km, least = min_flux(map_.grid, 0.0);
    this->set_grid(texels, -map_.west_km * texels - 0.5, -map_.south_km * texels - 0.5);
    this->set_face(0, map_.grid, least);
    if (!scene.march.skip) return;
    std::vector<LitMap> maps;
    maps.push_back(plane_lit_map(map_.grid.columns, map_.grid.rows, lit_texels(map_.grid, least), threads));
    this->set_lit(std::move(maps));
  }

 private:
  PlaneFootprint<T> map_;
};

template <class T>
class CubeEmitter : public FootprintEmitter<T, double> {
 public:
  CubeEmitter(const Scene& scene, const Footprint& footprint, CubeFootprint<double> map,
              const ProfileTable& profiles, const ProfileChanges& changes, const NumberAs<T>& number,
              int threads, MarchBy by)
      : FootprintEmitter<T, double>(scene, footprint, profiles, changes, number, by, map.turned_deg),
        map_(std::move(map)) {
    const double half = 0.5 * map_.face_cells;
    double least = 0.0;
    for (const FootprintGrid<double>& face : map_.face) least = min_flux(face, least);
    this->set_grid(half, half + 0.5, half + 0.5);
    for (int face = 0; face < 6; ++face) this->set_face(face, map_.face[face], least);
    if (!scene.march.skip) return;
    std::array<std::vector<std::uint8_t>, 6> lit;
    for (int face = 0; face < 6; ++face) lit[face] = lit_texels(map_.face[face], least);
    this->set_lit(cube_lit_maps(map_.face_cells, lit, threads));
  }

 private:
  CubeFootprint<double> map_;
};

}  // namespace

template <class T>
std::unique_ptr<Emitter<T>> plane_footprint_emitter(const Scene& scene, const Footprint& footprint,
                                                    PlaneFootprint<T> map, const ProfileTable& profiles,
                                                    const ProfileChanges& changes, const NumberAs<T>& number,
                                                    int threads, MarchBy by) {
  return std::make_unique<PlaneEmitter<T>>(scene, footprint, std::move(map), profiles, changes, number,
                                           threads, by);
}

template <class T>
std::unique_ptr<Emitter<T>> cube_footprint_emitter(const Scene& scene, const Footprint& footprint,
                                                   CubeFootprint<double> map, const ProfileTable& profiles,
                                                   const ProfileChanges& changes, const NumberAs<T>& number,
                                                   int threads, MarchBy by) {
  return std::make_unique<CubeEmitter<T>>(scene, footprint, std::move(map), profiles, changes, number,
                                          threads, by);
}

template std::unique_ptr<Emitter<double>> plane_footprint_emitter(const Scene&, const Footprint&,
                                                                  PlaneFootprint<double>, const ProfileTable&,
                                                                  const ProfileChanges&,
                                                                  const NumberAs<double>&, int, MarchBy);
template std::unique_ptr<Emitter<FreeDual>> plane_footprint_emitter(const Scene&, const Footprint&,
                                                                    PlaneFootprint<FreeDual>,
                                                                    const ProfileTable&,
                                                                    const ProfileChanges&,
                                                                    const NumberAs<FreeDual>&, int, MarchBy);
template std::unique_ptr<Emitter<double>> cube_footprint_emitter(const Scene&, const Footprint&,
                                                                 CubeFootprint<double>, const ProfileTable&,
                                                                 const ProfileChanges&,
                                                                 const NumberAs<double>&, int, MarchBy);
template std::unique_ptr<Emitter<FreeDual>> cube_footprint_emitter(const Scene&, const Footprint&,
                                                                   CubeFootprint<double>, const ProfileTable&,
                                                                   const ProfileChanges&,
                                                                   const NumberAs<FreeDual>&, int, MarchBy);

}  // namespace vegard::sim
