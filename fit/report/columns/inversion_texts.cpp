#include "fit/report/columns/inversion_texts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fit/answer/tables_correction.h"
#include "sim/base/file/netcdf_dataset.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/version.h"

namespace vegard::fit {

namespace {

using Json = nlohmann::ordered_json;

struct UnknownWords {
  const char* words;
  const char* key;
};
constexpr UnknownWords kUnknownWords[kColumnUnknowns] = {{"E0 (keV)", "energy_kev"},
                                                         {"energy flux (mW m⁻²)", "energy_flux_mw_m2"},
                                                         {"oxygen factor", "oxygen_factor"},
                                                         {"soft flux / rest", "soft_ratio"}};
constexpr std::size_t kShownOrder[kColumnUnknowns] = {kLnFlux, kLnEnergy, kLnOxygen, kLnSoft};

std::string column_interval_text(const OpenInterval& interval) {
  if (interval.lower && interval.upper)
    return fmt::format("{:.4g} to {:.4g}", *interval.lower, *interval.upper);
  if (interval.upper) return fmt::format("below {:.4g}", *interval.upper);
  if (interval.lower) return fmt::format("above {:.4g}", *interval.lower);
  return "any of the tables'";
}

/// Padded by characters, of which a sign such as ² has several bytes.
std::string padded(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
  return text + std::string(characters < width ? width - characters : 1, ' ');
}

std::string chance_text(double chance) {
  const double per_cent = 100.0 * chance;
  if (per_cent < 0.01) return "below 0.01 %";
  return per_cent < 1.0 ? fmt::format("{:.2f} %", per_cent) : fmt::format("{:.0f} %", per_cent);
}

std::string solution_text(const ColumnInversion& inversion, const ColumnSolution& solution) {
  std::string text = padded("", 24) + padded("value", 11) + padded("68 %", 20) + "95 %\n";
  for (const std::size_t k : kShownOrder) {
    const ColumnEstimate& e = solution.of[k];
    if (!e.is_free && (k == kLnOxygen || k == kLnSoft) && e.value == 1.0) continue;
    text += "  " + padded(kUnknownWords[k].words, 22) + padded(fmt::format("{:.4g}", e.value), 11);
    text += e.is_free
                ? padded(column_interval_text(e.interval68), 20) + column_interval_text(e.interval95) + "\n"
                : "held\n";
  }
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    text += fmt::format("  {:.1f} nm: {:.5g} ± {:.3g} R, by these electrons {:.5g} R ({:+.1f} σ)\n",
                        inversion.lines_nm[l], inversion.data.rayleigh[l], inversion.data.sigma[l],
                        solution.rayleigh[l],
                        (inversion.data.rayleigh[l] - solution.rayleigh[l]) / inversion.data.sigma[l]);
  return text;
}

Json interval_json(const OpenInterval& interval) {
  return {interval.lower ? Json(*interval.lower) : Json(nullptr),
          interval.upper ? Json(*interval.upper) : Json(nullptr)};
}

Json solution_json(const ColumnSolution& solution, bool has_soft) {
  Json json;
  for (const std::size_t k : kShownOrder) {
    const ColumnEstimate& e = solution.of[k];
    if (k == kLnSoft && !has_soft) continue;
    Json one = {{"value", e.value}, {"free", e.is_free}};
    if (e.is_free) {
      one["sigma_ln"] = e.sigma_ln;
      one["sigma_ln_if_others_known"] = e.sigma_ln_alone;
      one["interval68"] = interval_json(e.interval68);
      one["interval95"] = interval_json(e.interval95);
    }
    json[kUnknownWords[k].key] = one;
  }
  json["chi2"] = solution.chi2;
  json["correlations"] = Json::object();
  for (std::size_t a = 0; a < kColumnUnknowns; ++a)
    for (std::size_t b = a + 1; b < kColumnUnknowns; ++b)
      if (solution.of[a].is_free && solution.of[b].is_free)
        json["correlations"][std::string(kUnknownWords[a].key) + "," + kUnknownWords[b].key] =
            solution.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  json["rayleigh"] = solution.rayleigh;
  json["corrections"] = Json::array();
  for (const LineCorrection& line : solution.corrections)
    json["corrections"].push_back({{"factor", line.factor},
                                   {"sigma_ln", line.ln_sigma},
                                   {"sigma_ln_of_tables", line.ln_sigma_of_tables}});
  return json;
}

struct MapPlane {
  const char* name;
  const char* long_name;
  const char* unit;
  const std::vector<float> ColumnMaps::*values;
};
constexpr std::array<MapPlane, 9> kPlanes = {
    {{"energy_flux", "energy flux of the electrons", "mW m-2", &ColumnMaps::flux_mw_m2},
     {"energy", "characteristic energy E0 of the electrons", "keV", &ColumnMaps::energy_kev},
     {"energy_flux_error", "relative standard error of energy_flux", "1", &ColumnMaps::relative_flux_error},
     {"ln_energy_error", "standard error of the logarithm of energy", "1", &ColumnMaps::ln_energy_error},
     {"oxygen_factor", "factor of atomic oxygen", "1", &ColumnMaps::oxygen_factor},
     {"ln_oxygen_error", "standard error of the logarithm of oxygen_factor", "1",
      &ColumnMaps::ln_oxygen_error},
     {"other_energy", "energy of a second solution", "keV", &ColumnMaps::other_energy_kev},
     {"chi2", "chi2 of the brightnesses", "1", &ColumnMaps::chi2},
     {"consistency", "probability of so large a chi2 by chance; exp(-chi2/2) without a degree of freedom",
      "1", &ColumnMaps::consistency}}};
/// Behind the quality, where there is a soft component.
constexpr std::array<MapPlane, 2> kSoftPlanes = {
    {{"soft_ratio", "energy flux of the soft component over that of the rest", "1", &ColumnMaps::soft_ratio},
     {"ln_soft_error", "standard error of the logarithm of soft_ratio", "1", &ColumnMaps::ln_soft_error}}};

constexpr std::array<ColumnVerdict, 8> kQualities = {
    ColumnVerdict::well_constrained, ColumnVerdict::loosely_constrained, ColumnVerdict::one_sided,
    ColumnVerdict::two_solutions,    ColumnVerdict::contradiction,       ColumnVerdict::no_light,
    ColumnVerdict::not_measured,     ColumnVerdict::other_spectrum};

std::string quality_words() {
  std::string words;
  for (const ColumnVerdict verdict : kQualities)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", static_cast<int>(verdict),
                         column_verdict_name(verdict));
  return words;
}

constexpr int kAcross = 240, kDown = 200;
struct ContourLevel {
  double rise;
  const char* label;
  double width_px;
};
constexpr std::array<ContourLevel, 3> kLevels = {
    {{2.30, "68 %", 2.4}, {6.18, "95 %", 1.7}, {11.83, "99.7 %", 1.0}}};
constexpr double kLogAxis = 1.6;     // of a logarithm: wider axes are logarithmic
constexpr double kMinMargin = 0.15;  // of a logarithm, about the intervals

/// An axis of an unknown, whose limits are logarithms.
struct UnknownAxis {
  double least = 1e9, most = -1e9;

