#include "fit/survey/survey_frame.h"

#include <algorithm>
#include <cmath>

#include "fit/answer/trust.h"
#include "fit/answer/verdict.h"
#include "fit/border/border.h"
#include "fit/border/border_distance.h"
#include "fit/map/map_fit.h"
#include "fit/parameters/free_parameters.h"
#include "fit/photo/averaging.h"
#include "fit/photo/photo.h"
#include "fit/radar/radar_refusal.h"
#include "fit/report/border/border_run.h"
#include "fit/sequence.h"
#include "fit/survey/survey_physics.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/table_files.h"

namespace vegard::fit {
namespace {

/// Returns an error's words without names of files, which depend on where the program runs.
std::string words_of(const sim::Error& error) {
  const sim::ErrorDetails& d = error.details();
  return d.problem + (d.expected.empty() ? "" : " (expected " + d.expected + ")");
}

WorkAnswer refused_work(SurveyWork work, const sim::Error& error) {
  WorkAnswer answer;
  answer.work = work;
  answer.verdict = "refused";
  answer.words = words_of(error);
  return answer;
}

WorkAnswer filter_answer(const FilterFinding& found) {
  WorkAnswer answer;
  answer.work = SurveyWork::filter;
  answer.verdict = found.sky;
  for (int q = 0; q < kSkyQuestions; ++q)
    answer.quantities.push_back({0,
                                 std::string("score of ") + sky_question_name(static_cast<SkyQuestion>(q)),
                                 "",
                                 found.scores[static_cast<std::size_t>(q)],
                                 {},
                                 {},
                                 {}});
  for (const SkyFeatureWords& words : sky_feature_words()) {
    if (!is_of_surveys(words.feature)) continue;
    answer.quantities.push_back(
        {0, words.name, words.unit, finite_or_none(feature(found.features, words.feature)), {}, {}, {}});
  }
  return answer;
}

WorkAnswer border_answer(const Photo& photo, const sim::Scene& scene, int channel) {
  BorderSettings settings;
  settings.channel = channel;
  const Border border = trace_border(photo, scene, settings);
  WorkAnswer answer;
  answer.work = SurveyWork::border;
  answer.verdict = border.measured > 0 ? "good" : "none";
  if (!border.notes.empty()) answer.words = sim::joined(border.notes, "; ");
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    const BorderTrace& trace = border.traces[t];
    if (trace.measured == 0) continue;
    const BorderSummary s = border_summary(trace, scene);
    const int item = static_cast<int>(t) + 1;
    const auto put = [&](const std::string& name, const std::string& unit, double value,
                         std::optional<double> sigma = std::nullopt) {
      answer.quantities.push_back({item, name, unit, finite_or_none(value), sigma, {}, {}});
    };
    put("points", "", trace.measured);
    put("from azimuth", "deg", s.from_azimuth_deg);
    put("to azimuth", "deg", s.to_azimuth_deg);
    put("lowest elevation", "deg", s.lowest_deg);
    put("highest elevation", "deg", s.highest_deg, finite_or_none(s.nearest_error_deg));
    put("nearest azimuth", "deg", s.nearest_azimuth_deg);
    for (std::size_t h = 0; h < kBorderAltitudesKm.size(); ++h)
      put("distance if " + std::to_string(static_cast<int>(kBorderAltitudesKm[h])) + " km high", "km",
          s.distance_km[h], finite_or_none(s.distance_error_km[h]));
    put("brightness", "white", trace.mean_brightness());
  }
  return answer;
}

/// Returns the last frame's solution as the row that the next frame begins with.
SequenceRow row_of_answer(const WorkAnswer& before) {
  SequenceRow row;
  for (const Verdict known : kVerdicts)
    if (before.verdict == verdict_name(known)) row.verdict = known;
  row.values = before.free_values;
  return row;
}

WorkAnswer fit_answer(const FrameFit& fit, const sim::Scene& scene, const Photo& photo, double time_s) {
  const FitResult& result = fit.result;
  const SequenceRow row = sequence_row("", time_s, scene, fit, photo);
  WorkAnswer answer;
  answer.work = SurveyWork::fit;
  answer.verdict = verdict_name(result.verdict);
  answer.words = result.verdict_line;
  answer.start = fit.searched ? "full" : "warm";
  answer.chi2_per_dof = finite_or_none(row.chi2_per_dof);
  answer.seed = static_cast<std::int64_t>(result.seed);
  answer.free_values = row.values;
  answer.physics = physics_of_row(row);
  for (const SequenceNumber& n : row.numbers) {
    SurveyQuantity quantity{0, n.name, n.unit, finite_or_none(n.value), {}, {}, {}};
    if (n.sigma) quantity.sigma = finite_or_none(*n.sigma);
    answer.quantities.push_back(quantity);
  }
  for (const DerivedNumber& d : result.derived) {
    const auto found = std::find_if(answer.quantities.begin(), answer.quantities.end(),
                                    [&](const SurveyQuantity& q) { return q.name == d.name; });
    SurveyQuantity quantity{0, d.name, d.unit, {}, {}, {}, {}};
    SurveyQuantity& entry = found != answer.quantities.end() ? *found : quantity;
    entry.trust = trust_name(d.trust);
    const std::string& reason = d.why_none.empty() ? d.trust_reason : d.why_none;
    if (!reason.empty()) entry.reason = reason;
    if (found == answer.quantities.end() && !d.why_none.empty()) answer.quantities.push_back(quantity);
  }
  return answer;
}

/// The frame decoded, by what the works want of it.
class FrameInHand {
 public:
  FrameInHand(const PictureBytes& picture, const SurveyEye& eye, const sim::Scene& scene)
      : picture_(picture), eye_(eye), scene_(scene) {}

