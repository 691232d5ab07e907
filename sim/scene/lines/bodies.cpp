#include "sim/scene/lines/bodies.h"

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"

namespace vegard::sim {
namespace {

const char* const kOwnBody = "own";

const char* const kJupiterLines =
    "H2 (Lyman and Werner bands, 90 to 170 nm, under one name): 10 kR for each mW m⁻², none of it absorbed "
    "(Waite et al. 1983, J. Geophys. Res. 88, 6143). Estimated, good to a factor of two: H alpha a fifth of "
    "their photons, H beta a fifth of that, by cross-sections of electrons on H2 (Ajello et al. 1984, Phys. "
    "Rev. A 29, 636; Karolis and Harting 1978, J. Phys. B 11, 357); 40 to 140 mW m⁻² then give the 80 to 300 "
    "kR that Ingersoll et al. 1998 (Icarus 135, 251) saw in visible light, continuum included. Estimated, "
    "good to a factor of three: H3+, its line Q(1,0-), of one ion for each 30 eV, which lives for 80 s among "
    "1e5 electrons cm⁻³ and radiates as at 1000 K (Miller et al. 2013, J. Phys. Chem. A 117, 9770). Heights: "
    "visible light of Vasavada et al. 1999 (J. Geophys. Res. 104, 27133), also taken for the ultraviolet; of "
    "H3+ estimated";
const char* const kSaturnLines =
    "brightness as Jupiter's; heights: ultraviolet of Gerard et al. 2009 (Geophys. Res. Lett. 36, L02202), "
    "H3+ of Stallard et al. 2012 (Geophys. Res. Lett. 39, L15103), less 800 km";

/// Per mW m^-2 of electrons in an air of hydrogen; kJupiterLines says whence.
std::vector<OwnLine> hydrogen_lines(double peak_km, double h3_plus_km) {
  return {
      {"h2_bands", 161.0, 1e-9, 0.0, 1.0, 10000.0, peak_km, 0.0},
      {"h_beta", 486.1, 3.3e-8, 0.0, 1.0, 360.0, peak_km, 0.0},
      {"h_alpha", 656.3, 1e-8, 0.0, 1.0, 1800.0, peak_km, 0.0},
      {"h3_plus", 3953.0, 80.0, 0.0, 1.0, 50000.0, h3_plus_km, 0.0},
  };
}

}  // namespace

const std::vector<KnownBody>& known_bodies() {
  static const std::vector<KnownBody> bodies = {
      {Body(),
       "the sphere of the mean radius; dipole of IGRF-14 in 2020; air of NRLMSISE-00 at 115 km",
       Field().pole_latitude_deg,
       Field().pole_longitude_deg,
       {},
       Emission().lines,
       ""},
      {{"jupiter", 69911.0, 25.92, -1.55e20, 400.0, 2.2},
       "mean radius at 1 bar and GM (Archinal et al. 2018, Celest. Mech. Dyn. Astr. 130, 22; Jacobson 2013); "
       "dipole moment of Russell and Dougherty 2010 (Space Sci. Rev. 152, 251), its tilt and longitude of "
       "JRM09 (Connerney et al. 2018, Geophys. Res. Lett. 45, 2590); air at 250 km of the Galileo probe "
       "(Seiff et al. 1998, J. Geophys. Res. 103, 22857)",
       79.69,
       163.39,
       hydrogen_lines(245.0, 500.0),
       {3953.0, 656.3, 486.1, 161.0},
       kJupiterLines},
      {{"saturn", 59032.0, 10.88, -4.6e18, 400.0, 2.0},
       "a sphere 800 km above the mean radius at 1 bar, since light is worked out between 80 and 640 km "
       "above it, and GM (Archinal et al. 2018; Jacobson et al. 2006, Astron. J. 132, 2520); dipole moment "
       "of Russell and Dougherty 2010, its tilt below 0.06 degrees taken as none; air estimated",
       90.0,
       0.0,
       hydrogen_lines(300.0, 355.0),
       {3953.0, 656.3, 486.1, 161.0},
       kSaturnLines},
  };
  return bodies;
}

std::vector<std::string> body_names() {
  std::vector<std::string> names;
  for (const KnownBody& known : known_bodies()) names.push_back(known.body.name);
  names.emplace_back(kOwnBody);
  return names;
}

void adopt_body(Scene& scene) {
  for (const KnownBody& known : known_bodies()) {
    if (known.body.name != scene.body.name) continue;
    scene.body = known.body;
    scene.field.pole_latitude_deg = known.pole_latitude_deg;
    scene.field.pole_longitude_deg = known.pole_longitude_deg;
    if (!is_earth(scene.body)) scene.field.model = FieldModel::dipole;
    scene.own_lines = known.lines;
    change_lines(scene, known.shown_nm);
  }
}

}  // namespace vegard::sim
