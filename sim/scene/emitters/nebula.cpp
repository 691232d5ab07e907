// [[nebula]]: clouds beyond the air, and [[node]]: what their density maps are made of.
#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <set>

#include "sim/scene/emitters/element_rules.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/nebula.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<Nebula> row(const char* key, Value Nebula::*value) {
  return Row("nebula", key, &Scene::nebulae, value)
      .none_free_if([](const Nebula& n) { return n.method == NebulaMethod::literal; },
                    {"the literal march makes colours, not light that could be compared",
                     "a nebula with method = \"physical\"", "leave it out of fit.free"});
}
Row<Nebula> of_gas(Row<Nebula> row) {
  return row.inert_if([](const Nebula& n) { return n.gas.empty(); }, "the nebula has no gas",
                      "name the node of its gas");
}
Row<Nebula> of_light(Row<Nebula> row) {
  return row.inert_if([](const Nebula& n) { return n.gas.empty() && n.glow.empty(); },
                      "nothing in the nebula shines", "name the node of its gas");
}
Row<Nebula> of_dust(Row<Nebula> row) {
  return row.inert_if([](const Nebula& n) { return n.dust.empty(); }, "the nebula has no dust",
                      "name the node of its dust");
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
    if (nebula.method != NebulaMethod::literal)
      for (const std::string* name : {&nebula.gas, &nebula.glow, &nebula.dust}) visit(visit, *name);
  return used;
}

template <class Value>
Row<Node> node(const char* key, Value Node::*value) {
  return Row("node", key, &Scene::nodes, value)
      .none_free_if(
          [](const Node& n, const Scene& scene) { return nodes_in_use(scene).count(n.name) == 0; },
          {"no nebula that is marched physically is made of the node",
           "a parameter that the light depends on", "leave it out of fit.free, or name it in a nebula"});
}

/// A number that only nodes of these kinds have.
Row<Node> number_of(const std::vector<NodeKind>& kinds, const char* key, double Node::*value) {
  return node(key, value)
      .inert_if([=](const Node& n) { return std::find(kinds.begin(), kinds.end(), n.kind) == kinds.end(); },
                "the node is of kind {kind}", "free a number that this kind has");
}