  /// Returns the frame as the file has it.
  const Photo& whole() {
    if (!whole_) whole_ = read({});
    return *whole_;
  }
  /// Returns the frame averaged as a fit wants it.
  const Photo& for_fit() {
    const Averaging averaging = averaging_for_fit(scene_);
    if (!averaging.any()) return whole();
    if (!averaged_) averaged_ = read(averaging);
    return *averaged_;
  }

 private:
  Photo read(const Averaging& averaging) const {
    return read_photo_of(picture_, eye_.decoding, &scene_, averaging);
  }

  const PictureBytes& picture_;
  const SurveyEye& eye_;
  const sim::Scene& scene_;
  std::optional<Photo> whole_, averaged_;
};

Photo masked(Photo photo, const std::string& mask) {
  if (!mask.empty()) apply_mask(photo, mask);
  return photo;
}

/// Measures or fits one frame, whose time and clock are those of `scene`; none if it was interrupted.
std::optional<WorkAnswer> work_answer(SurveyWork work, const FrameTask& task, const SurveyEye& eye,
                                      const sim::Scene& scene, const FitOptions& options,
                                      FrameInHand& frame) {
  if (work == SurveyWork::border) return border_answer(masked(frame.whole(), eye.mask), scene, eye.channel);
  if (work == SurveyWork::profile) return profile_answer(masked(frame.whole(), eye.mask), scene, eye.channel);
  if (work == SurveyWork::map) {
    MapOptions map_options;
    map_options.threads = options.threads;
    map_options.replicates = kSurveyReplicates;
    map_options.stop = options.stop;
    return map_answer(masked(frame.whole(), eye.mask), scene, map_options);
  }
  const Photo photo = masked(frame.for_fit(), eye.mask);
  const double clock_s = scene.time.start_s;
  const SequenceRow before = task.before != nullptr ? row_of_answer(*task.before) : SequenceRow();
  const FrameFit fit = fit_frame(scene, photo, clock_s, task.before != nullptr ? &before : nullptr, options);
  if (fit.result.verdict == Verdict::interrupted) return std::nullopt;
  return fit_answer(fit, scene, photo, clock_s);
}

void give_up(FrameAnswer& answer, FrameStatus status, const std::string& reason) {
  answer.status = status;
  answer.reason = reason;
}

}  // namespace

PictureBytes SurveyPictures::read(const std::string& name, std::string& sha256) {
  const std::string file = file_of_frame(name);
  const bool is_one_of_many = file != name;
  if (!is_one_of_many) {
    sha256 = sim::sha256_of_file(file);
  } else if (hashed_ != file) {
    hashed_.clear();
    sha256_ = sim::sha256_of_file(file);
    hashed_ = file;
  }
  if (is_one_of_many) sha256 = sha256_;
  return series_.read(name);
}

std::optional<FrameAnswer> survey_frame(const FrameTask& task, const SurveyEye* eye,
                                        const FitOptions& options, SurveyPictures& pictures) {
  const SurveyPlan& plan = *task.plan;
  const PlannedBlock& block = plan.blocks.at(static_cast<std::size_t>(task.block));
  const PlannedFrame& planned = block.frames.at(static_cast<std::size_t>(task.number));
  FrameAnswer answer;
  answer.frame = block.first_frame + task.number;
  answer.block = task.block;
  answer.camera = plan.cameras.at(static_cast<std::size_t>(block.camera)).name;
  answer.file = planned.file;
  answer.time_s = planned.time_s;
  if (!planned.skip.empty() || eye == nullptr) {
    give_up(answer, FrameStatus::skipped, planned.skip);
    return answer;
  }
  const std::string name = plan.place(planned.file);
  const std::string problem = sim::why_no_input(file_of_frame(name));
  if (!problem.empty()) {
    const bool is_missing = problem == "there is no such file";
    give_up(answer, is_missing ? FrameStatus::missing : FrameStatus::unreadable, problem);
    return answer;
  }
  PictureBytes picture;
  std::string sha256;
  try {
    picture = pictures.read(name, sha256);
  } catch (const sim::Error& error) {
    give_up(answer, FrameStatus::unreadable, words_of(error));
  }
  if (!sha256.empty()) answer.sha256 = sha256;
  if (answer.status != FrameStatus::done) return answer;
  sim::Scene scene = eye->scene;
  // The clock of the scene begins with the block: what drifts goes on from frame to frame.
  scene.time.start_s = scene.time.start_s + planned.time_s - block.frames.front().time_s;
  scene.site.time_utc = sim::utc_text(planned.time_s);
  FrameInHand frame(picture, *eye, scene);
  const bool only_fits = std::all_of(plan.work.begin(), plan.work.end(),
                                     [](SurveyWork work) { return work == SurveyWork::fit; });
  try {
    answer.decoding = (only_fits ? frame.for_fit() : frame.whole()).decoding;
  } catch (const sim::Error& error) {
    give_up(answer, FrameStatus::unreadable, words_of(error));
    return answer;
  }
  for (const SurveyWork work : plan.work) {
    try {
      if (work == SurveyWork::filter) {
        const FilterFinding found = eye->filter->classify(frame.whole(), scene, planned.time_s);
        answer.works.push_back(filter_answer(found));
        if (has_arc(found.scores)) continue;
        give_up(answer, FrameStatus::filtered, "no arc: " + found.sky);
        break;
      }
      std::optional<WorkAnswer> done = work_answer(work, task, *eye, scene, options, frame);
      if (!done) return std::nullopt;
      answer.works.push_back(std::move(*done));
    } catch (const sim::Error& error) {
      answer.works.push_back(refused_work(work, error));
    }
  }
  if (options.stop != nullptr && options.stop->load()) return std::nullopt;
  return answer;
}

