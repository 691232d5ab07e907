#include "fit/measurement/measure_answer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/measurement/measure_stages.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace measure_sentences {

constexpr double kExplained = 2.0;  // chi2 per value of a map, as in its own verdict
constexpr double kEndShare = 0.2;   // of a curtain's light at the end of the energies that a map can have
constexpr double kNoAurora = 0.2;   // probability by the kind of sky, which is right in five of six pictures
constexpr double kAllAround_deg = 300.0, kHalfAround_deg = 110.0;

/// Adds a reason for a trust that is at most doubtful, or `at_most`.
void doubt(AnswerPart& part, const std::string& reason, Trust at_most = Trust::doubtful) {
  part.trust = std::max(part.trust, at_most);
  part.reasons.push_back(reason);
}

/// "south-east (130°)"
std::string direction_words(double azimuth_deg) {
  return fmt::format("{} ({:.0f}°)", compass_word(azimuth_deg), azimuth_deg);
}

/// Whether azimuths are those of the sky, be it roughly.
bool has_compass(const Measurement& m) { return m.has_azimuth || m.over_horizon; }

/// "12° left", off the middle of a picture whose azimuth is not known.
std::string beside_middle(const Measurement& m, double azimuth_deg) {
  const double off = std::remainder(azimuth_deg - (m.camera ? m.camera->azimuth_deg : 0.0), 360.0);
  return fmt::format("{:.0f}° {}", std::abs(off), off > 0.0 ? "right" : "left");
}

/// "75.94° N, 15.02° E"
std::string place_words(double latitude_deg, double longitude_deg) {
  return fmt::format("{:.1f}° {}, {:.1f}° {}", std::abs(latitude_deg), latitude_deg < 0.0 ? "S" : "N",
                     std::abs(longitude_deg), longitude_deg < 0.0 ? "W" : "E");
}

/// "251 ± 14 km"
std::string with_error(double value, double error, const std::string& unit) {
  return sim::number_with_error(value, error) + " " + unit;
}

/// "251 ± 14 km"; "251 km" if there is no error.
std::string distance_words(double value, double error) {
  return std::isfinite(error) ? fmt::format("{:.0f} ± {:.0f} km", value, std::max(1.0, error))
                              : fmt::format("{:.0f} km", value);
}

/// "runs from the south-east (130°) over the south to the west (265°)"
std::string along_words(const Measurement& m, const MainBorder& b) {
  const double width = std::fmod(b.to_azimuth_deg - b.from_azimuth_deg + 720.0, 360.0);
  if (width > kAllAround_deg) return "goes nearly all around";
  if (!has_compass(m))
    return "runs from " + beside_middle(m, b.from_azimuth_deg) + " to " + beside_middle(m, b.to_azimuth_deg) +
           " of the picture's middle";
  const std::string from = compass_word(b.from_azimuth_deg), to = compass_word(b.to_azimuth_deg);
  if (from == to && width < 90.0)
    return fmt::format("stands in the {} ({:.0f} to {:.0f}°)", from, b.from_azimuth_deg, b.to_azimuth_deg);
  const std::string over =
      width > kHalfAround_deg ? " over the " + compass_word(b.from_azimuth_deg + 0.5 * width) : "";
  return "runs from the " + direction_words(b.from_azimuth_deg) + over + " to the " +
         direction_words(b.to_azimuth_deg);
}

std::string where_sentence(const Measurement& m, const MainBorder& b) {
  return fmt::format(
      "A lower border of aurora {}, {:.0f} to {:.0f}° above the horizon. Its nearest part is {} away, {}{}.",
      along_words(m, b), b.lowest_deg, b.highest_deg, distance_words(b.distance_km, b.distance_error_km),
      has_compass(m) ? "in the " + direction_words(b.azimuth_deg)
                     : beside_middle(m, b.azimuth_deg) + " of the middle",
      m.site && m.has_azimuth ? ", over " + place_words(b.latitude_deg, b.longitude_deg) : "");
}