std::vector<Declaration> nebula_rows() {
  using N = Nebula;
  // clang-format off
  return {
      row("name", &N::name).means("name in paths"),
      row("method", &N::method).one_of<NebulaMethod>({{"physical", NebulaMethod::physical}, {"literal", NebulaMethod::literal}})
          .means("in rayleighs; or the source's literal march, in colours only"),
      row("azimuth_deg", &N::azimuth_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("azimuth of its middle"),
      row("elevation_deg", &N::elevation_deg).in("deg").within(-90, 90).may_be_free(ParameterScale::linear).means("elevation of its middle"),
      row("distance_pc", &N::distance_pc).in("pc").within(0, 1e7).may_be_free(ParameterScale::logarithmic).means("of its middle; below bound the camera is inside"),
      row("unit_pc", &N::unit_pc).in("pc").within(1e-6, 1e6).may_be_free(ParameterScale::logarithmic).means("unit of all its lengths"),
      row("position_angle_deg", &N::position_angle_deg).in("deg").within(-720, 720).may_be_free(ParameterScale::angle).means("anticlockwise, as the observer sees it"),
      row("bound", &N::bound).within(0.01, 1000).means("radius of the sphere that holds it; the source's is √8"),
      row("edge", &N::edge).within(1e-6, 100).may_be_free(ParameterScale::logarithmic).means("distance outside a surface at which density is 0 (h of the source)"),
      row("step", &N::step).within(1e-4, 1).means("step of the march; the literal march has its own"),
      row("gas", &N::gas).means("node of the gas that shines (and of the literal march)"),
      row("glow", &N::glow).means("node of a second light"),
      row("dust", &N::dust).means("node of what absorbs"),
      of_gas(row("inner_rayleigh", &N::inner_rayleigh)).called("inner light").by_line().in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("light of the gas of density 1 per unit of path and line, near the middle"),
      of_gas(row("outer_rayleigh", &N::outer_rayleigh)).called("outer light").by_line().in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("the same far out"),
      row("glow_rayleigh", &N::glow_rayleigh).called("glow").by_line().in("R").within(0, 1e9).may_be_free(ParameterScale::linear)
          .means("the same of the glow")
          .inert_if([](const N& n) { return n.glow.empty(); }, "the nebula has no glow", "name the node of its glow"),
      of_gas(row("inner_radius", &N::inner_radius)).within(0, 1000).may_be_free(ParameterScale::linear).means("up to this radius inner_rayleigh holds"),
      of_gas(row("outer_radius", &N::outer_radius)).within(1e-6, 1000).may_be_free(ParameterScale::linear).means("from this radius on outer_rayleigh holds"),
      of_light(row("density_power", &N::density_power)).within(0.1, 4).may_be_free(ParameterScale::linear).means("exponent from density to light: 2 for recombination"),
      of_light(row("brightness", &N::brightness)).within(0, 1e9).may_be_free(ParameterScale::logarithmic).means("factor on all its light"),
      of_dust(row("dust_depth", &N::dust_depth)).within(0, 1e6).may_be_free(ParameterScale::linear).means("of dust of density 1 per unit of path at 550 nm"),
      of_dust(row("dust_exponent", &N::dust_exponent)).within(-4, 8).may_be_free(ParameterScale::linear).means("optical depth goes as wavelength to minus this power")
          .inert_if([](const N& n, const Scene& scene) { return n.dust_depth == 0.0 && !frees(scene, "nebula." + n.name + ".dust_depth"); }, "its dust has no depth", "give it a dust_depth"),
      row("colour_a", &N::colour_a).of({"r", "g", "b"}).within(0, 100).means("of the literal march: light's colour at the middle"),
      row("literal_colour", &N::literal_colour).one_of<LiteralColour>({{"two", LiteralColour::two}, {"white", LiteralColour::white}})
          .means("of the literal march: from colour_a to colour_b, or white as in the source"),
      row("colour_b", &N::colour_b).of({"r", "g", "b"}).within(0, 100).means("of the literal march: colour at distance 1"),
  };
  // clang-format on
}

std::vector<Declaration> node_rows() {
  using K = NodeKind;
  const std::vector<K> noise = {K::filaments, K::turbulence, K::warp};
  // clang-format off
  return {
      node("name", &Node::name).means("for other nodes, nebulae and paths"),
      node("kind", &Node::kind)
          .one_of<NodeKind>({{"sphere", NodeKind::sphere}, {"shell", NodeKind::shell}, {"lobes", NodeKind::lobes}, {"torus", NodeKind::torus}, {"tube", NodeKind::tube}, {"slab", NodeKind::slab}, {"filaments", NodeKind::filaments}, {"turbulence", NodeKind::turbulence}, {"warp", NodeKind::warp}, {"union", NodeKind::unite}, {"intersection", NodeKind::intersect}, {"difference", NodeKind::subtract}, {"scale", NodeKind::scale}, {"rotate", NodeKind::rotate}, {"move", NodeKind::move}})
          .means("what it is: docs/nebulae.md"),
      node("of", &Node::of).means("nodes that it works on, separated by commas"),
      node("center", &Node::center).of({"right", "up", "near"}).within(-1000, 1000).may_be_free(ParameterScale::linear)
          .means("middle of a shape"),
      node("angles_deg", &Node::angles_deg).of({"right", "up", "near"}).in("deg").within(-720, 720).may_be_free(ParameterScale::angle)
          .means("rotation about these axes, one after the other"),
      node("stretch", &Node::stretch).of({"right", "up", "near"}).within(0.01, 100).may_be_free(ParameterScale::logarithmic)
          .means("along these axes, before any rotation"),
      number_of({K::sphere, K::shell, K::torus, K::tube, K::lobes}, "radius", &Node::radius).within(0, 1000).may_be_free(ParameterScale::linear).means("of a sphere, shell, torus, tube; the largest of lobes"),
      number_of({K::shell, K::slab, K::lobes, K::torus}, "thickness", &Node::thickness).within(1e-6, 1000).may_be_free(ParameterScale::logarithmic).means("of the walls of a shell, slab or lobes, or of a torus's ring"),
      number_of({K::lobes, K::tube}, "length", &Node::length).within(0, 1000).may_be_free(ParameterScale::linear).means("half-length of lobes or a tube"),
      number_of({K::lobes}, "waist", &Node::waist).within(0, 1000).may_be_free(ParameterScale::linear).means("of lobes in the middle"),
      number_of(noise, "amplitude", &Node::amplitude).within(-100, 100).may_be_free(ParameterScale::linear).means("of filaments, turbulence and warp"),
      number_of(noise, "frequency", &Node::frequency).within(1e-3, 1e3).may_be_free(ParameterScale::logarithmic).means("of the noise's largest waves, per unit of length"),
      number_of(noise, "gain", &Node::gain).within(0, 1).may_be_free(ParameterScale::linear).means("amplitude ratio of successive octaves"),
      number_of({K::unite, K::intersect, K::subtract}, "blend", &Node::blend).within(0, 100).may_be_free(ParameterScale::linear).means("rounding of a union, intersection or difference; 0: sharp"),
      node("octaves", &Node::octaves).within(1, 12).means("of noise"),
      node("seed", &Node::seed).within(0, 1e9).means("seed of its noise, with the scene's"),
  };
  // clang-format on
}

std::vector<Declaration> rows_of_nebulae_and_nodes() {
  std::vector<Declaration> all = nebula_rows(), of_nodes = node_rows();
  std::move(of_nodes.begin(), of_nodes.end(), std::back_inserter(all));
  return all;
}

/// Names of nodes must be there, and no node may stand on itself.
void check_nodes(const Scene& scene) {
  constexpr std::size_t kMaxNodes = 1000;
  constexpr double kMaxAsked = 10000.0;
  if (scene.nodes.size() > kMaxNodes)
    throw scene_error(
        {std::to_string(scene.nodes.size()) + " nodes", "at most " + std::to_string(kMaxNodes), ""},
        {scene.file, 0, "node." + scene.nodes[kMaxNodes].name + ".name"});
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
      throw scene_error(
          {"a node of kind " + quoted_text(word_in(node_rows(), node.kind)) + " works on " + arity.words() +
               ", not on " + std::to_string(names.size()),
           "of = " + std::string(arity.most == 0 ? "\"\"" : "names of nodes, separated by commas"), ""},
          {scene.file, 0, key});
    for (const std::string& name : names)
      if (index_of(name) == scene.nodes.size())
        throw scene_error({"there is no node '" + name + "'", "the name of a [[node]]", ""},
                          {scene.file, 0, key});
  }
  std::vector<int> state(scene.nodes.size(), 0);  // 1: on the way, 2: done
  // A node that several work on is asked by each of them.
  std::vector<double> asked(scene.nodes.size(), 1.0);
  const auto visit = [&](const auto& self, std::size_t n) -> void {
    if (state[n] == 2) return;
    if (state[n] == 1)
      throw scene_error({"the node '" + scene.nodes[n].name + "' works on itself, directly or by others",
                         "nodes without a circle", ""},
                        {scene.file, 0, "node." + scene.nodes[n].name + ".of"});
    state[n] = 1;
    for (const std::string& name : node_names(scene.nodes[n].of)) {
      self(self, index_of(name));
      asked[n] += asked[index_of(name)];
    }
    if (asked[n] > kMaxAsked)
      throw scene_error({"the node '" + scene.nodes[n].name + "' asks " + short_real_text(asked[n]) +
                             " nodes for each point, those that work on one another counted each time",
                         "at most " + short_real_text(kMaxAsked), "let fewer nodes share what they work on"},
                        {scene.file, 0, "node." + scene.nodes[n].name + ".of"});
    state[n] = 2;
  };
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) visit(visit, n);
}

