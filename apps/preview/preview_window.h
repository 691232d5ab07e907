// The window of a preview: a picture with lines of text, keys and the mouse. OpenCV is behind this door.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/preview/preview_painter.h"

namespace vegard::apps {

/// Whether the environment names a display (DISPLAY or WAYLAND_DISPLAY).
bool has_display();

/// Whether a window opens on it: tried by a process of its own, since the library ends the process where
/// none answers. To be asked before any threads are started.
bool display_answers();

enum class WindowKey { none, up, down, left, right, page_up, page_down, escape, closed, letter };

/// What has happened since it was last asked.
struct WindowEvents {
  WindowKey key = WindowKey::none;
  char letter = 0;                                ///< of WindowKey::letter
  double dragged_x_px = 0.0, dragged_y_px = 0.0;  ///< with the left button held down
  double wheel = 0.0;                             ///< notches, away from oneself
};

class PreviewWindow {
 public:
  explicit PreviewWindow(const std::string& title);
  ~PreviewWindow();
  PreviewWindow(const PreviewWindow&) = delete;
  PreviewWindow& operator=(const PreviewWindow&) = delete;

  /// The lines, in ASCII, stand below each other in the upper left corner.
  void show(const ScreenPicture& picture, const std::vector<std::string>& lines);

  /// Waits so long at most, but no longer than until a key is pressed.
  WindowEvents wait(int ms);

 private:
  struct Mouse;
  void open();

  std::string title_;
  std::unique_ptr<Mouse> mouse_;
  bool shown_ = false;
};

}  // namespace vegard::apps
