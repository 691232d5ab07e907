#include "sim/scene/rows/forms.h"

#include "sim/scene/structs/sheet.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vegard::sim {
namespace {

constexpr std::size_t kForms = 12;

const char* const kNames[kForms][2] = {
    {"homogeneous_arc", "an even arc without rays"},
    {"band", "an even band, which bends more than an arc"},
    {"rayed_arc", "an arc broken up into rays"},
    {"rayed_band", "a band of many short rays"},
    {"rays", "a bundle of rays apart from other forms"},
    {"corona", "a rayed band, to be placed overhead and seen along the field"},
    {"drapery", "a folded band of long rays, like a curtain"},
    {"diffuse_patches", "weak patches without structure, like clouds"},
    {"spirals", "an arc wound up into a street of spirals"},
    {"steve", "a narrow mauve arc of a continuum, high and equatorward of the aurora"},
    {"picket_fence", "green rays below STEVE, of 557.7 nm alone"},
    {"proton_arc", "a wide faint arc of protons, spread by charge exchange"},
};

/// One key per row, one form per column. Of its folds, curls, rays and patches a form says nothing about
/// motion and lifetime.
///
/// Energies are those whose light, 630.0, 557.7 and 427.8 nm together, is as tall as the source has the form
/// (its sections 2.2 and 2.3), between the tenths of its peak: by the program's own emission tables 27 km of
/// arcs and bands, 56 km of rayed arcs, 73 km of rayed bands, 38 km of spirals, 160 km of draperies and 220
/// km of rays. Arcs, bands and spirals have electrons about one energy, as an acceleration leaves them; the
/// light of a Maxwellian is never so low. peak_km, lower_km and upper_km are of the measured curve, profile =
/// "form".
///
/// STEVE and the picket fence have no known electrons. Their light is at a tenth of its peak at the limits of
/// Archer et al. 2019 (doi:10.1029/2019GL084473), 130 and 270 km, 95 and 150 km. Where between them it peaks,
/// its brightness, and the fence's rays are ESTIMATED. STEVE is 20 to 30 km wide (MacDonald et al. 2018,
/// doi:10.1126/sciadv.aaq0030).
///
/// Protons spread in their first charge exchanges at 250 to 450 km (Fang et al. 2004, "Quantification of the
/// spreading effect of auroral proton precipitation"), ESTIMATED as one and a half scale heights of the air
/// there, 75 km, aslant by up to 45 degrees.
struct FormRow {
  const char* key;
  const char* of_form[kForms];
};

// clang-format off
const FormRow kFormRows[] = {
    //                       arc     band    r. arc  r. band rays   corona  drapery patches spirals steve fence protons
    {"length_km",            {"1200", "1200", "1200", "1200", "60",  "1200", "800", "600", "1200", "2000", "2000", "1200"}},
    {"thickness_km",           {"3", "8", "3", "10", "1", "10", "9", "10", "4", "3", "3", "3"}},
    {"wavelength_km",          {"160", "110", "120", "110", "30", "110", "95", "300", "220", "900", "900", "900"}},
    {"phase_shift_rad",      {"0.5",  "0.5",  "0.5",  "0.5",  "0.5", "0.5",  "1.0", "0.5", "0.5", "0.5", "0.5", "0.5"}},
    {"layers",                 {"3", "3", "2", "2", "2", "2", "2", "1", "2", "1", "1", "1"}},
    {"width_km",               {"1.5", "2.0", "0.3", "0.4", "0.3", "0.4", "0.35", "25", "1.2", "9", "2", "60"}},
    {"beams_per_km",           {"80", "80", "60", "60", "150", "60", "60", "500", "120", "240", "60", "500"}},
    {"points_per_px",        {"4",    "4",    "4",    "4",    "4",   "4",    "4",   "4", "4", "4", "4", "4"}},
    {"spacing_jitter",       {"0",    "0",    "0.5",  "0.5",  "0.5", "0.5",  "0.5", "0", "0", "0", "0.5", "0"}},
    {"top_km",               {"500",  "500",  "500",  "500",  "640", "500",  "640", "500", "500", "500", "500", "500"}},
    {"energy_kev",             {"9", "9", "2.5", "1.8", "0.5", "1.8", "0.9", "5", "6", "3", "3", "5"}},
    {"energy_spread",          {"0.1", "0.1", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2", "0.2"}},
    {"energy_flux_mw_m2",    {"4",    "5",    "12",   "18",   "40",  "18",   "40",  "0.35", "12", "5", "5", "5"}},
    {"profile",              {"'gaussian'", "'gaussian'", "'maxwellian'", "'maxwellian'", "'maxwellian'", "'maxwellian'", "'maxwellian'", "'maxwellian'", "'gaussian'", "'line'", "'line'", "'proton'"}},
    {"peak_km",              {"108",  "108",  "110",  "112",  "120", "112",  "115", "110", "108", "200", "110", "110"}},
    {"lower_km",             {"4",    "4.5",  "4",    "4.5",  "4.8", "4.5",  "4.8", "4.8", "4", "70", "15", "4"}},
    {"upper_km",               {"20", "22", "60", "90", "300", "90", "180", "20", "35", "70", "40", "20"}},
    {"line_nm",              {"557.7", "557.7", "557.7", "557.7", "557.7", "557.7", "557.7", "557.7", "557.7", "610", "557.7", "486.1"}},
    {"line_kilorayleigh",    {"1", "1", "1", "1", "1", "1", "1", "1", "1", "10", "10", "0.1"}},
    {"fold_spacing_km",        {"0", "0", "0", "30", "0", "30", "26", "0", "0", "0", "0", "0"}},
    {"fold_length_km",         {"8", "8", "8", "20", "8", "20", "20", "8", "8", "8", "8", "8"}},
    {"fold_stage",             {"0.5", "0.5", "0.5", "0.6", "0.5", "0.6", "0.9", "0.5", "0.5", "0.5", "0.5", "0.5"}},
    {"curl_spacing_km",        {"0", "0", "0", "8", "0", "8", "0", "0", "0", "0", "0", "0"}},
    {"curl_radius_km",       {"1",    "1",    "1",    "1",    "1",   "1",    "1",   "1", "1", "1", "1", "1"}},
    {"spiral_spacing_km",    {"0", "0", "0", "0", "0", "0", "0", "0", "150", "0", "0", "0"}},
    {"spiral_radius_km",     {"25", "25", "25", "25", "25", "25", "25", "25", "25", "25", "25", "25"}},
    {"spiral_turn_rad",      {"6", "6", "6", "6", "6", "6", "6", "6", "5", "6", "6", "6"}},
    {"ray_contrast",           {"0", "0", "0.6", "0.5", "1.2", "0.5", "0.5", "0", "0.3", "0", "1.2", "0"}},
    {"ray_width_km",           {"1", "1", "1", "1", "1", "1", "1", "1", "1", "1", "4", "1"}},
    {"ray_length_contrast",    {"0", "0", "0.3", "0.35", "0.4", "0.35", "0.3", "0", "0.2", "0", "0.2", "0"}},
    {"patch_size_km",          {"0", "0", "0", "0", "0", "0", "0", "20", "0", "0", "0", "0"}},
    {"patch_contrast",       {"1",    "1",    "1",    "1",    "1",   "1",    "1",   "1", "1", "1", "1", "1"}},
    {"border_amplitude_km",    {"0", "0", "2", "3", "3", "3", "3", "2", "1.5", "0", "0", "0"}},
    {"border_scale_km",        {"20", "20", "40", "40", "20", "40", "40", "20", "40", "20", "20", "20"}},
};
// clang-format on

std::vector<Form> build_forms() {
  std::vector<Form> all = {{Sheet{}.form, "what the keys say, nothing else", {}}};
  for (std::size_t f = 0; f < kForms; ++f) {
    Form form{kNames[f][0], kNames[f][1], {}};
    for (const FormRow& row : kFormRows) form.values.emplace_back(row.key, row.of_form[f]);
    all.push_back(std::move(form));
  }
  return all;
}

}  // namespace

const std::vector<Form>& forms() {
  static const std::vector<Form> all = build_forms();
  return all;
}

std::vector<std::string> form_names() {
  std::vector<std::string> names;
  std::transform(forms().begin(), forms().end(), std::back_inserter(names),
                 [](const Form& f) { return f.name; });
  return names;
}

const std::vector<KeyAndText>& values_of_form(const std::string& name) {
  const auto found =
      std::find_if(forms().begin(), forms().end(), [&](const Form& form) { return form.name == name; });
  return (found == forms().end() ? forms().front() : *found).values;  // of "custom", which sets nothing
}

}  // namespace vegard::sim
