#include "fit/survey/report/survey_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "fit/report/table/shared_physics_files.h"
#include "fit/survey/report/survey_pages.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_directory.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

constexpr const char *kIndex = "index.html", *kPhysicsEnd = "-physics.csv";
constexpr std::size_t kMaxIndexBytes = 256u << 20;

bool is_night_file(const std::string& name) {
  const auto ends_with = [&](const std::string& end) {
    return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  return name.rfind("night-", 0) == 0 && (ends_with(".html") || ends_with(kPhysicsEnd));
}

sim::KnownFolder look_at_report(const std::string& directory) {
  sim::KnownFolder known;
  const sim::InputFile file = sim::read_input(directory + "/" + kIndex, kMaxIndexBytes);
  if (!file.problem.empty())
    known.objection = "its index.html " + file.problem;
  else if (file.bytes.substr(0, 300).find("content=\"vegard survey report\"") == std::string::npos)
    known.objection = "its index.html is none that vegard wrote";
  known.has = [](const std::string& name) { return name == kIndex || is_night_file(name); };
  return known;
}

/// Takes the fits of all cameras of a night together, and writes the table of their answers.
void add_physics(const sim::WholeDirectory& whole, ShownNight& night) {
  std::vector<FrameOfNight> fits;
  NamesOfFrames names{"camera,file,time_utc", {}};
  for (const ShownCamera& camera : night.cameras)
    for (const FitOfNight& fit : camera.digest.fits) {
      fits.push_back(fit.answer);
      names.rows.push_back(sim::csv_cell(camera.digest.camera) + "," + sim::csv_cell(fit.file) + "," +
                           sim::utc_text(fit.time_s));
    }
  if (fits.size() < 2) return;
  night.physics = share_physics(fits);
  night.physics_file = "night-" + night.name + kPhysicsEnd;
  sim::write_whole(whole.file(night.physics_file), shared_physics_csv(*night.physics, names));
}

/// The scenes of a plan's blocks, each read once.
class SitesOfPlan {
 public:
  explicit SitesOfPlan(const SurveyFrames& frames) : frames_(frames) {}

  const sim::Site* of(int block) {
    if (frames_.plan == nullptr || block < 0 || block >= static_cast<int>(frames_.plan->blocks.size()))
      return nullptr;
    const PlannedBlock& planned = frames_.plan->blocks[static_cast<std::size_t>(block)];
    if (planned.calibration < 0) return nullptr;
    const std::pair key{planned.camera, planned.calibration};
    auto found = sites_.find(key);
    if (found == sites_.end()) {
      const sim::Scene scene = frames_.eye(planned.camera, planned.calibration).scene;
      found =
          sites_.emplace(key, sim::is_latitude_given(scene) ? std::optional(scene.site) : std::nullopt).first;
    }
    return found->second ? &*found->second : nullptr;
  }

 private:
  const SurveyFrames& frames_;
  std::map<std::pair<int, int>, std::optional<sim::Site>> sites_;
};

void require_plan_of(const SurveyReader& reader, const SqliteFile& database, const SurveyFrames& frames) {
  if (frames.plan == nullptr) return;
  if (reader.plans().size() != 1)
    throw sim::Error(sim::ErrorKind::usage, "is merged of several plans")
        .file(database.name())
        .key("--plan")
        .hint("leave out --plan");
  if (reader.plans()[0].sha256 != frames.plan->sha256)
    throw sim::Error(sim::ErrorKind::usage, "is not of the plan '" + frames.plan->file + "'")
        .file(database.name())
        .key("--plan")
        .hint("the plan that the survey was run by");
}

SurveyFacts facts_of(const SurveyReader& reader, const SurveyNights& nights, int frames) {
  SurveyFacts facts;
  int planned = 0;
  for (const AnsweredPlan& plan : reader.plans()) {
    facts.name += (facts.name.empty() ? "" : ", ") + plan.name;
    planned += plan.frames;
  }
  for (const SurveyReader::Origin& origin : reader.origins()) {
    const AnsweredPlan& plan = reader.plans()[static_cast<std::size_t>(origin.plan)];
    facts.origins.push_back(origin.versions.words() + "; plan " + plan.name + " (sha256 " + plan.sha256 +
                            ")");
  }
  facts.lacking = std::max(0, planned - frames);
  constexpr int kSecondsOfAnHour = 3600;
  facts.first_hour = nights.begins_at_s / kSecondsOfAnHour;
  return facts;
}

/// Returns links from the report's folder to a frame's file.
FrameLink link_from(const std::string& folder, const SurveyPlan* plan) {
  if (plan == nullptr) return {};
  std::error_code error;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, error), error);
  return [from, plan](const NamedFrame& frame) {
    std::error_code ignored;
    const std::string file = plan->place(frame_reference(frame.file).file);
    if (!fs::exists(file, ignored)) return std::string();
    return fs::weakly_canonical(fs::absolute(file, ignored), ignored)
        .lexically_relative(from)
        .generic_string();
  };
}

