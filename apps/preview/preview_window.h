// The window of a preview: a picture with lines of text, and input by keys and the mouse. OpenCV, which
// opens it, is in a module (sim/base/module.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/preview/preview_painter.h"

namespace vegard::apps {

/// Whether the environment names a display (DISPLAY or WAYLAND_DISPLAY).
bool has_display();

/// Whether a window can be opened on the display. This is tested in a separate process, since the library
/// ends the process if no display answers. To be called before any threads are started.
bool display_answers();

enum class WindowKey { none, up, down, left, right, page_up, page_down, escape, closed, letter };

/// Input events since the last call of wait().
struct WindowEvents {
  WindowKey key = WindowKey::none;
  char letter = 0;                                ///< the letter, for WindowKey::letter
  double dragged_x_px = 0.0, dragged_y_px = 0.0;  ///< with the left button held down
  double wheel = 0.0;                             ///< notches, positive away from the user
};

/// It closes when it is destroyed.
class PreviewWindow {
 public:
  PreviewWindow() = default;
  virtual ~PreviewWindow() = default;
  PreviewWindow(const PreviewWindow&) = delete;
  PreviewWindow& operator=(const PreviewWindow&) = delete;

  /// Shows a picture. The lines, in ASCII, are drawn below each other in its upper left corner.
  virtual void show(const ScreenPicture& picture, const std::vector<std::string>& lines) = 0;

  /// Waits at most this long, or until a key is pressed.
  virtual WindowEvents wait(int ms) = 0;
};

/// Throws sim::MissingModule.
std::unique_ptr<PreviewWindow> open_preview_window(const std::string& title);

/// Of preview_window_module.cpp, which alone uses OpenCV's windows.
struct PreviewWindowModule {
  static constexpr const char* module = "vegard_window";

  std::unique_ptr<PreviewWindow> (*open)(const std::string& title);
};

}  // namespace vegard::apps
