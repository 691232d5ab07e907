#include "sim/render/slab_exposer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>

#include "sim/base/parallel.h"
#include "sim/light/emitter.h"
#include "sim/light/height_profile.h"
#include "sim/light/sample.h"
#include "sim/render/beams/light_ages.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kMaxOfPass = kMaxLines;
constexpr double kMinSpreadPx = 0.5;     // what is spread less is shared with light that is not spread
constexpr double kCellsToASpread = 2.8;  // at least, where a film has wide cells
constexpr int kWidestBeamCells = 8, kWidestRayCells = 4;
constexpr double kReach = 4.0;       // standard deviations from beyond which no light comes
constexpr double kBrightKm = 250.0;  // where 630.0 nm is bright
constexpr int kSightsAcross = 48;    // places at which a film is looked at beforehand

double carried_km_s(const Scene& scene) {
  return 1e-3 * std::hypot(scene.blur.wind_m_s.east, scene.blur.wind_m_s.north);
}

bool has_line_footprints(const Scene& scene) {
  return std::any_of(scene.footprints.begin(), scene.footprints.end(),
                     [](const Footprint& f) { return f.light == FootprintLight::lines; });
}

/// Returns whether the scene has light that is not emitted by the air's excited atoms.
bool has_other_light(const Scene& scene) {
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.table != "footprint" && is_drawn(kind, scene)) return true;
  return std::any_of(scene.footprints.begin(), scene.footprints.end(),
                     [](const Footprint& f) { return f.light == FootprintLight::colours; });
}

double top_of_light_km(const Scene& scene) {
  double top_km = HeightProfile::kBottomKm;
  for (const Sheet& sheet : scene.sheets) top_km = std::max(top_km, sheet.top_km);
  for (const Footprint& footprint : scene.footprints) top_km = std::max(top_km, footprint.top_km);
  return top_km;
}

/// All of the film in few cells.
FilmGeometry overview(const FilmGeometry& film) {
  FilmGeometry few = film;
  few.columns = std::min(film.columns, kSightsAcross);
  few.rows = std::min(film.rows, kSightsAcross);
  few.cell_width_px = film.cell_width_px * film.columns / few.columns;
  few.cell_height_px = film.cell_height_px * film.rows / few.rows;
  return few;
}

/// The film with cells so many times as wide and high, and so much beyond its edges.
FilmGeometry widened(const FilmGeometry& film, int cells, double margin_px) {
  FilmGeometry wide;
  wide.cell_width_px = film.cell_width_px * cells;
  wide.cell_height_px = film.cell_height_px * cells;
  const int across = static_cast<int>(std::ceil(margin_px / wide.cell_width_px)),
            down = static_cast<int>(std::ceil(margin_px / wide.cell_height_px));
  wide.x0_px = film.x0_px - across * wide.cell_width_px;
  wide.y0_px = film.y0_px - down * wide.cell_height_px;
  wide.columns = (film.columns + cells - 1) / cells + 2 * across;
  wide.rows = (film.rows + cells - 1) / cells + 2 * down;
  return wide;
}

const std::shared_ptr<const std::vector<float>>& whole_share() {
  static const auto whole =
      std::make_shared<const std::vector<float>>(static_cast<std::size_t>(HeightProfile::kAltitudes), 1.0f);
  return whole;
}

/// Returns whether the number belongs to an emitter of such light, which the parts of a scene do not have.
bool is_of_other_light(const ParameterId& id) {
  const EmitterKind* kind = kind_of_table(id.row->table);
  return kind != nullptr && kind->table != "footprint";
}

/// A step of a camera's number over which its picture is nearly straight.
double camera_step(const Scene& scene, const ParameterId& id) {
  switch (camera_number_of(scene.camera, id)) {
    case azimuth_number:
    case elevation_number:
    case roll_number:
      return 0.02;
    case scale_number:
      return 1e-3 * *number_at(scene, id);
    case principal_x_number:
    case principal_y_number:
      return 0.1;
    default:
      return 1e-3;
  }
}

}  // namespace

