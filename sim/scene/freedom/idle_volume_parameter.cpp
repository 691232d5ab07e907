#include "sim/scene/freedom/idle_volume_parameter.h"

#include <algorithm>
#include <set>
#include <string>

#include "sim/scene/structs/node_names.h"

namespace vegard::sim {
namespace {

bool is_any_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

Complaint idle(const std::string& problem, const std::string& hint) {
  return {problem, "a parameter that the light depends on", "leave it out of fit.free, or " + hint};
}

std::optional<Complaint> of_footprint(const Footprint& f, const std::string& key) {
  const auto nothing = [&](const std::string& what) { return what + ", so " + key + " counts for nothing"; };
  if (f.shape == "shell" && !is_any_of(key, {"energy_kev"}))
    return Complaint{"the footprint is a shell, whose map has no derivative by " + key,
                     "a number of a footprint of shape \"box\", or energy_kev", "leave it out of fit.free"};
  const bool of_spline = is_any_of(key, {"east_km", "north_km", "width_km", "point_energy", "point_flux"});
  if (of_spline && f.source != "spline")
    return idle(nothing("the footprint comes from \"" + f.source + "\""), "set source to \"spline\"");
  if (f.model != "curtain" && f.flow_turns > 0.0 &&
      is_any_of(key, {"east_km", "north_km", "width_km", "point_flux"}))
    return Complaint{
        "the flow that winds the footprint up depends on " + key + ", and its derivative is not known",
        "a footprint that does not flow, or a number that its flow does not depend on",
        "set flow_turns = 0, or leave it out of fit.free"};
  if (f.source == "sheets" && is_any_of(key, {"center_km", "energy_kev", "energy_flux_mw_m2"}))
    return idle(nothing("feet, energy and flux are those of the sheets"), "free the sheets' own numbers");
  return std::nullopt;
}

/// Of a sheet that a footprint is made of.
std::optional<Complaint> of_sheet_in_footprint(const Scene& scene, const Sheet& sheet,
                                               const std::string& key) {
  const bool is_in_one = std::any_of(scene.footprints.begin(), scene.footprints.end(),
                                     [](const Footprint& f) { return f.source == "sheets"; });
  if (is_in_one && key == "energy_kev" && sheet.brightness_kilorayleigh > 0.0)
    return Complaint{
        "the sheet's brightness is given, and how the energy flux of its footprint depends on "
        "its energy then is not known",
        "a sheet of given energy_flux_mw_m2",
        "set energy_flux_mw_m2 in the place of brightness_kilorayleigh, or leave it out of "
        "fit.free"};
  const bool flows = std::any_of(scene.footprints.begin(), scene.footprints.end(), [](const Footprint& f) {
    return f.source == "sheets" && f.flow_turns > 0.0;
  });
  // The flow goes by ratios of fluxes, and so not by the flux of a single sheet.
  if (!flows || key == "energy_kev" || (key == "energy_flux_mw_m2" && scene.sheets.size() == 1))
    return std::nullopt;
  return Complaint{
      "the flow that winds the sheets' footprint up depends on " + key + ", and its derivative is not known",
      "a footprint that does not flow, or a number that its flow does not depend on",
      "set the footprint's flow_turns = 0, or leave it out of fit.free"};
}

std::optional<Complaint> of_nebula(const Scene& scene, const Nebula& n, const std::string& key) {
  const auto nothing = [&](const std::string& what) { return what + ", so " + key + " counts for nothing"; };
  if (n.method == "literal")
    return Complaint{"the literal march makes colours, not light that could be compared",
                     "a nebula with method = \"physical\"", "leave it out of fit.free"};
  const bool of_gas = is_any_of(key, {"inner_rayleigh", "outer_rayleigh", "inner_radius", "outer_radius"});
  if (of_gas && n.gas.empty()) return idle(nothing("the nebula has no gas"), "name the node of its gas");
  if (key == "glow_rayleigh" && n.glow.empty())
    return idle(nothing("the nebula has no glow"), "name the node of its glow");
  if (is_any_of(key, {"brightness", "density_power"}) && n.gas.empty() && n.glow.empty())
    return idle(nothing("nothing in the nebula shines"), "name the node of its gas");
  if (is_any_of(key, {"dust_depth", "dust_exponent"}) && n.dust.empty())
    return idle(nothing("the nebula has no dust"), "name the node of its dust");
  const auto frees = [&](const std::string& path) {
    return std::any_of(scene.fit.free.begin(), scene.fit.free.end(),
                       [&](const FreeParameter& free) { return free.path == path; });
  };
  if (key == "dust_exponent" && n.dust_depth == 0.0 && !frees("nebula." + n.name + ".dust_depth"))
    return idle(nothing("its dust has no depth"), "give it a dust_depth");
  return std::nullopt;
}

/// Names of the nodes that some nebula of the physical march is made of.
std::set<std::string> nodes_in_use(const Scene& scene) {
  std::set<std::string> used;
  const auto visit = [&](const auto& self, const std::string& name) -> void {
    if (name.empty() || !used.insert(name).second) return;
    for (const Node& node : scene.nodes)
      if (node.name == name)
        for (const std::string& of : node_names(node.of)) self(self, of);
  };
  for (const Nebula& nebula : scene.nebulae)
    if (nebula.method != "literal")
      for (const std::string* name : {&nebula.gas, &nebula.glow, &nebula.dust}) visit(visit, *name);
  return used;
}

std::optional<Complaint> of_node(const Scene& scene, const Node& node, const std::string& key) {
  if (nodes_in_use(scene).count(node.name) == 0)
    return idle("no nebula that is marched physically is made of the node", "name it in a nebula");
  const std::string& kind = node.kind;
  const bool is_noise = is_any_of(kind, {"filaments", "turbulence", "warp"});
  const bool counts = key == "radius"      ? is_any_of(kind, {"sphere", "shell", "torus", "tube", "lobes"})
                      : key == "thickness" ? is_any_of(kind, {"shell", "slab", "lobes", "torus"})
                      : key == "length"    ? is_any_of(kind, {"lobes", "tube"})
                      : key == "waist"     ? kind == "lobes"
                      : key == "blend"     ? is_any_of(kind, {"union", "intersection", "difference"})
                      : key == "amplitude" || key == "frequency" || key == "gain" ? is_noise
                                                                                  : true;
  if (counts) return std::nullopt;
  return idle("the node is of kind \"" + kind + "\", so " + key + " counts for nothing",
              "free a number that this kind has");
}

std::optional<Complaint> of_loop(const Loop& loop, const std::string& key) {
  if (loop.voxel == 0.0) return std::nullopt;
  return Complaint{"the loop is drawn by a grid, whose derivative by " + key + " is not known",
                   "a number of a loop that is drawn strand by strand",
                   "set its voxel = 0, or leave it out of fit.free"};
}

}  // namespace

std::optional<Complaint> why_volume_number_counts_for_nothing(const Scene& scene, const ParameterPath& path) {
  const std::string &table = path.row->table, &key = path.row->key;
  const auto e = static_cast<std::size_t>(path.element);
  if (table == "footprint") return of_footprint(scene.footprints[e], key);
  if (table == "sheet") return of_sheet_in_footprint(scene, scene.sheets[e], key);
  if (table == "loop") return of_loop(scene.loops[e], key);
  if (table == "nebula") return of_nebula(scene, scene.nebulae[e], key);
  if (table == "node") return of_node(scene, scene.nodes[e], key);
  return std::nullopt;
}

}  // namespace vegard::sim
