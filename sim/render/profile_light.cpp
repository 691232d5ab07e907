#include "sim/render/profile_light.h"

#include <algorithm>
#include <utility>

#include "sim/light/sheet_profile.h"
#include "sim/render/film.h"
#include "sim/render/picture.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

ProfileShapers profile_shapers(const Scene& scene, const std::vector<ParameterId>& free,
                               const Exposer& exposer) {
  ProfileShapers result;
  result.sheets.resize(scene.sheets.size());
  result.alone.assign(free.size(), false);
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    SheetShapers& sheet = result.sheets[s];
    for (std::size_t j = 0; j < free.size(); ++j) {
      const std::vector<std::vector<float>> slopes =
          profile_slopes(scene.emission.lines, scene, static_cast<int>(s), free[j]);
      if (slopes.empty()) continue;
      // These two numbers also act outside of the profiles: in the kernel, and in the volumes.
      result.alone[j] =
          free[j].role() != ParameterRole::energy_flux && free[j].role() != ParameterRole::oxygen_factor;
      const std::size_t stride = slopes.front().size() / HeightProfile::kAltitudes;
      for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) {
        std::vector<float> rate;  // of one rung of the sheet's ladder of energies after the other
        for (const std::vector<float>& slope : slopes)
          for (int a = 0; a < HeightProfile::kAltitudes; ++a) rate.push_back(slope[a * stride + l]);
        if (std::all_of(rate.begin(), rate.end(), [](float x) { return x == 0.0f; })) continue;
        rate = exposer.split_by_age(static_cast<int>(s), scene.emission.lines[l], rate);
        const auto found = std::find(sheet.rates.begin(), sheet.rates.end(), rate);
        sheet.shapers.push_back({static_cast<int>(j), static_cast<int>(l),
                                 static_cast<std::size_t>(found - sheet.rates.begin())});
        if (found == sheet.rates.end()) sheet.rates.push_back(std::move(rate));
      }
    }
  }
  return result;
}

ProfileLight::ProfileLight(const Scene& scene, const FilmGeometry& film, int threads, Exposer& exposer)
    : film_(film), threads_(threads), exposer_(exposer) {
  for (const Sheet& sheet : scene.sheets) first_rates_.push_back(sheet.spline_rate);
}

bool ProfileLight::is_kept(const Scene& rest, const ProfileShapers& shapers) const {
  const auto same = [](const SheetShapers& a, const SheetShapers& b) { return a.rates == b.rates; };
  return scene_ && same_values(*scene_, rest, {"fit"}) &&
         std::equal(shapers_.begin(), shapers_.end(), shapers.sheets.begin(), shapers.sheets.end(), same);
}

void ProfileLight::expose(const Scene& scene, const ProfileShapers& shapers) {
  if (std::all_of(shapers.sheets.begin(), shapers.sheets.end(),
                  [](const SheetShapers& sheet) { return sheet.rates.empty(); }))
    return;
  Scene rest = scene;
  for (std::size_t s = 0; s < rest.sheets.size(); ++s) rest.sheets[s].spline_rate = first_rates_[s];
  if (is_kept(rest, shapers)) return;
  shapers_ = shapers.sheets;
  light_.resize(scene.sheets.size());
  const std::vector<float> transmission = transmission_on_film(scene, film_, threads_);
  for (std::size_t s = 0; s < light_.size(); ++s)
    if (!shapers_[s].rates.empty()) expose_sheet(scene, rest, s, transmission);
  scene_ = std::move(rest);
}

void ProfileLight::expose_sheet(const Scene& scene, const Scene& rest, std::size_t s,
                                const std::vector<float>& transmission) {
  const auto& rates = shapers_[s].rates;
  const std::size_t cells = static_cast<std::size_t>(film_.rows) * film_.columns,
                    lines = rest.emission.lines.size();
  Exposure exposure;
  std::vector<float> dimmed, down(cells);
  light_[s].resize(cells * lines * rates.size());
  if (!exposer_.spreads()) exposer_.expose_profiles(rest, static_cast<int>(s), rates, exposure);
  for (std::size_t l = 0; l < lines; ++l) {
    if (exposer_.spreads())
      exposer_.expose_profiles(rest, static_cast<int>(s), rates, exposure, static_cast<int>(l));
    const PlaneBlur blur = line_blur(scene, film_, static_cast<int>(l));
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const float* plane = exposure.rayleigh.data() + i * cells;
      if (!transmission.empty()) {
        dimmed.assign(plane, plane + cells);
        for (std::size_t cell = 0; cell < cells; ++cell) dimmed[cell] *= transmission[l * cells + cell];
        plane = dimmed.data();
      }
      blur_down(plane, down.data(), film_.rows, film_.columns, 1, blur.down, threads_);
      blur_across(down.data(), light_[s].data() + (l * rates.size() + i) * cells, film_.rows, film_.columns,
                  1, blur.across, threads_);
    }
  }
}

const float* ProfileLight::plane(std::size_t sheet, const Shaper& shaper) const {
  const std::size_t cells = static_cast<std::size_t>(film_.rows) * film_.columns;
  return light_[sheet].data() + (shaper.line * shapers_[sheet].rates.size() + shaper.rate) * cells;
}

}  // namespace vegard::sim
