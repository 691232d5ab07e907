#include "fit/survey/survey_answer.h"

namespace vegard::fit {

const char* frame_status_name(FrameStatus status) {
  switch (status) {
    case FrameStatus::done:
      return "done";
    case FrameStatus::skipped:
      return "skipped";
    case FrameStatus::missing:
      return "missing";
    case FrameStatus::unreadable:
      return "unreadable";
    case FrameStatus::filtered:
      return "filtered";
  }
  return "";
}

}  // namespace vegard::fit
