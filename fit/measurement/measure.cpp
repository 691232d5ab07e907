#include "fit/measurement/measure.h"

#include <utility>

#include "fit/measurement/measure_answer.h"
#include "fit/measurement/measure_run.h"
#include "fit/measurement/measure_stages.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::fit {

void measure_before_map(MeasureRun& run) {
  describe_picture(run);
  find_sky(run);
  find_camera(run);
  if (!run.result.camera_file.empty()) run.result.camera = sim::read_scene(run.result.camera_file).camera;
  doubt_skyline(run);
  measure_border(run);
}

void conclude_measurement(MeasureRun& run) {
  Measurement& m = run.result;
  MeasureAnswer answer = measure_answer(m);
  m.trust = answer.trust;
  m.word = std::move(answer.word);
  m.answer = std::move(answer.sentences);
  m.parts = std::move(answer.parts);
  m.not_known = std::move(answer.not_known);
  run.write("report.html", measure_page(m));
  run.write("measure.json", measure_json(m));
  run.follower.tell("");
  for (const std::string& sentence : m.answer) run.follower.tell(sentence);
  for (const std::string& sentence : m.not_known) run.follower.tell("Not known: " + sentence);
  run.follower.tell(run.in_run("report.html"));
}

Measurement measure(const MeasureRequest& request, const MeasureFollower& follower) {
  MeasureRun run(request, follower);
  run.read_given();
  run.claim_folder();
  measure_before_map(run);
  measure_map(run);
  conclude_measurement(run);
  return std::move(run.result);
}

}  // namespace vegard::fit
