#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/earth.h"
#include "sim/scene/structs/footprint_size.h"
#include "sim/scene/structs/node_names.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/value_check.h"
#include "sim/scene/table/value_words.h"

namespace vegard::sim {
namespace {

using Refuse = std::function<void(const Complaint&, const std::string& key)>;

/// That no map, and no curve, takes more memory than a machine has.
void check_size(const Footprint& f, const Refuse& refuse) {
  const bool is_shell = f.shape == FootprintShape::shell, of_spline = f.source == FootprintSource::spline;
  if (of_spline && spline_pieces(f) > kMostSplinePieces)
    refuse({"the spline would be drawn in " + short_real_text(spline_pieces(f)) + " pieces of " +
                short_real_text(longest_piece_km(f)) + " km",
            "at most 1048576", "a larger width_km, larger cells, or points nearer to each other"},
           is_shell ? "longitude_deg" : "east_km");
  if (f.model == FootprintModel::curtain) return;
  if (!is_shell && longest_side_cells(f) > kMostSideCells)
    refuse({"the box has " + short_real_text(longest_side_cells(f)) + " cells along a side", "at most 262000",
            "a larger cell_km, or a smaller size_km"},
           "cell_km");
  if (!is_shell && map_cells(f) > kMostBoxCells)
    refuse({"the box has more than 67108864 cells: " + short_real_text(map_cells(f)),
            "a larger cell_km, or a smaller size_km", ""},
           "cell_km");
  const double bytes = map_cells(f) * bytes_per_cell(f, sizeof(double));
  if (bytes > kMostMapBytes)
    refuse({"the footprint's map would take " + short_real_text(std::round(bytes * 1e-8) * 0.1) + " GB, " +
                short_real_text(bytes_per_cell(f, sizeof(double))) + " bytes a cell",
            "at most 4 GB", is_shell ? "fewer face_cells" : "a larger cell_km, or a smaller size_km"},
           is_shell ? "face_cells" : "cell_km");
}

/// Between neighbours a quarter of the way round or more apart, a spline would leave the sphere too far to be
/// drawn back to it.
void check_points_of_shell(const Footprint& f, const Refuse& refuse) {
  const auto unit = [&](std::size_t i) {
    const double latitude = f.latitude_deg[i] * kRadiansPerDegree,
                 longitude = f.longitude_deg[i] * kRadiansPerDegree;
    return std::array<double, 3>{std::cos(latitude) * std::cos(longitude),
                                 std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
  };
  const std::size_t n = f.latitude_deg.size();
  for (std::size_t i = 0; i < (f.closed ? n : n - 1); ++i) {
    const std::size_t next = (i + 1) % n;
    const std::array<double, 3> a = unit(i), b = unit(next);
    const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (cosine > 1e-9) continue;
    const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadiansPerDegree;
    refuse({"points " + std::to_string(i) + " and " + std::to_string(next) + " are " +
                short_real_text(std::round(degrees * 10.0) * 0.1) + " degrees apart on the globe",
            "neighbours less than 90 degrees apart" +
                std::string(f.closed ? ", the last and the first of a closed curve too" : ""),
            "more points between them"},
           "longitude_deg");
  }
}

void check_footprint(const Scene& scene, const Footprint& f) {
  const std::string path = "footprint." + f.name + ".";
  const auto refuse = [&](const Complaint& complaint, const std::string& key) {
    complain(complaint, {scene.file, 0, path + key});
  };
  const bool is_shell = f.shape == FootprintShape::shell;
  const auto &x = is_shell ? f.longitude_deg : f.east_km, &y = is_shell ? f.latitude_deg : f.north_km;
  const char *x_key = is_shell ? "longitude_deg" : "east_km", *y_key = is_shell ? "latitude_deg" : "north_km";
  if (f.source == FootprintSource::spline) {
    if (x.size() != y.size())
      refuse({std::to_string(x.size()) + " of " + x_key + " for " + std::to_string(y.size()) + " of " + y_key,
              "as many of one as of the other", ""},
             y_key);
    if (x.size() < 2 || x.size() > 1000)
      refuse({"a spline through " + std::to_string(x.size()) + " points",
              std::string(x_key) + " and " + y_key + " of 2 to 1000 points", ""},
             x_key);
    if (is_shell) check_points_of_shell(f, refuse);
  }
  for (const auto& [list, key] : {std::pair{&f.point_energy, "point_energy"}, {&f.point_flux, "point_flux"}})
    if (!list->empty() && (f.source != FootprintSource::spline || list->size() != x.size()))
      refuse({std::to_string(list->size()) + " numbers for " +
                  std::to_string(f.source == FootprintSource::spline ? x.size() : 0) + " points of a spline",
              "one for every point, or none", ""},
             key);
  if (f.model == FootprintModel::curtain && f.source != FootprintSource::spline)
    refuse({"a curtain stands on a spline, not on a footprint of " + quoted_text(word_of(f.source)),
            "source = \"spline\"", "or model = \"volume\""},
           "model");
  const bool of_file = f.source == FootprintSource::image || f.source == FootprintSource::cube;
  if (of_file && f.image.empty())
    refuse(
        {"the footprint is to come from a picture, but image names none", "image = \"a picture's name\"", ""},
        "source");
  if (f.source == FootprintSource::cube && (!is_shell || f.image.find("{face}") == std::string::npos))
    refuse(
        {is_shell ? "'" + f.image + "' does not say where the face's name stands" : "a box has no cube faces",
         is_shell ? "a name such as \"foot_{face}.png\"" : "shape = \"shell\"", ""},
        is_shell ? "image" : "source");
  if (is_shell && (f.source == FootprintSource::sheets || f.source == FootprintSource::noise))
    refuse({"a footprint of " + quoted_text(word_of(f.source)) + " is a box's", "shape = \"box\"", ""},
           "source");
  if (f.source == FootprintSource::sheets && scene.sheets.empty())
    refuse({"the footprint is to be that of the sheets, but there are none", "a [[sheet]], or another source",
            ""},
           "source");
  if (is_shell && f.flow_turns > 0.0)
    refuse({"a flow is of a plane, and a shell has none", "flow_turns = 0, or shape = \"box\"", ""},
           "flow_turns");
  check_size(f, refuse);
  if (f.low_km >= f.high_km) refuse({"low_km is not below high_km", "low_km below high_km", ""}, "low_km");
}

/// Names of nodes must be there, and no node may stand on itself.
void check_nodes(const Scene& scene) {
  constexpr std::size_t kMostNodes = 1000;
  constexpr double kMostAsked = 10000.0;
  if (scene.nodes.size() > kMostNodes)
    complain({std::to_string(scene.nodes.size()) + " nodes", "at most " + std::to_string(kMostNodes), ""},
             {scene.file, 0, "node." + scene.nodes[kMostNodes].name + ".name"});
  const auto index_of = [&](const std::string& name) {
    const auto found =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
    return static_cast<std::size_t>(found - scene.nodes.begin());
  };
  for (const Node& node : scene.nodes) {
    const std::string key = "node." + node.name + ".of";
    const std::vector<std::string> names = node_names(node.of);
    const NodeArity arity = arity_of(node.kind);
    if (names.size() < arity.least || names.size() > arity.most)
      complain({"a node of kind " + quoted_text(word_of(node.kind)) + " works on " + arity.words() +
                    ", not on " + std::to_string(names.size()),
                "of = " + std::string(arity.most == 0 ? "\"\"" : "names of nodes, separated by commas"), ""},
               {scene.file, 0, key});
    for (const std::string& name : names)
      if (index_of(name) == scene.nodes.size())
        complain({"there is no node '" + name + "'", "the name of a [[node]]", ""}, {scene.file, 0, key});
  }
  std::vector<int> state(scene.nodes.size(), 0);  // 1: on the way, 2: done
  // A node that several work on is asked by each of them.
  std::vector<double> asked(scene.nodes.size(), 1.0);
  const auto visit = [&](const auto& self, std::size_t n) -> void {
    if (state[n] == 2) return;
    if (state[n] == 1)
      complain({"the node '" + scene.nodes[n].name + "' works on itself, directly or by others",
                "nodes without a circle", ""},
               {scene.file, 0, "node." + scene.nodes[n].name + ".of"});
    state[n] = 1;
    for (const std::string& name : node_names(scene.nodes[n].of)) {
      self(self, index_of(name));
      asked[n] += asked[index_of(name)];
    }
    if (asked[n] > kMostAsked)
      complain({"the node '" + scene.nodes[n].name + "' asks " + short_real_text(asked[n]) +
                    " nodes for each point, those that work on one another counted each time",
                "at most " + short_real_text(kMostAsked), "let fewer nodes share what they work on"},
               {scene.file, 0, "node." + scene.nodes[n].name + ".of"});
    state[n] = 2;
  };
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) visit(visit, n);
}

void check_nebula(const Scene& scene, const Nebula& nebula) {
  const std::string path = "nebula." + nebula.name + ".";
  const auto refuse = [&](const Complaint& complaint, const std::string& key) {
    complain(complaint, {scene.file, 0, path + key});
  };
  const auto is_node = [&](const std::string& name) {
    return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
  };
  for (const auto& [name, key] : {std::pair{nebula.gas, "gas"}, {nebula.glow, "glow"}, {nebula.dust, "dust"}})
    if (!name.empty() && !is_node(name))
      refuse({"there is no node '" + name + "'", "the name of a [[node]], or none", ""}, key);
  if (nebula.gas.empty() && nebula.glow.empty() && nebula.dust.empty())
    refuse({"the nebula is made of nothing", "gas, glow or dust with the name of a [[node]]", ""}, "gas");
  if (nebula.method == NebulaMethod::literal && nebula.gas.empty())
    refuse({"the literal march has no map", "gas with the name of a [[node]]", ""}, "gas");
  constexpr double kMostSteps = 100000.0;
  if (2.0 * nebula.bound / nebula.step > kMostSteps)
    refuse(
        {short_real_text(2.0 * nebula.bound / nebula.step) + " steps from side to side of the nebula's bound",
         "at most " + short_real_text(kMostSteps), "a larger step, or a smaller bound"},
        "step");
  const std::size_t lines = scene.emission.lines.size();
  const auto check_list = [&](const std::vector<double>& list, const std::string& node, const char* key) {
    if (list.size() != lines && (!node.empty() || !list.empty()))
      refuse({std::to_string(list.size()) + " numbers for " + std::to_string(lines) + " emission lines",
              "one per line of emission.lines, in its order", ""},
             key);
  };
  const std::string gas = nebula.method == NebulaMethod::literal ? "" : nebula.gas;
  check_list(nebula.inner_rayleigh, gas, "inner_rayleigh");
  check_list(nebula.outer_rayleigh, gas, "outer_rayleigh");
  check_list(nebula.glow_rayleigh, nebula.glow, "glow_rayleigh");
  if (nebula.inner_radius >= nebula.outer_radius)
    refuse({"inner_radius is not below outer_radius", "inner_radius below outer_radius", ""}, "inner_radius");
}

void check_volume(const Scene& scene, const Volume& volume) {
  const auto refuse = [&](const Complaint& complaint, const char* key) {
    complain(complaint, {scene.file, 0, "volume." + volume.name + "." + key});
  };
  if (volume.file.empty()) refuse({"the volume names no file", "file = \"NAME.vdb\"", ""}, "file");
  if (volume.frame == VolumeFrame::sun && !scene.sun.shown)
    refuse({"it stands on the Sun, which is not in the scene", "shown = true in [sun]", ""}, "frame");
  if (!volume.density_rayleigh.empty() && volume.density_rayleigh.size() != scene.emission.lines.size())
    refuse({std::to_string(volume.density_rayleigh.size()) + " numbers for " +
                std::to_string(scene.emission.lines.size()) + " emission lines",
            "one per line of emission.lines, in its order", ""},
           "density_rayleigh");
}

}  // namespace

void check_volumes(const Scene& scene) {
  for (const Footprint& footprint : scene.footprints) check_footprint(scene, footprint);
  check_nodes(scene);
  for (const Nebula& nebula : scene.nebulae) check_nebula(scene, nebula);
  for (const Volume& volume : scene.volumes) check_volume(scene, volume);
}

}  // namespace vegard::sim
