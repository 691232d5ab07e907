// Plans and answers made by hand, with all that is awkward in them.
#pragma once

#include <cmath>
#include <string>

#include "fit/survey/survey.h"
#include "fit/survey/survey_plan.h"
#include "sim/base/file/sha256.h"

namespace vegard::tests {

/// Blocks of so many frames of a camera "gill", a frame every 3 s, 1 s of work each.
inline fit::SurveyPlan made_survey_plan(int blocks, int frames, const std::string& name = "night") {
  fit::SurveyPlan plan;
  plan.name = name;
  plan.folder = ".";
  plan.version = "0.1.0";
  plan.work = {fit::SurveyWork::border, fit::SurveyWork::fit};
  plan.cameras.emplace_back();
  plan.cameras[0].name = "gill";
  plan.cameras[0].calibrations.emplace_back();
  plan.inputs = {{"the survey", std::string(64, 'a')},
                 {"the setup of gill, calibration 1", std::string(64, 'b')}};
  for (int b = 0; b < blocks; ++b) {
    plan.blocks.emplace_back();
    fit::PlannedBlock& block = plan.blocks.back();
    block.calibration = 0;
    block.first_frame = b * frames;
    block.seconds = frames;
    for (int f = 0; f < frames; ++f)
      block.frames.push_back(
          {"gill/" + std::to_string(b * frames + f) + ".png", 1551478200.25 + 3.0 * (b * frames + f), {}});
  }
  plan.sha256 = sim::sha256(fit::plan_json(plan));
  return plan;
}

/// Every fifth frame is missing.
inline fit::FrameAnswer made_answer(const fit::SurveyPlan& plan, int block, int number) {
  const fit::PlannedBlock& planned = plan.blocks[static_cast<std::size_t>(block)];
  fit::FrameAnswer answer;
  answer.frame = planned.first_frame + number;
  answer.block = block;
  answer.camera = "gill";
  answer.file = planned.frames[static_cast<std::size_t>(number)].file;
  answer.time_s = planned.frames[static_cast<std::size_t>(number)].time_s;
  if (answer.frame % 5 == 2) {
    answer.status = fit::FrameStatus::missing;
    answer.reason = "there is no such file";
    return answer;
  }
  answer.sha256 = sim::sha256(answer.file);
  answer.decoding = "sRGB (8-bit PNG, assumed)";
  fit::WorkAnswer border;
  border.work = fit::SurveyWork::border;
  border.verdict = "none";
  border.words = "No light with an edge, it's \"dark\", caf\xc3\xa9";
  fit::WorkAnswer fit;
  fit.work = fit::SurveyWork::fit;
  fit.verdict = "good";
  fit.start = number == 0 ? "full" : "warm";
  fit.chi2_per_dof = 1.0 / 3.0;
  fit.seed = 9223372036854775807;
  fit.free_values = {1.0 / 3.0, -1e-300, 235.0, std::sqrt(answer.frame + 0.5)};
  fit.physics =
      "{\"modes_sha256\":\"made\",\"modes\":[1],\"information\":[[3.0]],\"towards\":[1.5],\"lines\":[{\"nm\":"
      "630.0,\"over_nm\":557.7,\"ln_ratio_by_mode\":[0.3]}],\"numbers\":{\"distance of the main sheet\":"
      "{\"relative\":true,\"by_mode\":[2.0]}}}";
  fit.quantities = {{0, "distance of the main sheet", "km", 220.0 + answer.frame, 3.25, "good", {}},
                    {0,
                     "energy flux Q of the main sheet",
                     "mW m\xe2\x81\xbb\xc2\xb2",
                     {},
                     {},
                     "unconstrained",
                     "no gain is known"},
                    {0, "sheet.main.energy_kev", "keV", std::sqrt(answer.frame), {}, {}, {}}};
  answer.works = {border, fit};
  return answer;
}

}  // namespace vegard::tests