SlabPlan slab_plan(const Scene& scene, const FilmGeometry& film, int threads) {
  using Item = SlabPlan::Item;
  SlabPlan plan;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const FilmSight sight = film_sight(scene, overview(film), false, threads);
  const double wind_km_s = carried_km_s(scene), top_km = top_of_light_km(scene);
  const double widest_px =
      0.5 * std::hypot(film.columns * film.cell_width_px, film.rows * film.cell_height_px);
  const double px = std::max(film.cell_width_px, film.cell_height_px);
  const int widest_cells = has_line_footprints(scene) ? kWidestRayCells : kWidestBeamCells;
  std::vector<Item> items;
  double max_px = 0.0;
  plan.slabs.resize(static_cast<std::size_t>(lines));
  for (int l = 0; l < lines; ++l) {
    const EmissionLine line = find_line(scene, scene.emission.lines[l]).value();
    if (is_prompt(line)) {
      items.push_back({l, -1, 1, 0.0});
      continue;
    }
    // Pixels to a kilometre, where the picture is nearest and farthest at a height that has much light.
    const SpreadRange per_km = spread_range(scene, sight, std::min(top_km, kBrightKm), 1.0);
    const double min_km = kMinSpreadPx * film.cell_height_px / std::max(per_km.max_px, 1e-9),
                 max_km = widest_px / std::max(per_km.min_px, 1e-9);
    plan.slabs[l] = altitude_slabs(spread_profile(line, 1e3 * wind_km_s), spread_profile(line, 0.0),
                                   min_km * min_km, max_km * max_km, top_km);
    for (std::size_t s = 0; s < plan.slabs[l].size(); ++s) {
      const AltitudeSlab& slab = plan.slabs[l][s];
      Item item{l, static_cast<int>(s), 1, 0.0};
      const SpreadRange range = spread_range(scene, sight, slab.altitude_km, slab.variance_km2);
      const double carried_km = wind_km_s * slab.lifetime_s;
      const SpreadRange way = spread_range(scene, sight, slab.altitude_km, carried_km * carried_km);
      while (2 * item.cells <= widest_cells && range.min_px >= kCellsToASpread * 2 * item.cells * px)
        item.cells *= 2;
      max_px = std::max(max_px, std::min(range.max_px, widest_px));
      item.margin_px = kReach * std::min(range.max_px, widest_px) + std::min(way.max_px, 2.0 * widest_px);
      items.push_back(item);
    }
  }
  plan.widest_px = std::max(max_px, kMinSpreadPx);

  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.cells < b.cells; });
  std::vector<double> margins;  // of the films
  for (std::size_t first = 0; first < items.size(); first += kMaxOfPass) {
    SlabPlan::Pass pass;
    pass.items.assign(
        items.begin() + static_cast<std::ptrdiff_t>(first),
        items.begin() + static_cast<std::ptrdiff_t>(std::min(first + kMaxOfPass, items.size())));
    const int wide = pass.items.front().cells;
    double margin_px = 0.0;
    for (const Item& item : pass.items) margin_px = std::max(margin_px, item.margin_px);
    while (pass.film < plan.films.size() && plan.films[pass.film].cells != wide) ++pass.film;
    if (pass.film == plan.films.size()) {
      plan.films.push_back({wide, {}});
      margins.push_back(0.0);
    }
    margins[pass.film] = std::max(margins[pass.film], margin_px);
    plan.passes.push_back(std::move(pass));
  }
  for (std::size_t f = 0; f < plan.films.size(); ++f)
    plan.films[f].film = widened(film, plan.films[f].cells, margins[f]);
  return plan;
}

double slab_bytes(const SlabPlan& plan, int free, int threads) {
  constexpr double kFloat = sizeof(float), kUnit = 8.0;
  const double slots = thread_count(threads);
  double most = 0.0, kept = 0.0;
  for (const SlabPlan::PassFilm& of : plan.films)
    kept += static_cast<double>(of.film.rows) * of.film.columns * slots * kMaxLines * kUnit;
  for (const SlabPlan::Pass& pass : plan.passes) {
    const FilmGeometry& film = plan.films[pass.film].film;
    const double cells = static_cast<double>(film.rows) * film.columns,
                 items = static_cast<double>(pass.items.size());
    const double width =
        free > 0 ? std::ceil(free / static_cast<double>(kTangentWidth)) * kTangentWidth : 0.0;
    // Light, that of volumes with their depth, derivatives (as shares of the beams too), places, a level's
    // film for each thread and its blur.
    most = std::max(
        most, cells * kFloat *
                  (items * (2.0 + 4.0 * 1.5) + 1.0 + (free > 0 ? items * (width + kTangentWidth) : 0.0) +
                   5.0 + 2.0 * slots * (free > 0 ? kTangentWidth : 1.0)));
  }
  return kept + most;
}