void check_the_nebula(const Scene& scene, const Nebula& nebula) {
  const ElementCheck check(scene, "nebula." + nebula.name);
  const auto is_node = [&](const std::string& name) {
    return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
  };
  for (const auto& [name, key] : {std::pair{nebula.gas, "gas"}, {nebula.glow, "glow"}, {nebula.dust, "dust"}})
    if (!name.empty() && !is_node(name))
      throw check.error_at({"there is no node '" + name + "'", "the name of a [[node]], or none", ""}, key);
  if (nebula.gas.empty() && nebula.glow.empty() && nebula.dust.empty())
    throw check.error_at(
        {"the nebula is made of nothing", "gas, glow or dust with the name of a [[node]]", ""}, "gas");
  if (nebula.method == NebulaMethod::literal && nebula.gas.empty())
    throw check.error_at({"the literal march has no map", "gas with the name of a [[node]]", ""}, "gas");
  constexpr double kMaxSteps = 100000.0;
  if (2.0 * nebula.bound / nebula.step > kMaxSteps)
    throw check.error_at(
        {short_real_text(2.0 * nebula.bound / nebula.step) + " steps from side to side of the nebula's bound",
         "at most " + short_real_text(kMaxSteps), "a larger step, or a smaller bound"},
        "step");
  const std::string gas = nebula.method == NebulaMethod::literal ? "" : nebula.gas;
  check.check_lines(nebula.inner_rayleigh, gas.empty(), "inner_rayleigh");
  check.check_lines(nebula.outer_rayleigh, gas.empty(), "outer_rayleigh");
  check.check_lines(nebula.glow_rayleigh, nebula.glow.empty(), "glow_rayleigh");
  check.check_below(nebula.inner_radius, "inner_radius", nebula.outer_radius, "outer_radius");
}