double median_of(const std::vector<FollowedPoint>& points) {
  std::vector<double> values;
  for (const FollowedPoint& point : points) values.push_back(point.value);
  return share_of_numbers(values, 0.5);
}

ListedNight row_of_night(const ShownNight& night) {
  ListedNight row;
  row.name = night.name;
  row.file = night.file;
  row.energy_kev = row.distance_km = sim::kNaN;
  for (const ShownCamera& camera : night.cameras) {
    const NightDigest& d = camera.digest;
    row.frames += d.frames;
    add_verdicts(d.verdicts, row.verdicts);
    if (std::isnan(row.energy_kev)) row.energy_kev = median_of(points_of(d, FollowedKind::energy));
    if (std::isnan(row.distance_km)) row.distance_km = median_of(points_of(d, FollowedKind::distance));
  }
  return row;
}

}  // namespace

SurveyReport write_survey_report(const SqliteFile& database, const std::string& folder,
                                 const SurveyReportOptions& options) {
  const SurveyReader reader(database);
  require_plan_of(reader, database, options.frames);
  sim::WholeDirectory whole(folder, options.overwrite, {"a survey's report", look_at_report, {kIndex}});
  const SurveyNights nights = survey_nights(database);
  SurveyFacts facts =
      facts_of(reader, nights, static_cast<int>(database.integer("SELECT count(*) FROM frame")));
  const FrameLink link = link_from(folder, options.frames.plan);
  SitesOfPlan sites(options.frames);
  const SiteOfBlock site_of = [&](int block) { return sites.of(block); };
  SurveyReport report;
  SurveySum sum;
  std::vector<NightMinutes> minutes_of_nights;
  StripScales scales;
  for (std::size_t n = 0; n < nights.nights.size(); ++n) {
    const SurveyNight& night = nights.nights[n];
    ShownNight shown;
    shown.name = night.name;
    shown.file = night_file_name(night.name);
    if (n > 0) shown.before = nights.nights[n - 1].name;
    if (n + 1 < nights.nights.size()) shown.after = nights.nights[n + 1].name;
    double first_s = 0.0, last_s = 0.0;
    for (const CameraNight& camera : night.cameras) {
      ShownCamera one;
      one.digest = digest_night(reader, camera, site_of);
      add_motion(database, camera, one.digest);
      first_s = shown.cameras.empty() ? one.digest.first_s : std::min(first_s, one.digest.first_s);
      last_s = shown.cameras.empty() ? one.digest.last_s : std::max(last_s, one.digest.last_s);
      sum.add(one.digest);
      shown.cameras.push_back(std::move(one));
    }
    const ShownSpan span{first_s, std::max(last_s, first_s + 1.0)};
    for (std::size_t c = 0; c < shown.cameras.size(); ++c) {
      ShownCamera& one = shown.cameras[c];
      if (!options.keograms) {
        one.keogram_note = "No keogram was asked for.";
        continue;
      }
      const NightKeogram made = night_keogram(reader, night.cameras[c], options.frames, options.max_columns);
      if (made.keogram) {
        ++report.keograms;
        one.keogram = plot_svg(keogram_with_border(*made.keogram, one.digest, span));
        one.keogram_note = "Keogram of " + std::to_string(made.columns) + " frames" +
                           (made.unreadable > 0 ? "; " + std::to_string(made.unreadable) +
                                                      " more were not to be read or did not fit"
                                                : "") +
                           ".";
      } else {
        one.keogram_note = "There is no keogram: " + made.why_none + ".";
        if (report.why_no_keogram.empty()) report.why_no_keogram = made.why_none;
      }
    }
    add_physics(whole, shown);
    sim::write_whole(whole.file(shown.file), night_page(facts, shown, link));
    sum.nights.push_back(row_of_night(shown));
    std::vector<const NightDigest*> digests;
    for (const ShownCamera& camera : shown.cameras) digests.push_back(&camera.digest);
    minutes_of_nights.push_back(night_minutes(digests, night.begin_s));
    scales.add(minutes_of_nights.back());
    if (options.progress) options.progress(static_cast<double>(n + 1) / nights.nights.size());
  }
  for (std::size_t n = 0; n < minutes_of_nights.size(); ++n)
    sum.nights[n].strip = night_strip(minutes_of_nights[n], scales);
  sim::write_whole(whole.file(kIndex), survey_page(facts, sum, link));
  whole.commit();
  report.nights = static_cast<int>(nights.nights.size());
  return report;
}

}  // namespace vegard::fit