SlabExposer::SlabExposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond,
                         const BeamSampling& sampling)
    : film_(film),
      threads_(thread_count(threads)),
      lines_(static_cast<int>(scene.emission.lines.size())),
      plan_(slab_plan(scene, film, threads)),
      has_footprints_(has_line_footprints(scene)) {
  spread_ = std::make_unique<const SlabSpread>(film, plan_.widest_px);
  Scene plain = scene;  // beams and footprints, with all of the lines
  remove_emitters(plain);
  plain.footprints = scene.footprints;
  for (const SlabPlan::PassFilm& of : plan_.films)
    exposers_.push_back(std::make_unique<BeamExposer>(plain, of.film, threads, beyond, sampling));
  if (has_other_light(scene)) rest_ = std::make_unique<const Volumes>(rest_of(scene), threads_);

  const std::size_t sheets = scene.sheets.size();
  Group of_wind, of_ages;
  of_wind.sheets.assign(sheets, true);
  of_wind.has_footprints = has_footprints_;
  of_ages.is_calm = true;
  of_ages.sheets.assign(sheets, false);
  if (carried_km_s(scene) > 0.0 && !has_emitters_of_sheets(scene)) {
    const LightAges ages(scene);
    for (std::size_t s = 0; s < sheets; ++s)
      if (ages.lags(static_cast<int>(s))) {
        of_wind.sheets[s] = false;
        of_ages.sheets[s] = true;
      }
  }
  for (const Group& group : {of_wind, of_ages})
    if (group.has_footprints ||
        std::find(group.sheets.begin(), group.sheets.end(), true) != group.sheets.end())
      groups_.push_back(group);
}

Scene SlabExposer::part_of(const Scene& scene, const Pass& pass, bool has_footprints) const {
  Scene part = scene;
  part.emission.lines.clear();
  part.emission.altitude_share.clear();
  for (const Item& item : pass.items) {
    part.emission.lines.push_back(scene.emission.lines[item.line]);
    part.emission.altitude_share.push_back(item.slab < 0 ? whole_share()
                                                         : plan_.slabs[item.line][item.slab].share);
  }
  part.blur.width_deg.assign(pass.items.size(), 0.0);
  for (std::size_t s = 0; s < part.sheets.size(); ++s) {
    Sheet& sheet = part.sheets[s];
    if (sheet.spline_rate.empty()) continue;
    const auto knots = static_cast<std::ptrdiff_t>(sheet.spline_rate.size()) / lines_;
    const std::vector<double> all = sheet.spline_rate;
    sheet.spline_rate.clear();
    for (const Item& item : pass.items)
      sheet.spline_rate.insert(sheet.spline_rate.end(), all.begin() + item.line * knots,
                               all.begin() + (item.line + 1) * knots);
  }
  remove_emitters(part);
  if (has_footprints) part.footprints = scene.footprints;
  return part;
}

Scene SlabExposer::rest_of(const Scene& scene) const {
  Scene rest = scene;
  rest.emission.altitude_share.assign(scene.emission.lines.size(), nullptr);
  return rest;
}

SlabExposer::PassPlaces SlabExposer::places_of(const Scene& scene, const Pass& pass, bool is_calm) const {
  PassPlaces places;
  const FilmSight sight =
      film_sight(scene, plan_.films[pass.film].film, !is_calm && carried_km_s(scene) > 0.0, threads_);
  for (const Item& item : pass.items)
    places.of_item.push_back(
        spread_->places(scene, sight, item.slab < 0 ? AltitudeSlab{} : plan_.slabs[item.line][item.slab],
                        is_calm || item.slab < 0, threads_));
  return places;
}

void SlabExposer::add_line(const Pass& pass, const PassPlaces& places, int line, const float* planes,
                           std::size_t stride, int width, float* out) const {
  const FilmGeometry& film = plan_.films[pass.film].film;
  const std::size_t of_item = static_cast<std::size_t>(film.rows) * film.columns * stride;
  std::vector<SlabLight> light;
  for (std::size_t i = 0; i < pass.items.size(); ++i)
    if (pass.items[i].line == line)
      light.push_back({&film, &places.of_item[i], planes + i * of_item, stride});
  if (!light.empty()) spread_->add(light, width, out, threads_);
}

