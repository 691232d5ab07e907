#include "sim/scene/table/free_entry_keys.h"

#include <array>
#include <cstddef>
#include <utility>

namespace vegard::sim {
namespace {

template <std::string FreeParameter::*Place>
FreeTextKey plain_text(const char* key, const char* meaning, const char* type) {
  return {key, meaning, type,
          [](FreeParameter& free, const std::string& text) {
            free.*Place = text;
            return true;
          },
          [](const FreeParameter& free) { return free.*Place; }};
}

constexpr std::array<std::pair<FreeScale, const char*>, 3> kScales = {
    {{FreeScale::of_table, ""}, {FreeScale::linear, "linear"}, {FreeScale::logarithmic, "logarithmic"}}};
constexpr std::array<std::pair<PriorLaw, const char*>, 3> kLaws = {
    {{PriorLaw::normal, "normal"}, {PriorLaw::log_normal, "log-normal"}, {PriorLaw::uniform, "uniform"}}};

template <class Kind>
std::optional<Kind> kind_of(const std::array<std::pair<Kind, const char*>, 3>& words,
                            const std::string& word) {
  for (const auto& [kind, its_word] : words)
    if (word == its_word) return kind;
  return std::nullopt;
}

template <class Kind>
std::string word_in(const std::array<std::pair<Kind, const char*>, 3>& words, Kind kind) {
  return words[static_cast<std::size_t>(kind)].second;
}

}  // namespace

std::optional<PriorLaw> prior_law(const std::string& word) { return kind_of(kLaws, word); }

std::string word_of_law(PriorLaw law) { return word_in(kLaws, law); }

const std::vector<FreeNumberKey>& free_number_keys() {
  static const std::vector<FreeNumberKey> keys = {
      {"start", "default the scene's value", &FreeParameter::start},
      {"min", "lower limit; default the parameter's", &FreeParameter::min},
      {"max", "upper limit; default the parameter's", &FreeParameter::max},
  };
  return keys;
}

const std::vector<FreeTextKey>& free_text_keys() {
  static const std::vector<FreeTextKey> keys = {
      plain_text<&FreeParameter::name>("name",
                                       "for expressions; entries of one name are one number; without a path "
                                       "(but with start, min, max) used only there",
                                       "a text"),
      {"scale", "default the parameter's", "\"linear\" or \"logarithmic\"",
       [](FreeParameter& free, const std::string& text) {
         const std::optional<FreeScale> scale = kind_of(kScales, text);
         if (scale) free.scale = *scale;
         return scale.has_value();
       },
       [](const FreeParameter& free) { return word_in(kScales, free.scale); }},
      plain_text<&FreeParameter::photo>("photo", "the only photograph that has it; default all",
                                        "a name of fit.photo"),
  };
  return keys;
}

const std::vector<FreePriorKey>& free_prior_keys() {
  static const std::vector<FreePriorKey> keys = {
      {"mean", "centre (log-normal: median)", &Prior::mean},
      {"sigma", "standard deviation, above 0 (log-normal: of the logarithm)", &Prior::sigma},
  };
  return keys;
}

const std::vector<TiedKey>& tied_keys() {
  static const std::vector<TiedKey> keys = {
      {"path", "what follows from others", "a text", true, &TiedParameter::path},
      {"equals", "numbers, paths, names of fit.free, +-*/^, parentheses, functions", "an expression", true,
       &TiedParameter::equals},
      {"photo", "the only photograph that has it; default all", "a name of fit.photo", false,
       &TiedParameter::photo},
  };
  return keys;
}

ParameterScale scale_of(const FreeParameter& free, const ParameterRow* row) {
  if (free.scale == FreeScale::logarithmic) return ParameterScale::logarithmic;
  if (free.scale == FreeScale::linear || row == nullptr) return ParameterScale::linear;
  return row->scale;
}

const std::vector<PhotoTextKey>& photo_text_keys() {
  static const std::vector<PhotoTextKey> keys = {
      {"name", "in fit.free and results; default the file's name without its ending", &PhotoEntry::name},
      {"file", "the photograph", &PhotoEntry::file},
      {"mask", "mask of the same size: white = use; default all", &PhotoEntry::mask},
      {"decoding", "decoding; default fit.decoding", &PhotoEntry::decoding},
  };
  return keys;
}

const std::vector<RadarTextKey>& radar_text_keys() {
  static const std::vector<RadarTextKey> keys = {
      {"name", "in results; default the file's name without its ending", &RadarEntry::name},
      {"file", "densities with errors: CSV or Madrigal's HDF5", &RadarEntry::file},
  };
  return keys;
}

const std::vector<RadarNumberKey>& radar_number_keys() {
  constexpr double kNone = 1e-3, kLong = 1e10;
  static const std::vector<RadarNumberKey> keys = {
      {"beam", "", "of a file of several", -kLong, kLong, &RadarEntry::beam},
      {"time_s", "s", "of the profile, as the file counts it", -kLong, kLong, &RadarEntry::time_s},
      {"lowest_km", "km", "altitudes from; default 85", 80.0, 300.0, &RadarEntry::lowest_km},
      {"highest_km", "km", "to; default 150", 80.0, 300.0, &RadarEntry::highest_km},
      {"latitude_deg", "deg", "of the field line's foot at 110 km", -90.0, 90.0, &RadarEntry::latitude_deg},
      {"longitude_deg", "deg", "likewise", -360.0, 360.0, &RadarEntry::longitude_deg},
      {"azimuth_deg", "deg", "or of the beam", -360.0, 360.0, &RadarEntry::azimuth_deg},
      {"elevation_deg", "deg", "likewise", 10.0, 90.0, &RadarEntry::elevation_deg},
      {"site_latitude_deg", "deg", "of the radar; default the scene's", -90.0, 90.0,
       &RadarEntry::site_latitude_deg},
      {"site_longitude_deg", "deg", "likewise", -360.0, 360.0, &RadarEntry::site_longitude_deg},
      {"site_altitude_m", "m", "likewise", -500.0, 9000.0, &RadarEntry::site_altitude_m},
      {"scale_sigma", "", "of the densities' scale, about 1; default held", kNone, 10.0,
       &RadarEntry::scale_sigma},
      {"seconds", "s", "since the onset; default a steady state", 1.0, 1e5, &RadarEntry::seconds},
  };
  return keys;
}

}  // namespace vegard::sim
