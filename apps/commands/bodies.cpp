#include "apps/commands/commands.h"

#include <string>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/standard_streams.h"
#include "sim/scene/lines/bodies.h"

namespace vegard::apps {
namespace {

double scale_height_km(const sim::OwnLine& line, const sim::Body& body) {
  return line.scale_height_km > 0.0 ? line.scale_height_km : sim::scale_height_km(body, line.peak_km);
}

double microtesla(const sim::Body& body, double magnetic_latitude_deg) {
  return 1e6 * sim::dipole_field_t(body, body.radius_km, magnetic_latitude_deg);
}

std::string line_text(const sim::OwnLine& line, const sim::Body& body) {
  return fmt::format("    {:6.1f} nm  {:8}  {:g} R per mW m⁻², {:g} km high, scale height {:.0f} km\n",
                     line.wavelength_nm, line.name, line.rayleigh_per_mw_m2, line.peak_km,
                     scale_height_km(line, body));
}

std::string body_text(const sim::KnownBody& known) {
  const sim::Body& body = known.body;
  std::string text = fmt::format(
      "{}: radius {:g} km, gravity {:g} m s⁻², horizon of an observer 400 km high {:.1f}° down\n"
      "  dipole: {:.1f} µT at its equator ({}), {:.1f} µT at its poles, pole at latitude {:g}°, longitude "
      "{:g}°\n"
      "  air where it shines: {:g} K, {:g} Da\n  from: {}\n",
      body.name, body.radius_km, body.gravity_m_s2, sim::horizon_dip_deg(body, 400.0), microtesla(body, 0.0),
      body.dipole_moment_t_m3 < 0.0 ? "to the south" : "to the north", microtesla(body, 90.0),
      known.pole_latitude_deg, known.pole_longitude_deg, body.air_temperature_k, body.air_mass_dalton,
      known.source);
  if (known.lines.empty()) return text + "  lines: those of the emission tables (vegard lines)\n";
  text += "  lines:\n";
  for (const sim::OwnLine& line : known.lines) text += line_text(line, body);
  return text + fmt::format("  from: {}\n", known.lines_source);
}

/// The same numbers for --json.
Json body_json(const sim::KnownBody& known) {
  const sim::Body& body = known.body;
  Json lines = Json::array();
  for (const sim::OwnLine& line : known.lines)
    lines.push_back({{"name", line.name},
                     {"wavelength_nm", line.wavelength_nm},
                     {"rayleigh_per_mw_m2", line.rayleigh_per_mw_m2},
                     {"peak_km", line.peak_km},
                     {"scale_height_km", scale_height_km(line, body)}});
  return {{"name", body.name},
          {"radius_km", body.radius_km},
          {"gravity_m_s2", body.gravity_m_s2},
          {"horizon_dip_at_400_km_deg", sim::horizon_dip_deg(body, 400.0)},
          {"field_at_equator_microtesla", microtesla(body, 0.0)},
          {"field_at_pole_microtesla", microtesla(body, 90.0)},
          {"dipole_moment_t_m3", body.dipole_moment_t_m3},
          {"pole_latitude_deg", known.pole_latitude_deg},
          {"pole_longitude_deg", known.pole_longitude_deg},
          {"air_temperature_k", body.air_temperature_k},
          {"air_mass_dalton", body.air_mass_dalton},
          {"source", known.source},
          {"lines", lines},
          {"lines_source", known.lines_source}};
}

}  // namespace

void add_bodies_command(Program& program) {
  const Command command =
      program.add("bodies", "List the bodies that a scene can have: size, field, air, lines, sources");
  command.runs([] {
    json_answer()["bodies"] = Json::array();
    for (const sim::KnownBody& known : sim::known_bodies()) {
      say_result(body_text(known));
      json_answer()["bodies"].push_back(body_json(known));
    }
    return good;
  });
}

}  // namespace vegard::apps