std::string height_sentence(const Measurement& m, const MainBorder& b) {
  std::string sentence = fmt::format(
      "That is for a border {:.0f} km high, as most are; if it is only {:.0f} km high or as much as {:.0f} "
      "km, it is {:.0f} "
      "or {:.0f} km away.",
      kAssumedBorder_km, kBorderAltitudesKm.front(), kBorderAltitudesKm.back(), b.lowest_distance_km,
      b.highest_distance_km);
  const double probability = m.border->traces[b.trace].aurora_probability;
  if (probability < 0.995)
    sentence += fmt::format(" With a probability of {:.0f} % it is aurora.", 100.0 * probability);
  if (m.border->measured > 1)
    sentence += m.border->measured == 2
                    ? " One more border is in the table."
                    : fmt::format(" {} more borders are in the table.", m.border->measured - 1);
  return sentence;
}

std::string energy_sentence(const MainCurtain& c, Trust trust) {
  return fmt::format(
      "The electrons of {} have a mean energy of {} by the map, which puts its lower border at {}{}.",
      c.is_along_border ? "this arc" : "the brightest curtain",
      with_error(c.energy_kev.value, c.energy_kev.error, "keV"),
      with_error(c.lower_border_km.value, c.lower_border_km.error, "km"),
      trust == Trust::good ? "" : ", with care");
}

AnswerPart direction_part(const Measurement& m) {
  AnswerPart part{"direction", Trust::good, {}};
  if (m.over_horizon)
    doubt(part,
          fmt::format("azimuths are by stars above the skyline, to {:.0f}°, and elevations by the skyline",
                      std::max(1.0, m.over_horizon->azimuth_error_deg)));
  else if (!m.has_azimuth)
    doubt(part, "azimuths count from where the camera looked, and elevations from the skyline");
  if (m.sky_kind && m.sky_kind->aurora < kNoAurora)
    doubt(part, "as a whole the picture looks like a sky without aurora: " + m.sky_kind->sentence);
  if (m.is_skyline_open) doubt(part, "whether this is a border of light or of high ground is not decided");
  return part;
}

AnswerPart distance_part(const Measurement& m, const MainBorder& b, bool is_map_explained) {
  AnswerPart part{"distance", trust_of(Quantity::distance, b.distance_km, b.distance_error_km), {}};
  if (part.trust != Trust::good)
    part.reasons.push_back(fmt::format("its error is {:.0f} %", 100.0 * b.distance_error_km / b.distance_km));
  if (!m.has_azimuth) doubt(part, "the skyline may be a degree or more above the horizon");
  if (m.is_skyline_open) doubt(part, "what was measured may be the ground");
  for (const double km : {b.lower_level_km, b.upper_level_km})
    if (!(std::abs(km - b.distance_km) <= 2.0 * b.distance_error_km)) {
      doubt(part, std::isfinite(b.lower_level_km)
                      ? fmt::format("the border is not sharp: where the light has fallen to three quarters "
                                    "and to one quarter of its "
                                    "peak are {:.0f} and {:.0f} km",
                                    b.upper_level_km, b.lower_level_km)
                      : fmt::format("the border is not sharp: it reaches down to the horizon"));
      break;
    }
  if (!m.map || !is_map_explained) return part;
  const auto& c = m.main_curtain;
  if (!c || !c->is_along_border)
    doubt(part, "the map has no curtain there");
  else if (!c->agrees())
    doubt(part, fmt::format("the map has the same arc {} away, where the border has {}",
                            distance_words(c->distance_km.value, c->distance_km.error),
                            distance_words(c->border_distance_km.value, c->border_distance_km.error)));
  return part;
}

/// Whether the picture is explained by the map.
AnswerPart map_part(const PhotoMap& map) {
  AnswerPart part{"the map as a whole", Trust::good, {}};
  const double chi2 = map.result.chi2_per_value();
  if (!(chi2 <= kExplained))
    doubt(part,
          fmt::format("it does not explain the picture, chi2 per value {}", sim::short_number(chi2, 3)));
  std::size_t quantities = 0, good = 0;
  for (std::size_t i = 2; i < map.verdicts.size(); ++i) {  // after those on the picture and its borders
    ++quantities;
    good += map.verdicts[i].trust == Trust::good ? 1 : 0;
  }
  if (good == 0)
    doubt(part,
          quantities == 0 ? "it has no curtain" : "none of its distances, energies and fluxes is certain");
  return part;
}

