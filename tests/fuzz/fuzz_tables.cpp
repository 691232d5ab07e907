// Any text as one of the tables that people write. The first letter of an input chooses whose, as in
// `readers`; the rest is the table. What is read is worked out as far as its user does it.
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "apps/options/picture_lists.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "fit/photo/pointing/star_table.h"
#include "fit/photo/rayleigh/rayleigh_camera.h"
#include "fit/radar/density_table.h"
#include "fit/report/ionosphere/electron_source.h"
#include "fit/report/netcdf/keyed_table.h"
#include "fit/sky_kind/sky_model.h"
#include "fit/survey/survey.h"
#include "fit/survey/survey_plan.h"
#include "fit/track/satellite_track.h"
#include "fit/track/sgp4.h"
#include "fit/triangulation/sight_table.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/mask5.h"
#include "sim/base/utc_time.h"
#include "sim/light/reactions.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/light/transport/field_air.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/curve_table.h"
#include "sim/scene/file/precipitation_file.h"
#include "sim/view/colour/colour_table.h"
#include "sim/view/colour/sensor_response.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard;
using tests::require;

void csv(const std::string& text) {
  const sim::CsvTable table = sim::read_csv_table(text, "it.csv");
  require(table.rows() > 0 && table.columns.size() == table.numbers.size());
  for (const std::string& name : table.columns)
    for (const double number : table.column(name)) require(std::isfinite(number));
}

void height_profile(const std::string& text) {
  sim::Scene scene;
  scene.sheets.emplace_back();
  scene.sheets[0].profile = sim::ProfileKind::file;
  scene.sheets[0].profile_file = "it.csv";
  scene.tables["sheet." + scene.sheets[0].name + ".profile_file"] = text;
  sim::check_profiles(scene);
}

/// As each kind of file in a folder of emission tables.
void emission_tables(const std::string& text) {
  const sim::CsvTable csv = sim::read_csv_table(text, "it.csv");
  const auto tried = [](const auto& read) {
    try {
      read();
    } catch (const sim::Error&) {
    }
  };
  tried([&] {
    const sim::EmissionTable table(csv);
    for (const std::string& column : table.columns())
      require(table.at_energy(column, 3.0, 1.1).size() == table.altitudes_km().size());
    sim::tables_air(csv, table.altitudes_km());
  });
  tried([&] {
    const sim::FluxFactors factors({"ver_5577"}, csv, csv);
    factors.at("ver_5577", 3.0, 0.5);
  });
  tried([&] { require(sim::tables_air(csv, csv.column("altitude_km")).size() == csv.rows()); });
}

void response(const std::string& text) {
  sim::Scene scene;
  scene.sensor.response = "it.csv";
  scene.tables["sensor.response"] = text;
  for (const auto per : {sim::ResponsePer::energy, sim::ResponsePer::photon}) {
    scene.sensor.response_per = per;
    const sim::SensorResponse response(scene);
    for (const double nm : {427.8, 557.7, 630.0}) response.rgb_per_kilorayleigh(nm);
  }
  scene.sensor.white_balance_rule = sim::WhiteBalanceRule::daylight;
  scene.sensor.matrix_rule = sim::MatrixRule::colorimetric;
  const sim::SensorResponse balanced(scene);
}

void tone(const std::string& text) {
  const sim::ToneCurve curve = sim::ToneCurve::of_table(text, "it.csv");
  for (const double x : {-1.0, 0.0, 0.1, 0.5, 1.0, 2.0}) {
    require(std::isfinite(curve.encode(x)));
    require(std::isfinite(curve.decode(x)));
  }
}

void colours(const std::string& text) {
  sim::Scene scene;
  scene.sensor.colour_table = "it.csv";
  scene.tables["sensor.colour_table"] = text;
  const sim::ColourTable table(scene);
  for (const double grey : {-1.0, 0.0, 0.3, 1.0, 2.0})
    for (const double value : table.at(grey)) require(value >= 0.0 && value <= 1.0);
}

/// A text, or what solve-field writes.
void stars(const std::string& text) {
  const tests::InputFile file(text, "it.csv");
  fit::SkyOfPicture sky;
  sky.julian_date = 2458849.5;
  sky.observer = sim::Observer{65.0, 20.0, 100.0};
  for (const fit::StarSighting& star : fit::read_star_table(file.path("it.csv"), sky)) {
    require(std::isfinite(star.x_px) && std::isfinite(star.y_px));
    for (const double part : star.enu) require(std::isfinite(part));
  }
}

void pictures(const std::string& text) {
  const tests::InputFile file(text, "it.txt");
  for (const apps::SequencePhoto& photo : apps::sequence_photos({file.path("it.txt")}, {}))
    require(!photo.file.empty() && std::isfinite(photo.time_s));
}

