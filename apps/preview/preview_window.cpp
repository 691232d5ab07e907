#include "apps/preview/preview_window.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iterator>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>

namespace vegard::apps {
namespace {

/// Keys as the window system numbers them; those of the number pad have numbers of their own.
struct KeyCode {
  int code;
  WindowKey key;
  char letter;
};
constexpr KeyCode kKeyCodes[] = {
    {0xff51, WindowKey::left, 0},     {0xff96, WindowKey::left, 0},      {0xff52, WindowKey::up, 0},
    {0xff97, WindowKey::up, 0},       {0xff53, WindowKey::right, 0},     {0xff98, WindowKey::right, 0},
    {0xff54, WindowKey::down, 0},     {0xff99, WindowKey::down, 0},      {0xff55, WindowKey::page_up, 0},
    {0xff9a, WindowKey::page_up, 0},  {0xff56, WindowKey::page_down, 0}, {0xff9b, WindowKey::page_down, 0},
    {0xffab, WindowKey::letter, '+'}, {0xffad, WindowKey::letter, '-'},  {27, WindowKey::escape, 0},
    {0xff1b, WindowKey::escape, 0}};

}  // namespace

bool has_display() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return true;
  }
  return false;
}

bool display_answers() {
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO), ::dup2(nowhere, STDOUT_FILENO);
    try {
      cv::namedWindow("vegard", cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Where the mouse was when it was last looked at.
struct PreviewWindow::Mouse {
  bool held = false;
  int x = 0, y = 0;
  double dragged_x = 0.0, dragged_y = 0.0, wheel = 0.0;

  static void event(int what, int x, int y, int flags, void* data) {
    Mouse& mouse = *static_cast<Mouse*>(data);
    // The upper half of the flags, 120 a notch (cv::getMouseWheelDelta() is missing in some builds).
    if (what == cv::EVENT_MOUSEWHEEL) mouse.wheel += static_cast<std::int16_t>(flags >> 16) / 120.0;
    if (what == cv::EVENT_LBUTTONUP) mouse.held = false;
    if (what == cv::EVENT_MOUSEMOVE && mouse.held) {
      mouse.dragged_x += x - mouse.x;
      mouse.dragged_y += y - mouse.y;
    }
    if (what == cv::EVENT_LBUTTONDOWN) mouse.held = true;
    mouse.x = x, mouse.y = y;
  }
};

PreviewWindow::PreviewWindow(const std::string& title) : title_(title), mouse_(std::make_unique<Mouse>()) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  open();
}

void PreviewWindow::open() {
  cv::namedWindow(title_, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
  cv::setMouseCallback(title_, &Mouse::event, mouse_.get());
}

PreviewWindow::~PreviewWindow() {
  try {
    cv::destroyAllWindows();
  } catch (const std::exception&) {
    // It is closed already.
  }
}

void PreviewWindow::show(const ScreenPicture& picture, const std::vector<std::string>& lines) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  constexpr double kScale = 0.45;
  int y = 16;
  for (const std::string& line : lines) {
    // Dark under light, to be read before any sky.
    for (const auto& [colour, thickness] :
         {std::pair(cv::Scalar(0, 0, 0), 3), {cv::Scalar(255, 255, 255), 1}})
      cv::putText(bgr, line, {8, y}, cv::FONT_HERSHEY_SIMPLEX, kScale, colour, thickness, cv::LINE_AA);
    y += 17;
  }
  cv::imshow(title_, bgr);
  shown_ = true;
}

WindowEvents PreviewWindow::wait(int ms) {
  // The codes of X11 for what is no letter; those of the numeric keypad mean the same.
  const int code = cv::waitKeyEx(std::max(1, ms));
  WindowEvents events;
  std::swap(events.dragged_x_px, mouse_->dragged_x);
  std::swap(events.dragged_y_px, mouse_->dragged_y);
  std::swap(events.wheel, mouse_->wheel);
  if (events.wheel != 0.0 && shown_) {
    // Qt magnifies what it shows by the wheel itself, and knows no way back but a window again.
    const cv::Rect place = cv::getWindowImageRect(title_);
    cv::destroyWindow(title_);
    open();
    cv::moveWindow(title_, place.x, place.y);
    shown_ = false;
    mouse_->held = false;
  }
  const auto known = std::find_if(std::begin(kKeyCodes), std::end(kKeyCodes), [&](const KeyCode& one) {
    return code >= 0 && one.code == (code & 0xffff);
  });
  if (known != std::end(kKeyCodes))
    events.key = known->key, events.letter = known->letter;
  else if (code >= 32 && code < 127)
    events.key = WindowKey::letter, events.letter = static_cast<char>(code);
  if (shown_ && cv::getWindowProperty(title_, cv::WND_PROP_VISIBLE) < 1.0) events.key = WindowKey::closed;
  return events;
}

}  // namespace vegard::apps