AnswerPart energy_part(const PhotoMap& map, const MainCurtain& c, const AnswerPart& distance,
                       bool is_map_explained) {
  AnswerPart part{"energy", Trust::good, {}};
  const double error = c.energy_kev.error / c.energy_kev.value;
  if (map.result.replicates.empty() || !std::isfinite(error))
    doubt(part, "no error bars were asked for");
  else if (const Trust by_error = trust_of(Quantity::energy, c.energy_kev.value, c.energy_kev.error);
           by_error != Trust::good)
    doubt(part, fmt::format("its error is {:.0f} %", 100.0 * error), by_error);
  if (!is_map_explained) doubt(part, "the map does not explain the picture");
  if (c.share_at_end > kEndShare)
    doubt(part, fmt::format("{:.0f} % of the light is at the end of the energies that a map can have",
                            100.0 * c.share_at_end));
  if (!c.agrees())
    doubt(part, "map and border do not place the arc alike");
  else if (distance.trust != Trust::good)
    doubt(part, "it depends on the distance");
  for (const QuantityVerdict& v : map.verdicts)
    if (v.quantity.rfind("energy ", 0) == 0 && v.quantity.rfind("energy flux", 0) != 0 &&
        v.trust > part.trust)
      doubt(part, v.reason, v.trust);
  return part;
}

std::string list_of(const std::vector<AnswerPart>& parts, bool good) {
  std::string list;
  for (const AnswerPart& part : parts) {
    if ((part.trust == Trust::good) != good) continue;
    list += (list.empty() ? "" : good ? ", " : "; ") + part.name;
    if (!good) list += " (" + sim::joined(part.reasons, ", ") + ")";
  }
  return list;
}

std::string trust_sentence(const std::vector<AnswerPart>& parts) {
  const std::string good = list_of(parts, true), other = list_of(parts, false);
  std::string sentence;
  if (!good.empty()) sentence = "To be trusted: " + good + ".";
  if (!other.empty()) sentence += (good.empty() ? "" : " ") + ("With care: " + other + ".");
  return sentence;
}

bool has_recognised_stars(const Measurement& m) { return m.stars && m.stars->blind && m.stars->blind->place; }

std::string lacking_azimuth(const Measurement& m) {
  const std::string what = m.over_horizon ? "The direction of the compass to better than some degrees: "
                                          : "In which direction of the compass: ";
  if (!has_recognised_stars(m)) return what + "stars in the picture would tell, with its time and place.";
  return what + fmt::format("the right {} would tell, since {} stars were recognised.",
                            m.time_utc.empty() && m.site   ? "time (--time)"
                            : m.site || m.time_utc.empty() ? "time and place (--time, --site)"
                                                           : "place (--site)",
                            m.stars->blind->picture.recognition.best.agreement.matches.size());
}

void add_unknown(const Measurement& m, const std::vector<AnswerPart>& parts, MeasureAnswer& answer) {
  const auto is_good = [&](const std::string& name) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const AnswerPart& p) { return p.name == name && p.trust == Trust::good; });
  };
  answer.not_known.emplace_back(
      "How high the border is: a second picture of it, taken at the same moment 50 to 200 km away, would "
      "tell.");
  if (!m.has_azimuth) answer.not_known.push_back(lacking_azimuth(m));
  if (m.is_map_interrupted)
    answer.not_known.emplace_back(
        "Which energy the electrons have: the map was interrupted; the same command with --overwrite makes "
        "it anew.");
  else if (!is_good("energy"))
    answer.not_known.emplace_back(
        "Which energy the electrons have: pictures through filters at the same moment, such as 427.8 and "
        "630.0 "
        "nm, would tell.");
}