void times(const std::string& text) {
  const tests::InputFile file(text, "it.csv");
  const apps::TimedPictures pictures =
      apps::timed_pictures({"a.png", "b.png"}, {file.path("it.csv"), {}, {}});
  require(pictures.files.size() == 2 && pictures.times.seconds.size() == 2);
  for (const double seconds : pictures.times.seconds) require(std::isfinite(seconds));
}

void camera(const std::string& text) {
  const tests::InputFile file(text, "it.toml");
  sim::Scene scene;
  sim::take_camera(scene, file.path("it.toml"));
}

void mask(const std::string& text) { require(std::isfinite(sim::read_mask5(text, "it.txt").sum())); }

/// Not a file, but words of one and names of others.
void moments(const std::string& text) {
  if (const auto seconds = sim::utc_seconds(text)) sim::utc_text(*seconds);
  if (const auto time = sim::time_in_name(text)) sim::utc_text(time->utc_s());
  sim::offset_minutes(text);
}

void curtains(const std::string& text) {
  for (const int curtain : {1, 2}) {
    sim::Sheet sheet;
    sim::take_curtain(text, "it.csv", curtain, false, sheet);
    require(!sheet.east_km.empty() && sheet.energy_flux_mw_m2 > 0.0);
    for (const std::vector<double>* list : {&sheet.east_km, &sheet.north_km, &sheet.point_brightness,
                                            &sheet.point_energy_kev, &sheet.point_width_km}) {
      require(list->size() == sheet.east_km.size());
      for (const double number : *list) require(std::isfinite(number));
    }
  }
}

/// A FITS file.
void precipitation(const std::string& bytes) {
  const tests::InputFile file(bytes, "it.fits");
  const sim::PrecipitationMap map = sim::read_precipitation_map(file.path("it.fits"));
  const std::size_t cells = static_cast<std::size_t>(map.columns) * map.rows;
  require(map.energy_flux_mw_m2.size() == cells && map.energy_kev.size() == cells);
  for (std::size_t i = 0; i < cells; ++i)
    require(map.energy_flux_mw_m2[i] >= 0.0f &&
            (map.energy_flux_mw_m2[i] > 0.0f || map.energy_kev[i] == 0.0f));
}

void survey(const std::string& text) {
  const fit::Survey survey = fit::parse_survey(text, "it.toml");
  require(!survey.cameras.empty() && !survey.work.empty() && survey.block_frames > 0);
  for (const fit::SurveyCamera& camera : survey.cameras)
    require(!camera.frames.empty() && !camera.calibrations.empty());
}

/// What is read comes back to the last bit.
void plan(const std::string& text) {
  const fit::SurveyPlan plan = fit::plan_of_json(text, "it.json");
  const std::string again = fit::plan_json(plan);
  require(fit::plan_json(fit::plan_of_json(again, "it.json")) == again);
  for (const int shards : {1, 3}) fit::blocks_of_shard(plan, 1, shards);
}

void survey_list(const std::string& text) {
  const tests::InputFile file(text, "it.txt");
  fit::Survey survey;
  survey.file = file.path("it.toml");
  survey.cameras.emplace_back();
  survey.cameras[0].frames = {"it.txt"};
  const fit::ListedFrames listed = fit::survey_frames(survey, survey.cameras[0]);
  for (const fit::PlannedFrame& frame : listed.frames) require(std::isfinite(frame.time_s));
}

void air(const std::string& text) {
  const sim::FieldAir column = sim::field_air(sim::read_air_table(text, "it.csv"), 77.0, 0.1);
  require(column.size() > 1 && column.path_cm.front() == 0.0);
  for (std::size_t m = 0; m < column.size(); ++m) {
    require(std::isfinite(column.path_cm[m]) && column.temperature_k[m] > 0.0);
    for (const std::vector<double>& gas : column.density_cm3) require(std::isfinite(gas[m]) && gas[m] >= 0.0);
  }
}