  bool is_log() const { return most - least > kLogAxis; }
  double at(double share) const { return least + (most - least) * share; }
  double shown(double ln) const { return is_log() ? ln / std::log(10.0) : std::exp(ln); }
};

/// All solutions' 95 % intervals with as much again on both sides, inside the tables.
UnknownAxis unknown_axis(const ColumnModel& model, const ColumnInversion& inversion, std::size_t k) {
  UnknownAxis axis;
  for (const ColumnSolution& s : inversion.solutions) {
    const OpenInterval& interval = s.of[k].interval95;
    axis.least = std::min(axis.least, interval.lower ? std::log(*interval.lower) : model.least(k));
    axis.most = std::max(axis.most, interval.upper ? std::log(*interval.upper) : model.most(k));
  }
  const double margin = std::max(kMinMargin, 0.7 * (axis.most - axis.least));
  axis.least = std::max(model.least(k), axis.least - margin);
  axis.most = std::min(model.most(k), axis.most + margin);
  return axis;
}

/// chi2 on a grid, even in the logarithms of energy (to the right) and flux (upwards).
struct ChiGrid {
  UnknownAxis energy, flux;
  std::vector<double> value;  ///< [row * kAcross + column]
  double ln_energy(double column) const { return energy.at(column / (kAcross - 1)); }
  double ln_flux(double row) const { return flux.at(row / (kDown - 1)); }
};

using AxisPoint = std::pair<double, double>;  // as the axes show it

/// A piece of a contour inside of one cell of the grid; its ends lie on edges of the grid, by their numbers.
struct ContourPiece {
  std::array<std::size_t, 2> edge{};
  std::array<AxisPoint, 2> end;
};

std::vector<ContourPiece> contour_pieces(const ChiGrid& grid, double level) {
  std::vector<ContourPiece> pieces;
  const auto at = [&](int column, int row) {
    return grid.value[static_cast<std::size_t>(row) * kAcross + column] - level;
  };
  for (int row = 0; row + 1 < kDown; ++row)
    for (int column = 0; column + 1 < kAcross; ++column) {
      // The lower, right, upper and left edge: where they begin, to the right or upwards.
      constexpr std::array<std::array<int, 3>, 4> kEdges = {{{0, 0, 0}, {1, 0, 1}, {0, 1, 0}, {0, 0, 1}}};
      ContourPiece piece;
      std::size_t ends = 0;
      for (const auto& [right, up, upwards] : kEdges) {
        const int x = column + right, y = row + up;
        const double a = at(x, y), b = at(x + 1 - upwards, y + upwards);
        if ((a < 0.0) == (b < 0.0)) continue;
        const double t = a / (a - b);
        piece.edge[ends] = 2 * (static_cast<std::size_t>(y) * kAcross + x) + upwards;
        piece.end[ends] = {grid.energy.shown(grid.ln_energy(x + t * (1 - upwards))),
                           grid.flux.shown(grid.ln_flux(y + t * upwards))};
        if (++ends < 2) continue;
        pieces.push_back(piece);
        ends = 0;
      }
    }
  return pieces;
}

/// The contour by marching squares, its pieces one behind another.
void add_contour(const ChiGrid& grid, double level, Series& series) {
  const std::vector<ContourPiece> pieces = contour_pieces(grid, level);
  std::multimap<std::size_t, std::size_t> at_edge;
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const std::size_t edge : pieces[p].edge) at_edge.emplace(edge, p);
  std::vector<bool> drawn(pieces.size(), false);
  const auto put = [&](const AxisPoint& point) {
    series.x.push_back(point.first);
    series.y.push_back(point.second);
  };
  // The pieces from `piece` on, entered at its end `from`.
  const auto follow = [&](std::size_t piece, std::size_t from) {
    put(pieces[piece].end[from]);
    for (bool goes_on = true; goes_on;) {
      drawn[piece] = true;
      const std::size_t edge = pieces[piece].edge[1 - from];
      put(pieces[piece].end[1 - from]);
      goes_on = false;
      const auto [first, last] = at_edge.equal_range(edge);
      for (auto next = first; next != last && !goes_on; ++next) {
        if (drawn[next->second]) continue;
        piece = next->second;
        from = pieces[piece].edge[0] == edge ? 0 : 1;
        goes_on = true;
      }
    }
    put({sim::kNaN, sim::kNaN});
  };
  // First those that begin at the frame.
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const std::size_t from : {0u, 1u})
      if (!drawn[p] && at_edge.count(pieces[p].edge[from]) == 1) follow(p, from);
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (!drawn[p]) follow(p, 0);
}

