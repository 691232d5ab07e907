// Silences decoders: libpng, libjpeg, libtiff, OpenCV, LibRaw and OpenVDB print messages about a file on the
// terminal. The Error that is thrown has the necessary information, and vegard's libraries do not print.
#pragma once

namespace vegard::sim {

/// While an object of this class exists, in any thread, the standard error of the process is discarded.
/// Create it only around the call of a decoder.
class QuietDecoder {
 public:
  QuietDecoder();
  ~QuietDecoder();
  QuietDecoder(const QuietDecoder&) = delete;
  QuietDecoder& operator=(const QuietDecoder&) = delete;
};

/// Returns the file descriptor of the real standard error, even while it is discarded. Safe in signal
/// handlers.
int error_stream();

}  // namespace vegard::sim
