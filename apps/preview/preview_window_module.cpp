#include <algorithm>
#include <cstdint>
#include <exception>
#include <iterator>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/preview/preview_window.h"
#include "sim/base/module.h"

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

/// Where the mouse was when it was last looked at.
struct Mouse {
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

class OpenCvWindow : public PreviewWindow {
 public:
  explicit OpenCvWindow(const std::string& title) : title_(title) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    open();
  }
  ~OpenCvWindow() override {
    try {
      cv::destroyAllWindows();
    } catch (const std::exception&) {
      // It is closed already.
    }
  }

  void show(const ScreenPicture& picture, const std::vector<std::string>& lines) override;
  WindowEvents wait(int ms) override;

 private:
  void open() {
    cv::namedWindow(title_, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    cv::setMouseCallback(title_, &Mouse::event, &mouse_);
  }

  std::string title_;
  Mouse mouse_;
  bool shown_ = false;
};

void OpenCvWindow::show(const ScreenPicture& picture, const std::vector<std::string>& lines) {
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

WindowEvents OpenCvWindow::wait(int ms) {
  // The codes of X11 for what is no letter; those of the numeric keypad mean the same.
  const int code = cv::waitKeyEx(std::max(1, ms));
  WindowEvents events;
  std::swap(events.dragged_x_px, mouse_.dragged_x);
  std::swap(events.dragged_y_px, mouse_.dragged_y);
  std::swap(events.wheel, mouse_.wheel);
  if (events.wheel != 0.0 && shown_) {
    // Qt magnifies what it shows by the wheel itself, and knows no way back but a window again.
    const cv::Rect place = cv::getWindowImageRect(title_);
    cv::destroyWindow(title_);
    open();
    cv::moveWindow(title_, place.x, place.y);
    shown_ = false;
    mouse_.held = false;
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

std::unique_ptr<PreviewWindow> open_window(const std::string& title) {
  return std::make_unique<OpenCvWindow>(title);
}

constexpr PreviewWindowModule functions{open_window};

}  // namespace
}  // namespace vegard::apps

VEGARD_MODULE(&vegard::apps::functions);