using Reader = void (*)(const std::string&);
void sky_model(const std::string& text) {
  const fit::SkyModel model(text, "it.json");
  for (const double value : {-1e9, 0.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    fit::SkyFeatures features{};
    features.fill(value);
    model.scores(features);
  }
}

void reactions(const std::string& text) {
  const sim::RatesAtPlace rates = sim::Reactions::changed(text, "it.csv").at(200.0, 2000.0);
  require(rates(sim::Reaction::o1s_5577) >= 0.0);
}

/// What takes a factor is read as it was meant.
void counts(const std::string& text) {
  const fit::RayleighCamera camera = fit::parse_rayleigh_camera(text, "it.toml");
  require(!camera.filters.empty());
  for (const fit::RayleighFilter& filter : camera.filters) {
    require(!filter.name.empty() && filter.band.line_nm > 0.0);
    const bool has_band = filter.band.width_nm > 0.0 || !filter.band.table_nm.empty();
    if (has_band) require(std::isfinite(fit::star_photons_in_band(filter.band, 1.0, 0.5)));
    const std::string with = fit::with_factor(text, "it.toml", filter.name, {12.5, 0.5});
    require(fit::filter_called(fit::parse_rayleigh_camera(with, "it.toml"), filter.name).factor->value ==
            12.5);
  }
}

void aida_cameras(const std::string& text) {
  for (const fit::AidaCamera& camera : fit::read_aida_cameras(text, "it.acc")) {
    const sim::DirectionMap map = fit::directions_of_aida(camera, 3, 2);
    require(map.azimuth_deg.size() == 6 && map.elevation_deg.size() == 6);
  }
}

/// A FITS header.
void solutions(const std::string& bytes) {
  fit::SipWcs wcs = fit::read_sip_wcs(bytes, "it.wcs");
  wcs.width_px = 3;
  wcs.height_px = 2;
  const sim::DirectionMap map = fit::directions_of_wcs(wcs, {65.0, 20.0, 100.0, true}, 2458849.5);
  require(map.azimuth_deg.size() == 6 && map.elevation_deg.size() == 6);
}

/// By its first two columns, as those of netCDF are.
void keyed_tables(const std::string& text) {
  const fit::TextTable table = fit::read_text_table(text, "it.csv");
  if (table.columns.size() < 3) return;
  const std::vector<std::string> keys = {table.columns[0], table.columns[1]};
  const fit::KeyedTable keyed(table, keys);
  const std::size_t places = keyed.places(keys[0]).size() * keyed.places(keys[1]).size();
  require(keyed.numbers(table.columns[2], keys).size() == places);
}

/// What cameras see, of two.
void sights(const std::string& text) {
  for (const fit::SightedFeature& feature : fit::read_sights(text, "it.csv", {"a.toml", "b.toml"}, {})) {
    require(!feature.name.empty() && (feature.curves.empty() || feature.curves.size() > 1));
    for (const fit::Sight& sight : feature.sights)
      require(sight.camera < 2 && std::isfinite(sight.pixel.x_px) && std::isfinite(sight.pixel.y_px));
    for (const fit::PictureCurve& curve : feature.curves)
      require(curve.camera < 2 && curve.points.size() > 1 && curve.points.size() == curve.error_px.size());
  }
}

void tracks(const std::string& text) {
  for (const fit::SatellitePoint& point : fit::read_track(text, "it.csv"))
    require(std::isfinite(point.time_s) && std::abs(point.place.latitude_deg) <= 90.0 &&
            std::isfinite(point.place.longitude_deg) && std::isfinite(point.place.height_km));
}

/// Two lines of an orbit.
void elements(const std::string& text) {
  for (const fit::OrbitalElements& of : fit::read_orbital_elements(text, "it.tle")) {
    const fit::OrbitState state = fit::Sgp4(of, "it.tle").at(30.0);
    for (int i = 0; i < 3; ++i) require(std::isfinite(state.km[i]) && std::isfinite(state.km_s[i]));
  }
}

/// An answer of vegard invert.
void electrons(const std::string& text) {
  const tests::InputFile file(text, "it.json");
  for (const sim::ElectronEstimate& row : fit::read_electron_source(file.path("it.json"), "", 0.0).rows)
    require(row.energy_kev > 0.0 && row.energy_flux_mw_m2 >= 0.0);
}

/// A radar's profiles.
void densities(const std::string& text) {
  const fit::DensityTable table = fit::density_table_of_csv(text, "it.csv", 80.0, 150.0);
  require(!table.profiles.empty() && table.altitude_km.size() >= fit::kLeastAltitudes);
  for (const fit::DensityProfile& profile : table.profiles)
    for (std::size_t i = 0; i < table.altitude_km.size(); ++i)
      require(std::isfinite(profile.density_cm3[i]) == (profile.sigma_cm3[i] > 0.0));
}

constexpr Reader kReaders[] = {
    csv,    height_profile, response,        tone,      colours,       stars,     pictures,     times,
    camera, mask,           moments,         curtains,  precipitation, survey,    plan,         survey_list,
    air,    sky_model,      emission_tables, reactions, aida_cameras,  solutions, keyed_tables, counts,
    sights, tracks,         elements,        electrons, densities};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Reader reader = kReaders[(data[0] + 256u - 'a') % 256u % std::size(kReaders)];
  tests::read_or_refused([&] { reader(text); });
  return 0;
}