/// The energy flux at which one line has its brightness, by energy.
Series line_series(const ColumnChi2& chi2, const ColumnInversion& inversion, std::size_t line,
                   const ChiGrid& grid) {
  Series series;
  series.label = fmt::format("{:.1f} nm alone", inversion.lines_nm[line]);
  series.colour = line_ink(inversion.lines_nm[line]);
  series.mark = Mark::dashed_line;
  const ColumnModel& model = chi2.model();
  const ColumnSolution& best = inversion.solutions.front();
  const double ln_oxygen = std::log(best.of[kLnOxygen].value), ln_soft = std::log(best.of[kLnSoft].value);
  const double wanted = std::log(inversion.data.rayleigh[line]);
  for (int column = 0; column < kAcross; ++column) {
    const double ln_energy = grid.ln_energy(column);
    double ln_flux = 0.0;
    for (int round = 0; round < 20; ++round)
      ln_flux =
          std::clamp(ln_flux + wanted - model.at(line, {ln_energy, ln_flux, ln_oxygen, ln_soft}).ln_rayleigh,
                     model.least(kLnFlux), model.most(kLnFlux));
    const bool inside = ln_flux > grid.flux.least && ln_flux < grid.flux.most;
    series.x.push_back(grid.energy.shown(ln_energy));
    series.y.push_back(inside ? grid.flux.shown(ln_flux) : sim::kNaN);
  }
  return series;
}

