// The window of a preview: a picture with lines of text, and input by keys and the mouse. It hides the use of
// OpenCV.
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

class PreviewWindow {
 public:
  explicit PreviewWindow(const std::string& title);
  ~PreviewWindow();
  PreviewWindow(const PreviewWindow&) = delete;
  PreviewWindow& operator=(const PreviewWindow&) = delete;

  /// Shows a picture. The lines, in ASCII, are drawn below each other in its upper left corner.
  void show(const ScreenPicture& picture, const std::vector<std::string>& lines);

  /// Waits at most this long, or until a key is pressed.
  WindowEvents wait(int ms);

 private:
  struct Mouse;
  void open();

  std::string title_;
  std::unique_ptr<Mouse> mouse_;
  bool shown_ = false;
};

}  // namespace vegard::apps