void check_nebulae(const Scene& scene) {
  check_nodes(scene);
  for (const Nebula& nebula : scene.nebulae) check_the_nebula(scene, nebula);
}

/// The literal march makes a layer of colours of its own.
bool nebulae_are_drawn(const Scene& scene) {
  return std::any_of(scene.nebulae.begin(), scene.nebulae.end(),
                     [](const Nebula& n) { return n.method != NebulaMethod::literal; });
}

bool nebulae_may_emit(const Scene& scene) {
  return std::any_of(scene.nebulae.begin(), scene.nebulae.end(),
                     [](const Nebula& n) { return n.method != NebulaMethod::literal && n.brightness > 0.0; });
}

std::vector<LightLocation> where_nebulae_are(const Scene& scene) {
  std::vector<LightLocation> all;
  for (const Nebula& n : scene.nebulae)
    all.push_back(
        {LightLocation::Known::direction, "nebula '" + n.name + "'", {}, n.azimuth_deg, n.elevation_deg});
  return all;
}

}  // namespace

EmitterKind nebula_kind() {
  EmitterKind kind;
  kind.table = "nebula";
  kind.repeated = {repeated_table_of(kind.table, &Scene::nebulae), repeated_table_of("node", &Scene::nodes)};
  kind.rows = rows_of_nebulae_and_nodes;
  kind.light = LightKind::nebula;
  kind.check = check_nebulae;
  kind.is_drawn = nebulae_are_drawn;
  kind.may_emit = nebulae_may_emit;
  kind.light_locations = where_nebulae_are;
  kind.place_in_preview = 1;
  return kind;
}

}  // namespace vegard::sim
