// How the noise of a picture falls with the number of its beams, and what is left between beams and the
// integral along lines of sight. Prints a table; with --plot OUT.svg draws it.
//
// The scene is a sheet whose electrons are not deflected, for which the integral is exact (see
// tests/support/line_of_sight.h). Noise is the scatter between eight seeds, in the mean over blocks of 8 x 8
// pixels, relative to the picture's root mean square; a difference from the integral that is no noise would
// stay where it is as beams are added.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "sim/render/film.h"
#include "tests/support/block_means.h"
#include "tests/support/kind_named.h"

namespace vegard::bench {
namespace {

constexpr int kSeeds = 8;
constexpr int kLine = 1;  // 557.7 nm

struct Rule {
  const char *name, *words;
  double jitter;
};

struct Point {
  int beams;
  double noise, difference;  ///< relative
};

Point measure(int beams, const Rule& rule, const std::vector<double>& truth) {
  std::vector<std::vector<double>> of_seed;
  for (int s = 0; s < kSeeds; ++s) {
    sim::Scene scene = tests::undeflected_scene(beams);
    scene.seed = 100 + s;
    scene.sheets[0].spacing_rule = tests::kind_named<sim::SpacingRule>(rule.name);
    scene.sheets[0].spacing_jitter = rule.jitter;
    of_seed.push_back(tests::blocks_by_beams(scene, kLine));
  }
  return {beams, tests::relative_scatter(of_seed, truth), tests::relative_rms(of_seed[0], truth)};
}

fit::Series series(const std::string& label, int colour, fit::Mark mark, const std::vector<Point>& points,
                   double Point::*number) {
  fit::Series s;
  s.label = label;
  s.colour = fit::distinct_colour(colour);
  s.mark = mark;
  for (const Point& p : points) {
    s.x.push_back(std::log10(p.beams));
    s.y.push_back(std::log10(p.*number));
  }
  return s;
}

}  // namespace
}  // namespace vegard::bench

int main(int argc, char** argv) {
  using namespace vegard;
  using namespace vegard::bench;
  const std::vector<double> truth = tests::blocks_by_lines_of_sight(tests::undeflected_scene(1), kLine);
  const std::vector<Rule> rules = {{"stratified", "stratified, j = 0.5", 0.5},
                                   {"stratified", "even, j = 0", 0.0},
                                   {"tied", "tied walk, j = 0.5", 0.5}};
  fit::Plot plot;
  plot.title = "Noise against the number of beams";
  plot.note = "8 x 8 pixels, 557.7 nm, relative; scatter of eight seeds";
  fit::Panel panel;
  panel.x.label = "log10(beams per layer)";
  panel.y.label = "log10(relative error)";
  int colour = 0;
  for (const Rule& rule : rules) {
    std::vector<Point> points;
    for (int beams = 64; beams <= 65536; beams *= 4) {
      points.push_back(measure(beams, rule, truth));
      const Point& p = points.back();
      fmt::print("{:28} {:6} beams: noise {:.5f}, off the integral by {:.5f}", rule.words, beams, p.noise,
                 p.difference);
      if (points.size() > 1) {
        const double slope = std::log(p.noise / points[points.size() - 2].noise) / std::log(4.0);
        fmt::print(", noise falls as n^{:.2f}", slope);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
    panel.series.push_back(series(rule.words, colour++, fit::Mark::line, points, &Point::noise));
    if (&rule == &rules.front()) {
      std::vector<Point> root = points;
      for (Point& p : root)
        p.noise = points[0].noise * std::sqrt(static_cast<double>(points[0].beams) / p.beams);
      panel.series.push_back(series("off the integral", 5, fit::Mark::points, points, &Point::difference));
      panel.series.back().width_px = 5.0;
      panel.series.push_back(series("1/√n", 6, fit::Mark::dashed_line, root, &Point::noise));
    }
  }
  plot.panels.push_back(panel);
  if (argc == 3 && std::string(argv[1]) == "--plot") std::ofstream(argv[2]) << fit::plot_svg(plot);
  return 0;
}