void SlabExposer::begin(Exposure& out) const {
  out.geometry = film_;
  out.lines = lines_;
  out.deflection_points = 0;
  out.free = out.free_stride = 0;
  out.volumes = {};
  out.rayleigh.assign(cells() * static_cast<std::size_t>(lines_), 0.0f);
  if (!has_footprints_ && !rest_) return;
  out.volumes.lines = lines_;
  out.volumes.rayleigh.assign(out.rayleigh.size(), 0.0f);
  out.volumes.depth_km.assign(cells(), std::numeric_limits<float>::infinity());
}

void SlabExposer::add_rest(const Scene& scene, Exposure& out, const std::atomic<bool>* stop,
                           bool whole_resolution) const {
  if (!rest_) return;
  const Scene rest = rest_of(scene);
  VolumeLight light = rest_->light(rest, film_, {}, stop, whole_resolution);
  for (std::size_t i = 0; i < light.rayleigh.size(); ++i) {
    out.rayleigh[i] += light.rayleigh[i];
    out.volumes.rayleigh[i] += light.rayleigh[i];
  }
  out.volumes.kept = std::move(light.kept);
  out.volumes.depth_km = std::move(light.depth_km);
}

void SlabExposer::expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
                         const std::atomic<bool>* stop, int only_sheet) {
  begin(out);
  const auto count = static_cast<double>(plan_.passes.size() * groups_.size());
  std::size_t done = 0;
  Exposure some;
  some.one_ray = out.one_ray;
  for (const Group& group : groups_) {
    const bool has_footprints = group.has_footprints && only_sheet < 0;
    for (const Pass& pass : plan_.passes) {
      std::function<void(double)> share;
      if (progress) share = [&](double of_pass) { progress((static_cast<double>(done) + of_pass) / count); };
      BeamExposer& exposer = *exposers_[pass.film];
      exposer.set_emitting(group.sheets, has_footprints);
      exposer.expose(part_of(scene, pass, has_footprints), some, share, stop, only_sheet);
      ++done;
      if (stop != nullptr && stop->load()) return;
      out.deflection_points = std::max(out.deflection_points, some.deflection_points);
      const PassPlaces places = places_of(scene, pass, group.is_calm);
      for (int l = 0; l < lines_; ++l) {
        add_line(pass, places, l, some.rayleigh.data(), 1, 1, out.rayleigh.data() + l * cells());
        if (has_footprints)
          add_line(pass, places, l, some.volumes.rayleigh.data(), 1, 1,
                   out.volumes.rayleigh.data() + l * cells());
      }
    }
  }
  if (only_sheet < 0)
    add_rest(scene, out, stop, out.one_ray);
  else
    out.volumes = {};
}

