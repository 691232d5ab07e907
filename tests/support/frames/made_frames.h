// A file of frames as the imagers of THEMIS write it: all words before the first, what has changed before the
// others.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace vegard::tests {

struct MadeFrames {
  int width_px = 4, height_px = 2;
  std::string begin = "2014-03-10 06:03:";  ///< of every time, before the seconds
  std::vector<double> seconds = {0.25, 3.25, 6.25};
  std::string options = "WIDTH=8 HEIGHT=2 XBIN=2 YBIN=1 XOFFSET=126 MSEC=999";
};

/// Of frame i all pixels are 256 (i + 1) + their number.
inline std::string pixels_of_frame(const MadeFrames& made, std::size_t frame) {
  std::string pixels;
  for (int pixel = 0; pixel < made.width_px * made.height_px; ++pixel) {
    pixels += static_cast<char>(frame + 1);
    pixels += static_cast<char>(pixel);
  }
  return pixels;
}

inline std::string frame_bytes(const MadeFrames& made, std::size_t frame) {
  std::string text = "P5\n";
  if (frame == 0)
    text +=
        "#\"Imager unique ID\" themis19\n#\"Imager model\" an imager\n#\"Site unique ID\" gill\n"
        "#\"Geodetic latitude\" 56.3539\n#\"Geodetic Longitude\" 265.3443\n#\"Geodetic altitude\" 12.5\n";
  char seconds[16];
  std::snprintf(seconds, sizeof seconds, "%09.6f", made.seconds[frame]);
  text += "#\"Mode unique ID\" full\n#\"Exposure options\" " + made.options + "\n#\"Image request start\" " +
          made.begin + seconds + " UTC\n";
  return text + std::to_string(made.width_px) + " " + std::to_string(made.height_px) + "\n65535\n" +
         pixels_of_frame(made, frame);
}

inline std::string frames_bytes(const MadeFrames& made = {}) {
  std::string file;
  for (std::size_t frame = 0; frame < made.seconds.size(); ++frame) file += frame_bytes(made, frame);
  return file;
}

}  // namespace vegard::tests