MeasureAnswer of_border(const Measurement& m) {
  const MainBorder& b = *m.main_border;
  MeasureAnswer answer;
  answer.sentences = {where_sentence(m, b), height_sentence(m, b)};
  std::vector<AnswerPart> parts = {direction_part(m)};
  AnswerPart whole{"", Trust::good, {}};
  if (m.map) whole = map_part(*m.map);
  const bool is_explained = m.map && m.map->result.chi2_per_value() <= kExplained;
  parts.push_back(distance_part(m, b, is_explained));
  if (m.map) {
    parts.push_back(whole);
    if (m.main_curtain) {
      parts.push_back(energy_part(*m.map, *m.main_curtain, parts[1], is_explained));
      answer.sentences.push_back(energy_sentence(*m.main_curtain, parts.back().trust));
    }
  }
  answer.sentences.push_back(trust_sentence(parts));
  const bool is_good =
      parts[0].trust == Trust::good && parts[1].trust == Trust::good && whole.trust == Trust::good;
  answer.trust = is_good ? Trust::good : Trust::doubtful;
  answer.word = is_good ? "Measured" : "With care";
  add_unknown(m, parts, answer);
  answer.parts = std::move(parts);
  return answer;
}

/// The sky was searched, and no border is claimed.
MeasureAnswer of_no_border(const Measurement& m) {
  MeasureAnswer answer;
  answer.word = "None found";
  answer.sentences.emplace_back("No border of aurora is found.");
  if (const std::string seen = unclaimed_words(*m.border); !seen.empty())
    answer.sentences.push_back("Traced were instead " + seen + ".");
  for (const std::string& note : m.border->notes) {
    if (answer.sentences.size() >= 4) break;
    answer.sentences.push_back(note);
  }
  answer.not_known.emplace_back(
      "Whether there is aurora without a border, such as diffuse light or light overhead: look at the "
      "picture.");
  if (!m.has_azimuth) answer.not_known.push_back(lacking_azimuth(m));
  return answer;
}

/// What is known of time, place and field of view without looking at the picture.
std::string known_words(const Measurement& m) {
  std::vector<std::string> known, unknown;
  const auto sort = [&](bool is_known, const char* what) { (is_known ? known : unknown).emplace_back(what); };
  sort(!m.time_utc.empty(), "the time");
  sort(m.site.has_value(), "the place");
  sort(m.has_field_of_view, "the field of view");
  std::string words;
  if (!known.empty()) words = "Known from the file or the command: " + sim::joined(known, ", ") + ".";
  if (!unknown.empty())
    words += (known.empty() ? "" : " ") + ("Not told: " + sim::joined(unknown, ", ") + ".");
  return words;
}

/// What the stars gave where they gave no camera.
std::string tried_stars(const Measurement& m) {
  if (!m.stars || !m.stars->blind) return "No camera follows from the stars.";
  const StarRecognition& recognition = m.stars->blind->picture.recognition;
  if (m.stars->blind->place)
    return fmt::format(
        "{} stars were recognised, but they are directions only with the right time and place.",
        recognition.best.agreement.matches.size());
  return fmt::format("No stars were recognised among {} points of light.", recognition.points.size());
}

/// Nothing is known of the camera's pointing. In three lines: what is lacking, what was tried, what is
/// needed.
MeasureAnswer of_no_camera(const Measurement& m) {
  MeasureAnswer answer;
  answer.word = "Not measured";
  answer.sentences.emplace_back(
      "Where the camera looked is not known, and so neither direction nor distance of the light.");
  answer.sentences.push_back("Tried: " + tried_stars(m) + " " + known_words(m));
  for (const MeasureStage& stage : m.stages)
    if (stage.title == kHorizonStage) answer.sentences.back() += " " + stage.found;
  if (has_recognised_stars(m)) {
    const bool is_given = !m.time_utc.empty() && m.site;
    answer.sentences.push_back(
        is_given ? "Needed: the right time and place (--time, --site); these stars stood elsewhere then."
                 : std::string("Needed: ") + (m.time_utc.empty() ? "the time (--time)" : "") +
                       (m.time_utc.empty() && !m.site ? " and " : "") +
                       (m.site ? "" : "the place (--site LATITUDE,LONGITUDE)") + ".");
  } else {
    answer.sentences.emplace_back(
        "Needed is one of these: sharper or more stars, with time and place (--time, --site); points on the "
        "horizon and the field of view (vegard horizon); a camera file of this camera (--camera).");
  }
  return answer;
}

}  // namespace measure_sentences

MeasureAnswer measure_answer(const Measurement& m) {
  using namespace measure_sentences;
  if (m.main_border) return of_border(m);
  if (m.border) return of_no_border(m);
  return of_no_camera(m);
}

}  // namespace vegard::fit