void SlabExposer::expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                                          Exposure& out) {
  begin(out);
  out.free = static_cast<int>(free.size());
  const std::size_t stride = (free.size() + kTangentWidth - 1) / kTangentWidth * kTangentWidth;
  out.free_stride = static_cast<int>(stride);
  out.derivative.assign(cells() * static_cast<std::size_t>(lines_) * stride, 0.0f);
  std::vector<ParameterId> known;  // of the parts
  std::vector<std::size_t> places_of_known;
  for (std::size_t j = 0; j < free.size(); ++j)
    if (!is_of_other_light(free[j])) {
      known.push_back(free[j]);
      places_of_known.push_back(j);
    }
  Exposure some;
  std::vector<float> spread, other;
  for (const Group& group : groups_)
    for (const Pass& pass : plan_.passes) {
      BeamExposer& exposer = *exposers_[pass.film];
      exposer.set_emitting(group.sheets, group.has_footprints);
      exposer.expose_with_derivatives(part_of(scene, pass, group.has_footprints), known, some);
      out.deflection_points = std::max(out.deflection_points, some.deflection_points);
      const PassPlaces places = places_of(scene, pass, group.is_calm);
      std::set<int> lines;
      for (const Item& item : pass.items) lines.insert(item.line);
      for (const int l : lines) {
        add_line(pass, places, l, some.rayleigh.data(), 1, 1, out.rayleigh.data() + l * cells());
        if (group.has_footprints)
          add_line(pass, places, l, some.volumes.rayleigh.data(), 1, 1,
                   out.volumes.rayleigh.data() + l * cells());
        float* of_line = out.derivative.data() + l * cells() * stride;
        for (std::size_t first = 0; first < known.size(); first += kTangentWidth) {
          const std::size_t count = std::min<std::size_t>(kTangentWidth, known.size() - first);
          spread.assign(cells() * count, 0.0f);
          add_line(pass, places, l, some.derivative.data() + first,
                   static_cast<std::size_t>(some.free_stride), static_cast<int>(count), spread.data());
          for (std::size_t cell = 0; cell < cells(); ++cell)
            for (std::size_t j = 0; j < count; ++j)
              of_line[cell * stride + places_of_known[first + j]] += spread[cell * count + j];
        }
      }
      // The camera says how widely the same light is spread.
      for (std::size_t j = 0; j < free.size(); ++j) {
        if (camera_number_of(scene.camera, free[j]) < 0) continue;
        const double step = camera_step(scene, free[j]);
        Scene moved = scene;
        *number_at(moved, free[j]) += step;
        const PassPlaces ahead = places_of(moved, pass, group.is_calm);
        *number_at(moved, free[j]) -= 2.0 * step;
        const PassPlaces behind = places_of(moved, pass, group.is_calm);
        for (const int l : lines) {
          if (plan_.slabs[l].empty()) continue;
          spread.assign(cells(), 0.0f);
          other.assign(cells(), 0.0f);
          add_line(pass, ahead, l, some.rayleigh.data(), 1, 1, spread.data());
          add_line(pass, behind, l, some.rayleigh.data(), 1, 1, other.data());
          float* of_line = out.derivative.data() + l * cells() * stride;
          for (std::size_t cell = 0; cell < cells(); ++cell)
            of_line[cell * stride + j] += static_cast<float>((spread[cell] - other[cell]) / (2.0 * step));
        }
      }
    }
  add_rest(scene, out, nullptr, true);
  if (rest_) rest_->add_light_derivatives(rest_of(scene), film_, free, stride, out.derivative.data());
}

void SlabExposer::expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                                  Exposure& out, int line) {
  begin(out);
  out.volumes = {};
  out.lines = static_cast<int>(rates.size());
  out.rayleigh.assign(cells() * rates.size(), 0.0f);
  const bool is_calm = std::any_of(groups_.begin(), groups_.end(),
                                   [&](const Group& g) { return g.is_calm && g.sheets[sheet]; });
  Exposure some;
  for (const Pass& pass : plan_.passes) {
    PassPlaces places;
    for (std::size_t i = 0; i < pass.items.size(); ++i) {
      const Item& item = pass.items[i];
      if (item.line != line) continue;
      const std::vector<float>& share =
          item.slab < 0 ? *whole_share() : *plan_.slabs[item.line][item.slab].share;
      std::vector<std::vector<float>> own;
      std::vector<std::size_t> of_rate;
      for (std::size_t r = 0; r < rates.size(); ++r) {
        std::vector<float> rate = rates[r];
        bool any = false;
        for (std::size_t a = 0; a < rate.size(); ++a) {
          rate[a] *= share[a % HeightProfile::kAltitudes];
          any = any || rate[a] != 0.0f;
        }
        if (!any) continue;
        own.push_back(std::move(rate));
        of_rate.push_back(r);
      }
      if (own.empty()) continue;
      if (places.of_item.empty()) places = places_of(scene, pass, is_calm);
      const FilmGeometry& on = plan_.films[pass.film].film;
      exposers_[pass.film]->expose_profiles(scene, sheet, own, some);
      out.deflection_points += some.deflection_points;
      for (std::size_t k = 0; k < own.size(); ++k)
        spread_->add({{&on, &places.of_item[i], some.rayleigh.data() + k * some.cells(), 1}}, 1,
                     out.rayleigh.data() + of_rate[k] * cells(), threads_);
    }
  }
}

std::vector<float> SlabExposer::split_by_age(int sheet, double wavelength_nm,
                                             const std::vector<float>& rates) const {
  return exposers_.front()->split_by_age(sheet, wavelength_nm, rates);
}

}  // namespace vegard::sim