/// Limits, and of a logarithmic axis ticks at 1, 2 and 5 times powers of ten.
void put_limits(const UnknownAxis& unknown, Axis& axis) {
  axis.min = unknown.shown(unknown.least);
  axis.max = unknown.shown(unknown.most);
  if (!unknown.is_log()) return;
  for (int power = static_cast<int>(std::floor(*axis.min)); power <= *axis.max; ++power)
    for (const double first : {1.0, 2.0, 5.0}) {
      const double place = power + std::log10(first);
      if (place < *axis.min || place > *axis.max) continue;
      axis.tick_places.push_back(place);
      axis.tick_labels.push_back(fmt::format("{:g}", first * std::pow(10.0, power)));
    }
}

}  // namespace

std::string inversion_text(const ColumnInversion& inversion, const InversionFacts& facts) {
  std::string text = fmt::format(
      "electrons: {}{}, tables {}\n", facts.spectrum,
      facts.soft_kev > 0.0 ? fmt::format(" and a Maxwellian of {:g} keV", facts.soft_kev) : "", facts.tables);
  for (std::size_t s = 0; s < inversion.solutions.size(); ++s) {
    const ColumnSolution& solution = inversion.solutions[s];
    if (inversion.solutions.size() > 1)
      text += fmt::format("solution {}: chi² {:.3g}\n", s + 1, solution.chi2);
    text += solution_text(inversion, solution);
  }
  const ColumnSolution& best = inversion.solutions.front();
  text += fmt::format("chi² {:.3g}, {} degree{} of freedom", best.chi2, inversion.degrees_of_freedom,
                      inversion.degrees_of_freedom == 1 ? "" : "s");
  if (inversion.degrees_of_freedom > 0)
    text += " (so much or more by chance: " + chance_text(inversion.p_value) + ")";
  else if (inversion.verdict != ColumnVerdict::contradiction)
    text += ": whether the lines agree is not known";
  text += "\n";
  for (std::size_t a = 0; a < kColumnUnknowns; ++a)
    for (std::size_t b = a + 1; b < kColumnUnknowns; ++b)
      if (best.of[a].is_free && best.of[b].is_free)
        text += fmt::format("correlation of ln {} and ln {}: {:+.2f}\n", kUnknownWords[a].words,
                            kUnknownWords[b].words,
                            best.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
  text += fmt::format("verdict: {}; {}\n", column_verdict_name(inversion.verdict), inversion.reason);
  for (const std::string& words : inversion.degeneracies) text += words + "\n";
  for (const SpectrumTrial& trial : inversion.spectra)
    text += fmt::format("with {}: chi² {:.3g}, E0 {:.3g} keV, energy flux {:.3g} mW m⁻²\n", trial.words,
                        trial.chi2, trial.energy_kev, trial.energy_flux_mw_m2);
  for (std::size_t l = 0; l < best.corrections.size(); ++l) {
    const LineCorrection& line = best.corrections[l];
    text += correction_words(fmt::format("{:.1f} nm", inversion.lines_nm[l]), line.factor, line.ln_sigma,
                             line.ln_sigma_of_tables) +
            "\n";
  }
  if (facts.model_error == 0.0 && best.corrections.empty())
    text += "errors of the tables are not in this: see --model-error\n";
  return text;
}

std::string inversion_json(const ColumnInversion& inversion, const InversionFacts& facts) {
  Json json;
  json["kind"] = "vegard invert";
  json["version"] = sim::version();
  json["spectrum"] = facts.spectrum;
  if (facts.soft_kev > 0.0) json["soft_kev"] = facts.soft_kev;
  json["tables"] = facts.tables;
  json["model_error"] = facts.model_error;
  json["uncertainty"] = facts.uncertainty;
  json["lines"] = Json::array();
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    json["lines"].push_back({{"wavelength_nm", inversion.lines_nm[l]},
                             {"rayleigh", inversion.data.rayleigh[l]},
                             {"sigma_rayleigh", inversion.data.sigma[l]}});
  json["verdict"] = column_verdict_name(inversion.verdict);
  json["reason"] = inversion.reason;
  json["degrees_of_freedom"] = inversion.degrees_of_freedom;
  json["chance"] = inversion.degrees_of_freedom > 0 ? Json(inversion.p_value) : Json(nullptr);
  json["degeneracies"] = inversion.degeneracies;
  json["spectra"] = Json::array();
  for (const SpectrumTrial& trial : inversion.spectra)
    json["spectra"].push_back({{"words", trial.words},
                               {"chi2", trial.chi2},
                               {"energy_kev", trial.energy_kev},
                               {"energy_flux_mw_m2", trial.energy_flux_mw_m2},
                               {"soft_ratio", trial.soft_ratio ? Json(*trial.soft_ratio) : Json(nullptr)}});
  json["solutions"] = Json::array();
  for (const ColumnSolution& solution : inversion.solutions)
    json["solutions"].push_back(solution_json(solution, facts.soft_kev > 0.0));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string encode_column_maps(const ColumnMaps& maps, const InversionFacts& facts, const std::string& name) {
  const std::vector<float> quality(maps.quality.begin(), maps.quality.end());
  std::vector<std::string> names;
  std::vector<const std::vector<float>*> planes;
  std::vector<sim::FitsKeyword> keywords;
  const auto add = [&](const std::string& plane, const std::string& words, const std::vector<float>& values) {
    names.push_back(plane);
    planes.push_back(&values);
    keywords.push_back({fmt::format("PLANE{}", names.size()), words, ""});
  };
  const auto add_plane = [&](const MapPlane& plane) {
    add(plane.name, fmt::format("{}, {}", plane.long_name, plane.unit), maps.*plane.values);
  };
  for (const MapPlane& plane : kPlanes) add_plane(plane);
  add("quality", "quality: " + quality_words(), quality);
  if (facts.soft_kev > 0.0)
    for (const MapPlane& plane : kSoftPlanes) add_plane(plane);
  sim::Image image(static_cast<int>(maps.width), static_cast<int>(maps.height), names);
  for (std::size_t i = 0; i < maps.width * maps.height; ++i)
    for (std::size_t p = 0; p < planes.size(); ++p) image.data[i * planes.size() + p] = (*planes[p])[i];
  keywords.push_back({"SPECTRUM", facts.spectrum, "of the electrons"});
  keywords.push_back({"TABLES", facts.tables, "emission tables"});
  keywords.push_back({"MODELERR", facts.model_error, "error of the tables, share of a line"});
  keywords.push_back({"ORIGIN", "vegard " + sim::version(), ""});
  return sim::encode_fits(image, keywords, name);
}

void write_column_maps_netcdf(const ColumnMaps& maps, const InversionFacts& facts, const std::string& path,
                              const std::string& shown_name) {
  sim::NetcdfDataset dataset(
      "energy and energy flux of electrons by line brightnesses",
      "vegard " + sim::version() + ", electrons: " + facts.spectrum + ", emission tables: " + facts.tables);
  dataset.attribute("model_error", fmt::format("{:g}", facts.model_error));
  dataset.attribute("comment", "rows from the top of the line maps down");
  dataset.dimension("y", maps.height);
  dataset.dimension("x", maps.width);
  const auto add = [&](const MapPlane& p) {
    const std::vector<float>& values = maps.*p.values;
    dataset.real(p.name, p.long_name, p.unit, {"y", "x"}, std::vector<double>(values.begin(), values.end()));
  };
  for (const MapPlane& plane : kPlanes) add(plane);
  if (facts.soft_kev > 0.0)
    for (const MapPlane& plane : kSoftPlanes) add(plane);
  std::vector<std::string> words;
  for (const ColumnVerdict verdict : kQualities) words.emplace_back(column_verdict_name(verdict));
  dataset.flags("quality", "quality of a pixel", words, {"y", "x"},
                std::vector<int>(maps.quality.begin(), maps.quality.end()));
  dataset.write(path, shown_name);
}

std::string column_maps_text(const ColumnMaps& maps) {
  std::array<std::size_t, kQualities.size()> counts{};
  for (const std::uint8_t quality : maps.quality) ++counts[quality];
  std::string text = fmt::format("{} x {} pixels\n", maps.width, maps.height);
  for (const ColumnVerdict verdict : kQualities)
    text +=
        fmt::format("  {:>9}  {}\n", counts[static_cast<std::size_t>(verdict)], column_verdict_name(verdict));
  if (most_contradict(maps))
    text +=
        "verdict: most of the pixels with light contradict the tables or ask for another spectrum, so that "
        "the "
        "others are doubtful\n";
  return text;
}

Plot inversion_plot(const ColumnChi2& chi2, const ColumnInversion& inversion, const std::string& note) {
  const ColumnModel& model = chi2.model();
  const ColumnSolution& best = inversion.solutions.front();
  const ColumnFreedom others = {false, false, chi2.free()[kLnOxygen], chi2.free()[kLnSoft]};
  ChiGrid grid{unknown_axis(model, inversion, kLnEnergy), unknown_axis(model, inversion, kLnFlux), {}};
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const ColumnPoint point = {grid.ln_energy(column), grid.ln_flux(row),
                                 std::log(best.of[kLnOxygen].value), std::log(best.of[kLnSoft].value)};
      grid.value.push_back(chi2.descend(inversion.data, point, others).chi2);
    }
  Panel panel;
  panel.x.label = "characteristic energy E0 (keV)";
  panel.y.label = "energy flux (mW m⁻²)";
  put_limits(grid.energy, panel.x);
  put_limits(grid.flux, panel.y);
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l)
    if (inversion.data.rayleigh[l] > 0.0) panel.series.push_back(line_series(chi2, inversion, l, grid));
  for (const ContourLevel& level : kLevels) {
    Series series;
    series.label = level.label;
    series.colour = {20, 20, 20};
    series.width_px = level.width_px;
    add_contour(grid, inversion.solutions.front().chi2 + level.rise, series);
    if (!series.x.empty()) panel.series.push_back(series);
  }
  Series dots;
  dots.label = inversion.solutions.size() > 1 ? "solutions" : "solution";
  dots.colour = distinct_colour(3);
  dots.mark = Mark::points;
  dots.width_px = 7.0;
  for (const ColumnSolution& s : inversion.solutions) {
    dots.x.push_back(grid.energy.shown(std::log(s.of[kLnEnergy].value)));
    dots.y.push_back(grid.flux.shown(std::log(s.of[kLnFlux].value)));
  }
  panel.series.push_back(dots);
  Plot plot;
  plot.title = std::string("Energy and energy flux by lines: ") + column_verdict_name(inversion.verdict);
  plot.note = note;
  plot.panels = {panel};
  plot.panel_width_px = 560;
  plot.panel_height_px = 400;
  return plot;
}

}  // namespace vegard::fit