const SurveyEye& LatestEye::of(int camera, int calibration) {
  const std::pair key{camera, calibration};
  if (!eye_ || key_ != key) {
    eye_ = make_(camera, calibration);
    key_ = key;
  }
  return *eye_;
}

void check_eye(const SurveyEye& eye, const std::vector<SurveyWork>& work) {
  const sim::Scene& scene = eye.scene;
  const auto wants = [&](SurveyWork one) { return std::count(work.begin(), work.end(), one) > 0; };
  const auto fault = [&](const std::string& key, const std::string& problem) {
    return sim::Error(sim::ErrorKind::scene, problem)
        .file(scene.file)
        .line(sim::line_of(scene, key))
        .key(key);
  };
  if (wants(SurveyWork::filter) && !(sim::is_latitude_given(scene) && sim::is_longitude_given(scene)))
    throw fault("site.latitude_deg, site.longitude_deg",
                "the filter asks where the Sun and the Moon are, and the site is not given")
        .expected("[site] with latitude_deg and longitude_deg")
        .hint("or a survey whose work is not \"filter\"");
  if (wants(SurveyWork::profile) && eye.decoding.kind == Decoding::Kind::unknown)
    throw fault("fit.decoding", "light cannot be measured through an unknown transfer curve")
        .expected("a decoding that is known")
        .hint("vegard fit --decoding unknown finds the curve of one frame");
  for (const SurveyWork one : work) {
    if (one != SurveyWork::fit && one != SurveyWork::map) continue;
    refuse_radars(scene, "a survey");
    if (!scene.fit.photos.empty())
      throw fault("fit.photo", "a survey takes one photograph after another")
          .expected("a scene without [[fit.photo]]")
          .hint("vegard fit and vegard map take them all at once");
    if (one == SurveyWork::fit && free_numbers(scene).empty())
      throw fault("fit.free", "nothing is free")
          .expected("a scene with fit.free")
          .hint("or a survey whose work is not \"fit\"");
    if (eye.decoding.kind == Decoding::Kind::unknown)
      throw fault("fit.decoding", "a survey's camera has one transfer curve")
          .expected("one that is known")
          .hint("fit one frame by itself with --decoding unknown, and give all the curve that it finds");
  }
  if (!eye.mask.empty())
    if (const std::string problem = sim::why_no_input(eye.mask); !problem.empty())
      throw sim::unreadable(eye.mask, problem).expected("a mask");
}

std::string eye_sha256(const SurveyEye& eye, const std::string& decoding) {
  sim::Sha256 sum;
  const auto add = [&](const std::string& what, const std::string& bytes) {
    sum.add(what + " " + std::to_string(bytes.size()) + "\n" + bytes + "\n");
  };
  add("scene", sim::write_scene(eye.scene));
  for (const auto& [path, text] : eye.scene.tables) add(path, text);
  if (eye.scene.emission.folder)
    for (const auto& [file, text] : eye.scene.emission.folder->files)
      add(sim::emission_file_path(file), text);
  for (const sim::NamedFile& named : sim::named_files(eye.scene))
    for (const std::string& name : sim::files_of_name(named.name))
      add(named.path, sim::sha256_of_file(sim::table_place(eye.scene, name)));
  add("mask", eye.mask.empty() ? "" : sim::sha256_of_file(eye.mask));
  // A curve's file counts, not where it stands.
  const std::string file = decoding.empty() ? "" : sim::decoding_word(decoding).file;
  add("decoding", file.empty() ? decoding : sim::sha256_of_file(file));
  add("channel", std::to_string(eye.channel));
  if (eye.filter != nullptr) add("filter", eye.filter->sha256());
  return sum.digest();
}

}  // namespace vegard::fit
